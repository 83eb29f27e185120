//! Gauss quadrature over a body and its faces.

use std::f64::consts::FRAC_PI_2;

use mms_runtime::body::round::Block;
use mms_runtime::body::{block, faces};
use mms_runtime::math::coordinates::Numbers;
use mms_runtime::math::polygon::{self, quadrilaterals};
use mms_runtime::{Body, Face, Vector};

use crate::body::padded;
use crate::smooth::legendre;

/// Points with weights over a body, and over its faces.
pub struct Quadrature<const D: usize> {
    /// X of the points in the body.
    pub points: Vec<Vector<f64, D>>,
    /// The volume weights of the points, which add up to the volume of the body.
    pub volumes: Vec<f64>,
    /// The pieces of all faces.
    pub pieces: Vec<Piece<D>>,
}

/// A point of a face.
pub struct Piece<const D: usize> {
    /// The face.
    pub face: Face,
    /// X.
    pub position: Vector<f64, D>,
    /// The area weight of the point times the outward normal.
    pub area: Vector<f64, D>,
}

impl<const D: usize> Quadrature<D> {
    /// Places `count` points along each axis of a box, along the radius and the height, in each quarter turn of an angle, and
    /// along both sides of the quadrilaterals of a polygon.
    pub fn new(body: &Body<f64, D>, count: usize) -> Self {
        let (mut points, mut volumes) = (Vec::new(), Vec::new());
        match body {
            Body::Box { lower, upper } => {
                let axes = std::array::from_fn(|axis| over([lower[axis], upper[axis]], 1, count));
                for (x, weight) in products::<D>(&axes) {
                    points.push(x);
                    volumes.push(weight);
                }
            }
            Body::Polygon { vertices, .. } => {
                for quad in quadrilaterals(vertices) {
                    let axes = std::array::from_fn(|_| over([0.0, 1.0], 1, count));
                    for (at, weight) in products::<2>(&axes) {
                        let [[a, b], [c, d]] = quad.slopes(at.into());
                        points.push(in_plane(quad.point(at.into())));
                        volumes.push(weight * (a * d - b * c).abs());
                    }
                }
            }
            body => {
                if let Some(block) = block(body) {
                    for (at, weight) in products::<D>(&axes(&block, None, count)) {
                        points.push(block.place(&padded(&at)));
                        volumes.push(weight * scales(&block, &at).product());
                    }
                }
            }
        }
        let pieces = faces(body).into_iter().flat_map(|face| on_face(body, face, count)).collect();
        Quadrature { points, volumes, pieces }
    }
}

/// The scale factors: how far X moves per unit of each coordinate.
fn scales<const D: usize>(block: &Block, at: &Vector<f64, D>) -> Vector<f64, D> {
    let scales = block.system.scales(&mut Numbers::new(), &padded(at));
    Vector::from_fn(|axis, _| scales[axis])
}

/// Points along each coordinate; one coordinate may be constant.
fn axes<const D: usize>(
    block: &Block,
    constant: Option<(usize, f64)>,
    count: usize,
) -> [Vec<(f64, f64)>; D] {
    std::array::from_fn(|axis| match constant {
        Some((own, value)) if own == axis => vec![(value, 1.0)],
        _ if block.system.is_angle(axis) => around(block.bounds[axis], count),
        _ => over(block.bounds[axis], 1, count),
    })
}

fn in_plane<const D: usize>(place: [f64; 2]) -> Vector<f64, D> {
    Vector::from_fn(|axis, _| place.get(axis).copied().unwrap_or(0.0))
}

