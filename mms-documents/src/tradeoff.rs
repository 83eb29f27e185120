//! The documents of `mms tradeoff`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;

/// The document of `mms tradeoff FIELD`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Tradeoff {
    /// The name of the field.
    pub field: String,
    /// The unit of the displacement and of its errors, if the field states units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// The cost to minimise: `seconds`, `particle_steps` or `memory`.
    pub cost: Cost,
    /// The error that the run must reach, with `--target-linf`.
    pub target_linf: Option<f64>,
    /// The time that the run may take, with `--budget`.
    pub budget_seconds: Option<f64>,
    /// The runs, in the order in which they were made.
    pub runs: Vec<Trial>,
    /// The recommended run.
    pub choice: Option<Trial>,
    /// A run that would meet the goal, if no run did.
    pub predicted: Option<Prediction>,
    /// A run of the default method that would meet the goal.
    pub default: Option<Prediction>,
    /// The cost of the default method over the cost of the choice; for a budget, the ratio of the errors.
    pub gain: Option<f64>,
    /// The exponent s of cost = C linf^-s.
    pub exponent: Option<f64>,
    /// The options that are never worth their cost.
    pub dominated: Vec<String>,
    /// The words of the command to type next, `mms` first; missing if no run finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// The cost of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(inline))]
#[serde(rename_all = "snake_case")]
pub enum Cost {
    /// The time in seconds.
    Seconds,
    /// The number of particles times the number of steps.
    ParticleSteps,
    /// The largest memory in bytes.
    Memory,
}

/// A run of the search.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Trial {
    /// The command to type.
    pub command: String,
    /// The formulation: `updated` or `total`.
    pub formulation: String,
    /// The shape function.
    pub shape: String,
    /// The time integrator.
    pub integrator: String,
    /// The transfer between particles and grid.
    pub transfer: String,
    /// The number of particles along an edge of a cell.
    pub particles_per_cell: usize,
    /// The Courant number.
    pub courant: f64,
    /// The precision: `f32` or `f64`.
    pub precision: String,
    /// The form of the code: `stable` or `fast`.
    pub form: String,
    /// The number of cells along the longest edge, or a text such as `32x16`.
    pub cells: usize,
    /// The number of particles.
    pub particles: Option<usize>,
    /// The number of time steps.
    pub steps: Option<usize>,
    /// The maximum of the error.
    pub linf: Option<f64>,
    /// The number of particles times the number of steps.
    pub particle_steps: Option<f64>,
    /// The seconds on the clock.
    pub seconds: Option<f64>,
    /// The memory in bytes.
    pub memory: Option<f64>,
    /// True if the run is on the Pareto front.
    pub front: bool,
    /// The reason why the run stopped.
    pub failure: Option<String>,
}

/// A run that was not made.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Prediction {
    /// The options of the run.
    pub setting: String,
    /// The number of cells along the longest edge, or a text such as `32x16`.
    pub cells: f64,
    /// The predicted error.
    pub linf: f64,
    /// The predicted time, if the cost is time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// The predicted memory, if the cost is memory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory: Option<f64>,
    /// The number of particles times the number of steps.
    pub particle_steps: f64,
}
