//! The documents of `mms accuracy`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;

/// The document of `mms accuracy FIELD`. Errors are in eps of the precision.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Accuracy {
    /// The name of the field.
    pub field: String,
    /// The number of points.
    pub points: usize,
    /// The bound that the project promises.
    pub bound_eps: f64,
    /// The measured combinations.
    pub rows: Vec<AccuracyRow>,
    /// The combinations that were not measured.
    pub left_out: Vec<LeftOut>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// The errors of a quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AccuracyRow {
    /// The name of the quantity.
    pub quantity: String,
    /// The precision: `f32` or `f64`.
    pub precision: String,
    /// The form of the code: `stable` or `fast`.
    pub form: String,
    /// `declared`, or the name of an extreme.
    pub regime: String,
    /// The median of the relative errors of components.
    pub median_eps: Option<f64>,
    /// The 99th percentile of these errors.
    pub p99_eps: Option<f64>,
    /// The maximum of these errors.
    pub max_eps: Option<f64>,
    /// The largest error over the largest magnitude of the quantity.
    pub max_scaled_eps: Option<f64>,
    /// The number of components that were compared.
    pub compared: usize,
    /// The number of components that are infinite or not a number.
    pub not_finite: usize,
    /// The number of components whose true value exceeds the range of the precision.
    pub overflowed: usize,
    /// The number of components without a real value.
    pub undefined: usize,
    /// True if the errors are within the bound; null if no bound is promised.
    pub within_bound: Option<bool>,
    /// The nanoseconds per point, with `--time`.
    pub ns_per_point: Option<f64>,
}

/// A combination that was not measured.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LeftOut {
    /// `declared`, or the name of an extreme.
    pub regime: String,
    /// The name of the quantity; null for all.
    pub quantity: Option<String>,
    /// The precision; null for both.
    pub precision: Option<String>,
    /// The reason.
    pub reason: String,
}
