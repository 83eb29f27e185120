//! Reads files: only plain ones, and none longer than its kind allows.
//!
//! All files of the command are read here. A `FileKind` sets the limit: 1 MiB for a field, a material or a study, 16 MiB for a
//! document, a result in a store or a list of states, 256 MiB for a state. At most one byte more than the limit is read. The
//! limit of a checkpoint is the free memory, and the limit of its first line is 64 MiB. A history is read up to the length that
//! its checkpoint states. A FIFO, a device, a socket or a folder is not opened: it is named in the error, and skipped where
//! other files are read as well (`mms report`, stores). A pipe without a name is allowed, as `/dev/stdin`. `mms-macros` applies
//! the same rules for `field!`.

use std::fmt;
use std::fs::{self, File, FileType, Metadata};
use std::io::{self, Read as _};
use std::path::Path;

use anyhow::{Context as _, anyhow};
use mms_spec::MAX_FILE;
use mms_spec::foreign;
use mms_spec::source::Sources;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A field or a material.
    Field,
    /// A saved study.
    Study,
    /// A description of how to run a solver.
    Campaign,
    /// The names of arrays in the files of a code.
    Profile,
    /// A table of errors.
    Errors,
    /// Results that a solver wrote.
    Results,
    /// A document that a command wrote.
    Result,
    /// The result of one run in a store.
    Stored,
    /// The list of the states of a run.
    States,
    /// One state of a run.
    State,
    /// Compiled code of an emitted field.
    Object,
}

impl FileKind {
    /// The name of the kind in messages.
    fn name(self) -> &'static str {
        match self {
            FileKind::Field => "a field or material file",
            FileKind::Study => "a study file",
            FileKind::Campaign => "a campaign file",
            FileKind::Profile => "a profile of a code",
            FileKind::Errors => "a table of errors",
            FileKind::Results => "a file of results",
            FileKind::Result => "a result",
            FileKind::Stored => "a stored result",
            FileKind::States => "a list of states",
            FileKind::State => "a state",
            FileKind::Object => "compiled code",
        }
    }

    /// The largest number of bytes.
    pub fn most(self) -> u64 {
        match self {
            FileKind::Field
            | FileKind::Study
            | FileKind::Campaign
            | FileKind::Profile
            | FileKind::Errors => MAX_FILE as u64,
            FileKind::Result | FileKind::Stored | FileKind::States => 16 << 20,
            FileKind::State | FileKind::Object => 256 << 20,
            FileKind::Results => 8 << 30,
        }
    }

    /// Advice for a file that is too long.
    fn advice(self) -> &'static str {
        match self {
            FileKind::Field => "is it the right file? then write its formulas shorter, with [let]",
            FileKind::Study => "is it the right file? its keys are the options of `mms study`",
            FileKind::Campaign => {
                "is it the right file? it has [solver] and a [[study]] for each field"
            }
            FileKind::Profile => "is it the right file? it names the arrays of a code",
            FileKind::Errors => "is it the right file? it has a row for each run",
            FileKind::Results => "write fewer times to a file, or fewer quantities",
            FileKind::Result => {
                "write fewer things to one document, as with `--quantity` or `--row`"
            }
            FileKind::Stored => "remove it, and the run is made again",
            FileKind::States => "write fewer states, with `--frames`",
            FileKind::State => "draw it with ParaView, or run with fewer particles",
            FileKind::Object => "compile fewer quantities, with `--quantity`",
        }
    }
}

