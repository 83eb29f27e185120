//! Views of results: tables, JSON documents, CSV files, pictures, and pages of HTML.
//!
//! Each kind of result has a module for its text and its files; [`page`] reads the documents of a folder and makes a page of
//! them. This crate neither runs the solver nor prints.

#![warn(clippy::disallowed_methods)]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod accuracy;
pub mod campaign;
mod comparison;
#[cfg(feature = "defects")]
pub mod defects;
mod diagnosis;
pub mod excluded;
pub mod extremes;
pub mod front;
mod judge;
mod junit;
pub mod method;
pub mod page;
mod phase;
mod plan;
pub mod plot;
mod results;
pub mod run;
#[cfg(test)]
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod shown;
mod study;
pub mod table;
mod text;
pub mod tradeoff;
pub mod verify;

pub use comparison::Comparison;
pub use diagnosis::{Diagnosed, Hypotheses};
pub use judge::View;
pub use phase::Phases;
pub use plan::{DiagnosisPlan, DiagnosisStep};
pub use results::{Compared, differences, with_baseline};
pub use shown::{Format, Shown};
pub use study::{Study, UnstartedLevel};
pub use text::tally;
