//! The words of a study.

use std::ffi::OsString;

use clap::Parser;
use mms_runtime::Division;

use crate::field::{Motion, Variant};
use crate::method::MethodOptions;

/// The arguments of `mms study` that determine the runs.
#[derive(Clone, Debug, Parser)]
#[command(no_binary_name = true)]
pub struct Study {
    /// The name of a field of the gallery.
    pub field: String,
    /// The grids.
    #[arg(long, value_delimiter = ',', required = true)]
    pub cells: Vec<Division>,
    /// The method.
    #[command(flatten)]
    pub method: MethodOptions,
    /// Settings of parameters, `name=value`.
    #[arg(long)]
    pub set: Vec<String>,
    /// The variant of the motion.
    #[command(flatten)]
    pub motion: Motion,
}

impl Study {
    /// Reads a line of words.
    ///
    /// # Errors
    /// Words that `mms study` does not have.
    pub fn read(line: &str) -> anyhow::Result<Self> {
        Self::of_words(&arguments(line))
    }

    /// Reads words.
    ///
    /// # Errors
    /// Words that `mms study` does not have.
    pub fn of_words<W: Into<OsString> + Clone>(words: &[W]) -> anyhow::Result<Self> {
        Ok(Self::try_parse_from(words.iter().cloned())?)
    }

    /// The variant of the field.
    pub fn variant(&self) -> Variant {
        self.method.variant(&self.motion)
    }
}

/// The arguments of a line, split at blanks that are not between apostrophes.
pub fn arguments(line: &str) -> Vec<&str> {
    let parts = line.split('\'').enumerate();
    let words = parts.map(|(at, part)| match at % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    words.flatten().collect()
}
