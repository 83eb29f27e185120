//! Names the mistake of a solver by the error that it makes.
//!
//! A [hypothesis] is a change of the input of a solver or of what it computes: of b, tau, tractions on a face, rho0, the
//! initial state, a condition, or the written results. The error that it makes is computed in one of three ways:
//!
//! * for a law alone, from its stresses ([`table`]) or its [tangent](mod@tangent), or from formulas on paper ([`closed_form`]);
//! * for accelerations or residuals at an exact state, from the [weak] form of the balance ([`state`]); velocities after one
//!   [step] are mean accelerations;
//! * for ordinary results, from a run of the solver of `mms-runtime` with the [changed] field, at rest from Newton's method
//!   about the exact motion ([`statics`]), or, for mistakes of output, from the exact solution ([`ordinary`], [`run`]).
//!
//! Errors are compared as coefficients of [smooth] functions, or as sums with them, never point by point, because methods
//! differ in the error between points and agree in its smooth part. The errors of our own runs are interpolated at the user's
//! points ([`sample`]), because the part that is not smooth depends on the points. [`rank`] finds the size with which a
//! hypothesis comes nearest to an error, allowing for the error of the method. The error of the method is assumed to fall from
//! mesh to mesh of the user, and to be about as large as the error of one of our right methods. [`answer`] states whether the
//! rest is at most this error, and which hypotheses explain as much. If none does, [`pair`] searches two, and [`place`] says
//! where the error is.
//!
//! If the order between meshes is wrong ([`falls`]), the finding is `named` or `unexplained`, however small the error is. If an
//! error is no larger than a method's, the same runs show which mistakes it [excludes](excluded). [`follow`] shows the progress
//! of the runs, and ends them on request.
//!
//! A hypothesis is named only if three conditions hold ([`answer::Limits`]). It leaves little of the error unexplained. Its
//! fitted size is possible or, for a hypothesis without a size, its effect fits unscaled. If the size was fitted, the error is
//! larger than the methods' errors.
//!
//! If the effect is not proportional to the size (a time, a density), the size is found by iteration: the response is computed
//! again at the size that the last response suggests.

pub mod answer;
mod body;
pub mod changed;
pub mod closed_form;
pub mod evidence;
pub mod exact;
pub mod excluded;
pub mod falls;
pub mod follow;
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
