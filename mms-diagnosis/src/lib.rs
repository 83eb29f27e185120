//! Names the mistake of a solver by the error that it makes.
//!
//! A [hypothesis] is a change of what a solver is given or computes: of b, of tau, of tractions on a face, of rho0, of the initial
//! state, of a condition, or of what is written. The error that it makes is found in one of three ways:
//!
//! * of a law alone, by its stresses ([`table`]) or its [tangent](mod@tangent), or of formulas from paper ([`closed_form`]);
//! * of accelerations or residuals at an exact state, by the [weak] form of the balance ([`state`]); velocities after one
//!   [step] are mean accelerations;
//! * of ordinary results, by running the solver of `mms-runtime` with the [changed] field, at rest by Newton's method about
//!   the exact motion ([`statics`]), or for mistakes of output by the exact solution ([`ordinary`], [`run`]).
//!
//! Errors are compared as coefficients of [smooth] functions, or as sums with them, never point by point: what
//! methods make of an error between points differs, and what is smooth does not. Those of our own runs are taken at the user's points
//! ([`sample`]), for what is not smooth looks different at others. [`rank`] finds the size with which a hypothesis comes nearest
//! to an error, besides what the method makes of it: that falls from one mesh of the user's to the next, and is about what
//! one of several right methods of our own makes. [`answer`] says whether what is left is no more than that, and which
//! hypotheses do as well. Where none does, [`pair`] looks for two, and [`place`] says where the error is.
//!
//! If the order between meshes is wrong ([`falls`]), the answer is a name or that nothing explains the error, however small it is.
//! Where an error is no more than a method's, the same runs tell which mistakes it [excludes](excluded).
//!
//! A hypothesis is named only if three things hold: it leaves little of the error; its effect need not be scaled, or its size is one
//! that it may have; and, where that size was fitted, the error is beyond that of methods ([`answer::Limits`]).
//!
//! The formula for a size that is no factor of the effect (a time, a density) is met by repeating: the response is found again at
//! the size that the last one asked for.

pub mod answer;
mod body;
pub mod changed;
pub mod closed_form;
pub mod evidence;
pub mod exact;
pub mod excluded;
pub mod falls;
pub mod hypothesis;
pub mod law;
pub mod level;
pub mod like;
pub mod list;
pub mod material;
pub mod ordinary;
pub mod pair;
pub mod patterns;
pub mod place;
pub mod quadrature;
pub mod rank;
mod revolved;
pub mod run;
pub mod sample;
pub mod scene;
pub mod slopes;
pub mod smooth;
pub mod solver;
pub mod state;
pub mod statics;
pub mod step;
pub mod table;
pub mod tangent;
pub mod weak;
