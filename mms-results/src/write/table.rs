//! A table in CSV: a line for each point at each time. Numbers have the fewest digits that read back as the same number.

use std::fmt::Write as _;
use std::io;

use super::{ArrayShape, Column, State};
use crate::names::Axes;

/// Letters of axes.
fn letters(axes: Axes) -> [&'static str; 3] {
    match axes {
        Axes::Cartesian => ["x", "y", "z"],
        Axes::Axisymmetric { .. } => ["r", "z", "t"],
    }
}

/// Writes states with the same columns, one below the other.
///
/// # Errors
/// Errors of the writer.
pub fn csv(states: &[&State], out: &mut dyn io::Write) -> io::Result<()> {
    let Some(first) = states.first() else { return Ok(()) };
    let names = first.columns.iter().flat_map(|column| names(column, first));
    let header: Vec<String> = std::iter::once("time".to_owned()).chain(names).collect();
    out.write_all(format!("{}\n", header.join(",")).as_bytes())?;
    states.iter().try_for_each(|state| lines(state, out))
}

fn lines(state: &State, out: &mut dyn io::Write) -> io::Result<()> {
    let sizes = state.columns.iter().map(|column| column.shape.components(state.dimension));
    let sizes: Vec<usize> = sizes.collect();
    let time = format!("{:?}", state.time);
    let mut line = String::new();
    for row in 0..state.points() {
        line.clone_from(&time);
        for (column, &size) in state.columns.iter().zip(&sizes) {
            for value in &column.values[row * size..][..size] {
                // Writing to a `String` cannot fail.
                let _ = match column.shape {
                    ArrayShape::Whole => write!(line, ",{value}"),
                    _ => write!(line, ",{value:?}"),
                };
            }
        }
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// The names of the columns of numbers: X, Y and x, y for positions, u_x, F_xy for others, and without axes in one dimension;
/// for an axisymmetric field R, Z and r, z, u_r, F_rz.
fn names(column: &Column, state: &State) -> Vec<String> {
    let name = &column.name;
    let is_spatial = matches!(column.shape, ArrayShape::Three | ArrayShape::Nine);
    let rows = if is_spatial { 3 } else { state.dimension };
    let letters = letters(state.axes);
    let axes = || letters[..rows].iter();
    match (column.shape, name.as_str()) {
        (ArrayShape::Vector, "X") => axes().map(|axis| axis.to_uppercase()).collect(),
        (ArrayShape::Vector, "x") => axes().map(|axis| (*axis).to_owned()).collect(),
        (ArrayShape::Scalar | ArrayShape::Whole, _) => vec![name.clone()],
        _ if rows == 1 => vec![name.clone()],
        (ArrayShape::Vector | ArrayShape::Three, _) => {
            axes().map(|axis| format!("{name}_{axis}")).collect()
        }
        (ArrayShape::Tensor | ArrayShape::Nine, _) => {
            axes().flat_map(|i| axes().map(move |j| format!("{name}_{i}{j}"))).collect()
        }
    }
}
