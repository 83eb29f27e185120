//! A material at F = I: the moduli to use in another code.

use mms_codegen::compile::Compiled;
use mms_spec::Space;

use crate::elasticity::Elasticity;
use crate::subject::{Formulas, Resting, Subject};

/// A tangent that differs from an isotropic one by less than this fraction is isotropic.
pub(crate) const ISOTROPIC: f64 = 1e-9;

/// The material of a field at F = I.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The material in the middle of the body.
    pub middle: Resting,
    /// Whether the material in a corner differs.
    pub is_graded: bool,
}

impl Material {
    /// The material of a compiled field at rest; `None` if it is not finite, or the field is axisymmetric.
    pub fn of(compiled: &Compiled) -> Option<Self> {
        let formulas = Formulas::new(compiled);
        match compiled.field.space {
            Space::Axisymmetric { .. } => None,
            Space::Cartesian(1) => Self::of_subject(&mut Subject::<1>::new(compiled, &formulas)),
            Space::Cartesian(2) => Self::of_subject(&mut Subject::<2>::new(compiled, &formulas)),
            Space::Cartesian(_) => Self::of_subject(&mut Subject::<3>::new(compiled, &formulas)),
        }
    }

    pub(crate) fn of_subject<const D: usize>(subject: &mut Subject<'_, D>) -> Option<Self> {
        let [corner, middle] = [0.0, 0.5].map(|part| subject.chart.place(&[part; D]));
        let (middle, corner) = (subject.at_rest(&middle)?, subject.at_rest(&corner));
        let is_graded = corner.is_some_and(|corner| corner != middle);
        Some(Material { middle, is_graded })
    }

    /// The name of the unit of moduli.
    pub fn modulus(&self) -> &'static str {
        match self.middle.moduli() {
            Some(moduli) if moduli.mu == 0.0 => "lambda",
            Some(_) => "mu",
            None => "times the mean shear modulus",
        }
    }
}

/// Moduli of an isotropic material at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    /// The first Lame parameter.
    pub lambda: f64,
    /// The second one, the shear modulus.
    pub mu: f64,
}

impl Moduli {
    /// Young's modulus.
    pub fn young(&self) -> f64 {
        self.mu * (3.0 * self.lambda + 2.0 * self.mu) / (self.lambda + self.mu)
    }

    /// Poisson's ratio.
    pub fn nu(&self) -> f64 {
        self.lambda / (2.0 * (self.lambda + self.mu))
    }

    /// lambda d_iJ d_kL + mu (d_ik d_JL + d_iL d_Jk).
    fn tangent(&self) -> Elasticity<3> {
        let delta = |a: usize, b: usize| f64::from(u8::from(a == b));
        Elasticity::from_fn(|[i, j, k, l]| {
            self.lambda * delta(i, j) * delta(k, l)
                + self.mu * (delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k))
        })
    }
}

impl Resting {
    /// The shear modulus of a material whose volume is governed by a given field, such as a pressure: it has no other modulus.
    pub fn shear_alone(&self) -> Option<f64> {
        self.has_balanced_pressure.then(|| average(&self.stiffness()).mu)
    }

    /// The moduli of a material that is isotropic at rest; `None` for others.
    pub fn moduli(&self) -> Option<Moduli> {
        if self.has_balanced_pressure {
            return None;
        }
        let stiffness = self.stiffness();
        let (moduli, size) = (average(&stiffness), stiffness.norm());
        let rest = moduli.tangent();
        let difference = Elasticity::<3>::from_fn(|at| stiffness.at(at) - rest.at(at));
        (difference.norm() <= ISOTROPIC * size).then_some(moduli)
    }

    /// The unit of other moduli: mu, or lambda if mu is 0; for a material that is not isotropic, the averages over all
    /// directions (Voigt 1928).
    pub fn modulus(&self) -> f64 {
        let Moduli { lambda, mu } = average(&self.stiffness());
        if mu.abs() > ISOTROPIC * lambda.abs() { mu } else { lambda }
    }

    /// dP/dF minus the contribution of a stress at rest, P_JL d_ik. A spherical stress s that a given field balances is
    /// different: the result is the coefficients of stress and strain, to which s adds d_ik d_jl + d_il d_jk - d_ij d_kl (Birch
    /// 1947).
    pub(crate) fn stiffness(&self) -> Elasticity<3> {
        let delta = |a: usize, b: usize| f64::from(u8::from(a == b));
        Elasticity::from_fn(|[i, j, k, l]| {
            if self.has_balanced_pressure {
                let adds = delta(i, l) * delta(j, k) - delta(i, j) * delta(k, l);
                return self.tangent.at([i, j, k, l]) + self.stress[0] * adds;
            }
            let adds = self.is_frame_indifferent && i == k;
            let stress = if adds { self.stress[j * 3 + l] } else { 0.0 };
            self.tangent.at([i, j, k, l]) - stress
        })
    }
}

/// The nearest isotropic moduli: of the average over all directions.
fn average(stiffness: &Elasticity<3>) -> Moduli {
    let sum = |pick: fn(usize, usize) -> [usize; 4]| -> f64 {
        let pairs = (0..3).flat_map(|a| (0..3).map(move |b| (a, b)));
        pairs.map(|(a, b)| stiffness.at(pick(a, b))).sum()
    };
    let (bulk, shear) = (sum(|a, b| [a, a, b, b]), sum(|a, b| [a, b, a, b]));
    Moduli { lambda: (2.0 * bulk - shear) / 15.0, mu: (3.0 * shear - bulk) / 30.0 }
}
