//! The sums between particles and nodes, w = w_ip and grad w = grad w_ip of the stencils.
//!
//! Every function takes plain slices: one entry per particle (`stencils` and the particle data) and
//! one per node (the `nodal` data). The sums onto nodes add to what is there.

use crate::stencil::Stencil;
use crate::{Lattice, Matrix, Real, Vector};

/// m_i += sum_p w m_p.
pub fn mass<T: Real, const D: usize>(stencils: &[impl Stencil<T, D>], mass: &[T], nodal: &mut [T]) {
    for (stencil, &m) in stencils.iter().zip(mass) {
        stencil.each(|i, w, _| nodal[i] += w * m);
    }
}

/// sum_p w m_p q_p, added to the nodes: momentum for q = v, the external force for q = b.
pub fn weighted_by_mass<T: Real, const D: usize>(
    stencils: &[impl Stencil<T, D>],
    mass: &[T],
    quantity: &[Vector<T, D>],
    nodal: &mut [Vector<T, D>],
) {
    for ((stencil, &m), q) in stencils.iter().zip(mass).zip(quantity) {
        let mq = q * m;
        stencil.each(|i, w, _| nodal[i] += mq * w);
    }
}

/// (mv)_i += sum_p w m_p C_p (x_i - x_p), what a velocity that is linear on each particle adds.
pub fn affine_momentum<T: Real, const D: usize>(
    stencils: &[impl Stencil<T, D>],
    mass: &[T],
    affine: &[Matrix<T, D>],
    position: &[Vector<T, D>],
    lattice: &Lattice<T, D>,
    nodal: &mut [Vector<T, D>],
) {
    let particles = stencils.iter().zip(mass).zip(affine).zip(position);
    for (((stencil, &m), c), x) in particles {
        stencil.each(|i, w, _| nodal[i] += c * lattice.difference(i, x) * (w * m));
    }
}

/// f_i += - sum_p V0 S_p grad w, the internal force; V0 tau = V sigma.
pub fn internal_force<T: Real, const D: usize>(
    stencils: &[impl Stencil<T, D>],
    reference_volume: &[T],
    stress: &[Matrix<T, D>],
    nodal: &mut [Vector<T, D>],
) {
    for ((stencil, &volume), stress) in stencils.iter().zip(reference_volume).zip(stress) {
        let stress = stress * volume;
        stencil.each(|i, _, grad_w| nodal[i] -= stress * grad_w);
    }
}

/// sum_i v_i (x) grad w: the gradient of the nodal quantity at a particle.
pub fn gradient<T: Real, const D: usize>(
    stencil: &impl Stencil<T, D>,
    nodal: &[Vector<T, D>],
) -> Matrix<T, D> {
    let mut sum = Matrix::zeros();
    stencil.each(|i, _, grad_w| sum += nodal[i] * grad_w.transpose());
    sum
}

/// (sum_i w v_i (x) (x_i - x_p)) (sum_i w (x_i - x_p) (x) (x_i - x_p))^-1: the linear velocity around a
/// particle, or `None` where the second sum is singular.
pub fn affine<T: Real, const D: usize>(
    stencil: &impl Stencil<T, D>,
    position: &Vector<T, D>,
    lattice: &Lattice<T, D>,
    nodal: &[Vector<T, D>],
) -> Option<Matrix<T, D>> {
    let (mut moment, mut spread) = (Matrix::zeros(), Matrix::zeros());
    stencil.each(|i, w, _| {
        let difference = lattice.difference(i, position);
        moment += nodal[i] * difference.transpose() * w;
        spread += difference * difference.transpose() * w;
    });
    spread.try_inverse().map(|inverse| moment * inverse)
}
