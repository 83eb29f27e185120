//! The origin of a document.

use serde::{Deserialize, Serialize};

/// The version of the forms of documents. It grows when a key changes its meaning or is removed; a new key does not change it.
pub const VERSION: u32 = 2;

/// The version of documents without the key.
fn unsaid() -> u32 {
    1
}

/// The origin of a document, and how to make it again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Provenance {
    /// The name of the command.
    pub kind: String,
    /// The version of `mms`.
    pub version: String,
    /// The version of the form of the document; 1 if the key is missing.
    #[serde(default = "unsaid")]
    pub document_version: u32,
    /// The command to type.
    pub command: String,
    /// The input.
    pub input: Input,
    /// The machine; null if the document is the same on every machine.
    pub machine: Option<Machine>,
}

/// The input of a command.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Input {
    /// The field as it was given; null for several fields.
    pub field: Option<String>,
    /// The rigid motion; empty for the standard one, null for none.
    pub rigid: Option<String>,
    /// The first and last time, if they were given in place of the file's.
    pub window: Option<[String; 2]>,
    /// The parameters that were set.
    pub set: Vec<String>,
    /// A hash of the texts of field and material.
    pub hash: String,
}

/// The machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Machine {
    /// The name of the processor.
    pub processor: String,
    /// The number of cores.
    pub cores: usize,
}
