//! The outputs of programs of fields.

use crate::boundary::Datum;
use mms_math::coordinates::System;

use crate::derivation::Response;
use crate::region::{Block, Region};
use mms_spec::Face;
use mms_spec::quantity::Quantity;

/// The program of a field.
pub type Program = mms_program::Program<Output>;

/// An output of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Output {
    /// A quantity of the field at a point and a time.
    Quantity(Quantity),
    /// A function of a supplied displacement gradient.
    Response(Response),
    /// A part of the domain.
    Bound(Bound),
    /// The default value of the parameter at this index.
    Parameter(usize),
    /// The closed form of the check at this index.
    Expected(usize),
    /// A datum on a face.
    Face(Face, Datum),
}

impl Output {
    /// Whether the output is a quantity. Compiled code computes quantities over many points, in one loop for the part of X and
    /// another for the part of t, if that pays.
    pub fn is_quantity(self) -> bool {
        matches!(self, Output::Quantity(_))
    }
}

/// A part of the declared domain, in terms of the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Bound {
    /// The least coordinates of a box.
    Lower,
    /// The greatest coordinates of a box.
    Upper,
    /// The inner radius of a round body.
    Inner,
    /// The outer radius of a round body.
    Outer,
    /// The first and last angle about the axis Z.
    Theta,
    /// The lower and the upper end of a cylinder.
    Z,
    /// The first and last angle of a sphere from +Z.
    Phi,
    /// The vertices of a polygon, one after another.
    Vertices,
    /// Zeros, one for each dimension, of a field without a body.
    Space,
    /// The first and last time.
    Time,
}

impl Bound {
    /// All bounds.
    pub const ALL: [Bound; 10] = [
        Bound::Lower,
        Bound::Upper,
        Bound::Inner,
        Bound::Outer,
        Bound::Theta,
        Bound::Z,
        Bound::Phi,
        Bound::Vertices,
        Bound::Space,
        Bound::Time,
    ];

    /// The name of the bound in emitted code.
    pub fn name(self) -> &'static str {
        match self {
            Bound::Lower => "lower",
            Bound::Upper => "upper",
            Bound::Inner => "inner",
            Bound::Outer => "outer",
            Bound::Theta => "theta",
            Bound::Z => "z_ends",
            Bound::Phi => "phi",
            Bound::Vertices => "vertices",
            Bound::Space => "space",
            Bound::Time => "time_window",
        }
    }

    /// The sentence that describes the bound.
    pub fn doc(self) -> &'static str {
        match self {
            Bound::Lower => "The body's least reference coordinates, m.",
            Bound::Upper => "The body's greatest reference coordinates, m.",
            Bound::Inner => "The body's inner radius, m.",
            Bound::Outer => "The body's outer radius, m.",
            Bound::Theta => "The body's first and last angle.",
            Bound::Z => "The lower and the upper end of the body, m.",
            Bound::Phi => "The body's first and last angle from +Z.",
            Bound::Vertices => "The body's vertices, X and Y of one after another, m.",
            Bound::Space => "As many zeros as space has dimensions.",
            Bound::Time => "The first and last time of the claims, s.",
        }
    }
}

/// The parts of a body, each with its numbers; without a body, one zero for each dimension.
pub fn parts<V: Clone>(body: &Region<V>, zero: V) -> Vec<(Bound, Vec<V>)> {
    let end = |bounds: &[[V; 2]], end: usize| bounds.iter().map(|it| it[end].clone()).collect();
    match body {
        Region::Block(Block { system: System::Cartesian, bounds }) => {
            vec![(Bound::Lower, end(bounds, 0)), (Bound::Upper, end(bounds, 1))]
        }
        Region::Block(Block { system, bounds }) => {
            let third = if *system == System::Spherical { Bound::Phi } else { Bound::Z };
            let radii = &bounds[..1];
            let mut parts = vec![(Bound::Inner, end(radii, 0)), (Bound::Outer, end(radii, 1))];
            let angles = [Bound::Theta, third].into_iter().zip(&bounds[1..]);
            parts.extend(angles.map(|(bound, pair)| (bound, pair.to_vec())));
            parts
        }
        Region::Polygon(_) => vec![(Bound::Vertices, body.values())],
        Region::Nothing(dimension) => vec![(Bound::Space, vec![zero; *dimension])],
    }
}

/// Makes the body that has these parts.
pub fn body<V: Clone>(part: impl Fn(Bound) -> Option<Vec<V>>) -> Region<V> {
    let pairs = |values: Vec<V>| {
        let pairs = values.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]);
        pairs.collect::<Vec<_>>()
    };
    if let (Some(lower), Some(upper)) = (part(Bound::Lower), part(Bound::Upper)) {
        return Region::cuboid(lower, upper);
    }
    if let Some(vertices) = part(Bound::Vertices) {
        return Region::Polygon(pairs(vertices));
    }
    let radii = part(Bound::Inner).zip(part(Bound::Outer));
    let Some((inner, outer)) = radii else {
        return Region::Nothing(part(Bound::Space).map_or(0, |zeros| zeros.len()));
    };
    let phi = part(Bound::Phi);
    let system = if phi.is_some() { System::Spherical } else { System::Polar };
    let others = [part(Bound::Theta), part(Bound::Z), phi].into_iter().flatten().flatten();
    let bounds = pairs(inner.into_iter().chain(outer).chain(others).collect());
    Region::Block(Block { system, bounds })
}
