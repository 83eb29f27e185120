//! An unstructured grid of VTK in XML ("VTK File Formats", Kitware, 2023), with numbers in base64. Vectors have three
//! components and tensors nine; components that a dimension lacks are 0.

use std::borrow::Cow;
use std::io::{self, Write};

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;

use super::{ArrayShape, Fact, Mesh, State, Value};
use crate::Cells;

/// The type number of a vertex.
const VERTEX: u8 = 1;

/// The beginning of a file, before its content.
pub fn head(kind: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
    )
}

/// Writes a state of a mesh.
///
/// # Errors
/// Errors of the writer.
pub fn vtu(state: &State, mesh: Mesh<'_>, out: &mut dyn Write) -> io::Result<()> {
    let dimension = state.dimension;
    let points = state.points();
    let cells = or_vertices(mesh.cells, points);
    writeln!(out, "{}<UnstructuredGrid>", head("UnstructuredGrid"))?;
    // All digits: fewer would mean that the time is less precise.
    writeln!(
        out,
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
         format=\"ascii\">{:.16e}</DataArray>",
        state.time
    )?;
    state.facts.iter().try_for_each(|it| fact(it, out))?;
    out.write_all(b"</FieldData>\n")?;
    writeln!(out, r#"<Piece NumberOfPoints="{points}" NumberOfCells="{}">"#, cells.len())?;
    out.write_all(b"<PointData>\n")?;
    for column in &state.columns {
        numbers(&column.name, column.shape, &column.values, dimension, out)?;
    }
    out.write_all(b"</PointData>\n<Points>\n")?;
    let is_spatial = mesh.position.len() == 3 * points;
    let shape = if is_spatial { ArrayShape::Three } else { ArrayShape::Vector };
    numbers("position", shape, mesh.position, dimension, out)?;
    out.write_all(b"</Points>\n<Cells>\n")?;
    let whole = |values: &[usize]| -> Vec<u8> {
        values.iter().flat_map(|value| (*value as u64).to_le_bytes()).collect()
    };
    array("UInt64", "connectivity", 1, &whole(&cells.points), out)?;
    array("UInt64", "offsets", 1, &whole(&cells.ends), out)?;
    array("UInt8", "types", 1, &cells.types, out)?;
    out.write_all(b"</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")
}

/// Field data: a word is written as the numbers of its letters, and 0.
fn fact(Fact { name, value }: &Fact, out: &mut dyn Write) -> io::Result<()> {
    let (kind, count, text) = match value {
        Value::Numbers(numbers) => {
            let text = numbers.iter().map(|it| format!("{it:?}")).collect::<Vec<_>>();
            ("Float64", numbers.len(), text.join(" "))
        }
        Value::Word(word) => {
            let letters = word.bytes().chain([0]).map(|it| it.to_string());
            ("String", 1, letters.collect::<Vec<_>>().join(" "))
        }
    };
    writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfTuples=\"{count}\" format=\"ascii\">{text}</DataArray>"
    )
}

fn or_vertices(cells: &Cells, points: usize) -> Cow<'_, Cells> {
    if !cells.is_empty() {
        return Cow::Borrowed(cells);
    }
    Cow::Owned(Cells {
        types: vec![VERTEX; points],
        points: (0..points).collect(),
        ends: (1..=points).collect(),
    })
}

fn numbers(
    name: &str,
    shape: ArrayShape,
    values: &[f64],
    dimension: usize,
    out: &mut dyn Write,
) -> io::Result<()> {
    let bytes = |values: &[f64]| values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let (kind, components, bytes): (_, _, Vec<u8>) = match shape {
        ArrayShape::Scalar => ("Float64", 1, bytes(values)),
        ArrayShape::Three => ("Float64", 3, bytes(values)),
        ArrayShape::Nine => ("Float64", 9, bytes(values)),
        ArrayShape::Vector => ("Float64", 3, bytes(&padded(values, dimension, [1, 3]))),
        ArrayShape::Tensor => ("Float64", 9, bytes(&padded(values, dimension, [dimension, 9]))),
        ArrayShape::Whole => {
            let bytes = values.iter().flat_map(|value| (*value as u64).to_le_bytes());
            ("UInt64", 1, bytes.collect())
        }
    };
    array(kind, name, components, &bytes, out)
}

/// Vectors (one row) or tensors with `dimension` components per row, padded with 0 to the `size` components (3 or 9) that VTK
/// expects.
fn padded(values: &[f64], dimension: usize, [rows, size]: [usize; 2]) -> Vec<f64> {
    let mut all = Vec::with_capacity(values.len() / (dimension * rows) * size);
    for tensor in values.chunks(dimension * rows) {
        let start = all.len();
        all.resize(start + size, 0.0);
        for (row, components) in tensor.chunks(dimension).enumerate() {
            all[start + 3 * row..][..dimension].copy_from_slice(components);
        }
    }
    all
}

/// A named array of numbers: the number of bytes, and the bytes.
fn array(
    kind: &str,
    name: &str,
    components: usize,
    bytes: &[u8],
    out: &mut dyn Write,
) -> io::Result<()> {
    write!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">"
    )?;
    let mut encoder = EncoderWriter::new(&mut *out, &STANDARD);
    encoder.write_all(&(bytes.len() as u64).to_le_bytes())?;
    encoder.write_all(bytes)?;
    encoder.finish()?;
    drop(encoder);
    out.write_all(b"</DataArray>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_components_are_zero() {
        assert_eq!(padded(&[1.0, 2.0], 1, [1, 3]), [1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        let lonely = padded(&[1.0, 2.0], 1, [1, 9]);
        assert_eq!(
            (lonely.len(), lonely[0], lonely[9], lonely.iter().sum::<f64>()),
            (18, 1.0, 2.0, 3.0)
        );
        assert_eq!(
            padded(&[1.0, 2.0, 3.0, 4.0], 2, [2, 9]),
            [1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0]
        );
    }
}
