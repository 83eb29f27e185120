//! The times at which levels are compared.

use anyhow::bail;
use mms_exact::{Exact, SAME};
use mms_results::{Array, Snapshot, Stored, Time};

use super::files::Results;

/// The times at which all meshes have results, or the wanted ones; and the number of results left out.
#[derive(Default)]
pub struct Common {
    /// The times.
    pub times: Vec<f64>,
    /// The indices of each mesh's snapshots at these times.
    pub snapshots: Vec<Vec<usize>>,
    /// The number of results at other times, over all meshes.
    pub left_out: usize,
    /// Whether the field is static, so that the last result of each mesh counts.
    pub is_static: bool,
}

/// Gives snapshots without a time the times of `--time`, and finds the times that all meshes have.
///
/// # Errors
/// No time; a time outside the window; two snapshots at one time; no time that all meshes have.
pub fn common(all: &mut [Results], wanted: &[f64], exact: &Exact) -> anyhow::Result<Common> {
    if exact.input().is_static() {
        return Ok(at_rest(all, exact.window[1]));
    }
    let window = exact.window;
    for results in all.iter_mut() {
        complete(results, wanted)?;
        say(results, wanted);
        validate_roundings(results);
        validate_times(results, window)?;
    }
    if wanted.is_empty() {
        validate_ends(all, window)?;
    }
    let span = window[1] - window[0];
    let same =
        |a: Time, b: Time| (a.value - b.value).abs() <= a.rounding + b.rounding + SAME * span;
    // The nearest of the times that are equal within rounding.
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
        Common { times: Vec::new(), snapshots: vec![Vec::new(); all.len()], ..Common::default() };
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

/// Keeps the last result of each mesh, at the given time, for a static field.
fn at_rest(all: &mut [Results], value: f64) -> Common {
    let time = Time { value, rounding: 0.0 };
    let mut common = Common { times: vec![time.value], is_static: true, ..Common::default() };
    for results in all {
        common.left_out += results.snapshots.len().saturating_sub(1);
        results.keep_last();
        results.snapshots.iter_mut().for_each(|it| it.time = Some(time));
        common.snapshots.push(vec![0]);
    }
    common
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

/// Refuses results that end earlier than others by at least one of their own steps: their run stopped.
fn validate_ends(all: &[Results], [first, last]: [f64; 2]) -> anyhow::Result<()> {
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

/// Replaces a time that a file prints with fewer digits by the wanted time.
fn say(results: &mut Results, wanted: &[f64]) {
    for &value in wanted {
        let times = results.snapshots.iter_mut().filter_map(|it| it.time.as_mut());
        let is_printed = |time: &Time| {
            let (count, decimals) = digits(time.value);
            let is_shorter = count < digits(value).0;
            let rounding = if is_shorter { half_unit(decimals) } else { 0.0 };
            (time.value - value).abs() <= rounding.max(time.rounding)
        };
        let printed = times.filter(|it| is_printed(it));
        let distance = |time: &&mut Time| (time.value - value).abs();
        let nearest = printed.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.into_iter().for_each(|it| *it = Time { value, rounding: 0.0 });
    }
}

/// Treats times as exact, unless other numbers show that they were rounded: numbers of the file with no more digits than the
/// times; the times' own bits; or uneven steps that differ only in the last digit.
fn validate_roundings(results: &mut Results) {
    let times: Vec<f64> = results.snapshots.iter().filter_map(|it| Some(it.time?.value)).collect();
    let most = |of: &dyn Fn(f64) -> i32| times.iter().map(|it| of(*it)).max().unwrap_or(0);
    let (digits, decimals) = (most(&|it| digits(it).0), most(&|it| digits(it).1));
    let is_short = |array: &Array| match array.stored {
        Stored::Digits(all) => digits >= all as i32,
        Stored::Fixed(all) => decimals >= all as i32,
        Stored::Single | Stored::Double | Stored::Whole => false,
    };
    let fixed = |_: f64| half_unit(decimals);
    let scientific = |time: f64| half_unit(digits - 1 - exponent(time));
    let is_any_short = results.snapshots.iter().any(|it| {
        let points = it.points.iter().chain(&it.of_points);
        points.chain(&it.of_cells).any(is_short)
    });
    let roundings: [&dyn Fn(f64) -> f64; 2] = [&fixed, &scientific];
    let shown = roundings.into_iter().find(|rounding| is_uneven(&times, rounding));
    for time in results.snapshots.iter_mut().filter_map(|it| it.time.as_mut()) {
        let is_single = Stored::Double.at_first(&[time.value]) == Stored::Single;
        time.rounding = match shown {
            Some(rounding) => time.rounding.max(rounding(time.value)),
            None if is_any_short || is_single => time.rounding,
            None => 0.0,
        };
    }
}

/// The power of ten of the first digit of a number.
fn exponent(value: f64) -> i32 {
    value.abs().max(f64::MIN_POSITIVE).log10().floor() as i32
}

/// Half a unit of this digit after the point.
pub fn half_unit(decimals: i32) -> f64 {
    0.5 * 0.1_f64.powi(decimals)
}

/// The numbers of digits of a number: all of them, and those after the point.
pub fn digits(value: f64) -> (i32, i32) {
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).count() as i32;
    (digits, (digits - 1 - exponent.parse::<i32>().unwrap_or(0)).max(0))
}

/// Whether times differ from even spacing by about the rounding of their last digit.
fn is_uneven(times: &[f64], rounding: &dyn Fn(f64) -> f64) -> bool {
    let [first, .., last] = times else { return false };
    let (step, coarse) = ((last - first) / (times.len() - 1) as f64, rounding(*last));
    let away = |(at, time): (usize, &f64)| (time - (first + at as f64 * step)).abs();
    let farthest = times.iter().enumerate().map(away).fold(0.0, f64::max);
    let is_rounding = 0.4 * coarse < farthest && farthest < 2.1 * coarse;
    times.len() > 3 && step > 40.0 * coarse && is_rounding
}

fn validate_times(results: &Results, [first, last]: [f64; 2]) -> anyhow::Result<()> {
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

/// The file, and the line of its first point if it has lines.
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
