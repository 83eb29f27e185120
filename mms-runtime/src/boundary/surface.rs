//! The faces of a reference body, as surfaces.

use mms_math::coordinates::System;
use mms_math::polygon;

use crate::body::block;
use crate::body::round::Block;
use crate::field::{Body, Face};
use crate::lattice::Lattice;
use crate::real::{Real, Vector};

/// A face of the reference body.
pub enum Surface<T> {
    /// A face of a box.
    Plane {
        /// The normal axis of the plane.
        axis: usize,
        /// Whether the body is below.
        upper: bool,
        /// The plane's coordinate.
        position: T,
    },
    /// A circle, a cylinder about the axis Z, or a sphere.
    Round {
        /// The number of coordinates that the radius is computed from.
        among: usize,
        /// Whether the body is inside.
        outer: bool,
        /// The radius.
        radius: T,
    },
    /// A face of a sector: a ray, or a half plane that ends in the axis Z.
    Ray {
        /// Whether the body is at smaller angles.
        last: bool,
        /// Cosine and sine of the angle.
        direction: [T; 2],
    },
    /// A face of a part of a sphere: a cone about the axis Z.
    Cone {
        /// Whether the body is at smaller angles from +Z.
        last: bool,
        /// Cosine and sine of the angle from +Z.
        direction: [T; 2],
    },
    /// A face of a polygon: the edge between two points.
    Edge {
        /// The points.
        ends: [[T; 2]; 2],
        /// The outward normal.
        normal: [T; 2],
    },
}

impl<T: Real> Surface<T> {
    /// The surface of a `face` that the body has.
    pub fn new<const D: usize>(body: &Body<T, D>, face: Face) -> Self {
        match (body, face) {
            (Body::Box { upper, .. }, Face::Max(axis)) => {
                Surface::Plane { axis, upper: true, position: upper[axis] }
            }
            (Body::Box { lower, .. }, Face::Min(axis)) => {
                Surface::Plane { axis, upper: false, position: lower[axis] }
            }
            (Body::Polygon { vertices, .. }, Face::Edge(first, _)) => {
                let near: Vec<_> = vertices.iter().map(|it| it.map(Real::to_f64)).collect();
                let ends = polygon::edge(&near, first).map(|end| end.map(T::of));
                Surface::Edge { ends, normal: polygon::normal(&near, first).map(T::of) }
            }
            (body, face) => {
                let block =
                    block(body).unwrap_or_else(|| unreachable!("the body has no such face"));
                let (axis, last) = Block::end(face);
                let bound = block.bounds[axis][usize::from(last)];
                let direction = [bound.cos(), bound.sin()].map(T::of);
                match (axis, block.system) {
                    (0, system) => {
                        let among = if system == System::Spherical { 3 } else { 2 };
                        Surface::Round { among, outer: last, radius: T::of(bound) }
                    }
                    (1, _) => Surface::Ray { last, direction },
                    (_, System::Spherical) => Surface::Cone { last, direction },
                    (axis, _) => Surface::Plane { axis, upper: last, position: T::of(bound) },
                }
            }
        }
    }

    /// The mirror image in the surface of a point beyond it.
    pub fn image<const D: usize>(&self, position: &Vector<T, D>) -> Option<Vector<T, D>> {
        let [foot, normal] = self.foot(position);
        let beyond = (position - foot).dot(&normal) > T::zero();
        beyond.then(|| foot + foot - position)
    }

