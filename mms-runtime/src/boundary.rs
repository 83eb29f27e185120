//! Boundary conditions: what the solver imposes on the grid's nodes at the body's faces.
//!
//! | claim on a face | the solver |
//! |---|---|
//! | `fixed` (u = 0) | on a box a wall at rest on a plane of nodes, by images: all components reflected ([`wall`]) |
//! | `roller` (u.N = 0, no tangential traction) | the same, the normal component reflected; boxes only |
//! | `free` (P N = 0) | does nothing |
//! | `prescribed`, no claim, or `fixed` on a curved face | nodes follow the field ([`prescribed`]) |
//! | `traction` | the field's stress on the pieces of the face ([`traction`]) |
//! | none, with `--periodic` | nodes a period apart are one ([`period`]) |

mod images;
pub mod period;
pub mod prescribed;
pub mod surface;
pub mod traction;
pub mod wall;

use crate::body::{Fill, Filling, Piece, faces};
use crate::defect::{Defect, on};
use crate::failure::{Failure, Refusal};
use crate::field::{Body, Condition, Domain, Face, ManufacturedField};
use crate::grid::Grid;
use crate::lattice::Lattice;
use crate::nodal::Nodal;
use crate::real::{Real, Vector};
use period::Period;
use prescribed::Prescribed;
use surface::Surface;
use traction::{FacePoint, Traction, TractionPoint};
use wall::Wall;

/// The boundary conditions of a scene. A condition that the scene does not have is empty, and costs nothing.
pub struct Boundary<T, const D: usize> {
    periods: Vec<Period>,
    walls: Vec<Wall>,
    prescribed: Prescribed<T, D>,
    traction: Traction<T, D>,
}

/// Whether a face is a wall: a face of a box that rests on a plane of nodes.
pub(crate) fn is_wall<T, const D: usize>(domain: &Domain<T, D>, face: Face) -> bool {
    let rests = matches!(domain.condition(face), Condition::Fixed | Condition::Roller);
    rests && matches!(domain.body, Body::Box { .. })
}

impl<T: Real, const D: usize> Boundary<T, D> {
    /// The conditions of a body on a grid; `moves` tells whether the body moves through it.
    ///
    /// # Errors
    /// A condition that cannot be met on this grid, or a claim about a face that the body lacks.
    pub fn new(
        domain: &Domain<T, D>,
        lattice: &Lattice<T, D>,
        pieces: &[Piece<D>],
        moves: bool,
    ) -> Result<Self, Refusal> {
        let faces = faces(&domain.body);
        if let Some(&(face, _)) = domain.faces.iter().find(|(face, _)| !faces.contains(face)) {
            return Err(Refusal::NoSuchFace { face, dimension: D });
        }
        let mut boundary = Self {
            periods: (0..D).filter_map(|axis| Period::new(lattice, axis)).collect(),
            walls: Vec::new(),
            prescribed: Prescribed::new(moves),
            traction: Traction::none(),
        };
        for face in faces {
            if matches!(face, Face::Min(a) | Face::Max(a) if lattice.period[a].is_some()) {
                continue;
            }
            let condition = domain.condition(face);
            match condition {
                Condition::Free => {}
                Condition::Fixed | Condition::Roller if is_wall(domain, face) => {
                    boundary.walls.push(Wall::new(lattice, face, condition)?);
                }
                Condition::Fixed | Condition::Prescribed => {
                    let surface = Surface::new(&domain.body, face);
                    let at_rest = condition == Condition::Fixed;
                    let cell_size = lattice.cell_size.map(Real::to_f64);
                    let cells = Filling::new(&domain.body, Fill::Fitted, &cell_size)?;
                    let samples = cells.pieces.iter().filter(|piece| piece.face == face);
                    let samples = samples.map(|piece| piece.position.map(T::of));
                    boundary.prescribed.add_face(surface, at_rest, samples, lattice);
                }
                Condition::Roller => {
                    return Err(Refusal::UnsupportedCondition { face, condition });
                }
                Condition::Traction => boundary.traction.add_face(face, pieces)?,
            }
        }
        Ok(boundary)
    }

    /// Finds how far beyond its faces the body adds mass to nodes. To be called before masses are folded.
    pub fn reach(&mut self, momentum: &[Nodal<T>]) {
        self.periods.iter_mut().for_each(|period| period.reach(momentum));
        self.walls.iter_mut().for_each(|wall| wall.reach(momentum));
    }

    /// Adds the images' mass and momentum, or force, to the nodes inside.
    pub fn fold(&self, extensive: &mut [Nodal<T>]) {
        self.periods.iter().for_each(|period| period.fold(extensive));
        self.walls.iter().for_each(|wall| wall.fold(extensive));
    }

    /// Finds the nodes that follow the field, and their reference positions at `time`.
    ///
    /// # Errors
    /// The motion cannot be inverted at a node.
    pub fn locate<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.prescribed.locate(field, time, grid)
    }

    /// Adds this `share` of the field's tractions at `time` to the nodes. `place` computes where the piece of a face at X that
    /// a particle carries is, and `point` the nodes of a place.
    ///
    /// # Errors
    /// A piece is off the grid, or the field's F is singular there.
    pub fn traction<F>(
        &mut self,
        field: &F,
        time: T,
        point: TractionPoint<'_, T, D>,
        place: impl Fn(usize, &Vector<T, D>) -> FacePoint<T, D>,
        share: T,
        extensive: &mut [Nodal<T>],
    ) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.traction.apply(field, time, point, place, share, extensive)
    }

    /// Imposes the velocity at `time`.
    pub fn velocity<F>(&mut self, field: &F, time: T, velocity: &mut [Nodal<T>])
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.prescribed.impose(velocity, |reference, out| field.velocity(time, reference, out));
        self.mirror(velocity);
    }

    /// Imposes the acceleration at `time`.
    pub fn acceleration<F>(&mut self, field: &F, time: T, acceleration: &mut [Nodal<T>])
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.prescribed
            .impose(acceleration, |reference, out| field.acceleration(time, reference, out));
        if !on(Defect::MirrorVelocityAlone) {
            self.mirror(acceleration);
        }
    }

    /// Imposes zero on a residual velocity, for the boundary has none.
    pub fn residual(&mut self, residual: &mut [Nodal<T>]) {
        self.prescribed.impose(residual, |_, out| out.fill(Vector::zeros()));
        self.mirror(residual);
    }

    /// Mirrors at wall after wall; at edges the last wall reads what the others have mirrored.
    fn mirror(&self, intensive: &mut [Nodal<T>]) {
        self.walls.iter().for_each(|wall| wall.mirror(intensive));
        self.periods.iter().for_each(|period| period.copy(intensive));
    }
}
