//! Studies of the solver of this project.
//!
//! [`tradeoff`] searches methods for the least error at a cost, with runs that [`trial`] makes; [`extremes`] checks the solver
//! against its bounds at extreme fields; [`workbench`] compiles and times generated code; [`plausibility`] decides which
//! mistakes a person would notice in pictures of a run. [`outcome`] is the result of a run; [`rows`] reads the TOML tables that
//! list runs.

#![warn(clippy::disallowed_methods)]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod extremes;
pub mod outcome;
pub mod plausibility;
pub mod rows;
pub mod tradeoff;
pub mod trial;
pub mod workbench;
