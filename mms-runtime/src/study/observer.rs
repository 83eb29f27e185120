//! Observers of a run: its progress, and its states.

use std::io::{self, Read, Write};

use super::{Diagnostics, Errors};
use crate::axisymmetric::{hoop_stretch, kirchhoff_stress};
use crate::field::ManufacturedField;
use crate::real::{Matrix, Real, Vector};
use crate::solver::StateView;
use crate::tensor::{deformation_gradient, inverse};

/// Observes a run. A closure receives only the steps, and `()` ignores all.
pub trait Observer: Send {
    /// Called before the first step, with the number of particles and of steps.
    fn begin(&mut self, _particles: usize, _steps: usize) {}

    /// Called after each step, with its number, from 1, and the number of steps.
    fn step(&mut self, step: usize, steps: usize);

    /// Whether to call [`see`](Observer::see) after this step; 0 is the initial state.
    fn wants(&self, _step: usize, _steps: usize) -> bool {
        false
    }

    /// Receives a state.
    ///
    /// # Errors
    /// The reason why the run should stop.
    fn see(&mut self, _frame: &Frame) -> Result<(), String> {
        Ok(())
    }

    /// Whether to call [`record`](Observer::record) after every step. That costs an evaluation of the material's strain energy.
    fn records(&self) -> bool {
        false
    }

    /// Receives the results of a step.
    fn record(&mut self, _record: &Record) {}

    /// A checkpoint of the same scene, to resume from instead of starting.
    fn resume(&mut self) -> Option<Box<dyn Read + '_>> {
        None
    }

    /// Whether to call [`keep`](Observer::keep) after this step, which writes a checkpoint or stops the run.
    fn keeps(&self, _step: usize, _steps: usize) -> bool {
        false
    }

    /// Receives a checkpoint.
    ///
    /// # Errors
    /// The reason why the run should stop.
    fn keep(&mut self, _checkpoint: &dyn Checkpoint) -> Result<(), String> {
        Ok(())
    }
}

/// A state of a run, from which it can be resumed to the bit.
pub trait Checkpoint {
    /// The step after which the checkpoint was made.
    fn step(&self) -> usize;

    /// Writes the checkpoint.
    ///
    /// # Errors
    /// The checkpoint cannot be written.
    fn write(&self, to: &mut dyn Write) -> io::Result<()>;
}

/// The results of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The step, from 1.
    pub step: usize,
    /// The time of positions, F and stress.
    pub time: f64,
    /// The errors of the displacement.
    pub displacement: Errors,
    /// Sums over the particles; without a balance where only the displacement is watched.
    pub diagnostics: Diagnostics,
}

impl Observer for () {
    fn step(&mut self, _: usize, _: usize) {}
}

impl<F: FnMut(usize, usize) + Send> Observer for F {
    fn step(&mut self, step: usize, steps: usize) {
        self(step, steps);
    }
}

/// All particles at a time, in double precision and in the order of their numbers. Vectors have `dimension` components for
/// each, tensors the square of that, by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The step; 0 is the initial state.
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
    /// v; half a step earlier with some integrators.
    pub velocity: Vec<f64>,
    /// F.
    pub deformation_gradient: Vec<f64>,
    /// The Cauchy stress tau/J; P at small strain.
    pub cauchy_stress: Vec<f64>,
    /// F_tt if the body is a body of revolution; empty otherwise.
    pub hoop_stretch: Vec<f64>,
    /// The component of the Cauchy stress around the axis; empty otherwise.
    pub hoop_stress: Vec<f64>,
}

impl Frame {
    /// The state of a solver.
    pub(super) fn of<T: Real, const D: usize, F>(present: &StateView<'_, T, D, F>) -> Self
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let StateView { field, particles, .. } = *present;
        let (x, h) = (&particles.reference_position, particles.displacement_gradient.iter());
        let h: Vec<_> = h.collect();
        let mut exact = vec![Vector::zeros(); particles.len()];
        let now = T::of(present.time);
        field.displacement(now, x, &mut exact);
        let mut stress = vec![Matrix::zeros(); particles.len()];
        let mut hoop = particles.hoop_strain.to_vec();
        kirchhoff_stress(field, now, x, (&h, &particles.hoop_strain), (&mut stress, &mut hoop));
        let d = &particles.displacement;
        let is_small = field.is_small_strain();
        let cauchy = |p: usize| {
            let deformation = deformation_gradient(&h[p]);
            match inverse(&deformation).filter(|_| is_small) {
                Some(inverse) => stress[p] * inverse.transpose(),
                None => stress[p] / particles.jacobian(p),
            }
        };
        let stretch = |p: usize| hoop_stretch(&particles.hoop_strain, p);
        let hoop_stress = |p: usize| match is_small {
            true => hoop[p] / stretch(p),
            false => hoop[p] / particles.jacobian(p),
        };
        let around = |of: &dyn Fn(usize) -> T| match hoop.is_empty() {
            true => Vec::new(),
            false => by_number(&particles.id, 1, |p, out| out[0] = of(p).to_f64()),
        };
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
            step: present.step,
            time: present.time,
            dimension: D,
            position: vectors(&|p| particles.position(p)),
            displacement: vectors(&|p| d.get(p)),
            displacement_error: vectors(&|p| d.get(p) - exact[p]),
            velocity: vectors(&|p| particles.velocity.get(p)),
            deformation_gradient: tensors(&|p| deformation_gradient(&h[p])),
            cauchy_stress: tensors(&cauchy),
            hoop_stretch: around(&stretch),
            hoop_stress: around(&hoop_stress),
        }
    }
}

/// Collects `width` components of each particle, which `write` computes, in the order of their numbers.
fn by_number(ids: &[u32], width: usize, write: impl Fn(usize, &mut [f64])) -> Vec<f64> {
    let mut values = vec![0.0; width * ids.len()];
    for (p, &id) in ids.iter().enumerate() {
        let at = width * id as usize;
        write(p, &mut values[at..at + width]);
    }
    values
}
