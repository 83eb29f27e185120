//! Shape functions: the weights w_ip and weight gradients that tie a particle to its nodes.
//!
//! To add one, write `shape/name.rs` with a type that implements [`Shape`] (the weights, their source,
//! and what of a particle's domain they need), and add `name::Type` to the list below. The property
//! tests and the `mms` command then find it by itself.

use nalgebra::ComplexField;

use crate::extension::extension_list;
use crate::stencil::{Stencil, Tensor};
use crate::tensor::determinant;
use crate::{Cause, Lattice, Matrix, Real, Vector};

extension_list! {
    /// The shape functions.
    ShapeName, ShapeVisitor: Shape, "shape function";
    linear::Linear,
    ugimp::Ugimp,
    cpgimp::Cpgimp,
    cpdi::Cpdi,
    quadratic_bspline::QuadraticBspline,
    cubic_bspline::CubicBspline,
}

/// The most nodes along one axis that a particle may touch.
pub const MAX_NODES: usize = 4;

/// The weights of a point, of any degree up to 3.
pub type PointStencil<T, const D: usize> = Tensor<T, D, MAX_NODES>;

/// A shape function.
///
/// The weights of one particle add up to 1, and reproduce linear functions of its position: sum_i w_ip
/// = 1, sum_i w_ip x_i = x_p.
pub trait Shape: 'static {
    /// The degree of the splines on the grid: 1 has its nodes on the corners of cells.
    const DEGREE: usize = 1;

    /// Whether a particle's domain follows its deformation. Such a shape function is none in the total
    /// formulation, where nothing moves.
    const FOLLOWS: bool = false;

    /// What is kept of a particle's undeformed domain.
    type Domain<T: Real, const D: usize>: Copy + Send + Sync;

    /// The nodes of a particle.
    type Stencil<T: Real, const D: usize>: Stencil<T, D>;

    /// What is kept of the undeformed domain X_p + sum_a xi_a r_a, |xi_a| <= 1; r_a are the columns.
    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Self::Domain<T, D>;

    /// The nodes and weights of a particle at `position` (a length), with displacement gradient H.
    ///
    /// # Errors
    /// The domain does not fit on the grid, or is too large for the stencil.
    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        domain: &Self::Domain<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<Self::Stencil<T, D>, Cause>;

    /// The nodes and weights of a point: of a piece of a face, say.
    ///
    /// # Errors
    /// The point is off the grid.
    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<PointStencil<T, D>, Cause> {
        let cells = lattice.in_cells(position);
        Tensor::new(lattice, |a| linear::hats(cells[a])).ok_or_else(|| Cause::lost(position))
    }
}

/// The half widths of the box that stands for a domain in GIMP: its own if its edges run along the
/// axes, else those of the cube of its volume. (A body-fitted domain is turned; a box is not.)
fn half_widths<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
    let diagonal = half_edges.diagonal();
    if *half_edges == Matrix::from_diagonal(&diagonal) {
        return diagonal;
    }
    let volume = determinant(half_edges).abs();
    Vector::repeat(ComplexField::powf(volume, T::ratio(1, D as i32)))
}

/// GIMP's stencil for a box of half widths `half_width`.
fn gimp_stencil<T: Real, const D: usize>(
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
    half_width: &Vector<T, D>,
) -> Result<Tensor<T, D, MAX_NODES>, Cause> {
    for (&l, &h) in half_width.iter().zip(&lattice.cell_size) {
        if !(l > T::zero() && l < h) {
            return Err(Cause::HalfWidth { half_width: l.to_f64(), cell_size: h.to_f64() });
        }
    }
    let (cells, half) = (lattice.in_cells(position), half_width.component_div(&lattice.cell_size));
    Tensor::new(lattice, |a| ugimp::averages_of_hat(cells[a], half[a]))
        .ok_or_else(|| Cause::lost(position))
}
