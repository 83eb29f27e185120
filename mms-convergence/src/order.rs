//! The observed order of a few levels, and its interval.

use crate::OUTSIDE;
use crate::least::{Solution, solve};
use crate::sequence::SequenceLevel;
use crate::student::tail_of_ratio;

/// An order, and its interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The best guess.
    pub order: f64,
    /// The interval of the order; `None` for two levels whose errors were not rounded.
    pub interval: Option<[f64; 2]>,
    /// The basis of the interval.
    pub basis: Basis,
}

/// The data that the interval of an order is computed from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The scatter of levels, or of replicates, about a power law: 95 % by Student's t.
    Scatter,
    /// The drift between two pairs of levels, which have no scatter.
    Drift,
    /// The printed digits of two errors.
    Digits,
    /// No data: two levels have an order, and no second one to compare it with.
    Nothing,
}

/// The factor by which orders may drift more than by Richardson's extrapolation (Roache 1998; Eca & Hoekstra 2014).
const SAFETY: f64 = 1.25;

impl Estimate {
    /// The order of two levels or more, whose errors are positive. The half width of an interval is at least `resolution`.
    pub(crate) fn of(levels: &[SequenceLevel], resolution: f64) -> Option<Self> {
        let first = *pairs(levels)?.last()?;
        let (order, reach, basis) = match levels {
            [coarse, fine] => return Some(Self::of_two(first, coarse, fine)),
            _ => match scatter(levels) {
                Some((order, reach)) => (order, [order - reach, order + reach], Basis::Scatter),
                None => (first, drift(levels)?, Basis::Drift),
            },
        };
        let interval = [reach[0].min(order - resolution), reach[1].max(order + resolution)];
        Some(Self { order, interval: Some(interval), basis })
    }

    fn of_two(order: f64, coarse: &SequenceLevel, fine: &SequenceLevel) -> Self {
        let digits = coarse.rounding + fine.rounding;
        if digits == 0.0 {
            return Self { order, interval: None, basis: Basis::Nothing };
        }
        let reach = digits / (coarse.length / fine.length).ln();
        Self { order, interval: Some([order - reach, order + reach]), basis: Basis::Digits }
    }

    /// Whether an order lies in the interval.
    pub fn holds(&self, order: f64) -> bool {
        self.interval.is_some_and(|[low, high]| (low..=high).contains(&order))
    }

    /// Half the width of the interval; infinite if there is none.
    pub fn reach(&self) -> f64 {
        self.interval.map_or(f64::INFINITY, |[low, high]| (high - low) / 2.0)
    }
}

/// The orders between neighbours; `None` if a pair has none.
pub(crate) fn pairs(levels: &[SequenceLevel]) -> Option<Vec<f64>> {
    levels.windows(2).map(|pair| pair[1].order_from(&pair[0])).collect()
}

/// The interval of three levels: the two orders, and the possible further drift of the second if orders approach their limit as
/// h does.
fn drift(levels: &[SequenceLevel]) -> Option<[f64; 2]> {
    let [first, second] = pairs(levels)?[..] else { return None };
    let ratio = levels[1].length / levels[2].length;
    let further = second + SAFETY * (second - first) / (ratio - 1.0);
    Some([first.min(second).min(further), first.max(second).max(further)])
}

/// Fits ln e = ln C + p ln h by least squares, and returns p and half its interval. With replicates the scatter combines
/// replicates and levels, unless levels scatter more than replicates do (lack of fit, by Fisher's F; Draper & Smith, Applied
/// Regression Analysis, 1998, section 2.1). `None` for three levels, unless the scatter of replicates is used.
fn scatter(levels: &[SequenceLevel]) -> Option<(f64, f64)> {
    let all = levels.iter().flat_map(|level| level.errors.iter().map(|e| [level.length, *e]));
    let of_all = power_law(all)?;
    let within: f64 = levels
        .iter()
        .flat_map(|level| level.errors.iter().map(|e| (e / level.error()).ln().powi(2)))
        .sum();
    let runs: usize = levels.iter().map(|level| level.errors.len()).sum();
    let (replicates, between) = (runs - levels.len(), levels.len() - 2);
    let is_pooled = replicates > 0 && {
        let lack = (of_all.left - within).max(0.0) / between as f64;
        tail_of_ratio(lack / (within / replicates as f64), [between, replicates]) > OUTSIDE
    };
    let of_levels = || power_law(means(levels)).filter(|_| levels.len() > 3);
    let found = if is_pooled { Some(of_all) } else { of_levels() }?;
    Some((found.unknowns[1], found.reach(1, OUTSIDE)))
}

fn means(levels: &[SequenceLevel]) -> impl Iterator<Item = [f64; 2]> {
    levels.iter().map(|level| [level.length, level.error()])
}

/// Fits a straight line through logarithms: ln C at the first length, and p.
fn power_law(points: impl Iterator<Item = [f64; 2]>) -> Option<Solution<2>> {
    let points: Vec<_> = points.map(|point| point.map(f64::ln)).collect();
    let first = points.first()?[0];
    solve(&points.iter().map(|[h, e]| ([1.0, h - first], *e)).collect::<Vec<_>>())
}

/// The power law with a free order that is nearest to the means of levels.
pub(crate) struct Line {
    pub order: f64,
    /// The remaining sum of squares of logarithms.
    pub left: f64,
    /// The root mean square of the residuals.
    pub scatter: f64,
}

impl Line {
    /// Fits three levels or more.
    pub fn through(levels: &[SequenceLevel]) -> Option<Self> {
        let found = power_law(means(levels))?;
        let scatter = (found.left / levels.len().checked_sub(2)? as f64).sqrt();
        Some(Self { order: found.unknowns[1], left: found.left, scatter })
    }
}
