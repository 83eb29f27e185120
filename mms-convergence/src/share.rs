//! The share of a term of lower order in the finest error: e = C h^p + D h^q + E h^(p+1) with q < p.

use crate::least::solve;
use crate::sequence::SequenceLevel;

/// The relative scatter of the errors of correct methods. It has the weight of one more level.
const USUAL_SCATTER: f64 = 0.025;

/// Half the interval of a share, in standard deviations. With the usual tolerance, 95 % of correct methods pass on five levels
/// that scatter by 3 %, and 6 % of methods with a fifth of the finest error of first order.
const REACH: f64 = 0.75;

/// The largest part of the term h^(p+1) in the coarsest error, relative to the others, on levels that are asymptotic.
const ASYMPTOTIC: f64 = 0.5;

/// The share of a term of lower order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// q.
    pub order: f64,
    /// D h^q over the error on the finest level; negative if it reduces the error.
    pub share: f64,
    /// Half the interval of the share.
    pub reach: f64,
    /// The order of all three terms together on the finest level.
    pub total_order: f64,
    /// Whether printed digits are more uncertain than the scatter.
    pub is_rounded: bool,
    /// Whether the term h^(p+1) is more than half of the two others on the coarsest level.
    pub is_coarse: bool,
}

/// The order of the term below the term of order p.
pub(crate) fn lower(p: f64) -> f64 {
    if p > 0.0 { (p - 1.0).max(0.0) } else { p - 1.0 }
}

/// The scatter due to printed digits, whose error is uniform; relative to the errors.
pub(crate) fn rounding(levels: &[SequenceLevel]) -> f64 {
    let sum: f64 = levels.iter().map(|level| level.rounding.powi(2) / 3.0).sum();
    (sum / levels.len() as f64).sqrt()
}

impl Share {
    /// The interval of the share.
    pub fn interval(&self) -> [f64; 2] {
        [self.share - self.reach, self.share + self.reach]
    }

    /// The interval by which the term lowers the order on the finest level below p.
    pub fn lowers(&self, p: f64) -> [f64; 2] {
        self.interval().map(|share| (p - self.order) * share)
    }

    /// Fits three levels or more, each error relative to itself; `None` if they do not determine the terms.
    ///
    /// The scatter combines the scatter about the fit, one level of the usual scatter, and printed digits.
    pub(crate) fn of(levels: &[SequenceLevel], p: f64, q: f64) -> Option<Self> {
        let (coarsest, finest) = (levels.first()?, levels.last()?);
        let row = |level: &SequenceLevel| {
            let (x, e) = (level.length / finest.length, level.error() / finest.error());
            let [main, low, high] = [p, q, p + 1.0].map(|power| x.powf(power) / e);
            // The first unknown is the sum of the terms on the finest level, so that the others relative to it are shares.
            ([main, low - main, high - main], 1.0)
        };
        let found = solve(&levels.iter().map(row).collect::<Vec<_>>())?;
        let [total, low, high] = found.unknowns;
        let (share, higher) = (low / total, high / total);
        let scatter = (USUAL_SCATTER.powi(2) + found.left) / (levels.len() - 2) as f64;
        let digits = rounding(levels).powi(2);
        let deviation = |which| found.deviation(which, scatter + digits) / total;
        let reach = REACH * deviation(1);
        let x = coarsest.length / finest.length;
        let others = (1.0 - share - higher).abs() * x.powf(p) + share.abs() * x.powf(q);
        let least = (higher.abs() - 2.0 * deviation(2)) * x.powf(p + 1.0);
        let is_coarse = least > ASYMPTOTIC * others;
        let total_order = p - (p - q) * share + higher;
        let is_rounded = digits > scatter;
        let found = Self { order: q, share, reach, total_order, is_rounded, is_coarse };
        (total > 0.0 && reach.is_finite()).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sequence::{Sample, Sequence};

    #[test]
    fn the_order_below_is_a_plateau_at_least_of_errors_that_fall() {
        let orders = [3.0, 2.0, 1.0, 0.5, 0.0, -1.0].map(lower);
        assert_eq!(orders, [2.0, 1.0, 0.0, 0.0, -1.0, -2.0]);
    }

    /// The share of first order in errors of a law, on levels refined by 2.
    fn of(count: i32, law: impl Fn(f64) -> f64) -> Share {
        let sample = |k: i32| Sample::new(2f64.powi(k) * 1e-2, law(2f64.powi(k)));
        let levels = Sequence::new((0..count).map(sample));
        Share::of(levels.levels(), 2.0, 1.0).expect("a fit")
    }

    /// Against the inverse of the normal equations, by NumPy.
    #[test]
    fn the_usual_scatter_makes_a_share_uncertain() {
        for (count, reach) in [(4, 0.036825698574117), (5, 0.021617292382294)] {
            let found = of(count, |x| x * x);
            assert!(found.share.abs() < 1e-12 && (found.reach - reach).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn levels_are_coarse_where_the_third_term_is_more_than_half_of_the_others() {
        assert!(of(4, |x| x * x + 0.2 * x.powi(3)).is_coarse);
        assert!(!of(4, |x| x * x + 0.03 * x.powi(3)).is_coarse);
        // The term of first order counts among the others: 120 is less than half of 64 + 200.
        assert!(of(4, |x| x * x + 0.234 * x.powi(3)).is_coarse);
        assert!(!of(4, |x| 25.0 * x + x * x + 0.234 * x.powi(3)).is_coarse);
    }

    /// Errors that are uniform within half a digit have a third of its square as their variance.
    #[test]
    fn rounding_scatters_as_uniform_errors_do() {
        let sample = |(length, rounding)| Sample { rounding, ..Sample::new(length, 1.0) };
        let found = rounding(Sequence::new([(2.0, 0.03), (1.0, 0.06)].map(sample)).levels());
        assert!((found - ((0.0009f64 + 0.0036) / 6.0).sqrt()).abs() < 1e-15, "{found}");
    }
}
