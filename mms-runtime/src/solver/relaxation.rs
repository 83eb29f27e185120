//! Dynamic relaxation: the computation of an equilibrium, for a field that does not move.
//!
//! # Loads
//!
//! The body starts undeformed and at rest. Along a ramp the field is g(t) u(X), with g = t/T: faces move to their exact places
//! at constant speeds, so that their particles arrive there in any number of steps; the body force is g b, and tractions are
//! computed from g H. T is the time in which the fastest wave crosses the longest edge of the body. After that the loads are
//! constant, and only forces out of balance move the body. A body that follows its loads overshoots little. That matters in the
//! updated formulation, where an error on the way remains at the end.
//!
//! # Damping
//!
//! Kinetic: whenever the kinetic energy of the nodes has passed a peak, all particles are halted (Cundall 1976; Barnes, "Form
//! finding and analysis of tension structures by dynamic relaxation", Int. J. Space Struct. 14 (1999) 89-104). Viscous damping
//! needs a coefficient that follows the lowest frequency (Underwood 1983), which has to be estimated for every body as it
//! stiffens, and damps badly if the estimate is wrong. Peaks need no parameter and occur with every shape function and
//! transfer, and halting acts on particles alone, at one place between two steps. Integrators that move particles by one
//! velocity and deform them by another are refused: each halt would make u inconsistent with F.
//!
//! # Mass
//!
//! The mass is fictitious, for an equilibrium does not depend on it: rho0 of the field, or 1 if the field has none, with b =
//! -Div P/rho0 by the same number. The Courant number determines the time step with this mass, so that a wave needs the usual
//! number of steps for a cell.
//!
//! # The end
//!
//! The residual is the norm of the forces out of balance at the nodes divided by the norm of the forces of the stress.
//! Constrained components have none: their reactions balance them. The run ends below [`SMALL`], far below the error of a grid;
//! or when only the rounding of H, and in the updated formulation of x, is out of balance.

use super::Solver;
use super::operations::Forces;
use super::setup::largest_wave_speed;
use crate::body::{Fill, Filling, bounding_box};
use crate::column::{Matrices, PACK};
use crate::failure::{Failure, Refusal};
use crate::field::{Domain, ManufacturedField};
use crate::grid::Grid;
use crate::material::{Axisymmetric, Material};
use crate::nodal::Nodal;
use crate::real::{Matrix, Real, Vector};

/// The residual at which a run ends.
const SMALL: f64 = 1e-9;

/// The multiple of the expected rounding that may be out of balance.
const ROUNDINGS: f64 = 4.0;

/// The number of places along each edge of a body where its wave speed is sampled.
const SAMPLES: f64 = 8.0;

/// A field whose loads grow from 0 to their full values along a ramp, its time window.
pub struct Ramp<'f, T: Real, const D: usize> {
    field: &'f dyn ManufacturedField<T, D>,
    /// T.
    length: T,
}

impl<'f, T: Real, const D: usize> Ramp<'f, T, D> {
    /// A ramp of a field that does not move.
    ///
    /// # Errors
    /// The body has no extent; a wave speed is not positive and finite.
    pub fn new(field: &'f dyn ManufacturedField<T, D>) -> Result<Self, Refusal> {
        let body = field.domain().body;
        let [lower, upper] = bounding_box(&body)?;
        let edges = upper - lower;
        let filling = Filling::new(&body, Fill::Fitted, &(edges / SAMPLES))?;
        let samples: Vec<Vector<T, D>> = filling.position.iter().map(|x| x.map(T::of)).collect();
        let length = edges.max() / largest_wave_speed(field, &samples)?;
        Ok(Self { field, length: T::of(length) })
    }

    /// g.
    fn share(&self, time: T) -> T {
        if time < self.length { time / self.length } else { T::one() }
    }

    /// dg/dt, for steps that end at a time; integrators evaluate it at the end of a step, or half a step before.
    fn rate(&self, time: T) -> T {
        let round_off = self.length * T::of(1e-6);
        let is_on = time > round_off && time < self.length + round_off;
        if is_on { T::one() / self.length } else { T::zero() }
    }

    fn scale(out: &mut [Vector<T, D>], factor: T) {
        out.iter_mut().for_each(|it| *it *= factor);
    }
}

impl<T: Real, const D: usize> Material<T, D> for Ramp<'_, T, D> {
    fn density(&self, reference: &[Vector<T, D>], density: &mut [T]) {
        self.field.density(reference, density);
    }

    fn wave_speed(&self, reference: &[Vector<T, D>], speed: &mut [T]) {
        self.field.wave_speed(reference, speed);
    }

    fn is_small_strain(&self) -> bool {
        self.field.is_small_strain()
    }

    fn axisymmetric(&self) -> Option<&dyn Axisymmetric<T, D>> {
        self.field.axisymmetric().map(|_| self as &dyn Axisymmetric<T, D>)
    }

    fn kirchhoff_stress(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        self.field.kirchhoff_stress(time, reference, displacement_gradient, stress);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) {
        self.field.kirchhoff_stress_of_packs(time, reference, displacement_gradient, stress);
    }

    fn strain_energy(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        energy: &mut [T],
    ) -> bool {
        self.field.strain_energy(time, reference, displacement_gradient, energy)
    }
}

impl<T: Real, const D: usize> Ramp<'_, T, D> {
    /// The axisymmetric material of the field. Only called for axisymmetric fields.
    fn revolved(&self) -> &dyn Axisymmetric<T, D> {
        self.field.axisymmetric().expect("an axisymmetric field")
    }
}

