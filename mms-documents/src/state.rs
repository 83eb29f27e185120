//! The documents of `mms state`.

use serde::{Deserialize, Serialize};

/// The document of `mms state FIELD`: the files, and facts that a solver needs once.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct State {
    /// The name of the field.
    pub field: String,
    /// The files that were written; open the first one.
    pub files: Vec<String>,
    /// The source of the points.
    pub source: String,
    /// The number of points.
    pub points: usize,
    /// The times.
    pub times: Vec<f64>,
    /// The arrays of a file.
    pub columns: Vec<String>,
    /// The terms that are set to 0: `body_force`, `stress`, `traction`.
    pub without: Vec<String>,
    /// True if the motion is the affine part of the field.
    pub affine: bool,
    /// The data of the field.
    #[serde(flatten)]
    pub domain: StateDomain,
}

/// The data of a field that a solver needs once. The file beside a table of states contains only these data.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StateDomain {
    /// The first and last time of the field; null if it is static.
    pub time_window: Option<[f64; 2]>,
    /// The body in the reference configuration; null if the field has none.
    pub body: Option<StateBody>,
    /// A box that contains x over the time window, from samples.
    pub motion: StateBox,
    /// The faces of the body.
    pub faces: Vec<StateFace>,
    /// `per radian` if points represent rings: volumes and masses are per radian. Missing if the field is not axisymmetric.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volumes: Option<String>,
}

/// The reference body. It has the keys of its shape.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StateBody {
    /// The lower corner of a box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<Vec<f64>>,
    /// The upper corner of a box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<Vec<f64>>,
    /// The inner radius of a round body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inner: Option<f64>,
    /// The outer radius of a round body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outer: Option<f64>,
    /// The first and last angle of a round body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub theta: Option<[f64; 2]>,
    /// The ends of a cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z: Option<[f64; 2]>,
    /// The first and last angle of a sphere, from +Z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub phi: Option<[f64; 2]>,
    /// The vertices of a polygon.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vertices: Option<Vec<Vec<f64>>>,
}

/// A box.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StateBox {
    /// The lower corner.
    pub lower: Vec<f64>,
    /// The upper corner.
    pub upper: Vec<f64>,
}

/// A face of the body.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StateFace {
    /// The name of the face.
    pub face: String,
    /// `fixed`, `roller`, `free`, `prescribed` or `traction`.
    pub claim: String,
}
