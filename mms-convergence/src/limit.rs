//! The error in the limit of fine levels: e = e0 + C h^p with unknown p.

use crate::OUTSIDE;
use crate::least::{Solution, solve};
use crate::sequence::SequenceLevel;

/// The error in the limit of fine levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// e0.
    pub error: f64,
    /// The interval of e0.
    pub interval: [f64; 2],
    /// p.
    pub order: f64,
    /// e0 over the error on the finest level.
    pub share: f64,
}

impl Limit {
    /// Whether the limit is clearly not 0: the half width of the interval is at most a fifth of the error.
    pub(crate) fn is_plain(&self) -> bool {
        self.interval[0] > 0.8 * self.error
    }

    /// Whether the limit may be 0: the method is consistent, as far as these levels show.
    pub fn is_consistent(&self) -> bool {
        self.interval[0] <= 0.0
    }
}

/// The range of orders that is searched.
const ORDERS: [f64; 2] = [0.1, 8.0];

/// Fits four levels or more, with relative errors; `None` with fewer, or if no order is best.
pub(crate) fn limit(levels: &[SequenceLevel]) -> Option<Limit> {
    if levels.len() < 4 {
        return None;
    }
    let finest = levels.last()?;
    let point = |it: &SequenceLevel| [it.length / finest.length, it.error() / finest.error()];
    let points: Vec<_> = levels.iter().map(point).collect();
    let left = |p: f64| linear(&points, p).map_or(f64::INFINITY, |found| found.left);
    let order = least(left);
    if order - ORDERS[0] < 1e-3 || ORDERS[1] - order < 1e-3 {
        return None;
    }
    let [error, constant] = linear(&points, order)?.unknowns;
    // The order is an unknown, too: linearised about the solution.
    let rows = points.iter().map(|&[x, e]| {
        let power = x.powf(order);
        ([1.0 / e, power / e, constant * power * x.ln() / e], 1.0 - (error + constant * power) / e)
    });
    let reach = solve(&rows.collect::<Vec<_>>())?.reach(0, OUTSIDE);
    let share = error / (error + constant);
    let interval = [error - reach, error + reach].map(|it| it * finest.error());
    Some(Limit { error: error * finest.error(), interval, order, share })
}

fn linear(points: &[[f64; 2]], p: f64) -> Option<Solution<2>> {
    solve(&points.iter().map(|&[x, e]| ([1.0 / e, x.powf(p) / e], 1.0)).collect::<Vec<_>>())
}

/// Minimises a function of the order: on a grid over all orders, and then on ever finer grids around the best.
fn least(value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (ORDERS[0], ORDERS[1]);
    let mut best = low;
    while high - low > 1e-7 {
        let step = (high - low) / 40.0;
        let orders = (0..=40).map(|k| low + f64::from(k) * step);
        best = orders.min_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap_or(best);
        (low, high) = ((best - step).max(ORDERS[0]), (best + step).min(ORDERS[1]));
    }
    best
}
