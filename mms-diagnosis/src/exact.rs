//! The exact solution, its law, and its moduli.

use std::sync::Arc;

use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::{Domain, Fill, ManufacturedField, Matrix, Vector};

use crate::follow::{Follow, Unfollowed};
use crate::law::{LAWS, PublishedLaw, moduli};
use crate::revolved::Revolved;

/// A quantity of the motion that solvers write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// u.
    Displacement,
    /// v.
    Velocity,
    /// H.
    DisplacementGradient,
}

impl Quantity {
    /// The identifier of the quantity.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Displacement => "displacement",
            Quantity::Velocity => "velocity",
            Quantity::DisplacementGradient => "displacement_gradient",
        }
    }

    /// The number of components at a point.
    pub fn components(self, dimension: usize) -> usize {
        match self {
            Quantity::Displacement | Quantity::Velocity => dimension,
            Quantity::DisplacementGradient => dimension * dimension,
        }
    }
}

/// The moduli of the law, as far as they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Moduli {
    /// The moduli are the same everywhere.
    Uniform([f64; 2]),
    /// The moduli depend on X.
    Graded,
    /// The law has no lambda and mu at rest: it is anisotropic, or has a stress there.
    None,
}

/// The parameters of a material.
pub trait Parameters<const D: usize>: Sync {
    /// The names of the parameters.
    fn names(&self) -> &[String];

    /// A field with the same motion, whose material has one parameter times a factor; `None` if there is no such field.
    fn times(&self, parameter: usize, factor: f64) -> Option<Arc<dyn ManufacturedField<f64, D>>>;
}

/// A field, with the data of a solver that computes it.
pub struct Exact<'a, const D: usize> {
    /// The field.
    pub field: &'a dyn ManufacturedField<f64, D>,
    /// The body, time window and conditions of the field.
    pub domain: Domain<f64, D>,
    /// The time step of the solver, possibly estimated.
    pub time_step: f64,
    /// h of the solver.
    pub cell_size: f64,
    /// The published law that is the law of the field.
    pub law: Option<&'static PublishedLaw>,
    /// The parameters of the material, if they are known.
    pub parameters: Option<&'a dyn Parameters<D>>,
    /// The field in space, if it is axisymmetric.
    pub space: Option<&'a Exact<'a, 3>>,
    /// The follower of what is done with the field.
    pub follow: &'a dyn Follow,
    moduli: Moduli,
    /// Whether strains have no shears along the hoop: this is an axisymmetric field in space.
    is_revolved: bool,
}

/// Displacement gradients that distinguish the laws, and one at which all laws agree.
fn trials<const D: usize>() -> [Matrix<f64, D>; 4] {
    let angle = |k: usize, i: usize, j: usize| {
        (1.0 + 2.3 * k as f64 + 1.7 * i as f64 + 0.9 * j as f64).sin()
    };
    std::array::from_fn(|k| Matrix::from_fn(|i, j| 0.15 * angle(k, i, j)))
}

/// The strain at which a law is taken as linear.
const SMALL: f64 = 1e-6;
/// The largest relative difference of values that counts as rounding.
const SAME: f64 = 1e-9;
/// Parts of the time window at which a field is tested for motion.
const TRIED: [f64; 4] = [0.0, 0.31, 0.67, 1.0];
/// The step of differences in time, relative to the time window.
const STEP: f64 = 1e-5;
/// The largest relative difference between a law taken as linear and its stresses.
const LINEAR: f64 = 1e-4;

impl<'a, const D: usize> Exact<'a, D> {
    /// The exact solution of a field, for a solver with this h and time step.
    pub fn new(field: &'a dyn ManufacturedField<f64, D>, cell_size: f64, time_step: f64) -> Self {
        Self::of(field, cell_size, time_step, false)
    }

