//! The tests of this crate, as one program, so that shared code is compiled and linked once. The tests of HDF5 are another,
//! since they need its feature.

mod archives;
mod dumps;
mod files;
mod frd;
mod gmsh;
mod mat;
mod memory;
mod norms;
mod over_cells;
mod pairing;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod series;
mod shared;
mod survive;
mod tables;
mod tecplot;
mod vtk_more;
mod write;
mod xdmf;

/// The shape of a VTK type.
fn shape(kind: u8) -> &'static mms_results::cell::CellShape {
    mms_results::cell::CellShape::all().find(|it| it.kind() == kind).unwrap()
}
