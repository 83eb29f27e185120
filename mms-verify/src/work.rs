//! Runs, several at the same time: each is read from the store if it is there, and stored if it is not.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::{Arc, Mutex};

use mms_exact::Input;
use mms_files::store::{Entry, Store, side_by_side};
use mms_lab::outcome::{Quantity, SolverOutcome, outcome};
use mms_options::field::Variant;
use mms_options::method::Precision;
use mms_runtime::scene::{Scene, Solvable};
use mms_runtime::study::Watch;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::plan::Job;

/// A function that is called after every step of a run, with the step and the number of steps.
pub type OnStep<'a> = dyn FnMut(usize, usize) + Send + 'a;

/// Runs jobs.
pub trait JobRunner: Sync {
    /// The result of a run, which is stored.
    type Result: AsRef<SolverOutcome> + Clone + Serialize + DeserializeOwned + Send;

    /// Runs a job, and calls `step` after each of its steps.
    ///
    /// # Errors
    /// A field of the gallery does not compile.
    fn run(&self, job: &Job, step: &mut OnStep<'_>) -> anyhow::Result<Self::Result>;
}

/// Receives messages while runs go on. Several threads may call it.
pub trait Watcher: Sync {
    /// A run was taken from the store.
    fn found(&self, job: &Job);
    /// A run has made some of its steps.
    fn step(&self, job: &Job, step: usize, steps: usize);
    /// A run has ended.
    fn done(&self, job: &Job, outcome: &SolverOutcome);
    /// A file of the store was set aside.
    fn set_aside(&self, what: &str);
}

/// The results of runs, in their order.
///
/// # Errors
/// The store cannot be read or written, a field of the gallery does not compile.
pub fn outcomes<B: JobRunner>(
    jobs: &[Job],
    store: &Store,
    threads: NonZero<usize>,
    runner: &B,
    watcher: &dyn Watcher,
) -> anyhow::Result<Vec<B::Result>> {
    let work = Work { store, runner, watcher };
    side_by_side(jobs, threads, |job, wait| work.outcome(job, wait))
}

struct Work<'a, B> {
    store: &'a Store,
    runner: &'a B,
    watcher: &'a dyn Watcher,
}

impl<B: JobRunner> Work<'_, B> {
    /// The outcome of a run; `None`, if another process has claimed it and `wait` is false.
    fn outcome(&self, job: &Job, wait: bool) -> anyhow::Result<Option<B::Result>> {
        if let Some(outcome) = self.stored(job)? {
            return Ok(Some(outcome));
        }
        let Some(_claim) = self.store.claim(&job.key, wait)? else { return Ok(None) };
        // The process that held the claim before may have finished.
        if let Some(outcome) = self.stored(job)? {
            return Ok(Some(outcome));
        }
        let mut step = |step: usize, steps: usize| self.watcher.step(job, step, steps);
        let outcome = self.runner.run(job, &mut step)?;
        self.store.save(&job.key, &outcome)?;
        self.watcher.done(job, outcome.as_ref());
        Ok(Some(outcome))
    }

    fn stored(&self, job: &Job) -> anyhow::Result<Option<B::Result>> {
        Ok(match self.store.load(&job.key)? {
            Entry::Stored(outcome) => {
                self.watcher.found(job);
                Some(outcome)
            }
            Entry::Missing => None,
            Entry::SetAside(what) => {
                self.watcher.set_aside(&what);
                None
            }
        })
    }
}

/// A function that finds a field.
type Find = fn(&str, &Variant) -> anyhow::Result<Input>;

/// Fields with everything derived.
pub struct Fields {
    find: Find,
    /// The fields by name and variant.
    inputs: Mutex<BTreeMap<String, Arc<Input>>>,
}

/// Measures the quantity that the row of a run judges.
impl JobRunner for Fields {
    type Result = SolverOutcome;

    fn run(&self, job: &Job, step: &mut OnStep<'_>) -> anyhow::Result<SolverOutcome> {
        self.with_scene(job, step, solve::<f32>, solve::<f64>)
    }
}

/// The quantities to watch for the errors of a quantity.
pub fn watch_of(quantity: &Quantity) -> Watch {
    match quantity {
        Quantity::Displacement => Watch::Displacement,
        _ => Watch::Everything,
    }
}

fn solve<T: Solvable>(job: &Job, scene: &Scene<T>, mut step: &mut OnStep<'_>) -> SolverOutcome {
    match scene.run(&job.method, &job.study.cells[0], watch_of(&job.quantity), &mut step) {
        Err(refusal) => SolverOutcome::Refused { reason: refusal.to_string() },
        Ok(run) => outcome(&run.level, run.details.as_ref(), &job.quantity),
    }
}

impl Fields {
    /// The result of `single` or `double` for the scene of a run, according to its precision.
    ///
    /// # Errors
    /// The field does not compile.
    pub fn with_scene<R>(
        &self,
        job: &Job,
        step: &mut OnStep<'_>,
        single: fn(&Job, &Scene<f32>, &mut OnStep<'_>) -> R,
        double: fn(&Job, &Scene<f64>, &mut OnStep<'_>) -> R,
    ) -> anyhow::Result<R> {
        let input = self.input(job)?;
        let set = &job.study.set;
        Ok(match job.study.method.arithmetic.precision {
            Precision::F32 => single(job, &input.scene(set, |code| code.single)?, step),
            Precision::F64 => double(job, &input.scene(set, |code| code.double)?, step),
        })
    }

    /// A collection without fields.
    pub fn new(find: Find) -> Self {
        Fields { find, inputs: Mutex::default() }
    }

    /// The field of a run, derived once for all of its runs.
    ///
    /// # Errors
    /// It does not compile.
    pub fn input(&self, job: &Job) -> anyhow::Result<Arc<Input>> {
        let variant = job.study.variant();
        let name = format!("{} {variant:?}", job.entry.name);
        // Other threads that need a field have to wait for it anyway.
        let mut inputs = self.inputs.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(input) = inputs.get(&name) {
            return Ok(input.clone());
        }
        let input = Arc::new((self.find)(job.entry.name, &variant)?);
        inputs.insert(name, input.clone());
        Ok(input)
    }
}
