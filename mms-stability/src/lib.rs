//! Tests whether a compiled field is fit for verification: a stable solution of its own problem, which a solver can follow.
//!
//! Four kinds of disturbances can grow on an exact motion, and then no solver follows it, not even a correct one:
//!
//! | disturbance | grows if | module |
//! |---|---|---|
//! | short waves in the body | an acoustic tensor is not positive definite | `waves` |
//! | short waves on a face that can move | the surface impedance is not positive definite | `faces`, `impedance` |
//! | short disturbances at a corner of such faces | the second variation of the energy is not positive for displacements of the quadrant between both faces | `corners` |
//! | long waves | the tangent on a coarse mesh has a negative eigenvalue | `growth` |
//!
//! These modules sample, at the defaults of the parameters, and prove nothing. The proof of strong ellipticity is in
//! `mms_codegen::certify`.
//!
//! | other modules | contents |
//! |---|---|
//! | `stability`, `warnings` | all results for a field, and the warnings about them |
//! | `subject`, `elasticity` | the exact state at a place and a time; its elasticity A and acoustic tensors |
//! | `chart`, `mesh`, `modes`, `pencil` | the body as a box, its coarse mesh, stiffness and mass, the least eigenvalue |
//! | `solve` | Newton's method on the coarse mesh, for a static field |
//! | `resting`, `fibres` | moduli at F = I, also of a material with fibres |
//! | `wavelength`, `least` | the shortest wavelength of a motion; the minimum of a function over a box |

mod chart;
pub mod corners;
pub mod elasticity;
pub mod faces;
pub mod fibres;
pub mod growth;
pub mod impedance;
mod least;
mod mesh;
mod modes;
pub mod pencil;
pub mod resting;
pub mod solve;
pub mod stability;
pub mod subject;
pub mod warnings;
pub mod wavelength;
pub mod waves;

pub use stability::{Stability, judge};
