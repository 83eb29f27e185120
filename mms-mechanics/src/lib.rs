//! Continuum mechanics on the graph: derives every quantity from u(X, t) and W.
//!
//! Kinematics are differentiated symbolically. Stress and its divergence are computed by the tensor algebra of hyperelasticity,
//! so that expressions grow with the field and not with the material. Everything is written in the displacement gradient H =
//! F - I, because a strain computed from F has a relative rounding error of eps/strain:
//!
//! ```text
//! C - I = H + H^T + H^T H          i1 = tr (C - I)          i2 = 2 i1 + (i1^2 - tr (C - I)^2)/2
//! B - I = H + H^T + H H^T          j  = the sum of the principal minors of H
//! ```
//!
//! A strain-energy density has one of three kinds (`invariant`): a function of I1, I2, I3 = J^2 and J; of these and I4; or of
//! the small strain. Only the quantities that its kind needs are derived.
//!
//! The solver needs the material without the field. The same `Law` is therefore evaluated a second time at a gradient H that
//! the caller supplies: W(H), P(H), tau(H), with rho0(X) and the fastest wave speed at F = I, sqrt(dP_11/dF_11 / rho0); with
//! fibres it is the greater of two speeds, along them and across. These are the `Response`s. The tangent dP/dF is a separate
//! program (`Compiled::tangent`), made only on request. The forcing and the solver's stress follow from one W, so neither can
//! verify the other; the tests verify both by independent routes.
//!
//! | module | contents |
//! |---|---|
//! | `resolve`, `meanings`, `model` | formulas with names to expressions; a field with resolved names |
//! | `derivation`, `kinematics`, `tensor` | all quantities; strains and motion; matrices of expressions |
//! | `material`, `invariant`, `finite`, `divergence`, `expansion`, `small_strain`, `rest` | stress and Div P from W; W about F = I; the material at F = I |
//! | `axisymmetric`, `rigid`, `offset`, `boundary`, `face`, `requested` | the basis that turns about the axis; rigid twins; places far from the origin; data on faces; quantities on request |
//! | `simplify`, `candidates` | the choice among the forms of a quantity |
//! | `amplitude`, `samples`, `rounding` | whether a form keeps its digits at a small amplitude; values at a few places; bounds of rounding errors |
//! | `region`, `extent`, `sample` | bodies in formulas; bodies in numbers; points over body and time window |
//! | `output` | the keys of programs |
//! | `defect`, `faults` | deliberate mistakes, and the expressions that they change |

pub mod amplitude;
pub mod axisymmetric;
pub mod boundary;
pub mod candidates;
#[cfg(feature = "defects")]
pub mod defect;
#[cfg(not(feature = "defects"))]
mod defect;
pub mod derivation;
mod divergence;
mod expansion;
pub mod extent;
pub mod face;
pub mod faults;
mod finite;
pub mod invariant;
pub mod kinematics;
pub mod material;
mod meanings;
pub mod model;
pub mod offset;
pub mod output;
pub mod region;
mod requested;
pub mod resolve;
mod rest;
pub mod rigid;
pub mod rounding;
pub mod sample;
mod samples;
pub mod simplify;
mod small_strain;
pub mod tensor;

pub use derivation::{Derivation, Response, TooLarge, derive, tangent};
pub use model::{Domain, Model};
pub use output::{Bound, Output, Program};
pub use requested::requested;
pub use rest::{at_rest, is_spherical, moduli, pressures};
pub use samples::{largest_triangle, triangles};
