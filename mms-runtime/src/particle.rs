//! The particles: structure of arrays, entry `p` of every array belongs to particle `p`.

use crate::body::Filling;
use crate::{Matrix, Real, Vector};

/// The state of all particles.
///
/// The displacement is stored, not the position, and H, not F: so `f32` loses nothing to x - X and to
/// F - I, and X never has to be recovered.
#[derive(Clone, Debug)]
pub struct Particles<T, const D: usize> {
    /// X.
    pub reference_position: Vec<Vector<T, D>>,
    /// d = x - X.
    pub displacement: Vec<Vector<T, D>>,
    /// v.
    pub velocity: Vec<Vector<T, D>>,
    /// H = F - I.
    pub displacement_gradient: Vec<Matrix<T, D>>,
    /// tau in the updated formulation, P in the total one.
    pub stress: Vec<Matrix<T, D>>,
    /// b, per unit mass.
    pub body_force: Vec<Vector<T, D>>,
    /// m.
    pub mass: Vec<T>,
    /// V0.
    pub reference_volume: Vec<T>,
}

impl<T: Real, const D: usize> Particles<T, D> {
    /// The particles that fill a body, undeformed, at rest and without mass.
    pub fn new(filling: &Filling<D>) -> Self {
        let count = filling.len();
        Self {
            reference_position: filling.position.iter().map(|x| x.map(T::of)).collect(),
            displacement: vec![Vector::zeros(); count],
            velocity: vec![Vector::zeros(); count],
            displacement_gradient: vec![Matrix::zeros(); count],
            stress: vec![Matrix::zeros(); count],
            body_force: vec![Vector::zeros(); count],
            mass: vec![T::zero(); count],
            reference_volume: filling.volume.iter().map(|&volume| T::of(volume)).collect(),
        }
    }

    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there is no particle; a filled body always has some.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// x = X + d of one particle.
    pub fn position(&self, particle: usize) -> Vector<T, D> {
        self.reference_position[particle] + self.displacement[particle]
    }
}
