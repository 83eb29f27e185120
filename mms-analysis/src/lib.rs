//! What can be measured and said of a compiled field: how exact its quantities are, which terms of the equations it sees,
//! its period, what it costs, and which point is where.

pub mod accuracy;
pub mod operations;
pub mod period;
pub mod present;
pub mod visibility;
