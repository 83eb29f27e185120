//! Checkpoints of a run, each in one file that is replaced when the next one is whole.
//!
//! A run that resumes from a checkpoint ends with the same bits as a run that never stopped. The file has a line of JSON
//! (format, digest of the scene, command, step, length and CRC-32 of the history so far), the state by postcard, and a
//! CRC-32 of both. The digest excludes threads, which change no bit. A resumed run does not use rows of the history that
//! have changed since. The file is written beside the old one and renamed. It is trusted only if its checksum is right,
//! and its scene and program are the same; otherwise it is refused by name, and not changed.

use std::fs::File;
use std::io::{BufRead as _, BufReader, BufWriter, Read, Seek as _, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use crc32fast::Hasher;
use mms_files::read;
use mms_files::shell::quoted;
use mms_files::write::write_with;
use mms_files::write::{is_stream, remove_unfinished, try_to_write};
use mms_runtime::study::Checkpoint;
use mms_spec::foreign;
use mms_spec::foreign::Foreign;
use serde::{Deserialize, Serialize};

use crate::history::Mark;

/// The value of the first key of every file.
const FORMAT: &str = "mms checkpoint 2";

/// Bytes of the checksum.
const SUM: u64 = 4;

/// The largest number of bytes of the first line: a state that was written for ParaView takes some tens of them.
const MOST_OF_HEAD: u64 = 64 << 20;

/// The head of a checkpoint: the run and the step that it belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    format: Foreign,
    /// The identity of the program and the scene.
    pub key: String,
    /// The command of the run.
    pub command: Foreign,
    /// The last step before the checkpoint.
    pub step: usize,
    /// The states for ParaView that were written before: times and files.
    pub states: Vec<(f64, String)>,
    /// The length and checksum of the history written before.
    pub history: Option<Mark>,
}

impl Head {
    /// The head of a scene and a command, before the first step.
    pub fn new(key: String, command: String) -> Self {
        let (format, command) = (FORMAT.into(), command.into());
        Head { format, key, command, step: 0, states: Vec::new(), history: None }
    }
}

/// Writes a checkpoint; the one that was there stays until this one is whole.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, head: &Head, checkpoint: &dyn Checkpoint) -> anyhow::Result<()> {
    write_with(path, |file| {
        let mut out = Summed { to: BufWriter::new(&*file), sum: Hasher::new() };
        serde_json::to_writer(&mut out, head)?;
        out.write_all(b"\n")?;
        checkpoint.write(&mut out)?;
        let Summed { mut to, sum } = out;
        to.write_all(&sum.finalize().to_le_bytes())?;
        to.flush()?;
        // Its name must not be older than its content.
        Ok(file.sync_all()?)
    })
    .with_context(|| format!("cannot write `{}`", foreign::path(path)))
}

/// A whole checkpoint in a file.
#[derive(Debug)]
pub struct StoredCheckpoint {
    /// The head of the checkpoint.
    pub head: Head,
    state: BufReader<std::io::Take<File>>,
}

impl StoredCheckpoint {
    /// Opens a file, and reads all of it once, unless it has more than `most` bytes.
    ///
    /// # Errors
    /// A file that cannot be read, or is no whole checkpoint.
    pub fn open(path: &Path, most: u64) -> anyhow::Result<Self> {
        let shown = foreign::path(path);
        let cannot = || read::cannot_read(path);
        let damaged = |what: &str| {
            format!(
                "`{shown}` is no whole checkpoint: {what}; it is unchanged, and the run can be started again without `--resume`"
            )
        };
        let mut file = read::open(path).with_context(cannot)?;
        let length = file.metadata().with_context(cannot)?.len();
        let Some(content) = length.checked_sub(SUM) else { bail!(damaged("it is too short")) };
        if length > most {
            bail!(
                "{}: it has {length} bytes, and the {most} of memory that are free cannot hold its state",
                cannot()
            );
        }
        let mut line = Vec::new();
        let head = (&file).take(MOST_OF_HEAD.min(content));
        BufReader::new(head).read_until(b'\n', &mut line).with_context(cannot)?;
        if line.len() as u64 == MOST_OF_HEAD {
            bail!(damaged("its first line has no end"));
        }
        file.seek(SeekFrom::Start(0)).with_context(cannot)?;
        let mut sum = Summed { to: std::io::sink(), sum: Hasher::new() };
        std::io::copy(&mut (&file).take(content), &mut sum).with_context(cannot)?;
        let mut expected = [0; SUM as usize];
        file.read_exact(&mut expected).with_context(cannot)?;
        if sum.sum.finalize() != u32::from_le_bytes(expected) {
            bail!(damaged("its checksum does not fit its content"));
        }
        let head = head_of(&line).map_err(|what| anyhow::anyhow!(damaged(&what)))?;
        file.seek(SeekFrom::Start(line.len() as u64)).with_context(cannot)?;
        let state = BufReader::new(file.take(content - line.len() as u64));
        Ok(StoredCheckpoint { head, state })
    }

    /// The state.
    pub fn state(self) -> impl Read {
        self.state
    }
}

/// Reads the first line. An error describes the mistake.
fn head_of(line: &[u8]) -> Result<Head, String> {
    #[derive(Deserialize)]
    struct Format {
        format: Foreign,
    }
    let wrong = |error: serde_json::Error| foreign::shown(&format!("its first line: {error}"));
    let Format { format } = serde_json::from_slice(line).map_err(wrong)?;
    if format != FORMAT {
        let format = format.shown();
        return Err(format!("its format is `{format}`, and this version reads `{FORMAT}`"));
    }
    serde_json::from_slice(line).map_err(wrong)
}

/// Writes the checkpoints of a run to one file.
pub struct CheckpointWriter {
    path: PathBuf,
    every: usize,
    head: Head,
}

impl CheckpointWriter {
    /// A writer that writes after every `every` steps, to a file in an existing folder.
    ///
    /// # Errors
    /// A folder that cannot be written to.
    pub fn new(path: &Path, every: usize, head: Head) -> anyhow::Result<Self> {
        // Fails before any work is done.
        let option = format!("`--checkpoint {}`", foreign::path(path));
        if path.is_dir() {
            bail!("{option}: expected a file, and it is a folder");
        }
        if is_stream(path) {
            bail!("{option}: expected a plain file to continue from");
        }
        remove_unfinished(path);
        try_to_write(path).with_context(|| format!("{option}: cannot write there"))?;
        Ok(Self { path: path.to_owned(), every, head })
    }

    /// The command that resumes from the last checkpoint.
    pub fn resuming(&self) -> String {
        // The words of the command are quoted already.
        let command = self.head.command.raw();
        format!("{command} --resume {}", quoted(&self.path.to_string_lossy()))
    }

    /// Whether a checkpoint follows this step.
    pub fn wants(&self, step: usize) -> bool {
        step.is_multiple_of(self.every)
    }

    /// Writes a checkpoint.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn keep(
        &mut self,
        checkpoint: &dyn Checkpoint,
        states: &[(f64, String)],
        history: Option<Mark>,
    ) -> anyhow::Result<()> {
        self.head.step = checkpoint.step();
        (self.head.states, self.head.history) = (states.to_vec(), history);
        write(&self.path, &self.head, checkpoint)
    }
}

/// A writer that computes the checksum of the bytes that it passes on.
struct Summed<W> {
    to: W,
    sum: Hasher,
}

impl<W: Write> Write for Summed<W> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.to.flush()
    }
}
