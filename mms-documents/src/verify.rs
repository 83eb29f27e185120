//! The documents of `mms verify`.

use serde::{Deserialize, Serialize};

use crate::provenance::Provenance;
use crate::study::Level;
use crate::value::Names;

/// The document of `mms verify`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Verify {
    /// `quick` or `full`.
    pub matrix: String,
    /// The rows of the matrix.
    pub rows: Vec<VerifiedRow>,
    /// The names of rows with an unexpected verdict.
    pub unexpected: Vec<String>,
    /// The words of the command to type next, `mms` first; missing if all rows are as expected.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// A row of the verification matrix.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VerifiedRow {
    /// The name.
    pub name: String,
    /// The study, as options of `mms study`.
    pub study: String,
    /// The refined lengths: `time` or `space and time`.
    pub refined: String,
    /// The name of the quantity.
    pub quantity: String,
    /// The formal order: a number, `none` or `exact`.
    pub formal_order: String,
    /// The tolerance of the order.
    pub tolerance: f64,
    /// The reason for that order.
    pub theory: String,
    /// The levels, from coarse to fine.
    pub levels: Vec<Level>,
    /// The observed order.
    pub observed_order: Option<f64>,
    /// The constant C of `l2` = C h^p.
    pub error_constant: Option<f64>,
    /// The value of `error_constant` that is expected.
    pub expected_error_constant: Option<f64>,
    /// The verdict.
    pub verdict: String,
    /// The verdict that theory expects.
    pub expected_verdict: String,
    /// The reason why the row is unexpected; null if it is as expected.
    pub reason: Option<String>,
    /// The seconds on the clock.
    pub seconds: f64,
}

/// The document of `mms verify --list`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VerifyList {
    /// The rows of the matrix.
    pub rows: Vec<ListedRow>,
}

/// A row of the verification matrix, before it runs.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListedRow {
    /// The name.
    pub name: String,
    /// The study, as options of `mms study`.
    pub study: String,
    /// The number of levels.
    pub levels: usize,
    /// The formal order: a number, `none` or `exact`.
    pub formal_order: String,
    /// The reason for the expected result.
    pub theory: String,
}

/// The document of `mms verify --defects`, of a program with the feature `defects`. Its provenance has the `kind` `defects`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VerifyDefects {
    /// The names of the rows.
    pub rows: Vec<String>,
    /// True if each defect was tried on all rows.
    pub every_row: bool,
    /// The defects.
    pub defects: Vec<ShownDefect>,
    /// The names of defects that no row caught.
    pub uncaught: Vec<String>,
    /// Pairs of a row and a defect that the row claims to catch and did not catch.
    pub missed: Vec<[String; 2]>,
    /// The rows that catch nothing that few other rows catch.
    pub idle: Vec<String>,
    /// How the document was made.
    pub provenance: Provenance,
}

/// A defect, and the rows on which it was tried.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ShownDefect {
    /// The name.
    pub name: String,
    /// `compiler` or `solver`.
    pub place: String,
    /// The defect in a sentence.
    pub what: String,
    /// The rows on which the defect was tried.
    pub rows: Vec<ShownRow>,
    /// True for each check of plausibility that objects; null if the check cannot tell.
    pub pseudo: Names<Option<bool>>,
}

/// A row on which a defect was tried.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ShownRow {
    /// The name.
    pub name: String,
    /// True if the row caught the defect.
    pub caught: bool,
    /// The verdict.
    pub verdict: String,
    /// The reason of the verdict.
    pub reason: Option<String>,
}
