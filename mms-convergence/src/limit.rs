//! What is left in the limit: e = e0 + C h^p, p being looked for.

use crate::OUTSIDE;
use crate::least::{Solution, solve};
use crate::sequence::Level;

/// The error that is left in the limit of fine levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// e0.
    pub error: f64,
    /// From where to where it may be.
    pub interval: [f64; 2],
    /// p.
    pub order: f64,
    /// e0 over the error on the finest level.
    pub share: f64,
}

impl Limit {
    /// Whether something is left beyond doubt: the interval is a fifth of the error at most, to each side.
    pub(crate) fn is_plain(&self) -> bool {
        self.interval[0] > 0.8 * self.error
    }

    /// Whether nothing need be left: the method is consistent, as far as these levels show.
    pub fn is_consistent(&self) -> bool {
        self.interval[0] <= 0.0
    }
}

/// Orders are looked for between these.
const ORDERS: [f64; 2] = [0.1, 8.0];

/// Fits four levels or more, each error counting relative to itself; `None` with fewer, or where no order is best.
pub(crate) fn limit(levels: &[Level]) -> Option<Limit> {
    if levels.len() < 4 {
        return None;
    }
    let finest = levels.last()?;
    let point = |it: &Level| [it.length / finest.length, it.error() / finest.error()];
    let points: Vec<_> = levels.iter().map(point).collect();
    let left = |p: f64| linear(&points, p).map_or(f64::INFINITY, |found| found.left);
    let order = least(left);
    if order - ORDERS[0] < 1e-3 || ORDERS[1] - order < 1e-3 {
        return None;
    }
    let [error, constant] = linear(&points, order)?.unknowns;
    // The order is an unknown as well: linearised about what was found.
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

/// Where a function of the order is least: on a grid over all orders, and then on ever finer ones around the best.
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
