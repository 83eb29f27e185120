//! The folder that emitted files are written to, or compared with.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use mms_codegen::emit::File;

use crate::report::write_whole;

/// Writes a file into a folder, whole or not at all, and returns its path.
pub fn write(folder: &Path, file: &File) -> anyhow::Result<String> {
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder `{}`", folder.display()))?;
    let path = folder.join(&file.name);
    write_whole(&path, &file.text).with_context(|| format!("cannot write `{}`", path.display()))?;
    Ok(path.display().to_string())
}

/// How a file in a folder compares with what would be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The same bytes.
    Current,
    /// Other bytes.
    Stale,
    /// No such file.
    Missing,
}

impl State {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            State::Current => "current",
            State::Stale => "stale",
            State::Missing => "missing",
        }
    }
}

/// Compares a file with that in a folder.
pub fn compare(folder: &Path, file: &File) -> anyhow::Result<(String, State)> {
    let path = folder.join(&file.name);
    let shown = path.display().to_string();
    let state = match fs::read(&path) {
        Ok(bytes) if bytes == file.text.as_bytes() => State::Current,
        Ok(_) => State::Stale,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => State::Missing,
        Err(error) => return Err(error).with_context(|| format!("cannot read `{shown}`")),
    };
    Ok((shown, state))
}
