//! The contents of a folder: results, and other files.

use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use mms_files::read::{self, FileKind};
use mms_files::store;
use mms_spec::foreign;
use serde_json::Value;

use super::{Entry, Page, entry, states};

impl Page {
    /// Reads all results in a folder and in the folders in it. Other files are set aside; results of a store are counted.
    ///
    /// # Errors
    /// A folder that is not there, cannot be read, or has no results.
    pub fn read(folder: &Path) -> anyhow::Result<Self> {
        let shown = foreign::path(folder);
        if !folder.is_dir() {
            bail!("`{shown}`: not a folder; give the one that `--output` of other commands named");
        }
        let (mut files, mut unread) = (Vec::new(), Vec::new());
        walk(folder, &mut files, &mut unread).with_context(|| read::cannot_read(folder))?;
        let (mut entries, mut set_aside, mut stored) = (Vec::new(), Vec::new(), 0);
        let name = |path: &Path| foreign::path(path.strip_prefix(folder).unwrap_or(path));
        let mut leave_out = |path: &Path, reason: &str| {
            set_aside.push(format!("{}: {}", name(path), foreign::shown(reason)));
        };
        for path in files.iter().filter(|path| !has_extension(path, "vtu")) {
            match found(path, &name(path)) {
                FolderFile::Result(entry) => entries.push(*entry),
                FolderFile::Stored => stored += 1,
                FolderFile::Other(reason) => leave_out(path, &reason),
            }
        }
        for (path, error) in unread {
            leave_out(&path, &format!("cannot be read: {error}"));
        }
        if stored > 0 {
            set_aside.push(format!(
                "{stored} results of single runs, kept by `mms verify --store` or `mms campaign`; `--output` of these \
                 writes a summary of them"
            ));
        }
        if entries.is_empty() {
            set_aside.insert(0, format!("`{shown}`: no results in it; `mms study`, `judge`, `diagnose`, `campaign`, `run`, `verify`, `tradeoff`, `extremes` and `accuracy` write theirs with `--output`"));
            bail!("{}", set_aside.join("\n"));
        }
        let name = folder.canonicalize().ok();
        let name = name.as_deref().and_then(Path::file_name).unwrap_or_default();
        let title = format!("Results in {}", foreign::path(Path::new(name)));
        Ok(Self { read: files, ..Self::new(&title, entries, set_aside) })
    }
}

/// A file of a folder, by its kind.
enum FolderFile {
    Result(Box<Entry>),
    /// One run of a store.
    Stored,
    /// Another file, and the reason.
    Other(String),
}

/// Files that may be results or parts of them, in the order of their paths; and folders that cannot be read.
fn walk(
    folder: &Path,
    files: &mut Vec<PathBuf>,
    unread: &mut Vec<(PathBuf, io::Error)>,
) -> io::Result<()> {
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        // A link may lead back to where it is.
        let is_folder = entry.file_type()?.is_dir();
        paths.push((entry.path(), is_folder));
    }
    paths.sort();
    for (path, is_folder) in paths {
        if is_folder {
            if let Err(error) = walk(&path, files, unread) {
                unread.push((path, error));
            }
        } else if ["json", "pvd", "vtu"].iter().any(|it| has_extension(&path, it)) {
            files.push(path);
        }
    }
    Ok(())
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|own| own == extension)
}

fn found(path: &Path, name: &str) -> FolderFile {
    read(path, name).unwrap_or_else(|error| FolderFile::Other(format!("{error:#}")))
}

fn read(path: &Path, name: &str) -> anyhow::Result<FolderFile> {
    let is_list = has_extension(path, "pvd");
    let bytes = read::bytes(path, if is_list { FileKind::States } else { FileKind::Result })?;
    let Ok(text) = String::from_utf8(bytes) else { bail!("not text") };
    if is_list {
        return Ok(FolderFile::Result(Box::new(Entry {
            id: String::new(),
            heading: states::HEADING,
            file: name.to_owned(),
            provenance: None,
            section: Box::new(states::States::read(path, &text)?),
        })));
    }
    let document: Value =
        serde_json::from_str(&text).map_err(|error| anyhow!("not JSON: {error}"))?;
    if document.get("format").is_some_and(|format| format == store::FORMAT) {
        return Ok(FolderFile::Stored);
    }
    Ok(entry(name, &document)
        .map_or_else(FolderFile::Other, |entry| FolderFile::Result(Box::new(entry))))
}
