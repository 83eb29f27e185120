//! What a target language is, what it takes, and what it makes.

use std::sync::OnceLock;

use crate::port::Port;
use crate::port::callable::Callable;
use crate::port::names::Rules;
use crate::port::vectors::Vectors;
use mms_codegen::certify::certificate::reach_at;
use mms_codegen::compile::Compiled;
use mms_codegen::rust::File;
use mms_symbolic::sorted::SortedMap;

/// Names as they are in the file.
const ANY: Rules = Rules { words: &[], modules: &[], folds_case: false, longest: 120 };

/// A field that is emitted, in one language or more: its test vectors and its extent are computed once.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    pub(crate) compiled: &'a Compiled,
    vectors: OnceLock<Vectors>,
    reach: OnceLock<Vec<[f64; 2]>>,
}

impl<'a> Subject<'a> {
    /// What a field was compiled for.
    pub fn new(compiled: &'a Compiled) -> Self {
        Subject { compiled, vectors: OnceLock::new(), reach: OnceLock::new() }
    }

    /// The test vectors, which are the same in every language.
    pub fn vectors(&self) -> &Vectors {
        self.vectors.get_or_init(|| Port::new(self, &ANY).compute_vectors())
    }

    /// Bounds of x by axis over body and time window, at the defaults of parameters; infinite where none is found. Of an
    /// axisymmetric field they are those of the distance from the axis and of the coordinate along it.
    pub fn reach(&self) -> &[[f64; 2]] {
        self.reach.get_or_init(|| reach_at(self.compiled, &SortedMap::new()))
    }

    /// Whether a check program has something to compare: a point where all functions have a value, if there are
    /// functions of points.
    pub fn has_values(&self) -> bool {
        let is_needed = Port::new(self, &ANY).callables.iter().any(Callable::is_of_points);
        !is_needed || !self.vectors().samples.is_empty()
    }
}

/// What a target makes of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// The files: the one that a solver uses first; the check program, where there is one, and its test vectors last.
    pub files: Vec<File>,
    /// The line that builds and runs the check program in their folder, where there is one.
    pub verify: Option<String>,
}

impl Bundle {
    /// The files that a solver needs.
    pub fn sources(&self) -> &[File] {
        let others = if self.verify.is_some() { 2 } else { 0 };
        &self.files[..self.files.len() - others]
    }
}

/// A language that code is emitted in.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The word of the command line.
    pub name: &'static str,
    /// Another word for it, where a second language reads the same files.
    pub alias: Option<&'static str>,
    /// What comes out, in one line.
    pub doc: &'static str,
    /// Emits what a field was compiled for.
    pub emit: fn(&Subject<'_>) -> Bundle,
    /// The words that mean something in the language or in what is emitted: parameters that are called
    /// so are renamed.
    pub words: &'static [&'static str],
}
