//! The document of `mms explain`.

use serde::{Deserialize, Serialize};

/// Words with their meanings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Explain {
    /// The requested words; all words, if none was requested.
    pub terms: Vec<Term>,
}

/// A word with its meaning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Term {
    /// The word.
    pub term: String,
    /// The meaning of the word, in sentences.
    pub text: String,
}
