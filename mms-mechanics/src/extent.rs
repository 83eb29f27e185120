//! A body in numbers, and points spread evenly (a low-discrepancy sequence) over it.

use std::f64::consts::TAU;

use mms_math::coordinates::{Numbers, Side, System};
use mms_math::polygon;
use mms_program::interpret::Number;
use mms_spec::Face;
use mms_symbolic::expr::Rational;

use crate::region::fixed_coordinate;
pub use crate::region::{Block, Region};

/// The rounding error of a bound, relative to the larger bound.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A body in numbers.
pub type Extent<T> = Region<T>;

impl<T: Number> Extent<T> {
    /// The point at these fractions: along each edge of a box; along theta, the radius and the third coordinate of a round
    /// body. In a polygon the first fraction chooses a triangle, in proportion to its area. Without a body, the fractions are
    /// X.
    pub fn point(&self, fractions: &[T]) -> Vec<T> {
        match self {
            Extent::Block(block) => block.point(fractions),
            Extent::Polygon(vertices) => in_polygon(vertices, &fractions[0], &fractions[1]),
            Extent::Nothing(dimension) => fractions[..*dimension].to_vec(),
        }
    }
}

impl<T: Number> Block<T> {
    fn point(&self, fractions: &[T]) -> Vec<T> {
        let dimension = self.bounds.len();
        let fraction = |axis: usize| match self.system {
            System::Cartesian => axis,
            // The first fraction is the angle.
            System::Polar | System::Spherical => [1, 0, 2][axis],
        };
        let at = std::array::from_fn(|axis| match self.bounds.get(axis) {
            Some([from, to]) => between(from, to, &fractions[fraction(axis)]),
            None => T::from_f64(0.0),
        });
        self.system.position(&mut Numbers::new(), &at)[..dimension].to_vec()
    }
}

/// The point of a polygon at two fractions.
fn in_polygon<T: Number>(vertices: &[[T; 2]], first: &T, second: &T) -> Vec<T> {
    let rounded: Vec<[f64; 2]> = vertices.iter().map(|vertex| vertex.clone().map(near)).collect();
    let triangles = polygon::triangles(&rounded);
    let area = |it: &[usize; 3]| polygon::area(&it.map(|corner| rounded[corner])).abs();
    let whole: f64 = triangles.iter().map(area).sum();
    let (fraction, mut before) = (near(first.clone()), 0.0);
    let Some(last) = triangles.last().copied() else { return vec![T::from_f64(f64::NAN); 2] };
    let mut chosen = (last, before, 1.0);
    for triangle in triangles {
        let part = area(&triangle) / whole;
        if part > 0.0 {
            chosen = (triangle, before, part);
        }
        before += part;
        if fraction < before {
            break;
        }
    }
    let (triangle, before, part) = chosen;
    let [a, b, c] = triangle.map(|corner| &vertices[corner]);
    // The distance from the first corner grows like a square root, so that equal parts have equal area.
    let s = (first.clone() - T::from_f64(before)) / T::from_f64(part);
    let s = if near(s.clone()) > 0.0 { s.sqrt() } else { T::from_f64(0.0) };
    let coordinate = |k: usize| {
        let far = between(&b[k], &c[k], second);
        between(&a[k], &far, &s)
    };
    vec![coordinate(0), coordinate(1)]
}

fn near<T: Number>(value: T) -> f64 {
    value.bounds()[0]
}

impl Extent<f64> {
    /// Whether a point is in the body, on its boundary, or within rounding of it. Without a body every point is.
    pub fn contains(&self, point: &[f64]) -> bool {
        match self {
            Extent::Block(block) => block.contains(point),
            Extent::Polygon(vertices) => {
                let point = [point[0], point[1]];
                let size = self.size();
                let is_on = |first: usize| {
                    polygon::nearest(polygon::edge(vertices, first), point).1 <= ROUNDING * size
                };
                polygon::contains(vertices, point) || (0..vertices.len()).any(is_on)
            }
            Extent::Nothing(_) => true,
        }
    }

    /// The length, area or volume of the body; 0 without a body.
    pub fn measure(&self) -> f64 {
        match self {
            Extent::Block(block) => {
                let sides = block.bounds.iter().copied().map(Side::Between);
                block.system.measure(&sides.collect::<Vec<_>>())
            }
            Extent::Polygon(vertices) => polygon::area(vertices).abs(),
            Extent::Nothing(_) => 0.0,
        }
    }

