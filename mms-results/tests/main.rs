//! The tests of this crate, as one program, so that what they share is compiled and linked once.

mod archives;
mod dumps;
mod files;
#[cfg(feature = "hdf5")]
mod hdf5;
mod memory;
mod norms;
mod over_cells;
mod pairing;
mod tables;
mod tecplot;
mod write;
mod xdmf;
