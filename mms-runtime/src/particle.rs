//! The particles: structure of arrays, entry `p` of every array belongs to particle `p`.

use crate::failure::at_most;
use crate::{Matrix, Real, Refusal, Vector};

/// More particles than this are refused.
const PARTICLE_LIMIT: f64 = (1u64 << 27) as f64;

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
    /// tau.
    pub kirchhoff_stress: Vec<Matrix<T, D>>,
    /// b, per unit mass.
    pub body_force: Vec<Vector<T, D>>,
    /// m.
    pub mass: Vec<T>,
    /// V0.
    pub reference_volume: Vec<T>,
    /// Half width of the reference domain along each axis.
    pub half_width: Vec<Vector<T, D>>,
}

impl<T: Real, const D: usize> Particles<T, D> {
    /// Fills a box with a Cartesian array of particles, undeformed, at rest and without mass.
    ///
    /// About `particles_per_cell` per cell along each axis: as many as make the particles' domains
    /// fill the box without gap or overlap.
    pub fn fill_box(
        lower: &[f64; D],
        upper: &[f64; D],
        cell_size: f64,
        particles_per_cell: usize,
    ) -> Result<Self, Refusal> {
        let edge = |a: usize| upper[a] - lower[a];
        let per_edge = |a: usize| edge(a) / cell_size * particles_per_cell as f64;
        let per_axis: [f64; D] = std::array::from_fn(|a| per_edge(a).round().max(1.0));
        let count = per_axis.iter().product();
        at_most("particles", count, PARTICLE_LIMIT)?;
        let half_width: [f64; D] = std::array::from_fn(|a| edge(a) / per_axis[a] / 2.0);
        let per_axis = per_axis.map(|particles| particles as usize);
        let count = per_axis.iter().product();
        let coordinate = |p: usize, a: usize| {
            let k = p / per_axis[..a].iter().product::<usize>() % per_axis[a];
            T::of(lower[a] + (2 * k + 1) as f64 * half_width[a])
        };
        Ok(Self {
            reference_position: (0..count)
                .map(|p| Vector::from_fn(|a, _| coordinate(p, a)))
                .collect(),
            displacement: vec![Vector::zeros(); count],
            velocity: vec![Vector::zeros(); count],
            displacement_gradient: vec![Matrix::zeros(); count],
            kirchhoff_stress: vec![Matrix::zeros(); count],
            body_force: vec![Vector::zeros(); count],
            mass: vec![T::zero(); count],
            reference_volume: vec![T::of(half_width.iter().map(|l| 2.0 * l).product()); count],
            half_width: vec![Vector::from_fn(|a, _| T::of(half_width[a])); count],
        })
    }

    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there is no particle; a filled box always has some.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// x = X + d of one particle.
    pub fn position(&self, particle: usize) -> Vector<T, D> {
        self.reference_position[particle] + self.displacement[particle]
    }
}
