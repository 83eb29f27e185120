//! What the names of arrays mean: names that codes use, and those that a user maps.

use std::borrow::Cow;

use crate::norm::largest_if_finite;
use crate::role::plain;
use crate::{Array, Mistake, Snapshot, Stored};

pub use crate::role::{Form, Role};

/// Names that may mean two quantities.
const UNCLEAR: &[(&str, [Role; 2])] = &[
    ("stress", [Role::CauchyStress, Role::FirstPiolaKirchhoff]),
    ("stresses", [Role::CauchyStress, Role::FirstPiolaKirchhoff]),
    ("piola", [Role::FirstPiolaKirchhoff, Role::SecondPiolaKirchhoff]),
];

/// Faces that the name of a traction may end with.
const FACES: [&str; 10] = [
    "x_min",
    "x_max",
    "y_min",
    "y_max",
    "z_min",
    "z_max",
    "inner",
    "outer",
    "theta_min",
    "theta_max",
];

/// Which numbers of a quantity a column has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    /// The one of that position, of all that there are.
    Nth(usize),
    /// A row and a column.
    Entry(usize, usize),
}

/// Where an array of a snapshot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// The places of its points.
    Grid,
    /// Among the arrays of points.
    Points(usize),
    /// Among those of cells.
    Cells(usize),
}

/// A column of numbers: of an array one component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Column {
    place: Place,
    component: usize,
}

/// What a quantity is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// The quantity.
    pub role: Role,
    /// Its name in the file.
    pub source: String,
    /// The face that the name speaks of: a traction is that of a face.
    pub face: Option<&'static str>,
    columns: Vec<(Part, Column)>,
}

/// What the name of an array says.
struct Understood {
    role: Role,
    part: Option<Part>,
    source: String,
    face: Option<&'static str>,
}

impl Understood {
    fn new(role: Role, part: Option<Part>, source: impl Into<String>) -> Self {
        Understood { role, part, source: source.into(), face: None }
    }
}

/// A quantity and the columns that a user says it is: names, or `name:k` for the component k, counted from 0; `points`
/// are the places of the grid, `cells:name` is an array of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mapping {
    /// The quantity.
    pub role: Role,
    /// Its columns.
    pub columns: Vec<String>,
}

