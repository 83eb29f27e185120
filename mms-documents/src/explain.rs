//! The document of `mms explain`.

use serde::{Deserialize, Serialize};

/// Words with their meanings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Explain {
    /// The words that were asked for; all of them, if none was.
    pub terms: Vec<Term>,
}

/// A word with its meaning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Term {
    /// The word.
    pub term: String,
    /// Its meaning, in sentences.
    pub text: String,
}
