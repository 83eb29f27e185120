//! The folder that emitted files are written to, or compared with.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use mms_emit::File;
use mms_files::read;
use mms_files::write::write_own;
use mms_spec::foreign;
use mms_spec::foreign::Foreign;

/// Writes a file into a folder, whole or not at all, and returns its path.
pub fn write(folder: &Path, file: &File) -> anyhow::Result<Foreign> {
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder `{}`", foreign::path(folder)))?;
    let path = folder.join(&file.name);
    write_own(&path, &file.text)
        .with_context(|| format!("cannot write `{}`", foreign::path(&path)))?;
    Ok(path.to_string_lossy().into())
}

/// How a file in a folder compares with what would be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// A file with the same bytes.
    Current,
    /// A file with other bytes.
    Stale,
    /// A missing file.
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
pub fn compare(folder: &Path, file: &File) -> anyhow::Result<(Foreign, State)> {
    let path = folder.join(&file.name);
    // One more byte is read, so that a longer file differs.
    let state = match read::first(&path, file.text.len() as u64 + 1) {
        Ok(bytes) if bytes == file.text.as_bytes() => State::Current,
        Ok(_) => State::Stale,
        Err(error) if error.is_missing() => State::Missing,
        Err(error) => return Err(error).with_context(|| read::cannot_read(&path)),
    };
    Ok((path.to_string_lossy().into(), state))
}
