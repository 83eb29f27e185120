//! Campaigns: an external solver, run on the meshes of several studies.
//!
//! [`read`] parses a TOML file into a [`Campaign`], and finds every mistake of form in it, each at its place. Commands are
//! [`template`]s: a text is split into words once, as POSIX does, and the value of a placeholder is never split again; there is
//! no shell. A study whose parameters are lists (`set`) becomes one study for each set of values. [`process`] runs the words in
//! a folder of their own, with a limit of time, under a [`supervisor`] that keeps what they print and ends all processes that
//! they start. [`coverage`] finds the smallest set of candidate fields that shows every term that any candidate shows.
//!
//! This crate does not evaluate fields, resolve their names, or read results.

mod capabilities;
pub mod coverage;
mod descendants;
mod file;
pub mod printed;
pub mod process;
pub mod profile;
mod set;
pub mod supervisor;
mod table;
pub mod template;

pub use capabilities::Capabilities;
pub use file::{Campaign, Mistakes, Solver, Study, read};
