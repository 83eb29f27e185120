//! Compiles a field, and refuses what contradicts it.

use crate::certify::certificate::contradictions;
use crate::compile::{Compiled, Failure, Loader, Options, compile_unproved};

/// Compiles the text of a field file, all of it, within the default limits.
///
/// `name` is the field's name (its file's stem), `path` what messages show. Every mistake of the
/// file and of its material is in the failure.
pub fn compile(name: &str, path: &str, text: &str, load: Loader<'_>) -> Result<Compiled, Failure> {
    compile_with(name, path, text, load, &Options::default())
}

/// Compiles a part of a field, the field with some parameters fixed, or within other limits.
///
/// Mistakes of the selection are in the failure too; [`Selection::entry`](crate::Selection::entry) tells them apart. So is
/// what a short search finds to contradict the field: see [`contradictions`].
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