/// The points of a face.
fn on_face<const D: usize>(body: &Body<f64, D>, face: Face, count: usize) -> Vec<Piece<D>> {
    match (body, face) {
        (Body::Box { lower, upper }, Face::Min(normal) | Face::Max(normal)) => {
            let (end, sign) = match face {
                Face::Min(_) => (lower[normal], -1.0),
                _ => (upper[normal], 1.0),
            };
            let axes = std::array::from_fn(|axis| match axis == normal {
                true => vec![(end, 1.0)],
                false => over([lower[axis], upper[axis]], 1, count),
            });
            let piece = |(position, weight): (Vector<f64, D>, f64)| {
                let area =
                    Vector::from_fn(|axis, _| if axis == normal { sign * weight } else { 0.0 });
                Piece { face, position, area }
            };
            products::<D>(&axes).into_iter().map(piece).collect()
        }
        (Body::Polygon { vertices, .. }, Face::Edge(first, _)) => {
            let [from, to] = polygon::edge(vertices, first);
            let (from, to): (Vector<f64, D>, _) = (in_plane(from), in_plane(to));
            let normal = in_plane(polygon::normal(vertices, first)) * (to - from).norm();
            let piece = |(way, weight): (f64, f64)| Piece {
                face,
                position: from + (to - from) * way,
                area: normal * weight,
            };
            over([0.0, 1.0], 1, count).into_iter().map(piece).collect()
        }
        (body, _) => {
            let Some(block) = block(body) else { return Vec::new() };
            let (own, is_upper) = Block::end(face);
            let bound = block.bounds[own][usize::from(is_upper)];
            let sign = if is_upper { 1.0 } else { -1.0 };
            let piece = |(at, weight): (Vector<f64, D>, f64)| {
                let mut lengths = scales(&block, &at);
                lengths[own] = sign;
                let direction = block.directions::<D>(&padded(&at))[own];
                let area = direction * (weight * lengths.product());
                Piece { face, position: block.place(&padded(&at)), area }
            };
            let points = products::<D>(&axes(&block, Some((own, bound)), count));
            points.into_iter().map(piece).collect()
        }
    }
}

/// Angles between two ends, with their weights.
fn around(theta: [f64; 2], count: usize) -> Vec<(f64, f64)> {
    let quarters = ((theta[1] - theta[0]) / FRAC_PI_2).ceil().max(1.0);
    over(theta, quarters as usize, count)
}

/// All combinations of places along the axes, with the products of their weights.
fn products<const D: usize>(axes: &[Vec<(f64, f64)>; D]) -> Vec<(Vector<f64, D>, f64)> {
    let mut all = vec![(Vector::zeros(), 1.0)];
    for (axis, places) in axes.iter().enumerate() {
        let each = all.iter().flat_map(|(x, weight)| {
            places.iter().map(move |(place, own)| {
                let mut x: Vector<f64, D> = *x;
                x[axis] = *place;
                (x, weight * own)
            })
        });
        all = each.collect();
    }
    all
}

/// Points with weights in `parts` intervals of equal length between two ends.
fn over([from, to]: [f64; 2], parts: usize, count: usize) -> Vec<(f64, f64)> {
    let (rule, part) = (gauss(count), (to - from) / parts as f64);
    let within = |at: usize| {
        let start = from + part * at as f64;
        rule.iter().map(move |(x, weight)| (start + part * x, part * weight))
    };
    (0..parts).flat_map(within).collect()
}

