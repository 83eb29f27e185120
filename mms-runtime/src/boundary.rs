//! What holds the grid's nodes at the body's faces.
//!
//! * `fixed` and `roller`: a wall on a plane of nodes, by the method of images ([`wall`]).
//! * `free`: nothing.
//! * `prescribed`, and faces without a claim: nodes follow the field ([`prescribed`]).

pub mod prescribed;
pub mod wall;

use crate::failure::positive;
use crate::{
    Body, Condition, Domain, Face, Failure, Grid, ManufacturedField, Real, Refusal, Vector,
};
use prescribed::Prescribed;
use wall::Wall;

/// The boundary conditions of a scene.
pub struct Boundary<T, const D: usize> {
    walls: Vec<Wall>,
    prescribed: Prescribed<T, D>,
}

/// Lower and upper corner of the body in double precision, or why it cannot be used.
pub(crate) fn box_corners<T: Real, const D: usize>(
    body: &Body<T, D>,
) -> Result<[[f64; D]; 2], Refusal> {
    let Body::Box { lower, upper } = body else {
        return Err(Refusal::UnsupportedBody);
    };
    let corner = |corner: &Vector<T, D>| std::array::from_fn(|a| corner[a].to_f64());
    let corners: [[f64; D]; 2] = [corner(lower), corner(upper)];
    for (lower, upper) in corners[0].iter().zip(&corners[1]) {
        positive("an edge of the body", upper - lower)?;
    }
    Ok(corners)
}

impl<T: Real, const D: usize> Boundary<T, D> {
    /// The conditions of a box on a grid that has a node at the box's lower corner.
    pub fn new(domain: &Domain<T, D>, grid: &Grid<T, D>) -> Result<Self, Refusal> {
        let corners = box_corners(&domain.body)?;
        let exists = |face: Face| matches!(face, Face::Min(a) | Face::Max(a) if a < D);
        if let Some(&(face, _)) = domain.faces.iter().find(|(face, _)| !exists(*face)) {
            return Err(Refusal::NoSuchFace { face, dimension: D });
        }
        let mut boundary = Self { walls: Vec::new(), prescribed: Prescribed::none() };
        for (axis, (&lower, &upper)) in corners[0].iter().zip(&corners[1]).enumerate() {
            for (face, position) in [(Face::Min(axis), lower), (Face::Max(axis), upper)] {
                let condition = domain.condition(face);
                match condition {
                    Condition::Free => {}
                    Condition::Fixed | Condition::Roller => {
                        let wall = Wall::new(grid, face, condition, upper - lower)?;
                        boundary.walls.push(wall);
                    }
                    Condition::Prescribed => {
                        let is_upper = face == Face::Max(axis);
                        boundary.prescribed.add_face(grid, axis, is_upper, T::of(position));
                    }
                    Condition::Traction => {
                        return Err(Refusal::UnsupportedCondition { face, condition });
                    }
                }
            }
        }
        Ok(boundary)
    }

    /// Adds the images' mass to the nodes inside the walls.
    pub fn fold_mass(&self, mass: &mut [T]) {
        self.walls.iter().for_each(|wall| wall.fold_mass(mass));
    }

    /// Adds the images' momentum or force to the nodes inside the walls.
    pub fn fold(&self, extensive: &mut [Vector<T, D>]) {
        self.walls.iter().for_each(|wall| wall.fold(extensive));
    }

    /// Finds the nodes that follow the field, and their reference positions at `time`.
    pub fn locate<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.prescribed.locate(field, time, grid)
    }

    /// Imposes the velocity at `time`.
    pub fn velocity<F>(&mut self, field: &F, time: T, velocity: &mut [Vector<T, D>])
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.prescribed.impose(velocity, |reference, out| field.velocity(time, reference, out));
        self.mirror(velocity);
    }

    /// Imposes the acceleration at `time`.
    pub fn acceleration<F>(&mut self, field: &F, time: T, acceleration: &mut [Vector<T, D>])
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.prescribed
            .impose(acceleration, |reference, out| field.acceleration(time, reference, out));
        self.mirror(acceleration);
    }

    /// Wall after wall; at edges the last one sees what the others have mirrored.
    fn mirror(&self, intensive: &mut [Vector<T, D>]) {
        self.walls.iter().for_each(|wall| wall.mirror(intensive));
    }
}
