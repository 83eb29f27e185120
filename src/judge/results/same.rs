//! Two results of one run: how far they differ, and where.

use anyhow::{bail, ensure};
use mms_results::{Array, Snapshot};

use super::Results;

/// The largest difference of an array.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The array.
    pub name: String,
    /// The time, where it is known.
    pub time: Option<f64>,
    /// The largest difference of a number.
    pub largest: f64,
    /// The largest number of both.
    pub magnitude: f64,
    /// Where it is.
    pub place: String,
}

impl Difference {
    /// The largest difference over the largest number; 0 where both are.
    pub fn relative(&self) -> f64 {
        if self.largest == 0.0 { 0.0 } else { self.largest / self.magnitude }
    }
}

/// The differences of all arrays that two results have both, the largest over times, and the names of those that one has.
///
/// # Errors
/// Results of other times or of other points.
pub fn same(a: &Results, b: &Results) -> anyhow::Result<(Vec<Difference>, Vec<String>)> {
    ensure!(
        a.snapshots.len() == b.snapshots.len(),
        "`{}` has {} times, and `{}` {}",
        a.name,
        a.snapshots.len(),
        b.name,
        b.snapshots.len()
    );
    let (mut differences, mut alone) = (Vec::<Difference>::new(), Vec::new());
    for (one, other) in a.snapshots.iter().zip(&b.snapshots) {
        let times = [one, other].map(|it| it.time.map(|time| time.value));
        if let [Some(first), Some(second)] = times
            && (first - second).abs() > 1e-9 * first.abs().max(second.abs())
        {
            bail!("{}: t = {first}, and {second} in {}", one.path, other.path);
        }
        let (found, missing) = compare(one, other)?;
        found.into_iter().for_each(|it| keep(&mut differences, it));
        alone.extend(missing);
    }
    alone.sort();
    alone.dedup();
    Ok((differences, alone))
}

/// Keeps the larger difference of each array; what is no number is the largest.
fn keep(all: &mut Vec<Difference>, one: Difference) {
    match all.iter_mut().find(|it| it.name == one.name) {
        None => all.push(one),
        Some(most) if one.largest > most.largest || one.largest.is_nan() => *most = one,
        Some(_) => {}
    }
}

/// All arrays, and whether they are of points.
fn arrays(snapshot: &Snapshot) -> impl Iterator<Item = (&Array, bool)> {
    let points = snapshot.points.iter().chain(&snapshot.of_points).map(|array| (array, true));
    points.chain(snapshot.of_cells.iter().map(|array| (array, false)))
}

fn compare(one: &Snapshot, other: &Snapshot) -> anyhow::Result<(Vec<Difference>, Vec<String>)> {
    let named =
        |snapshot: &'_ Snapshot, name: &str| arrays(snapshot).any(|(it, _)| it.name == name);
    let mut alone: Vec<String> = Vec::new();
    for (from, to) in [(one, other), (other, one)] {
        let missing = arrays(from).filter(|(it, _)| !named(to, &it.name));
        alone.extend(missing.map(|(it, _)| it.name.clone()));
    }
    let mut differences = Vec::new();
    for (array, is_of_points) in arrays(one) {
        let Some((second, _)) =
            arrays(other).find(|(it, of)| it.name == array.name && *of == is_of_points)
        else {
            continue;
        };
        ensure!(
            array.values.len() == second.values.len(),
            "{}: `{}` has {} numbers, and {} in {}",
            one.path,
            array.name,
            array.values.len(),
            second.values.len(),
            other.path
        );
        let far = array
            .values
            .iter()
            .zip(&second.values)
            .map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() });
        let (at, largest) = far.enumerate().fold((0, 0.0_f64), |most, (at, far)| {
            // What is no number differs most of all.
            if far > most.1 || far.is_nan() && !most.1.is_nan() { (at, far) } else { most }
        });
        let row = at / array.components;
        let place = if is_of_points { one.place(row) } else { format!("{}: cell {row}", one.path) };
        let both = array.values.iter().chain(&second.values);
        let magnitude = both.fold(0.0, |most: f64, it| most.max(it.abs()));
        let time = one.time.map(|time| time.value);
        differences.push(Difference { name: array.name.clone(), time, largest, magnitude, place });
    }
    Ok((differences, alone))
}
