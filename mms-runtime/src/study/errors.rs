//! Error norms.

use serde::{Deserialize, Serialize};

use crate::real::{Matrix, Real, Vector};

/// Norms over the particles of the distance between a computed and an exact value, such as delta_p = |d_p - u(X_p, t)|; for a
/// run, the largest over its steps. In the unit of the quantity, computed in double precision for all solvers. Means over a
/// body of revolution are weighted with the volumes of the rings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// mean_p delta_p.
    pub l1: f64,
    /// sqrt(mean_p delta_p^2).
    pub l2: f64,
    /// max_p delta_p.
    pub linf: f64,
}

impl Errors {
    /// The norms of `computed` against `exact` vectors, both with one entry per particle; or the first particle whose error is
    /// not finite. Without `weights`, all particles have the same weight.
    pub fn of<T: Real, const D: usize>(
        computed: impl ExactSizeIterator<Item = Vector<T, D>>,
        exact: &[Vector<T, D>],
        weights: Option<&[T]>,
    ) -> Result<Self, usize> {
        let square = |(a, b): (Vector<T, D>, &Vector<T, D>)| {
            a.iter().zip(b).map(|(a, b)| (a.to_f64() - b.to_f64()).powi(2)).sum()
        };
        Self::of_squares(computed.zip(exact).map(square), weights)
    }

    /// The norms of the errors of tensors, in the Frobenius norm, including the component around the axis if there is one.
    pub fn of_tensors<T: Real, const D: usize>(
        (computed, computed_hoop): (&[Matrix<T, D>], &[T]),
        (exact, exact_hoop): (&[Matrix<T, D>], &[T]),
        weights: Option<&[T]>,
    ) -> Result<Self, usize> {
        let square = |p: usize| {
            let apart = |(a, b): (&T, &T)| (a.to_f64() - b.to_f64()).powi(2);
            let hoop = computed_hoop.get(p).zip(exact_hoop.get(p)).map_or(0.0, apart);
            computed[p].iter().zip(&exact[p]).map(apart).sum::<f64>() + hoop
        };
        Self::of_squares((0..computed.len()).map(square), weights)
    }

    fn of_squares<T: Real>(
        squares: impl ExactSizeIterator<Item = f64>,
        weights: Option<&[T]>,
    ) -> Result<Self, usize> {
        let count = squares.len().max(1) as f64;
        let total = weights.map(|all| all.iter().map(|weight| weight.to_f64()).sum::<f64>());
        let (mut sum, mut sum_of_squares, mut largest) = (0.0, 0.0, 0.0_f64);
        for (p, square) in squares.enumerate() {
            if !square.is_finite() {
                return Err(p);
            }
            let weight = weights.map_or(1.0, |weights| weights[p].to_f64());
            sum += weight * square.sqrt();
            sum_of_squares += weight * square;
            largest = largest.max(square.sqrt());
        }
        let total = total.unwrap_or(count);
        Ok(Self { l1: sum / total, l2: (sum_of_squares / total).sqrt(), linf: largest })
    }

    /// The larger of each norm; all of them are finite.
    pub fn larger(&self, other: &Self) -> Self {
        Self {
            l1: self.l1.max(other.l1),
            l2: self.l2.max(other.l2),
            linf: self.linf.max(other.linf),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_of_a_known_error() {
        let zero = [Vector::<f32, 2>::zeros(); 2];
        let one = [Vector::<f32, 2>::new(3.0, 4.0), Vector::zeros()];
        let errors = Errors::of(one.into_iter(), &zero, None).unwrap();
        assert_eq!(errors, Errors { l1: 2.5, l2: 12.5f64.sqrt(), linf: 5.0 });
        let errors = Errors::of(one.into_iter(), &zero, Some(&[1.0, 3.0])).unwrap();
        assert_eq!(errors, Errors { l1: 1.25, l2: 2.5, linf: 5.0 });
    }

    #[test]
    fn not_a_number_is_seen() {
        let zero = [Vector::<f64, 1>::zeros(); 3];
        let odd = [0.0, f64::NAN, 1.0].map(Vector::<f64, 1>::new);
        assert_eq!(Errors::of(odd.into_iter(), &zero, None), Err(1));
    }
}
