//! Error norms of the displacement.

use crate::{Real, Vector};

/// Norms of delta_p = |d_p - u(X_p, t)| over the particles; of a run, the largest over its steps.
///
/// Lengths, in the unit of the field. Computed in double precision whatever the solver's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// mean_p delta_p.
    pub l1: f64,
    /// sqrt(mean_p delta_p^2).
    pub l2: f64,
    /// max_p delta_p.
    pub linf: f64,
}

impl Errors {
    /// The norms of `displacement` against the `exact` one, both with one entry per particle; or the
    /// first particle whose error is not finite.
    pub fn of<T: Real, const D: usize>(
        displacement: &[Vector<T, D>],
        exact: &[Vector<T, D>],
    ) -> Result<Self, usize> {
        let (mut sum, mut sum_of_squares, mut largest) = (0.0, 0.0, 0.0_f64);
        for (p, (d, u)) in displacement.iter().zip(exact).enumerate() {
            let square: f64 = (0..D).map(|a| (d[a].to_f64() - u[a].to_f64()).powi(2)).sum();
            if !square.is_finite() {
                return Err(p);
            }
            sum += square.sqrt();
            sum_of_squares += square;
            largest = largest.max(square.sqrt());
        }
        let count = displacement.len().max(1) as f64;
        Ok(Self { l1: sum / count, l2: (sum_of_squares / count).sqrt(), linf: largest })
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
        let errors = Errors::of(&one, &zero).unwrap();
        assert_eq!(errors, Errors { l1: 2.5, l2: 12.5f64.sqrt(), linf: 5.0 });
    }

    #[test]
    fn not_a_number_is_seen() {
        let zero = [Vector::<f64, 1>::zeros(); 3];
        let odd = [0.0, f64::NAN, 1.0].map(Vector::<f64, 1>::new);
        assert_eq!(Errors::of(&odd, &zero), Err(1));
    }
}
