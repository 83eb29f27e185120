//! Files of states, in the format of their extension.

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::Context as _;
use mms_exact::Exact;
use mms_files::write::pretty;
use mms_files::write::refuse_link;
use mms_files::write::write_with;
use mms_results::Cells;
use mms_results::write::{self, Mesh, State};
use mms_spec::foreign;
use mms_spec::quantity::Quantity;

use crate::domain::Domain;
use crate::points::Points;
use crate::{Names, Wanted};

/// A file to write, or several with one stem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    path: PathBuf,
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Csv,
    Vtu,
    Npz,
}

impl FromStr for Target {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let path = PathBuf::from(text);
        let ending = path.extension().map(|it| it.to_string_lossy().to_lowercase());
        let format = match ending.as_deref() {
            Some("csv") => Format::Csv,
            Some("vtu") => Format::Vtu,
            Some("npz") => Format::Npz,
            _ => return Err("expected a file that ends in .csv, .vtu or .npz"),
        };
        Ok(Target { path, format })
    }
}

/// A state, and its mesh.
pub struct Frame {
    /// The state.
    pub state: State,
    /// x.
    pub position: Vec<f64>,
    /// The cells.
    pub cells: Cells,
    /// The source of the points.
    pub how: String,
}

impl Frame {
    /// The exact state at points X.
    ///
    /// # Errors
    /// A quantity that is not finite somewhere.
    pub fn new(
        wanted: &Wanted<'_>,
        exact: &mut Exact,
        points: &Points,
        time: f64,
    ) -> anyhow::Result<Self> {
        let state = wanted.state(exact, points, time)?;
        let position = exact.values(Quantity::Position, time, &points.reference)?;
        Ok(Frame { state, position, cells: points.cells.clone(), how: points.how.clone() })
    }
}

impl Target {
    /// The path of the file, from which the names of several files are made.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The kind of names of the columns.
    pub fn names(&self) -> Names {
        match self.format {
            Format::Csv | Format::Npz => Names::Symbols,
            Format::Vtu => Names::Words,
        }
    }

    /// Writes the states of all times, refusing links: a table as one file, other formats as one file for each time, with a
    /// list of the files in VTK. The data of the field are stored in the files; for a table, which has no place for them, in a
    /// file beside it. Returns the files, the one to open first.
    ///
    /// # Errors
    /// A file that cannot be written, by its name.
    pub fn write(&self, frames: &[Frame], domain: &Domain) -> anyhow::Result<Vec<String>> {
        match (self.format, frames) {
            (Format::Csv, _) => {
                let states: Vec<&State> = frames.iter().map(|frame| &frame.state).collect();
                let written = self.one(&self.path, |out| Ok(write::csv(&states, out)?))?;
                Ok(vec![written, self.beside(domain)?])
            }
            (_, [frame]) => Ok(vec![self.frame(&self.path, frame)?]),
            _ => self.several(frames),
        }
    }

    /// Writes the data of the field beside a table.
    fn beside(&self, domain: &Domain) -> anyhow::Result<String> {
        let mut name = self.path.file_name().unwrap_or_default().to_owned();
        name.push(".json");
        let path = self.path.with_file_name(name);
        let text = pretty(&domain.document())?;
        self.one(&path, |out| Ok(out.write_all(text.as_bytes())?))
    }

    fn several(&self, frames: &[Frame]) -> anyhow::Result<Vec<String>> {
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let ending = self.path.extension().unwrap_or_default().to_string_lossy();
        let mut times = Vec::new();
        let mut written = Vec::new();
        for (at, frame) in frames.iter().enumerate() {
            let name = format!("{stem}_{at:04}.{ending}");
            written.push(self.frame(&self.path.with_file_name(&name), frame)?);
            times.push((frame.state.time, name));
        }
        if self.format == Format::Vtu {
            let list = list(&times);
            let path = self.path.with_extension("pvd");
            written.insert(0, self.one(&path, |out| Ok(out.write_all(list.as_bytes())?))?);
        }
        Ok(written)
    }

    fn frame(&self, path: &Path, frame: &Frame) -> anyhow::Result<String> {
        let Frame { state, position, cells, .. } = frame;
        self.one(path, |out| match self.format {
            Format::Npz => Ok(write::npz(state, out)?),
            _ => Ok(write::vtu(state, Mesh { position, cells }, out)?),
        })
    }

    fn one(
        &self,
        path: &Path,
        write: impl FnOnce(&mut BufWriter<&mut File>) -> anyhow::Result<()>,
    ) -> anyhow::Result<String> {
        let shown = foreign::path(path);
        let written = refuse_link(path, "file").and_then(|()| {
            write_with(path, |file| {
                let mut out = BufWriter::new(file);
                write(&mut out)?;
                Ok(out.flush()?)
            })
        });
        written.with_context(|| format!("cannot write `{shown}`"))?;
        Ok(shown)
    }
}

/// The text of a `.pvd` file, which lists files of one mesh at times.
pub fn list(written: &[(f64, String)]) -> String {
    let mut text = write::head("Collection");
    text += "<Collection>\n";
    for (time, file) in written {
        let file = attribute(file);
        text += &format!("<DataSet timestep=\"{time:.16e}\" file=\"{file}\"/>\n");
    }
    text + "</Collection>\n</VTKFile>\n"
}

/// Escapes a text for the value of an attribute.
fn attribute(text: &str) -> String {
    foreign::markup(text).replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