/// The reasons why a file was not read.
#[derive(Debug)]
pub enum Unread {
    /// The system reports an error.
    Failed(io::Error),
    /// The file is not plain, but of this type.
    NotPlain(&'static str),
    /// The file is longer than its kind allows.
    TooLong(FileKind),
    /// The file has more bytes than there is memory: its length, and the memory.
    NoRoom([u64; 2]),
}

impl std::error::Error for Unread {}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unread::Failed(error) => write!(f, "{error}"),
            Unread::NotPlain(what) => write!(f, "it is {what}, and only plain files are read"),
            Unread::NoRoom([length, room]) => write!(
                f,
                "it has {} MB, and there are {} MB of memory to read it in; `mms judge` and `mms diagnose` take more \
                 with `--max-memory MB`",
                length.div_ceil(1_000_000),
                room / 1_000_000
            ),
            Unread::TooLong(kind) => write!(
                f,
                "it has more than {} bytes, the most that {} may have: {}",
                kind.most(),
                kind.name(),
                kind.advice()
            ),
        }
    }
}

impl From<io::Error> for Unread {
    fn from(error: io::Error) -> Self {
        Unread::Failed(error)
    }
}

impl Unread {
    /// Whether there is no such file.
    pub fn is_missing(&self) -> bool {
        matches!(self, Unread::Failed(error) if error.kind() == io::ErrorKind::NotFound)
    }
}

/// Opens a plain file. Refuses others before opening them: a FIFO may block for ever, and opening a device may have effects.
pub fn open(path: &Path) -> Result<File, Unread> {
    open_where(path, Metadata::is_file)
}

/// Opens a plain file or a pipe without a name, such as `/dev/stdin`: a pipe has a process at its other end.
fn open_given(path: &Path) -> Result<File, Unread> {
    open_where(path, |found| found.is_file() || is_pipe(found))
}

fn open_where(path: &Path, fits: impl Fn(&Metadata) -> bool) -> Result<File, Unread> {
    let validate = |found: Metadata| match fits(&found) {
        true => Ok(()),
        false => Err(Unread::NotPlain(what(found.file_type()))),
    };
    validate(fs::metadata(path).map_err(|error| lost(path, error))?)?;
    #[expect(clippy::disallowed_methods, reason = "this is where files are opened")]
    let file = File::open(path)?;
    // The file may have been replaced since.
    validate(file.metadata()?)?;
    Ok(file)
}

/// Whether this is a pipe outside of all file systems.
#[cfg(unix)]
fn is_pipe(found: &Metadata) -> bool {
    use std::os::fd::OwnedFd;
    use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
    let device = |(reader, _): (io::PipeReader, io::PipeWriter)| {
        File::from(OwnedFd::from(reader)).metadata().map(|pipe| pipe.dev())
    };
    found.file_type().is_fifo() && io::pipe().and_then(device).is_ok_and(|it| it == found.dev())
}

#[cfg(not(unix))]
fn is_pipe(_: &Metadata) -> bool {
    false
}

/// Names the type of a file that is not plain.
pub fn what(file_type: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt as _;
        if file_type.is_fifo() {
            return "a FIFO";
        }
        if file_type.is_socket() {
            return "a socket";
        }
        if file_type.is_block_device() || file_type.is_char_device() {
            return "a device";
        }
    }
    match file_type {
        it if it.is_dir() => "a folder",
        it if it.is_symlink() => "a link",
        _ => "no plain file",
    }
}

/// Reports a link that leads nowhere as such, and not as a missing file.
fn lost(path: &Path, error: io::Error) -> Unread {
    let leads_nowhere = error.kind() == io::ErrorKind::NotFound && path.is_symlink();
    if leads_nowhere { Unread::NotPlain("a link that leads nowhere") } else { error.into() }
}

/// All bytes of a file of some kind.
pub fn bytes(path: &Path, kind: FileKind) -> Result<Vec<u8>, Unread> {
    all(open(path)?, kind)
}

/// All bytes of a file of some kind; fails if they exceed `room`.
pub fn bytes_within(path: &Path, kind: FileKind, room: u64) -> Result<Vec<u8>, Unread> {
    let file = open(path)?;
    match file.metadata()?.len() {
        length if length > room => Err(Unread::NoRoom([length, room])),
        _ => all(file, kind),
    }
}

