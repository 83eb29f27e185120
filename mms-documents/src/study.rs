//! The documents of `mms study`.

use serde::{Deserialize, Serialize};

use crate::judge::Excluded;
use crate::provenance::Provenance;
use crate::value::present;
use crate::value::{Division, Names};

/// The document of `mms study FIELD`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Study {
    /// The study.
    #[serde(flatten)]
    pub study: StudyOfMethod,
    /// How the document was made.
    pub provenance: Provenance,
}

/// The study of a method.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StudyOfMethod {
    /// The name of the field.
    pub field: String,
    /// The method of the solver.
    pub method: Method,
    /// The refined lengths: `both`, `space` or `time`.
    pub refinement: String,
    /// The levels, from coarse to fine.
    pub levels: Vec<Level>,
    /// True for each level whose error may be round-off alone.
    pub noise: Vec<bool>,
    /// The quantities.
    pub quantities: StudyErrors,
    /// The units of h, dt and the quantities, if the field states units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<Names<String>>,
    /// The differences of successive levels, if only time is refined.
    pub differences: Option<Vec<LevelDifference>>,
    /// The order that is expected.
    pub expected_order: f64,
    /// The observed order of `l2`.
    pub observed_order: Option<f64>,
    /// The change that Richardson's extrapolation makes to the order of the finest pair.
    pub order_uncertainty: Option<f64>,
    /// The interval of the observed order.
    pub order_interval: Option<[f64; 2]>,
    /// The norm that decided.
    pub norm: Option<String>,
    /// The finding of each norm.
    pub norms: Vec<JudgedNorm>,
    /// The version of the [rule](../guide/rule.md#the-rule) that decided.
    pub rule: u32,
    /// The constant C of `l2` = C h^p.
    pub error_constant: Option<f64>,
    /// The value of `error_constant` that is expected.
    pub expected_error_constant: Option<f64>,
    /// The fit in h and dt, with `--fit`.
    pub fit: Option<Fit>,
    /// The errors of amplitude and phase, with `--periods`.
    pub phase: Option<Phase>,
    /// `pass`, `fail` or `not asymptotic`.
    pub verdict: String,
    /// The mistakes that a pass excludes, with `--excluded`; null if the mistakes could not be run.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub excluded: Option<Option<Vec<Excluded>>>,
    /// The likely causes of a verdict that is no pass, and errors of F or P that grow on finer meshes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub causes: Vec<String>,
    /// The words of the command to type next, `mms` first; missing after a good verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
}

/// The orders of a norm: see [the verdict](../guide/judging.md).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgedNorm {
    /// The name of the norm.
    pub norm: String,
    /// The least order that a right method may show.
    pub expected_order: f64,
    /// The highest such order, if theory leaves a range.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub highest_order: Option<f64>,
    /// `pass`, `fail` or `not asymptotic`; from `mms judge` also `exact to round-off` or `no evidence`.
    pub verdict: String,
    /// The observed order.
    pub observed_order: Option<f64>,
    /// The interval of `observed_order` at 95 %.
    pub order_interval: Option<[f64; 2]>,
    /// The source of the interval: `drift`, `scatter`, `digits` or `nothing`.
    pub interval_from: Option<String>,
    /// h or dt of the levels that decided.
    pub decided_by: Vec<f64>,
    /// The share of a term of lower order in the finest error, from three levels or more. It decides.
    pub lower_order: Option<LowerOrder>,
    /// The term that explains the drift of the order best.
    pub second_term: Option<SecondTerm>,
    /// The limit e0 of e0 + C h^p, from four levels or more.
    pub limit: Option<Limit>,
    /// The errors on each level, from `mms judge`; null for a grid of h and dt.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub levels: Option<Option<Vec<JudgedLevel>>>,
}

/// The share of a term of lower order in the finest error, from three levels or more.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LowerOrder {
    /// The order q of D h^q.
    pub order: f64,
    /// D h^q over the finest error.
    pub share: f64,
    /// The interval of `share` at 95 %.
    pub share_interval: [f64; 2],
}

/// The term that explains the drift of the order best.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SecondTerm {
    /// `plateau`, `lower order` or `pre-asymptotic`.
    pub kind: String,
    /// The order q of D h^q.
    pub order: f64,
    /// D h^q over the finest error.
    pub share: f64,
    /// The interval of `share` at 95 %.
    pub share_interval: [f64; 2],
    /// The length at which both terms are equal.
    pub takes_over: f64,
}

/// The limit e0 of e0 + C h^p, from four levels or more.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Limit {
    /// The limit e0.
    pub error: f64,
    /// The interval of e0.
    pub interval: [f64; 2],
    /// The order p.
    pub order: f64,
}

/// The errors on a mesh.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgedLevel {
    /// h or dt.
    pub length: f64,
    /// The errors of the runs.
    pub runs: Vec<f64>,
    /// The mean error; null if all runs stopped.
    pub error: Option<f64>,
    /// The order against the level before.
    pub order: Option<f64>,
}

