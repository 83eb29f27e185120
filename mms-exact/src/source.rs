//! The text of a field, from wherever it was read.

use std::path::PathBuf;
use std::sync::Arc;

use mms_codegen::compile::{Failure, Loader, compile_unproved, own_quantities};
use mms_codegen::selection::Selection;
use mms_codegen::{Compiled, Options};
use mms_runtime::scene::Code;
use mms_spec::foreign::Foreign;
use mms_spec::own::Own;

use crate::gallery::Entry;

/// Reads the text of a material file beside a field file; an error says why it cannot.
type Load = Arc<dyn Fn(&str) -> Result<String, String> + Send + Sync>;

/// Opens the field that a user named: one of the gallery, or a file.
pub type Open<'a> = &'a (dyn Fn(&str) -> anyhow::Result<Source> + Sync);

/// A function that compiles the text of a field.
pub(crate) type Compile = fn(&str, &str, &str, Loader<'_>, &Options) -> Result<Compiled, Failure>;

/// The text of a field that a user named, to be compiled with one set of options or several.
#[derive(Clone)]
pub struct Source {
    /// The words by which the user named it.
    given: String,
    name: Foreign,
    path: Foreign,
    text: String,
    load: Load,
    origin: Origin,
}

/// The origin of a text.
#[derive(Clone)]
enum Origin {
    /// The gallery; with the compiled code of the field, where the program has it.
    Gallery(Option<Code>),
    /// A file.
    File(PathBuf),
}

impl Source {
    /// The text of a field of the gallery; `code` is its compiled code, if the program has it.
    pub fn shipped(entry: &'static Entry, code: Option<Code>) -> Self {
        Source {
            given: entry.name.into(),
            name: entry.name.into(),
            path: entry.path.into(),
            text: entry.text.into(),
            load: Arc::new(|_| entry.own_material()),
            origin: Origin::Gallery(code),
        }
    }

    /// The text of a field file at a path; `load` reads a material file beside it.
    pub fn file(
        path: PathBuf,
        text: String,
        load: impl Fn(&str) -> Result<String, String> + Send + Sync + 'static,
    ) -> Self {
        let given = path.to_string_lossy().into_owned();
        Source {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into(),
            path: given.as_str().into(),
            given,
            text,
            load: Arc::new(load),
            origin: Origin::File(path),
        }
    }

    /// The name of the field.
    pub fn name(&self) -> &Foreign {
        &self.name
    }

    /// The words by which the user named it.
    pub fn given(&self) -> &str {
        &self.given
    }

    /// The path of its file; `None` for a field of the gallery.
    pub(crate) fn path(&self) -> Option<&PathBuf> {
        match &self.origin {
            Origin::Gallery(_) => None,
            Origin::File(path) => Some(path),
        }
    }

    /// The compiled code of a field of the gallery, where the program has it.
    pub(crate) fn code(&self) -> Option<Code> {
        match self.origin {
            Origin::Gallery(code) => code,
            Origin::File(_) => None,
        }
    }

    /// Compiles the text without proofs, so that a field that contradicts its claims compiles too.
    ///
    /// # Errors
    /// The mistakes of the text, each at its place.
    pub fn compile(&self, options: &Options) -> Result<Compiled, Failure> {
        self.compile_as(compile_unproved, options)
    }

    pub(crate) fn compile_as(
        &self,
        compile: Compile,
        options: &Options,
    ) -> Result<Compiled, Failure> {
        compile(self.name.raw(), self.path.raw(), &self.text, &*self.load, options)
    }

    /// The quantities that the field defines.
    pub fn own_quantities(&self) -> Vec<Own> {
        own_quantities(self.name.raw(), self.path.raw(), &self.text, &*self.load)
    }

    /// The subject of a message about mistakes: the whole field, or the part of it that was selected.
    pub(crate) fn subject(&self, options: &Options) -> &'static str {
        // Which quantities are wanted makes no mistake.
        let selection = Selection { quantities: None, ..options.selection.clone() };
        match self.origin {
            _ if selection != Selection::default() => "the field does not compile as selected",
            Origin::Gallery(_) => "the field of the gallery does not compile",
            Origin::File(_) => "the field file has mistakes",
        }
    }
}
