//! Who follows a run: its progress, and its states.

use crate::formulation::Formulation;
use crate::shape::Shape;
use crate::tensor::{deformation_gradient, jacobian};
use crate::{ManufacturedField, Matrix, Real, Solver, Vector};

/// Follows a run. A closure does, if it wants no states, and `()` looks away.
pub trait Observer: Send {
    /// Before the first step: how many particles and steps there are.
    fn begin(&mut self, _particles: usize, _steps: usize) {}

    /// After each step: its number, from 1, and the number of steps.
    fn step(&mut self, step: usize, steps: usize);

    /// Whether the state after this step is wanted; 0 is the initial one.
    fn wants(&self, _step: usize, _steps: usize) -> bool {
        false
    }

    /// A state that was wanted.
    ///
    /// # Errors
    /// Why the run should stop.
    fn see(&mut self, _frame: &Frame) -> Result<(), String> {
        Ok(())
    }
}

impl Observer for () {
    fn step(&mut self, _: usize, _: usize) {}
}

impl<F: FnMut(usize, usize) + Send> Observer for F {
    fn step(&mut self, step: usize, steps: usize) {
        self(step, steps);
    }
}

/// All particles at a time, in double precision and in the order of their numbers. Of vectors there are `dimension`
/// components for each, of tensors their square, by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// After this step; 0 is the initial state.
    pub step: usize,
    /// The time of positions, F and stress.
    pub time: f64,
    /// The number of components of a vector.
    pub dimension: usize,
    /// x.
    pub position: Vec<f64>,
    /// d = x - X.
    pub displacement: Vec<f64>,
    /// d less the field's u(X, t).
    pub displacement_error: Vec<f64>,
    /// v; some integrators have it half a step earlier.
    pub velocity: Vec<f64>,
    /// F.
    pub deformation_gradient: Vec<f64>,
    /// The Cauchy stress tau/J.
    pub cauchy_stress: Vec<f64>,
}

impl Frame {
    /// The state of a solver.
    pub(super) fn of<T: Real, const D: usize, F, S, L>(
        solver: &Solver<'_, T, D, F, S, L>,
        step: usize,
    ) -> Self
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let (field, particles) = (solver.field(), solver.particles());
        let (x, h) = (&particles.reference_position, &particles.displacement_gradient);
        let mut exact = vec![Vector::zeros(); particles.len()];
        field.displacement(T::of(solver.present()), x, &mut exact);
        let mut stress = vec![Matrix::zeros(); particles.len()];
        field.kirchhoff_stress(x, h, &mut stress);
        let d = &particles.displacement;
        let vectors = |of: &dyn Fn(usize) -> Vector<T, D>| {
            by_number(&particles.id, D, |p, out| {
                out.copy_from_slice(of(p).map(Real::to_f64).as_slice());
            })
        };
        let tensors = |of: &dyn Fn(usize) -> Matrix<T, D>| {
            by_number(&particles.id, D * D, |p, out| {
                // Components are stored by columns.
                out.copy_from_slice(of(p).map(Real::to_f64).transpose().as_slice());
            })
        };
        Self {
            step,
            time: solver.present(),
            dimension: D,
            position: vectors(&|p| particles.position(p)),
            displacement: vectors(&|p| d[p]),
            displacement_error: vectors(&|p| d[p] - exact[p]),
            velocity: vectors(&|p| particles.velocity[p]),
            deformation_gradient: tensors(&|p| deformation_gradient(&h[p])),
            cauchy_stress: tensors(&|p| stress[p] / jacobian(&h[p])),
        }
    }
}

/// `width` components of each particle, which `write` gives, in the order of their numbers.
fn by_number(ids: &[u32], width: usize, write: impl Fn(usize, &mut [f64])) -> Vec<f64> {
    let mut values = vec![0.0; width * ids.len()];
    for (p, &id) in ids.iter().enumerate() {
        let at = width * id as usize;
        write(p, &mut values[at..at + width]);
    }
    values
}
