//! Quantiles of Student's t and tails of Fisher's F, for whole degrees of freedom.
//!
//! Both are incomplete beta functions of halves of whole numbers, which have finite recurrences (Abramowitz & Stegun,
//! Handbook of Mathematical Functions, 26.5.15, 26.5.16, 26.5.27, 26.5.28).

use std::f64::consts::{FRAC_2_PI, PI};

/// I_x(a/2, b/2), regularised.
fn incomplete_beta(x: f64, [a, b]: [usize; 2]) -> f64 {
    let (mut p, mut q) = (1 + (a - 1) % 2, 1 + (b - 1) % 2);
    let (mut value, mut beta) = match (p, q) {
        (1, 1) => (FRAC_2_PI * x.sqrt().asin(), PI),
        (1, _) => (x.sqrt(), 2.0),
        (_, 1) => (1.0 - (1.0 - x).sqrt(), 2.0),
        _ => (x, 1.0),
    };
    let half = |n: usize| n as f64 / 2.0;
    let term = |p: usize, q: usize, beta: f64| x.powf(half(p)) * (1.0 - x).powf(half(q)) / beta;
    while p < a {
        value -= term(p, q, beta) / half(p);
        beta *= half(p) / (half(p) + half(q));
        p += 2;
    }
    while q < b {
        value += term(p, q, beta) / half(q);
        beta *= half(q) / (half(p) + half(q));
        q += 2;
    }
    value.clamp(0.0, 1.0)
}

/// The probability that |t| exceeds this value.
fn both_tails(t: f64, freedom: usize) -> f64 {
    incomplete_beta(freedom as f64 / (freedom as f64 + t * t), [freedom, 1])
}

/// The t that |t| exceeds with this probability; infinite without a degree of freedom.
pub(crate) fn quantile(outside: f64, freedom: usize) -> f64 {
    if freedom == 0 {
        return f64::INFINITY;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while both_tails(high, freedom) > outside {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if both_tails(middle, freedom) > outside { low = middle } else { high = middle }
    }
    high
}

/// The probability that a ratio of two independent variances of the same expectation exceeds this value.
pub(crate) fn tail_of_ratio(ratio: f64, [above, below]: [usize; 2]) -> f64 {
    let (above_f, below_f) = (above as f64, below as f64);
    incomplete_beta(below_f / (below_f + above_f * ratio), [below, above])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 1e-4, "{found}, {expected}");
    }

    /// With one degree of freedom t is the tangent of a uniform angle; with two it is algebraic.
    #[test]
    fn quantiles_are_those_of_closed_forms() {
        for outside in [0.3, 0.05, 0.01] {
            assert_near(quantile(outside, 1), (PI / 2.0 * (1.0 - outside)).tan());
            let inside = 1.0 - outside;
            assert_near(quantile(outside, 2), inside * (2.0 / (1.0 - inside * inside)).sqrt());
        }
    }

    /// Published tables.
    #[test]
    fn quantiles_and_tails_are_those_of_tables() {
        for (freedom, t) in
            [(3, 3.18245), (4, 2.77645), (7, 2.36462), (30, 2.04227), (200, 1.97190)]
        {
            assert_near(quantile(0.05, freedom), t);
        }
        for (freedom, ratio) in [
            ([1, 1], 161.4476),
            ([1, 4], 7.70865),
            ([2, 5], 5.78614),
            ([3, 8], 4.06618),
            ([5, 17], 2.80999),
        ] {
            assert_near(tail_of_ratio(ratio, freedom), 0.05);
        }
        assert_eq!(quantile(0.05, 0), f64::INFINITY);
    }
}
