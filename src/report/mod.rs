//! What the command says of runs and studies: tables, JSON documents, CSV files and pictures.

pub mod accuracy;
pub(crate) mod campaign;
mod comparison;
mod diagnosis;
pub(crate) mod excluded;
pub(crate) mod extremes;
pub(crate) mod front;
mod judge;
pub(crate) mod method;
mod phase;
pub(crate) mod picture;
mod plan;
mod results;
pub mod run;
mod study;
mod text;
pub(crate) mod tradeoff;

pub use comparison::Comparison;
pub use diagnosis::{Diagnosed, Hypotheses};
pub(crate) use judge::View;
pub use phase::Phases;
pub use plan::{Plan, Step};
pub(crate) use results::{differences, with_baseline};
pub use study::{Refused, Study};

pub(crate) use text::{plain, tally, to_the_right};
