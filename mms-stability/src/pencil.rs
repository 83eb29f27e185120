//! The least eigenvalue of K v = w^2 M v with symmetric K and positive definite M.

use nalgebra::{Cholesky, DMatrix, DVector};

/// How many vectors a Krylov space has at most.
const VECTORS: usize = 40;

/// An eigenvalue that another vector changes by less than this part of the shift is found.
const CONVERGED: f64 = 1e-6;

/// How often a shift is tried, four times as large each time.
const SHIFTS: usize = 40;

/// Stiffness and mass.
#[derive(Clone, Debug)]
pub struct Pencil {
    /// K.
    pub stiffness: DMatrix<f64>,
    /// M.
    pub mass: DMatrix<f64>,
}

impl Pencil {
    /// The least eigenvalue over all vectors that are M-orthogonal to the given ones, which are M-orthonormal. A shift of
    /// the size of the least eigenvalues, `near`, is cheapest. `None` where there is no such vector.
    ///
    /// K + s M is factored, with s so great that it is positive definite; the greatest eigenvalues of its inverse times M are
    /// those sought (Lanczos 1950, with full orthogonalisation; Ericsson & Ruhe, Math. Comp. 35, 1980).
    pub fn least(&self, apart: &[DVector<f64>], near: f64) -> Option<f64> {
        let order = self.mass.nrows();
        if apart.len() >= order {
            return None;
        }
        let mut shifts = (0..SHIFTS as i32).map(|power| near * 4.0_f64.powi(power));
        let (shift, factor) = shifts.find_map(|shift| {
            Some((shift, Cholesky::new(&self.stiffness + &self.mass * shift)?))
        })?;
        let mut known = apart.to_vec();
        let mut vector = self.normal(start(order), &known)?;
        let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
        let mut least = f64::INFINITY;
        for _ in 0..VECTORS.min(order - apart.len()) {
            let image = factor.solve(&(&self.mass * &vector));
            diagonal.push(image.dot(&(&self.mass * &vector)));
            known.push(vector);
            let found = 1.0 / largest(&diagonal, &beside) - shift;
            let change = least - found;
            least = found;
            let Some(next) = self.normal(image.clone(), &known) else { break };
            if change.abs() <= CONVERGED * shift.max(found.abs()) {
                break;
            }
            beside.push(image.dot(&(&self.mass * &next)));
            vector = next;
        }
        Some(least)
    }

    /// A vector less its parts along others, of length 1 in M; `None` where nothing is left.
    pub fn normal(&self, mut vector: DVector<f64>, known: &[DVector<f64>]) -> Option<DVector<f64>> {
        let whole = vector.dot(&(&self.mass * &vector)).sqrt();
        // Once more for what rounding leaves of the parts.
        for _ in 0..2 {
            for other in known {
                let part = vector.dot(&(&self.mass * other));
                vector.axpy(-part, other, 1.0);
            }
        }
        let length = vector.dot(&(&self.mass * &vector)).sqrt();
        (length > 1e-10 * whole).then(|| vector / length)
    }
}

/// The largest eigenvalue of a symmetric tridiagonal matrix.
fn largest(diagonal: &[f64], beside: &[f64]) -> f64 {
    let matrix = DMatrix::from_fn(diagonal.len(), diagonal.len(), |row, column| {
        match row.abs_diff(column) {
            0 => diagonal[row],
            1 => beside[row.min(column)],
            _ => 0.0,
        }
    });
    matrix.symmetric_eigenvalues().max()
}

/// A vector that no symmetry of a body leaves without a part along an eigenvector.
fn start(order: usize) -> DVector<f64> {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    DVector::from_fn(order, |row, _| ((row + 1) as f64 * golden).fract() - 0.4)
}
