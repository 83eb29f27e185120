//! The record of a run: its measurements, step by step, and its checkpoints.

use std::borrow::Cow;
use std::io::{self, Read, Write};
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::balance::{Account, Tally};
use super::deviations::{Deviations, Watcher};
use super::{Checkpoint, Details, Diagnostics, Frame, Observer, Record, Snapshots, Watch};
use crate::failure::{Failure, Refusal};
use crate::field::ManufacturedField;
use crate::real::Real;
use crate::solver::{Residual, State, StateView};

/// The contents of a checkpoint: the solver's state and the measurements so far.
#[derive(Serialize, Deserialize)]
#[serde(bound = "T: Real")]
pub(super) struct Saved<'a, T: Real, const D: usize> {
    pub state: State<'a, T, D>,
    pub run_record: SavedRecord<'a>,
}

/// The measurements so far that do not follow from the state.
#[derive(Serialize, Deserialize)]
pub(super) struct SavedRecord<'a> {
    step: usize,
    largest: Deviations,
    size: f64,
    tally: Option<Cow<'a, Tally>>,
    snapshots: Cow<'a, Snapshots>,
    /// Wall-clock seconds.
    pub elapsed: f64,
}

/// Wall-clock time of a run, including the time before its checkpoint.
#[derive(Clone, Copy)]
pub(super) struct Stopwatch {
    start: Instant,
    /// Seconds.
    pub before: f64,
}

impl Default for Stopwatch {
    fn default() -> Self {
        Self { start: Instant::now(), before: 0.0 }
    }
}

impl Stopwatch {
    /// Seconds so far.
    pub fn seconds(&self) -> f64 {
        self.before + self.start.elapsed().as_secs_f64()
    }
}

/// The number of bytes of a checkpoint that are read at once.
const BUFFER: usize = 1 << 16;

impl<T: Real, const D: usize> Saved<'_, T, D> {
    /// Reads a checkpoint that [`Checkpoint::write`] has written.
    ///
    /// # Errors
    /// The bytes are no checkpoint.
    pub fn read(from: Box<dyn Read + '_>) -> Result<Self, Refusal> {
        let mut buffer = vec![0; BUFFER];
        let read = postcard::from_io((from, &mut buffer));
        let (saved, _) =
            read.map_err(|error| Refusal::NoState { reason: format!("no checkpoint: {error}") })?;
        Ok(saved)
    }
}

impl<T: Real, const D: usize> Checkpoint for Saved<'_, T, D> {
    fn step(&self) -> usize {
        self.run_record.step
    }

    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        // `postcard` drops the error of a writer, so the writer is wrapped.
        let mut to = Remember { to, error: None };
        match postcard::to_io(self, &mut to) {
            Ok(_) => Ok(()),
            Err(error) => Err(to.error.unwrap_or_else(|| io::Error::other(error))),
        }
    }
}

/// Keeps the error of a writer, for formats with their own error type.
struct Remember<'a> {
    to: &'a mut dyn Write,
    error: Option<io::Error>,
}

