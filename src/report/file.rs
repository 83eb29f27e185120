//! How files are read and written: whole or not at all, without a change to what else is at their place.

use std::fs::{self, File, Metadata};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow};
use mms_codegen::source::Sources;

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
pub(crate) fn is_stream(path: &Path) -> bool {
    matches!(Target::of(path), Ok(Target::Stream))
}

/// The folder that holds a file, behind its links.
pub(crate) fn folder(path: &Path) -> PathBuf {
    let folder = without_links(path).parent().map(Path::to_owned).unwrap_or_default();
    if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder }
}

/// Never leaves half a file under its final name.
pub(crate) fn write_whole(path: &Path, content: &str) -> anyhow::Result<()> {
    write_with(path, |file| Ok(file.write_all(content.as_bytes())?))
}

/// The same, of a file that must not be there yet: an error of the kind `AlreadyExists` if it is.
pub(crate) fn write_new(path: &Path, content: &str) -> io::Result<()> {
    let mut file = builder().tempfile_in(folder(path))?;
    file.write_all(content.as_bytes())?;
    file.persist_noclobber(path)?;
    Ok(())
}

/// The text of a file, in UTF-8.
///
/// # Errors
/// A file that cannot be read, or is no text, and where.
pub(crate) fn read(path: &Path) -> anyhow::Result<String> {
    let shown = path.display();
    let bytes = fs::read(path).with_context(|| format!("cannot read `{shown}`"))?;
    String::from_utf8(bytes).map_err(|error| {
        let mut sources = Sources::default();
        let text = String::from_utf8_lossy(error.as_bytes());
        let source = sources.add(shown.to_string(), text);
        let odd = error.utf8_error().valid_up_to();
        let place = sources.place(sources.span(source, odd, odd));
        anyhow!("{place}: expected text in UTF-8; save the file in that encoding")
    })
}

/// Whether two paths lead to the same file, there or not, by whatever folders and links.
pub(crate) fn is_same(one: &Path, other: &Path) -> bool {
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
pub(crate) fn write_with(
    path: &Path,
    write: impl FnOnce(&mut File) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let (path, replaced) = match Target::of(path)? {
        Target::Plain(path, replaced) => (path, replaced),
        Target::Stream => return write(&mut stream(path)?),
    };
    let mut file = builder().tempfile_in(folder(&path))?;
    write(file.as_file_mut())?;
    if let Some(replaced) = replaced {
        file.as_file().set_permissions(replaced.permissions())?;
    }
    file.persist(&path)?;
    Ok(())
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

/// A temporary file is private by default; these are results, as open as any other file.
fn builder() -> tempfile::Builder<'static, 'static> {
    #[cfg_attr(not(unix), allow(unused_mut))]
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}
