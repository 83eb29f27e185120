//! The verification matrix: every mode of the solver, one at a time, by the field that isolates it.
//!
//! | step | from -> to | where |
//! |---|---|---|
//! | read | `matrix.toml` -> rows | [`matrix`] |
//! | plan | rows -> runs, each once | [`plan`] |
//! | run | runs -> outcomes, from the store where it has them | [`work`] |
//! | judge | outcomes of a row -> its verdict | [`verdict`] |
//! | report | rows and verdicts -> table, JSON, page | [`report`] |
//!
//! With the feature `defects`, `defects` shows rows deliberate mistakes of solver and compiler, which they have to
//! catch.
//!
//! "Sufficient, not just necessary, if we test all modes [...] but not all in the same test": Wallstedt,
//! Guilkey, "Manufactured Solutions Suitable for Verification of MPM and GIMP Codes".

#[cfg(feature = "defects")]
pub mod defects;
pub mod matrix;
pub mod plan;
#[cfg(any(test, feature = "defects"))]
pub mod pseudo;
pub mod report;
pub mod verdict;
pub mod work;

#[cfg(test)]
mod tests;
