//! Results of any solver: what files hold, what its names mean, and how far it is from an exact solution.
//!
//! A file is known by its content: a table with a header, VTK in XML or in the legacy format, NumPy, MATLAB, CalculiX,
//! Gmsh, Tecplot, dumps of particles. What is read is a [`Snapshot`]: points, cells, and named arrays of numbers, each with
//! the precision in which it was stored. [`names`]
//! says which of them are displacement, velocity and so on; [`norm`] measures them over points,
//! [`over_cells`] over the [cells](cell) of a [`mesh`], and [`comparison`] block by block of the exact solution;
//! [`pairing`] finds the same points in two results,
//! [`own`] leaves out ghosts and what is there twice, and [`lattice`] finds neighbours.
//! [`write`](mod@write) makes such files of a state that is known. [`wanted`] says which arrays are read, in how much
//! memory.
//!
//! Nothing here opens a file, knows a field, or decides whether an error is small.

mod axes;
pub mod cell;
pub mod comparison;
mod components;
mod files;
pub mod lattice;
mod mapping;
mod meaning;
pub mod mesh;
mod mistake;
pub mod motion;
pub mod names;
pub mod norm;
pub mod over_cells;
pub mod own;
pub mod pairing;
mod parts;
mod profile;
mod read;
mod role;
mod snapshot;
pub mod suggestion;
pub mod wanted;
pub mod write;

pub use files::Files;
pub use mistake::Mistake;
pub use read::{Contents, is_time, parse, read};
pub use snapshot::{Array, Cells, Snapshot, Stored, Time};
