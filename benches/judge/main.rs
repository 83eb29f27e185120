//! Times judging against reading: `cargo bench --bench judge`, or with another number of points, `-- 1000000`.
//!
//! Files of NumPy and of VTK with raw data contain X and u of points in the unit square. The bench runs `mms judge` on each.
//! Judging may take at most three times as long as reading the file into arrays, and four times the memory of these arrays,
//! to which the bench limits it. The table marks a row that exceeds this. Times are CPU times, the least of some rounds, since
//! other programs make nothing faster.

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::process::Command;

use cpu_time::ProcessTime;
use mms_results::names::{Axes, KNOWN, everything};
use mms_results::write::{ArrayShape, Column, State, npz};

/// The default number of points.
const POINTS: usize = 10_000_000;

/// The number of rounds of each measurement.
const ROUNDS: usize = 3;

/// The bytes of address space of the program and its libraries.
const PROGRAM: usize = 256 << 20;

/// A sequence of different fractions that fills [0, 1) evenly.
fn fraction(at: usize, step: f64) -> f64 {
    (at as f64 * step).fract()
}

fn state(points: usize) -> State {
    let of = |steps: [f64; 2], scale: f64| -> Vec<f64> {
        (0..points).flat_map(|at| steps.map(|step| scale * fraction(at, step))).collect()
    };
    let column =
        |name: &str, values| Column { name: name.into(), shape: ArrayShape::Vector, values };
    let golden = 1.618_033_988_749_895;
    let columns = vec![
        column("X", of([golden, 2.0_f64.sqrt()], 1.0)),
        column("u", of([3.0_f64.sqrt(), golden], 1e-3)),
    ];
    State { time: 0.02, dimension: 2, axes: Axes::Cartesian, facts: Vec::new(), columns }
}

/// Writes VTK with raw data behind the XML, as ParaView does: vectors have three components, and each point is a vertex.
fn vtu(state: &State, path: &Path) -> std::io::Result<usize> {
    let points = state.columns[0].values.len() / 2;
    let solid = |values: &[f64]| -> Vec<u8> {
        values.chunks(2).flat_map(|it| [it[0], it[1], 0.0]).flat_map(f64::to_le_bytes).collect()
    };
    let whole = |from: usize| -> Vec<u8> {
        (from..from + points).flat_map(|it| (it as i64).to_le_bytes()).collect()
    };
    let arrays = [
        (
            "<PointData>",
            "</PointData>",
            "Float64",
            "displacement",
            3,
            solid(&state.columns[1].values),
        ),
        ("<Points>", "</Points>", "Float64", "Points", 3, solid(&state.columns[0].values)),
        ("<Cells>", "", "Int64", "connectivity", 1, whole(0)),
        ("", "", "Int64", "offsets", 1, whole(1)),
        ("", "</Cells>", "UInt8", "types", 1, vec![1; points]),
    ];
    let mut out = BufWriter::new(File::create(path)?);
    write!(
        out,
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\
         <UnstructuredGrid><FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" format=\"ascii\">{:.16e}</DataArray>\
         </FieldData><Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{points}\">",
        state.time
    )?;
    let mut offset = 0;
    for (start, end, kind, name, components, bytes) in &arrays {
        write!(
            out,
            "{start}<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>{end}"
        )?;
        offset += 8 + bytes.len();
    }
    write!(out, "</Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_")?;
    for (.., bytes) in &arrays {
        out.write_all(&(bytes.len() as u64).to_le_bytes())?;
        out.write_all(bytes)?;
    }
    write!(out, "</AppendedData></VTKFile>")?;
    out.flush()?;
    Ok(offset)
}

fn least(work: impl FnMut() -> f64) -> f64 {
    std::iter::repeat_with(work).take(ROUNDS).fold(f64::INFINITY, f64::min)
}

/// The CPU seconds of the programs that a shell has run, from the output of its `times`: a line for the shell, and one for the
/// programs, each with user and system time as `0m1.25s`.
fn seconds(times: &str) -> Option<f64> {
    let of = |text: &str| -> Option<f64> {
        let (minutes, seconds) = text.strip_suffix('s')?.split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
    };
    times.lines().last()?.split(' ').map(of).sum()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points = std::env::args().filter_map(|it| it.parse().ok()).next().unwrap_or(POINTS);
    let folder = tempfile::tempdir()?;
    let state = state(points);
    let [numpy, vtk] = ["u.npz", "u.vtu"].map(|name| folder.path().join(name));
    npz(&state, &mut BufWriter::new(File::create(&numpy)?))?;
    let in_vtk = vtu(&state, &vtk)?;
    drop(state);
    println!("{points} points\nfile   arrays MB  read s  judge s  ratio  in 4 x arrays");
    for (path, arrays) in [(&numpy, 32 * points), (&vtk, in_vtk)] {
        let read = least(|| {
            let begun = ProcessTime::now();
            let bytes = std::fs::read(path).unwrap_or_default();
            mms_results::parse(&bytes, &everything(&KNOWN))
                .map(drop)
                .unwrap_or_else(|mistake| panic!("{mistake}"));
            begun.elapsed().as_secs_f64()
        });
        let judge = |limit: &str| -> Option<f64> {
            let words = format!(
                "{limit} \"$0\" judge axis_aligned_2d \"$1\" --map X=\"$2\" > \"$1.txt\"; \
                 grep -q 'no observed order' \"$1.txt\" && times"
            );
            let reference = if path == &numpy { "X" } else { "points" };
            let mut command = Command::new("sh");
            command.args(["-c", &words, env!("CARGO_BIN_EXE_mms")]).arg(path).arg(reference);
            let output = command.output().ok().filter(|output| output.status.success())?;
            seconds(std::str::from_utf8(&output.stdout).ok()?)
        };
        let judged = least(|| judge("").unwrap_or(f64::INFINITY));
        let is_small = judge(&format!("ulimit -v {};", (4 * arrays + PROGRAM) >> 10)).is_some();
        let ratio = judged / read;
        let mark = if is_small && ratio <= 3.0 { "" } else { "  more than it should be" };
        println!(
            "{:<6} {:>9.0} {read:>7.2} {judged:>8.2} {ratio:>6.2}  {}{mark}",
            path.extension().unwrap_or_default().to_string_lossy(),
            arrays as f64 / 1e6,
            if is_small { "yes" } else { "no" }
        );
    }
    Ok(())
}
