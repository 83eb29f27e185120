//! The tests of this crate, as one program, so that what they share is compiled and linked once.

mod archives;
mod dumps;
mod files;
mod frd;
mod gmsh;
#[cfg(feature = "hdf5")]
mod hdf5;
mod mat;
mod memory;
mod norms;
mod over_cells;
mod pairing;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod series;
mod shared;
mod tables;
mod tecplot;
mod vtk_more;
mod write;
mod xdmf;

/// The kind of cells of that number in VTK.
fn shape(kind: u8) -> &'static mms_results::cell::Shape {
    mms_results::cell::Shape::all().find(|it| it.kind() == kind).unwrap()
}
