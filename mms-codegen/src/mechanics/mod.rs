//! Continuum mechanics on the graph: from u(X, t) and W to every quantity.
//!
//! Kinematics are differentiated symbolically. Stress and its divergence go through the tensor
//! algebra of hyperelasticity, so that expressions grow with the field and not with the
//! material. Everything is written in the displacement gradient H = F - I, because strains formed
//! from F lose eps/strain.

pub mod amplitude;
pub mod boundary;
pub mod derivation;
mod expansion;
pub mod face;
mod finite;
pub mod invariant;
pub mod kinematics;
pub mod material;
pub(crate) mod misread;
pub mod model;
pub(crate) mod offset;
mod place;
pub mod rigid;
pub mod rounding;
mod small_strain;
pub mod tensor;

pub use derivation::{Derivation, Response, TooLarge, derive, tangent};
pub use model::{Domain, Model};
