//! The faces of a body: which points are on them, how far other points are from them, and their normals.

pub use mms_runtime::body::faces;
use mms_runtime::body::round::Block;
use mms_runtime::body::{block, bounding_box};
use mms_runtime::boundary::surface::Surface;
use mms_runtime::math::coordinates::System;
use mms_runtime::math::polygon;
use mms_runtime::{Body, Face, Vector};

/// Whether a point of the boundary is on a face, to within 1/1000 of the body's size.
pub fn is_on<const D: usize>(body: &Body<f64, D>, face: Face, x: &Vector<f64, D>) -> bool {
    match (body, face) {
        (Body::Box { lower, upper }, Face::Min(axis) | Face::Max(axis)) => {
            let place = if face == Face::Min(axis) { lower[axis] } else { upper[axis] };
            (x[axis] - place).abs() < 1e-3 * (upper[axis] - lower[axis])
        }
        (Body::Polygon { vertices, .. }, Face::Edge(first, _)) => {
            let [lower, upper] = bounds(body);
            let edge = polygon::edge(vertices, first);
            polygon::nearest(edge, [x[0], x[1]]).1 < 1e-3 * (upper - lower).amax()
        }
        (body, face) => {
            let Some(block) = block(body) else { return false };
            let (axis, is_upper) = Block::end(face);
            let [from, to] = block.bounds[axis];
            let bound = if is_upper { to } else { from };
            let away = block.system.local(padded(x))[axis] - bound;
            let turn = std::f64::consts::TAU;
            let away = match axis {
                1 => away.rem_euclid(turn).min(turn - away.rem_euclid(turn)),
                _ => away.abs(),
            };
            away < 1e-3 * (to - from)
        }
    }
}

/// X with three components.
pub fn padded<const D: usize>(x: &Vector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|axis| if axis < D { x[axis] } else { 0.0 })
}

/// The corners of the box around a body; two origins if the body has no box.
pub fn bounds<const D: usize>(body: &Body<f64, D>) -> [Vector<f64, D>; 2] {
    bounding_box(body).unwrap_or_else(|_| [Vector::zeros(); 2])
}

/// The distance of X from a face, relative to the size of the body.
pub fn away<const D: usize>(body: &Body<f64, D>, face: Face, x: &Vector<f64, D>) -> f64 {
    match (body, face) {
        (Body::Box { lower, upper }, Face::Min(axis)) => {
            (x[axis] - lower[axis]) / (upper[axis] - lower[axis])
        }
        (Body::Box { lower, upper }, Face::Max(axis)) => {
            (upper[axis] - x[axis]) / (upper[axis] - lower[axis])
        }
        (Body::Polygon { vertices, .. }, Face::Edge(first, _)) => {
            let [lower, upper] = bounds(body);
            polygon::nearest(polygon::edge(vertices, first), [x[0], x[1]]).1
                / (upper - lower).amax()
        }
        (body, face) => {
            let Some(block) = block(body) else { return 1.0 };
            let (axis, is_upper) = Block::end(face);
            let [from, to] = block.bounds[axis];
            let bound = if is_upper { to } else { from };
            let (sine, cosine) = bound.sin_cos();
            let outer = block.bounds[0][1];
            let [radius, _, third] = block.system.local(padded(x));
            match (axis, block.system) {
                (1, _) => (x[1] * cosine - x[0] * sine).abs() / outer,
                (2, System::Spherical) => radius * (third - bound).sin().abs() / outer,
                (2, _) => (third - bound).abs() / (to - from),
                _ => (radius - bound).abs() / (to - from),
            }
        }
    }
}

/// The outward normal N at X on a face.
pub fn normal<const D: usize>(
    body: &Body<f64, D>,
    face: Face,
    x: &Vector<f64, D>,
) -> Vector<f64, D> {
    Surface::new(body, face).foot(x)[1]
}
