//! A body as a box of fractions: of its edges, or of radius and angle.

use mms_mechanics::extent::Extent;
use mms_mechanics::face::fixed_coordinate;
use mms_spec::Face;
use nalgebra::{SMatrix, SVector};

/// An angle that differs from a whole turn by less than this part of one is a whole turn.
const ROUNDING: f64 = 1e-12;

/// A body of `D` dimensions.
#[derive(Clone, Debug)]
pub struct Chart<const D: usize> {
    /// Least and greatest coordinates: X, or radius and angle.
    bounds: [[f64; D]; 2],
    is_polar: bool,
}

impl<const D: usize> Chart<D> {
    /// Of a body in numbers.
    pub fn new(extent: &Extent<f64>) -> Self {
        let (lower, upper, is_polar) = match extent {
            Extent::Box([lower, upper]) => (lower.clone(), upper.clone(), false),
            Extent::Annulus(radii, angles) => {
                (vec![radii[0], angles[0]], vec![radii[1], angles[1]], true)
            }
        };
        let bounds = [lower, upper].map(|bound| std::array::from_fn(|axis| bound[axis]));
        Chart { bounds, is_polar }
    }

    fn coordinate(&self, axis: usize, fraction: f64) -> f64 {
        let [lower, upper] = [0, 1].map(|end| self.bounds[end][axis]);
        lower + (upper - lower) * fraction
    }

    /// X.
    pub fn place(&self, fractions: &[f64; D]) -> SVector<f64, D> {
        let coordinates = SVector::from_fn(|axis, _| self.coordinate(axis, fractions[axis]));
        if !self.is_polar {
            return coordinates;
        }
        let (sine, cosine) = coordinates[1].sin_cos();
        SVector::from_fn(|axis, _| coordinates[0] * [cosine, sine][axis])
    }

    /// The unit vectors along which the coordinates grow, as columns.
    pub fn basis(&self, fractions: &[f64; D]) -> SMatrix<f64, D, D> {
        if !self.is_polar {
            return SMatrix::identity();
        }
        let (sine, cosine) = self.coordinate(1, fractions[1]).sin_cos();
        SMatrix::from_fn(|row, column| [[cosine, -sine], [sine, cosine]][row][column])
    }

    /// How far X moves for each fraction.
    pub fn scales(&self, fractions: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| {
            let length = self.bounds[1][axis] - self.bounds[0][axis];
            let is_angle = self.is_polar && axis == 1;
            if is_angle { length * self.coordinate(0, fractions[0]) } else { length }
        })
    }

    /// The longest edge, or the outer radius.
    pub fn size(&self) -> f64 {
        if self.is_polar {
            return self.bounds[1][0];
        }
        (0..D).map(|axis| self.bounds[1][axis] - self.bounds[0][axis]).fold(0.0, f64::max)
    }

    /// Whether it closes on itself along an axis.
    pub fn is_closed(&self, axis: usize) -> bool {
        let turns = (self.bounds[1][axis] - self.bounds[0][axis]) / std::f64::consts::TAU;
        self.is_polar && axis == 1 && (turns - 1.0).abs() <= ROUNDING
    }

    /// Whether all angles meet in one point where the radius is least.
    pub fn is_disc(&self) -> bool {
        self.is_polar && self.bounds[0][0] == 0.0
    }

    /// Whether a face is there: a disc has no inner one, a whole ring no edges.
    pub fn has(&self, face: Face) -> bool {
        match face {
            Face::Inner => !self.is_disc(),
            Face::ThetaMin | Face::ThetaMax => !self.is_closed(1),
            Face::Outer | Face::Min(_) | Face::Max(_) => true,
        }
    }

    /// The fractions of a point of a face, from those along it.
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

/// The components of a vector; what rounding leaves of 0, of either sign, is 0.
pub(crate) fn components<const D: usize>(vector: &SVector<f64, D>) -> Vec<f64> {
    let rounding = 4.0 * f64::EPSILON * vector.amax();
    let clean = |component: &f64| if component.abs() <= rounding { 0.0 } else { *component };
    vector.iter().map(clean).collect()
}
