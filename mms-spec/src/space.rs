//! The coordinates in which a field is written, and the numbers of components of points, vectors and tensors in them.
//!
//! | `coordinates` | a point | a vector | a tensor |
//! |---|---|---|---|
//! | `cartesian` | `dimension` numbers | as many | `dimension` rows |
//! | `axisymmetric` | R, Z | R, Z; with a swirl also theta | 3 rows: R, Z, theta |
//!
//! Components of an axisymmetric field refer to the fixed basis at the reference angle of the point: e_R, e_Z, and e_theta
//! along the hoop.

use crate::quantity::Shape;

/// The coordinates of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Space {
    /// Cartesian coordinates, and their number.
    Cartesian(usize),
    /// R and Z of a field that is symmetric about the axis Z.
    Axisymmetric {
        /// Whether points also move along the hoop.
        swirl: bool,
    },
}

impl Space {
    /// The words for coordinates in a field file.
    pub const WORDS: [&str; 2] = ["cartesian", "axisymmetric"];

    /// The number of coordinates of a point.
    pub fn coordinates(self) -> usize {
        match self {
            Space::Cartesian(dimension) => dimension,
            Space::Axisymmetric { .. } => 2,
        }
    }

    /// The number of components of a vector.
    pub fn vector(self) -> usize {
        match self {
            Space::Cartesian(dimension) => dimension,
            Space::Axisymmetric { swirl } => 2 + usize::from(swirl),
        }
    }

    /// The number of rows, and of columns, of a tensor.
    pub fn rows(self) -> usize {
        match self {
            Space::Cartesian(dimension) => dimension,
            Space::Axisymmetric { .. } => 3,
        }
    }

    /// The number of components of a quantity.
    pub fn components(self, shape: Shape) -> usize {
        match shape {
            Shape::Scalar => 1,
            Shape::Vector => self.vector(),
            Shape::Tensor => self.rows() * self.rows(),
        }
    }

    /// Whether the field is symmetric about the axis Z.
    pub fn is_axisymmetric(self) -> bool {
        matches!(self, Space::Axisymmetric { .. })
    }

    /// The names of all coordinates that a field of this kind may have.
    pub fn axes(self) -> &'static [&'static str] {
        match self {
            Space::Cartesian(_) => &["X", "Y", "Z"],
            Space::Axisymmetric { .. } => &["R", "Z"],
        }
    }

    /// The names of the directions that components of a vector may have.
    pub fn directions(self) -> &'static [&'static str] {
        match self {
            Space::Cartesian(_) => &["x", "y", "z"],
            Space::Axisymmetric { .. } => &["r", "z", "theta"],
        }
    }

    /// The words for the space, such as `2-D`.
    pub fn noun(self) -> String {
        match self {
            Space::Cartesian(dimension) => format!("{dimension}-D"),
            Space::Axisymmetric { swirl: false } => "axisymmetric".into(),
            Space::Axisymmetric { swirl: true } => "axisymmetric, with a swirl".into(),
        }
    }
}