    /// The least and the greatest coordinates of the body.
    pub fn bounding_box(&self) -> [Vec<f64>; 2] {
        match self {
            Extent::Block(block) => {
                let [lower, upper] = block.system.bounding_box(&block.bounds);
                [lower, upper].map(|corner| corner[..block.bounds.len()].to_vec())
            }
            Extent::Polygon(vertices) => {
                let along = |k: usize| vertices.iter().map(move |vertex| vertex[k]);
                [
                    (0..2).map(|k| along(k).fold(f64::INFINITY, f64::min)).collect(),
                    (0..2).map(|k| along(k).fold(f64::NEG_INFINITY, f64::max)).collect(),
                ]
            }
            Extent::Nothing(dimension) => [vec![0.0; *dimension], vec![1.0; *dimension]],
        }
    }

    /// The longest edge of a box, and of the box around a polygon; the outer diameter or the length of a round body.
    pub fn size(&self) -> f64 {
        let longest = |edges: &mut dyn Iterator<Item = f64>| edges.fold(0.0, f64::max);
        match self {
            Extent::Block(Block { system: System::Cartesian, bounds }) => {
                longest(&mut bounds.iter().map(|[lower, upper]| upper - lower))
            }
            Extent::Block(Block { system: System::Polar, bounds }) => {
                let lengths = bounds.iter().skip(2).map(|[lower, upper]| upper - lower);
                longest(&mut lengths.chain([2.0 * bounds[0][1]]))
            }
            Extent::Block(Block { system: System::Spherical, bounds }) => 2.0 * bounds[0][1],
            Extent::Polygon(_) | Extent::Nothing(_) => {
                let [lower, upper] = self.bounding_box();
                longest(&mut lower.iter().zip(&upper).map(|(lower, upper)| upper - lower))
            }
        }
    }

    /// The distance of a point from the body, in the unit of lengths; 0 inside it.
    pub fn distance(&self, point: &[f64]) -> f64 {
        match self {
            Extent::Block(block) => block.distance(point),
            Extent::Polygon(vertices) => {
                let point = [point[0], point[1]];
                if self.contains(&point) {
                    return 0.0;
                }
                let to_edge = |first| polygon::nearest(polygon::edge(vertices, first), point).1;
                (0..vertices.len()).map(to_edge).fold(f64::INFINITY, f64::min)
            }
            Extent::Nothing(_) => 0.0,
        }
    }

    /// The distance of a point of the body from a face, in the unit of lengths; infinite if the body does not have the face.
    pub fn distance_to(&self, face: Face, point: &[f64]) -> f64 {
        match (self, face) {
            (Extent::Block(block), _) => block.distance_to(face, point),
            (Extent::Polygon(vertices), Face::Edge(first, _)) if first < vertices.len() => {
                polygon::nearest(polygon::edge(vertices, first), [point[0], point[1]]).1
            }
            _ => f64::INFINITY,
        }
    }
}

impl Block<f64> {
    fn contains(&self, point: &[f64]) -> bool {
        let at = self.system.local(padded(point));
        self.bounds.iter().enumerate().all(|(axis, [from, to])| match axis == 1 {
            true if self.system != System::Cartesian => {
                let turns = (at[1] - from).rem_euclid(TAU);
                // An angle just before the first one is nearly a turn after it.
                let angle = if TAU - turns <= ROUNDING * TAU { 0.0 } else { turns };
                is_between(0.0, to - from, angle)
            }
            _ => is_between(*from, *to, at[axis]),
        })
    }

    fn distance(&self, point: &[f64]) -> f64 {
        let radii = self.bounds[0];
        match (self.system, point) {
            (System::Cartesian, _) => {
                let sides = point.iter().zip(&self.bounds);
                sides.map(|(x, [a, b])| beyond(*x, *a, *b).powi(2)).sum::<f64>().sqrt()
            }
            (System::Polar, [x, y]) => to_sector(radii, self.bounds[1], [*x, *y]),
            (System::Polar, [x, y, z]) => {
                let [from, to] = self.bounds[2];
                to_sector(radii, self.bounds[1], [*x, *y]).hypot(beyond(*z, from, to))
            }
            (System::Spherical, [x, y, z]) => {
                let [theta, phi] = [self.bounds[1], self.bounds[2]];
                // In the half plane of an angle theta, the body is a sector about the origin.
                let within = |across: f64| to_sector(radii, phi, [*z, across]);
                if (y.atan2(*x) - theta[0]).rem_euclid(TAU) <= theta[1] - theta[0] {
                    return within(x.hypot(*y));
                }
                let to_plane = |angle: f64| {
                    let (sine, cosine) = angle.sin_cos();
                    within(x * cosine + y * sine).hypot(y * cosine - x * sine)
                };
                to_plane(theta[0]).min(to_plane(theta[1]))
            }
            _ => f64::INFINITY,
        }
    }

