//! Files of results on the disk: a file, a list of states, a folder, a pattern.

use std::error::Error;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use mms_results::Files;
use mms_spec::foreign;

use crate::machine::memory;
use crate::read::{self, FileKind, cannot_read};

/// The extensions of files that list pieces of one mesh; the pieces are no meshes of their own.
const PIECES: &[&str] = &["vtm", "vtpc", "pvtu", "pvtp", "pvti", "pvtr", "pvts"];

/// The extensions of files of results, in groups: if a folder has files of one group, the next group is not searched.
const ENDS: [&[&str]; 2] = [
    &["vtu", "vtp", "vti", "vtr", "vts", "vtk", "npz", "npy", "csv", "tsv"],
    &["xdmf", "vtkhdf", "e", "exo", "h5", "hdf5", "nc", "mat", "frd", "msh", "dat", "tec", "dump"],
];

/// Files of results on the disk.
pub struct Disk;

impl Files for Disk {
    fn paths(&self, given: &str) -> Result<Vec<PathBuf>, Box<dyn Error + Send + Sync>> {
        Ok(paths(given)?)
    }

    fn bytes(&self, path: &Path, room: u64) -> Result<Vec<u8>, String> {
        read::bytes_within(path, FileKind::Results, room)
            .map_err(|error| format!("cannot read it: {error}"))
    }

    fn memory(&self) -> u64 {
        memory()
    }
}

/// Finds the files of a name, and checks that all of them exist.
///
/// # Errors
/// No file of this name.
pub fn existing(given: &str) -> anyhow::Result<Vec<PathBuf>> {
    let found = paths(given)?;
    match found.iter().find(|path| !path.is_file()) {
        Some(path) => bail!("`{}`: no such file", foreign::path(path)),
        None => Ok(found),
    }
}

/// Splits a name into pieces: text, the number of the following digits without leading zeros, and these digits. In their order
/// `out_9` precedes `out_10`.
fn pieces(path: &Path) -> Vec<(String, usize, String)> {
    let name = path.to_string_lossy();
    let (mut pieces, mut rest) = (Vec::new(), &*name);
    while !rest.is_empty() {
        let is_digit = |it: char| it.is_ascii_digit();
        let (text, after) = rest.split_at(rest.find(is_digit).unwrap_or(rest.len()));
        let end = after.find(|it| !is_digit(it)).unwrap_or(after.len());
        let number = after[..end].trim_start_matches('0');
        pieces.push((text.to_owned(), number.len(), number.to_owned()));
        rest = &after[end..];
    }
    pieces
}

/// Sorts files by name, and the numbers in names by value.
fn sort(files: &mut [PathBuf]) {
    files.sort_by_cached_key(|it| (pieces(it), it.clone()));
}

/// Finds the files of a name, sorted by name with numbers in numeric order.
fn paths(given: &str) -> anyhow::Result<Vec<PathBuf>> {
    let path = Path::new(given);
    if path.is_dir() {
        return folder(path);
    }
    if path.exists() || !given.contains(['*', '?', '[']) {
        return Ok(vec![path.to_owned()]);
    }
    let found = glob::glob(given).with_context(|| format!("`{given}`: not a pattern"))?;
    let found = found.filter_map(Result::ok).filter(|path| path.is_file());
    let mut found: Vec<_> = found.collect();
    if found.is_empty() {
        bail!("`{given}`: no file fits the pattern");
    }
    sort(&mut found);
    Ok(found)
}

/// Finds the list of states in a folder, or its files of results.
fn folder(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let entries = path.read_dir().with_context(|| cannot_read(path))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|it| it.ok().map(|it| it.path())).collect();
    sort(&mut files);
    let ending = |end: &str| -> Vec<PathBuf> {
        let fits =
            |file: &&PathBuf| file.extension().is_some_and(|it| it.eq_ignore_ascii_case(end));
        files.iter().filter(fits).cloned().collect()
    };
    let of = |ends: &[&str]| -> Vec<PathBuf> { ends.iter().flat_map(|it| ending(it)).collect() };
    let lists = of(&["pvd", "series"]);
    if lists.len() > 1 {
        bail!(
            "`{}`: it holds {} lists of states (.pvd, .series); name one of them",
            foreign::path(path),
            lists.len()
        );
    }
    let groups = [lists, of(PIECES)].into_iter().chain(ENDS.map(of));
    groups.into_iter().find(|it| !it.is_empty()).ok_or_else(|| {
        let known = ENDS.concat().iter().map(|it| format!(".{it}")).collect::<Vec<_>>().join(", ");
        anyhow!("`{}`: it holds no results: expected {known}", foreign::path(path))
    })
}

#[cfg(test)]
mod tests {
    use super::{PathBuf, sort};

    #[test]
    fn numbers_in_names_stand_in_their_order() {
        let right = ["a/9.csv", "a/10.csv", "out", "out_8.csv", "out_009.csv", "out_10.csv"];
        let mut files: Vec<PathBuf> = right.iter().rev().map(PathBuf::from).collect();
        sort(&mut files);
        assert_eq!(files, right.map(PathBuf::from));
    }
}
