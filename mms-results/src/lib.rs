//! Results of any solver: reads files, recognises their arrays, and measures their distance from an exact solution.
//!
//! A file is recognised by its content: a table with a header, VTK in XML or in the legacy format, NumPy, MATLAB, CalculiX,
//! Gmsh, Tecplot, dumps of particles. Readers return a [`Snapshot`]: points, cells, and named arrays of numbers, each with the
//! precision in which it was stored. [`names`] finds the arrays of displacement, velocity and so on; [`norm`] measures errors
//! over points, and [`over_cells`] over the [cells](cell) of a [`mesh`]. [`comparison`] compares with the exact solution in
//! blocks, so that no array contains all of it. [`pairing`] finds the same points in two results; [`own`] removes ghosts and duplicates, and [`lattice`] finds neighbours.
//! [`write`](mod@write) writes such files of a known state. [`wanted`] selects the arrays to read, and limits the memory.
//!
//! Nothing here opens a file, evaluates a field, or decides whether an error is small.

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
pub use snapshot::{ARRAYS, Array, Cells, Snapshot, Stored, Time};
