//! The verification matrix: every mode of the solver, one at a time, by the field that isolates it.
//!
//! `matrix.toml` is the list of rows, and is embedded. A row is a study, in the words of `mms study`, with the expectation of
//! theory and its reason; `mms verify` compares the results with it.
//!
//! | step | from -> to | where |
//! |---|---|---|
//! | read | `matrix.toml` -> rows; a row that has no meaning is an error | [`matrix`] |
//! | plan | rows -> runs, each once; the longest comes first, so that no thread runs it alone at the end | [`plan`] |
//! | run | runs -> outcomes, one thread each, from the store where it has them | [`work`] |
//! | judge | outcomes of a row -> its verdict | [`verdict`] |
//!
//! With the feature `defects`, the module `defects` runs rows with deliberate mistakes of solver and compiler, which the rows
//! have to catch.
//!
//! "Sufficient, not just necessary, if we test all modes [...] but not all in the same test": Wallstedt, Guilkey,
//! "Manufactured Solutions Suitable for Verification of MPM and GIMP Codes".

#[cfg(feature = "defects")]
pub mod defects;
pub mod matrix;
pub mod plan;
pub mod verdict;
pub mod work;
