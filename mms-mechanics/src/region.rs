//! Reference bodies, in formulas or in numbers: one description, from which positions, faces and bounds follow.

use mms_math::coordinates::System;

use mms_spec::Face;

/// A body, in terms of values of a type.
#[derive(Clone, Debug, PartialEq)]
pub enum Region<V> {
    /// A body between bounds of coordinates.
    Block(Block<V>),
    /// A polygon in the plane, by its vertices.
    Polygon(Vec<[V; 2]>),
    /// No body, in a space of this dimension.
    Nothing(usize),
}

/// A body between bounds of coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Block<V> {
    /// The coordinates.
    pub system: System,
    /// The least and greatest values of the coordinates, one pair per dimension.
    pub bounds: Vec<[V; 2]>,
}

impl<V: Clone> Region<V> {
    /// A box with edges along the axes.
    pub fn cuboid(lower: Vec<V>, upper: Vec<V>) -> Self {
        let bounds = lower.into_iter().zip(upper).map(|(lower, upper)| [lower, upper]).collect();
        Region::Block(Block { system: System::Cartesian, bounds })
    }

    /// The dimension of the space.
    pub fn dimension(&self) -> usize {
        match self {
            Region::Block(block) => block.bounds.len(),
            Region::Polygon(_) => 2,
            Region::Nothing(dimension) => *dimension,
        }
    }

    /// The bounds of a box with edges along the axes; `None` for other bodies.
    pub fn box_bounds(&self) -> Option<&[[V; 2]]> {
        match self {
            Region::Block(Block { system: System::Cartesian, bounds }) => Some(bounds),
            _ => None,
        }
    }

    /// The numbers that define the body, in a fixed order.
    pub fn values(&self) -> Vec<V> {
        match self {
            Region::Block(block) => block.bounds.iter().flatten().cloned().collect(),
            Region::Polygon(vertices) => vertices.iter().flatten().cloned().collect(),
            Region::Nothing(_) => Vec::new(),
        }
    }

    /// Makes a body of this kind from other values, in the order of [`Self::values`].
    pub fn with<W: Clone>(&self, values: Vec<W>) -> Region<W> {
        let pairs = || values.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]);
        match self {
            Region::Block(block) => {
                Region::Block(Block { system: block.system, bounds: pairs().collect() })
            }
            Region::Polygon(_) => Region::Polygon(pairs().collect()),
            Region::Nothing(dimension) => Region::Nothing(*dimension),
        }
    }

    /// Applies a function to all values of the body.
    pub fn map<W: Clone>(&self, of: impl Fn(&V) -> W) -> Region<W> {
        self.with(self.values().iter().map(of).collect())
    }
}

impl<V> Block<V> {
    /// The coordinate that is constant on a face, by its index, and its value there.
    pub fn fixed(&self, face: Face) -> (usize, &V) {
        let (axis, is_upper) = fixed_coordinate(face);
        (axis, &self.bounds[axis][usize::from(is_upper)])
    }
}

/// The coordinate that is constant on a face of a block, and whether it is at its upper bound.
pub fn fixed_coordinate(face: Face) -> (usize, bool) {
    match face {
        Face::Min(axis) => (axis, false),
        Face::Max(axis) => (axis, true),
        Face::Inner => (0, false),
        Face::Outer => (0, true),
        Face::ThetaMin => (1, false),
        Face::ThetaMax => (1, true),
        Face::PhiMin => (2, false),
        Face::PhiMax => (2, true),
        Face::RadialMin => (0, false),
        Face::RadialMax => (0, true),
        Face::AxialMin => (1, false),
        Face::AxialMax => (1, true),
        // An edge is no bound of a coordinate; the coordinate along it varies.
        Face::Edge(..) => (1, false),
    }
}
