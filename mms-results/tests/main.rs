//! The tests of this crate, as one program, so that what they share is compiled and linked once.

mod archives;
mod dumps;
mod files;
mod memory;
mod norms;
mod over_cells;
mod pairing;
mod tables;
mod tecplot;
mod vtk_more;
mod write;
