//! The letters of components in names: Cartesian coordinates, or R, Z and the hoop.

/// The letters of components in names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// x, y, z.
    #[default]
    Cartesian,
    /// r, z and t or theta of an axisymmetric field; x and y may replace r and z.
    Axisymmetric {
        /// Whether points also move along the hoop.
        swirl: bool,
    },
}

impl Axes {
    /// The axis that a letter or a digit names.
    pub(crate) fn of(self, byte: u8) -> Option<usize> {
        match (self, byte.to_ascii_lowercase()) {
            (_, b'x') | (Axes::Axisymmetric { .. }, b'r') => Some(0),
            (_, b'y') | (Axes::Axisymmetric { .. }, b'z') => Some(1),
            (Axes::Cartesian, b'z') | (Axes::Axisymmetric { .. }, b't') => Some(2),
            (_, b'0'..=b'9') => Some(usize::from(byte - b'0')),
            _ => None,
        }
    }

    /// The number of components of a vector at a point with this number of coordinates.
    pub fn of_vectors(self, coordinates: usize) -> usize {
        coordinates + usize::from(self == Axes::Axisymmetric { swirl: true })
    }

    /// Whether shears along the hoop are 0, so that files leave them out.
    pub(crate) fn has_no_swirl(self) -> bool {
        self == Axes::Axisymmetric { swirl: false }
    }
}
