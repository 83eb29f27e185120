//! The tensor operations that `nalgebra` does not have for vectors and matrices of plain `const D`.

use crate::real::{Matrix, Real, Vector};

/// F = I + H.
pub fn deformation_gradient<T: Real, const D: usize>(
    displacement_gradient: &Matrix<T, D>,
) -> Matrix<T, D> {
    Matrix::identity() + displacement_gradient
}

/// J = det(I + H) for D = 1, 2, 3; other dimensions do not compile.
pub fn jacobian<T: Real, const D: usize>(displacement_gradient: &Matrix<T, D>) -> T {
    determinant(&deformation_gradient(displacement_gradient))
}

/// det F for D = 1, 2, 3; other dimensions do not compile.
pub fn determinant<T: Real, const D: usize>(f: &Matrix<T, D>) -> T {
    const { assert!(D >= 1 && D <= 3, "one to three dimensions") };
    let minor = |i: usize, j: usize| f[(1, i)] * f[(2, j)] - f[(1, j)] * f[(2, i)];
    match D {
        1 => f[(0, 0)],
        2 => f[(0, 0)] * f[(1, 1)] - f[(0, 1)] * f[(1, 0)],
        _ => f[(0, 0)] * minor(1, 2) - f[(0, 1)] * minor(0, 2) + f[(0, 2)] * minor(0, 1),
    }
}

/// F^-1 = (I + H)^-1, or `None` where F is singular or not finite.
pub fn inverse_deformation_gradient<T: Real, const D: usize>(
    displacement_gradient: &Matrix<T, D>,
) -> Option<Matrix<T, D>> {
    inverse(&deformation_gradient(displacement_gradient))
}

/// F^-1 for D = 1, 2, 3, or `None` where F is singular or not finite. The inverse of `nalgebra` would compile code for larger
/// matrices too, for all D.
pub fn inverse<T: Real, const D: usize>(f: &Matrix<T, D>) -> Option<Matrix<T, D>> {
    let determinant = determinant(f);
    let cofactor = |i: usize, j: usize| match D {
        1 => T::one(),
        2 if i == j => f[(1 - i, 1 - j)],
        2 => -f[(j, i)],
        // Rows and columns are cyclic, so that no sign changes.
        _ => {
            let ([i1, i2], [j1, j2]) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
            f[(i1, j1)] * f[(i2, j2)] - f[(i1, j2)] * f[(i2, j1)]
        }
    };
    let inverse = Matrix::from_fn(|i, j| cofactor(j, i) / determinant);
    Some(inverse).filter(matrix_is_finite)
}

/// cof F = J F^-T, or `None` where F = I + H is singular or not finite.
pub fn cofactor<T: Real, const D: usize>(
    displacement_gradient: &Matrix<T, D>,
) -> Option<Matrix<T, D>> {
    let inverse = inverse_deformation_gradient(displacement_gradient)?;
    Some(inverse.transpose() * jacobian(displacement_gradient))
}

/// Whether every component is finite.
pub fn is_finite<T: Real, const D: usize>(vector: &Vector<T, D>) -> bool {
    vector.iter().all(|component| component.is_finite())
}

/// Whether every component of a matrix is finite.
pub fn matrix_is_finite<T: Real, const D: usize>(matrix: &Matrix<T, D>) -> bool {
    matrix.iter().all(|component| component.is_finite())
}

/// The components in double precision.
pub(crate) fn components<T: Real, const D: usize>(vector: &Vector<T, D>) -> Vec<f64> {
    vector.iter().map(|component| component.to_f64()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jacobian_is_the_determinant() {
        assert_eq!(jacobian(&Matrix::<f64, 1>::new(0.25)), 1.25);
        assert_eq!(jacobian(&Matrix::<f64, 2>::new(1.0, 2.0, 3.0, 4.0)), 4.0);
        let h = Matrix::<f64, 3>::new(1.0, 2.0, 0.5, -1.0, 3.0, 4.0, 2.0, 0.0, 1.0);
        let exact = (Matrix::<f64, 3>::identity() + h).determinant();
        assert!((jacobian(&h) - exact).abs() < 1e-13);
    }

    fn the_inverse_has_the_bits_of<const D: usize>(f: &Matrix<f64, D>) {
        assert_eq!(inverse(f), f.try_inverse());
        assert_eq!(
            inverse(&f.map(|entry| entry as f32)),
            f.map(|entry| entry as f32).try_inverse()
        );
    }

    #[test]
    fn the_inverse_is_that_of_nalgebra() {
        the_inverse_has_the_bits_of(&Matrix::<f64, 1>::new(0.3));
        the_inverse_has_the_bits_of(&Matrix::<f64, 2>::new(1.1, 0.2, -0.7, 0.9));
        the_inverse_has_the_bits_of(&Matrix::<f64, 3>::new(
            1.1, 0.2, -0.7, 0.3, 0.9, 0.15, -0.25, 0.45, 1.3,
        ));
    }

    #[test]
    fn a_singular_deformation_has_no_inverse() {
        assert!(inverse_deformation_gradient(&Matrix::<f64, 1>::new(-1.0)).is_none());
        assert!(inverse_deformation_gradient(&Matrix::<f64, 1>::new(f64::NAN)).is_none());
    }
}