    /// The point of the surface nearest to X, and the outward normal there.
    pub fn foot<const D: usize>(&self, reference: &Vector<T, D>) -> [Vector<T, D>; 2] {
        let (mut foot, mut normal) = (*reference, Vector::zeros());
        match *self {
            Surface::Plane { axis, upper, position } => {
                foot[axis] = position;
                normal[axis] = if upper { T::one() } else { -T::one() };
            }
            Surface::Round { among, outer, radius } => {
                let radial: Vector<T, D> =
                    Vector::from_fn(|a, _| if a < among { foot[a] } else { T::zero() });
                let length = radial.norm();
                let along_x: Vector<T, D> =
                    Vector::from_fn(|a, _| if a == 0 { T::one() } else { T::zero() });
                let direction = if length > T::zero() { radial / length } else { along_x };
                foot += direction * radius - radial;
                normal = if outer { direction } else { -direction };
            }
            Surface::Ray { last, direction: [cosine, sine] } => {
                let along = Vector::from_fn(|a, _| [cosine, sine, T::zero()][a.min(2)]);
                let around = Vector::from_fn(|a, _| [-sine, cosine, T::zero()][a.min(2)]);
                // The component along the axis Z is unchanged.
                let rest = Vector::from_fn(|a, _| if a == 2 { foot[a] } else { T::zero() });
                foot = along * foot.dot(&along) + rest;
                normal = if last { around } else { -around };
            }
            Surface::Cone { last, direction: [cosine, sine] } => {
                let radial: Vector<T, D> =
                    Vector::from_fn(|a, _| if a < 2 { foot[a] } else { T::zero() });
                let length = radial.norm();
                let along_x: Vector<T, D> =
                    Vector::from_fn(|a, _| if a == 0 { T::one() } else { T::zero() });
                let direction = if length > T::zero() { radial / length } else { along_x };
                let axis = Vector::from_fn(|a, _| if a == 2 { T::one() } else { T::zero() });
                let along = axis * cosine + direction * sine;
                let around = direction * cosine - axis * sine;
                foot = along * foot.dot(&along);
                normal = if last { around } else { -around };
            }
            Surface::Edge { ends, normal: outward } => {
                let place = |[x, y]: [T; 2]| Vector::from_fn(|a, _| [x, y, T::zero()][a.min(2)]);
                let [from, to] = ends.map(place);
                let along: Vector<T, D> = to - from;
                let part = (foot - from).dot(&along) / along.norm_squared();
                let clamped = part.max(T::zero()).min(T::one());
                let nearest = from + along * clamped;
                normal = place(outward);
                // If the nearest point is an end of the edge, the normal is the direction to it, on either side of the edge's
                // line.
                let away = nearest - foot;
                if clamped != part && away.norm() > T::zero() {
                    normal = away.normalize();
                }
                foot = nearest;
            }
        }
        [foot, normal]
    }

    /// The reach of the weights of a node along a unit normal.
    pub fn reach<const D: usize>(&self, normal: &Vector<T, D>, lattice: &Lattice<T, D>) -> T {
        let ended = match *self {
            Surface::Plane { axis, upper, .. } => {
                lattice.degree > 1 && lattice.node_on_face(axis, upper).is_some()
            }
            _ => false,
        };
        let width = normal.abs().dot(&lattice.cell_size);
        // Where weights just touch the face, round-off must not decide.
        let (half_support, slack) = (T::ratio(lattice.degree as i32 + 1, 2), T::of(1e-3));
        if ended { width * slack } else { width * (half_support - slack) }
    }
}

#[cfg(test)]
mod tests {
    use super::Surface;
    use crate::body::faces;
    use crate::field::Body;
    use crate::real::Vector;

    #[test]
    fn normals_of_all_faces_point_away_from_the_body() {
        let plate = Body::Box {
            lower: Vector::<f64, 2>::new(-1.0, 0.5),
            upper: Vector::<f64, 2>::new(2.0, 0.75),
        };
        let sector = Body::Annulus { inner: 0.5, outer: 1.0, theta: [0.25, 1.5] };
        for (body, inside) in [(plate, [0.0, 0.625]), (sector, [0.5, 0.5])] {
            let inside = Vector::<f64, 2>::from(inside);
            for face in faces(&body) {
                let surface = Surface::new(&body, face);
                let [foot, normal] = surface.foot(&inside);
                let depth = (foot - inside).norm();
                assert!(depth > 0.1 && (normal.norm() - 1.0).abs() < 1e-15, "{face}");
                // The nearest point is straight ahead, and is its own nearest point.
                assert!((inside + normal * depth - foot).norm() < 1e-15, "{face}");
                assert!((surface.foot(&foot)[0] - foot).norm() < 1e-15, "{face}");
                // An image is as far on the other side, and points that are not beyond have none.
                let beyond = foot + normal * 0.125;
                let image = surface.image(&beyond).expect("the point is beyond");
                assert!((image - (foot - normal * 0.125)).norm() < 1e-15, "{face}");
                assert!(surface.image(&inside).is_none(), "{face}");
            }
        }
    }
}
