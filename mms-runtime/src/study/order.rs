//! Observed orders between levels.

use super::{StudyLevel, StudyPoint};

/// The observed orders between two levels, one per norm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ObservedOrders {
    /// The order of the norm l1.
    pub l1: Option<f64>,
    /// The order of the norm l2.
    pub l2: Option<f64>,
    /// The order of the norm linf.
    pub linf: Option<f64>,
}

/// The observed orders from one level to another, refined in space; `None` if either run stopped.
pub fn orders(coarse: &StudyLevel, fine: &StudyLevel) -> ObservedOrders {
    StudyPoint::of(fine).orders_from(&StudyPoint::of(coarse))
}
