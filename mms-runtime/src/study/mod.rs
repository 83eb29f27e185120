//! Convergence studies: one method on levels of refinement, its errors, orders and verdict.

mod balance;
mod course;
mod deviations;
mod errors;
mod observer;
mod order;
mod phase;
mod range;
mod refinement;
mod run;
mod series;
mod snapshots;

pub use balance::Balance;
pub use deviations::Deviations;
pub use errors::Errors;
pub use observer::{Checkpoint, Frame, Observer, Record};
pub use order::{Orders, orders};
pub use phase::{Phase, Phases};
pub use refinement::{Refinement, differences};
pub use run::{Details, Diagnostics, Run, Solve, Watch};
pub use series::{NORMS, Point, Series, judge};
pub use snapshots::Snapshots;

use crate::{Division, Failure, ManufacturedField, Method, Refusal};

/// One level of a study: a run at one resolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Cells of the body.
    pub cells: Division,
    /// Grid spacing h, the longest edge of a cell.
    pub cell_size: f64,
    /// Time step dt.
    pub time_step: f64,
    /// Steps that the time window takes.
    pub steps: usize,
    /// Particles.
    pub particles: usize,
    /// The errors, or why the run stopped.
    pub errors: Result<Errors, Failure>,
    /// Wall-clock seconds, everything included.
    pub seconds: f64,
}

/// Runs one level: the whole time window, with the body divided into `cells`; see [`Solve::run`].
///
/// # Errors
/// A scene that cannot be started.
pub fn run_level<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: &Division,
    observer: &mut dyn Observer,
) -> Result<Level, Refusal> {
    T::run(field, method, cells, Watch::Displacement, observer).map(|run| run.level)
}
