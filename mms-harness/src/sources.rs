//! The files that a pattern of `sources` names, within limits: a pattern such as `/**/*` would search the whole disk.

use std::fs;
use std::path::{Component, Path, PathBuf};

use glob::{MatchOptions, Pattern};
use mms_spec::foreign;

use super::digests::MOST;

/// The most files and folders that a pattern may visit.
const MOST_ENTRIES: usize = 100_000;

/// The most files that may match.
const MOST_FILES: usize = 10_000;

/// Finds the plain files that match a path or a pattern from a folder, sorted.
///
/// # Errors
/// The reason: no pattern, no such file, or too many files.
pub fn files(here: &Path, word: &str) -> Result<Vec<PathBuf>, String> {
    let (base, pattern) = parted(here, word);
    let mut found = match pattern.as_os_str().is_empty() {
        true => vec![base],
        false => fitting(&base, &pattern)?,
    };
    found.retain(|path| path.is_file());
    found.sort();
    let length: u64 = found.iter().filter_map(|path| Some(path.metadata().ok()?.len())).sum();
    match (found.len(), length) {
        (0, _) => Err("there is no such file".into()),
        (count, _) if count > MOST_FILES => Err(too_many(&format!("{MOST_FILES} files"))),
        (_, length) if length > MOST => Err(too_many(&format!("{MOST} bytes"))),
        _ => Ok(found),
    }
}

fn too_many(most: &str) -> String {
    format!(
        "it names more than {most}, the most that are read before a run: name a folder, as in \"src/**/*.c\""
    )
}

/// Splits a path before its first part that is a pattern.
fn parted(here: &Path, word: &str) -> (PathBuf, PathBuf) {
    let is_plain =
        |part: &Component<'_>| !part.as_os_str().to_string_lossy().contains(['*', '?', '[']);
    let mut parts = Path::new(word).components().peekable();
    let mut base = here.to_owned();
    while let Some(part) = parts.next_if(is_plain) {
        base.push(part);
    }
    (base, parts.collect())
}

/// Finds the files that match a pattern below a folder. Follows links to folders if the pattern limits the depth.
fn fitting(base: &Path, pattern: &Path) -> Result<Vec<PathBuf>, String> {
    let pattern = pattern.to_string_lossy();
    let depth = (!pattern.contains("**")).then(|| pattern.split('/').count());
    let own = Pattern::new(&pattern).map_err(|error| error.msg.to_owned())?;
    let options = MatchOptions { require_literal_separator: true, ..MatchOptions::default() };
    let (mut found, mut entries) = (Vec::new(), 0);
    let mut folders = vec![(base.to_owned(), 1)];
    while let Some((folder, level)) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            entries += 1;
            if entries > MOST_ENTRIES {
                return Err(format!(
                    "it leads through more than {MOST_ENTRIES} files below `{}`: name a folder nearer to the sources, as \
                     in \"src/**/*.c\"",
                    foreign::path(base)
                ));
            }
            let path = entry.path();
            let is_folder = match depth {
                None => entry.file_type().is_ok_and(|it| it.is_dir()),
                Some(depth) => level < depth && path.is_dir(),
            };
            if is_folder {
                folders.push((path, level + 1));
            } else if path.strip_prefix(base).is_ok_and(|it| own.matches_path_with(it, options)) {
                found.push(path);
            }
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_and_patterns_name_plain_files() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().join("it's [here]");
        fs::create_dir_all(here.join("a/b")).unwrap();
        for file in ["x.c", "y.h", "a/x.c", "a/b/x.c"] {
            mms_files::write::write_whole(&here.join(file), file).unwrap();
        }
        for (word, names) in [
            ("x.c", vec!["x.c"]),
            ("*.c", vec!["x.c"]),
            ("*", vec!["x.c", "y.h"]),
            ("**/*.c", vec!["a/b/x.c", "a/x.c", "x.c"]),
            ("a/**/*", vec!["a/b/x.c", "a/x.c"]),
            ("?/x.[ch]", vec!["a/x.c"]),
            ("a/../y.h", vec!["a/../y.h"]),
        ] {
            let found = files(&here, word).unwrap();
            let found = found.iter().map(|it| it.strip_prefix(&here).unwrap().to_str().unwrap());
            assert_eq!(found.collect::<Vec<_>>(), names, "{word}");
        }
        for word in ["none.c", "a", "*.f90", "none/**/*"] {
            assert_eq!(files(&here, word).unwrap_err(), "there is no such file", "{word}");
        }
        assert!(files(&here, "***").unwrap_err().contains("wildcards"));
    }

    #[test]
    #[cfg(unix)]
    fn no_pattern_leads_through_all_there_is() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        symlink(".", folder.path().join("circle")).unwrap();
        mms_files::write::write_whole(&folder.path().join("x.c"), "").unwrap();
        assert_eq!(files(folder.path(), "**/*.c").unwrap().len(), 1);
        assert_eq!(files(folder.path(), "*/*/*.c").unwrap().len(), 1);
        let sparse = fs::File::create(folder.path().join("mesh")).unwrap();
        sparse.set_len(MOST + 1).unwrap();
        let said = files(folder.path(), "*").unwrap_err();
        assert!(said.starts_with("it names more than 1073741824 bytes"), "{said}");
    }
}
