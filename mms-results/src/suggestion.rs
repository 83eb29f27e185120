//! Suggestions: the columns of a file that may contain a quantity whose name is unknown.

use crate::axes::Axes;
use crate::meaning::{ArrayPlace, Meaning};
use crate::parts::{arrays, split};
use crate::role::{Form, Role};
use crate::{Array, Snapshot};

/// Words in the names of displacements in several languages.
const DISPLACED: [&str; 6] = ["disp", "depl", "verschieb", "spost", "desplaz", "move"];

/// Columns of points, by their names in `--map`, with their numbers row by row.
struct Candidate {
    names: Vec<String>,
    numbers: Vec<f64>,
}

impl Candidate {
    /// All finite numbers of some columns, each given by an array and a component.
    fn of(columns: &[(String, &Array, usize)]) -> Option<Candidate> {
        let rows = columns.first()?.1.rows();
        let mut numbers = vec![0.0; rows * columns.len()];
        for (at, (_, array, component)) in columns.iter().enumerate() {
            if array.rows() != rows {
                return None;
            }
            for row in 0..rows {
                numbers[row * columns.len() + at] =
                    array.values[row * array.components + component];
            }
        }
        let is_finite = rows > 0 && numbers.iter().all(|it| it.is_finite());
        let names = columns.iter().map(|(name, ..)| name.clone()).collect();
        is_finite.then_some(Candidate { names, numbers })
    }

    /// The option that maps the quantity to the columns.
    fn option(&self, role: Role) -> String {
        let mapping = format!("{}={}", role.symbol(), self.names.join(","));
        let needs_quotes =
            mapping.contains(|it: char| it.is_whitespace() || "()[]$&;*?".contains(it));
        if needs_quotes { format!("`--map '{mapping}'`") } else { format!("`--map {mapping}`") }
    }

    /// Whether it is one column that counts rows.
    fn is_count(&self) -> bool {
        self.numbers.windows(2).all(|it| it[1] == it[0] + 1.0)
    }
}

/// The only column of an array.
fn column<'a>(array: &&'a Array) -> (String, &'a Array, usize) {
    (array.name.clone(), array, 0)
}

/// Possible vectors of a dimension in arrays of points: an array with as many components, or with others that are 0; columns
/// whose names differ in a component; and adjacent columns.
fn vectors(snapshot: &Snapshot, dimension: usize) -> Vec<Candidate> {
    let of_points = || arrays(snapshot).filter(|(place, _)| !matches!(place, ArrayPlace::Cells(_)));
    let mut found = Vec::new();
    let is_flat = |array: &Array| {
        let mut rows = array.values.chunks_exact(array.components);
        rows.all(|row| row[dimension..].iter().all(|it| *it == 0.0))
    };
    let fits =
        |array: &Array| array.components >= dimension && array.components <= 3 && is_flat(array);
    for (place, array) in of_points().filter(|(_, it)| fits(it)) {
        let name = if place == ArrayPlace::Grid { "points" } else { &array.name };
        let columns: Vec<_> = (0..dimension).map(|at| (name.to_owned(), array, at)).collect();
        let whole = Candidate::of(&columns);
        found.extend(whole.map(|it| Candidate { names: vec![name.to_owned()], ..it }));
    }
    let single: Vec<&Array> =
        of_points().map(|(_, array)| array).filter(|it| it.components == 1).collect();
    let mut windows: Vec<_> = single.windows(dimension.max(1)).collect();
    let base =
        |array: &&Array| split(&array.name, Axes::Cartesian).map(|(base, _)| base.to_owned());
    let has_one_base = |them: &&[&Array]| {
        base(&them[0]).is_some_and(|it| them.iter().all(|other| base(other).as_ref() == Some(&it)))
    };
    if dimension > 1 {
        windows.sort_by_key(|it| !has_one_base(it));
        let all = windows
            .into_iter()
            .filter_map(|them| Candidate::of(&them.iter().map(column).collect::<Vec<_>>()));
        found.extend(all);
    }
    found.retain(|it| !it.is_count());
    found
}

/// The option that names X: the columns that lie in the body at the most places. `None` if there are no such columns.
pub fn positions(
    snapshot: &Snapshot,
    dimension: usize,
    outside: &dyn Fn(&[f64]) -> f64,
) -> Option<String> {
    let is_inside =
        |it: &Candidate| it.numbers.chunks_exact(dimension).all(|point| outside(point) == 0.0);
    let places = |it: &Candidate| {
        let mut points: Vec<&[f64]> = it.numbers.chunks_exact(dimension).collect();
        points.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        points.dedup();
        points.len()
    };
    let found = vectors(snapshot, dimension).into_iter().filter(is_inside);
    let found = found.map(|it| (places(&it), it)).filter(|(places, _)| *places > 1);
    // The first of the best ones.
    let best = found.reduce(|best, it| if it.0 > best.0 { it } else { best });
    best.map(|(_, it)| it.option(Role::Reference))
}

/// The option that names a vector or a scalar: columns without another meaning, and for u with a name that sounds like it.
/// `None` if there are no such columns.
pub fn quantity(
    snapshot: &Snapshot,
    dimension: usize,
    role: Role,
    known: &[Meaning],
) -> Option<String> {
    let components = match role.form() {
        Form::Scalar => 1,
        Form::Vector => dimension,
        Form::Tensor | Form::Symmetric | Form::Voigt => return None,
    };
    let is_taken = |name: &String| {
        let columns = known.iter().flat_map(|it| &it.columns);
        let mut names = columns.map(|(_, it)| crate::meaning::name(snapshot, it.place));
        name == "points" || names.any(|it| it == name)
    };
    let mut found = vectors(snapshot, components);
    found.retain(|it| !it.names.iter().any(is_taken));
    let sounds = |it: &Candidate| {
        let plain = it.names.concat().to_lowercase();
        DISPLACED.iter().any(|word| plain.contains(word))
    };
    if role == Role::Displacement {
        found.sort_by_key(|it| !sounds(it));
    }
    found.first().map(|it| it.option(role))
}
