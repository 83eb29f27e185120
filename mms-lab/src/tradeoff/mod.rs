//! Error against cost: which method, with which numbers, on which grid.

pub mod search;
pub mod setting;

#[cfg(test)]
mod tests;
