//! The traits that a manufactured field implements, and an explicit MPM/GIMP solver that measures its own observed order of
//! accuracy on any such field.
//!
//! * [`ManufacturedField`] and [`Material`] are implemented by generated code; they are evaluated over slices of
//!   particles and are object-safe.
//! * [`Solver`] advances a body of particles through a background grid. It is written once for one to three
//!   dimensions and for `f32` and `f64`.
//! * [`AnySolver`] is a solver as a trait object. [`Solve::solver`] makes one for the shape function, integrator and
//!   formulation that a [`Method`] names; all combinations are compiled in this crate.
//! * [`study`] runs a method over levels of refinement, measures the errors against the field, and judges the
//!   observed orders.
//!
//! The crate depends on no particular field. To add a shape function or a time integrator, see [`shape`] and [`integrator`]:
//! each is one file and one word in a list.
//!
//! | module | contents |
//! |---|---|
//! | `axisymmetric` | bodies of revolution: rings, hoop strain, hoop stress |
//! | `body` | bodies filled with particles: boxes, annuli and sectors, Cartesian or fitted; the pieces of faces that particles carry; jitter |
//! | `lattice` | positions of nodes: cells of any edge lengths, offset, period, knots |
//! | `stencil`, `shape` | the nodes of a pack with w and grad w; the sums between particles and nodes |
//! | `particle`, `column` | the particles' arrays, grouped in packs |
//! | `lanes` | vectors and tensors of a pack, a particle in each lane |
//! | `spline`, `gimp` | B-splines of any degree on knots that may end; averages of hat functions |
//! | `nodal`, `grid` | four numbers of a node, windows of nodes; the nodes |
//! | `formulation` | updated: tau, weights that follow x, dF/dt = L F. Total: P, weights at X |
//! | `transfer` | FLIP, PIC, APIC, XPIC |
//! | `solver` | P2G and G2P, weights, order of the particles, threads, state |
//! | `boundary` | walls by images, periods, nodes that follow the field, tractions |
//! | `integrator` | the order of the operations of a step |
//! | `study` | a run, its observers, errors, orders, verdicts |
//! | `field`, `material`, `scene` | the traits of a field and of its material; a field of any dimension |
//! | `method` | the settings of a run, without the field and the number of cells |
//! | `failure` | the reasons why a run is not started, or stops |
//! | `real`, `tensor`, `threads` | precisions, vectors and matrices; tensor operations; fork and join |
//! | `extension` | the macro that lists shape functions, integrators and formulations |
//! | `defect` | deliberate mistakes of the solver |
//!
//! Names follow one glossary: `reference_position` X, `position` x = X + u, `displacement_gradient` H = du/dX, F =
//! I + H, J = det F, `kirchhoff_stress` tau = P F^T. Units are the field's own; any consistent system works.

#[cfg(feature = "defects")]
pub mod defect;
#[cfg(not(feature = "defects"))]
mod defect;
mod extension;
pub mod spline;

pub mod axisymmetric;
pub mod body;
pub mod boundary;
pub mod column;
pub mod failure;
pub mod field;
pub mod formulation;
pub mod gimp;
pub mod grid;
pub mod integrator;
pub mod lanes;
pub mod lattice;
pub mod material;
pub mod method;
pub mod nodal;
pub mod particle;
mod real;
pub mod scene;
pub mod shape;
pub mod solver;
pub mod stencil;
pub mod study;
pub mod tensor;
mod threads;
pub mod transfer;

pub use mms_convergence as convergence;
pub use mms_math as math;
pub use nalgebra;

pub use body::Fill;
pub use extension::UnknownName;
pub use failure::{Cause, Failure, Refusal};
pub use field::{Body, Condition, Domain, Face, ManufacturedField};
pub use formulation::FormulationName;
pub use grid::Grid;
pub use integrator::IntegratorName;
pub use lattice::Lattice;
pub use material::{Axisymmetric, Material};
pub use method::{Division, Method, Setup};
pub use real::{Matrix, Real, Vector, arrays, arrays_mut};
pub use shape::ShapeName;
pub use solver::{AnySolver, Solver};
pub use study::{Errors, Run, Solve, StudyLevel, run_level};
pub use transfer::Transfer;
