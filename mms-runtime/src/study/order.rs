//! Observed orders between levels.

use super::{Level, Point};

/// The observed orders between two levels, one per norm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Orders {
    /// The order of the norm l1.
    pub l1: Option<f64>,
    /// The order of the norm l2.
    pub l2: Option<f64>,
    /// The order of the norm linf.
    pub linf: Option<f64>,
}

/// The observed orders from one level to another, refined in space; `None` if either run stopped.
pub fn orders(coarse: &Level, fine: &Level) -> Orders {
    Point::of(fine).orders_from(&Point::of(coarse))
}
