//! Runs in the words of `mms run`, one after the other: each is read from the store if it is there, and stored if it is not.
//! Searches consist of these runs, and their results can be run again as they are.

use std::collections::BTreeMap;

use anyhow::Context as _;
use mms_exact::Input;
use mms_exact::wave::{fastest_wave, without_bound};
use mms_files::shell;
use mms_files::store::{Entry, Store};
use mms_options::Study;
use mms_options::field::find;
use mms_options::method::Precision;
use mms_runtime::scene::{Scene, Solvable};
use mms_runtime::study::{Observer, Watch};
use mms_runtime::{Division, Method};
use peak_alloc::PeakAlloc;
use serde::{Deserialize, Serialize};

use crate::outcome::Key;
use crate::outcome::Quantity;
use crate::outcome::{SolverOutcome, outcome};

/// The result of a run, and its memory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trial {
    /// Errors of the displacement, or the reason why there are none.
    pub outcome: SolverOutcome,
    /// The largest memory in use at a time, in bytes.
    pub memory: usize,
}

/// Follows runs, one after the other.
pub trait Progress {
    /// Follows a run on a grid.
    fn of(&self, cells: Division) -> Box<dyn Observer + '_>;

    /// Says a line between runs.
    fn say(&self, line: &str);

    /// Clears the displayed progress of the current run.
    fn finish(&self);
}

/// A maker of runs.
pub struct Trials {
    store: Store,
    program: String,
    progress: Box<dyn Progress>,
    /// Fields with everything derived, by name and variant.
    inputs: BTreeMap<String, Input>,
    /// Bounds of the speed of waves, by the variant and parameters.
    waves: BTreeMap<String, Option<f64>>,
}

impl Trials {
    /// Makes runs with a store, for results of this program; `progress` follows them.
    ///
    /// # Errors
    /// This program cannot be found.
    pub fn new(store: Store, progress: Box<dyn Progress>) -> anyhow::Result<Self> {
        Ok(Self {
            store,
            program: mms_files::program::identity()?,
            progress,
            inputs: BTreeMap::new(),
            waves: BTreeMap::new(),
        })
    }

    /// Makes the run of `mms run` with these arguments, on one thread.
    ///
    /// # Errors
    /// Arguments without a meaning, a field that does not compile, a store that cannot be read or written.
    pub fn run(&mut self, arguments: &[String]) -> anyhow::Result<Trial> {
        let study = Study::of_words(arguments)?;
        let [cells] = *study.cells.as_slice() else { anyhow::bail!("a run has one grid") };
        let variant = study.variant();
        let name = format!("{} {variant:?}", study.field);
        if !self.inputs.contains_key(&name) {
            self.inputs.insert(name.clone(), find(&study.field, &variant)?);
        }
        let input = self.inputs.get(&name).context("it was put there")?;
        let mut method = study.method.method(input.compiled.field.dimension)?;
        method.setup.threads = 1;
        let key = Key {
            program: self.program.clone(),
            field: input.compiled.provenance(),
            run: format!("trial {}", shell::command(arguments)),
            quantity: Quantity::Displacement.name(),
            defect: None,
        };
        // Two processes that search the same wait for each other's runs.
        let _claim = self.store.claim(&key, true)?;
        match self.store.load(&key)? {
            Entry::Stored(trial) => return Ok(trial),
            Entry::Missing => {}
            Entry::SetAside(what) => self.progress.say(&format!("warning: {what}")),
        }
        if !study.method.allow_unstable {
            let setup = (method.setup.courant, method.setup.time_step);
            let wave = format!("{name} {:?} {} {setup:?}", study.set, method.formulation);
            if !self.waves.contains_key(&wave) {
                let fastest = fastest_wave(input, &input.settings(&study.set)?, &method);
                if fastest.is_none() {
                    self.progress.say(&without_bound(input));
                }
                self.waves.insert(wave.clone(), fastest);
            }
            method.setup.fastest_wave = self.waves.get(&wave).copied().flatten();
        }
        let mut observer = self.progress.of(cells);
        let trial = match study.method.arithmetic.precision {
            Precision::F32 => measure(
                &input.scene(&study.set, |code| code.single)?,
                &method,
                &cells,
                &mut *observer,
            ),
            Precision::F64 => measure(
                &input.scene(&study.set, |code| code.double)?,
                &method,
                &cells,
                &mut *observer,
            ),
        };
        self.store.save(&key, &trial)?;
        Ok(trial)
    }

    /// Clears the displayed progress of the current run.
    pub fn finish(&self) {
        self.progress.finish();
    }
}

/// Runs that take less are repeated, and the shortest time counts: others may use the processor.
const SHORT: f64 = 0.05;

/// The largest number of repetitions.
const REPEATS: usize = 4;

fn measure<T: Solvable>(
    scene: &Scene<T>,
    method: &Method,
    cells: &Division,
    observer: &mut dyn Observer,
) -> Trial {
    let mut best = once(scene, method, cells, observer);
    let mut spent = 0.0;
    for _ in 0..REPEATS {
        let SolverOutcome::Finished { run, .. } = &mut best.outcome else { break };
        spent += run.seconds;
        if spent > SHORT {
            break;
        }
        let again = once(scene, method, cells, &mut ());
        let seconds = again.outcome.run().map_or(run.seconds, |again| again.seconds);
        run.seconds = run.seconds.min(seconds);
        best.memory = best.memory.min(again.memory);
    }
    best
}

/// An observer whose own memory is not counted for the run: its output depends on the terminal, and on the runs before.
struct Apart<'a> {
    observer: &'a mut dyn Observer,
    /// The peak memory, without the memory in use while the observer ran.
    peak: usize,
}

impl Apart<'_> {
    fn hear(&mut self, hear: impl FnOnce(&mut dyn Observer)) {
        self.peak = self.peak.max(PeakAlloc.peak_usage());
        hear(self.observer);
        PeakAlloc.reset_peak_usage();
    }
}

impl Observer for Apart<'_> {
    fn begin(&mut self, particles: usize, steps: usize) {
        self.hear(|observer| observer.begin(particles, steps));
    }

    fn step(&mut self, step: usize, steps: usize) {
        self.hear(|observer| observer.step(step, steps));
    }
}

fn once<T: Solvable>(
    scene: &Scene<T>,
    method: &Method,
    cells: &Division,
    observer: &mut dyn Observer,
) -> Trial {
    PeakAlloc.reset_peak_usage();
    let before = PeakAlloc.current_usage();
    let mut apart = Apart { observer, peak: 0 };
    let run = scene.run(method, cells, Watch::Displacement, &mut apart);
    let memory = apart.peak.max(PeakAlloc.peak_usage()).saturating_sub(before);
    let outcome = match run {
        Err(refusal) => SolverOutcome::Refused { reason: refusal.to_string() },
        Ok(run) => outcome(&run.level, run.details.as_ref(), &Quantity::Displacement),
    };
    Trial { outcome, memory }
}
