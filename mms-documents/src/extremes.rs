//! The documents of `mms extremes`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;
use crate::study::Method;

/// The document of `mms extremes FIELD`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Extremes {
    /// The name of the field.
    pub field: String,
    /// The method of the solver.
    pub method: Method,
    /// True if `--quick` was given.
    pub quick: bool,
    /// The error of the field as declared, over its largest displacement.
    pub declared_l2: f64,
    /// The extremes.
    pub rows: Vec<ExtremeRow>,
    /// The largest stable Courant numbers.
    pub stability: Vec<StabilityLimit>,
    /// The names of unexpected rows.
    pub unexpected: Vec<String>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// A row of the table of extremes.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExtremeRow {
    /// The name.
    pub name: String,
    /// The setting.
    pub setting: String,
    /// The reason for the expected result.
    pub theory: String,
    /// The factor that is allowed on `declared_l2`.
    pub allowed_factor: Option<f64>,
    /// The right reasons to stop.
    pub allowed_diagnoses: Vec<String>,
    /// The root mean square of the error.
    pub l2: Option<f64>,
    /// The largest right value of `l2`.
    pub bound: Option<f64>,
    /// The reason why the run stopped.
    pub diagnosis: Option<String>,
    /// The reason.
    pub reason: Option<String>,
    /// The verdict.
    pub verdict: String,
    /// True if the verdict is the expected one.
    pub expected: bool,
}

/// The largest stable Courant number of a method.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StabilityLimit {
    /// The method.
    pub method: String,
    /// The largest stable Courant number on an endless grid.
    pub theory: Option<f64>,
    /// The largest stable Courant number that was found.
    pub measured: f64,
    /// The verdict.
    pub verdict: String,
    /// True if the verdict is the expected one.
    pub expected: bool,
}
