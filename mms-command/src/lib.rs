//! The command `mms`: options, calls, output, exit codes. [`run`] executes a command line.
//!
//! Manufactured solutions for solid mechanics.
//!
//! A manufactured displacement field u(X, t) is one TOML file in `fields/`. Everything that follows
//! from it and from a strain-energy density W is derived: at build time by `field!`, and at run time
//! by the command, which interprets files that were never compiled.

#![warn(clippy::disallowed_methods)]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod checkpoint;
mod cli;
mod history;
mod provenance;
#[cfg(test)]
#[path = "../../tests/support/sampled.rs"]
mod sampled;
pub mod schema;
mod session;
mod terminal;
mod vtk;

pub use cli::run;
pub use cli::study::studies;

/// The tour's programs.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide/tour.md")]
pub struct Tour;

/// The guide's programs.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide/embedding.md")]
pub struct Guide;
