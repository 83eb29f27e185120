//! The documents of `mms judge`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;
use crate::study::{JudgedNorm, LevelErrors};
use crate::value::Names;
use crate::value::present;

/// The document of `mms judge --errors TABLE` and `mms judge FIELD FILE...`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Judge {
    /// The table, or the field.
    pub source: String,
    /// The refined lengths: `space`, `time` or `space and time`.
    pub refinement: String,
    /// The levels of the first quantity.
    pub levels: Vec<JudgeLevel>,
    /// The quantity that decided.
    pub quantity: Option<String>,
    /// The norm that decided.
    pub norm: Option<String>,
    /// The order that is expected of that norm.
    pub expected_order: Option<f64>,
    /// The tolerance of the order.
    pub tolerance: Option<f64>,
    /// The observed order.
    pub observed_order: Option<f64>,
    /// The interval of `observed_order` at 95 %.
    pub order_interval: Option<[f64; 2]>,
    /// The quantities.
    pub quantities: Vec<JudgedQuantity>,
    /// The worst verdict: `no evidence`, `exact to round-off`, `pass`, `not asymptotic` or `fail`.
    pub verdict: String,
    /// The version of the [rule](../guide/rule.md#the-rule) that decided.
    pub rule: u32,
    /// Notes on the reading of the files: arrays that were recognised or left out, and why.
    pub notes: Vec<String>,
    /// The name of the field, if results were judged. The same holds for the next five keys.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
    /// The files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub files: Option<Vec<String>>,
    /// The times at which meshes are compared.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times: Option<Vec<f64>>,
    /// The sampling of each quantity: `points`, `weighted points`, `cells`, `middles of cells` or `points of faces`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samplings: Option<Names<String>>,
    /// The units of h, dt and the quantities, if the field states units. The unit of a quantity is the unit of its errors in
    /// l1, l2 and linf.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<Names<String>>,
    /// The warnings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub warnings: Option<Vec<String>>,
    /// With `--tighter`: the root mean square of the difference of each quantity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub iterative_errors: Option<Names<f64>>,
    /// The mistakes that results of u, v or F exclude if they pass; null if the project's own solver could not be run.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub excluded: Option<Option<Vec<Excluded>>>,
    /// The words of the command to type next, `mms` first; missing after a good verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// A mistake, and the size from which a pass excludes it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Excluded {
    /// The name of the mistake, as `mms diagnose --list` prints it.
    pub hypothesis: String,
    /// The mistake in a sentence.
    pub says: String,
    /// `mistake` or `choice`.
    pub kind: String,
    /// True if the mistake would have made a larger error.
    pub excluded: bool,
    /// The error that the mistake adds, over the finest error; null if the mistake stops the solver, or if a size
    /// of it is excluded.
    pub times: Option<f64>,
    /// The size in a right solver, if the mistake has a size.
    pub right: Option<f64>,
    /// The distance from that size, from which on the mistake is excluded.
    pub from: Option<f64>,
}

/// A level of the first quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgeLevel {
    /// The edge h of a cell.
    pub cell_size: Option<f64>,
    /// The time step dt.
    pub time_step: Option<f64>,
    /// The number of replicates.
    pub runs: usize,
    /// The errors, and their orders.
    #[serde(flatten)]
    pub errors: LevelErrors,
}

/// The verdict on a quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgedQuantity {
    /// The name of the quantity.
    pub name: String,
    /// The norm that decided.
    pub norm: String,
    /// The verdict, as in the document.
    pub verdict: String,
    /// The order q of a layer at a face.
    pub layer_order: Option<f64>,
    /// True if the order exceeds the one that theory promises everywhere, because of the places of the points.
    pub superconvergent: bool,
    /// The finding of each norm.
    pub norms: Vec<JudgedNorm>,
    /// The findings in sentences.
    pub says: Vec<String>,
}

/// The document of `mms judge FIELD FILE --baseline JSON`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgeBaseline {
    /// The errors beside the saved ones.
    pub errors: Vec<SavedError>,
    /// `pass`, `fail` or `no evidence`.
    pub verdict: String,
}

/// An error beside the saved one.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SavedError {
    /// The name of the quantity.
    pub quantity: String,
    /// The name of the norm.
    pub norm: String,
    /// The edge h of a cell.
    pub cell_size: f64,
    /// The error.
    pub error: f64,
    /// The saved error.
    pub saved: f64,
    /// True if both agree within 1 %, or if both are round-off.
    pub near: bool,
}

/// The document of `mms judge --same A B`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgeSame {
    /// The names of both results.
    pub source: Vec<String>,
    /// The pairing of points: by numbers, by X, or in their order.
    pub paired: String,
    /// The differences of the arrays.
    pub differences: Vec<DifferenceOfResults>,
    /// The arrays that only one result has.
    pub alone: Vec<String>,
    /// The arrays of words, which are not compared.
    pub words: Vec<String>,
}

/// The difference of an array.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DifferenceOfResults {
    /// The name of the array.
    pub array: String,
    /// The time; null if the files have none.
    pub time: Option<f64>,
    /// The largest difference; null if it is not finite.
    pub largest: Option<f64>,
    /// The largest difference over the largest value; null if it is not finite.
    pub relative: Option<f64>,
    /// The place of the largest difference.
    pub r#where: String,
}

/// The document of `mms judge FIELD FILE... --explain`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JudgeExplained {
    /// The files.
    pub files: Vec<ExplainedFile>,
}

/// The reading of a file.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExplainedFile {
    /// The name of the file.
    pub file: String,
    /// The name of the format.
    pub format: String,
    /// The times of the results.
    pub times: Vec<f64>,
    /// The path of the file of each result, in the order of times.
    pub paths: Vec<String>,
    /// The number of points.
    pub points: usize,
    /// The source of X.
    pub positions: String,
    /// The cells of each kind.
    pub cells: Vec<String>,
    /// The quantities.
    pub quantities: Vec<ExplainedQuantity>,
    /// The arrays, cells and points that are left out, and why.
    pub left_out: Vec<String>,
}

/// The reading of a quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExplainedQuantity {
    /// The name of the quantity.
    pub quantity: String,
    /// The arrays, their precision, the order of the components, and the reason.
    pub how: String,
}
