//! Continuum mechanics on the graph: from u(X, t) and W to every quantity.
//!
//! Kinematics are differentiated symbolically. Stress and its divergence go through the tensor
//! algebra of hyperelasticity, so that expressions grow with the field and not with the
//! material. Everything is written in the displacement gradient H = F - I, because strains formed
//! from F lose eps/strain.

pub mod amplitude;
pub mod boundary;
#[cfg(feature = "defects")]
pub mod defect;
#[cfg(not(feature = "defects"))]
mod defect;
pub mod derivation;
mod expansion;
pub mod extent;
pub mod face;
mod finite;
pub mod invariant;
pub mod kinematics;
pub mod material;
mod meanings;
pub mod misread;
pub mod model;
pub mod offset;
pub mod output;
mod place;
pub mod resolve;
pub mod rigid;
pub mod rounding;
pub mod sample;
pub mod simplify;
mod small_strain;
pub mod tensor;

pub use derivation::{Derivation, Response, TooLarge, derive, tangent};
pub use model::{Domain, Model};
pub use output::{Bound, Output, Program};
