//! Observed orders between levels.

use super::{Level, Point};

/// ln(e1/e2) / ln(h1/h2).
///
/// `None` where there is none: an error or a length that is not positive and finite, or h1 = h2. An
/// error of exactly zero has no order: a method that represents the field exactly proves nothing.
pub fn observed_order(errors: [f64; 2], cell_sizes: [f64; 2]) -> Option<f64> {
    let usable = |value: f64| value > 0.0 && value.is_finite();
    let all_usable = errors.into_iter().chain(cell_sizes).all(usable);
    let order = (errors[0] / errors[1]).ln() / (cell_sizes[0] / cell_sizes[1]).ln();
    (all_usable && order.is_finite()).then_some(order)
}

/// The observed orders between two levels, one per norm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Orders {
    /// Of the norm l1.
    pub l1: Option<f64>,
    /// Of the norm l2.
    pub l2: Option<f64>,
    /// Of the norm linf.
    pub linf: Option<f64>,
}

/// The observed orders from one level to another, refined in space; none if either run stopped.
pub fn orders(coarse: &Level, fine: &Level) -> Orders {
    Point::of(fine).orders_from(&Point::of(coarse))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_a_power_law_is_its_exponent() {
        let order = observed_order([9e-3, 1e-3], [0.3, 0.1]).unwrap();
        assert!((order - 2.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_useless_has_an_order() {
        for errors in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0]] {
            assert_eq!(observed_order(errors, [0.2, 0.1]), None);
        }
        assert_eq!(observed_order([2.0, 1.0], [0.1, 0.1]), None);
    }
}
