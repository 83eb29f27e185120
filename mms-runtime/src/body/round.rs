//! Rings, cylinders and spheres around the origin, and sectors of them, cut along radius and angles.
//!
//! Layers have equal thickness. If the inner radius is positive, the same rays cut all layers around the axis, the same cones
//! cut all layers of a sphere, and each band has as many rays as its circumference needs. If the inner radius is 0, each layer
//! has as many as it needs, so that particles do not crowd about the axis or the centre.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use mms_math::coordinates::{Numbers, Side, System};

use super::{Filling, Piece};
use crate::defect::{Defect, on};
use crate::field::Face;
use crate::real::{Matrix, Vector};

/// A body between bounds of radius, angle and, in space, height or angle from the axis.
pub struct Block {
    /// The coordinates.
    pub system: System,
    /// The bounds of the coordinates, one pair per dimension.
    pub bounds: Vec<[f64; 2]>,
}

/// Single precision changes an angle by up to this.
const ROUNDING: f64 = 1e-6;

impl Block {
    /// Whether the block goes all around and so has no first and last angle theta. Allows for the round-off of single
    /// precision.
    pub fn is_ring(&self) -> bool {
        self.bounds[1][1] - self.bounds[1][0] > TAU * (1.0 - ROUNDING)
    }

    /// The faces of the block.
    pub fn faces(&self) -> Vec<Face> {
        let mut faces = Vec::new();
        faces.extend((self.bounds[0][0] > 0.0).then_some(Face::Inner));
        faces.push(Face::Outer);
        if !self.is_ring() {
            faces.extend([Face::ThetaMin, Face::ThetaMax]);
        }
        match (self.system, self.bounds.get(2)) {
            (System::Spherical, Some([first, last])) => {
                faces.extend((*first > ROUNDING).then_some(Face::PhiMin));
                faces.extend((*last < PI - ROUNDING).then_some(Face::PhiMax));
            }
            (_, Some(_)) => faces.extend([Face::Min(2), Face::Max(2)]),
            (_, None) => {}
        }
        faces
    }

    /// The coordinate that is constant on a face, and whether it is at its upper bound.
    pub fn end(face: Face) -> (usize, bool) {
        match face {
            Face::Inner => (0, false),
            Face::Outer => (0, true),
            Face::ThetaMin => (1, false),
            Face::ThetaMax => (1, true),
            Face::PhiMin => (2, false),
            Face::PhiMax => (2, true),
            Face::Min(axis) => (axis, false),
            Face::Max(axis) => (axis, true),
            Face::Edge(..) => (0, false),
        }
    }

    /// X at the given coordinates.
    pub fn place<const D: usize>(&self, at: &[f64; 3]) -> Vector<f64, D> {
        let place = self.system.position(&mut Numbers::new(), at);
        Vector::from_fn(|axis, _| place[axis])
    }

    /// The unit vectors along which the coordinates grow.
    pub fn directions<const D: usize>(&self, at: &[f64; 3]) -> [Vector<f64, D>; 3] {
        let basis = self.system.basis(&mut Numbers::new(), at);
        basis.map(|direction| Vector::from_fn(|axis, _| direction[axis]))
    }

    /// Boxes of one size whose middles lie inside.
    pub fn fill_cartesian<const D: usize>(&self, spacing: &Vector<f64, D>) -> Filling<D> {
        let [lower, upper] = self.system.bounding_box(&self.bounds);
        let corners = [lower, upper].map(|corner| Vector::from_fn(|axis, _| corner[axis]));
        super::lattice(corners, spacing, |point| self.contains(point))
    }

    fn contains<const D: usize>(&self, point: &Vector<f64, D>) -> bool {
        let padded = std::array::from_fn(|axis| if axis < D { point[axis] } else { 0.0 });
        let at = self.system.local(padded);
        let [first, last] = self.bounds[1];
        let turned = first + (at[1] - first).rem_euclid(TAU);
        let within = |axis: usize| {
            let [from, to] = self.bounds[axis];
            (from..=to).contains(&at[axis])
        };
        within(0) && (self.is_ring() || turned <= last) && (D < 3 || within(2))
    }

