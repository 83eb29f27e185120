//! Measurements of a compiled field: the accuracy of its quantities, the terms of the equations that it tests, its period, its
//! cost, and the inverse of its motion.

pub mod accuracy;
pub mod inverse_motion;
pub mod operations;
pub mod period;
pub mod visibility;
