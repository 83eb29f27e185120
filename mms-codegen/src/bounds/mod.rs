//! Bounds of formulas over the body, the time window and the ranges of parameters, by interval search.

pub mod angles;
pub mod chart;
pub mod enclosure;
pub mod forms;
pub mod search;
pub mod witness;