impl<T: Real, const D: usize> Axisymmetric<T, D> for Ramp<'_, T, D> {
    fn hoop_strain(&self, time: T, reference: &[Vector<T, D>], out: &mut [T]) {
        self.revolved().hoop_strain(T::zero(), reference, out);
        let share = self.share(time);
        out.iter_mut().for_each(|strain| *strain *= share);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        strains: (&[Matrices<T, D>], &[[T; PACK]]),
        stresses: (&mut [Matrices<T, D>], &mut [[T; PACK]]),
    ) {
        self.revolved().kirchhoff_stress_of_packs(time, reference, strains, stresses);
    }

    fn strain_energy(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        strains: (&[Matrix<T, D>], &[T]),
        energy: &mut [T],
    ) -> bool {
        self.revolved().strain_energy(time, reference, strains, energy)
    }
}

impl<T: Real, const D: usize> ManufacturedField<T, D> for Ramp<'_, T, D> {
    fn domain(&self) -> Domain<T, D> {
        Domain { time: [T::zero(), self.length], ..self.field.domain() }
    }

    fn displacement(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.field.displacement(T::zero(), reference, out);
        Self::scale(out, self.share(time));
    }

    fn velocity(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.field.displacement(T::zero(), reference, out);
        Self::scale(out, self.rate(time));
    }

    fn acceleration(&self, _: T, _: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        out.fill(Vector::zeros());
    }

    fn body_force(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.field.body_force(T::zero(), reference, out);
        Self::scale(out, self.share(time));
    }

    fn displacement_gradient(&self, time: T, reference: &[Vector<T, D>], out: &mut [Matrix<T, D>]) {
        self.field.displacement_gradient(T::zero(), reference, out);
        let share = self.share(time);
        out.iter_mut().for_each(|h| *h *= share);
    }

    fn surface_stress(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        self.field.surface_stress(time, reference, displacement_gradient, stress);
    }
}

/// The distance of a body from equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The norm of the forces out of balance divided by the norm of the forces of the stress.
    pub relative: f64,
    /// The residual at which a run ends.
    pub tolerance: f64,
}

impl Residual {
    /// Computes the residual from the norms of all forces at free components, of the forces of the stress, and of the forces of
    /// rounding.
    fn of(force: f64, internal: f64, rounding: f64) -> Self {
        // If there is no stress, as in an undeformed body, all forces are out of balance.
        let relative = |norm: f64| if norm == 0.0 { 0.0 } else { norm / internal };
        Self { relative: relative(force), tolerance: SMALL.max(ROUNDINGS * relative(rounding)) }
    }

    /// Whether the residual is within the tolerance.
    pub fn is_small(&self) -> bool {
        self.relative <= self.tolerance
    }
}

impl<T: Real, const D: usize, F> Solver<'_, T, D, F>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    /// sum m v.v/2 of the nodes, with the v_i that the last step moved particles by.
    pub fn kinetic_energy(&self) -> f64 {
        let Grid { momentum, velocity, .. } = &self.grid;
        let of = |(momentum, v): (&Nodal<T>, &Nodal<T>)| {
            momentum.last().to_f64() * v.vector::<D>().map(Real::to_f64).norm_squared() / 2.0
        };
        momentum.iter().zip(velocity).map(of).sum()
    }

    /// Sets the velocities of all particles to 0.
    pub fn halt(&mut self) {
        let count = self.particles.len();
        let affine = self.particles.affine.len();
        self.particles.velocity = std::iter::repeat_n(Vector::zeros(), count).collect();
        self.particles.affine = std::iter::repeat_n(Matrix::zeros(), affine).collect();
    }

    /// The distance of the body from equilibrium in its present state.
    ///
    /// # Errors
    /// A particle, or a piece of a face, is outside the grid; a particle has no stress.
    pub fn out_of_balance(&mut self) -> Result<Residual, Failure> {
        let force = self.forces(Forces::Free)?;
        let internal = self.forces(Forces::OfStress)?;
        Ok(Residual::of(force, internal, self.rounding()))
    }

    /// The norm of the forces due to one rounding of H of each particle, and of x if weights depend on it.
    fn rounding(&self) -> f64 {
        let particles = &self.particles;
        let mut speeds = vec![T::zero(); particles.len()];
        self.field.wave_speed(&particles.reference_position, &mut speeds);
        let edge = self.grid.lattice.cell_size.min().to_f64();
        let gradients = particles.displacement_gradient.iter();
        let square = |(p, h): (usize, Matrix<T, D>)| {
            // m c0^2 = V0 (lambda + 2 mu)
            let stiffness = particles.mass[p].to_f64() * speeds[p].to_f64().powi(2);
            let position = particles.position(p).map(Real::to_f64).norm() / edge;
            let weights = if self.formulation.moves { 1.0 + position } else { 1.0 };
            (stiffness * h.map(Real::to_f64).norm() / edge * weights).powi(2)
        };
        T::default_epsilon().to_f64() * gradients.enumerate().map(square).sum::<f64>().sqrt()
    }
}

/// The norm of the vectors of some nodes.
pub(super) fn norm<T: Real, const D: usize>(nodes: &[Nodal<T>]) -> f64 {
    let square = |node: &Nodal<T>| node.vector::<D>().map(Real::to_f64).norm_squared();
    nodes.iter().map(square).sum::<f64>().sqrt()
}
