//! At which times levels are compared.

use anyhow::bail;
use mms_results::{Snapshot, Time};

use super::files::Results;
use crate::session::exact::SAME;

/// Times at which all meshes have results, or those that are wanted; and how many each has that are left out.
pub struct Common {
    /// The times.
    pub times: Vec<f64>,
    /// The snapshots of each mesh at them, by position.
    pub snapshots: Vec<Vec<usize>>,
    /// How many times no other mesh has, over all of them.
    pub left_out: usize,
}

/// Gives snapshots without a time those of `--time`, and finds the times that all have.
///
/// # Errors
/// No time; a time outside the window; two snapshots at one time; no time that all have.
pub fn common(all: &mut [Results], wanted: &[f64], window: [f64; 2]) -> anyhow::Result<Common> {
    for results in all.iter_mut() {
        complete(results, wanted)?;
        hold_times(results, window)?;
    }
    if wanted.is_empty() {
        hold_ends(all, window)?;
    }
    let span = window[1] - window[0];
    let same =
        |a: Time, b: Time| (a.value - b.value).abs() <= a.rounding + b.rounding + SAME * span;
    // Of those that rounding lets be the same, the nearest.
    let at = |results: &Results, time: Time| {
        let times =
            results.snapshots.iter().enumerate().filter_map(|(at, it)| Some((at, it.time?)));
        let distance = |other: Time| (time.value - other.value).abs();
        let near = times.filter(|(_, other)| same(time, *other));
        near.min_by(|(_, a), (_, b)| distance(*a).total_cmp(&distance(*b))).map(|(at, _)| at)
    };
    let first = all[0].snapshots.iter().filter_map(|snapshot| snapshot.time);
    let is_wanted = |time: &Time| {
        wanted.is_empty() || wanted.iter().any(|&value| same(*time, Time { value, rounding: 0.0 }))
    };
    let mut common =
        Common { times: Vec::new(), snapshots: vec![Vec::new(); all.len()], left_out: 0 };
    for time in first.filter(is_wanted) {
        let positions: Option<Vec<usize>> = all.iter().map(|results| at(results, time)).collect();
        let is_taken = |positions: &Vec<usize>| {
            common.snapshots.iter().zip(positions).any(|(taken, position)| taken.contains(position))
        };
        let Some(positions) = positions.filter(|it| !is_taken(it)) else { continue };
        common.times.push(time.value);
        common.snapshots.iter_mut().zip(positions).for_each(|(to, position)| to.push(position));
    }
    if common.times.is_empty() {
        bail!("no time at which all files have results: {}", listed(all));
    }
    let found: usize = all.iter().map(|it| it.snapshots.len()).sum();
    common.left_out = found - all.len() * common.times.len();
    Ok(common)
}

fn complete(results: &mut Results, wanted: &[f64]) -> anyhow::Result<()> {
    let without = results.snapshots.iter().filter(|it| it.time.is_none()).count();
    if without == 0 {
        return Ok(());
    }
    if without != results.snapshots.len() || without != wanted.len() {
        bail!(
            "`{}`: {without} of its {} results have no time; give it in the file (a column `time`, TimeValue, a .pvd), \
             or as many with `--time T,..`, in the order of the files",
            results.name,
            results.snapshots.len()
        );
    }
    for (snapshot, &value) in results.snapshots.iter_mut().zip(wanted) {
        snapshot.time = Some(Time { value, rounding: 0.0 });
    }
    Ok(())
}

/// Refuses results that end before others do, where one step more of their own would not go beyond these: their run stopped.
fn hold_ends(all: &[Results], [first, last]: [f64; 2]) -> anyhow::Result<()> {
    let times = |results: &Results| -> Vec<Time> {
        results.snapshots.iter().filter_map(|it| it.time).collect()
    };
    let end = |results: &Results| times(results).pop().map(|time| (time, results.name.clone()));
    let Some((latest, other)) =
        all.iter().filter_map(end).max_by(|(a, _), (b, _)| a.value.total_cmp(&b.value))
    else {
        return Ok(());
    };
    for results in all {
        let times = times(results);
        let (step, time) = match times.as_slice() {
            [] => continue,
            [only] => (0.0, *only),
            [.., before, time] => (time.value - before.value, *time),
        };
        let most = time.rounding + latest.rounding + SAME * (last - first);
        let missing = latest.value - time.value;
        if missing > most && missing >= step - most {
            bail!(
                "`{}`: its results end at t = {:?}, and those of `{other}` at t = {:?}: did the run stop? Results of times \
                 that all have are judged with `--time T,..`",
                results.name,
                time.value,
                latest.value
            );
        }
    }
    Ok(())
}

fn hold_times(results: &Results, [first, last]: [f64; 2]) -> anyhow::Result<()> {
    let mut before: Option<(&Snapshot, f64)> = None;
    for (snapshot, time) in results.snapshots.iter().filter_map(|it| Some((it, it.time?))) {
        let Time { value, rounding } = time;
        let most = rounding + SAME * (last - first);
        if !value.is_finite() || value < first - most || value > last + most {
            bail!(
                "{}: t = {value} is outside the time window of the field, {first} to {last}",
                place(snapshot)
            );
        }
        if let Some((other, _)) = before.filter(|(_, earlier)| *earlier == value) {
            bail!(
                "{}: another result at t = {value}: {}; name one of them",
                place(snapshot),
                place(other)
            );
        }
        before = Some((snapshot, value));
    }
    Ok(())
}

/// The file, and the line of its first point where it has lines.
fn place(snapshot: &Snapshot) -> String {
    match snapshot.lines.first() {
        Some(_) => snapshot.place(0),
        None => snapshot.path.clone(),
    }
}

fn listed(all: &[Results]) -> String {
    let of = |results: &Results| {
        let times: Vec<_> = results.snapshots.iter().filter_map(|it| it.time).collect();
        let range = match times.as_slice() {
            [] => String::new(),
            [only] => format!("t = {}", only.value),
            [first, .., last] => {
                format!("{} times, {} to {}", times.len(), first.value, last.value)
            }
        };
        format!("`{}` has {range}", results.name)
    };
    all.iter().map(of).collect::<Vec<_>>().join(", ")
}
