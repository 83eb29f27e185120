//! The documents of `mms emit`.

use serde::{Deserialize, Serialize};

/// The document of `mms emit FIELD`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Emit {
    /// The name of the field.
    pub field: String,
    /// The target language.
    pub target: String,
    /// The name of the first file.
    pub file: String,
    /// The path of the first file; null if it was not written.
    pub path: Option<String>,
    /// The text of the first file; null if it was written.
    pub text: Option<String>,
    /// All files.
    pub files: Vec<EmittedFile>,
    /// The command that builds and runs the check program; null if there is none.
    pub verify: Option<String>,
}

/// A file of an emitted field.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EmittedFile {
    /// The name of the file.
    pub file: String,
    /// The path of the file; null if it was not written.
    pub path: Option<String>,
    /// The text of the file; null if it was written.
    pub text: Option<String>,
    /// With `--check`: `current`, `stale` or `missing`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

/// The document of `mms emit --all`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EmitAll {
    /// The target language.
    pub target: String,
    /// The emitted fields.
    pub fields: Vec<Emit>,
}
