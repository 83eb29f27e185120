//! An estimate of the memory of a run, which is refused before its particles or nodes are allocated. The command sets the bound
//! to the free memory.

use crate::column::PACK;
use crate::column::{Matrices, Vectors};
use crate::failure::Refusal;
use crate::nodal::Nodal;
use crate::real::{Matrix, Real, Vector};

/// The number of bytes of a particle and of a node, and the available bytes.
pub(super) struct Need {
    particle: usize,
    node: usize,
    available: Option<u64>,
}

impl Need {
    /// Estimates the memory of this scene; `domain` is the number of bytes of a pack's domains.
    pub fn new<T: Real, const D: usize>(domain: usize, available: Option<u64>) -> Self {
        let (number, vector) = (size_of::<T>(), size_of::<Vector<T, D>>());
        let matrix = size_of::<Matrix<T, D>>();
        // Id, X, d, v, H, C, m, V0 and the domain. d, v, H and C of a pack are padded.
        let pack = 2 * size_of::<Vectors<T, D>>() + 2 * size_of::<Matrices<T, D>>();
        let pack = (pack + domain) / PACK;
        // Some integrators keep d and H of the beginning of a step. Sorting needs three numbers more.
        let kept = (size_of::<Vectors<T, D>>() + size_of::<Matrices<T, D>>()) / PACK;
        let state = 4 * size_of::<u32>() + vector + pack + kept + 2 * number;
        // Measurements need vectors, tensors and a number; filling a body needs X, V0 and half edges.
        let measured = 3 * vector + 3 * matrix + number;
        let filling = size_of::<f64>() * (D + 1 + D * D);
        Self {
            particle: state + measured + filling,
            // Momentum, force, velocity and acceleration, and the number of particles.
            node: 4 * size_of::<Nodal<T>>() + size_of::<u32>(),
            available,
        }
    }

    /// Refuses scenes that need more memory than is available.
    ///
    /// # Errors
    /// The particles and nodes need too much memory.
    pub fn check(&self, particles: f64, nodes: f64) -> Result<(), Refusal> {
        let needed = particles * self.particle as f64 + nodes * self.node as f64;
        match self.available {
            Some(available) if needed > available as f64 => Err(Refusal::TooLittleMemory {
                needed: (needed / 1e6) as u64,
                available: available / 1_000_000,
            }),
            _ => Ok(()),
        }
    }
}
