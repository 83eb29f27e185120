//! The documents of `mms run`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;
use crate::study::Method;
use crate::value::Division;

/// The document of `mms run FIELD`. If the run stopped, then errors, diagnostics and times are null.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Run {
    /// The name of the field.
    pub field: String,
    /// The method of the solver.
    pub method: Method,
    /// The number of cells along the longest edge, or a text such as `32x16`.
    pub cells: Division,
    /// The edge h of a cell.
    pub cell_size: Option<f64>,
    /// The time step dt.
    pub time_step: Option<f64>,
    /// The number of time steps.
    pub steps: Option<usize>,
    /// The number of particles.
    pub particles: Option<usize>,
    /// The errors.
    pub errors: Option<RunErrors>,
    /// Global sums of the run.
    pub diagnostics: Option<Diagnostics>,
    /// Nanoseconds per particle and step.
    pub ns_per_particle_step: Option<f64>,
    /// The seconds on the clock.
    pub seconds: Option<PartsOfTime>,
    /// With `--relax`: the forces out of balance at the end, over the forces of the stress.
    pub residual_ratio: Option<f64>,
    /// The reason why the run stopped; null if it reached its end.
    pub failure: Option<String>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// The errors of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunErrors {
    /// The error of u.
    pub displacement: OverTime,
    /// The error of v.
    pub velocity: OverTime,
    /// The error of F.
    pub deformation_gradient: OverTime,
    /// The error of P.
    pub first_piola_kirchhoff: OverTime,
}

/// The errors of a quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OverTime {
    /// The largest norms of all steps.
    pub over_time: Norms,
    /// The norms at the end.
    pub at_end: Norms,
}

/// The norms of an error.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Norms {
    /// The mean over the particles.
    pub l1: f64,
    /// The root mean square over the particles.
    pub l2: f64,
    /// The maximum over the particles.
    pub linf: f64,
}

/// Global sums of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Diagnostics {
    /// The total mass.
    pub mass: f64,
    /// The momentum at the end.
    pub momentum: Vec<f64>,
    /// The kinetic energy at the end.
    pub kinetic_energy: f64,
    /// The least and greatest J of the particles at the end.
    pub jacobian: [f64; 2],
    /// The balance of energy; null if it was not kept.
    pub balance: Option<Balance>,
}

/// The balance of energy over a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Balance {
    /// The time of the energies.
    pub time: f64,
    /// The kinetic energy.
    pub kinetic_energy: f64,
    /// The strain energy; null if the material has none.
    pub strain_energy: Option<f64>,
    /// The work of b.
    pub body_work: f64,
    /// The missing energy; null if the material has no strain energy.
    pub energy_residual: Option<f64>,
    /// The force on the faces.
    pub surface_force: Vec<f64>,
    /// The work of given fields: the change of W with time at fixed F.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given_work: Option<f64>,
}

/// The seconds for each part of a step.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PartsOfTime {
    /// The seconds for evaluating b.
    pub forcing: f64,
    /// The seconds for P2G and G2P.
    pub transfer: f64,
    /// The seconds for updating the grid.
    pub grid: f64,
    /// The seconds for updating the stress.
    pub stress: f64,
}
