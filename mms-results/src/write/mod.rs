//! Writes states as files that codes read: tables, VTK in XML, NumPy. [`read`](crate::read()) reads them without options.

mod npz;
mod table;
mod vtu;

use crate::Cells;
use crate::names::Axes;

pub use npz::npz;
pub use table::csv;
pub use vtu::{head, vtu};

/// The number of components of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArrayShape {
    /// One number.
    Scalar,
    /// One whole number.
    Whole,
    /// One number for each dimension.
    Vector,
    /// A square matrix, by rows.
    Tensor,
    /// A vector of three components in any dimension.
    Three,
    /// A matrix of three rows in any dimension.
    Nine,
}

impl ArrayShape {
    /// The number of components.
    pub fn components(self, dimension: usize) -> usize {
        match self {
            ArrayShape::Scalar | ArrayShape::Whole => 1,
            ArrayShape::Vector => dimension,
            ArrayShape::Tensor => dimension * dimension,
            ArrayShape::Three => 3,
            ArrayShape::Nine => 9,
        }
    }
}

/// Named numbers of all points.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name of the column.
    pub name: String,
    /// The number of components.
    pub shape: ArrayShape,
    /// The numbers, point by point.
    pub values: Vec<f64>,
}

/// A named property of a state as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// The name of the property.
    pub name: String,
    /// The value of the property.
    pub value: Value,
}

/// The value of a property: numbers, or a word.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Numbers.
    Numbers(Vec<f64>),
    /// A word in ASCII.
    Word(String),
}

/// Some points at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The time.
    pub time: f64,
    /// The dimension.
    pub dimension: usize,
    /// The letters of components.
    pub axes: Axes,
    /// The properties of the state as a whole; tables omit them.
    pub facts: Vec<Fact>,
    /// The data of the points; the same columns at all times.
    pub columns: Vec<Column>,
}

impl State {
    /// The number of points.
    pub fn points(&self) -> usize {
        let rows = |it: &Column| it.values.len() / it.shape.components(self.dimension);
        self.columns.first().map_or(0, rows)
    }
}

/// The places of a state's points, and the cells between them.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Present positions, point by point.
    pub position: &'a [f64],
    /// The cells; if there are none, each point is a vertex.
    pub cells: &'a Cells,
}
