//! The sums between particles and nodes, w = w_ip and grad w = grad w_ip of the stencils.
//!
//! Every function takes plain slices: one entry per particle (`stencils` and the particle data) and
//! one per node (the `nodal` data). The sums onto nodes add to what is there.

use crate::shape::Stencil;
use crate::{Matrix, Real, Vector};

/// m_i += sum_p w m_p.
pub fn mass<T: Real, const D: usize>(stencils: &[Stencil<T, D>], mass: &[T], nodal: &mut [T]) {
    for (stencil, &m) in stencils.iter().zip(mass) {
        for (i, w, _) in stencil.nodes() {
            nodal[i] += w * m;
        }
    }
}

/// sum_p w m_p q_p, added to the nodes: momentum for q = v, the external force for q = b.
pub fn weighted_by_mass<T: Real, const D: usize>(
    stencils: &[Stencil<T, D>],
    mass: &[T],
    quantity: &[Vector<T, D>],
    nodal: &mut [Vector<T, D>],
) {
    for ((stencil, &m), q) in stencils.iter().zip(mass).zip(quantity) {
        let mq = q * m;
        for (i, w, _) in stencil.nodes() {
            nodal[i] += mq * w;
        }
    }
}

/// f_i += - sum_p V0 tau_p grad w, the internal force; V0 tau = V sigma.
pub fn internal_force<T: Real, const D: usize>(
    stencils: &[Stencil<T, D>],
    reference_volume: &[T],
    kirchhoff_stress: &[Matrix<T, D>],
    nodal: &mut [Vector<T, D>],
) {
    for ((stencil, &volume), tau) in stencils.iter().zip(reference_volume).zip(kirchhoff_stress) {
        let stress = tau * volume;
        for (i, _, grad_w) in stencil.nodes() {
            nodal[i] -= stress * grad_w;
        }
    }
}

/// sum_i w q_i: the nodal quantity at a particle.
pub fn interpolate<T: Real, const D: usize>(
    stencil: &Stencil<T, D>,
    nodal: &[Vector<T, D>],
) -> Vector<T, D> {
    let mut sum = Vector::zeros();
    for (i, w, _) in stencil.nodes() {
        sum += nodal[i] * w;
    }
    sum
}

/// L = sum_i v_i (x) grad w: the gradient of the nodal quantity at a particle.
pub fn gradient<T: Real, const D: usize>(
    stencil: &Stencil<T, D>,
    nodal: &[Vector<T, D>],
) -> Matrix<T, D> {
    let mut sum = Matrix::zeros();
    for (i, _, grad_w) in stencil.nodes() {
        sum += nodal[i] * grad_w.transpose();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Cpgimp;

    /// The gradient of v_i = A x_i is A, not its transpose.
    #[test]
    fn gradient_of_a_linear_field() {
        let (position, half_width) =
            (Vector::<f64, 2>::new(3.2, 4.9), Vector::<f64, 2>::new(0.25, 0.3));
        let stencil =
            Stencil::new::<Cpgimp>(&position, &half_width, 1.0, &[8; 2], &[1, 8]).unwrap();
        let a = Matrix::<f64, 2>::new(1.0, 2.0, -3.0, 0.5);
        let node = |i: usize| Vector::<f64, 2>::new((i % 8) as f64, (i / 8) as f64);
        let nodal: Vec<_> = (0..64).map(|i| a * node(i)).collect();
        assert!((gradient(&stencil, &nodal) - a).amax() < 1e-13);
        assert!((interpolate(&stencil, &nodal) - a * position).amax() < 1e-13);
    }
}