    fn of(
        field: &'a dyn ManufacturedField<f64, D>,
        cell_size: f64,
        time_step: f64,
        is_revolved: bool,
    ) -> Self {
        let domain = field.domain();
        let mut exact = Exact {
            field,
            domain,
            time_step,
            cell_size,
            law: None,
            parameters: None,
            space: None,
            follow: &Unfollowed,
            moduli: Moduli::None,
            is_revolved,
        };
        let places = exact.places();
        exact.law = LAWS.iter().find(|law| {
            let fits = |x: &Vector<f64, D>| {
                let found = moduli(law, &exact.samples(x, &exact.trials()));
                found.is_some_and(|(_, missed)| missed < SAME)
            };
            places.iter().all(fits)
        });
        let found: Option<Vec<_>> = places.iter().map(|x| exact.fitted(x)).collect();
        exact.moduli = match found.as_deref() {
            None | Some([]) => Moduli::None,
            Some([first, others @ ..]) => {
                let near = |a: f64, b: f64| (a - b).abs() <= LINEAR * a.abs().max(b.abs());
                let alike = |it: &[f64; 2]| near(it[0], first[0]) && near(it[1], first[1]);
                if others.iter().all(alike) { Moduli::Uniform(*first) } else { Moduli::Graded }
            }
        };
        exact
    }

    /// Displacement gradients that the field can have, and that distinguish the laws.
    fn trials(&self) -> [Matrix<f64, D>; 4] {
        let is_shear = |i: usize, j: usize| self.is_revolved && (i == 2) != (j == 2);
        let held = |h: Matrix<f64, D>| {
            Matrix::from_fn(|i, j| if is_shear(i, j) { 0.0 } else { h[(i, j)] })
        };
        trials().map(held)
    }

    /// Whether the body reaches the axis.
    pub fn starts_at_axis(&self) -> bool {
        bounding_box(&self.domain.body).is_ok_and(|[lower, _]| lower[0] == 0.0)
    }

    /// Whether nothing moves: v and a are 0 at all times.
    pub fn is_at_rest(&self) -> bool {
        let (places, [start, end]) = (self.places(), self.domain.time);
        let is_zero = |time: f64| {
            let moves = [self.velocity(time, &places), self.acceleration(time, &places)];
            moves.iter().flatten().all(|it| it.norm() == 0.0)
        };
        TRIED.iter().all(|part| is_zero(start + part * (end - start)))
    }

    /// The longest edge of the box around the body.
    pub fn length(&self) -> f64 {
        let edges = bounding_box(&self.domain.body).map(|[lower, upper]| upper - lower);
        edges.map_or(1.0, |edges| edges.max())
    }

    /// The largest wave speed at a few points.
    pub fn wave_speed(&self) -> f64 {
        let places = self.places();
        let mut speeds = vec![0.0; places.len()];
        self.field.wave_speed(&places, &mut speeds);
        speeds.into_iter().fold(f64::MIN_POSITIVE, f64::max)
    }

    /// rho0, where it is the same everywhere.
    pub fn uniform_density(&self) -> Option<f64> {
        let density = self.density(&self.places());
        let first = *density.first()?;
        density.iter().all(|it| (it - first).abs() <= SAME * first).then_some(first)
    }

    /// Some points of the body.
    pub fn places(&self) -> Vec<Vector<f64, D>> {
        let Ok([lower, upper]) = bounding_box(&self.domain.body) else { return Vec::new() };
        let spacing = (upper - lower) / 3.0;
        let filling = Filling::new(&self.domain.body, Fill::Fitted, &spacing);
        filling.map_or(Vec::new(), |it| it.position.into_iter().step_by(2).take(5).collect())
    }

    fn samples(
        &self,
        x: &Vector<f64, D>,
        gradients: &[Matrix<f64, D>],
    ) -> Vec<(Matrix<f64, D>, Matrix<f64, D>)> {
        let stress = self.stress(self.domain.time[0], &vec![*x; gradients.len()], gradients);
        gradients.iter().copied().zip(stress).collect()
    }

    /// lambda and mu at X: of the law if it is known, otherwise at small strains.
    fn fitted(&self, x: &Vector<f64, D>) -> Option<[f64; 2]> {
        let (law, gradients, most) = match self.law {
            Some(law) => (law, self.trials(), SAME),
            None => (&LAWS[LAWS.len() - 1], self.trials().map(|h| h * SMALL), LINEAR),
        };
        let (found, missed) = moduli(law, &self.samples(x, &gradients))?;
        (missed < most && found.iter().all(|it| it.is_finite())).then_some(found)
    }

