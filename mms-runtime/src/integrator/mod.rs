//! Explicit time integrators: the order in which one step does its sums and updates.
//!
//! To add one, write `integrator/name.rs` with a type that implements [`Integrator`] in terms of the
//! operations of [`Solver`], and its source, and add `name::Type` to the list below. The property tests
//! and the `mms` command then find it by itself.
//!
//! All map mass m_i = sum w m and momentum (mv)_i = sum w m v to the grid, and evaluate the body force
//! at the beginning of the step, b(X, t^n). They differ in when the deformation follows, and from which
//! velocity.

use crate::extension::extension_list;
use crate::shape::Shape;
use crate::{Failure, ManufacturedField, Real, Solver};

extension_list! {
    /// The time integrators.
    IntegratorName, IntegratorVisitor: Integrator, "time integrator";
    usl::Usl,
    usf::Usf,
    musl::Musl,
    leapfrog::Leapfrog,
}

/// A time integrator.
pub trait Integrator: 'static {
    /// Order of the displacement in time, by theory; a test measures it.
    const FORMAL_ORDER: i32;

    /// Advances particles and grid from t^n = `solver.time()` by one time step dt.
    ///
    /// The solver has checked the state before, and checks it afterwards.
    fn step<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized, S: Shape>(
        solver: &mut Solver<'_, T, D, F, S>,
    ) -> Result<(), Failure>;
}
