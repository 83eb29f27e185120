//! Displacements at a few times, to compare runs with different time steps on one grid.

use serde::{Deserialize, Serialize};

use super::Errors;
use crate::particle::Particles;
use crate::real::{Real, Vector};

/// The displacements of all particles at some times, in double precision.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshots {
    dimension: usize,
    particles: usize,
    /// By times, by the particles' numbers, by components.
    values: Vec<f64>,
}

impl Snapshots {
    /// Appends the present displacements. A solver may have changed the order of its particles.
    pub(super) fn take<T: Real, const D: usize>(&mut self, particles: &Particles<T, D>) {
        (self.dimension, self.particles) = (D, particles.len());
        let start = self.values.len();
        self.values.resize(start + D * particles.len(), 0.0);
        for (&id, d) in particles.id.iter().zip(particles.displacement.iter()) {
            let at = start + D * id as usize;
            self.values[at..at + D].copy_from_slice(d.map(Real::to_f64).as_slice());
        }
    }

    /// The distance of two runs: the largest of each norm over the times. `None` unless both have the same particles and the
    /// same number of times.
    pub fn distance(&self, other: &Self) -> Option<Errors> {
        let size = |it: &Self| (it.dimension, it.particles, it.values.len());
        if size(self) != size(other) || self.values.is_empty() {
            return None;
        }
        match self.dimension {
            1 => self.distance_in::<1>(other),
            2 => self.distance_in::<2>(other),
            _ => self.distance_in::<3>(other),
        }
    }

    fn distance_in<const D: usize>(&self, other: &Self) -> Option<Errors> {
        let vectors = |values| bytemuck::cast_slice::<f64, Vector<f64, D>>(values);
        let times = [self, other].map(|it| vectors(&it.values).chunks(it.particles));
        let [own, others] = times;
        own.zip(others).try_fold(Errors::default(), |largest, (a, b)| {
            Some(largest.larger(&Errors::of::<f64, _>(a.iter().copied(), b, None).ok()?))
        })
    }
}
