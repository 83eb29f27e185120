//! Mistakes in the stress of the body under any law: measures, transpositions, kinematics.

use mms_runtime::Matrix;
use mms_runtime::tensor::determinant;

use super::{Change, Given, Hypothesis, Known, Of, OfStress, inverse, of_first};
use crate::exact::Exact;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let stress = |of, name, says, change| Hypothesis::fixed(name, says, Change::Stress(of, change));
    let mut all: Vec<Hypothesis<D>> = vec![
        stress(Of::Measure, "stress_transposed", "P^T in place of P", |at, tau| {
            of_first(at, tau, |f, p| p.transpose() * f.transpose());
        }),
        stress(Of::Measure, "stress_second_piola", "S in place of P", |at, tau| {
            of_first(at, tau, |f, p| inverse(f) * p * f.transpose());
        }),
        stress(Of::Measure, "stress_kirchhoff", "tau in place of P", |at, tau| {
            of_first(at, tau, |f, p| p * f.transpose() * f.transpose());
        }),
        stress(Of::Measure, "stress_cauchy", "sigma in place of P", |at, tau| {
            of_first(at, tau, |f, p| p * f.transpose() * f.transpose() / determinant(f));
        }),
        stress(
            Of::Measure,
            "stress_volume",
            "P/J in place of P: sigma with the reference volume",
            |at, tau| {
                of_first(at, tau, |f, p| p * f.transpose() / determinant(f));
            },
        ),
        stress(
            Of::Stress,
            "stress_volume_twice",
            "J P in place of P: tau with the present volume",
            |at, tau| {
                of_first(at, tau, |f, p| p * f.transpose() * determinant(f));
            },
        ),
        stress(Of::Law, "deformation_transposed", "F^T in place of F in the law", |at, tau| {
            let transposed: Vec<_> = at.gradient.iter().map(Matrix::transpose).collect();
            tau.copy_from_slice(&at.exact.stress(at.time, at.reference, &transposed));
        }),
        stress(
            Of::Stress,
            "strain_left",
            "F F^T in place of F^T F: S of the wrong strain",
            |at, tau| {
                let transposed: Vec<_> = at.gradient.iter().map(Matrix::transpose).collect();
                let other = at.exact.stress(at.time, at.reference, &transposed);
                for ((tau, other), h) in tau.iter_mut().zip(other).zip(at.gradient) {
                    let f = h + Matrix::identity();
                    // tau(F^T) = F^T S F.
                    *tau = f * inverse(&f.transpose()) * other * inverse(&f) * f.transpose();
                }
            },
        ),
        Hypothesis::factor(
            "shear_factor",
            "the shear components of the stress times a factor",
            2.0,
            Change::Stress(Of::Stress, |at, tau| {
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
        stress(
            Of::Motion,
            "moduli_at_present",
            "moduli at the present place x in place of X",
            |at, tau| {
                let u = at.exact.displacement(at.time, at.reference);
                let places: Vec<_> = at.reference.iter().zip(&u).map(|(x, u)| x + u).collect();
                tau.copy_from_slice(&at.exact.stress(at.time, &places, at.gradient));
            },
        ),
        Hypothesis::amount(
            "viscosity",
            "additional viscous stresses, as stiffness-proportional damping has: tau + 2 eta D; the size is eta",
            vec![0.01 * wave_modulus(exact) * (exact.domain.time[1] - exact.domain.time[0])],
            Change::Stress(Of::Motion, |at, tau| {
                let pairs = tau.iter_mut().zip(rates(at));
                pairs.for_each(|(tau, rate)| *tau += rate * (2.0 * at.size[0]));
            }),
        )
        .within([0.0, f64::MAX])
        .choice(),
        Hypothesis::<D>::amount(
            "artificial_viscosity",
            "an additional pressure c rho h c0 |div v| where div v < 0, of von Neumann and Richtmyer; the size is c",
            vec![0.5],
            Change::Stress(Of::Motion, |at, tau| {
                let density = at.exact.density(at.reference);
                let mut speed = vec![0.0; tau.len()];
                at.exact.field.wave_speed(at.reference, &mut speed);
                let all = tau.iter_mut().zip(rates(at)).zip(density).zip(speed);
                for (((tau, rate), density), speed) in all {
                    // rho J = rho0.
                    let compression = (-rate.trace()).max(0.0);
                    let pressure = at.size[0] * density * at.exact.cell_size * speed * compression;
                    *tau -= Matrix::identity() * pressure;
                }
            }),
        )
        .within([0.0, f64::MAX])
        .of_mesh()
        .choice(),
    ];
    if D > 1 {
        all.extend(of_components());
    }
    all
}

/// The mistakes in the off-diagonal components of P.
fn of_components<const D: usize>() -> Vec<Hypothesis<D>> {
    let says = "the off-diagonal components of P times a factor";
    let shear: OfStress<D> = |at, tau| {
        let size = at.size[0];
        of_first(at, tau, |f, p| {
            let diagonal = Matrix::from_diagonal(&p.diagonal());
            (diagonal + (p - diagonal) * size) * f.transpose()
        });
    };
    let known =
        |_: &Exact<'_, D>| vec![Known::new(0.5, "shear_half_of_first_piola", "half of them")];
    let factor = Hypothesis::factor(
        "shear_factor_of_first_piola",
        says,
        0.5,
        Change::Stress(Of::Stress, shear),
        known,
    );
    let missing: [(&str, [usize; 2], OfStress<D>); 6] = [
        ("P12", [0, 1], |at, tau| without(at, tau, [0, 1])),
        ("P21", [1, 0], |at, tau| without(at, tau, [1, 0])),
        ("P13", [0, 2], |at, tau| without(at, tau, [0, 2])),
        ("P31", [2, 0], |at, tau| without(at, tau, [2, 0])),
        ("P23", [1, 2], |at, tau| without(at, tau, [1, 2])),
        ("P32", [2, 1], |at, tau| without(at, tau, [2, 1])),
    ];
    let own = missing.into_iter().filter(|(_, [i, j], _)| *i < D && *j < D);
    let missing = own.map(|(which, _, change)| {
        let says = "one component of P is missing";
        Hypothesis::fixed("stress_component_missing", says, Change::Stress(Of::Stress, change))
            .of(which)
    });
    std::iter::once(factor).chain(missing).collect()
}

/// Removes a component of P.
fn without<const D: usize>(at: &Given<'_, D>, tau: &mut [Matrix<f64, D>], [i, j]: [usize; 2]) {
    of_first(at, tau, |f, mut p| {
        p[(i, j)] = 0.0;
        p * f.transpose()
    });
}

/// The stress divided by J, in any measure that a table has.
pub fn over_jacobian<const D: usize>() -> Hypothesis<D> {
    let change = Change::Stress(Of::Stress, |at: &Given<'_, D>, tau: &mut [Matrix<f64, D>]| {
        for (tau, h) in tau.iter_mut().zip(at.gradient) {
            *tau /= determinant(&(h + Matrix::identity()));
        }
    });
    Hypothesis::fixed("stress_volume", "the stress divided by J", change).of("over J")
}

/// D, the symmetric rate of deformation.
fn rates<const D: usize>(at: &Given<'_, D>) -> Vec<Matrix<f64, D>> {
    let rates = at.exact.gradient_rate(at.time, at.reference);
    let all = rates.iter().zip(at.gradient).map(|(rate, h)| {
        let velocity_gradient = rate * inverse(&(h + Matrix::identity()));
        (velocity_gradient + velocity_gradient.transpose()) / 2.0
    });
    all.collect()
}

/// The modulus of compression waves, rho0 c0^2.
fn wave_modulus<const D: usize>(exact: &Exact<'_, D>) -> f64 {
    exact.density(&exact.places()).into_iter().fold(0.0, f64::max) * exact.wave_speed().powi(2)
}
