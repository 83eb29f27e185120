//! What programs of fields compute.

use crate::boundary::Datum;
use crate::derivation::Response;
use mms_spec::Face;
use mms_spec::quantity::Quantity;

/// The program of a field.
pub type Program = mms_program::Program<Output>;

/// What a program computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Output {
    /// A quantity of the field at a point and a time.
    Quantity(Quantity),
    /// A function of a supplied displacement gradient.
    Response(Response),
    /// A part of the domain.
    Bound(Bound),
    /// The default value of the parameter of that index.
    Parameter(usize),
    /// The closed form of the check of that index.
    Expected(usize),
    /// What is given on a face.
    Face(Face, Datum),
}

impl Output {
    /// Whether it is a quantity: those are what compiled code computes over many points, in a loop for what X gives and
    /// another for t, where that pays.
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
    /// The inner radius of an annulus.
    Inner,
    /// The outer radius of an annulus.
    Outer,
    /// The first and last angle of an annulus.
    Theta,
    /// The first and last time.
    Time,
}
