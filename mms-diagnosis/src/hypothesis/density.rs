//! Mistakes in rho0, and in the mass alone.

use super::{Change, Hypothesis, law};

pub(super) fn all<const D: usize>() -> Vec<Hypothesis<D>> {
    let factor = |name, says, change, known| {
        Hypothesis::factor(name, says, 1.3, change, known).within([0.0, f64::MAX])
    };
    vec![
        factor("density_factor", "rho0 times a factor", Change::Density, |_| law::units()),
        factor(
            "mass_factor",
            "the mass times a factor, with the right forces",
            Change::Mass,
            |_| Vec::new(),
        ),
    ]
}
