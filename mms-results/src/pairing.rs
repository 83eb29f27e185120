//! Pairs the points and cells of two results, which files may list in different orders: ranks write their own parts, and a
//! restart may sort anew.

use std::collections::BTreeMap;

use crate::lattice::Lattice;
use crate::motion::difference;
use crate::names::{Names, Role, Values, recognise};
use crate::{Array, Cells, Mistake, Snapshot};

/// Pairs of rows of two results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Pairs {
    /// Rows with the same number, and the number of rows.
    InOrder(usize),
    /// Rows of the first and of the second.
    Listed(Vec<[usize; 2]>),
}

impl Pairs {
    /// All pairs.
    pub fn iter(&self) -> Box<dyn Iterator<Item = [usize; 2]> + '_> {
        match self {
            Pairs::InOrder(count) => Box::new((0..*count).map(|row| [row; 2])),
            Pairs::Listed(all) => Box::new(all.iter().copied()),
        }
    }
}

/// The way in which points were paired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PairedBy {
    /// By the numbers in an array of this name.
    Number(String),
    /// By X.
    Place,
    /// By the order in the files.
    Order,
}

/// Names of arrays that number points, in lower case, without separators, and without a final s.
const NUMBERS: [&str; 11] = [
    "id",
    "pid",
    "gid",
    "tag",
    "pointid",
    "nodeid",
    "particle",
    "particleid",
    "globalid",
    "globalnodeid",
    "globalpointid",
];

/// A row without a partner: the result, and the row.
type Alone = (usize, usize);

/// Pairs the points of two snapshots: by numbers that both have for their points, by X, or, where neither is known, by their
/// order. Points in one place are paired in their order; if one result has one point there, it is paired with all of the other:
/// parts of a mesh both have the points between them.
///
/// # Errors
/// A point that the other result does not have; different numbers of points where only the order could pair them.
pub fn points(
    one: &Snapshot,
    other: &Snapshot,
    names: &Names,
) -> Result<(Pairs, PairedBy), Mistake> {
    if let Some((name, [a, b])) = numbered(one, other) {
        let pairs = by_place(&a.values, &b.values, 1, 0.25);
        return pairs
            .map(|it| (it, PairedBy::Number(name)))
            .map_err(|it| alone([one, other], it, "number"));
    }
    let places = [places(one, names)?, places(other, names)?];
    let mut refused = None;
    if let [Some(of_one), Some(of_other)] = &places {
        let tried = of_one.readings.iter().zip(&of_other.readings);
        for (a, b) in tried.filter(|(a, b)| a.components == b.components) {
            // At most a quarter of the distance of neighbours, so that rounding cannot confuse them.
            let within = (4.0 * (a.rounding + b.rounding)).min(spacing(a) / 4.0)
                + 8.0 * f64::EPSILON * largest(a).max(largest(b));
            match by_place(&a.numbers, &b.numbers, a.components, within) {
                Ok(pairs) => return Ok((pairs, PairedBy::Place)),
                Err(row) => refused = refused.or(Some(row)),
            }
        }
        if let Some(row) = refused.filter(|_| of_one.is_reference && of_other.is_reference) {
            return Err(alone([one, other], row, "X"));
        }
    }
    let counts = [one, other].map(Snapshot::rows);
    if counts[0] != counts[1] {
        return Err(match refused {
            Some(row) => alone([one, other], row, "place"),
            None => {
                Mistake::new(format!("{} points, and {} in {}", counts[0], counts[1], other.path))
                    .of(&one.path)
            }
        });
    }
    Ok((Pairs::InOrder(counts[0]), PairedBy::Order))
}

/// Pairs cells by their points.
///
/// # Errors
/// A cell that the other result does not have.
pub fn cells(one: &Snapshot, other: &Snapshot, points: &Pairs) -> Result<Pairs, Mistake> {
    if matches!(points, Pairs::InOrder(_)) && one.cells == other.cells {
        return Ok(Pairs::InOrder(one.cells.len()));
    }
    for snapshot in [one, other] {
        snapshot.cells.validate(snapshot.rows()).map_err(|mistake| mistake.of(&snapshot.path))?;
    }
    // Paired points are named by the first of them in one result.
    let mut names = [vec![0; one.rows()], vec![usize::MAX; other.rows()]];
    points.iter().for_each(|[a, b]| names[1][b] = names[1][b].min(a));
    points.iter().for_each(|[a, b]| names[0][a] = names[1][b]);
    let listed = |cells: &Cells, names: &[usize]| -> BTreeMap<(u8, Vec<usize>), Vec<usize>> {
        let mut all = BTreeMap::<_, Vec<usize>>::new();
        for (at, (kind, points)) in cells.iter().enumerate() {
            let mut own: Vec<usize> = points.iter().map(|&point| names[point]).collect();
            own.sort_unstable();
            all.entry((kind, own)).or_default().push(at);
        }
        all
    };
    let (a, mut b) = (listed(&one.cells, &names[0]), listed(&other.cells, &names[1]));
    let mut groups = Vec::new();
    for (key, of_one) in a {
        groups.push([of_one, b.remove(&key).unwrap_or_default()]);
    }
    groups.extend(b.into_values().map(|rest| [Vec::new(), rest]));
    listed_pairs(groups).map_err(|(which, row)| {
        let paths = [&one.path, &other.path];
        Mistake::new(format!("cell {row} has no counterpart in {}", paths[1 - which]))
            .of(paths[which])
    })
}

/// The approximate distance of neighbouring points.
fn spacing(values: &Values<'_>) -> f64 {
    let mut extent: f64 = 0.0;
    for axis in 0..values.components {
        let along = || values.numbers.iter().skip(axis).step_by(values.components).copied();
        extent = extent.max(along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min));
    }
    let count = (values.numbers.len() / values.components) as f64;
    extent / count.powf(1.0 / values.components as f64)
}

