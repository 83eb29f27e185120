//! Reading of any bytes, for the tests with broken files.

use mms_results::motion::resolve;
use mms_results::names::{KNOWN, Role, everything, recognise, wanted};
use mms_results::{Contents, parse};

/// The distance of a point from the unit square.
pub fn outside(point: &[f64]) -> f64 {
    point.iter().map(|x| f64::max(-x, x - 1.0).max(0.0)).fold(0.0, f64::max)
}

/// Checks that reading any bytes ends, with results or with a mistake, and so does using the results.
pub fn survive(bytes: &[u8]) {
    let u = |role: Role| role == Role::Displacement;
    let ways = [everything(&KNOWN), wanted(&KNOWN, &u), everything(&KNOWN).within(1 << 12, "")];
    let mut all = ways.iter().filter_map(|wanted| parse(bytes, wanted).ok());
    while let Some(Contents::Snapshots(found)) = all.next() {
        for snapshot in found {
            let Ok(meanings) = recognise(&snapshot, &KNOWN, &|_| true) else { continue };
            for dimension in 1..=3 {
                let mut half = |x: &[f64], _: f64| Ok(Some(x.iter().map(|x| x / 2.0).collect()));
                let _ = resolve(&snapshot, &meanings, dimension, &outside, None);
                let _ = resolve(&snapshot, &meanings, dimension, &outside, Some(&mut half));
                for meaning in &meanings {
                    let _ = meaning.values(&snapshot, dimension);
                }
            }
        }
    }
}
