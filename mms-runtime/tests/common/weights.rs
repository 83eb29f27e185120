//! Single particles on a grid, for the properties of weights.

use std::collections::BTreeMap;

use mms_runtime::column::PACK;
use mms_runtime::column::{Matrices, Pack};
use mms_runtime::lanes::turned;
use mms_runtime::lattice::Axis;
use mms_runtime::math::simd::Plain;
use mms_runtime::shape::Shape;
use mms_runtime::stencil::Stencil;
use mms_runtime::tensor::{deformation_gradient, determinant};
use mms_runtime::{Cause, Lattice, Matrix, Real, Vector};

/// Cells along every axis.
pub const CELLS: usize = 12;

/// Edges of a cell: no two alike.
const EDGES: [f64; 3] = [0.25, 0.4, 0.15];

/// A grid for a shape function; splines of a higher degree than 1 end at these knots.
pub fn lattice<T: Real, const D: usize, S: Shape>(ends: [[i64; 2]; D]) -> Lattice<T, D> {
    let axis = |a: usize| Axis {
        lower: 0.0,
        cell_size: EDGES[a],
        cells: CELLS,
        ends: if S::DEGREE > 1 { ends[a] } else { [0, CELLS as i64] },
        body: [3.0, 9.0],
    };
    Lattice::new(std::array::from_fn(axis), S::DEGREE, [false; D]).unwrap()
}

/// A particle; lengths in cells.
#[derive(Clone, Debug)]
pub struct Particle<const D: usize> {
    pub cells: Vector<f64, D>,
    /// The columns are half the edges of the undeformed domain.
    half_edges: Matrix<f64, D>,
    displacement_gradient: Matrix<f64, D>,
}

/// The nodes of a pack of particles, and the particles' positions.
pub type Placed<T, const D: usize, S> = (<S as Shape>::Stencil<T, D>, [Vector<T, D>; PACK]);

impl<const D: usize> Particle<D> {
    /// A particle with the half edges `half` along the axes, or turned by 0.7 in the first two of them.
    pub fn new(cells: [f64; 3], half: [f64; 3], h: [f64; 9], turned: bool) -> Self {
        let mut half_edges = Matrix::from_diagonal(&Vector::from_fn(|a, _| half[a]));
        if turned && D > 1 {
            let (sine, cosine) = 0.7_f64.sin_cos();
            let mut turn = Matrix::identity();
            for ((i, j), value) in
                [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().zip([cosine, -sine, sine, cosine])
            {
                turn[(i, j)] = value;
            }
            half_edges = turn * half_edges;
        }
        Self {
            cells: Vector::from_fn(|a, _| cells[a]),
            half_edges,
            displacement_gradient: Matrix::from_fn(|i, j| h[3 * i + j]),
        }
    }

    /// The position of the particle.
    pub fn position<T: Real>(&self, lattice: &Lattice<T, D>) -> Vector<T, D> {
        self.cells.map(T::of).component_mul(&lattice.cell_size) + lattice.lower
    }

    /// Half the edges of the undeformed domain, as lengths.
    fn lengths<T: Real>(&self, lattice: &Lattice<T, D>) -> Matrix<T, D> {
        Matrix::from_fn(|i, j| T::of(self.half_edges[(i, j)]) * lattice.cell_size[i])
    }

    /// Half the edges of the present domain, as lengths.
    pub fn present_half_edges<T: Real>(&self, lattice: &Lattice<T, D>) -> Matrix<T, D> {
        deformation_gradient(&self.displacement_gradient.map(T::of)) * self.lengths(lattice)
    }

    /// The nodes of the particle.
    pub fn stencil<T: Real, S: Shape>(
        &self,
        lattice: &Lattice<T, D>,
    ) -> Result<S::Stencil<T, D>, Cause> {
        let domain = S::domain(&self.lengths(lattice));
        let h = self.displacement_gradient.map(T::of);
        S::stencil(lattice, &self.position(lattice), &domain, &h)
    }

    /// The nodes of a pack of equal particles at these distances in cells along each axis, and their positions.
    pub fn pack<T: Real, S: Shape>(
        &self,
        lattice: &Lattice<T, D>,
        apart: [f64; PACK],
    ) -> Result<Placed<T, D, S>, Cause> {
        let simd = T::PlainSimd::from(Plain);
        let here = self.position(lattice);
        let positions = apart.map(|cells| here + lattice.cell_size * T::of(cells));
        let domains = Pack::alike(&S::domain(&self.lengths(lattice)));
        let h = Matrices::alike(&self.displacement_gradient.map(T::of));
        let mut stencil = S::Stencil::default();
        let components = turned(simd, &positions);
        S::place(simd, &mut stencil, lattice, &components, &domains, &h)?;
        Ok((stencil, positions))
    }

    /// The reach of the domain along each axis, for any shape function, in cells.
    pub fn reach(&self) -> Vector<f64, D> {
        let edges = |a: usize| Vector::<f64, D>::from_fn(|i, _| EDGES[i] / EDGES[a]);
        let h = self.displacement_gradient;
        Vector::from_fn(|a, _| {
            let row = |m: &Matrix<f64, D>| m.row(a).transpose().abs().sum();
            let lengths = Matrix::from_fn(|i, j| self.half_edges[(i, j)] * edges(a)[i]);
            let cube = determinant(&lengths).abs().powf(1.0 / D as f64);
            // |U| = |F| <= 1 + |H|.
            let box_half_width = row(&lengths).max(cube) * (1.0 + h.norm());
            row(&(deformation_gradient(&h) * lengths)).max(box_half_width)
        })
    }

    /// The distance of the borders of the domain, and of its middle, from a knot along an axis, in cells, if H is diagonal: the
    /// kinks of points and of GIMP.
    pub fn distance_from_kinks(&self, axis: usize) -> f64 {
        let half = self.half_edges[(axis, axis)];
        let stretched = half * (1.0 + self.displacement_gradient[(axis, axis)]);
        let borders =
            [0.0, half, -half, stretched, -stretched].map(|shift| self.cells[axis] + shift);
        borders.iter().map(|border| (border - border.round()).abs()).fold(1.0, f64::min)
    }
}

/// The weights and gradients of a particle by node, summed if a node is visited more than once.
pub fn weights<T: Real, const D: usize>(
    stencil: &impl Stencil<T, D>,
) -> BTreeMap<usize, (f64, Vector<f64, D>)> {
    let mut table = BTreeMap::new();
    stencil.each(0, |node, w, grad_w| {
        let (weight, gradient) = table.entry(node).or_insert((0.0, Vector::<f64, D>::zeros()));
        *weight += w.to_f64();
        *gradient += grad_w.map(Real::to_f64);
    });
    table
}
