//! Target languages: the inputs and the files of each.

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

/// A field that is emitted in one or more languages: its test vectors and its extent are computed once.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    pub(crate) compiled: &'a Compiled,
    vectors: OnceLock<Vectors>,
    reach: OnceLock<Vec<[f64; 2]>>,
}

impl<'a> Subject<'a> {
    /// Prepares a compiled field for emission.
    pub fn new(compiled: &'a Compiled) -> Self {
        Subject { compiled, vectors: OnceLock::new(), reach: OnceLock::new() }
    }

    /// The test vectors, which are the same in every language.
    pub fn vectors(&self) -> &Vectors {
        self.vectors.get_or_init(|| Port::new(self, &ANY).compute_vectors())
    }

    /// Bounds of x by axis over body and time window, at the defaults of parameters; infinite if none is found. For an
    /// axisymmetric field: bounds of the distance from the axis and of the coordinate along it.
    pub fn reach(&self) -> &[[f64; 2]] {
        self.reach.get_or_init(|| reach_at(self.compiled, &SortedMap::new()))
    }

    /// Whether a check program has something to compare: a point where all functions have a value, if there are functions of
    /// points.
    pub fn has_values(&self) -> bool {
        let is_needed = Port::new(self, &ANY).callables.iter().any(Callable::is_of_points);
        !is_needed || !self.vectors().samples.is_empty()
    }
}

/// The files that a target emits for a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// The files: the one that a solver uses first; last the check program, if there is one, and its test vectors.
    pub files: Vec<File>,
    /// The line that builds and runs the check program in the folder of the files, if there is one.
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
    /// Another word for the target, if a second language reads the same files.
    pub alias: Option<&'static str>,
    /// A description of the emitted files, in one line.
    pub doc: &'static str,
    /// Emits a compiled field.
    pub emit: fn(&Subject<'_>) -> Bundle,
    /// The words that mean something in the language or in emitted code: parameters with such a name are renamed.
    pub words: &'static [&'static str],
}
