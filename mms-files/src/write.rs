//! Writes files whole or not at all, and changes nothing else at their place.
//!
//! All files of the command are written here. Links stay, and a replaced file keeps its permissions. A device or a FIFO is
//! written to, once. In a named folder only plain files are written to: a user who names a folder means neither the target of a
//! link in it, nor a FIFO that may have no reader. Until a file is whole, it is called `.NAME.mms-unfinished0` (or 1, 2, ...)
//! in the same folder, and is locked. A file of this name without a lock was left by a killed process. The next process that
//! writes the same file removes it, and nothing else.

use std::ffi::OsString;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use mms_spec::foreign;
use tempfile::TempPath;

use crate::read;

/// The target of a path.
enum Target {
    /// A plain file, with links resolved; without metadata if it does not exist yet.
    Plain(PathBuf, Option<Metadata>),
    /// A device, a FIFO, or the stdout or stderr of this process: written bytes cannot be taken back.
    Stream,
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => {
                Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"))
            }
            Ok(found) if !found.is_file() || own(&found)?.is_some() => Ok(Target::Stream),
            Ok(found) => Ok(Target::Plain(without_links(path), Some(found))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Ok(Target::Plain(without_links(path), None))
            }
            Err(error) => Err(error),
        }
    }
}

/// Whether a path is a stream, such as a device or a FIFO, that must be written once and in one go.
pub fn is_stream(path: &Path) -> bool {
    matches!(Target::of(path), Ok(Target::Stream))
}

/// The folder that contains a file, with links resolved.
pub fn folder(path: &Path) -> PathBuf {
    let folder = without_links(path).parent().map(Path::to_owned).unwrap_or_default();
    if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder }
}

/// Writes a file; never leaves half a file under its final name.
pub fn write_whole(path: &Path, content: &str) -> anyhow::Result<()> {
    write_with(path, |file| Ok(file.write_all(content.as_bytes())?))
}

/// Writes a file under a name of ours in a folder that the user named. Refuses anything but plain files: a user who names a
/// folder means neither the target of a link in it, nor a FIFO that may have no reader.
pub fn write_own(path: &Path, content: &str) -> anyhow::Result<()> {
    write_own_with(path, |file| Ok(file.write_all(content.as_bytes())?))
}

/// Writes a file as [`write_own`] does, with a function that writes its content.
pub fn write_own_with(
    path: &Path,
    write: impl FnOnce(&mut File) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => Err(not_written_to(&found, "folder")),
        _ => write_with(path, write),
    }
}

/// Refuses a link, because the user who named it may not mean its target; `other` says what to name instead.
pub fn refuse_link(path: &Path, other: &str) -> anyhow::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => Err(not_written_to(&found, other)),
        _ => Ok(()),
    }
}

fn not_written_to(found: &Metadata, other: &str) -> anyhow::Error {
    let what = read::what(found.file_type());
    anyhow::anyhow!("it is {what}, which is not written to: remove it, or name another {other}")
}

/// Writes a file that must not exist yet: if it does, returns an error of the kind `AlreadyExists`.
pub fn write_new(path: &Path, content: &str) -> io::Result<()> {
    let mut new = Unfinished::of(path)?;
    new.file.write_all(content.as_bytes())?;
    new.path.persist_noclobber(path).map_err(|error| error.error)
}

/// Whether two paths lead to the same file through any folders and links, even if it does not exist.
pub fn is_same(one: &Path, other: &Path) -> bool {
    place(one) == place(other)
}

/// The unique path of a file.
fn place(path: &Path) -> PathBuf {
    let path = without_links(path);
    let folder = folder(&path);
    let folder = fs::canonicalize(&folder).unwrap_or(folder);
    path.file_name().map_or_else(|| folder.clone(), |name| folder.join(name))
}

