//! Checkpoints of a run, each in one file that is replaced when the next one is whole.
//!
//! A file is a line of JSON, which says what it is of; the state as `mms_runtime` writes it; and a checksum of
//! both. It is trusted only if the checksum fits and it is of the same scene, computed by the same program.

use std::fs::File;
use std::io::{BufRead as _, BufReader, BufWriter, Read, Seek as _, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use crc32fast::Hasher;
use mms_runtime::study::Checkpoint;
use serde::{Deserialize, Serialize};

use crate::report::file::{folder, is_stream};
use crate::report::write_with;
use crate::shell::quoted;

/// What the first key of every file says.
const FORMAT: &str = "mms checkpoint 1";

/// Bytes of the checksum.
const SUM: u64 = 4;

/// What a checkpoint is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    format: String,
    /// What tells the program and the scene from all others.
    pub key: String,
    /// The command of the run.
    pub command: String,
    /// After this step.
    pub step: usize,
    /// The states for ParaView that were written before: times and files.
    pub states: Vec<(f64, String)>,
}

impl Head {
    /// Of a scene and a command.
    pub fn new(key: String, command: String) -> Self {
        Head { format: FORMAT.to_owned(), key, command, step: 0, states: Vec::new() }
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
    .with_context(|| format!("cannot write `{}`", path.display()))
}

/// A checkpoint that is whole.
#[derive(Debug)]
pub struct Found {
    /// What it is of.
    pub head: Head,
    state: BufReader<std::io::Take<File>>,
}

impl Found {
    /// Opens a file, and reads all of it once.
    ///
    /// # Errors
    /// A file that cannot be read, or is no whole checkpoint.
    pub fn open(path: &Path) -> anyhow::Result<Self> {
        let shown = path.display();
        let mut file = File::open(path).with_context(|| format!("cannot read `{shown}`"))?;
        let length = file.metadata().with_context(|| format!("cannot read `{shown}`"))?.len();
        let damaged = |what: &str| {
            format!(
                "`{shown}` is no whole checkpoint: {what}; it is left as it is, and the run can be \
                 started anew without `--resume`"
            )
        };
        let Some(content) = length.checked_sub(SUM) else { bail!(damaged("it is too short")) };
        let mut sum = Summed { to: std::io::sink(), sum: Hasher::new() };
        std::io::copy(&mut (&file).take(content), &mut sum)
            .with_context(|| format!("cannot read `{shown}`"))?;
        let mut expected = [0; SUM as usize];
        file.read_exact(&mut expected).with_context(|| format!("cannot read `{shown}`"))?;
        if sum.sum.finalize() != u32::from_le_bytes(expected) {
            bail!(damaged("its checksum does not fit its content"));
        }
        file.seek(SeekFrom::Start(0)).with_context(|| format!("cannot read `{shown}`"))?;
        let mut state = BufReader::new(file.take(content));
        let mut line = String::new();
        state.read_line(&mut line).with_context(|| damaged("it does not begin with a text"))?;
        let head: Head = serde_json::from_str(&line).with_context(|| damaged("its first line"))?;
        if head.format != FORMAT {
            bail!(damaged(&format!("its format is `{}`, not `{FORMAT}`", head.format)));
        }
        Ok(Found { head, state })
    }

    /// The state.
    pub fn state(self) -> impl Read {
        self.state
    }
}

/// Where checkpoints go, and how often.
pub struct Keeper {
    path: PathBuf,
    every: usize,
    head: Head,
}

impl Keeper {
    /// After every so many steps, to a file in a folder that is there.
    ///
    /// # Errors
    /// A folder that cannot be written to.
    pub fn new(path: &Path, every: usize, head: Head) -> anyhow::Result<Self> {
        // Said before any work is done.
        if path.is_dir() {
            bail!("`--checkpoint {}`: expected a file, and it is a folder", path.display());
        }
        if is_stream(path) {
            bail!("`--checkpoint {}`: expected a plain file, to go on from", path.display());
        }
        tempfile::tempfile_in(folder(path))
            .with_context(|| format!("`--checkpoint {}`: cannot write there", path.display()))?;
        Ok(Self { path: path.to_owned(), every, head })
    }

    /// The command that goes on from the last one.
    pub fn resuming(&self) -> String {
        format!("{} --resume {}", self.head.command, quoted(&self.path.to_string_lossy()))
    }

    /// Whether there is one after this step.
    pub fn wants(&self, step: usize) -> bool {
        step.is_multiple_of(self.every)
    }

    /// Writes one.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn keep(
        &mut self,
        checkpoint: &dyn Checkpoint,
        states: &[(f64, String)],
    ) -> anyhow::Result<()> {
        self.head.step = checkpoint.step();
        self.head.states = states.to_vec();
        write(&self.path, &self.head, checkpoint)
    }
}

/// Sums what it passes on.
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
