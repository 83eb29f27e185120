//! The least eigenvalue of K v = w^2 M v with symmetric K and positive definite M.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// The largest number of vectors of a Krylov space.
const VECTORS: usize = 40;

/// An eigenvalue is converged if another vector changes it by less than this fraction of the shift.
const CONVERGED: f64 = 1e-6;

/// The number of shifts that are tried, each four times as large as the previous one.
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
    /// The least eigenvalue over all vectors that are M-orthogonal to the given ones, which are M-orthonormal. A shift of the
    /// size of the least eigenvalues, `near`, is cheapest. `None` if there is no such vector.
    ///
    /// K + s M is factored, with s so large that it is positive definite; the largest eigenvalues of its inverse on these
    /// vectors, times M, determine the least eigenvalues (Lanczos 1950, with full orthogonalisation; Ericsson & Ruhe, Math.
    /// Comp. 35, 1980).
    pub fn least(&self, apart: &[DVector<f64>], near: f64) -> Option<f64> {
        let order = self.mass.nrows();
        if apart.len() >= order {
            return None;
        }
        let mut shifts = (0..SHIFTS as i32).map(|power| near * 4.0_f64.powi(power));
        let (shift, factor) = shifts.find_map(|shift| {
            Some((shift, Cholesky::new(&self.stiffness + &self.mass * shift)?))
        })?;
        let inverse = Inverse::new(factor, &self.mass, apart)?;
        let mut known = apart.to_vec();
        let mut vector = self.normal(start(order), &known)?;
        let mut heavy = &self.mass * &vector;
        let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
        let mut least = f64::INFINITY;
        for _ in 0..VECTORS.min(order - apart.len()) {
            let image = inverse.of(&heavy);
            diagonal.push(image.dot(&heavy));
            known.push(vector);
            let found = 1.0 / largest(&diagonal, &beside) - shift;
            let change = least - found;
            least = found;
            let Some(next) = self.normal(image.clone(), &known) else { break };
            if change.abs() <= CONVERGED * shift.max(found.abs()) {
                break;
            }
            heavy = &self.mass * &next;
            beside.push(image.dot(&heavy));
            vector = next;
        }
        Some(least)
    }

    /// A vector minus its parts along others, of length 1 in M; `None` if the remainder is 0.
    pub fn normal(&self, mut vector: DVector<f64>, known: &[DVector<f64>]) -> Option<DVector<f64>> {
        let mut heavy = &self.mass * &vector;
        let whole = vector.dot(&heavy).sqrt();
        // Twice, to remove the rounding of the first time.
        for _ in 0..2 {
            let parts: Vec<_> = known.iter().map(|other| other.dot(&heavy)).collect();
            known.iter().zip(parts).for_each(|(other, part)| vector.axpy(-part, other, 1.0));
            heavy = &self.mass * &vector;
        }
        let length = vector.dot(&heavy).sqrt();
        (length > 1e-10 * whole).then(|| vector / length)
    }
}

/// The inverse of a matrix on the vectors that are M-orthogonal to some others: a multiplier for each of these constrains the
/// solution.
struct Inverse {
    factor: Cholesky<f64, Dyn>,
    /// M times the constraint vectors, the inverse times that, and the matrix of the multipliers.
    constraints: DMatrix<f64>,
    moved: DMatrix<f64>,
    multipliers: Cholesky<f64, Dyn>,
}

impl Inverse {
    fn new(
        factor: Cholesky<f64, Dyn>,
        mass: &DMatrix<f64>,
        apart: &[DVector<f64>],
    ) -> Option<Self> {
        let constraints = match apart {
            [] => DMatrix::zeros(mass.nrows(), 0),
            _ => mass * DMatrix::from_columns(apart),
        };
        let moved = factor.solve(&constraints);
        let multipliers = Cholesky::new(constraints.tr_mul(&moved))?;
        Some(Inverse { factor, constraints, moved, multipliers })
    }

    fn of(&self, vector: &DVector<f64>) -> DVector<f64> {
        let free = self.factor.solve(vector);
        let multipliers = self.multipliers.solve(&self.constraints.tr_mul(&free));
        free - &self.moved * multipliers
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

/// A vector that has a part along every eigenvector for all symmetries of a body.
fn start(order: usize) -> DVector<f64> {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    DVector::from_fn(order, |row, _| ((row + 1) as f64 * golden).fract() - 0.4)
}