fn largest(values: &Values<'_>) -> f64 {
    values.numbers.iter().fold(0.0, |most: f64, it| most.max(it.abs()))
}

fn alone(both: [&Snapshot; 2], (which, row): Alone, by: &str) -> Mistake {
    let place = both[which].place(row);
    let what = format!("this point has no partner in {} by its {by}", both[1 - which].path);
    match both[which].lines.get(row) {
        Some(&line) => Mistake { line: Some(line), ..Mistake::new(what).of(&both[which].path) },
        None => Mistake::new(format!("{what} ({})", place.rsplit(": ").next().unwrap_or_default()))
            .of(&both[which].path),
    }
}

/// The arrays that number the points of both, with a different number for each point.
fn numbered<'a>(one: &'a Snapshot, other: &'a Snapshot) -> Option<(String, [&'a Array; 2])> {
    let plain = |name: &str| -> String {
        name.chars().filter(|it| it.is_alphanumeric()).flat_map(char::to_lowercase).collect()
    };
    let is_number = |array: &&Array| {
        array.components == 1 && NUMBERS.contains(&plain(&array.name).trim_end_matches('s'))
    };
    let of = |snapshot: &'a Snapshot| {
        let rows = snapshot.rows();
        snapshot.of_points.iter().filter(is_number).filter(move |it| it.rows() == rows)
    };
    of(one).find_map(|a| {
        let b = of(other).find(|it| it.name == a.name)?;
        [a, b].into_iter().all(are_distinct).then(|| (a.name.clone(), [a, b]))
    })
}

fn are_distinct(array: &Array) -> bool {
    let mut values = array.values.clone();
    values.sort_unstable_by(f64::total_cmp);
    values.iter().all(|it| it.fract() == 0.0) && values.windows(2).all(|it| it[0] < it[1])
}

/// The places of points in each possible reading: X first.
struct Places<'a> {
    readings: Vec<Values<'a>>,
    is_reference: bool,
}

fn places<'a>(snapshot: &'a Snapshot, names: &Names) -> Result<Option<Places<'a>>, Mistake> {
    let is_place =
        |role| matches!(role, Role::Reference | Role::Position | Role::Place | Role::Displacement);
    let map = names.map.iter().filter(|it| is_place(it.role)).cloned().collect();
    let meanings = recognise(snapshot, &Names { map, ..names.clone() }, &is_place)?;
    let values = |role: Role| -> Result<Option<Values<'a>>, Mistake> {
        let meaning = meanings.iter().find(|it| it.role == role);
        let found = meaning.map(|it| it.values(snapshot, it.dimension())).transpose()?;
        let is_of_all = |it: &Values<'_>| it.numbers.len() == it.components * snapshot.rows();
        Ok(found.filter(|it| !it.is_of_cells && is_of_all(it)))
    };
    if let Some(reference) = values(Role::Reference)? {
        return Ok(Some(Places { readings: vec![reference], is_reference: true }));
    }
    let u = values(Role::Displacement)?;
    let back = |x: &Values<'a>| {
        let u = u.as_ref().filter(|u| u.numbers.len() == x.numbers.len())?;
        Some(difference(x, u))
    };
    if let Some(present) = values(Role::Position)? {
        let back = back(&present);
        let is_reference = back.is_some();
        return Ok(Some(Places { readings: vec![back.unwrap_or(present)], is_reference }));
    }
    let Some(place) = values(Role::Place)? else { return Ok(None) };
    let back = back(&place);
    let readings = std::iter::once(place).chain(back).collect();
    Ok(Some(Places { readings, is_reference: false }))
}

/// Pairs rows that are within a distance of each other in each coordinate.
fn by_place(a: &[f64], b: &[f64], size: usize, within: f64) -> Result<Pairs, Alone> {
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= within);
    if a.len() == b.len() && near(a, b) {
        return Ok(Pairs::InOrder(a.len() / size));
    }
    let lattice = Lattice::new(b, size, 2.0 * within.max(f64::MIN_POSITIVE));
    let first = |point: &[f64]| {
        let beside = lattice.near(point, within);
        beside.filter(|at| near(point, &b[at * size..][..size])).min()
    };
    let mut groups = BTreeMap::<usize, [Vec<usize>; 2]>::new();
    for (at, point) in b.chunks(size).enumerate() {
        groups.entry(first(point).unwrap_or(at)).or_default()[1].push(at);
    }
    for (at, point) in a.chunks(size).enumerate() {
        let found = first(point).ok_or((0, at))?;
        // Points in one place are named by the first of them.
        let name = first(&b[found * size..][..size]).unwrap_or(found);
        groups.entry(name).or_default()[0].push(at);
    }
    listed_pairs(groups.into_values().collect())
}

/// Pairs the rows in one place: equally many in their order, or all with one.
fn listed_pairs(groups: Vec<[Vec<usize>; 2]>) -> Result<Pairs, Alone> {
    let mut all = Vec::new();
    for [a, b] in groups {
        match (a.as_slice(), b.as_slice()) {
            (_, [one]) if !a.is_empty() => all.extend(a.iter().map(|&row| [row, *one])),
            ([one], [_, ..]) => all.extend(b.iter().map(|&row| [*one, row])),
            _ if a.len() == b.len() => all.extend(a.iter().zip(&b).map(|(a, b)| [*a, *b])),
            _ if a.len() > b.len() => return Err((0, a[b.len()])),
            _ => return Err((1, b[a.len()])),
        }
    }
    all.sort_unstable();
    Ok(Pairs::Listed(all))
}
