//! Rings and sectors of rings in the first two coordinates, centred at the origin.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{Filling, Piece};
use crate::defect::{Defect, on};
use crate::field::Face;
use crate::real::{Matrix, Real, Vector};

/// inner < R < outer, and angles between theta.
pub struct Sector {
    /// The inner radius.
    pub inner: f64,
    /// The outer radius.
    pub outer: f64,
    /// The first and the last angle.
    pub theta: [f64; 2],
}

/// The unit vectors along the radius and along the angle; further components are 0.
fn basis<const D: usize>(angle: f64) -> [Vector<f64, D>; 2] {
    let (sine, cosine) = angle.sin_cos();
    let vector = |x: f64, y: f64| Vector::from_fn(|a, _| [x, y, 0.0][a.min(2)]);
    [vector(cosine, sine), vector(-sine, cosine)]
}

impl Sector {
    /// Between two radii, and two angles.
    pub fn new<T: Real>([inner, outer]: [T; 2], theta: [T; 2]) -> Self {
        Self { inner: inner.to_f64(), outer: outer.to_f64(), theta: theta.map(Real::to_f64) }
    }

    /// Lower and upper corner of the smallest box around it.
    pub fn bounding_box<const D: usize>(&self) -> [Vector<f64, D>; 2] {
        let [first, last] = self.theta;
        let quarters = (first / FRAC_PI_2).ceil() as i64..=(last / FRAC_PI_2).floor() as i64;
        let angles = quarters.map(|k| k as f64 * FRAC_PI_2).chain(self.theta);
        let mut corners = [f64::INFINITY, f64::NEG_INFINITY].map(Vector::<f64, D>::repeat);
        for angle in angles {
            let [radial, _] = basis::<D>(angle);
            for point in [radial * self.inner, radial * self.outer] {
                // Round-off of a sine must not put a corner beside a knot.
                let point = point.map(|x| if x.abs() < 1e-12 * self.outer { 0.0 } else { x });
                corners = [corners[0].inf(&point), corners[1].sup(&point)];
            }
        }
        corners
    }

    /// Whether it has no first and last angle: it is a whole ring, but for the round-off of single precision.
    pub fn is_ring(&self) -> bool {
        self.theta[1] - self.theta[0] > TAU * (1.0 - 1e-6)
    }

    /// Boxes of one size whose middles lie inside.
    pub fn fill_cartesian<const D: usize>(&self, spacing: &Vector<f64, D>) -> Filling<D> {
        let mut filling = Filling::default();
        let half = spacing / 2.0;
        let [lower, upper] = self.bounding_box::<D>();
        let count = |a: usize| ((upper[a] - lower[a]) / spacing[a]).ceil() as usize + 1;
        for k in 0..count(0) * count(1) {
            let index = [k % count(0), k / count(0)];
            let middle = Vector::from_fn(|a, _| lower[a] + (2 * index[a] + 1) as f64 * half[a]);
            if self.contains(&middle) {
                filling.position.push(middle);
                filling.volume.push(spacing.iter().product());
                filling.half_edges.push(Matrix::from_diagonal(&half));
            }
        }
        filling
    }

    fn contains<const D: usize>(&self, point: &Vector<f64, D>) -> bool {
        let (radius, angle) = (point[0].hypot(point[1]), point[1].atan2(point[0]));
        let turned = self.theta[0] + (angle - self.theta[0]).rem_euclid(TAU);
        (self.inner..=self.outer).contains(&radius) && (self.is_ring() || turned <= self.theta[1])
    }

    /// Rings of equal thickness, all divided by the same rays.
    pub fn fill_fitted<const D: usize>(&self, spacing: &Vector<f64, D>) -> Filling<D> {
        let [first, last] = self.theta;
        let thickness = self.outer - self.inner;
        let middle_circle = (self.inner + self.outer) / 2.0 * (last - first);
        let rings = (thickness / spacing[0]).round().max(1.0) as usize;
        let rays = (middle_circle / spacing[1]).round().max(1.0) as usize;
        let (step, turn) = (thickness / rings as f64, (last - first) / rays as f64);
        let mut filling = Filling::default();
        for k in 0..rings * rays {
            let (ring, ray) = (k % rings, k / rings);
            let radius = self.inner + (ring as f64 + 0.5) * step;
            let angle = first + (ray as f64 + 0.5) * turn;
            let [radial, around] = basis::<D>(angle);
            let mut half_edges = Matrix::<f64, D>::zeros();
            half_edges.set_column(0, &(radial * (step / 2.0)));
            half_edges.set_column(1, &(around * (radius * turn / 2.0)));
            filling.position.push(radial * radius);
            let middle = (self.inner + self.outer) / 2.0;
            let arm = if on(Defect::RingVolumes) { middle } else { radius };
            filling.volume.push(arm * turn * step);
            filling.half_edges.push(half_edges);
            let mut piece = |face: Face, position: Vector<f64, D>, area: Vector<f64, D>| {
                filling.pieces.push(Piece { face, particle: k, position, area });
            };
            if ring == 0 {
                piece(Face::Inner, radial * self.inner, -radial * (self.inner * turn));
            }
            if ring + 1 == rings {
                piece(Face::Outer, radial * self.outer, radial * (self.outer * turn));
            }
            if ray == 0 && !self.is_ring() {
                let [radial, around] = basis::<D>(first);
                piece(Face::ThetaMin, radial * radius, -around * step);
            }
            if ray + 1 == rays && !self.is_ring() {
                let [radial, around] = basis::<D>(last);
                piece(Face::ThetaMax, radial * radius, around * step);
            }
        }
        filling
    }
}
