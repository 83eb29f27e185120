//! The errors of space and of time in one formula: e = C_h h^p + C_t dt^q.

use crate::OUTSIDE;
use crate::least::solve;

/// A formula for the error of a method, in the fitted norm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// C_h; of opposite sign to C_t if the two errors cancel.
    pub space_constant: f64,
    /// p.
    pub space_order: f64,
    /// C_t.
    pub time_constant: f64,
    /// q.
    pub time_order: f64,
    /// Half the 95 % intervals of p and q, from the scatter of errors about the formula.
    pub reach: [f64; 2],
    /// The largest relative distance of an error from the formula.
    pub residual: f64,
}

/// The range of orders that is searched.
const ORDERS: [f64; 2] = [0.25, 6.0];

/// The accuracy of orders.
const STEP: f64 = 1e-4;

/// Fits h, dt and e of some runs, with relative errors. For given orders the constants are a linear problem; the orders
/// minimise its residual (Golub & Pereyra, SIAM J. Numer. Anal. 10, 1973). `None` unless there are at least three runs more
/// than unknowns, of at least three h and three dt, and all numbers are positive and finite; also `None` if an order lies at an
/// end of the search range.
pub fn fit(runs: &[[f64; 3]]) -> Option<Fit> {
    let different = |which: usize| {
        let mut values: Vec<f64> = runs.iter().map(|run| run[which]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| *a / *b < 1.0 + 1e-6);
        values.len()
    };
    let usable = runs.iter().flatten().all(|value| *value > 0.0 && value.is_finite());
    if !usable || runs.len() < 7 || different(0) < 3 || different(1) < 3 {
        return None;
    }
    let size = runs.iter().fold([0.0_f64; 2], |[h, dt], run| [h.max(run[0]), dt.max(run[1])]);
    let scaled: Vec<[f64; 3]> =
        runs.iter().map(|[h, dt, e]| [h / size[0], dt / size[1], *e]).collect();
    let orders = least(|orders| constants(&scaled, orders).map_or(f64::INFINITY, |found| found.1));
    let ([space, time], _) = constants(&scaled, orders)?;
    let inside = |order: f64| order > ORDERS[0] + STEP && order < ORDERS[1] - STEP;
    let residual = scaled.iter().map(|[h, dt, e]| {
        ((space * h.powf(orders[0]) + time * dt.powf(orders[1])) / e - 1.0).abs()
    });
    orders.into_iter().all(inside).then(|| Fit {
        space_constant: space / size[0].powf(orders[0]),
        space_order: orders[0],
        time_constant: time / size[1].powf(orders[1]),
        time_order: orders[1],
        reach: reach(&scaled, [space, time], orders),
        residual: residual.fold(0.0, f64::max),
    })
}

/// The constants that minimise the sum of squares of relative residuals, and that sum.
fn constants(runs: &[[f64; 3]], [p, q]: [f64; 2]) -> Option<([f64; 2], f64)> {
    let rows = runs.iter().map(|[h, dt, e]| ([h.powf(p) / e, dt.powf(q) / e], 1.0));
    solve(&rows.collect::<Vec<_>>()).map(|found| (found.unknowns, found.left))
}

/// Half the intervals of both orders, from the formula linearised about the solution.
fn reach(runs: &[[f64; 3]], [space, time]: [f64; 2], [p, q]: [f64; 2]) -> [f64; 2] {
    let row = |[h, dt, e]: &[f64; 3]| {
        let (a, b) = (h.powf(p) / e, dt.powf(q) / e);
        ([a, b, space * a * h.ln(), time * b * dt.ln()], 1.0 - space * a - time * b)
    };
    let found = solve(&runs.iter().map(row).collect::<Vec<_>>());
    [2, 3].map(|which| found.as_ref().map_or(f64::INFINITY, |it| it.reach(which, OUTSIDE)))
}

/// Minimises a function of two orders: on a grid over the whole range, and then on ever finer grids around the best point.
fn least(value: impl Fn([f64; 2]) -> f64) -> [f64; 2] {
    let (mut step, mut reach) = (0.25, ORDERS[1] - ORDERS[0]);
    let mut best = [2.0, 2.0];
    let mut lowest = value(best);
    while step > STEP / 4.0 {
        let centre = best;
        let count = (reach / step).round() as i32;
        for (i, j) in (-count..=count).flat_map(|i| (-count..=count).map(move |j| (i, j))) {
            let at = [centre[0] + f64::from(i) * step, centre[1] + f64::from(j) * step];
            let at = at.map(|order| order.clamp(ORDERS[0], ORDERS[1]));
            let found = value(at);
            if found < lowest {
                (best, lowest) = (at, found);
            }
        }
        (step, reach) = (step / 4.0, 2.0 * step);
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(error: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
        let halved = |times: i32| 0.5f64.powi(times);
        let of = |k| (0..3).map(move |j| (0.1 * halved(k), 3e-3 * halved(k + j)));
        let all = (0..4).flat_map(of);
        all.map(|(h, dt)| [h, dt, error(h, dt)]).collect()
    }

    #[test]
    fn the_formula_of_exact_data_is_found() {
        for (p, q, space, time) in [
            (2.0, 2.0, 0.5, 300.0),
            (2.0, 1.0, 0.5, 2.0),
            (2.0, 2.0, 0.5, -200.0),
            (1.5, 3.0, 2.0, 9e3),
        ] {
            let found = fit(&runs(|h, dt| space * h.powf(p) + time * dt.powf(q))).unwrap();
            let near = |a: f64, b: f64, within: f64| (a / b - 1.0).abs() < within;
            assert!(
                near(found.space_order, p, 1e-3) && near(found.time_order, q, 1e-3),
                "{found:?}"
            );
            assert!(near(found.space_constant, space, 0.01), "{found:?}");
            assert!(near(found.time_constant, time, 0.01) && found.residual < 1e-3, "{found:?}");
        }
    }

    /// Noise of a percent changes the formula little, and appears in the residual.
    #[test]
    fn noise_shows_as_the_residual() {
        let sign = |h: f64, dt: f64| if (h / dt * 1e3).sin() > 0.0 { 1.01 } else { 0.99 };
        let data = runs(|h, dt| (0.5 * h * h + 300.0 * dt * dt) * sign(h, dt));
        let found = fit(&data).unwrap();
        assert!((found.space_order - 2.0).abs() < 0.1, "{found:?}");
        assert!((0.003..0.03).contains(&found.residual), "{found:?}");
    }

    #[test]
    fn too_little_says_nothing() {
        let all = runs(|h, dt| h * h + dt);
        assert_eq!(fit(&all[..6]), None);
        assert_eq!(fit(&[]), None);
        let one_step: Vec<_> = all.iter().map(|[h, _, e]| [*h, 1.0, *e]).collect();
        assert_eq!(fit(&one_step), None);
        // Three h and three dt are enough.
        let three: Vec<_> = all.iter().filter(|run| run[0] > 0.02).copied().collect();
        assert!(fit(&three).is_some_and(|found| (found.space_order - 2.0).abs() < 1e-3));
        let mut broken = all.clone();
        broken[3][2] = f64::NAN;
        assert_eq!(fit(&broken), None);
        broken[3][2] = 0.0;
        assert_eq!(fit(&broken), None);
        // The errors do not depend on dt: there is no order in time.
        let still = runs(|h, _| h * h);
        assert!(fit(&still).is_none_or(|found| found.time_constant.abs() < 1e-6));
    }
}
