//! Compiles a field, and refuses contradictions in it.

use crate::certify::certificate::contradictions;
use crate::compile::{Compiled, Failure, Loader, Options, compile_unproved};

/// Compiles the text of a field file with all quantities, within the default limits.
///
/// `name` is the field's name (its file's stem), `path` is shown in messages. The failure lists every mistake of the file and
/// of its material.
pub fn compile(name: &str, path: &str, text: &str, load: Loader<'_>) -> Result<Compiled, Failure> {
    compile_with(name, path, text, load, &Options::default())
}

/// Compiles a part of a field, the field with some parameters fixed, or within other limits.
///
/// The failure also lists mistakes of the selection, which [`Selection::entry`](crate::Selection::entry) identifies, and the
/// contradictions that a short search finds: see [`contradictions`].
pub fn compile_with(
    name: &str,
    path: &str,
    text: &str,
    load: Loader<'_>,
    options: &Options,
) -> Result<Compiled, Failure> {
    let compiled = compile_unproved(name, path, text, load, options)?;
    match contradictions(&compiled) {
        found if found.is_empty() => Ok(compiled),
        diagnostics => Err(Failure { sources: compiled.sources, diagnostics }),
    }
}