/// Writes a file as [`write_whole`] does, with a function that writes its content. Links stay, and so do the permissions of a
/// replaced file; a device or a FIFO is written to.
pub fn write_with(
    path: &Path,
    write: impl FnOnce(&mut File) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let (path, replaced) = match Target::of(path)? {
        Target::Plain(path, replaced) => (path, replaced),
        Target::Stream => return write(&mut stream(path)?),
    };
    let mut new = Unfinished::of(&path)?;
    write(&mut new.file)?;
    if let Some(replaced) = replaced {
        new.file.set_permissions(replaced.permissions())?;
    }
    Ok(new.path.persist(&path).map_err(|error| error.error)?)
}

/// Writes texts to files of one stem in a folder, which is made if there is none, by their extensions; returns their paths.
pub fn write_files<const N: usize>(
    folder: &Path,
    stem: &str,
    files: [(&str, String); N],
) -> anyhow::Result<Vec<String>> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder `{}`", foreign::path(folder)))?;
    let write = |(extension, content): (&str, String)| {
        let path = folder.join(stem).with_extension(extension);
        let shown = foreign::path(&path);
        write_own(&path, &content).with_context(|| format!("cannot write `{shown}`"))?;
        Ok(shown)
    };
    files.into_iter().map(write).collect()
}

/// The text of a file with a JSON document.
pub fn pretty(document: &impl serde::Serialize) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// Whether a file could be written, without a trace of the attempt.
pub fn try_to_write(path: &Path) -> io::Result<()> {
    Unfinished::of(&without_links(path)).map(drop)
}

/// The number of unfinished files of one name that are removed after killed processes.
const WRITERS: u32 = 16;

/// Removes the unfinished files that killed processes left of a file.
pub fn remove_unfinished(path: &Path) {
    let path = without_links(path);
    for number in 0..WRITERS {
        let _ = remove_stale(&unfinished(&path, number));
    }
}

/// A file that is being written under another name in the same folder, and is locked meanwhile. Such a file without a lock was
/// left by a process that ended.
struct Unfinished {
    // Dropped first: the file is removed while it is locked.
    path: TempPath,
    file: File,
}

impl Unfinished {
    /// Makes the unfinished file of a file, under the first unused name.
    fn of(path: &Path) -> io::Result<Self> {
        for number in 0.. {
            let at = unfinished(path, number);
            // Tries again if the file was stale, or another process removed it as stale.
            loop {
                match create(&at) {
                    Ok(file) => {
                        let path = TempPath::try_from_path(&at)?;
                        // On systems without locks, no file counts as stale.
                        if file.lock().is_err() || leads_to(&at, &file) {
                            return Ok(Self { path, file });
                        }
                        let _ = path.keep();
                    }
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                        if !remove_stale(&at)? {
                            break;
                        }
                    }
                    Err(error) => return Err(error),
                }
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }
}

/// The most bytes of a file's name in the name of its unfinished file.
const MOST_OF_NAME: usize = 200;

/// The name of an unfinished file.
fn unfinished(path: &Path, number: u32) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let end = (0..=name.len().min(MOST_OF_NAME)).rev().find(|&end| name.is_char_boundary(end));
    let own = format!(".{}.mms-unfinished{number}", &name[..end.unwrap_or(0)]);
    folder(path).join(OsString::from(own))
}

/// Creates a file, which must not exist. Its permissions are the usual ones.
fn create(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create_new(true);
    options.open(path)
}

/// Removes a file that no process has locked; returns whether it did.
pub fn remove_stale(path: &Path) -> io::Result<bool> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => return Ok(false),
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
        Err(error) => return Err(error),
        Ok(_) => {}
    }
    let file = match OpenOptions::new().append(true).open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
        Err(_) => return Ok(false),
        Ok(file) => file,
    };
    if file.try_lock().is_err() {
        return Ok(false);
    }
    if leads_to(path, &file) {
        fs::remove_file(path)?;
    }
    Ok(true)
}

/// Whether a name still refers to a file.
#[cfg(unix)]
pub fn leads_to(path: &Path, file: &File) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let place = |found: io::Result<Metadata>| found.map(|it| (it.dev(), it.ino())).ok();
    place(file.metadata()).is_some_and(|own| place(fs::symlink_metadata(path)) == Some(own))
}

#[cfg(not(unix))]
pub fn leads_to(_: &Path, _: &File) -> bool {
    true
}