fn all(file: File, kind: FileKind) -> Result<Vec<u8>, Unread> {
    let bytes = first_of(file, kind.most() + 1)?;
    if bytes.len() as u64 > kind.most() { Err(Unread::TooLong(kind)) } else { Ok(bytes) }
}

/// The first bytes of a file, at most `most`.
pub fn first(path: &Path, most: u64) -> Result<Vec<u8>, Unread> {
    Ok(first_of(open(path)?, most)?)
}

fn first_of(file: File, most: u64) -> io::Result<Vec<u8>> {
    // Reserves room for the whole file at once; a stream has length 0.
    let length = file.metadata().map_or(0, |it| it.len().min(most));
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length as usize + 1)?;
    file.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads the text of a file of some kind that a user has named, in UTF-8.
///
/// # Errors
/// A file that cannot be read, or is no text, and where.
pub fn text(path: &Path, kind: FileKind) -> anyhow::Result<String> {
    let bytes = open_given(path).and_then(|file| all(file, kind));
    let bytes = bytes.with_context(|| cannot_read(path))?;
    String::from_utf8(bytes).map_err(|error| {
        let mut sources = Sources::default();
        let text = String::from_utf8_lossy(error.as_bytes());
        let source = sources.add(path.to_string_lossy(), text);
        let odd = error.utf8_error().valid_up_to();
        let place = sources.place(sources.span(source, odd, odd));
        anyhow!("{place}: expected text in UTF-8; save the file in that encoding")
    })
}

/// The message that a file cannot be read.
pub fn cannot_read(path: &Path) -> String {
    format!("cannot read `{}`", foreign::path(path))
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::symlink;
    use std::process::Command;

    use super::*;

    /// Makes a file of this length that occupies no blocks.
    fn sparse(path: &Path, length: u64) {
        File::create(path).unwrap().set_len(length).unwrap();
    }

    #[test]
    fn no_file_is_read_beyond_what_its_kind_may_hold() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x");
        for kind in [
            FileKind::Field,
            FileKind::Study,
            FileKind::Campaign,
            FileKind::Result,
            FileKind::Stored,
            FileKind::States,
        ] {
            sparse(&path, kind.most());
            assert_eq!(bytes(&path, kind).unwrap().len() as u64, kind.most());
            for length in [kind.most() + 1, 3 << 30] {
                sparse(&path, length);
                let said = bytes(&path, kind).unwrap_err().to_string();
                assert!(said.contains(&kind.most().to_string()), "{said}");
                assert!(said.contains(kind.name()) && said.ends_with(kind.advice()), "{said}");
            }
        }
        assert_eq!(first(&path, 7).unwrap().len(), 7);
    }

    #[test]
    fn what_is_no_plain_file_is_named_and_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        assert!(Command::new("mkfifo").arg(at("fifo")).status().unwrap().success());
        let _socket = std::os::unix::net::UnixListener::bind(at("socket")).unwrap();
        for (link, target) in [("loop", "loop"), ("nowhere", "none"), ("to_fifo", "fifo")] {
            symlink(target, at(link)).unwrap();
        }
        for (name, what) in [
            ("fifo", "it is a FIFO"),
            ("to_fifo", "it is a FIFO"),
            ("socket", "it is a socket"),
            (".", "it is a folder"),
            ("/dev/zero", "it is a device"),
            ("nowhere", "it is a link that leads nowhere"),
            ("loop", "symbolic link"),
            ("missing", "No such file"),
        ] {
            let said = bytes(&at(name), FileKind::Field).unwrap_err().to_string();
            assert!(said.contains(what), "{name}: {said}");
        }
        assert!(bytes(&at("missing"), FileKind::Field).unwrap_err().is_missing());
        symlink("file", at("link")).unwrap();
        fs::write(at("file"), "text").unwrap();
        assert_eq!(text(&at("link"), FileKind::Field).unwrap(), "text");
    }
}
