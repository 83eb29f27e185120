//! The errors of one quantity on levels of refinement, and what they say together.

use super::order::{Orders, observed_order};
use super::verdict::{Judgement, Verdict};
use super::{Errors, Level};

/// The errors of one quantity on one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// What is refined: h or dt.
    pub length: f64,
    /// The errors; none of a run that stopped.
    pub errors: Option<Errors>,
    /// What round-off alone leaves of an error; 0 where that is not known.
    pub floor: f64,
}

impl Point {
    /// Of the displacement on a level, refined in space.
    pub fn of(level: &Level) -> Self {
        let errors = level.errors.as_ref().ok().copied();
        Point { length: level.cell_size, errors, floor: 0.0 }
    }

    /// Whether its error may be nothing but round-off.
    pub fn is_noise(&self) -> bool {
        self.errors.is_some_and(|errors| errors.l2 < self.floor)
    }

    /// The observed orders from a coarser point to this; none if a run stopped.
    pub fn orders_from(&self, coarse: &Point) -> Orders {
        let (Some(e1), Some(e2)) = (&coarse.errors, &self.errors) else {
            return Orders::default();
        };
        let order = |norm: fn(&Errors) -> f64| {
            observed_order([norm(e1), norm(e2)], [coarse.length, self.length])
        };
        Orders { l1: order(|e| e.l1), l2: order(|e| e.l2), linf: order(|e| e.linf) }
    }
}

/// The order that a verdict rests on, where that is no `pass`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reason {
    /// `l2` or `linf`.
    pub norm: &'static str,
    /// The order that is not as expected, or has not settled; `None`, where there is none.
    pub order: Option<f64>,
    /// The positions of its levels among the [points](Series::points): the coarser one, the finer one.
    pub levels: [usize; 2],
}

/// The points of a study, from coarse to fine.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    points: Vec<Point>,
}

impl Series {
    /// Of points in any sequence.
    pub fn new(points: impl IntoIterator<Item = Point>) -> Self {
        let mut points: Vec<Point> = points.into_iter().collect();
        points.sort_by(|a, b| b.length.total_cmp(&a.length));
        Self { points }
    }

    /// Of the displacement, refined in space.
    pub fn of(levels: &[Level]) -> Self {
        Self::new(levels.iter().map(Point::of))
    }

    /// The points, from coarse to fine.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Those before the first that may be nothing but round-off.
    fn sound(&self) -> &[Point] {
        let sound = self.points.iter().take_while(|point| !point.is_noise()).count();
        &self.points[..sound]
    }

    /// Judges against an expected order; the first that holds:
    ///
    /// * `fail`: a run stopped; or l2 or linf is below `expected_order - tolerance` between the two finest
    ///   levels.
    /// * `not asymptotic`: fewer than two levels; no order (an error of exactly zero, equal lengths); l2 above
    ///   `expected_order + tolerance`; with three levels or more, the order of l2 differs from that of the pair
    ///   before by more than `tolerance`.
    /// * `pass`.
    ///
    /// Levels are those before the first whose error may be nothing but round-off.
    pub fn judge(&self, expected_order: f64, tolerance: f64) -> Judgement {
        let (verdict, _) = self.decide(expected_order, tolerance);
        Judgement { observed_order: self.pair(0).and_then(|(orders, _)| orders.l2), verdict }
    }

    /// What orders led to a verdict that is no `pass`; nothing, where none did.
    pub fn reason(&self, expected_order: f64, tolerance: f64) -> Option<Reason> {
        self.decide(expected_order, tolerance).1
    }

    /// The orders between two neighbouring levels, and the positions of these; 0 is the finest pair.
    fn pair(&self, before_finest: usize) -> Option<(Orders, [usize; 2])> {
        let sound = self.sound();
        let fine = sound.len().checked_sub(before_finest + 1)?;
        let coarse = fine.checked_sub(1)?;
        Some((sound[fine].orders_from(&sound[coarse]), [coarse, fine]))
    }

    fn decide(&self, expected_order: f64, tolerance: f64) -> (Verdict, Option<Reason>) {
        let stopped = self.points.iter().any(|point| point.errors.is_none());
        let (finest, levels) = match self.pair(0) {
            _ if stopped => return (Verdict::Fail, None),
            None => return (Verdict::NotAsymptotic, None),
            Some(pair) => pair,
        };
        let of = |norm, order| Some(Reason { norm, order, levels });
        let too_low = |order: Option<f64>| order.is_some_and(|it| it < expected_order - tolerance);
        let too_high = |order: f64| order > expected_order + tolerance;
        let unsettled = |order: f64, earlier: Orders| {
            !earlier.l2.is_some_and(|earlier| (order - earlier).abs() <= tolerance)
        };
        match (finest.l2, self.pair(1)) {
            (l2, _) if too_low(l2) => (Verdict::Fail, of("l2", l2)),
            _ if too_low(finest.linf) => (Verdict::Fail, of("linf", finest.linf)),
            _ if finest.linf.is_none() => (Verdict::NotAsymptotic, of("linf", None)),
            (None, _) => (Verdict::NotAsymptotic, of("l2", None)),
            (Some(l2), _) if too_high(l2) => (Verdict::NotAsymptotic, of("l2", Some(l2))),
            (Some(l2), Some((earlier, levels))) if unsettled(l2, earlier) => {
                let (norm, order) = ("l2", earlier.l2);
                (Verdict::NotAsymptotic, Some(Reason { norm, order, levels }))
            }
            _ => (Verdict::Pass, None),
        }
    }