    /// Layers of equal thickness, cut along the angles and, for a cylinder, the height.
    pub fn fill_fitted<const D: usize>(&self, spacing: &Vector<f64, D>) -> Filling<D> {
        let [inner, outer] = self.bounds[0];
        let layers = parts(outer - inner, spacing[0], 1);
        let third: &[f64; 2] = self.bounds.get(2).unwrap_or(&[0.0; 2]);
        let depth = |a: usize| if a < D { spacing[a] } else { 1.0 };
        let mut cells = Vec::new();
        for layer in 0..layers {
            let radii = part(self.bounds[0], layer, layers);
            // The radius that determines how many parts there are.
            let arm = if inner > 0.0 { (inner + outer) / 2.0 } else { middle(radii) };
            let bands = match (self.system, D) {
                (_, 0..=2) => 1,
                (System::Spherical, _) => {
                    parts(arm * (third[1] - third[0]), depth(2), quarters(*third))
                }
                _ => parts(third[1] - third[0], depth(2), 1),
            };
            for band in 0..bands {
                let heights = part(*third, band, bands);
                let across = match self.system {
                    System::Spherical => arm * middle(heights).sin(),
                    _ => arm,
                };
                let [first, last] = self.bounds[1];
                let least = if inner > 0.0 && D < 3 { 1 } else { quarters([first, last]) };
                let rays = parts(across * (last - first), spacing[1], least);
                for ray in 0..rays {
                    let cell = [radii, part([first, last], ray, rays), heights];
                    let ends = [[layer, layers], [ray, rays], [band, bands]]
                        .map(|[at, count]| [at == 0, at + 1 == count]);
                    cells.push((ray, cell, ends));
                }
            }
        }
        if D < 3 && inner > 0.0 {
            // Along one ray after another.
            cells.sort_by_key(|(ray, ..)| *ray);
        }
        let mut filling = Filling::default();
        for (_, cell, ends) in cells {
            self.add(&mut filling, cell, ends);
        }
        filling
    }

    /// Adds a particle for a cell; `ends` tells along each coordinate whether the cell is the first and whether it is the last.
    fn add<const D: usize>(
        &self,
        filling: &mut Filling<D>,
        cell: [[f64; 2]; 3],
        ends: [[bool; 2]; 3],
    ) {
        let centre = cell.map(middle);
        let sides = cell.map(Side::Between);
        let mut volume = self.system.measure(&sides[..D]);
        let directions = self.directions::<D>(&centre);
        let scales = self.system.scales(&mut Numbers::new(), &centre);
        let mut edges: [f64; 3] =
            std::array::from_fn(|axis| (cell[axis][1] - cell[axis][0]) * scales[axis]);
        // A box as thick as the layer, and as large as the cell.
        let excess = edges[..D].iter().product::<f64>() / volume;
        let of_angles = (0..D).filter(|axis| self.system.is_angle(*axis)).count();
        for axis in (0..D).filter(|axis| self.system.is_angle(*axis)) {
            edges[axis] /= excess.powf(1.0 / of_angles as f64);
        }
        let particle = filling.position.len();
        let mut half_edges = Matrix::<f64, D>::zeros();
        // Radius, theta and phi are left-handed: the columns of a domain have theta and phi exchanged.
        let order = if self.system == System::Spherical { [0, 2, 1] } else { [0, 1, 2] };
        for (column, axis) in order.into_iter().take(D).enumerate() {
            half_edges.set_column(column, &(directions[axis] * (edges[axis] / 2.0)));
        }
        let position = self.place::<D>(&centre);
        for face in self.faces() {
            let (axis, is_upper) = Self::end(face);
            if !ends[axis][usize::from(is_upper)] {
                continue;
            }
            let bound = cell[axis][usize::from(is_upper)];
            let (mut at, mut sides) = (centre, sides);
            (at[axis], sides[axis]) = (bound, Side::At(bound));
            let sign = if is_upper { 1.0 } else { -1.0 };
            let area = sign * self.system.measure(&sides[..D]);
            let area = self.directions::<D>(&at)[axis] * area;
            filling.pieces.push(Piece { face, particle, position: self.place(&at), area });
        }
        if on(Defect::RingVolumes) {
            volume *= middle(self.bounds[0]) / centre[0];
        }
        filling.position.push(position);
        filling.volume.push(volume);
        filling.half_edges.push(half_edges);
    }
}

fn middle([from, to]: [f64; 2]) -> f64 {
    (from + to) / 2.0
}

/// The number of parts of about the length `spacing`, and at least `least`.
fn parts(length: f64, spacing: f64, least: usize) -> usize {
    (length / spacing).round().max(least as f64) as usize
}

/// Part `at` of `count` equal parts between two ends.
fn part([from, to]: [f64; 2], at: usize, count: usize) -> [f64; 2] {
    let end =
        |at: usize| if at == count { to } else { from + (to - from) * at as f64 / count as f64 };
    [end(at), end(at + 1)]
}

/// The least number of parts of an angle: a part of more than a quarter of a turn would not resemble its box.
fn quarters([first, last]: [f64; 2]) -> usize {
    ((last - first) / FRAC_PI_2 * (1.0 - ROUNDING)).ceil().max(1.0) as usize
}
