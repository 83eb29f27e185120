//! Errors, with their places in the text.

use mms_codegen::compile::Failure;
use mms_exact::Mistaken;
use mms_spec::source::{Sources, Span};
use serde::Serialize;

/// A mistake of a request.
#[derive(Debug, Serialize)]
pub struct Mistake {
    message: String,
    /// The mistakes of a text, each at its place.
    diagnostics: Vec<Diagnostic>,
}

/// A message about one place of a text.
#[derive(Debug, Serialize)]
pub struct Diagnostic {
    /// The file: the field's or the material's.
    path: String,
    /// The first line, from 1 on.
    line: usize,
    /// The first column, in characters from 1 on.
    column: usize,
    end_line: usize,
    /// The column behind the last one.
    end_column: usize,
    message: String,
    label: String,
    help: Vec<String>,
    severity: &'static str,
}

impl Mistake {
    /// A mistake without a place.
    pub fn of(message: impl Into<String>) -> Self {
        Mistake { message: message.into(), diagnostics: Vec::new() }
    }
}

impl From<Failure> for Mistake {
    fn from(failure: Failure) -> Self {
        let place = |it| Diagnostic::of(&failure.sources, it);
        Mistake {
            message: failure.to_string(),
            diagnostics: failure.diagnostics.iter().map(place).collect(),
        }
    }
}

impl From<anyhow::Error> for Mistake {
    fn from(error: anyhow::Error) -> Self {
        match error.downcast::<Mistaken>() {
            Ok(mistaken) => mistaken.failure.into(),
            Err(error) => Self::of(format!("{error:#}")),
        }
    }
}

impl From<serde_json::Error> for Mistake {
    fn from(error: serde_json::Error) -> Self {
        Self::of(format!("the request: {error}"))
    }
}

impl Diagnostic {
    /// A diagnostic of the compiler.
    pub fn of(sources: &Sources, it: &mms_spec::diagnostic::Diagnostic) -> Self {
        let (line, column) = sources.location(it.span);
        let (end_line, end_column) = sources.location(Span { start: it.span.end, ..it.span });
        Diagnostic {
            path: sources.get(it.span.source).path.raw().to_owned(),
            line,
            column,
            end_line,
            end_column,
            message: it.message.clone(),
            label: it.label.clone(),
            help: it.help.clone(),
            severity: if it.is_warning { "warning" } else { "error" },
        }
    }
}
