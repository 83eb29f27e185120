//! Manufactured solutions for solid mechanics.
//!
//! A manufactured displacement field u(X, t) is one TOML file in `fields/`. Everything that follows
//! from it and from a strain-energy density W is derived at build time; [`gallery`] holds the
//! result, one module per file. [`scene`] lets a solver run on any of them, and on files that were
//! never compiled.

mod checkpoint;
pub mod cli;
mod extremes;
pub mod gallery;
mod history;
pub mod interpreted;
mod page;
pub mod report;
mod rows;
pub mod scene;
pub mod schema;
mod shell;
mod store;
mod tradeoff;
mod trial;
mod verify;
mod vtk;
pub mod workbench;

/// The README's programs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

/// The guide's programs.
#[cfg(doctest)]
#[doc = include_str!("../docs/guide/embedding.md")]
pub struct Guide;
