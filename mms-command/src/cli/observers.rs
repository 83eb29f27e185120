//! The observers of a run of `mms run`: its progress, what it writes (`--vtk`, `--history`, `--checkpoint`), and
//! the checkpoint from which it resumes.
//!
//! An observer that fails stops the run, with exit code 3. Files appear under their names when they are whole. The first
//! Ctrl-C, or Ctrl-\, ends the step, keeps a checkpoint and stops with exit code 3; the second one ends the process.

use std::io::Read;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context as _;
use mms_campaign::supervisor::signals;
use mms_runtime::study::{Checkpoint, Frame, Observer, Record};
use signal_hook::flag::{register, register_conditional_shutdown};

use crate::checkpoint::{CheckpointWriter, StoredCheckpoint};
use crate::history::History;
use crate::session::progress::OfRun;
use crate::vtk::Writer;

/// The exit code of a process that a second signal ends: 128 and the number of SIGINT.
const KILLED: i32 = 130;

/// A flag that a signal sets to stop the run.
pub struct Interrupted(Arc<AtomicBool>);

impl Interrupted {
    /// Installs handlers: the first Ctrl-C, Ctrl-\ or other request to terminate sets the flag, and a second one ends the process
    /// at once.
    ///
    /// # Errors
    /// Handlers of signals cannot be installed.
    pub fn listen() -> anyhow::Result<Self> {
        let flag = Arc::new(AtomicBool::new(false));
        for signal in signals() {
            // In this order, so that the first signal ends nothing.
            register_conditional_shutdown(signal, KILLED, flag.clone())
                .and_then(|_| register(signal, flag.clone()))
                .context("cannot wait for Ctrl-C")?;
        }
        Ok(Interrupted(flag))
    }

    /// Whether a signal has set the flag.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// All observers of a run.
pub struct Observers<'a> {
    pub progress: OfRun<'a>,
    pub vtk: Option<Writer>,
    pub history: Option<History>,
    pub checkpoints: Option<CheckpointWriter>,
    pub resumed: Option<StoredCheckpoint>,
    pub interrupted: Interrupted,
}

impl Observers<'_> {
    /// Writes the rest of the history.
    pub fn end(&self) -> anyhow::Result<()> {
        self.history.as_ref().map_or(Ok(()), History::write)
    }

    /// The list of the states that were written for ParaView.
    pub fn list_of_states(&self) -> Option<PathBuf> {
        self.vtk.as_ref().map(Writer::list)
    }

    fn try_to_keep(&mut self, checkpoint: &dyn Checkpoint) -> anyhow::Result<()> {
        let Some(checkpoints) = &mut self.checkpoints else { return Ok(()) };
        // First the history, so that it is never older than the checkpoint.
        self.history.as_ref().map_or(Ok(()), History::keep)?;
        let (states, mark) = (
            self.vtk.as_ref().map_or(&[][..], Writer::written),
            self.history.as_ref().map(History::mark),
        );
        checkpoints.keep(checkpoint, states, mark)
    }
}

impl Observer for Observers<'_> {
    fn begin(&mut self, particles: usize, steps: usize) {
        self.progress.begin(particles, steps);
    }

    fn step(&mut self, step: usize, steps: usize) {
        self.progress.step(step, steps);
    }

    fn wants(&self, step: usize, steps: usize) -> bool {
        self.vtk.as_ref().is_some_and(|vtk| vtk.wants(step, steps))
    }

    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        let Some(vtk) = &mut self.vtk else { return Ok(()) };
        vtk.write(frame).map_err(|error| format!("{error:#}"))
    }

    fn records(&self) -> bool {
        self.history.is_some()
    }

    fn record(&mut self, record: &Record) {
        self.history.iter_mut().for_each(|history| history.push(record));
    }

    fn resume(&mut self) -> Option<Box<dyn Read + '_>> {
        self.resumed.take().map(|found| Box::new(found.state()) as Box<dyn Read>)
    }

    fn keeps(&self, step: usize, _: usize) -> bool {
        self.interrupted.is_set()
            || self.checkpoints.as_ref().is_some_and(|checkpoints| checkpoints.wants(step))
    }

    fn keep(&mut self, checkpoint: &dyn Checkpoint) -> Result<(), String> {
        self.try_to_keep(checkpoint).map_err(|error| format!("{error:#}"))?;
        if !self.interrupted.is_set() {
            return Ok(());
        }
        Err(match &self.checkpoints {
            Some(checkpoints) => {
                format!("interrupted; `{}` continues from here", checkpoints.resuming())
            }
            None => "interrupted, without a checkpoint (`--checkpoint FILE` keeps one)".into(),
        })
    }
}
