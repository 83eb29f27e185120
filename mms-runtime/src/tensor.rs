//! The few tensor operations that the vectors and matrices of `nalgebra` do not offer for plain
//! `const D`.

use crate::{Matrix, Real, Vector};

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
    deformation_gradient(displacement_gradient).try_inverse().filter(matrix_is_finite)
}

/// cof F = J F^-T, or `None` where F = I + H is singular or not finite.
pub fn cofactor<T: Real, const D: usize>(
    displacement_gradient: &Matrix<T, D>,
) -> Option<Matrix<T, D>> {
    let inverse = inverse_deformation_gradient(displacement_gradient)?;
    Some(inverse.transpose() * jacobian(displacement_gradient))
}

/// How many iterations find a rotation; each doubles the digits.
const POLAR_ITERATIONS: usize = 20;

/// The diagonal of the right stretch tensor U of F = I + H = R U, or `None` where F is singular or not finite.
///
/// U^2 = C = F^T F. Where C is diagonal but for e, U_aa is sqrt(C_aa) but for e^2, which is nothing if that is
/// less than round-off. Otherwise R is the limit of (R + R^-T)/2 from R = F (Higham, "Computing the polar
/// decomposition, with applications", SIAM J. Sci. Stat. Comput. 7 (1986)). A diagonal F is its own stretch.
pub fn stretch_along_axes<T: Real, const D: usize>(
    displacement_gradient: &Matrix<T, D>,
) -> Option<Vector<T, D>> {
    let f = deformation_gradient(displacement_gradient);
    if f == Matrix::from_diagonal(&f.diagonal()) {
        return Some(f.diagonal());
    }
    let c = f.tr_mul(&f);
    let squares = c.diagonal();
    let mut aside = T::zero();
    for a in 0..D {
        for b in 0..a {
            aside = aside.max(c[(a, b)] * c[(a, b)] / (squares[a] * squares[b]));
        }
    }
    if aside <= T::default_epsilon() {
        return Some(squares.map(nalgebra::ComplexField::sqrt)).filter(is_finite);
    }
    let mut rotation = f;
    for _ in 0..POLAR_ITERATIONS {
        let next = (rotation + rotation.try_inverse()?.transpose()) * T::ratio(1, 2);
        let change = (next - rotation).amax();
        rotation = next;
        // What is left is the square of that.
        if change * change <= T::default_epsilon() {
            break;
        }
    }
    Some(rotation.tr_mul(&f).diagonal()).filter(is_finite)
}

/// Whether every component is finite.
pub fn is_finite<T: Real, const D: usize>(vector: &Vector<T, D>) -> bool {
    vector.iter().all(|component| component.is_finite())
}

/// Whether every component is finite.
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

    #[test]
    fn stretches_are_roots() {
        // U by the iteration of Denman and Beavers (1976), whatever is beside the diagonal.
        for aside in [1.0, 1e-3, 1e-7, 1e-9, 1e-20] {
            let h = Matrix::<f64, 3>::new(0.2, 1.5, -0.3, -0.9, 0.4, 0.1, 0.2, 0.0, -0.2);
            let h = h.map_with_location(|i, j, value| if i == j { value } else { value * aside });
            let f = deformation_gradient(&h);
            let (mut u, mut inverse) = (f.tr_mul(&f), Matrix::<f64, 3>::identity());
            for _ in 0..20 {
                let [next, other] = [inverse, u].map(|m| m.try_inverse().unwrap());
                (u, inverse) = ((u + next) * 0.5, (inverse + other) * 0.5);
            }
            let found = stretch_along_axes(&h).unwrap();
            assert!((found - u.diagonal()).amax() < 4e-15, "{aside}: {found}");
            // A body a thousand times smaller is stretched alike; F/1024 - I has lost three digits of F.
            let small = f / 1024.0 - Matrix::identity();
            let smaller = stretch_along_axes(&small).unwrap() * 1024.0;
            assert!((smaller - found).amax() < 1e-12, "{aside}: {smaller}");
        }
        assert!(stretch_along_axes(&Matrix::<f64, 2>::new(0.0, 1.0, 1.0, 0.0)).is_none());
        assert!(stretch_along_axes(&Matrix::<f64, 2>::repeat(f64::NAN)).is_none());
    }

    #[test]
    fn a_singular_deformation_has_no_inverse() {
        assert!(inverse_deformation_gradient(&Matrix::<f64, 1>::new(-1.0)).is_none());
        assert!(inverse_deformation_gradient(&Matrix::<f64, 1>::new(f64::NAN)).is_none());
    }
}