    fn distance_to(&self, face: Face, point: &[f64]) -> f64 {
        let (axis, is_upper) = fixed_coordinate(face);
        let is_of = match face {
            Face::Min(axis) | Face::Max(axis) => self.system == System::Cartesian || axis == 2,
            Face::PhiMin | Face::PhiMax => self.system == System::Spherical,
            Face::RadialMin | Face::RadialMax | Face::AxialMin | Face::AxialMax => {
                self.system == System::Cartesian
            }
            Face::Edge(..) => false,
            _ => self.system != System::Cartesian,
        };
        if !is_of || axis >= self.bounds.len() || axis >= point.len() {
            return f64::INFINITY;
        }
        let bound = self.bounds[axis][usize::from(is_upper)];
        match (self.system, axis) {
            (System::Polar | System::Spherical, 1) => to_ray(bound, [point[0], point[1]]),
            (System::Spherical, 2) => to_ray(bound, [point[2], point[0].hypot(point[1])]),
            _ => (self.system.local(padded(point))[axis] - bound).abs(),
        }
    }
}

fn padded(point: &[f64]) -> [f64; 3] {
    std::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0))
}

/// The distance of a point of the plane from a sector of a ring.
fn to_sector([inner, outer]: [f64; 2], [first, last]: [f64; 2], [x, y]: [f64; 2]) -> f64 {
    if (y.atan2(x) - first).rem_euclid(TAU) <= last - first {
        return beyond(x.hypot(y), inner, outer);
    }
    let to_edge = |angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        let along = (x * cosine + y * sine).clamp(inner, outer);
        (x - along * cosine).hypot(y - along * sine)
    };
    to_edge(first).min(to_edge(last))
}

/// The distance of a point from the ray at an angle.
fn to_ray(angle: f64, [x, y]: [f64; 2]) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let along = (x * cosine + y * sine).max(0.0);
    (x - along * cosine).hypot(y - along * sine)
}

fn beyond(value: f64, lower: f64, upper: f64) -> f64 {
    (lower - value).max(value - upper).max(0.0)
}

/// Whether a number lies between two others, or within rounding of them.
pub fn is_between(lower: f64, upper: f64, value: f64) -> bool {
    let rounding = ROUNDING * f64::max(lower.abs(), upper.abs());
    (lower - rounding..=upper + rounding).contains(&value)
}

pub(crate) fn between<T: Number>(from: &T, to: &T, fraction: &T) -> T {
    from.clone() + (to.clone() - from.clone()) * fraction.clone()
}

/// The point at this index, from 1 on, of the Halton sequence (Halton, Numer. Math. 2, 1960) in the unit cube of four
/// dimensions.
pub fn halton<T: Number>(index: usize) -> [T; 4] {
    [2, 3, 5, 7].map(|base| T::from_rational(&radical_inverse(index, base)))
}

/// The point at this index, from 1 on, of the Halton sequence in the unit cube of any dimension.
pub fn spread(index: usize, dimension: usize) -> Vec<Rational> {
    let mut primes: Vec<usize> = Vec::with_capacity(dimension);
    for n in 2.. {
        if primes.len() == dimension {
            break;
        }
        let mut divisors = primes.iter().take_while(|prime| *prime * *prime <= n);
        if divisors.all(|prime| !n.is_multiple_of(*prime)) {
            primes.push(n);
        }
    }
    primes.into_iter().map(|base| radical_inverse(index, base)).collect()
}

