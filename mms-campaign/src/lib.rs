//! Campaigns: somebody else's solver, run on the meshes of several studies.
//!
//! [`read`] makes a [`Campaign`] of a TOML file, and finds every mistake of form in it, each at its place. Commands are
//! [`template`]s: a text is split into words once, as POSIX does, and what stands for a placeholder is never split
//! again; there is no shell. A study whose parameters are lists (`set`) is a study for each step. [`process`] runs such words in a folder of their own, with a limit of time, under a
//! [`supervisor`] that keeps what they print and ends all that they start. [`cover`] finds the fewest fields that show all that any of them shows.
//!
//! What a field is, what its name means, and what comes of results is not known here.

mod can;
pub mod cover;
mod descendants;
mod file;
pub mod printed;
pub mod process;
pub mod profile;
mod set;
pub mod supervisor;
mod table;
pub mod template;

pub use can::Can;
pub use file::{Campaign, Mistakes, Solver, Study, read};
