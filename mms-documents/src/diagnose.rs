//! The documents of `mms diagnose`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;
use crate::value::Names;

/// The document of `mms diagnose FIELD FILE...`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Diagnose {
    /// The name of the field.
    pub field: String,
    /// The files.
    pub files: Vec<String>,
    /// `the law alone`, `accelerations at an exact state`, `residuals at an exact state`, `residuals at nodes at an
    /// exact state`, `one step from an exact state` or `results`.
    pub evidence: String,
    /// `nothing`, `named` or `unexplained`.
    pub finding: String,
    /// The error over the size of the solution.
    pub error: f64,
    /// The least error of a right solver, if it is known.
    pub least_expected_error: f64,
    /// The largest error that a right solver may have.
    pub expected_error: f64,
    /// The fall of the error from mesh to mesh, for results on two meshes or more.
    pub order: Option<ErrorOrder>,
    /// The mistakes that explain the error, the best one first.
    pub ranked: Vec<Hypothesis>,
    /// The mistakes that these results cannot show.
    pub cannot_be_seen: Vec<String>,
    /// Two mistakes that explain the error together, if none explains it alone.
    pub pair: Option<Pair>,
    /// A right method of the project's own solver with such an error, or the method of `--like`.
    pub like: Option<Like>,
    /// The place of the error of results.
    pub place: Option<Place>,
    /// The units of h, dt and the quantity of `fields`, if the field states units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<Names<String>>,
    /// The errors of results at points.
    pub fields: Option<ErrorFields>,
    /// A question about a parameter of the field; missing if no other value of one fits the results much better.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub question: Option<String>,
    /// The next step to take.
    pub next: String,
    /// The words of the command to type next, `mms` first; missing if the finding is `nothing`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// The fall of the error from mesh to mesh.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ErrorOrder {
    /// The quantity that decides, as in `mms judge`.
    pub quantity: String,
    /// The norm that decides.
    pub norm: String,
    /// The observed order; null if a run stopped.
    pub observed_order: Option<f64>,
    /// The least order of a right solver.
    pub expected_order: f64,
    /// The verdict of `mms judge`.
    pub verdict: String,
    /// The place to look for the cause; null if the order is right.
    pub says: Option<String>,
    /// A right method of the project's own solver with the observed order.
    pub like: Option<MethodOfOrder>,
}

/// A method of the solver of this project, and the order of its error.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MethodOfOrder {
    /// The method, as `--like` takes it.
    pub method: String,
    /// The order of its error on this field.
    pub order: f64,
}

/// Two mistakes that explain the error together.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Pair {
    /// The names of both.
    pub hypotheses: Vec<String>,
    /// The share of the squared error.
    pub explained: f64,
}

/// A method of the solver of this project whose error is similar.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Like {
    /// The method, as `--like` takes it.
    pub method: String,
    /// The error over the method's error.
    pub factor: f64,
    /// The difference between the two errors, over the error.
    pub apart: f64,
}

/// The place of the error.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Place {
    /// X of the largest error.
    pub at: Vec<f64>,
    /// The time t.
    pub time: f64,
    /// The face that has more than half of the squared error beside it.
    pub face: Option<String>,
    /// A plane inside the body that has more than half of the squared error beside it.
    pub plane: Option<Plane>,
    /// The order from the second finest mesh to the finest one.
    pub order: Option<f64>,
    /// The smooth part of the squared error.
    pub smooth: f64,
}

/// A plane through the body.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Plane {
    /// `X`, `Y` or `Z`.
    pub axis: String,
    /// The coordinate of the plane.
    pub at: f64,
}

/// The errors at points.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ErrorFields {
    /// The name of the quantity.
    pub quantity: String,
    /// The time t.
    pub time: f64,
    /// The points X.
    pub points: Vec<Vec<f64>>,
    /// The smooth part of the error.
    pub error: Vec<Vec<f64>>,
    /// The error of the named hypothesis; null if none is named.
    pub named: Option<Vec<Vec<f64>>>,
}

/// A mistake, and the share of the error that it explains.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Hypothesis {
    /// The name of the mistake, or the name of a size of it.
    pub hypothesis: String,
    /// The mistake in a sentence.
    pub says: String,
    /// `mistake` or `choice`.
    pub kind: String,
    /// The size of the mistake; for a mistake without a size, the factor that its effect would need.
    pub factor: Option<f64>,
    /// The interval of the factor.
    pub interval: Option<[f64; 2]>,
    /// The size, if it is a vector.
    pub vector: Option<Vec<f64>>,
    /// The share of the squared error.
    pub explained: f64,
    /// True if the mistake may have that size.
    pub plausible: bool,
    /// The name of the face.
    pub face: Option<String>,
    /// The variant of the mistake, such as a law or a component; null if it has none.
    pub which: Option<String>,
    /// Mistakes with the same formula, for such data on any field.
    pub equivalent_always: Vec<String>,
    /// Mistakes that these results do not tell apart.
    pub equivalent_here: Vec<String>,
    /// The data that tell them apart.
    pub needs: Vec<String>,
}

/// The document of `mms diagnose FIELD --plan`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DiagnosePlan {
    /// The name of the field.
    pub field: String,
    /// The steps, from the first on.
    pub steps: Vec<DiagnoseStep>,
}

/// A step of a plan.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DiagnoseStep {
    /// `law`, `residual`, `accelerations` or `results`.
    pub step: String,
    /// The input in a sentence.
    pub needs: String,
    /// The cost of the step, in a sentence.
    pub costs: String,
    /// The command to type.
    pub command: String,
    /// The mistakes that the step can show.
    pub sees: Vec<String>,
}

/// The document of `mms diagnose [FIELD] --list`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Hypotheses {
    /// The name of the field; empty if none was given.
    pub field: String,
    /// The mistakes that `mms diagnose` knows.
    pub hypotheses: Vec<ListedHypothesis>,
}

/// A mistake that `mms diagnose` knows.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListedHypothesis {
    /// The name of the mistake.
    pub hypothesis: String,
    /// `body force`, `stress`, `traction`, `mass`, `start`, `boundary condition` or `output`.
    pub changes: String,
    /// `mistake` or `choice`.
    pub kind: String,
    /// The data that show the mistake: `law`, `exact state`, `step` or `results`.
    pub shown_by: String,
    /// The mistake in a sentence.
    pub says: String,
    /// The hypothesis of which this name is a size; null for others.
    pub of: Option<SizeOf>,
}

/// The hypothesis and the size that a name refers to.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SizeOf {
    /// The name of the mistake, as `mms diagnose --list` prints it.
    pub hypothesis: String,
    /// The size.
    pub factor: f64,
}
