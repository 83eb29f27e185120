//! Arrays of NumPy in one file, as `numpy.savez` writes them: `time`, a double precision array for each column, whose first
//! axis is the points, and the properties of the whole, words as bytes ("NEP 1, a simple file format for NumPy arrays").

use std::io::{self, Write};

use rawzip::{CompressionMethod, ZipArchiveWriter};

use super::{ArrayShape, Column, Fact, State, Value};

/// The bytes of magic, version and length at the start of a header, which is padded to a multiple of 64.
const START: usize = 10;

/// Writes a state.
///
/// # Errors
/// Errors of the writer.
pub fn npz(state: &State, out: &mut dyn Write) -> io::Result<()> {
    let mut archive = ZipArchiveWriter::new(out);
    member(&mut archive, "time", ("<f8", ""), [state.time.to_le_bytes()])?;
    for column in &state.columns {
        let (axes, values) = (axes(column, state.dimension), column.values.iter());
        let whole = || values.clone().map(|value| (*value as i64).to_le_bytes());
        match column.shape {
            ArrayShape::Whole => member(&mut archive, &column.name, ("<i8", &axes), whole())?,
            _ => {
                let bytes = values.map(|value| value.to_le_bytes());
                member(&mut archive, &column.name, ("<f8", &axes), bytes)?;
            }
        }
    }
    for Fact { name, value } in &state.facts {
        match value {
            Value::Numbers(numbers) => {
                let axes = format!("{},", numbers.len());
                let bytes = numbers.iter().map(|value| value.to_le_bytes());
                member(&mut archive, name, ("<f8", &axes), bytes)?;
            }
            Value::Word(word) => {
                member(&mut archive, name, (&format!("|S{}", word.len()), ""), [word])?;
            }
        }
    }
    archive.finish().map_err(io::Error::other)?;
    Ok(())
}

/// The lengths of the axes, as inside a tuple of Python.
fn axes(column: &Column, dimension: usize) -> String {
    let rows = column.values.len() / column.shape.components(dimension);
    match column.shape {
        ArrayShape::Scalar | ArrayShape::Whole => format!("{rows},"),
        ArrayShape::Vector => format!("{rows}, {dimension}"),
        ArrayShape::Tensor => format!("{rows}, {dimension}, {dimension}"),
        ArrayShape::Three => format!("{rows}, 3"),
        ArrayShape::Nine => format!("{rows}, 3, 3"),
    }
}

fn member(
    archive: &mut ZipArchiveWriter<&mut dyn Write>,
    name: &str,
    (kind, axes): (&str, &str),
    values: impl IntoIterator<Item: AsRef<[u8]>>,
) -> io::Result<()> {
    let path = format!("{name}.npy");
    let file = archive.new_file(path.as_str()).compression_method(CompressionMethod::STORE);
    let file = file.start();
    let (mut entry, config) = file.map_err(io::Error::other)?;
    let mut writer = config.wrap(io::BufWriter::new(&mut entry));
    writer.write_all(&header(kind, axes))?;
    values.into_iter().try_for_each(|value| writer.write_all(value.as_ref()))?;
    let (mut buffered, sums) = writer.finish().map_err(io::Error::other)?;
    buffered.flush()?;
    drop(buffered);
    entry.finish(sums).map_err(io::Error::other)?;
    Ok(())
}

fn header(kind: &str, axes: &str) -> Vec<u8> {
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({axes}), }}");
    let length = (START + text.len() + 1).next_multiple_of(64) - START;
    text += &" ".repeat(length - text.len() - 1);
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(text.into_bytes());
    bytes
}
