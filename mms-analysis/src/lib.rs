//! What can be measured and said of a compiled field: how exact its quantities are, which terms of the equations it sees,
//! its period, and what it costs.

pub mod accuracy;
pub mod operations;
pub mod period;
pub mod visibility;
