//! What a folder holds: results, and files that are none.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::Value;

use super::{Entry, Page, entry, states};
use crate::store;

impl Page {
    /// All results in a folder and in the folders in it. What is none is set aside; what a store of `mms verify`
    /// holds is counted.
    ///
    /// # Errors
    /// A folder that is not there, cannot be read, or has no results.
    pub fn read(folder: &Path) -> anyhow::Result<Self> {
        let shown = folder.display();
        if !folder.is_dir() {
            bail!("`{shown}`: not a folder; give the one that `--output` of other commands named");
        }
        let mut files = Vec::new();
        walk(folder, &mut files)?;
        let (mut entries, mut set_aside, mut stored) = (Vec::new(), Vec::new(), 0);
        for path in files.iter().filter(|path| !has_extension(path, "vtu")) {
            let name = path.strip_prefix(folder).unwrap_or(path).display().to_string();
            match read(path, &name)? {
                Found::Result(entry) => entries.push(*entry),
                Found::Stored => stored += 1,
                Found::Other(reason) => set_aside.push(format!("{name}: {reason}")),
            }
        }
        if stored > 0 {
            set_aside.push(format!(
                "{stored} results of single runs, kept by `mms verify --store`; `mms verify --output` writes the matrix"
            ));
        }
        if entries.is_empty() {
            set_aside.insert(0, format!("`{shown}`: no results in it; `mms study`, `run`, `verify`, `tradeoff`, `extremes` and `accuracy` write theirs with `--output`"));
            bail!("{}", set_aside.join("\n"));
        }
        let name = folder.canonicalize().ok();
        let name = name.as_deref().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        let page = Self::new(&format!("Results in {name}"), entries, set_aside);
        Ok(Self { read: files, ..page })
    }
}

/// What a file is.
enum Found {
    Result(Box<Entry>),
    /// One run of a store.
    Stored,
    /// None of these, and why.
    Other(String),
}

/// Files that may be results or parts of them, in the order of their paths.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> anyhow::Result<()> {
    let wrong = || format!("cannot read `{}`", folder.display());
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(wrong)? {
        let entry = entry.with_context(wrong)?;
        // A link may lead back to where it is.
        let is_folder = entry.file_type().with_context(wrong)?.is_dir();
        paths.push((entry.path(), is_folder));
    }
    paths.sort();
    for (path, is_folder) in paths {
        if is_folder {
            walk(&path, files)?;
        } else if ["json", "pvd", "vtu"].iter().any(|it| has_extension(&path, it)) {
            files.push(path);
        }
    }
    Ok(())
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|own| own == extension)
}

fn read(path: &Path, name: &str) -> anyhow::Result<Found> {
    let bytes = std::fs::read(path).with_context(|| format!("cannot read `{}`", path.display()))?;
    let Ok(text) = String::from_utf8(bytes) else { return Ok(Found::Other("not text".into())) };
    if has_extension(path, "pvd") {
        return Ok(match states::States::read(path, &text) {
            Ok(states) => Found::Result(Box::new(Entry {
                id: String::new(),
                heading: states::HEADING,
                file: name.to_owned(),
                provenance: None,
                section: Box::new(states),
            })),
            Err(error) => Found::Other(format!("{error:#}")),
        });
    }
    let document: Value = match serde_json::from_str(&text) {
        Ok(document) => document,
        Err(error) => return Ok(Found::Other(format!("not JSON: {error}"))),
    };
    if document.get("format").is_some_and(|format| format == store::FORMAT) {
        return Ok(Found::Stored);
    }
    Ok(entry(name, &document).map_or_else(Found::Other, |entry| Found::Result(Box::new(entry))))
}