impl Write for Remember<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.to.write(bytes).map_err(|error| {
            let kind = error.kind();
            self.error = Some(error);
            kind.into()
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Measures a run, and reports to its observer.
pub(super) struct RunRecord<'a, T, const D: usize> {
    watch: Watch,
    watcher: Watcher<T, D>,
    account: Option<Account<T, D>>,
    largest: Deviations,
    last: Deviations,
    snapshots: Snapshots,
    steps: usize,
    records: bool,
    stopwatch: Stopwatch,
    observer: &'a mut dyn Observer,
}

impl<'a, T: Real, const D: usize> RunRecord<'a, T, D> {
    /// Begins at the first state of a run, or resumes from a checkpoint with the `saved` measurements.
    ///
    /// # Errors
    /// An error is not finite; the observer cannot continue.
    pub fn begin<F>(
        watch: Watch,
        present: &StateView<'_, T, D, F>,
        steps: usize,
        saved: Option<SavedRecord<'_>>,
        stopwatch: Stopwatch,
        observer: &'a mut dyn Observer,
    ) -> Result<Self, Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let count = present.particles.len();
        observer.begin(count, steps);
        let mut watcher = Watcher::new(watch, count);
        let last = watcher.measure(present)?;
        let watches_all = watch != Watch::Displacement;
        let records = observer.records();
        let mut run_record = Self {
            watch,
            watcher,
            account: None,
            largest: last,
            last,
            snapshots: Snapshots::default(),
            steps,
            records,
            stopwatch,
            observer,
        };
        let mut tally = None;
        match saved {
            None => run_record.show(present)?,
            Some(saved) => {
                run_record.largest = saved.largest;
                run_record.watcher.resume(saved.size);
                run_record.snapshots = saved.snapshots.into_owned();
                tally = saved.tally.map(Cow::into_owned);
            }
        }
        run_record.account = watches_all.then(|| Account::new(present, tally));
        Ok(run_record)
    }

    /// Measures the state before each step, if velocities lag behind positions (`behind`).
    pub fn before_step<F>(&mut self, present: &StateView<'_, T, D, F>, behind: bool)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        // If velocities lag, the last time with a velocity before and after it is the one before the last step.
        if behind && self.looks_at(present.step + 1) {
            self.account.iter_mut().for_each(|account| account.look(present));
        }
    }

    /// Measures the state after each step.
    ///
    /// # Errors
    /// An error is not finite; the observer cannot continue.
    pub fn after_step<F>(
        &mut self,
        present: &StateView<'_, T, D, F>,
        behind: bool,
    ) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let (step, steps) = (present.step, self.steps);
        let looks = self.looks_at(step);
        if let Some(account) = &mut self.account {
            account.step(present);
            if looks && !behind {
                account.look(present);
            }
        }
        self.last = self.watcher.measure(present)?;
        self.largest = self.largest.larger(&self.last);
        if let Watch::Parts(parts) = self.watch
            && step * parts % steps == 0
        {
            self.snapshots.take(present.particles);
        }
        self.observer.step(step, steps);
        if self.records {
            let diagnostics = self.diagnostics(present);
            let displacement = self.last.displacement;
            self.observer.record(&Record { step, time: present.time, displacement, diagnostics });
        }
        self.show(present)
    }

    /// Reports a step of a run without measurements along the way.
    pub fn pass<F: ?Sized>(&mut self, present: &StateView<'_, T, D, F>) {
        self.observer.step(present.step, self.steps);
    }

    /// Measures a run of which only the end is measured: its errors, with this residual.
    ///
    /// # Errors
    /// An error is not finite; the observer cannot continue.
    pub fn finish<F>(
        mut self,
        present: &StateView<'_, T, D, F>,
        residual: Residual,
    ) -> Result<(Details, Snapshots), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.steps = present.step;
        self.account = None;
        self.last = self.watcher.measure(present)?;
        self.largest = self.last;
        self.observer.step(self.steps, self.steps);
        self.show(present)?;
        // The relative displacement due to forces out of balance is about the residual.
        let left = residual.relative * self.watcher.size();
        let (details, snapshots) = self.close(present);
        let round_off = details.round_off.hypot(left);
        Ok((Details { residual: Some(residual), round_off, ..details }, snapshots))
    }

    /// Lets the observer write a checkpoint, if it wants one after this step.
    ///
    /// # Errors
    /// The observer cannot continue.
    pub fn keep<'s, F>(
        &mut self,
        present: &StateView<'_, T, D, F>,
        state: &dyn Fn() -> State<'s, T, D>,
    ) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        if !self.observer.keeps(present.step, self.steps) {
            return Ok(());
        }
        let run_record = SavedRecord {
            step: present.step,
            largest: self.largest,
            size: self.watcher.size(),
            tally: self.account.as_ref().map(|account| Cow::Borrowed(account.tally())),
            snapshots: Cow::Borrowed(&self.snapshots),
            elapsed: self.stopwatch.seconds(),
        };
        let saved = Saved { state: state(), run_record };
        self.observer.keep(&saved).map_err(|reason| present.stopped(reason))
    }

    /// The measurements of the run.
    pub fn close<F>(self, present: &StateView<'_, T, D, F>) -> (Details, Snapshots)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let round_off = self.watcher.round_off(self.steps);
        let diagnostics = self.diagnostics(present);
        let Self { largest, last, snapshots, .. } = self;
        (Details { largest, last, round_off, residual: None, diagnostics }, snapshots)
    }

    fn looks_at(&self, step: usize) -> bool {
        self.records || step == self.steps
    }

    fn diagnostics<F: ?Sized>(&self, present: &StateView<'_, T, D, F>) -> Diagnostics {
        Diagnostics::of(present.particles, self.account.as_ref().map(Account::balance))
    }

    /// Passes the state to the observer, if the observer wants a frame of this step.
    fn show<F>(&mut self, present: &StateView<'_, T, D, F>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        if !self.observer.wants(present.step, self.steps) {
            return Ok(());
        }
        self.observer.see(&Frame::of(present)).map_err(|reason| present.stopped(reason))
    }
}
