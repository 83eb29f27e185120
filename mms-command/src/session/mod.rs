//! What commands have in common: the field that is given and its variants, its values at many points, the options of a
//! method, the time steps that are stable, what runs will take, and progress.

pub(crate) mod effort;
pub(crate) mod progress;
