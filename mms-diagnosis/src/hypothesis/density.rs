//! Mistakes in rho0.

use super::{Change, Hypothesis, law};

pub(super) fn all<const D: usize>() -> Vec<Hypothesis<D>> {
    vec![
        Hypothesis::factor("density_factor", "rho0 times a factor", 1.3, Change::Density, |_| {
            law::units()
        })
        .within([0.0, f64::MAX]),
    ]
}
