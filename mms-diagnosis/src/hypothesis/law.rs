//! Mistakes in the law and its moduli.

use mms_runtime::Matrix;

use super::{Change, Given, Hypothesis, HypothesisKind, Known, Of, OfStress};
use crate::exact::Exact;
use crate::law::{LAWS, PublishedLaw};

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let mut all = vec![Hypothesis::factor(
        "moduli_factor",
        "the stress times a factor",
        1.3,
        Change::Stress(Of::Law, |at, tau| tau.iter_mut().for_each(|tau| *tau *= at.size[0])),
        |_| {
            let missing = Known::new(0.0, "stress_missing", "the stress is missing");
            [vec![missing], units()].concat()
        },
    )];
    if exact.law.is_some() {
        all.extend(of_moduli());
    }
    if exact.moduli(&exact.places()).is_some() {
        all.extend(other_laws(exact));
    }
    all
}

/// The mistakes in lambda and mu.
fn of_moduli<const D: usize>() -> [Hypothesis<D>; 3] {
    [
        Hypothesis::factor(
            "lambda_factor",
            "lambda times a factor",
            1.3,
            Change::Stress(Of::Law, |at, tau| {
                with_moduli(at, tau, |[lambda, mu], size| [size * lambda, mu])
            }),
            |exact| {
                let mut known =
                    vec![Known::new(0.0, "lambda_missing", "the term of lambda is missing")];
                let Some([lambda, mu]) = exact.uniform_moduli() else { return known };
                let [young, nu] = young_and_poisson([lambda, mu]);
                let others = [
                    (lambda + 2.0 / 3.0 * mu, "lambda_bulk", "the bulk modulus K given as lambda"),
                    (
                        2.0 * lambda * mu / (lambda + 2.0 * mu),
                        "lambda_plane_stress",
                        "lambda of plane stress",
                    ),
                    (
                        lambda + 2.0 * mu,
                        "lambda_wave",
                        "the modulus of compression waves given as lambda",
                    ),
                    (young, "lambda_young", "Young's modulus given as lambda"),
                    (
                        young * nu / (1.0 - 2.0 * nu),
                        "lambda_conversion",
                        "E nu/(1 - 2 nu), without 1 + nu, given as lambda",
                    ),
                    (
                        young / ((1.0 + nu) * (1.0 - 2.0 * nu)),
                        "lambda_conversion",
                        "E/((1 + nu) (1 - 2 nu)), without nu, given as lambda",
                    ),
                ];
                known.extend(others.map(|(is, name, says)| Known::new(is / lambda, name, says)));
                known
            },
        ),
        Hypothesis::factor(
            "mu_factor",
            "mu times a factor",
            1.3,
            Change::Stress(Of::Law, |at, tau| {
                with_moduli(at, tau, |[lambda, mu], size| [lambda, size * mu])
            }),
            |exact| {
                let mut known = vec![
                    Known::new(0.0, "mu_missing", "the term of mu is missing"),
                    Known::new(2.0, "mu_twice", "2 mu given as mu"),
                    Known::new(0.5, "mu_half", "half of mu"),
                ];
                if let Some([lambda, mu]) = exact.uniform_moduli() {
                    let [young, nu] = young_and_poisson([lambda, mu]);
                    known.push(Known::new(young / mu, "mu_young", "Young's modulus given as mu"));
                    let says = "E/2, without 1 + nu, given as mu";
                    known.push(Known::new(1.0 + nu, "mu_conversion", says));
                }
                known
            },
        ),
        Hypothesis::fixed(
            "moduli_swapped",
            "lambda and mu are swapped",
            Change::Stress(Of::Law, |at, tau| with_moduli(at, tau, |[lambda, mu], _| [mu, lambda])),
        ),
    ]
}

/// E and nu.
fn young_and_poisson([lambda, mu]: [f64; 2]) -> [f64; 2] {
    [mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu), lambda / (2.0 * (lambda + mu))]
}

/// Published laws with the same moduli at rest that are not the field's own.
fn other_laws<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let own = exact.law.map(|law| law.name);
    let all: [OfStress<D>; LAWS.len()] = [
        of_law::<D, 0>,
        of_law::<D, 1>,
        of_law::<D, 2>,
        of_law::<D, 3>,
        of_law::<D, 4>,
        of_law::<D, 5>,
        of_law::<D, 6>,
        of_law::<D, 7>,
        of_law::<D, 8>,
        of_law::<D, 9>,
    ];
    let others = LAWS.iter().zip(all).filter(|(law, _)| own != Some(law.name));
    let hypothesis = |(law, change): (&PublishedLaw, _)| {
        let is_linear = law.name == "linear_elastic";
        let (name, says) = if is_linear {
            ("stress_small_strain", "the linear law of small strains")
        } else {
            ("material", "another W with the same moduli at rest")
        };
        let kind = if is_linear { HypothesisKind::Mistake } else { HypothesisKind::Choice };
        let which = (!is_linear).then_some(law.name.into());
        Hypothesis { kind, which, ..Hypothesis::fixed(name, says, Change::Stress(Of::Law, change)) }
    };
    others.map(hypothesis).collect()
}

fn of_law<const D: usize, const K: usize>(at: &Given<'_, D>, tau: &mut [Matrix<f64, D>]) {
    let Some(moduli) = at.exact.moduli(at.reference) else { return };
    for ((tau, h), moduli) in tau.iter_mut().zip(at.gradient).zip(moduli) {
        let own = at.exact.law.map_or(*tau, |law| law.stress(moduli, h));
        *tau += LAWS[K].stress(moduli, h) - own;
    }
}

/// Computes each tau with other moduli. Keeps the contributions of given fields, such as a temperature.
fn with_moduli<const D: usize>(
    at: &Given<'_, D>,
    tau: &mut [Matrix<f64, D>],
    other: fn([f64; 2], f64) -> [f64; 2],
) {
    let (Some(law), Some(moduli)) = (at.exact.law, at.exact.moduli(at.reference)) else { return };
    let size = at.size.first().copied().unwrap_or(1.0);
    for ((tau, h), moduli) in tau.iter_mut().zip(at.gradient).zip(moduli) {
        let [other, own] = law.stresses([other(moduli, size), moduli], h);
        *tau += other - own;
    }
}

/// Factors of units.
pub(super) fn units() -> Vec<Known> {
    let power =
        |power: i32| Known::new(10f64.powi(power), "units", format!("another unit: 10^{power}"));
    [-9, -6, -3, -2, -1, 1, 2, 3, 6, 9].map(power).to_vec()
}
