//! Runs, side by side, each from the store if it is there and into it if it is not.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::{Arc, Mutex};

use mms_exact::Input;
use mms_files::store::{Entry, Store, side_by_side};
use mms_runtime::scene::{Scene, Solvable};
use mms_runtime::study::{Details, Watch};
use mms_runtime::{Errors, Level};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::matrix::{Quantity, Row};
use super::plan::Job;
use crate::session::input::Variant;
use crate::session::method::Precision;

/// l1, l2 and linf, the largest over all steps.
pub type Norms = [f64; 3];

/// What comes of a run, and is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Outcome {
    /// It reached its end.
    Finished {
        /// What it was.
        run: Size,
        /// Of the quantity that is measured.
        errors: Norms,
        /// At the end, the momentum over the mass.
        mean_velocity: Vec<f64>,
    },
    /// It stopped.
    Stopped {
        /// What it was.
        run: Size,
        /// Why.
        failure: String,
    },
    /// It was not started.
    Refused {
        /// Why.
        reason: String,
    },
}

/// How large a run is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Grid spacing h, the longest edge of a cell.
    pub cell_size: f64,
    /// Time step dt.
    pub time_step: f64,
    /// Steps.
    pub steps: usize,
    /// Particles.
    pub particles: usize,
    /// Wall-clock seconds.
    pub seconds: f64,
}

impl Outcome {
    /// What it was, if it was started.
    pub fn run(&self) -> Option<&Size> {
        match self {
            Outcome::Finished { run, .. } | Outcome::Stopped { run, .. } => Some(run),
            Outcome::Refused { .. } => None,
        }
    }

    /// l1, l2 and linf of the quantity that was measured, if it reached its end.
    pub fn norms(&self) -> Option<Norms> {
        match self {
            Outcome::Finished { errors, .. } => Some(*errors),
            _ => None,
        }
    }

    /// What a row refines: h or dt.
    pub fn size(&self, row: &Row) -> Option<f64> {
        let time_alone = row.halvings > 0;
        self.run().map(|run| if time_alone { run.time_step } else { run.cell_size })
    }

    /// The errors that a row looks at, if there are any.
    pub fn errors(&self, row: &Row) -> Option<Norms> {
        let Outcome::Finished { errors, mean_velocity, .. } = self else { return None };
        let Quantity::MeanVelocity(exact) = &row.quantity else { return Some(*errors) };
        if mean_velocity.len() != exact.len() {
            return None;
        }
        let squares = mean_velocity.iter().zip(exact).map(|(v, exact)| (v - exact).powi(2));
        Some([squares.sum::<f64>().sqrt(); 3])
    }

    /// Why there are no errors.
    pub fn failure(&self) -> Option<String> {
        match self {
            Outcome::Finished { .. } => None,
            Outcome::Stopped { failure, .. } => Some(failure.clone()),
            Outcome::Refused { reason } => Some(format!("not started: {reason}")),
        }
    }
}

impl AsRef<Outcome> for Outcome {
    fn as_ref(&self) -> &Outcome {
        self
    }
}

/// Hears of every step of a run, and of how many there are.
pub type Step<'a> = dyn FnMut(usize, usize) + Send + 'a;

/// What makes runs.
pub trait Bench: Sync {
    /// What comes of one, and is stored.
    type Result: AsRef<Outcome> + Clone + Serialize + DeserializeOwned + Send;

    /// Makes a run, and calls `step` after each of its steps.
    ///
    /// # Errors
    /// A field of the gallery does not compile.
    fn run(&self, job: &Job, step: &mut Step<'_>) -> anyhow::Result<Self::Result>;
}

/// What is said while runs go on. All of it may come from several threads.
pub trait Watcher: Sync {
    /// A run was taken from the store.
    fn found(&self, job: &Job);
    /// A run has made some of its steps.
    fn step(&self, job: &Job, step: usize, steps: usize);
    /// A run has ended.
    fn done(&self, job: &Job, outcome: &Outcome);
    /// A file of the store was set aside.
    fn set_aside(&self, what: &str);
}

/// What comes of runs, in their order.
///
/// # Errors
/// The store cannot be read or written, a field of the gallery does not compile.
pub fn outcomes<B: Bench>(
    jobs: &[Job],
    store: &Store,
    threads: NonZero<usize>,
    bench: &B,
    watcher: &dyn Watcher,
) -> anyhow::Result<Vec<B::Result>> {
    let work = Work { store, bench, watcher };
    side_by_side(jobs, threads, |job, wait| work.outcome(job, wait))
}

struct Work<'a, B> {
    store: &'a Store,
    bench: &'a B,
    watcher: &'a dyn Watcher,
}

