//! States as files that codes read: tables, VTK in XML, NumPy. What is written here is read by [`read`](crate::read()) as it
//! is.

mod npz;
mod table;
mod vtu;

use crate::Cells;
use crate::names::Axes;

pub use npz::npz;
pub use table::csv;
pub use vtu::{head, vtu};

/// How many numbers a column has for each point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One.
    Scalar,
    /// One, a whole number.
    Whole,
    /// One for each dimension.
    Vector,
    /// A square matrix, by rows.
    Tensor,
    /// A vector of three components in any dimension.
    Three,
    /// A matrix of three rows in any dimension.
    Nine,
}

impl Shape {
    /// How many that is.
    pub fn components(self, dimension: usize) -> usize {
        match self {
            Shape::Scalar | Shape::Whole => 1,
            Shape::Vector => dimension,
            Shape::Tensor => dimension * dimension,
            Shape::Three => 3,
            Shape::Nine => 9,
        }
    }
}

/// Named numbers of all points.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// How many numbers a point has.
    pub shape: Shape,
    /// The numbers, those of a point together.
    pub values: Vec<f64>,
}

/// What is known of a state as a whole, under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Its name.
    pub name: String,
    /// What it is.
    pub value: Value,
}

/// A fact: numbers, or a word.
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
    /// What is known of it as a whole; a table has no place for that.
    pub facts: Vec<Fact>,
    /// What is known of the points; the same columns at all times.
    pub columns: Vec<Column>,
}

impl State {
    /// The number of points.
    pub fn points(&self) -> usize {
        let rows = |it: &Column| it.values.len() / it.shape.components(self.dimension);
        self.columns.first().map_or(0, rows)
    }
}

/// Where the points of a state are, and between which of them there are cells.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Present positions, those of a point together.
    pub position: &'a [f64],
    /// The cells; where there are none, each point is a vertex.
    pub cells: &'a Cells,
}
