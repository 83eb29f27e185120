//! The surface impedance Z of a half space: the traction that sustains a wave exp(i k m.X) on its surface, which decays into
//! it, is k Z times the displacement.
//!
//! If Z is positive definite, no load on the surface lets such a wave grow; if it is not, a wave grows the faster, the shorter
//! it is (Biot, J. Appl. Phys. 34, 1963; the complementing condition of Simpson & Spector, Arch. Rat. Mech. Anal. 84, 1984). Z
//! is computed from integrals over the directions of the plane of m and the normal (Barnett & Lothe, Phys. Norv. 7, 1973): with
//! n and m turned by an angle a, and T = A n n, R = A m n,
//!
//! ```text
//! H = <T^-1>,   S = <T^-1 R^T>,   Z = H^-1 (I + i S),   <.> the mean over all a
//! ```
//!
//! No root of a polynomial is needed, and states with coinciding roots, such as an undeformed isotropic one, need no special
//! treatment. The integrand is periodic and analytic if A is strongly elliptic, so equal steps converge exponentially.

use nalgebra::{Cholesky, DMatrix, SMatrix, SVector};

use crate::elasticity::Elasticity;

/// The initial and the largest number of equal steps of the integrals.
const STEPS: [usize; 2] = [8, 512];

/// The integrals are converged if twice the steps change an impedance by less than this fraction.
const CONVERGED: f64 = 1e-8;

/// A Hermitian matrix Z, whose real part is symmetric and whose imaginary part is not.
#[derive(Clone, Debug, PartialEq)]
pub struct Impedance<const D: usize> {
    /// Re Z.
    pub real: SMatrix<f64, D, D>,
    /// Im Z.
    pub imaginary: SMatrix<f64, D, D>,
}

impl<const D: usize> Impedance<D> {
    /// The impedance of the half space with the outward normal N, for waves along m in its surface; both are unit vectors.
    /// `None` if A is not strongly elliptic in their plane.
    pub fn new(
        elasticity: &Elasticity<D>,
        normal: &SVector<f64, D>,
        along: &SVector<f64, D>,
    ) -> Option<Self> {
        let blocks = Blocks::new(elasticity, normal, along);
        let [mut steps, most] = STEPS;
        let mut sums = blocks.sums(steps, 0.0)?;
        let mut impedance = Self::of(&sums)?;
        while steps < most {
            // The steps between the previous ones.
            let between = blocks.sums(steps, 0.5)?;
            sums = [sums[0] + between[0], sums[1] + between[1]].map(|sum| sum / 2.0);
            steps *= 2;
            let finer = Self::of(&sums)?;
            let change = (finer.real - impedance.real).norm_squared()
                + (finer.imaginary - impedance.imaginary).norm_squared();
            let is_enough = change.sqrt() <= CONVERGED * finer.real.norm();
            impedance = finer;
            if is_enough {
                return Some(impedance);
            }
        }
        Some(impedance)
    }

    /// Computes Z from the means of T^-1 and T^-1 R^T.
    fn of([h, s]: &[SMatrix<f64, D, D>; 2]) -> Option<Self> {
        let real = Cholesky::new(*h)?.inverse();
        let product = real * s;
        // The difference from a Hermitian matrix is the remaining error of the steps.
        Some(Impedance { real, imaginary: (product - product.transpose()) / 2.0 })
    }

    /// The impedance under a pressure that follows the deformed surface, where P N = -q a with a = F^-T N: with b = F^-T m the
    /// load changes by -i k q (a b^T - b a^T) u.
    pub fn under_pressure(&self, q: f64, [a, b]: [SVector<f64, D>; 2]) -> Self {
        let turn = a * b.transpose() - b * a.transpose();
        Impedance { real: self.real, imaginary: self.imaginary + turn * q }
    }

    /// The least eigenvalue over the displacements in the span of some directions.
    pub fn least_eigenvalue(&self, span: &[SVector<f64, D>]) -> f64 {
        let entry = |matrix: &SMatrix<f64, D, D>, row: usize, column: usize| {
            span[row].dot(&(matrix * span[column]))
        };
        let order = span.len();
        // A Hermitian X + i Y has the eigenvalues of the symmetric matrix of the blocks X, -Y, Y, X.
        let whole = DMatrix::from_fn(2 * order, 2 * order, |row, column| {
            let (i, j) = (row % order, column % order);
            match (row / order, column / order) {
                (0, 1) => -entry(&self.imaginary, i, j),
                (1, 0) => entry(&self.imaginary, i, j),
                _ => entry(&self.real, i, j),
            }
        });
        whole.symmetric_eigenvalues().min()
    }
}

/// A m m, A m n and A n n.
struct Blocks<const D: usize> {
    along: SMatrix<f64, D, D>,
    mixed: SMatrix<f64, D, D>,
    across: SMatrix<f64, D, D>,
}

impl<const D: usize> Blocks<D> {
    fn new(elasticity: &Elasticity<D>, normal: &SVector<f64, D>, along: &SVector<f64, D>) -> Self {
        Blocks {
            along: elasticity.contract(along, along),
            mixed: elasticity.contract(along, normal),
            across: elasticity.contract(normal, normal),
        }
    }

    /// The means of T^-1 and T^-1 R^T over half a turn, of this number of steps; `None` if T is not positive definite.
    fn sums(&self, steps: usize, offset: f64) -> Option<[SMatrix<f64, D, D>; 2]> {
        let mut sums = [SMatrix::zeros(); 2];
        for step in 0..steps {
            let angle = std::f64::consts::PI * (step as f64 + offset) / steps as f64;
            let [t, r] = self.turned(angle);
            let inverse = Cholesky::new(t)?.inverse();
            sums[0] += inverse;
            sums[1] += inverse * r.transpose();
        }
        Some(sums.map(|sum| sum / steps as f64))
    }

    /// T and R with m cos a + n sin a in place of m, and n cos a - m sin a in place of n.
    fn turned(&self, angle: f64) -> [SMatrix<f64, D, D>; 2] {
        let (s, c) = angle.sin_cos();
        let mixed = self.mixed;
        let t =
            self.across * (c * c) - (mixed + mixed.transpose()) * (s * c) + self.along * (s * s);
        let r =
            mixed * (c * c) - mixed.transpose() * (s * s) + (self.across - self.along) * (s * c);
        [t, r]
    }
}
