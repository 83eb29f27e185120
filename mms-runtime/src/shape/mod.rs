//! Shape functions: the weights w_ip and weight gradients that tie a particle to its nodes.
//!
//! | shape function | domain of a particle |
//! |---|---|
//! | `linear`, `quadratic_bspline`, `cubic_bspline` | a point |
//! | `ugimp` | a box of its initial size |
//! | `cpgimp` | a box that follows the diagonal of U, F = R U, so that neighbours stay in contact if nothing shears |
//! | `cpdi` | a parallelepiped that follows F |
//!
//! Splines of degree p have p more nodes than cells along an axis, each at the mean of its inner knots, so that sum w x_i = x.
//! Where a body's face rests on a knot, at a wall or in the total formulation, knots end there with full multiplicity: then
//! only one spline is not 0 on the face, and a wall constrains its node.
//!
//! To add one, write `shape/name.rs` with a type that implements [`Shape`] (the weights, their source, and the data of a
//! particle's domain that they need), and add `name::Type` to the list below. The property tests and the `mms` command then
//! find it automatically.

use mms_math::simd::{Plain, Simd};

use crate::column::{Matrices, Pack, Vectors};
use crate::extension::extension_list;
use crate::failure::Cause;
use crate::lanes::components;
use crate::lattice::Lattice;
use crate::real::{Matrix, Real, Vector};
use crate::stencil::{ProductStencil, Stencil};

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

/// A shape function.
///
/// The weights of one particle add up to 1, and reproduce linear functions of its position: sum_i w_ip
/// = 1, sum_i w_ip x_i = x_p.
pub trait Shape: Sized + 'static {
    /// The degree of the splines on the grid: if it is 1, nodes are the corners of cells.
    const DEGREE: usize = 1;

    /// Whether a particle's domain follows its deformation. If so, the total formulation refuses the shape function, since
    /// nothing moves there.
    const FOLLOWS: bool = false;

    /// Whether a stencil reaches no further than from one node before a particle's cell to one beyond the cell after it, along
    /// every axis.
    const NEAR: bool = true;

    /// The offset, in cells from a node, of the regions where all positions have the same nodes: particles are sorted by these.
    const ORIGIN: f64 = 0.0;

    /// The stored data of a pack of undeformed particle domains.
    type Domain<T: Real, const D: usize>: Pack;

    /// The nodes of a pack of particles.
    type Stencil<T: Real, const D: usize>: Stencil<T, D>;

    /// The stored data of the undeformed domain X_p + sum_a xi_a r_a, |xi_a| <= 1; r_a are the columns of `half_edges`.
    fn domain<T: Real, const D: usize>(
        half_edges: &Matrix<T, D>,
    ) -> <Self::Domain<T, D> as Pack>::One;

    /// Writes the nodes and weights of a pack of particles to `stencil`. `position` has the components along each axis
    /// (lengths); `domain` and `displacement_gradient` (H) are the particles' too.
    ///
    /// # Errors
    /// A domain does not fit on the grid, or is too large for the stencil. The cause is right if all particles of the pack are
    /// equal; otherwise it is the first particle's.
    fn place<T: Real, M: Simd<T>, const D: usize>(
        simd: M,
        stencil: &mut Self::Stencil<T, D>,
        lattice: &Lattice<T, D>,
        position: &[M::Eight; D],
        domain: &Self::Domain<T, D>,
        displacement_gradient: &Matrices<T, D>,
    ) -> Result<(), Cause>;

    /// The nodes and weights of a pack of equal particles; see [`place`](Shape::place).
    ///
    /// # Errors
    /// The errors of [`place`](Shape::place).
    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        domain: &<Self::Domain<T, D> as Pack>::One,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<Self::Stencil<T, D>, Cause> {
        let mut stencil = Self::Stencil::default();
        let (position, domain) = (Vectors::alike(position), Pack::alike(domain));
        let h = Matrices::alike(displacement_gradient);
        place_alone::<T, D, Self>(&mut stencil, lattice, &position, &domain, &h)?;
        Ok(stencil)
    }

    /// The nodes and weights of a pack of equal points, for instance of a piece of a face.
    ///
    /// # Errors
    /// The point is off the grid.
    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<ProductStencil<T, D>, Cause>;
}

/// Calls [`Shape::place`] with the instructions of every processor, as a function that is not inlined, so that it is compiled
/// once.
///
/// # Errors
/// The errors of [`Shape::place`].
#[inline(never)]
pub(crate) fn place_alone<T: Real, const D: usize, S: Shape>(
    stencil: &mut S::Stencil<T, D>,
    lattice: &Lattice<T, D>,
    position: &Vectors<T, D>,
    domain: &S::Domain<T, D>,
    displacement_gradient: &Matrices<T, D>,
) -> Result<(), Cause> {
    let simd = T::PlainSimd::from(Plain);
    let position = components(simd, position);
    S::place(simd, stencil, lattice, &position, domain, displacement_gradient)
}

/// The failure of a pack off the grid, at the position of its first particle.
#[cold]
pub(crate) fn lost<T: Real, const D: usize>(position: &Vectors<T, D>) -> Cause {
    Cause::lost(&position.get(0))
}
