//! Convergence studies: one method on levels of refinement, its errors, orders and verdict.

mod balance;
mod deviations;
mod errors;
mod level;
mod observer;
mod order;
mod phase;
mod range;
mod refinement;
mod relax;
mod run;
mod run_record;
mod series;
mod snapshots;

pub use balance::Balance;
pub use deviations::Deviations;
pub use errors::Errors;
pub use level::StudyLevel;
pub use observer::{Checkpoint, Frame, Observer, Record};
pub use order::{ObservedOrders, orders};
pub use phase::{Phase, Phases};
pub use refinement::{Refinement, differences};
pub use run::{Details, Diagnostics, Run, Solve, Watch};
pub use series::{NORMS, Series, StudyPoint, judge};
pub use snapshots::Snapshots;

use crate::failure::Refusal;
use crate::field::ManufacturedField;
use crate::method::{Division, Method};

/// Runs one level: the whole time window, with the body divided into `cells`; see [`Solve::run`].
///
/// # Errors
/// The scene cannot be started.
pub fn run_level<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: &Division,
    observer: &mut dyn Observer,
) -> Result<StudyLevel, Refusal> {
    T::run(field, method, cells, Watch::Displacement, observer).map(|run| run.level)
}
