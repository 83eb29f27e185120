//! Runs a row once more and looks at the result as people do: the observers of pseudo verification.

use mms_lab::outcome::{SolverOutcome, outcome};
use mms_lab::plausibility::Observed;
use mms_runtime::scene::{Scene, Solvable};
use mms_runtime::study::{Frame, Observer, Watch};
use serde::{Deserialize, Serialize};

use crate::plan::Job;
use crate::work::{Fields, JobRunner, OnStep, watch_of};

/// The end of the key of a run whose energy is measured. If fields are interpreted, this takes as long as all other work, so
/// only the coarsest run of each row is measured.
pub const WEIGHED: &str = ", with its energy";

/// The number of states of a run that are inspected, including the last one.
const LOOKS: usize = 4;

/// A run, and the data that people see of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Watched {
    /// The outcome that the row judges.
    pub outcome: SolverOutcome,
    /// The data that people look at; `None` if the run did not end.
    pub seen: Option<Observed>,
}

impl AsRef<SolverOutcome> for Watched {
    fn as_ref(&self) -> &SolverOutcome {
        &self.outcome
    }
}

/// Makes runs, and inspects some of their states.
pub struct VisualInspection {
    /// The fields.
    pub fields: Fields,
}

impl JobRunner for VisualInspection {
    type Result = Watched;

    fn run(&self, job: &Job, step: &mut OnStep<'_>) -> anyhow::Result<Watched> {
        self.fields.with_scene(job, step, look::<f32>, look::<f64>)
    }
}

fn look<T: Solvable>(job: &Job, scene: &Scene<T>, step: &mut OnStep<'_>) -> Watched {
    let mut snapshots = Snapshots { step, frames: Vec::new() };
    let weighed = job.key.run.ends_with(WEIGHED);
    let watch = if weighed { Watch::Everything } else { watch_of(&job.quantity) };
    let run = match scene.run(&job.method, &job.study.cells[0], watch, &mut snapshots) {
        Ok(run) => run,
        Err(refusal) => {
            let outcome = SolverOutcome::Refused { reason: refusal.to_string() };
            return Watched { outcome, seen: None };
        }
    };
    let outcome = outcome(&run.level, run.details.as_ref(), &job.quantity);
    let balance = run.details.and_then(|details| details.diagnostics.balance);
    let energy = balance.and_then(|balance| {
        let energy = balance.kinetic_energy + balance.strain_energy?;
        let put_in = balance.body_work.abs().max(energy);
        Some(balance.energy_residual?.abs() / put_in)
    });
    let seen = outcome.norms().map(|_| Observed::of(&snapshots.frames, energy));
    Watched { outcome, seen }
}

/// Some states of a run.
struct Snapshots<'a> {
    step: &'a mut (dyn FnMut(usize, usize) + Send),
    frames: Vec<Frame>,
}

impl Observer for Snapshots<'_> {
    fn step(&mut self, step: usize, steps: usize) {
        (self.step)(step, steps);
    }

    fn wants(&self, step: usize, steps: usize) -> bool {
        step == steps || step > 0 && step.is_multiple_of(steps.div_ceil(LOOKS))
    }

    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        self.frames.push(frame.clone());
        Ok(())
    }
}
