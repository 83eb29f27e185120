//! One level of a study.

use super::Errors;
use crate::failure::Failure;
use crate::method::Division;

/// One level of a study: a run at one resolution.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyLevel {
    /// Cells of the body.
    pub cells: Division,
    /// Grid spacing h, the longest edge of a cell.
    pub cell_size: f64,
    /// Time step dt.
    pub time_step: f64,
    /// The number of steps of the time window.
    pub steps: usize,
    /// The number of particles.
    pub particles: usize,
    /// The errors, or the reason why the run stopped.
    pub errors: Result<Errors, Failure>,
    /// Wall-clock seconds, everything included.
    pub seconds: f64,
}