/// The most links in a chain before it counts as a circle, as in systems.
const MOST_LINKS: usize = 40;

/// The path with links resolved, whether its file exists or not. Follows at most [`MOST_LINKS`] links.
fn without_links(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&path) else { break };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    path
}

/// Opens a file that is not plain.
fn stream(path: &Path) -> io::Result<File> {
    match own(&fs::metadata(path)?)? {
        Some(file) => Ok(file),
        None => File::options().write(true).open(path),
    }
}

/// The stdout or stderr of this process, if `found` is it: opened by its name, as in `/dev/stdout`, a plain file would be
/// written from its start.
#[cfg(unix)]
fn own(found: &Metadata) -> io::Result<Option<File>> {
    use std::os::fd::AsFd as _;
    use std::os::unix::fs::MetadataExt as _;
    for stream in [io::stdout().as_fd(), io::stderr().as_fd()] {
        let Ok(stream) = stream.try_clone_to_owned() else { continue };
        let stream = File::from(stream);
        let its = stream.metadata()?;
        if (its.dev(), its.ino()) == (found.dev(), found.ino()) {
            return Ok(Some(stream));
        }
    }
    Ok(None)
}

#[cfg(not(unix))]
fn own(_: &Metadata) -> io::Result<Option<File>> {
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|it| it.unwrap().file_name());
        let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_a_killed_process_left_is_removed_and_what_another_writes_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x");
        let parts = [0, 1, 2].map(|number| unfinished(&path, number));
        // Files of a killed process, of a living one, and of another file.
        fs::write(&parts[0], "half").unwrap();
        let living = create(&parts[1]).unwrap();
        living.lock().unwrap();
        let other = unfinished(&folder.path().join("y"), 0);
        fs::write(&other, "half").unwrap();
        write_whole(&path, "whole").unwrap();
        let own = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
        assert_eq!(names(folder.path()), [own(&parts[1]), own(&other), "x".into()]);
        fs::write(&parts[0], "half").unwrap();
        remove_unfinished(&path);
        assert!(!parts[0].exists() && parts[1].exists());
        drop(living);
        fs::write(&parts[0], "half").unwrap();
        remove_unfinished(&path);
        assert_eq!(names(folder.path()), [own(&other), "x".into()]);
        assert_eq!(fs::read_to_string(path).unwrap(), "whole");
    }

    #[test]
    fn a_name_may_be_as_long_as_names_are() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["x".repeat(255), "\u{3bb}".repeat(127)] {
            let path = folder.path().join(name);
            write_whole(&path, "whole").unwrap();
            write_new(&path, "other").unwrap_err();
            assert_eq!(fs::read_to_string(path).unwrap(), "whole");
        }
        assert_eq!(names(folder.path()).len(), 2);
    }

    #[test]
    fn many_write_one_file_and_it_is_always_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x");
        std::thread::scope(|scope| {
            for writer in 0..8 {
                let path = &path;
                scope.spawn(move || {
                    for _ in 0..50 {
                        write_whole(path, &writer.to_string().repeat(9000)).unwrap();
                        let text = fs::read_to_string(path).unwrap();
                        assert!(
                            text.len() == 9000 && text.bytes().all(|it| it == text.as_bytes()[0])
                        );
                    }
                });
            }
        });
        assert_eq!(names(folder.path()), ["x"]);
    }

    #[test]
    #[cfg(unix)]
    fn a_link_in_a_folder_is_not_written_through() {
        let folder = tempfile::tempdir().unwrap();
        let [link, target] = ["link", "target"].map(|name| folder.path().join(name));
        fs::write(&target, "mine").unwrap();
        std::os::unix::fs::symlink("target", &link).unwrap();
        let said = write_own(&link, "other").unwrap_err().to_string();
        assert!(said.contains("it is a link, which is not written to"), "{said}");
        assert_eq!(fs::read_to_string(&target).unwrap(), "mine");
        write_own(&target, "other").unwrap();
        assert_eq!(fs::read_to_string(&target).unwrap(), "other");
    }
}