/// Gauss-Legendre points and weights on [0, 1]: the roots of a Legendre polynomial, by Newton's method.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let scale = (2.0 * count as f64 + 1.0).sqrt();
    let polynomial = |x: f64| {
        let (value, slope) = legendre(count, x)[count];
        (value / scale, slope / scale)
    };
    let root = |at: usize| {
        let turn = std::f64::consts::PI * (at as f64 + 0.75) / (count as f64 + 0.5);
        let mut x = turn.cos();
        for _ in 0..8 {
            let (value, slope) = polynomial(x);
            x -= value / slope;
        }
        ((1.0 - x) / 2.0, 1.0 / ((1.0 - x * x) * polynomial(x).1.powi(2)))
    };
    (0..count).map(root).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integrals of x^a y^b, from paper; and the theorem of Gauss for vectors (x^a y^b, 0) and (0, x^a y^b).
    #[test]
    fn polynomials_are_integrated_exactly() {
        let unit = Body::Box { lower: Vector::from([1.0, -1.0]), upper: Vector::from([3.0, 2.0]) };
        let quadrature = Quadrature::<2>::new(&unit, 5);
        let sum = |power: [i32; 2]| -> f64 {
            let value = |x: &Vector<f64, 2>| x[0].powi(power[0]) * x[1].powi(power[1]);
            quadrature.points.iter().zip(&quadrature.volumes).map(|(x, v)| v * value(x)).sum()
        };
        let along = |power: i32, [a, b]: [f64; 2]| {
            (b.powi(power + 1) - a.powi(power + 1)) / f64::from(power + 1)
        };
        for power in [[0, 0], [9, 0], [4, 7], [1, 9]] {
            let exact = along(power[0], [1.0, 3.0]) * along(power[1], [-1.0, 2.0]);
            assert!((sum(power) - exact).abs() < 1e-12 * exact.abs().max(1.0), "{power:?}");
        }
    }

    #[test]
    fn faces_close_the_body() {
        let bodies = [
            Body::Annulus { inner: 1.0, outer: 2.0, theta: [0.3, 2.9] },
            Body::Annulus { inner: 0.5, outer: 2.0, theta: [0.0, std::f64::consts::TAU] },
            Body::Box { lower: Vector::from([1.0, -1.0]), upper: Vector::from([3.0, 2.0]) },
            Body::Polygon {
                vertices: vec![[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [1.5, 2.0], [0.0, 2.0]],
                names: vec!["a", "b", "c", "d", "e"],
            },
        ];
        for body in bodies {
            let Quadrature { points, volumes, pieces } = Quadrature::<2>::new(&body, 14);
            for [a, b] in [[1, 0], [0, 1], [3, 2], [2, 3]] {
                let value = |x: &Vector<f64, 2>| x[0].powi(a) * x[1].powi(b);
                let slope = |x: &Vector<f64, 2>| f64::from(a) * x[0].powi(a - 1) * x[1].powi(b);
                let inside: f64 = points.iter().zip(&volumes).map(|(x, v)| v * slope(x)).sum();
                let through: f64 = pieces.iter().map(|it| it.area[0] * value(&it.position)).sum();
                assert!((inside - through).abs() < 1e-11, "{body:?}: {inside}, {through}");
            }
        }
        let turn = std::f64::consts::TAU;
        let in_space = [
            Body::Cylinder { inner: 0.0, outer: 1.5, theta: [0.0, turn], z: [-1.0, 0.5] },
            Body::Cylinder { inner: 0.5, outer: 1.5, theta: [0.3, 2.9], z: [-1.0, 0.5] },
            Body::Sphere { inner: 0.0, outer: 1.5, theta: [0.0, turn], phi: [0.0, turn / 2.0] },
            Body::Sphere { inner: 0.5, outer: 1.5, theta: [0.3, 2.9], phi: [0.4, 2.0] },
        ];
        for body in in_space {
            let Quadrature { points, volumes, pieces } = Quadrature::<3>::new(&body, 14);
            for axis in 0..3 {
                let value = |x: &Vector<f64, 3>| x[axis].powi(3) * x[(axis + 1) % 3];
                let slope = |x: &Vector<f64, 3>| 3.0 * x[axis].powi(2) * x[(axis + 1) % 3];
                let inside: f64 = points.iter().zip(&volumes).map(|(x, v)| v * slope(x)).sum();
                let through: f64 =
                    pieces.iter().map(|it| it.area[axis] * value(&it.position)).sum();
                assert!((inside - through).abs() < 1e-11, "{body:?}: {inside}, {through}");
            }
        }
        let cube = Body::Box { lower: Vector::zeros(), upper: Vector::from([1.0, 2.0, 3.0]) };
        let Quadrature { volumes, pieces, .. } = Quadrature::<3>::new(&cube, 3);
        assert!((volumes.iter().sum::<f64>() - 6.0).abs() < 1e-13);
        let through: f64 = pieces.iter().map(|it| it.area.dot(&it.position)).sum();
        assert!((through - 18.0).abs() < 1e-12);
        let line = Body::Box { lower: Vector::from([1.0]), upper: Vector::from([4.0]) };
        let ends: Vec<_> =
            Quadrature::<1>::new(&line, 2).pieces.iter().map(|it| it.area[0]).collect();
        assert_eq!(ends, [-1.0, 1.0]);
    }
}
