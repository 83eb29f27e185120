//! The solver whose results are diagnosed, as far as it is known.

use mms_runtime::Method;

use crate::changed::Without;
use crate::falls::Falls;

/// The user's solver, as far as it is known.
#[derive(Clone, Debug, Default)]
pub struct Solver {
    /// The terms that were left out.
    pub without: Without,
    /// A method of this project's own solver that it may be like.
    pub like: Option<Method>,
    /// The decrease of its errors from mesh to mesh, for results of two meshes or more.
    pub falls: Option<Falls>,
    /// Whether the results are compared with a right run of the same solver, which has the same errors.
    pub is_compared_with_right_run: bool,
}
