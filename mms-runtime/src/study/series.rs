//! The errors of one quantity on levels of refinement, and their common verdict.

use mms_convergence::{ExpectedOrder, Judgement, Sample, Sequence, observed_order};

use super::order::ObservedOrders;
use super::{Errors, StudyLevel};

/// A norm of errors.
type Norm = fn(&Errors) -> f64;

/// The norms with their names.
pub const NORMS: [(&str, Norm); 3] =
    [("l1", |errors| errors.l1), ("l2", |errors| errors.l2), ("linf", |errors| errors.linf)];

/// The errors of one quantity on one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyPoint {
    /// The refined length: h or dt.
    pub length: f64,
    /// The errors; `None` if the run stopped.
    pub errors: Option<Errors>,
    /// The part of an error due to round-off; 0 if it is unknown.
    pub floor: f64,
}

impl StudyPoint {
    /// The errors of the displacement on a level, refined in space.
    pub fn of(level: &StudyLevel) -> Self {
        let errors = level.errors.as_ref().ok().copied();
        StudyPoint { length: level.cell_size, errors, floor: 0.0 }
    }

    /// Whether the error may be entirely round-off.
    pub fn is_noise(&self) -> bool {
        self.errors.is_some_and(|errors| errors.l2 < self.floor)
    }

    /// The observed orders from a coarser point to this one; `None` if a run stopped.
    pub fn orders_from(&self, coarse: &StudyPoint) -> ObservedOrders {
        let (Some(e1), Some(e2)) = (&coarse.errors, &self.errors) else {
            return ObservedOrders::default();
        };
        let order = |norm: fn(&Errors) -> f64| {
            observed_order([norm(e1), norm(e2)], [coarse.length, self.length])
        };
        ObservedOrders { l1: order(|e| e.l1), l2: order(|e| e.l2), linf: order(|e| e.linf) }
    }
}

/// The points of a study, from coarse to fine.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    points: Vec<StudyPoint>,
}

impl Series {
    /// A series of points in any sequence.
    pub fn new(points: impl IntoIterator<Item = StudyPoint>) -> Self {
        let mut points: Vec<StudyPoint> = points.into_iter().collect();
        points.sort_by(|a, b| b.length.total_cmp(&a.length));
        Self { points }
    }

    /// The series of the displacement, refined in space.
    pub fn of(levels: &[StudyLevel]) -> Self {
        Self::new(levels.iter().map(StudyPoint::of))
    }

    /// The points, from coarse to fine.
    pub fn points(&self) -> &[StudyPoint] {
        &self.points
    }

    /// The errors of one norm.
    fn sequence(&self, norm: Norm) -> Sequence {
        Sequence::new(self.points.iter().map(|point| Sample {
            length: point.length,
            error: point.errors.as_ref().map(norm),
            is_noise: point.is_noise(),
            rounding: 0.0,
        }))
        .exact(!self.points.is_empty() && self.points.iter().all(StudyPoint::is_noise))
    }

    /// Judges every norm against an expected order; the worst decides.
    pub fn judge(&self, expected: ExpectedOrder) -> Judgement {
        let sequences = NORMS.map(|(name, norm)| (name, self.sequence(norm)));
        let norms = sequences.each_ref().map(|(name, sequence)| (*name, sequence, expected));
        Judgement::of(norms).expect("three norms")
    }

    /// The uncertainty of the order of l2 on the finest pair, as an estimate of the limit's order: the distance to the order of
    /// the pair before over r - 1, r being the ratio of lengths (Richardson's extrapolation; Roache, Verification and
    /// Validation in Computational Science and Engineering, 1998, chapter 5), plus the round-off of the finest error. `None`
    /// with fewer than three levels above round-off.
    pub fn uncertainty(&self) -> Option<f64> {
        let sound = self.points.iter().position(StudyPoint::is_noise).unwrap_or(self.points.len());
        let [.., first, second, third] = &self.points[..sound] else { return None };
        let (before, last) = (second.orders_from(first).l2?, third.orders_from(second).l2?);
        let ratio = second.length / third.length;
        let noise = third.floor / third.errors?.l2 / ratio.ln();
        Some((last - before).abs() / (ratio - 1.0) + noise)
    }

    /// C of e = C h^p, from l2 on the finest level above round-off, p being the expected order.
    pub fn error_constant(&self, expected_order: f64) -> Option<f64> {
        self.sequence(|errors| errors.l2).error_constant(expected_order)
    }
}