    /// How far the observed order of l2 may be from that of the limit: with e = C h^p (1 + K h + ..) orders
    /// approach p as h does, so that Richardson's extrapolation moves the finest of them by its distance to the
    /// one before over r - 1, r being the ratio of lengths (Roache, Verification and Validation in
    /// Computational Science and Engineering, 1998, chapter 5). Round-off of the finest error comes on top.
    /// `None` with fewer than three levels.
    pub fn uncertainty(&self) -> Option<f64> {
        let [.., first, second, third] = self.sound() else { return None };
        let (before, last) = (second.orders_from(first).l2?, third.orders_from(second).l2?);
        let ratio = second.length / third.length;
        let noise = third.floor / third.errors?.l2 / ratio.ln();
        Some((last - before).abs() / (ratio - 1.0) + noise)
    }

    /// C of e = C h^p, from l2 on the finest level, p being the expected order.
    pub fn error_constant(&self, expected_order: f64) -> Option<f64> {
        let finest = self.sound().last()?;
        let constant = finest.errors?.l2 / finest.length.powf(expected_order);
        (constant > 0.0 && constant.is_finite()).then_some(constant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points at h = 1, 1/2, 1/4, .. with these errors, the same in all norms.
    fn series(errors: impl Fn(f64) -> f64, levels: i32, floor: f64) -> Series {
        Series::new((0..levels).map(|k| {
            let length = 0.5f64.powi(k);
            let e = errors(length);
            Point { length, errors: Some(Errors { l1: e, l2: e, linf: e }), floor }
        }))
    }

    #[test]
    fn a_power_law_has_no_uncertainty_and_its_own_constant() {
        let exact = series(|h| 3.0 * h * h, 4, 0.0);
        assert!(exact.uncertainty().unwrap() < 1e-12);
        assert!((exact.error_constant(2.0).unwrap() - 3.0).abs() < 1e-12);
        assert_eq!(exact.judge(2.0, 0.15).verdict, Verdict::Pass);
    }

    /// e = h^2 (1 + K h): the limit lies within the uncertainty of what is observed, by not much.
    #[test]
    fn the_uncertainty_covers_what_levels_are_away_from_the_limit() {
        for next in [0.3, -0.3, 0.8] {
            let series = series(|h| h * h * (1.0 + next * h), 6, 0.0);
            let (order, away) =
                (series.judge(2.0, 0.5).observed_order.unwrap(), series.uncertainty().unwrap());
            let error = (order - 2.0).abs();
            assert!(error < 1.1 * away && away < 1.5 * error, "{next}: {order} {away}");
        }
    }

    /// Errors of l2 and of linf.
    fn two_norms(errors: &[[f64; 2]]) -> Series {
        Series::new(errors.iter().enumerate().map(|(k, &[l2, linf])| Point {
            length: 0.5f64.powi(k as i32),
            errors: Some(Errors { l1: l2, l2, linf }),
            floor: 0.0,
        }))
    }

    #[test]
    fn the_norm_and_the_levels_that_decide_are_named() {
        let reason = |errors: &[[f64; 2]]| {
            let series = two_norms(errors);
            let reason = series.reason(2.0, 0.15);
            let named = reason.map(|it| (it.norm, it.order.map(f64::round), it.levels));
            (series.judge(2.0, 0.15).verdict, named)
        };
        let (fail, not) = (Verdict::Fail, Verdict::NotAsymptotic);
        assert_eq!(reason(&[[16.0; 2], [4.0; 2], [1.0; 2]]), (Verdict::Pass, None));
        assert_eq!(
            reason(&[[16.0; 2], [4.0; 2], [2.0; 2]]),
            (fail, Some(("l2", Some(1.0), [1, 2])))
        );
        let of_largest = [[16.0, 16.0], [4.0, 4.0], [1.0, 2.0]];
        assert_eq!(reason(&of_largest), (fail, Some(("linf", Some(1.0), [1, 2]))));
        assert_eq!(
            reason(&[[32.0; 2], [4.0; 2], [1.0; 2]]),
            (not, Some(("l2", Some(3.0), [0, 1])))
        );
        assert_eq!(
            reason(&[[16.0; 2], [8.0; 2], [1.0; 2]]),
            (not, Some(("l2", Some(3.0), [1, 2])))
        );
        assert_eq!(reason(&[[4.0, 0.0], [1.0, 0.0]]), (not, Some(("linf", None, [0, 1]))));
        assert_eq!(reason(&[[1.0; 2]]), (not, None));
    }

    #[test]
    fn two_levels_have_no_uncertainty() {
        assert_eq!(series(|h| h, 2, 0.0).uncertainty(), None);
        assert_eq!(series(|_| 0.0, 4, 0.0).uncertainty(), None);
    }

    /// Errors that stall where round-off takes over fail without the floor, and pass above it.
    #[test]
    fn what_is_below_the_floor_is_not_judged() {
        let errors = |h: f64| (h * h).max(1e-3);
        assert_eq!(series(errors, 7, 0.0).judge(2.0, 0.15).verdict, Verdict::Fail);
        let known = series(errors, 7, 1.1e-3);
        assert!(known.points()[5].is_noise() && !known.points()[4].is_noise());
        assert_eq!(known.judge(2.0, 0.15).verdict, Verdict::Pass);
        assert_eq!(known.judge(1.0, 0.15).verdict, Verdict::NotAsymptotic);
        assert_eq!(series(errors, 7, 2.0).judge(2.0, 0.15).verdict, Verdict::NotAsymptotic);
    }

    #[test]
    fn a_run_that_stopped_fails_above_and_below_the_floor() {
        let mut points = series(|h| h * h, 4, 0.0).points;
        points[1].errors = None;
        assert_eq!(Series::new(points).judge(2.0, 0.15).verdict, Verdict::Fail);
    }
}
