//! Shape functions: the weights w_ip and weight gradients that tie a particle to its nodes.
//!
//! | shape function | domain of a particle |
//! |---|---|
//! | `linear`, `quadratic_bspline`, `cubic_bspline` | a point |
//! | `ugimp` | a box of its initial size |
//! | `cpgimp` | a box that follows the diagonal of U, F = R U, so that neighbours keep touching if nothing shears |
//! | `cpdi` | a parallelepiped that follows F |
//!
//! Splines of degree p have p more nodes than cells along an axis, each at the mean of its inner knots, so that
//! sum w x_i = x. Where a body's face rests on a knot, at a wall or in the total formulation, knots end there with
//! full multiplicity: then one spline alone is not 0 on the face, and a wall holds its node.
//!
//! To add one, write `shape/name.rs` with a type that implements [`Shape`] (the weights, their source, and what of
//! a particle's domain they need), and add `name::Type` to the list below. The property tests and the `mms`
//! command then find it by itself.

use mms_math::machine::{Machine, Plain};

use crate::column::{Bunch, Matrices, Vectors};
use crate::extension::extension_list;
use crate::failure::Cause;
use crate::lanes::components;
use crate::lattice::Lattice;
use crate::real::{Matrix, Real, Vector};
use crate::stencil::{Stencil, Tensor};

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
    /// The degree of the splines on the grid: 1 has its nodes on the corners of cells.
    const DEGREE: usize = 1;

    /// Whether a particle's domain follows its deformation. Such a shape function is none in the total
    /// formulation, where nothing moves.
    const FOLLOWS: bool = false;

    /// Whether a stencil reaches no further than from one node before a particle's cell to one beyond
    /// the cell after it, along every axis.
    const NEAR: bool = true;

    /// Where positions with the same nodes begin, in cells from a node: particles stand in this order.
    const ORIGIN: f64 = 0.0;

    /// What is kept of a particle's undeformed domain.
    type Domain<T: Real, const D: usize>: Bunch;

    /// The nodes of a bunch of particles.
    type Stencil<T: Real, const D: usize>: Stencil<T, D>;

    /// What is kept of the undeformed domain X_p + sum_a xi_a r_a, |xi_a| <= 1; r_a are the columns.
    fn domain<T: Real, const D: usize>(
        half_edges: &Matrix<T, D>,
    ) -> <Self::Domain<T, D> as Bunch>::One;

    /// Writes the nodes and weights of a bunch of particles to `stencil`. They are at these positions (lengths), of which
    /// the components along each axis are given, and have these domains and displacement gradients H.
    ///
    /// # Errors
    /// A domain does not fit on the grid, or is too large for the stencil: the cause that the first of particles
    /// that are alike would have.
    fn place<T: Real, M: Machine<T>, const D: usize>(
        machine: M,
        stencil: &mut Self::Stencil<T, D>,
        lattice: &Lattice<T, D>,
        position: &[M::Eight; D],
        domain: &Self::Domain<T, D>,
        displacement_gradient: &Matrices<T, D>,
    ) -> Result<(), Cause>;

    /// The nodes and weights of a bunch of particles that are alike; see [`place`](Shape::place).
    ///
    /// # Errors
    /// Likewise.
    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        domain: &<Self::Domain<T, D> as Bunch>::One,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<Self::Stencil<T, D>, Cause> {
        let mut stencil = Self::Stencil::default();
        let (position, domain) = (Vectors::alike(position), Bunch::alike(domain));
        let h = Matrices::alike(displacement_gradient);
        place_alone::<T, D, Self>(&mut stencil, lattice, &position, &domain, &h)?;
        Ok(stencil)
    }

    /// The nodes and weights of a bunch of points that are alike: of a piece of a face, say.
    ///
    /// # Errors
    /// The point is off the grid.
    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<Tensor<T, D>, Cause>;
}

/// [`Shape::place`] with the instructions of every processor, as a function of its own, so that it is compiled once.
///
/// # Errors
/// Likewise.
#[inline(never)]
pub(crate) fn place_alone<T: Real, const D: usize, S: Shape>(
    stencil: &mut S::Stencil<T, D>,
    lattice: &Lattice<T, D>,
    position: &Vectors<T, D>,
    domain: &S::Domain<T, D>,
    displacement_gradient: &Matrices<T, D>,
) -> Result<(), Cause> {
    let machine = T::PlainMachine::from(Plain);
    let position = components(machine, position);
    S::place(machine, stencil, lattice, &position, domain, displacement_gradient)
}

/// What becomes of a bunch at these positions that is off the grid; of its first particle.
#[cold]
pub(crate) fn lost<T: Real, const D: usize>(position: &Vectors<T, D>) -> Cause {
    Cause::lost(&position.get(0))
}
