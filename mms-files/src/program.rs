//! The running program: its file, the words that start it, and its arguments.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::SystemTime;

use anyhow::Context as _;
use mms_spec::foreign;

/// A program without an executable file of its own: a library that another program runs as a command.
#[derive(Debug)]
pub struct Program {
    /// The file with the code.
    pub file: PathBuf,
    /// The words that start it, before its arguments.
    pub words: Vec<OsString>,
    /// The arguments, without the name of the program.
    pub arguments: Vec<OsString>,
}

/// The program, if it is a library.
static PROGRAM: OnceLock<Program> = OnceLock::new();

/// Declares, before the first use, that this code is in a library.
pub fn set(program: Program) {
    PROGRAM.get_or_init(|| program);
}

/// The arguments of this program, its name first.
pub fn arguments() -> Vec<OsString> {
    match PROGRAM.get() {
        Some(program) => [&["mms".into()], &*program.arguments].concat(),
        None => std::env::args_os().collect(),
    }
}

/// Finds the words that start this program, even if its file has been replaced.
///
/// # Errors
/// This program cannot be found.
pub fn words() -> anyhow::Result<Vec<OsString>> {
    let own = Path::new("/proc/self/exe");
    match PROGRAM.get() {
        Some(program) => Ok(program.words.clone()),
        None if own.exists() => Ok(vec![own.into()]),
        None => Ok(vec![file()?.into()]),
    }
}

/// Identifies the build of this program: results of another build are not used.
///
/// # Errors
/// This program's file cannot be found, or its length and time cannot be read.
pub fn identity() -> anyhow::Result<String> {
    let path = file()?;
    let built = || {
        let file = path.metadata()?;
        let modified = file.modified()?.duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        io::Result::Ok((file.len(), modified.as_nanos()))
    };
    let (length, modified) = built()
        .with_context(|| format!("cannot look at this program, `{}`", foreign::path(&path)))?;
    Ok(format!("{}, {length} bytes, {modified}", env!("CARGO_PKG_VERSION")))
}

/// The file with the code of this program.
fn file() -> anyhow::Result<PathBuf> {
    match PROGRAM.get() {
        Some(program) => Ok(program.file.clone()),
        None => std::env::current_exe().context("cannot find this program"),
    }
}
