//! Splits arrays whose first axis is times into snapshots.

use std::collections::{BTreeSet, HashMap};

use super::table::is_time;
use crate::wanted::Wanted;
use crate::{Array, Mistake, Snapshot, Time};

/// An array, with the length of each of its axes.
pub struct Shaped {
    pub array: Array,
    pub shape: Vec<usize>,
}

/// Whether an array of this name contains times.
pub fn are_times(name: &str) -> bool {
    is_time(name) || name.eq_ignore_ascii_case("times")
}

/// The possible numbers of components of a point.
const COMPONENTS: [usize; 6] = [1, 2, 3, 4, 6, 9];

/// Whether an array of this shape can belong to the points, once, and at each of the times.
fn readings(shape: &[usize], times: usize, points: usize) -> [bool; 2] {
    let numbers = |axes: &[usize]| axes.iter().fold(1, |all: usize, it| all.saturating_mul(*it));
    let are_components = |axes: &[usize]| COMPONENTS.contains(&numbers(axes));
    match *shape {
        [first, second, ref rest @ ..] => [
            first == points && are_components(&shape[1..]),
            [first, second] == [times, points] && are_components(rest),
        ],
        [first] => [first == points, false],
        [] => [false; 2],
    }
}

/// Makes the snapshots of the times that one of these arrays lists; a single snapshot if none is an array of times. Known
/// shapes of arrays of points decide between the two readings.
///
/// # Errors
/// Shapes that can be read in two ways.
pub fn by_time(
    mut times: Vec<Shaped>,
    mut arrays: Vec<Shaped>,
    known: &[Vec<usize>],
    mut snapshot: Snapshot,
    wanted: &Wanted<'_>,
) -> Result<Vec<Snapshot>, Mistake> {
    times.sort_by_key(|it| std::cmp::Reverse(it.array.values.len()));
    let points = match times.first() {
        Some(times) if known.is_empty() => {
            let all: Vec<_> = arrays.iter().map(|it| it.shape.clone()).collect();
            points(times, &all)?
        }
        Some(times) => points(times, known)?,
        None => None,
    };
    let mut times = times.into_iter();
    let axis = points.and_then(|points| Some((times.next()?.array, points)));
    for it in times {
        match it.array.values.len() {
            1 if axis.is_none() && snapshot.time.is_none() => snapshot.take(it.array),
            _ if wanted.reads(&it.array.name) => arrays.push(it),
            _ => snapshot.unread.push(it.array.name),
        }
    }
    let Some((times, points)) = axis else {
        snapshot.of_points.extend(arrays.into_iter().map(|it| it.array));
        return Ok(vec![snapshot]);
    };
    let count = times.values.len();
    let at = |&value: &f64| {
        let time = Time { value, rounding: times.stored.rounding(value) };
        Snapshot { time: Some(time), ..snapshot.clone() }
    };
    let mut found: Vec<Snapshot> = times.values.iter().map(at).collect();
    for Shaped { mut array, mut shape } in arrays {
        let [is_fixed, is_timed] = readings(&shape, count, points);
        if is_timed {
            let each = array.values.len() / count;
            array.components = shape.split_off(2).iter().product::<usize>().max(1);
            for snapshot in found.iter_mut().rev() {
                let values = array.values.split_off(array.values.len() - each);
                snapshot.of_points.push(Array { values, ..array.clone_without_values() });
            }
        } else if is_fixed {
            let more = array.values.len() * (count - 1);
            wanted.reserve(&format!("`{}` at {count} times", array.name), more)?;
            found[1..].iter_mut().for_each(|it| it.of_points.push(array.clone()));
            found[0].of_points.push(array);
        } else {
            found.iter_mut().for_each(|it| it.unread.push(array.name.clone()));
        }
    }
    Ok(found)
}

/// The number of points of these arrays at each time; `None` if they have no axis of times.
fn points(times: &Shaped, known: &[Vec<usize>]) -> Result<Option<usize>, Mistake> {
    let Shaped { array: Array { name, values, .. }, shape } = times;
    let count = values.len();
    let are_times = values.is_sorted_by(|a, b| a < b) && values.iter().all(|it| it.is_finite());
    if shape.iter().all(|it| *it != count) || !are_times {
        return Ok(None);
    }
    // A single number is no array of points.
    let known = || known.iter().filter(|it| !it.is_empty());
    let lengths: BTreeSet<usize> = known().flat_map(|it| it.iter().copied().take(2)).collect();
    let fits = |points: &usize| known().all(|it| readings(it, count, *points) != [false; 2]);
    let found: Vec<usize> = lengths.into_iter().filter(fits).collect();
    let is_plain = found.iter().any(|it| known().all(|shape| readings(shape, count, *it)[0]));
    let timed = |points: usize| known().find(|it| readings(it, count, points)[1]);
    let Some((points, shape)) = found.iter().find_map(|it| Some((*it, timed(*it)?))) else {
        return Ok(None);
    };
    if count == 1 && is_plain {
        return Ok(None);
    }
    let others = match (is_plain, points == count) {
        (true, _) => {
            let numbers: usize = shape.iter().skip(1).product();
            format!("{count} points of {numbers} numbers")
        }
        (false, true) => format!("{count} points at {points} times"),
        (false, false) if found.len() > 1 => format!("{count} times of other points"),
        _ => return Ok(Some(points)),
    };
    let shape = shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    Err(Mistake::new(format!(
        "an array of shape ({shape}) may be {count} times of {points} points, or {others}, for `{name}` has {count} \
         numbers: save one file for each time, with one number as `{name}`"
    )))
}

/// Adds the names of arrays that were not read to the snapshots of their times; the first gets names at other times, too.
pub fn tell_unread(found: &mut [Snapshot], unread: Vec<(f64, String)>) {
    let time = |it: &Snapshot| it.time.map(|time| time.value.to_bits());
    let places: HashMap<_, _> =
        found.iter().enumerate().rev().map(|(at, it)| (time(it), at)).collect();
    for (time, name) in unread {
        let at = places.get(&Some(time.to_bits())).copied().unwrap_or(0);
        if let Some(snapshot) = found.get_mut(at) {
            snapshot.unread.push(name);
        }
    }
    for snapshot in found {
        snapshot.unread.sort();
        snapshot.unread.dedup();
    }
}
