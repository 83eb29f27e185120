//! What a study's observed orders say about the method.

use std::fmt;

use super::{Level, Series};

/// How far an observed order may be from the expected one.
pub const TOLERANCE: f64 = 0.15;

/// How far an error constant may be from the expected one, relative to it: runs are the same on every machine but for
/// rounding, and what levels lose by not being asymptotic is the same as well.
pub const CONSTANT_TOLERANCE: f64 = 0.01;

/// The outcome of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The finest levels show the expected order.
    Pass,
    /// They show a lower one or another error constant, or a run stopped.
    Fail,
    /// They show no settled order, or a higher one.
    NotAsymptotic,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::NotAsymptotic => "not asymptotic",
        })
    }
}

/// A study's outcome and the order it rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// The order of l2 between the two finest levels, if there is one.
    pub observed_order: Option<f64>,
    /// The outcome.
    pub verdict: Verdict,
}

impl Judgement {
    /// Holds the error constant of a study to the one that is expected too: a defect may leave the order and change
    /// the constant. What is not [near](is_near) it is a `fail`.
    #[must_use]
    pub fn with_constant(self, found: Option<f64>, expected: f64) -> Self {
        match found {
            Some(found) if is_near(found, expected) => self,
            _ => Self { verdict: Verdict::Fail, ..self },
        }
    }
}

/// Whether an error constant is the expected one, to within [`CONSTANT_TOLERANCE`].
pub fn is_near(constant: f64, expected: f64) -> bool {
    (constant / expected - 1.0).abs() <= CONSTANT_TOLERANCE
}

/// Judges the levels of a study in space, in any sequence, against the expected order: see
/// [`Series::judge`].
pub fn judge(levels: &[Level], expected_order: f64, tolerance: f64) -> Judgement {
    Series::of(levels).judge(expected_order, tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cause, Errors, Failure};

    /// Levels with 8, 16, ... cells and these errors, the same in all norms.
    fn levels(errors: &[f64]) -> Vec<Level> {
        let level = |(k, &e): (usize, &f64)| Level {
            cells: (8 << k).into(),
            cell_size: 1.0 / (8 << k) as f64,
            time_step: 0.1,
            steps: 10,
            particles: 16,
            errors: Ok(Errors { l1: e, l2: e, linf: e }),
            seconds: 0.0,
        };
        errors.iter().enumerate().map(level).collect()
    }

    fn verdict(errors: &[f64]) -> Verdict {
        judge(&levels(errors), 2.0, TOLERANCE).verdict
    }

    #[test]
    fn each_verdict() {
        assert_eq!(verdict(&[16.0, 4.0, 1.0]), Verdict::Pass);
        assert_eq!(verdict(&[4.0, 1.0]), Verdict::Pass);
        assert_eq!(verdict(&[4.0, 2.0, 1.0]), Verdict::Fail);
        assert_eq!(verdict(&[1.0, 4.0, 16.0]), Verdict::Fail);
        assert_eq!(verdict(&[4.0 * 8.0, 4.0, 1.0]), Verdict::NotAsymptotic);
        assert_eq!(verdict(&[64.0, 8.0, 1.0]), Verdict::NotAsymptotic);
        assert_eq!(verdict(&[1.0]), Verdict::NotAsymptotic);
        assert_eq!(verdict(&[]), Verdict::NotAsymptotic);
    }

    #[test]
    fn an_exactly_represented_field_proves_nothing() {
        assert_eq!(verdict(&[0.0, 0.0, 0.0]), Verdict::NotAsymptotic);
        assert_eq!(verdict(&[4.0, 1.0, 0.0]), Verdict::NotAsymptotic);
        assert_eq!(judge(&levels(&[0.0, 0.0]), 2.0, TOLERANCE).observed_order, None);
    }

    #[test]
    fn the_largest_error_counts_too() {
        let mut levels = levels(&[16.0, 4.0, 1.0]);
        levels[2].errors = Ok(Errors { l1: 1.0, l2: 1.0, linf: 2.0 });
        let judgement = judge(&levels, 2.0, TOLERANCE);
        assert_eq!(judgement, Judgement { observed_order: Some(2.0), verdict: Verdict::Fail });
    }

    /// The order alone lets a defect pass that changes the constant.
    #[test]
    fn another_constant_fails_what_has_the_order() {
        let judged = judge(&levels(&[16.0, 4.0, 1.0]), 2.0, TOLERANCE);
        let with = |found, expected| judged.with_constant(found, expected).verdict;
        assert_eq!(with(Some(0.5411), 0.541), Verdict::Pass);
        for found in [Some(0.6), Some(0.5), Some(f64::NAN), None] {
            assert_eq!(with(found, 0.541), Verdict::Fail, "{found:?}");
        }
        // A constant that is right redeems no order.
        let low = judge(&levels(&[4.0, 2.0, 1.0]), 2.0, TOLERANCE);
        assert_eq!(low.with_constant(Some(0.541), 0.541), low);
    }

    #[test]
    fn a_stopped_level_fails_the_study() {
        let mut levels = levels(&[16.0, 4.0, 1.0]);
        levels[0].errors = Err(Failure {
            step: 3,
            time: 0.1,
            particle: Some(2),
            reference_position: vec![0.5],
            cause: Cause::Inverted { jacobian: -1.0 },
        });
        assert_eq!(judge(&levels, 2.0, TOLERANCE).verdict, Verdict::Fail);
    }

    #[test]
    fn the_sequence_of_levels_does_not_matter() {
        let mut levels = levels(&[16.0, 4.0, 1.0]);
        levels.reverse();
        assert_eq!(judge(&levels, 2.0, TOLERANCE).verdict, Verdict::Pass);
    }
}
