//! The outcome of a run, and the inputs that it depends on.

use mms_runtime::study::Details;
use mms_runtime::{Errors, StudyLevel};
use serde::{Deserialize, Serialize};

/// Everything that a result depends on.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Key {
    /// The identity of the program: version, length and time of its build.
    pub program: String,
    /// The digest of the field's text, and of its own material's.
    pub field: String,
    /// Method, cells, precision, form, parameters and motion.
    pub run: String,
    /// The quantity whose errors are measured.
    pub quantity: &'static str,
    /// The deliberate mistake that was switched on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub defect: Option<&'static str>,
}

/// The quantity whose error is measured.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// u.
    #[default]
    Displacement,
    /// v.
    Velocity,
    /// F.
    DeformationGradient,
    /// P.
    FirstPiolaKirchhoff,
    /// Momentum divided by mass at the end, with its exact value.
    MeanVelocity(Vec<f64>),
}

impl Quantity {
    /// The glossary's identifier.
    pub fn name(&self) -> &'static str {
        match self {
            Quantity::Displacement => "displacement",
            Quantity::Velocity => "velocity",
            Quantity::DeformationGradient => "deformation_gradient",
            Quantity::FirstPiolaKirchhoff => "first_piola_kirchhoff",
            Quantity::MeanVelocity(_) => "mean_velocity",
        }
    }
}

/// l1, l2 and linf, the largest over all steps.
pub type Norms = [f64; 3];

/// The outcome of a run, as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SolverOutcome {
    /// The run reached its end.
    Finished {
        /// The size of the run.
        run: Size,
        /// The errors of the measured quantity.
        errors: Norms,
        /// The momentum divided by the mass, at the end.
        mean_velocity: Vec<f64>,
    },
    /// The run stopped.
    Stopped {
        /// The size of the run.
        run: Size,
        /// The reason.
        failure: String,
    },
    /// The run was not started.
    Refused {
        /// The reason.
        reason: String,
    },
}

/// The size of a run.
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

impl SolverOutcome {
    /// The size of a run that was started.
    pub fn run(&self) -> Option<&Size> {
        match self {
            SolverOutcome::Finished { run, .. } | SolverOutcome::Stopped { run, .. } => Some(run),
            SolverOutcome::Refused { .. } => None,
        }
    }

    /// l1, l2 and linf of the quantity that was measured, if it reached its end.
    pub fn norms(&self) -> Option<Norms> {
        match self {
            SolverOutcome::Finished { errors, .. } => Some(*errors),
            _ => None,
        }
    }

    /// The reason why there are no errors.
    pub fn failure(&self) -> Option<String> {
        match self {
            SolverOutcome::Finished { .. } => None,
            SolverOutcome::Stopped { failure, .. } => Some(failure.clone()),
            SolverOutcome::Refused { reason } => Some(format!("not started: {reason}")),
        }
    }
}

impl AsRef<SolverOutcome> for SolverOutcome {
    fn as_ref(&self) -> &SolverOutcome {
        self
    }
}

/// The outcome of a run that was started, with the errors of a quantity.
pub fn outcome(
    level: &StudyLevel,
    details: Option<&Details>,
    quantity: &Quantity,
) -> SolverOutcome {
    let run = Size {
        cell_size: level.cell_size,
        time_step: level.time_step,
        steps: level.steps,
        particles: level.particles,
        seconds: level.seconds,
    };
    let Some(Details { largest, diagnostics: state, .. }) = details else {
        let failure = level.errors.as_ref().err().map(ToString::to_string);
        return SolverOutcome::Stopped { run, failure: failure.unwrap_or_default() };
    };
    let Errors { l1, l2, linf } = match quantity {
        Quantity::Displacement | Quantity::MeanVelocity(_) => largest.displacement,
        Quantity::Velocity => largest.velocity,
        Quantity::DeformationGradient => largest.deformation_gradient,
        Quantity::FirstPiolaKirchhoff => largest.first_piola_kirchhoff,
    };
    let mean_velocity = state.momentum.iter().map(|p| p / state.mass).collect();
    SolverOutcome::Finished { run, errors: [l1, l2, linf], mean_velocity }
}
