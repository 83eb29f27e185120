//! Compares two results of one run: how far they differ, and where. Points may be in another order.

use std::collections::BTreeMap;

use anyhow::{bail, ensure};
use mms_results::names::Names;
use mms_results::pairing::{self, PairedBy, Pairs};
use mms_results::{Array, Snapshot};

use super::{Results, placed};

/// The largest difference of an array.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The array.
    pub name: String,
    /// The time, if it is known.
    pub time: Option<f64>,
    /// The largest difference of a number.
    pub largest: f64,
    /// The largest number of both arrays.
    pub magnitude: f64,
    /// The place of the largest difference.
    pub place: String,
}

impl Difference {
    /// The largest difference divided by the largest number; 0 if both are 0.
    pub fn relative(&self) -> f64 {
        if self.largest == 0.0 { 0.0 } else { self.largest / self.magnitude }
    }
}

/// The comparison of two results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Same {
    /// The differences of all arrays that both have, the largest over times.
    pub differences: Vec<Difference>,
    /// The names of arrays that only one has.
    pub alone: Vec<String>,
    /// The names of arrays of words, which are not compared.
    pub words: Vec<String>,
    /// The pairing of points.
    pub paired: String,
    /// The positions of the differences, by their names.
    known: BTreeMap<String, usize>,
}

/// Compares two results, point by point.
///
/// # Errors
/// Results with other times or other points.
pub fn same(a: &Results, b: &Results, names: &Names) -> anyhow::Result<Same> {
    ensure!(
        a.snapshots.len() == b.snapshots.len(),
        "`{}` has {} times, and `{}` {}",
        a.name,
        a.snapshots.len(),
        b.name,
        b.snapshots.len()
    );
    let mut same = Same::default();
    for (one, other) in a.snapshots.iter().zip(&b.snapshots) {
        let times = [one, other].map(|it| it.time.map(|time| time.value));
        if let [Some(first), Some(second)] = times
            && (first - second).abs() > 1e-9 * first.abs().max(second.abs())
        {
            bail!("{}: t = {first}, and {second} in {}", one.path, other.path);
        }
        same.compare(one, other, names)?;
    }
    for names in [&mut same.alone, &mut same.words] {
        names.sort();
        names.dedup();
    }
    Ok(same)
}

impl Same {
    /// Whether all numbers that were compared are finite.
    pub fn is_finite(&self) -> bool {
        self.differences.iter().all(|it| it.largest.is_finite())
    }

    fn compare(&mut self, one: &Snapshot, other: &Snapshot, names: &Names) -> anyhow::Result<()> {
        let [of_one, of_other] = [one, other].map(|it| arrays(it).collect::<Arrays<'_>>());
        for (from, to) in [(&of_one, &of_other), (&of_other, &of_one)] {
            let has = |name: &str| [true, false].iter().any(|of| to.contains_key(&(name, *of)));
            let missing = from.keys().filter(|(name, _)| !has(name));
            self.alone.extend(missing.map(|(name, _)| (*name).to_owned()));
        }
        self.words.extend(one.unread.iter().chain(&other.unread).cloned());
        let (points, by) = pairing::points(one, other, names).map_err(placed)?;
        let cells = pairing::cells(one, other, &points).map_err(placed)?;
        self.paired = match by {
            PairedBy::Number(name) => format!("by the number in `{name}`"),
            PairedBy::Place => "by X".into(),
            PairedBy::Order => {
                "in the order of the files, without numbers or X to pair them".into()
            }
        };
        for (key, array) in arrays(one) {
            let (Some(&second), is_of_points) = (of_other.get(&key), key.1) else { continue };
            let (of_all, pairs) = match is_of_points {
                true => ([one, other].map(Snapshot::rows), &points),
                false => ([one, other].map(|it| it.cells.len()), &cells),
            };
            let rows = [array, second].map(Array::rows);
            // Arrays that belong neither to points nor to cells keep their own order.
            let in_order = Pairs::InOrder(rows[0]);
            let pairs = if rows == of_all { pairs } else { &in_order };
            ensure!(
                rows == of_all || rows[0] == rows[1],
                "{}: `{}` has {} rows, and {} in {}",
                one.path,
                array.name,
                rows[0],
                rows[1],
                other.path
            );
            ensure!(
                array.components == second.components,
                "{}: `{}` has {} components, and {} in {}",
                one.path,
                array.name,
                array.components,
                second.components,
                other.path
            );
            let (row, largest) = farthest(array, second, pairs);
            let place =
                if is_of_points { one.place(row) } else { format!("{}: cell {row}", one.path) };
            let both = array.values.iter().chain(&second.values);
            let magnitude = both.fold(0.0, |most: f64, it| most.max(it.abs()));
            let time = one.time.map(|time| time.value);
            self.keep(Difference { name: array.name.clone(), time, largest, magnitude, place });
        }
        Ok(())
    }

    /// Keeps the larger difference of each array; NaN counts as the largest.
    fn keep(&mut self, one: Difference) {
        match self.known.get(&one.name).map(|&at| &mut self.differences[at]) {
            Some(most) if one.largest > most.largest || one.largest.is_nan() => *most = one,
            Some(_) => {}
            None => {
                self.known.insert(one.name.clone(), self.differences.len());
                self.differences.push(one);
            }
        }
    }
}

/// The largest difference of a number, and its row in the first array.
fn farthest(one: &Array, other: &Array, pairs: &Pairs) -> (usize, f64) {
    let size = one.components;
    let mut most = (0, 0.0_f64);
    for [a, b] in pairs.iter() {
        let numbers = one.values[a * size..][..size].iter().zip(&other.values[b * size..][..size]);
        for (x, y) in numbers {
            let far = if x == y && x.is_finite() { 0.0 } else { (x - y).abs() };
            // A difference that is NaN counts as the largest.
            if far > most.1 || far.is_nan() && !most.1.is_nan() {
                most = (a, far);
            }
        }
    }
    most
}

/// Arrays by their names and by whether they belong to points.
type Arrays<'a> = BTreeMap<(&'a str, bool), &'a Array>;

/// All arrays.
fn arrays(snapshot: &Snapshot) -> impl Iterator<Item = ((&str, bool), &Array)> {
    let points = snapshot.points.iter().chain(&snapshot.of_points).map(|array| (array, true));
    let all = points.chain(snapshot.of_cells.iter().map(|array| (array, false)));
    all.map(|(array, is_of_points)| ((array.name.as_str(), is_of_points), array))
}