/// Judges the levels of a study in space, in any sequence, against an expected order: see [`Series::judge`].
pub fn judge(levels: &[StudyLevel], expected: ExpectedOrder) -> Judgement {
    Series::of(levels).judge(expected)
}

#[cfg(test)]
mod tests {
    use mms_convergence::Verdict;

    use super::*;
    use crate::failure::{Cause, Failure};

    const SECOND: ExpectedOrder = ExpectedOrder::new(2.0, 0.15);

    /// Points at h = 1, 1/2, 1/4, .. with these errors; linf is a multiple of them.
    fn series(errors: impl Fn(f64) -> f64, levels: i32, floor: f64) -> Series {
        Series::new((0..levels).map(|k| {
            let length = 0.5f64.powi(k);
            let e = errors(length);
            StudyPoint { length, errors: Some(Errors { l1: e, l2: e, linf: 2.0 * e }), floor }
        }))
    }

    /// For e = h^2 (1 + K h), the uncertainty of the finest pair's order covers the limit, and is not much larger than needed.
    #[test]
    fn the_uncertainty_covers_what_levels_are_away_from_the_limit() {
        assert!(series(|h| 3.0 * h * h, 4, 0.0).uncertainty().unwrap() < 1e-12);
        for next in [0.3, -0.3, 0.8] {
            let series = series(|h| h * h * (1.0 + next * h), 6, 0.0);
            let [.., coarse, fine] = series.points() else { panic!("six points") };
            let (order, away) =
                (fine.orders_from(coarse).l2.unwrap(), series.uncertainty().unwrap());
            let error = (order - 2.0).abs();
            assert!(error < 1.1 * away && away < 1.5 * error, "{next}: {order} {away}");
        }
    }

    fn verdict(series: &Series) -> Verdict {
        series.judge(SECOND).verdict()
    }

    #[test]
    fn a_power_law_passes_with_its_own_constant() {
        let exact = series(|h| 3.0 * h * h, 4, 0.0);
        assert!((exact.error_constant(2.0).expect("a constant") - 3.0).abs() < 1e-12);
        assert_eq!(verdict(&exact), Verdict::Pass);
        assert_eq!(verdict(&series(|h| h, 4, 0.0)), Verdict::Fail);
        assert_eq!(verdict(&series(|_| 0.0, 4, 0.0)), Verdict::NotAsymptotic);
        assert_eq!(series(|_| 0.0, 4, 0.0).error_constant(2.0), None);
    }

    /// Errors that stall where round-off dominates fail without the floor, and pass above it. A level below the floor of l2 is
    /// left out in every norm.
    #[test]
    fn what_is_below_the_floor_is_not_judged() {
        let errors = |h: f64| (h * h).max(1e-3);
        assert_ne!(verdict(&series(errors, 7, 0.0)), Verdict::Pass);
        let known = series(errors, 7, 1.1e-3);
        assert!(known.points()[5].is_noise() && !known.points()[4].is_noise());
        assert_eq!(verdict(&known), Verdict::Pass);
        assert_eq!(verdict(&series(errors, 7, 2.0)), Verdict::Exact);
    }

    #[test]
    fn a_run_that_stopped_fails_above_and_below_the_floor() {
        let mut points = series(|h| h * h, 4, 0.0).points;
        points[1].errors = None;
        assert_eq!(verdict(&Series::new(points)), Verdict::Fail);
    }

    #[test]
    fn levels_are_judged_in_any_sequence_and_those_that_stopped_fail() {
        let level = |k: i32| {
            let cell_size = 0.5f64.powi(k);
            let e = cell_size * cell_size;
            StudyLevel {
                cells: (8 << k).into(),
                cell_size,
                time_step: 0.1,
                steps: 10,
                particles: 16,
                errors: Ok(Errors { l1: e, l2: e, linf: e }),
                seconds: 0.0,
            }
        };
        let mut levels = [2, 0, 1].map(level);
        assert_eq!(judge(&levels, SECOND).verdict(), Verdict::Pass);
        levels[1].errors = Err(Failure {
            step: 3,
            time: 0.1,
            particle: Some(2),
            reference_position: vec![0.5],
            cause: Cause::Inverted { jacobian: -1.0 },
        });
        assert_eq!(judge(&levels, SECOND).verdict(), Verdict::Fail);
    }
}
