//! Names the mistake of a solver by the error that it makes.
//!
//! A [hypothesis] is a change of the input of a solver or of what it computes: of b, tau, tractions on a face, rho0, the
//! initial state, a condition, or the written results. The error that a hypothesis makes is computed in one of three ways:
//!
//! * for a law alone, from its stresses ([`table`]) or its [tangent](mod@tangent), or from formulas on paper ([`closed_form`]);
//! * for accelerations or residuals at an exact state, from the [weak] form of the balance ([`state`]); velocities after one
//!   [step] are mean accelerations;
//! * for ordinary results ([`ordinary`], [`run`]): from a run of the solver of `mms-runtime` with the [changed] field; for a
//!   static field, from an equilibrium that Newton's method finds near the exact motion ([`statics`]); for a mistake of output,
//!   from the exact solution.
//!
//! Errors are compared as coefficients of [smooth] functions, or as sums with them, never point by point, because methods
//! differ in the error between points and agree in its smooth part. The errors of this project's runs are interpolated at the
//! user's points ([`sample`]), because the part that is not smooth depends on the points. [`rank`] finds the size with which the
//! error of a hypothesis is nearest to the user's error, allowing for the error of the user's method. That error is assumed to
//! fall from one of the user's meshes to the next, and to be about as large as the error of a right method: a method of this
//! project, run without a mistake. [`answer`] states whether the part of the error that the best hypothesis does not explain is
//! at most the error of the method, and which other hypotheses explain as much as the best one. If no hypothesis explains the
//! error, [`pair`] searches for two that explain it together, and [`place`] says where the error is.
//!
//! If the observed order of the error from mesh to mesh is wrong ([`falls`]), the finding is `named` or `unexplained`, even if
//! the error is small. If an error is no larger than the error of a right method, the runs also show which mistakes the error
//! [excludes](excluded). [`follow`] shows the progress of the runs, and ends them on request.
//!
//! A hypothesis is named only if four conditions hold ([`answer::Limits`]):
//!
//! * It leaves little of the error unexplained, and not much more than hypotheses of an impossible size leave.
//! * Few other hypotheses explain the error as well.
//! * Its fitted size is possible or, for a hypothesis without a size, its effect fits unscaled.
//! * The error is not small compared with the errors of right methods; the limit is higher if the size was fitted.
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
