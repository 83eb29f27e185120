//! What is wrong with a file.

use std::fmt;

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The file; empty where only its bytes are known.
    pub path: String,
    /// The line, from 1 on, of a file that has lines.
    pub line: Option<usize>,
    /// What is wrong, what was expected, and what to do.
    pub what: String,
}

impl Mistake {
    /// Of a file as a whole.
    pub fn new(what: impl Into<String>) -> Self {
        Mistake { path: String::new(), line: None, what: what.into() }
    }

    /// At a line.
    pub fn at(line: usize, what: impl Into<String>) -> Self {
        Mistake { line: Some(line), ..Self::new(what) }
    }

    /// The same in a file, if none is known yet.
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
