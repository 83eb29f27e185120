//! Least eigenvalues of pairs of matrices.

use mms_stability::pencil::Pencil;
use nalgebra::{DMatrix, DVector};

/// An excluded vector need not be an eigenvector. The least eigenvalue is then an eigenvalue of the matrix between projections
/// onto the other vectors.
#[test]
fn vectors_are_set_apart_that_are_no_eigenvectors() {
    let stiffness = DMatrix::from_fn(5, 5, |row, column| match row.abs_diff(column) {
        0 => row as f64 - 1.0,
        1 => 0.7,
        _ => 0.0,
    });
    let apart = DVector::from_vec(vec![0.5, -0.1, 0.5, 0.5, 0.7]).normalize();
    let onto = DMatrix::identity(5, 5) - &apart * apart.transpose();
    let values = (&onto * &stiffness * &onto).symmetric_eigenvalues();
    let expected = values.min();
    let pencil = Pencil { stiffness, mass: DMatrix::identity(5, 5) };
    let found = pencil.least(&[apart], 0.1).expect("something is left");
    assert!(expected < -0.1 && (found - expected).abs() < 1e-6, "{found} {expected}");
}
