//! Mistakes in the stress of the body, whatever the law: measures, transpositions, kinematics.

use mms_runtime::Matrix;
use mms_runtime::tensor::determinant;

use super::{Change, Hypothesis, Known, inverse, of_first};

pub(super) fn all<const D: usize>() -> Vec<Hypothesis<D>> {
    let stress = |name, says, change| Hypothesis::fixed(name, says, Change::Stress(change));
    vec![
        stress("stress_transposed", "P^T in place of P", |at, tau| {
            of_first(at, tau, |f, p| p.transpose() * f.transpose());
        }),
        stress("stress_second_piola", "S in place of P", |at, tau| {
            of_first(at, tau, |f, p| inverse(f) * p * f.transpose());
        }),
        stress("stress_kirchhoff", "tau in place of P", |at, tau| {
            of_first(at, tau, |f, p| p * f.transpose() * f.transpose());
        }),
        stress("stress_cauchy", "sigma in place of P", |at, tau| {
            of_first(at, tau, |f, p| p * f.transpose() * f.transpose() / determinant(f));
        }),
        stress("stress_volume", "P/J in place of P: sigma with the reference volume", |at, tau| {
            of_first(at, tau, |f, p| p * f.transpose() / determinant(f));
        }),
        stress(
            "stress_volume_twice",
            "J P in place of P: tau with the present volume",
            |at, tau| {
                of_first(at, tau, |f, p| p * f.transpose() * determinant(f));
            },
        ),
        stress("deformation_transposed", "F^T in place of F in the law", |at, tau| {
            let transposed: Vec<_> = at.gradient.iter().map(Matrix::transpose).collect();
            tau.copy_from_slice(&at.exact.stress(at.reference, &transposed));
        }),
        stress("strain_left", "F F^T in place of F^T F: S of the wrong strain", |at, tau| {
            let transposed: Vec<_> = at.gradient.iter().map(Matrix::transpose).collect();
            let other = at.exact.stress(at.reference, &transposed);
            for ((tau, other), h) in tau.iter_mut().zip(other).zip(at.gradient) {
                let f = h + Matrix::identity();
                // tau(F^T) = F^T S F.
                *tau = f * inverse(&f.transpose()) * other * inverse(&f) * f.transpose();
            }
        }),
        Hypothesis::factor(
            "shear_factor",
            "the shear components of the stress times a factor",
            2.0,
            Change::Stress(|at, tau| {
                for tau in tau {
                    let diagonal = Matrix::from_diagonal(&tau.diagonal());
                    *tau = diagonal + (*tau - diagonal) * at.size[0];
                }
            }),
            |_| {
                vec![
                    Known::new(
                        2.0,
                        "shear_twice",
                        "engineering shear strains taken as components of the tensor",
                    ),
                    Known::new(
                        0.5,
                        "shear_half",
                        "components of the tensor taken as engineering shear strains",
                    ),
                    Known::new(0.0, "shear_missing", "the shear components are missing"),
                ]
            },
        ),
        stress("moduli_at_present", "moduli at the present place x in place of X", |at, tau| {
            let u = at.exact.displacement(at.time, at.reference);
            let places: Vec<_> = at.reference.iter().zip(&u).map(|(x, u)| x + u).collect();
            tau.copy_from_slice(&at.exact.stress(&places, at.gradient));
        }),
    ]
}
