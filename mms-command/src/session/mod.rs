//! The common parts of commands: the given field and its variants, its values at many points, the options of a method, stable
//! time steps, the effort of runs, and progress.

pub(crate) mod estimate;
pub(crate) mod progress;
