//! A mistake in a file.

use std::fmt;

/// A mistake in a file, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The file; empty if only its bytes are known.
    pub path: String,
    /// The line, from 1 on, of a file that has lines.
    pub line: Option<usize>,
    /// The mistake, the expected content, and advice.
    pub what: String,
}

impl Mistake {
    /// A mistake of a file as a whole.
    pub fn new(what: impl Into<String>) -> Self {
        Mistake { path: String::new(), line: None, what: what.into() }
    }

    /// A mistake at a line.
    pub fn at(line: usize, what: impl Into<String>) -> Self {
        Mistake { line: Some(line), ..Self::new(what) }
    }

    /// Adds the file, if none is known yet.
    pub fn of(mut self, path: &str) -> Self {
        if self.path.is_empty() {
            self.path = path.to_owned();
        }
        self
    }
}

impl std::error::Error for Mistake {}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.path, self.what),
            None => write!(f, "{}: {}", self.path, self.what),
        }
    }
}
