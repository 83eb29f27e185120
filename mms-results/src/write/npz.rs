//! Arrays of NumPy in one file, as `numpy.savez` writes them: `time` and a double precision array for each column, whose
//! first axis are the points ("NEP 1, a simple file format for NumPy arrays").

use std::io::{self, Write};

use rawzip::{CompressionMethod, ZipArchiveWriter};

use super::{Column, Shape, State};

/// Magic, version and length of a header are of so many bytes, which the header fills up to a multiple of 64.
const START: usize = 10;

/// Writes a state.
///
/// # Errors
/// What the writer says.
pub fn npz(state: &State, out: &mut dyn Write) -> io::Result<()> {
    let mut archive = ZipArchiveWriter::new(out);
    member(&mut archive, "time", "", &[state.time], false)?;
    for column in &state.columns {
        let is_whole = column.shape == Shape::Whole;
        let axes = axes(column, state.dimension);
        member(&mut archive, &column.name, &axes, &column.values, is_whole)?;
    }
    archive.finish().map_err(io::Error::other)?;
    Ok(())
}

/// The lengths of the axes, as Python writes the inside of a tuple.
fn axes(column: &Column, dimension: usize) -> String {
    let rows = column.values.len() / column.shape.components(dimension);
    match column.shape {
        Shape::Scalar | Shape::Whole => format!("{rows},"),
        Shape::Vector => format!("{rows}, {dimension}"),
        Shape::Tensor => format!("{rows}, {dimension}, {dimension}"),
    }
}

fn member(
    archive: &mut ZipArchiveWriter<&mut dyn Write>,
    name: &str,
    axes: &str,
    values: &[f64],
    is_whole: bool,
) -> io::Result<()> {
    let path = format!("{name}.npy");
    let file = archive.new_file(path.as_str()).compression_method(CompressionMethod::STORE);
    let file = file.start();
    let (mut entry, config) = file.map_err(io::Error::other)?;
    let mut writer = config.wrap(io::BufWriter::new(&mut entry));
    writer.write_all(&header(if is_whole { "<i8" } else { "<f8" }, axes))?;
    for value in values {
        let bytes = if is_whole { (*value as i64).to_le_bytes() } else { value.to_le_bytes() };
        writer.write_all(&bytes)?;
    }
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
