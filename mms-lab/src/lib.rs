//! Studies of the solver of this project.
//!
//! [`tradeoff`] searches methods for the least error at a cost, with runs that [`trial`] makes; [`extremes`] holds the solver to
//! its bounds where fields are extreme; [`workbench`] compiles and times generated code; [`pictures`] says what a person would
//! see in pictures of a run. [`outcome`] is what comes of a run; [`rows`] reads tables of runs that are data.

#![warn(clippy::disallowed_methods)]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod extremes;
pub mod outcome;
pub mod pictures;
pub mod rows;
pub mod tradeoff;
pub mod trial;
pub mod workbench;
