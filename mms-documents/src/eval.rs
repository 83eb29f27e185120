//! The documents of `mms eval`.

use serde::{Deserialize, Serialize};

use crate::value::Names;

/// The document of `mms eval FIELD`. A point has a key for each requested quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Eval {
    /// The name of the field.
    pub field: String,
    /// The time t.
    pub time: f64,
    /// The precision: `f32` or `f64`.
    pub precision: String,
    /// The form of the code: `stable` or `fast`.
    pub form: String,
    /// The values at each point: `at` is X, and each quantity has a key.
    pub points: Vec<Names<Vec<f64>>>,
    /// The points outside the body, from 0 on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside_body: Option<Vec<usize>>,
    /// True if the time lies outside the time window.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside_time: Option<bool>,
}
