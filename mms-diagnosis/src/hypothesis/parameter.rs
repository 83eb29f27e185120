//! Mistakes in the parameters of any material.

use mms_runtime::Matrix;

use super::{Change, Given, Hypothesis, Known, Of, OfStress};
use crate::exact::Exact;

/// Parameters that other hypotheses cover if the law is a published one.
const KNOWN: [&str; 4] = ["lambda", "mu", "young", "kappa"];

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let names = exact.parameters.map_or(&[][..], |it| it.names());
    let is_own = |(name, _): &(&String, _)| exact.law.is_none() || !KNOWN.contains(&name.as_str());
    let each = names.iter().zip(Times::<D>::EACH).filter(is_own);
    each.map(|(name, change)| {
        let says = "a parameter of the material times a factor";
        Hypothesis::factor("parameter_factor", says, 1.3, Change::Stress(Of::Law, *change), |_| {
            vec![
                Known::new(0.0, "parameter_missing", "a parameter of the material is 0"),
                Known::new(
                    -1.0,
                    "parameter_sign",
                    "a parameter of the material has the other sign",
                ),
                Known::new(
                    0.5,
                    "parameter_half",
                    "a parameter of the material is half of what it is",
                ),
                Known::new(
                    2.0,
                    "parameter_twice",
                    "a parameter of the material is twice what it is",
                ),
            ]
        })
        .of(name.clone())
    })
    .collect()
}

/// The stress of a law with the parameter of each index times the size.
struct Times<const D: usize>;

impl<const D: usize> Times<D> {
    const EACH: &[OfStress<D>] = &[
        times::<D, 0>,
        times::<D, 1>,
        times::<D, 2>,
        times::<D, 3>,
        times::<D, 4>,
        times::<D, 5>,
        times::<D, 6>,
        times::<D, 7>,
        times::<D, 8>,
        times::<D, 9>,
        times::<D, 10>,
        times::<D, 11>,
    ];
}

fn times<const D: usize, const AT: usize>(at: &Given<'_, D>, tau: &mut [Matrix<f64, D>]) {
    match at.exact.parameters.and_then(|it| it.times(AT, at.size[0])) {
        Some(field) => field.kirchhoff_stress(at.time, at.reference, at.gradient, tau),
        None => tau.fill(Matrix::repeat(f64::NAN)),
    }
}
