//! What a [`Transfer`] keeps beside the velocity of particles, and how they take the grid's.

use crate::boundary::Boundary;
use crate::grid::divide_by_mass;
use crate::particle::Particles;
use crate::stencil::Stencil;
use crate::{Grid, Lattice, Matrix, Real, Transfer, Vector, mapping};

/// A transfer with its memory; what a transfer does not need is empty.
pub(super) struct Exchange<T, const D: usize> {
    transfer: Transfer,
    /// The degree of the shape functions.
    degree: usize,
    /// APIC: C of every particle,
    affine: Vec<Matrix<T, D>>,
    /// and where it was when its weights were taken.
    position: Vec<Vector<T, D>>,
    /// XPIC: (I - S S+)^m v of every particle,
    residual: Vec<Vector<T, D>>,
    /// and its image on the grid.
    nodal: Vec<Vector<T, D>>,
    image: Vec<Vector<T, D>>,
}

impl<T: Real, const D: usize> Exchange<T, D> {
    /// For so many particles, which start with C = 0: the first map loses what is of second order in h.
    pub fn new(transfer: Transfer, particles: usize, lattice: &Lattice<T, D>) -> Self {
        let (apic, xpic) = match transfer {
            Transfer::Apic => (particles, 0),
            Transfer::Xpic { .. } => (0, particles),
            Transfer::Flip { .. } | Transfer::Pic => (0, 0),
        };
        let nodes = if xpic > 0 { lattice.len() } else { 0 };
        Self {
            transfer,
            degree: lattice.degree,
            affine: vec![Matrix::zeros(); apic],
            position: vec![Vector::zeros(); apic],
            residual: vec![Vector::zeros(); xpic],
            nodal: vec![Vector::zeros(); nodes],
            image: vec![Vector::zeros(); nodes],
        }
    }

    /// Adds to the grid's momentum what particles carry beside v. `place` says where they are.
    pub fn map_momentum(
        &mut self,
        stencils: &[impl Stencil<T, D>],
        particles: &Particles<T, D>,
        place: impl Fn(usize) -> Vector<T, D>,
        grid: &mut Grid<T, D>,
    ) {
        if self.affine.is_empty() {
            return;
        }
        self.position.iter_mut().enumerate().for_each(|(p, position)| *position = place(p));
        let (affine, position) = (&self.affine, &self.position);
        let Grid { lattice, momentum, .. } = grid;
        mapping::affine_momentum(stencils, &particles.mass, affine, position, lattice, momentum);
    }

    /// What the grid does not represent of the velocities, of which it now has the map.
    pub fn find_residual(
        &mut self,
        stencils: &[impl Stencil<T, D>],
        particles: &Particles<T, D>,
        boundary: &mut Boundary<T, D>,
        grid: &Grid<T, D>,
    ) {
        let Transfer::Xpic { order } = self.transfer else { return };
        for ((residual, stencil), v) in
            self.residual.iter_mut().zip(stencils).zip(&particles.velocity)
        {
            *residual = v - stencil.interpolate(&grid.velocity);
        }
        for _ in 1..order {
            self.nodal.fill(Vector::zeros());
            let (mass, nodal) = (&particles.mass, &mut self.nodal);
            mapping::weighted_by_mass(stencils, mass, &self.residual, nodal);
            boundary.fold(nodal);
            divide_by_mass(nodal, &grid.mass, grid.mass_floor, &mut self.image);
            boundary.residual(&mut self.image);
            for (residual, stencil) in self.residual.iter_mut().zip(stencils) {
                *residual -= stencil.interpolate(&self.image);
            }
        }
    }

    /// The particles' velocities from the grid's velocity and acceleration, after a kick.
    pub fn update_velocity(
        &mut self,
        stencils: &[impl Stencil<T, D>],
        particles: &mut Particles<T, D>,
        grid: &Grid<T, D>,
        kick: T,
    ) {
        let Grid { lattice, velocity: nodal, acceleration, .. } = grid;
        let velocities = particles.velocity.iter_mut().zip(stencils);
        match self.transfer {
            Transfer::Flip { fraction: 1.0 } => {
                velocities.for_each(|(v, s)| *v += s.interpolate(acceleration) * kick);
            }
            Transfer::Flip { fraction } => {
                let (kept, rest) = (T::of(fraction), T::of(1.0 - fraction));
                velocities.for_each(|(v, s)| {
                    let kicked = *v + s.interpolate(acceleration) * kick;
                    *v = kicked * kept + s.interpolate(nodal) * rest;
                });
            }
            Transfer::Pic => velocities.for_each(|(v, s)| *v = s.interpolate(nodal)),
            Transfer::Apic => {
                for (p, (v, s)) in velocities.enumerate() {
                    *v = s.interpolate(nodal);
                    let affine = (self.degree > 1)
                        .then(|| mapping::affine(s, &self.position[p], lattice, nodal));
                    self.affine[p] =
                        affine.flatten().unwrap_or_else(|| mapping::gradient(s, nodal));
                }
            }
            Transfer::Xpic { .. } => {
                for ((v, s), residual) in velocities.zip(&self.residual) {
                    *v += s.interpolate(acceleration) * kick - residual;
                }
            }
        }
    }
}
