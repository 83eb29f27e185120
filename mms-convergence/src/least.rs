//! Linear least squares with few unknowns, and their uncertainties.

use crate::student::quantile;

/// The unknowns that minimise the sum of squares.
pub(crate) struct Solution<const K: usize> {
    pub unknowns: [f64; K],
    /// The remaining sum of squares.
    pub left: f64,
    /// The diagonal of the inverse of the normal equations: variances relative to the variance of a row.
    variances: [f64; K],
    freedom: usize,
}

impl<const K: usize> Solution<K> {
    /// Half the interval of an unknown that excludes it with this probability (Student's t); infinite without a degree of
    /// freedom.
    pub fn reach(&self, which: usize, outside: f64) -> f64 {
        if self.freedom == 0 {
            return f64::INFINITY;
        }
        let variance = self.left / self.freedom as f64;
        quantile(outside, self.freedom) * self.deviation(which, variance)
    }

    /// The standard deviation of an unknown, if rows have this variance.
    pub fn deviation(&self, which: usize, variance: f64) -> f64 {
        (variance * self.variances[which]).sqrt()
    }
}

/// The factors of the unknowns, and the right-hand side.
pub(crate) type Equation<const K: usize> = ([f64; K], f64);

/// Solves sum_k row_k unknown_k = right in the least-squares sense; `None` if the rows do not determine it.
pub(crate) fn solve<const K: usize>(rows: &[Equation<K>]) -> Option<Solution<K>> {
    let sum = |term: &dyn Fn(&Equation<K>) -> f64| rows.iter().map(term).sum::<f64>();
    let size: [f64; K] = std::array::from_fn(|i| sum(&|(row, _)| row[i] * row[i]).sqrt());
    let normal: [[f64; K]; K] = std::array::from_fn(|i| {
        std::array::from_fn(|j| sum(&|(row, _)| row[i] / size[i] * row[j] / size[j]))
    });
    let inverse = inverse(normal)?;
    let right: [f64; K] = std::array::from_fn(|i| sum(&|(row, b)| row[i] / size[i] * b));
    let unknown = |i: usize| (0..K).map(|j| inverse[i][j] * right[j]).sum::<f64>() / size[i];
    let unknowns: [f64; K] = std::array::from_fn(unknown);
    let residual = |(row, b): &Equation<K>| {
        let value: f64 = row.iter().zip(&unknowns).map(|(a, u)| a * u).sum();
        (value - b).powi(2)
    };
    let left = sum(&residual);
    let variances = std::array::from_fn(|i| inverse[i][i] / (size[i] * size[i]));
    let freedom = rows.len().checked_sub(K)?;
    let is_sound = left.is_finite() && unknowns.iter().all(|it| it.is_finite());
    is_sound.then_some(Solution { unknowns, left, variances, freedom })
}

/// Inverts a positive definite matrix with ones on its diagonal by Gauss-Jordan elimination.
fn inverse<const K: usize>(mut matrix: [[f64; K]; K]) -> Option<[[f64; K]; K]> {
    let mut inverse = [[0.0; K]; K];
    for (i, row) in inverse.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for i in 0..K {
        let pivot = matrix[i][i];
        if pivot.is_nan() || pivot < 1e-13 {
            return None;
        }
        for j in 0..K {
            matrix[i][j] /= pivot;
            inverse[i][j] /= pivot;
        }
        for k in (0..K).filter(|&k| k != i) {
            let factor = matrix[k][i];
            for j in 0..K {
                matrix[k][j] -= factor * matrix[i][j];
                inverse[k][j] -= factor * inverse[i][j];
            }
        }
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line through five points, by hand.
    #[test]
    fn a_line_and_its_intervals_are_those_on_paper() {
        let heights = [1.0, 3.2, 4.8, 7.1, 8.9];
        let rows: Vec<_> = (0..5).map(|k| ([1.0, f64::from(k)], heights[k as usize])).collect();
        let found = solve(&rows).expect("a line");
        assert!((found.unknowns[1] - 1.97).abs() < 1e-12, "{:?}", found.unknowns);
        assert!((found.unknowns[0] - 1.06).abs() < 1e-12);
        // sum of squares 0.091; variance of the slope a third of that over 10; t of three degrees 3.18245.
        assert!((found.left - 0.091).abs() < 1e-12, "{}", found.left);
        assert!((found.reach(1, 0.05) - 3.18245 * (0.091f64 / 30.0).sqrt()).abs() < 1e-5);
    }

    #[test]
    fn what_is_not_determined_has_no_solution() {
        assert!(solve(&[([1.0, 2.0], 1.0), ([2.0, 4.0], 2.0), ([3.0, 6.0], 3.0)]).is_none());
        assert!(solve(&[([1.0, 2.0], 1.0)]).is_none());
        let exact = solve(&[([1.0, 0.0], 1.0), ([0.0, 1.0], 2.0)]).expect("a solution");
        assert_eq!(exact.reach(0, 0.05), f64::INFINITY);
    }
}
