//! How files are written: whole or not at all, without a change to what else is at their place.
//!
//! All files of the command are written here. A link stays, a file that is replaced keeps its permissions, and a
//! device or a FIFO is written to, once. What is no plain file, in a folder that was named, is not written to: who
//! named the folder named neither what is behind a link, nor a FIFO that may have no reader. Until it is whole, a
//! file is called `.NAME.mms-unfinished0` (or 1, 2, ...) beside its place, and is locked. One that nobody has
//! locked was left by a process that was killed: the next process that writes the same file removes it, and
//! nothing else.

use std::ffi::OsString;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use mms_spec::foreign;
use tempfile::TempPath;

use crate::read;

/// Where a path leads.
enum Target {
    /// To a plain file, here without links on the way, or to none yet.
    Plain(PathBuf, Option<Metadata>),
    /// To a device, a FIFO, or the stdout or stderr of this process: what is written there is gone.
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

/// Whether what is written to a path is gone, as to a device or a FIFO, and so can be written once and in one go.
pub fn is_stream(path: &Path) -> bool {
    matches!(Target::of(path), Ok(Target::Stream))
}

/// The folder that holds a file, behind its links.
pub fn folder(path: &Path) -> PathBuf {
    let folder = without_links(path).parent().map(Path::to_owned).unwrap_or_default();
    if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder }
}

/// Never leaves half a file under its final name.
pub fn write_whole(path: &Path, content: &str) -> anyhow::Result<()> {
    write_with(path, |file| Ok(file.write_all(content.as_bytes())?))
}

/// The same, of a file in a folder that was named, by a name of ours. Nothing but a plain file is written to there: who
/// named the folder named neither what is behind a link, nor a FIFO that may have no reader.
pub fn write_own(path: &Path, content: &str) -> anyhow::Result<()> {
    write_own_with(path, |file| Ok(file.write_all(content.as_bytes())?))
}

/// As [`write_own`], with whatever is written.
pub fn write_own_with(
    path: &Path,
    write: impl FnOnce(&mut File) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => Err(not_written_to(&found, "folder")),
        _ => write_with(path, write),
    }
}

/// Refuses a link, whose user named the link and not what it leads to; `other` says what to name in its place.
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

/// The same, of a file that must not be there yet: an error of the kind `AlreadyExists` if it is.
pub fn write_new(path: &Path, content: &str) -> io::Result<()> {
    let mut new = Unfinished::of(path)?;
    new.file.write_all(content.as_bytes())?;
    new.path.persist_noclobber(path).map_err(|error| error.error)
}

/// Whether two paths lead to the same file, there or not, by whatever folders and links.
pub fn is_same(one: &Path, other: &Path) -> bool {
    place(one) == place(other)
}

/// The one path of a file.
fn place(path: &Path) -> PathBuf {
    let path = without_links(path);
    let folder = folder(&path);
    let folder = fs::canonicalize(&folder).unwrap_or(folder);
    path.file_name().map_or_else(|| folder.clone(), |name| folder.join(name))
}

/// As [`write_whole`], with whatever is written. A link stays, and so do the permissions of a file that is replaced; a device or a
/// FIFO is written to.
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

/// Writes texts to files of one stem in a folder, which is made if there is none, by their extensions; returns
/// their paths.
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

/// The content of a file with a JSON document.
pub fn pretty(document: &impl serde::Serialize) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// Whether a file could be written, without a trace of the attempt.
pub fn try_to_write(path: &Path) -> io::Result<()> {
    Unfinished::of(&without_links(path)).map(drop)
}

/// As many processes that write one file at the same time are cleaned up after.
const WRITERS: u32 = 16;

/// Removes what earlier processes left of a file that they were killed over.
pub fn remove_unfinished(path: &Path) {
    let path = without_links(path);
    for number in 0..WRITERS {
        let _ = remove_stale(&unfinished(&path, number));
    }
}

/// A file on its way to its name: it has another one in the same folder until then, which says of what it is a part, and is
/// locked as long as it is written. One that nobody has locked is left of a process that ended.
struct Unfinished {
    // Dropped first: removed while it is locked.
    path: TempPath,
    file: File,
}

impl Unfinished {
    /// The part of a file, by the first name that nobody uses.
    fn of(path: &Path) -> io::Result<Self> {
        for number in 0.. {
            let at = unfinished(path, number);
            // Once more, if it was stale, or somebody took it for stale.
            loop {
                match create(&at) {
                    Ok(file) => {
                        let path = TempPath::try_from_path(&at)?;
                        // Where there are no locks, nothing is taken for stale.
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

/// As much of a file's name as leaves room for what makes it that of a part.
const MOST_OF_NAME: usize = 200;

/// The name of a part of a file.
fn unfinished(path: &Path, number: u32) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let end = (0..=name.len().min(MOST_OF_NAME)).rev().find(|&end| name.is_char_boundary(end));
    let own = format!(".{}.mms-unfinished{number}", &name[..end.unwrap_or(0)]);
    folder(path).join(OsString::from(own))
}

/// Opens a file that is not there yet. These are results, as open as any other file.
fn create(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create_new(true);
    options.open(path)
}

/// Removes a file that no process has locked; whether it did.
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

/// Whether a name is still that of a file.
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

/// How many links lead on from each other before they are taken for a circle, as systems do.
const MOST_LINKS: usize = 40;

/// The place that a path leads to, a file or none. Links in circles are followed for a while.
fn without_links(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&path) else { break };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    path
}

/// Opens what is no plain file.
fn stream(path: &Path) -> io::Result<File> {
    match own(&fs::metadata(path)?)? {
        Some(file) => Ok(file),
        None => File::options().write(true).open(path),
    }
}

/// The stdout or stderr of this process, if that is what was found: under its name, as in `/dev/stdout`, a plain file would
/// be written from its start.
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
        // Of a killed process, of a living one, of another file.
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