/// The digits of `index` in `base`, mirrored at the radix point.
fn radical_inverse(mut index: usize, base: usize) -> Rational {
    let (mut numerator, mut denominator) = (0usize, 1usize);
    while index > 0 {
        numerator = numerator * base + index % base;
        denominator *= base;
        index /= base;
    }
    Rational::from_parts(numerator.into(), denominator.into())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn sector(radii: [f64; 2], angles: [f64; 2]) -> Extent<f64> {
        Extent::Block(Block { system: System::Polar, bounds: vec![radii, angles] })
    }

    fn angle() -> Extent<f64> {
        Extent::Polygon(vec![[0.0, -1.0], [2.0, -1.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    }

    /// Compares with the nearest of many points of the body.
    #[test]
    fn distances_are_those_to_the_nearest_point() {
        let bodies = [
            Extent::cuboid(vec![0.0, -1.0], vec![2.0, 1.0]),
            sector([1.0, 2.0], [0.25 * PI, 1.5 * PI]),
            sector([0.5, 1.0], [0.0, 2.0 * PI]),
            angle(),
        ];
        let fractions = || (0..=400).map(|k| f64::from(k) / 400.0);
        for body in &bodies {
            for [x, y] in [[0.0, 0.0], [3.0, 2.0], [0.1, -1.7], [1.5, 0.2], [-1.2, 0.3], [0.2, 0.1]]
            {
                let points =
                    fractions().flat_map(|a| fractions().map(move |b| body.point(&[a, b])));
                let nearest =
                    points.map(|p| (p[0] - x).hypot(p[1] - y)).fold(f64::INFINITY, f64::min);
                let found = body.distance(&[x, y]);
                assert!((found - nearest).abs() < 0.02, "{body:?}, {x}, {y}: {found}, {nearest}");
                assert_eq!(found == 0.0, body.contains(&[x, y]), "{body:?}, {x}, {y}");
            }
        }
        assert_eq!(bodies[0].distance_to(Face::Max(1), &[0.5, 0.75]), 0.25);
        assert_eq!(bodies[0].distance_to(Face::Inner, &[0.5, 0.75]), f64::INFINITY);
        assert!((bodies[1].distance_to(Face::Outer, &[-1.5, 0.0]) - 0.5).abs() < 1e-15);
        assert!((bodies[1].distance_to(Face::ThetaMin, &[0.0, 2.0]) - 2f64.sqrt()).abs() < 1e-15);
        assert!((bodies[1].distance_to(Face::ThetaMax, &[-1.0, -1.0]) - 1.0).abs() < 1e-15);
        assert!(
            (bodies[3].distance_to(Face::Edge(3, "slope"), &[0.0, 0.0]) - 0.5f64.sqrt()).abs()
                < 1e-15
        );
        assert_eq!(bodies[3].distance_to(Face::Min(0), &[0.0, 0.0]), f64::INFINITY);
        assert_eq!(bodies[0].measure(), 4.0);
        assert!((bodies[2].measure() - 0.75 * PI).abs() < 1e-12);
        assert_eq!(bodies[3].measure(), 2.5);
    }

    #[test]
    fn distances_in_space_are_those_to_the_nearest_point() {
        let block = |system: System, bounds: [[f64; 2]; 3]| {
            Extent::Block(Block { system, bounds: bounds.to_vec() })
        };
        let bodies = [
            block(System::Polar, [[0.5, 1.0], [0.3, 1.9], [-1.0, 0.5]]),
            block(System::Spherical, [[0.5, 1.0], [0.3, 1.9], [0.4, 2.0]]),
            block(System::Spherical, [[0.0, 1.0], [0.0, TAU], [0.0, PI]]),
        ];
        let fractions = || (0..=60).map(|k| f64::from(k) / 60.0);
        for body in &bodies {
            let places = [[0.0, 0.0, 0.1], [1.0, 2.0, 3.0], [0.3, 0.6, 0.2], [-0.5, -0.6, -0.4]];
            for place in places {
                let points = fractions().flat_map(|a| {
                    fractions().flat_map(move |b| fractions().map(move |c| body.point(&[a, b, c])))
                });
                let away = |p: Vec<f64>| {
                    p.iter().zip(place).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
                };
                let nearest = points.map(away).fold(f64::INFINITY, f64::min);
                let found = body.distance(&place);
                assert!((found - nearest).abs() < 0.04, "{body:?}, {place:?}: {found}, {nearest}");
                assert_eq!(found == 0.0, body.contains(&place), "{body:?}, {place:?}");
            }
        }
        let cone = bodies[1].distance_to(Face::PhiMax, &[0.6, 0.6, 0.0]);
        // The distance of the angle pi/2 from the cone at 2: R sin(2 - pi/2).
        assert!((cone - 0.72f64.sqrt() * (2.0 - 0.5 * PI).sin()).abs() < 1e-15);
        assert!((bodies[0].distance_to(Face::Max(2), &[0.6, 0.6, 0.2]) - 0.3).abs() < 1e-15);
        assert!((bodies[1].distance_to(Face::Outer, &[0.6, 0.0, 0.0]) - 0.4).abs() < 1e-15);
    }

    #[test]
    fn points_of_polygons_lie_in_them_as_often_as_their_parts_are_large() {
        let body = angle();
        let points: Vec<Vec<f64>> = (1..=4000).map(|k| body.point(&halton::<f64>(k))).collect();
        assert!(points.iter().all(|point| body.contains(point)));
        // The area below 0 is 2 of 2.5.
        let below = points.iter().filter(|point| point[1] < 0.0).count();
        assert!((below as f64 / 4000.0 - 0.8).abs() < 0.01, "{below}");
    }
}
