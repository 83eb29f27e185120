//! A body as a box of fractions: of its edges, or of radius and angles.

use std::f64::consts::PI;

use mms_math::coordinates::{Numbers, System};
use mms_mechanics::extent::Extent;
use mms_mechanics::face::fixed_coordinate;
use mms_spec::Face;
use nalgebra::{SMatrix, SVector};

/// An angle that differs from a whole turn by less than this fraction of a turn is a whole turn.
const ROUNDING: f64 = 1e-12;

/// A body of `D` dimensions.
#[derive(Clone, Debug)]
pub struct Chart<const D: usize> {
    body: Extent<f64>,
    system: System,
    /// Least and greatest coordinates: X, or radius and angles; for a polygon, of the box around it.
    bounds: [[f64; D]; 2],
}

impl<const D: usize> Chart<D> {
    /// The chart of a body with numeric bounds.
    pub fn new(body: Extent<f64>) -> Self {
        let (system, corners) = match &body {
            Extent::Block(block) => {
                let end = |end: usize| block.bounds.iter().map(|it| it[end]).collect();
                (block.system, [end(0), end(1)])
            }
            _ => (System::Cartesian, body.bounding_box()),
        };
        let bounds = corners.map(|corner: Vec<f64>| std::array::from_fn(|axis| corner[axis]));
        Chart { body, system, bounds }
    }

    /// Whether the fractions of its faces are 0 and 1, so that it has a mesh of fractions. Polygons have none, and `Nothing`
    /// has none.
    pub fn is_block(&self) -> bool {
        matches!(self.body, Extent::Block(_))
    }

    fn at(&self, fractions: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|axis| match fractions.get(axis) {
            Some(fraction) => {
                let [lower, upper] = [0, 1].map(|end: usize| self.bounds[end][axis]);
                lower + (upper - lower) * fraction
            }
            None => 0.0,
        })
    }

    /// X.
    pub fn place(&self, fractions: &[f64; D]) -> SVector<f64, D> {
        if !self.is_block() {
            return SVector::from_vec(self.body.point(fractions));
        }
        let place = self.system.position(&mut Numbers::new(), &self.at(fractions));
        SVector::from_fn(|axis, _| place[axis])
    }

    /// The unit vectors along which the coordinates grow, as columns.
    pub fn basis(&self, fractions: &[f64; D]) -> SMatrix<f64, D, D> {
        let basis = self.system.basis(&mut Numbers::new(), &self.at(fractions));
        SMatrix::from_fn(|row, column| basis[column][row])
    }

    /// The derivative of X by each fraction, in length.
    pub fn scales(&self, fractions: &[f64; D]) -> [f64; D] {
        let scales = self.system.scales(&mut Numbers::new(), &self.at(fractions));
        std::array::from_fn(|axis| (self.bounds[1][axis] - self.bounds[0][axis]) * scales[axis])
    }

    /// The longest edge, or the outer radius.
    pub fn size(&self) -> f64 {
        if self.system != System::Cartesian {
            return self.bounds[1][0];
        }
        (0..D).map(|axis| self.bounds[1][axis] - self.bounds[0][axis]).fold(0.0, f64::max)
    }

    /// Whether the body closes on itself along an axis.
    pub fn is_closed(&self, axis: usize) -> bool {
        let turns = (self.bounds[1][axis] - self.bounds[0][axis]) / std::f64::consts::TAU;
        self.system != System::Cartesian && axis == 1 && (turns - 1.0).abs() <= ROUNDING
    }

    /// The axes along which all coordinates are the same place if another coordinate is at an end of its range: all angles if
    /// the radius is 0, and the angle about the axis on the axis of a sphere.
    pub fn collapsed(&self, at_lower: [bool; D], at_upper: [bool; D]) -> [bool; D] {
        let is_centre = self.is_disc() && at_lower[0];
        let is_pole = self.system == System::Spherical
            && ((at_lower[D - 1] && self.bounds[0][D - 1] == 0.0)
                || (at_upper[D - 1] && (self.bounds[1][D - 1] - PI).abs() <= ROUNDING));
        std::array::from_fn(|axis| {
            (is_centre && self.system.is_angle(axis)) || (is_pole && axis == 1)
        })
    }

    /// Whether all angles meet at the least radius.
    pub fn is_disc(&self) -> bool {
        self.system != System::Cartesian && self.bounds[0][0] == 0.0
    }

    /// Whether a face exists: a disc has no inner face, a whole ring no edges, and the axis of a sphere is no face.
    pub fn has(&self, face: Face) -> bool {
        let (axis, _) = fixed_coordinate(face);
        match face {
            Face::Inner => !self.is_disc(),
            Face::ThetaMin | Face::ThetaMax => !self.is_closed(1),
            Face::PhiMin => self.bounds[0][axis] != 0.0,
            Face::PhiMax => (self.bounds[1][axis] - PI).abs() > ROUNDING,
            Face::Outer | Face::Min(_) | Face::Max(_) | Face::Edge(..) => true,
            Face::RadialMin | Face::RadialMax | Face::AxialMin | Face::AxialMax => true,
        }
    }

    /// The fractions of a point of a face, from the fractions along it.
    pub fn on_face(&self, face: Face, along: &[f64]) -> [f64; D] {
        let (axis, is_upper) = fixed_coordinate(face);
        let mut along = along.iter();
        std::array::from_fn(|own| match own == axis {
            true => f64::from(u8::from(is_upper)),
            false => *along.next().expect("a fraction for each direction along the face"),
        })
    }

    /// The outward unit normal of a face, and unit vectors along it.
    pub fn frame(
        &self,
        face: Face,
        fractions: &[f64; D],
    ) -> (SVector<f64, D>, Vec<SVector<f64, D>>) {
        let (axis, is_upper) = fixed_coordinate(face);
        let basis = self.basis(fractions);
        let column = |axis: usize| -> SVector<f64, D> { basis.column(axis).into_owned() };
        let normal = column(axis) * if is_upper { 1.0 } else { -1.0 };
        (normal, (0..D).filter(|other| *other != axis).map(column).collect())
    }
}

/// The components of a vector; components that are 0 up to rounding, of either sign, are 0.
pub(crate) fn components<const D: usize>(vector: &SVector<f64, D>) -> Vec<f64> {
    let rounding = 4.0 * f64::EPSILON * vector.amax();
    let clean = |component: &f64| if component.abs() <= rounding { 0.0 } else { *component };
    vector.iter().map(clean).collect()
}