/// A method of the solver of this project.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Method {
    /// The shape function.
    pub shape: String,
    /// The time integrator.
    pub integrator: String,
    /// The formulation: `updated` or `total`.
    pub formulation: String,
    /// The transfer between particles and grid.
    pub transfer: String,
    /// The fraction of FLIP; null for other transfers.
    pub flip_fraction: Option<f64>,
    /// The precision: `f32` or `f64`.
    pub precision: String,
    /// The form of the code: `stable` or `fast`.
    pub form: String,
    /// The number of particles along an edge of a cell, or a text such as `2x3`.
    pub particles_per_cell: Division,
    /// The arrangement of the particles.
    pub fill: Option<String>,
    /// The random shift of the particles, in their spacing.
    pub jitter: f64,
    /// The seed of the random shifts.
    pub seed: u64,
    /// The offset of the grid, in cells.
    pub offset: Vec<f64>,
    /// The periodic axes.
    pub periodic: Vec<String>,
    /// The Courant number.
    pub courant: f64,
    /// The time step, with `--time-step`.
    pub time_step: Option<f64>,
    /// The end of the run, with `--time`.
    pub end_time: Option<f64>,
    /// True if the run goes to an equilibrium, with `--relax`. Older documents do not have it.
    #[serde(default)]
    pub relax: bool,
}

/// A level of a study.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Level {
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
    /// The errors, and their orders.
    #[serde(flatten)]
    pub errors: LevelErrors,
    /// The seconds on the clock.
    pub seconds: Option<f64>,
    /// The reason why the run stopped; null if it reached its end.
    pub failure: Option<String>,
    /// The part of `l2` that round-off may cause, and with `--relax` the forces out of balance. Absent in a row of the matrix.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub round_off: Option<Option<f64>>,
    /// With `--relax`: the forces out of balance at the end, over the forces of the stress. Absent in a row of the matrix.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub residual_ratio: Option<Option<f64>>,
}

/// The errors of a study by quantity, level by level.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StudyErrors {
    /// The error of u.
    pub displacement: Vec<LevelErrors>,
    /// The error of v.
    pub velocity: Vec<LevelErrors>,
    /// The error of F.
    pub deformation_gradient: Vec<LevelErrors>,
    /// The error of P.
    pub first_piola_kirchhoff: Vec<LevelErrors>,
}

/// The errors on a level, and their orders.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelErrors {
    /// The mean of the error.
    pub l1: Option<f64>,
    /// The root mean square of the error.
    pub l2: Option<f64>,
    /// The maximum of the error.
    pub linf: Option<f64>,
    /// The order of `l1` against the level before.
    pub order_l1: Option<f64>,
    /// The order of `l2` against the level before.
    pub order_l2: Option<f64>,
    /// The order of `linf` against the level before.
    pub order_linf: Option<f64>,
}

/// The difference of two successive levels.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelDifference {
    /// The longer time step of both.
    pub time_step: f64,
    /// The errors, and their orders.
    #[serde(flatten)]
    pub errors: LevelErrors,
}

/// The fit C_h h^p + C_t dt^q of the errors.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Fit {
    /// The constant C_h.
    pub space_constant: f64,
    /// The order p.
    pub space_order: f64,
    /// The constant C_t.
    pub time_constant: f64,
    /// The order q.
    pub time_order: f64,
    /// The relative residual of the fit.
    pub residual: f64,
}

/// The errors of amplitude and phase.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Phase {
    /// The period of the motion.
    pub period: f64,
    /// The measured periods.
    pub measured: Vec<Period>,
}

/// The errors of a period.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Period {
    /// The number of the period, from 1 on.
    pub number: usize,
    /// The levels, from coarse to fine.
    pub levels: Vec<PhaseLevel>,
}

/// The errors of amplitude and phase on a level.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PhaseLevel {
    /// The computed amplitude over the exact one, minus 1.
    pub amplitude_error: Option<f64>,
    /// The order of `amplitude_error`.
    pub order_amplitude: Option<f64>,
    /// The phase lag in radians; negative if the run is ahead.
    pub phase_lag: Option<f64>,
    /// The order of `phase_lag`.
    pub order_phase: Option<f64>,
}

/// The document of `mms study FIELD` with several methods.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Studies {
    /// The name of the field.
    pub field: String,
    /// The refined lengths: `both`, `space` or `time`.
    pub refinement: String,
    /// The study of each method.
    pub studies: Vec<StudyOfOne>,
    /// The number of studies that pass.
    pub passed: usize,
    /// How the document was made.
    pub provenance: Provenance,
}

/// A study beside others. It has the keys of [study](#study), except its provenance.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StudyOfOne {
    /// The name that distinguishes the method from the others.
    pub name: String,
    /// The study.
    #[serde(flatten)]
    pub study: StudyOfMethod,
}