impl std::str::FromStr for Mapping {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}`: expected QUANTITY=COLUMN,.., as in X=x0,y0");
        let (role, columns) = text.split_once('=').ok_or_else(wrong)?;
        let symbols = || Role::ALL.iter().map(|role| role.symbol()).collect::<Vec<_>>().join(", ");
        let known = Role::from_name(role.trim());
        let role = known.ok_or_else(|| format!("`{role}`: expected one of {}", symbols()))?;
        let columns: Vec<_> = columns.split(',').map(|it| it.trim().to_owned()).collect();
        if columns.iter().any(String::is_empty) {
            return Err(wrong());
        }
        Ok(Mapping { role, columns })
    }
}

/// Numbers of a quantity: so many for each point or cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Values<'a> {
    /// All numbers, those of a point or cell together: of an array that has no others they are not copied.
    pub numbers: Cow<'a, [f64]>,
    /// Numbers of a point or cell.
    pub components: usize,
    /// How far one may be from what was computed, for how it was stored.
    pub rounding: f64,
    /// How it was stored.
    pub stored: Stored,
    /// Whether they are of cells.
    pub is_of_cells: bool,
}

impl Values<'_> {
    /// The same, which outlive the snapshot.
    pub fn into_owned(self) -> Values<'static> {
        Values { numbers: Cow::Owned(self.numbers.into_owned()), ..self }
    }
}

/// Says what arrays of a snapshot mean; those with names that are not known are left out.
///
/// # Errors
/// A name that may mean two quantities, of those that `wants` takes; two arrays that may be the same quantity; a
/// mapping to an array that is not there.
pub fn recognise(
    snapshot: &Snapshot,
    map: &[Mapping],
    wants: &dyn Fn(Role) -> bool,
) -> Result<Vec<Meaning>, Mistake> {
    let mut found: Vec<Meaning> = Vec::new();
    for mapping in map {
        found.push(mapped(snapshot, mapping)?);
    }
    let is_mapped = |role: Role| map.iter().any(|mapping| mapping.role == role);
    let taken: Vec<Place> =
        found.iter().flat_map(|it| it.columns.iter().map(|(_, column)| column.place)).collect();
    for (place, array) in arrays(snapshot).filter(|(place, _)| !taken.contains(place)) {
        hold_clear(&array.name, wants).map_err(|mistake| mistake.of(&snapshot.path))?;
        let Some(understood) = understand(place, array) else { continue };
        let Understood { role, part, source, face } = understood;
        if is_mapped(role) || !wants(role) {
            continue;
        }
        let column = |component| Column { place, component };
        let columns: Vec<_> = match part {
            Some(part) => vec![(part, column(0))],
            None => (0..array.components).map(|it| (Part::Nth(it), column(it))).collect(),
        };
        let same = |it: &&mut Meaning| it.role == role && it.source == source && part.is_some();
        match found.iter_mut().find(same) {
            Some(meaning) => meaning.columns.extend(columns),
            None => found.push(Meaning { role, source, face, columns }),
        }
    }
    hold_single(&found).map_err(|mistake| mistake.of(&snapshot.path))?;
    Ok(found)
}

/// All arrays, with the places of points first.
fn arrays(snapshot: &Snapshot) -> impl Iterator<Item = (Place, &Array)> {
    let grid = snapshot.points.iter().map(|array| (Place::Grid, array));
    let points =
        snapshot.of_points.iter().enumerate().map(|(at, array)| (Place::Points(at), array));
    let cells = snapshot.of_cells.iter().enumerate().map(|(at, array)| (Place::Cells(at), array));
    grid.chain(points).chain(cells)
}

/// The names of all arrays.
pub fn all_names(snapshot: &Snapshot) -> String {
    let names: Vec<_> = arrays(snapshot).map(|(_, array)| format!("`{}`", array.name)).collect();
    if names.is_empty() { "no arrays".into() } else { names.join(", ") }
}

fn hold_clear(name: &str, wants: &dyn Fn(Role) -> bool) -> Result<(), Mistake> {
    let stem = split(name).map_or(name, |(base, _)| base);
    let meant = UNCLEAR.iter().find(|(word, _)| *word == plain(stem));
    match meant {
        Some((_, [a, b])) if wants(*a) || wants(*b) => Err(Mistake::new(format!(
            "`{name}` may be {} or {}: say which with `--map {}={name}` or `--map {}={name}`",
            a.name(),
            b.name(),
            a.symbol(),
            b.symbol()
        ))),
        _ => Ok(()),
    }
}

/// Refuses two arrays for one quantity.
fn hold_single(found: &[Meaning]) -> Result<(), Mistake> {
    for (at, meaning) in found.iter().enumerate() {
        let is_same = |it: &&Meaning| it.role == meaning.role && it.face == meaning.face;
        if let Some(other) = found[..at].iter().find(is_same) {
            let (role, symbol) = (meaning.role.name(), meaning.role.symbol());
            return Err(Mistake::new(format!(
                "both `{}` and `{}` may be {role}: say which with `--map {symbol}=NAME`; an array of cells is `cells:NAME`",
                other.source, meaning.source
            )));
        }
    }
    Ok(())
}

/// What an array is, which part of it, and under which name.
fn understand(place: Place, array: &Array) -> Option<Understood> {
    let name = array.name.as_str();
    let role = |name: &str| Role::ALL.iter().copied().find(|role| role.is_called(name));
    match (place, name) {
        // So the project's own runs call x.
        (Place::Grid, "position") => return Some(Understood::new(Role::Position, None, name)),
        (Place::Grid, "reference_position") => {
            return Some(Understood::new(Role::Reference, None, name));
        }
        (Place::Grid, _) => return Some(Understood::new(Role::Place, None, "points")),
        // Coordinates in columns of their own.
        (_, "X" | "Y" | "Z") if array.components == 1 => {
            return Some(Understood::new(Role::Reference, Some(Part::Nth(letter(name)?)), "X"));
        }
        (_, "x" | "y" | "z") if array.components == 1 => {
            return Some(Understood::new(Role::Place, Some(Part::Nth(letter(name)?)), "x"));
        }
        _ => {}
    }
    if let Some(role) = role(name) {
        return Some(Understood::new(role, None, name));
    }
    if let Some(found) = on_face(array) {
        return Some(found);
    }
    let (base, part) = split(name).filter(|_| array.components == 1)?;
    let role = role(base).filter(|role| role.form() != Form::Scalar)?;
    // x0 may be the first coordinate, or where x was.
    let is_coordinate = base.len() == 1 && matches!(role, Role::Place | Role::Reference);
    (!is_coordinate || name.len() > 2).then(|| Understood::new(role, Some(part), base))
}

/// The traction of a face, as `traction_x_max`, or a component of it, as `traction_x_max_y`.
fn on_face(array: &Array) -> Option<Understood> {
    let rest = array.name.strip_prefix("traction_")?;
    let found = FACES.into_iter().find_map(|face| Some((face, rest.strip_prefix(face)?)));
    let (face, end) = found?;
    let part = match end {
        "" => None,
        _ => Some(Part::Nth(letter(end.strip_prefix('_').filter(|_| array.components == 1)?)?)),
    };
    Some(Understood {
        face: Some(face),
        ..Understood::new(Role::Traction, part, format!("traction_{face}"))
    })
}

fn letter(text: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|it| text.eq_ignore_ascii_case(it))
}

/// A name without what says which component it is.
fn split(name: &str) -> Option<(&str, Part)> {
    let name = name.strip_suffix([']', ')']).unwrap_or(name);
    let axis = |byte: u8| match byte {
        b'x' | b'X' => Some(0),
        b'y' | b'Y' => Some(1),
        b'z' | b'Z' => Some(2),
        b'0'..=b'9' => Some(usize::from(byte - b'0')),
        _ => None,
    };
    let (before, last) = name.split_at_checked(name.len().checked_sub(1)?)?;
    let last = axis(last.bytes().next()?)?;
    let base = |text: &'_ str| -> usize {
        text.trim_end_matches(['_', ':', '.', '[', '(', '-', ' ']).len()
    };
    let of_entry =
        before.split_at_checked(before.len().saturating_sub(1)).and_then(|(rest, first)| {
            let first = axis(first.bytes().next()?)?;
            Some((&rest[..base(rest)], Part::Entry(first, last)))
        });
    let found = of_entry.filter(|(base, _)| has_entries(base));
    let found = found.unwrap_or((&before[..base(before)], Part::Nth(last)));
    (!found.0.is_empty()).then_some(found)
}

/// Whether this may be the name of a matrix.
fn has_entries(name: &str) -> bool {
    let is_matrix = |role: &Role| !matches!(role.form(), Form::Scalar | Form::Vector);
    Role::ALL.iter().any(|role| is_matrix(role) && role.is_called(name))
        || UNCLEAR.iter().any(|(word, _)| *word == plain(name))
}

/// What a user says a quantity is.
fn mapped(snapshot: &Snapshot, mapping: &Mapping) -> Result<Meaning, Mistake> {
    let columns = mapping.columns.iter().map(|name| columns(snapshot, name));
    let columns: Vec<_> =
        columns.collect::<Result<Vec<_>, _>>().map_err(|mistake| mistake.of(&snapshot.path))?;
    let columns = columns.into_iter().flatten().enumerate();
    Ok(Meaning {
        role: mapping.role,
        source: mapping.columns.join(","),
        face: None,
        columns: columns.map(|(at, column)| (Part::Nth(at), column)).collect(),
    })
}

/// The columns of an array, or one of them.
fn columns(snapshot: &Snapshot, name: &str) -> Result<Vec<Column>, Mistake> {
    let named = |wanted: &str| {
        arrays(snapshot).find(|(place, array)| match place {
            Place::Grid => wanted == "points" || wanted == array.name,
            Place::Points(_) => wanted == array.name,
            Place::Cells(_) => {
                wanted == array.name || wanted.strip_prefix("cells:") == Some(&array.name)
            }
        })
    };
    let all = |(place, array): (Place, &Array)| {
        (0..array.components).map(|component| Column { place, component }).collect()
    };
    if let Some(found) = named(name) {
        return Ok(all(found));
    }
    let one = name.rsplit_once(':').and_then(|(name, component)| {
        let (found, component) = (named(name)?, component.parse().ok()?);
        (component < found.1.components).then_some(Column { place: found.0, component })
    });
    let one = one.ok_or_else(|| {
        Mistake::new(format!("`--map`: no array `{name}`; the file has {}", all_names(snapshot)))
    });
    Ok(vec![one?])
}

impl Meaning {
    /// How many dimensions a vector of as many columns has.
    pub fn dimension(&self) -> usize {
        self.columns.len().clamp(1, 3)
    }

    /// Its numbers in so many dimensions. What is more than that must be 0 in vectors, and is left out in tensors.
    ///
    /// # Errors
    /// Too few numbers, or too many; one that is not finite, by its place.
    pub fn values<'a>(
        &self,
        snapshot: &'a Snapshot,
        dimension: usize,
    ) -> Result<Values<'a>, Mistake> {
        let columns = self.wanted(dimension).map_err(|mistake| mistake.of(&snapshot.path))?;
        let of = |column: &Column| array(snapshot, column.place);
        let rows = of(&columns[0]).rows();
        if let Some(other) = columns.iter().map(of).find(|other| other.rows() != rows) {
            let what =
                format!("`{}` has {rows} rows, and `{}` {}", self.source, other.name, other.rows());
            return Err(Mistake::new(what).of(&snapshot.path));
        }
        self.hold_flat(snapshot, dimension)?;
        let numbers = gathered(snapshot, &columns, rows);
        let largest = largest_if_finite(&numbers).map_err(|at| {
            let row = at / columns.len();
            let what = format!("{} is {}; expected a finite number", self.source, numbers[at]);
            here(snapshot, row, what)
        })?;
        let stored = columns.iter().map(|it| of(it).stored).reduce(Stored::coarser);
        let stored = stored.unwrap_or(Stored::Double).at_first(&numbers);
        Ok(Values {
            components: columns.len(),
            rounding: stored.rounding(largest),
            stored,
            is_of_cells: matches!(columns[0].place, Place::Cells(_)),
            numbers,
        })
    }

    /// The columns that a field of that dimension has.
    fn wanted(&self, dimension: usize) -> Result<Vec<Column>, Mistake> {
        let pairs = || pairs_of((0..dimension).collect());
        let found = match self.role.form() {
            Form::Scalar => vec![self.columns.first().filter(|_| self.columns.len() == 1)],
            Form::Vector => (0..dimension).map(|axis| self.nth(axis)).collect(),
            Form::Tensor => pairs().map(|(i, j)| self.entry(i, j)).collect(),
            Form::Symmetric => {
                pairs().map(|(i, j)| self.entry(i, j).or_else(|| self.entry(j, i))).collect()
            }
            Form::Voigt => {
                pairs_of(self.in_dimension(dimension)).map(|(i, j)| self.entry(i, j)).collect()
            }
        };
        let found: Option<Vec<Column>> = found.into_iter().map(|it| it.map(|it| it.1)).collect();
        found.ok_or_else(|| self.misfit(dimension))
    }

    /// The rows of a matrix over Voigt's components that a field of that dimension has: in a plane all but 33.
    fn in_dimension(&self, dimension: usize) -> Vec<usize> {
        match (dimension, self.columns.len()) {
            (2, 16) => vec![0, 1, 3],
            _ => (0..dimension * (dimension + 1) / 2).collect(),
        }
    }

    /// Whether the numbers of axes, rows and columns in names are counted from 1 on.
    fn least_number(&self) -> usize {
        let is_named = |part: &Part| matches!(part, Part::Entry(..));
        let least = |(part, _): &(Part, Column)| match *part {
            Part::Nth(at) => at,
            Part::Entry(i, j) => i.min(j),
        };
        let (least, most) = (
            self.columns.iter().map(least).min().unwrap_or(0),
            self.columns
                .iter()
                .map(|(part, _)| match *part {
                    Part::Nth(at) => at,
                    Part::Entry(i, j) => i.max(j),
                })
                .max()
                .unwrap_or(0),
        );
        let any = self.columns.iter().any(|(part, _)| is_named(part));
        usize::from(least == 1 && (any || most <= self.columns.len()))
    }

    fn nth(&self, at: usize) -> Option<&(Part, Column)> {
        self.columns.iter().find(|(part, _)| *part == Part::Nth(at + self.least_number()))
    }

    /// The entry of a matrix: by its name, or from as many as a square matrix has, row by row.
    fn entry(&self, row: usize, column: usize) -> Option<&(Part, Column)> {
        let from = self.least_number();
        let named = |part: &Part| *part == Part::Entry(row + from, column + from);
        let by_name = self.columns.iter().find(|(part, _)| named(part));
        let largest = if self.role.form() == Form::Voigt { 6 } else { 3 };
        let size = (1..=largest).find(|size| size * size == self.columns.len());
        by_name
            .or_else(|| self.nth(row * size.filter(|&size| row < size && column < size)? + column))
    }

    fn misfit(&self, dimension: usize) -> Mistake {
        let (symbol, source, found) = (self.role.symbol(), &self.source, self.columns.len());
        let expected = match self.role.form() {
            Form::Scalar => 1,
            Form::Vector => dimension,
            Form::Tensor | Form::Symmetric => dimension * dimension,
            Form::Voigt => (dimension * (dimension + 1) / 2).pow(2),
        };
        let advice = match (self.role.form(), found) {
            (Form::Tensor | Form::Symmetric, 3 | 4 | 6) => format!(
                "; is it in the order of Voigt? then name its entries row by row, as in `--map {symbol}={source}:0,{source}:3,..`"
            ),
            _ => format!("; name them with `--map {symbol}=..`"),
        };
        Mistake::new(format!(
            "`{source}`, read as {}, has {found} component(s), and of {dimension} dimension(s) {expected} are expected{advice}",
            self.role.name()
        ))
    }

    /// Refuses a vector with more than the field's components, unless they are 0 throughout.
    fn hold_flat(&self, snapshot: &Snapshot, dimension: usize) -> Result<(), Mistake> {
        let from = self.least_number();
        let is_beyond = |part: &Part| matches!(part, Part::Nth(at) if *at >= dimension + from);
        let beyond = self.columns.iter().filter(|(part, _)| is_beyond(part));
        if self.role.form() != Form::Vector {
            return Ok(());
        }
        for (_, column) in beyond {
            let array = array(snapshot, column.place);
            let numbers = array.values.iter().skip(column.component).step_by(array.components);
            if let Some((row, value)) = numbers.enumerate().find(|(_, value)| **value != 0.0) {
                let what = format!(
                    "`{}` has a component of {value} beyond the {dimension} of the field; expected 0",
                    self.source
                );
                return Err(here(snapshot, row, what));
            }
        }
        Ok(())
    }
}

/// Rows and columns of a square matrix, row by row.
fn pairs_of(rows: Vec<usize>) -> impl Iterator<Item = (usize, usize)> {
    let columns = rows.clone();
    rows.into_iter().flat_map(move |i| columns.clone().into_iter().map(move |j| (i, j)))
}

/// The numbers of some columns, those of a row together.
fn gathered<'a>(snapshot: &'a Snapshot, columns: &[Column], rows: usize) -> Cow<'a, [f64]> {
    let first = array(snapshot, columns[0].place);
    let is_next = |(at, column): (usize, &Column)| {
        column.place == columns[0].place && column.component == columns[0].component + at
    };
    // Most often they stand side by side, with no others or with a third coordinate behind them.
    if columns.iter().enumerate().all(is_next) {
        if columns.len() == first.components {
            return Cow::Borrowed(&first.values);
        }
        let (start, count) = (columns[0].component, columns.len());
        let mut numbers = Vec::with_capacity(rows * count);
        let each = first.values.chunks_exact(first.components);
        each.for_each(|row| numbers.extend_from_slice(&row[start..start + count]));
        return numbers.into();
    }
    let mut numbers = vec![0.0; rows * columns.len()];
    for (at, column) in columns.iter().enumerate() {
        let array = array(snapshot, column.place);
        let own = array.values.chunks_exact(array.components).map(|row| row[column.component]);
        let to = numbers.chunks_exact_mut(columns.len());
        to.zip(own).for_each(|(to, number)| to[at] = number);
    }
    numbers.into()
}

fn array(snapshot: &Snapshot, place: Place) -> &Array {
    match place {
        Place::Points(at) => &snapshot.of_points[at],
        Place::Cells(at) => &snapshot.of_cells[at],
        Place::Grid => {
            snapshot.points.as_ref().expect("a meaning is of the snapshot that it was found in")
        }
    }
}

/// A mistake at a point.
pub(crate) fn here(snapshot: &Snapshot, row: usize, what: String) -> Mistake {
    let line = snapshot.lines.get(row).copied();
    let what = if line.is_some() { what } else { format!("point {row}: {what}") };
    Mistake { path: snapshot.path.clone(), line, what }
}