impl<B: Bench> Work<'_, B> {
    /// The outcome of a run; nothing, if another process has claimed it and there is to be no waiting.
    fn outcome(&self, job: &Job, wait: bool) -> anyhow::Result<Option<B::Result>> {
        if let Some(outcome) = self.stored(job)? {
            return Ok(Some(outcome));
        }
        let Some(_claim) = self.store.claim(&job.key, wait)? else { return Ok(None) };
        // Whoever held the claim before may have finished.
        if let Some(outcome) = self.stored(job)? {
            return Ok(Some(outcome));
        }
        let mut step = |step: usize, steps: usize| self.watcher.step(job, step, steps);
        let outcome = self.bench.run(job, &mut step)?;
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

/// How a field is found.
type Find = fn(&str, &Variant) -> anyhow::Result<Input>;

/// Fields with everything derived.
pub struct Fields {
    find: Find,
    /// By name and variant.
    inputs: Mutex<BTreeMap<String, Arc<Input>>>,
}

/// Measures what the row of a run looks at.
impl Bench for Fields {
    type Result = Outcome;

    fn run(&self, job: &Job, step: &mut Step<'_>) -> anyhow::Result<Outcome> {
        self.with_scene(job, step, solve::<f32>, solve::<f64>)
    }
}

/// What has to be watched for the errors of a quantity.
pub fn watch_of(quantity: &Quantity) -> Watch {
    match quantity {
        Quantity::Displacement => Watch::Displacement,
        _ => Watch::Everything,
    }
}

fn solve<T: Solvable>(job: &Job, scene: &Scene<T>, mut step: &mut Step<'_>) -> Outcome {
    match scene.run(&job.method, &job.study.cells[0], watch_of(&job.quantity), &mut step) {
        Err(refusal) => Outcome::Refused { reason: refusal.to_string() },
        Ok(run) => outcome(&run.level, run.details.as_ref(), &job.quantity),
    }
}

impl Fields {
    /// What `single` or `double` makes of the scene of a run, whichever its precision is.
    ///
    /// # Errors
    /// The field does not compile.
    pub fn with_scene<R>(
        &self,
        job: &Job,
        step: &mut Step<'_>,
        single: fn(&Job, &Scene<f32>, &mut Step<'_>) -> R,
        double: fn(&Job, &Scene<f64>, &mut Step<'_>) -> R,
    ) -> anyhow::Result<R> {
        let input = self.input(job)?;
        let set = &job.study.set;
        Ok(match job.study.method.arithmetic.precision {
            Precision::F32 => single(job, &input.scene(set, |code| code.single)?, step),
            Precision::F64 => double(job, &input.scene(set, |code| code.double)?, step),
        })
    }

    /// None yet.
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
        // Whoever else needs a field has to wait for it anyway.
        let mut inputs = self.inputs.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(input) = inputs.get(&name) {
            return Ok(input.clone());
        }
        let input = Arc::new((self.find)(job.entry.name, &variant)?);
        inputs.insert(name, input.clone());
        Ok(input)
    }
}

/// What came of a run that was started, with the errors of a quantity.
pub fn outcome(level: &Level, details: Option<&Details>, quantity: &Quantity) -> Outcome {
    let run = Size {
        cell_size: level.cell_size,
        time_step: level.time_step,
        steps: level.steps,
        particles: level.particles,
        seconds: level.seconds,
    };
    let Some(Details { largest, diagnostics: state, .. }) = details else {
        let failure = level.errors.as_ref().err().map(ToString::to_string);
        return Outcome::Stopped { run, failure: failure.unwrap_or_default() };
    };
    let Errors { l1, l2, linf } = match quantity {
        Quantity::Displacement | Quantity::MeanVelocity(_) => largest.displacement,
        Quantity::Velocity => largest.velocity,
        Quantity::DeformationGradient => largest.deformation_gradient,
        Quantity::FirstPiolaKirchhoff => largest.first_piola_kirchhoff,
    };
    let mean_velocity = state.momentum.iter().map(|p| p / state.mass).collect();
    Outcome::Finished { run, errors: [l1, l2, linf], mean_velocity }
}