    /// lambda and mu at rest at each X; `None` where the law has none.
    pub fn moduli(&self, reference: &[Vector<f64, D>]) -> Option<Vec<[f64; 2]>> {
        match self.moduli {
            Moduli::None => None,
            Moduli::Uniform(moduli) => Some(vec![moduli; reference.len()]),
            Moduli::Graded => reference.iter().map(|x| self.fitted(x)).collect(),
        }
    }

    /// lambda and mu at rest, where they are the same everywhere.
    pub fn uniform_moduli(&self) -> Option<[f64; 2]> {
        if let Moduli::Uniform(moduli) = self.moduli { Some(moduli) } else { None }
    }

    /// P F^T for H at X and a time: tau, except for small-strain laws.
    pub fn stress(
        &self,
        time: f64,
        x: &[Vector<f64, D>],
        h: &[Matrix<f64, D>],
    ) -> Vec<Matrix<f64, D>> {
        let mut stress = vec![Matrix::zeros(); h.len()];
        self.field.kirchhoff_stress(time, x, h, &mut stress);
        stress
    }

    /// u.
    pub fn displacement(&self, time: f64, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let mut values = vec![Vector::zeros(); x.len()];
        self.field.displacement(time, x, &mut values);
        values
    }

    /// v.
    pub fn velocity(&self, time: f64, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let mut values = vec![Vector::zeros(); x.len()];
        self.field.velocity(time, x, &mut values);
        values
    }

    /// a.
    pub fn acceleration(&self, time: f64, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let mut values = vec![Vector::zeros(); x.len()];
        self.field.acceleration(time, x, &mut values);
        values
    }

    /// b.
    pub fn body_force(&self, time: f64, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let mut values = vec![Vector::zeros(); x.len()];
        self.field.body_force(time, x, &mut values);
        values
    }

    /// H.
    pub fn gradient(&self, time: f64, x: &[Vector<f64, D>]) -> Vec<Matrix<f64, D>> {
        let mut values = vec![Matrix::zeros(); x.len()];
        self.field.displacement_gradient(time, x, &mut values);
        values
    }

    /// The rate of H, by central differences.
    pub fn gradient_rate(&self, time: f64, x: &[Vector<f64, D>]) -> Vec<Matrix<f64, D>> {
        let step = STEP * (self.domain.time[1] - self.domain.time[0]);
        let [before, after] = [-step, step].map(|step| self.gradient(time + step, x));
        after.iter().zip(before).map(|(after, before)| (after - before) / (2.0 * step)).collect()
    }

    /// rho0.
    pub fn density(&self, x: &[Vector<f64, D>]) -> Vec<f64> {
        let mut density = vec![0.0; x.len()];
        self.field.density(x, &mut density);
        density
    }

    /// A quantity, point by point, tensors by rows.
    pub fn values(&self, quantity: Quantity, time: f64, x: &[Vector<f64, D>]) -> Vec<f64> {
        match quantity {
            Quantity::Displacement => numbers(&self.displacement(time, x)),
            Quantity::Velocity => numbers(&self.velocity(time, x)),
            Quantity::DisplacementGradient => {
                let rows = self.gradient(time, x);
                rows.iter().flat_map(|h| h.transpose().as_slice().to_vec()).collect()
            }
        }
    }
}

impl<'a> Exact<'a, 3> {
    /// The exact solution of an axisymmetric field in space, in the components R, Z and theta.
    pub fn in_space<const D: usize>(
        field: &'a Revolved<'a, D>,
        cell_size: f64,
        time_step: f64,
    ) -> Self {
        Self::of(field, cell_size, time_step, true)
    }
}

/// The components of vectors, one after the other.
pub fn numbers<const D: usize>(vectors: &[Vector<f64, D>]) -> Vec<f64> {
    vectors.iter().flat_map(|vector| vector.iter().copied()).collect()
}

/// Vectors from a flat list of their components.
pub fn vectors<const D: usize>(numbers: &[f64]) -> Vec<Vector<f64, D>> {
    numbers.chunks_exact(D).map(Vector::from_column_slice).collect()
}
