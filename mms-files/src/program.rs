//! The program that this code is in: its file, the words that start it, and the arguments that it was given.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::SystemTime;

use anyhow::Context as _;
use mms_spec::foreign;

/// A program that is no executable file of its own: a library which another program runs as a command.
#[derive(Debug)]
pub struct Program {
    /// The file with the code.
    pub file: PathBuf,
    /// The words that start it, before its arguments.
    pub words: Vec<OsString>,
    /// The arguments that it was given, without a name of the program.
    pub arguments: Vec<OsString>,
}

/// The program, where it is none of its own.
static PROGRAM: OnceLock<Program> = OnceLock::new();

/// Says once, before anything asks for it, that this code is in a library.
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

/// The words that start this program, also where its file has been replaced.
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

/// The text that tells this program from any other: no result outlives the code that computed it.
///
/// # Errors
/// This program cannot be found or looked at.
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
