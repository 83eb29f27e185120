//! The quantities of every step of a run, as a CSV file.
//!
//! Rows are kept until a checkpoint or the end; then the whole file is replaced. A file that is not plain, such as a FIFO, gets
//! them only at the end.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use mms_files::read;
use mms_files::write::is_stream;
use mms_files::write::write_whole;
use mms_runtime::study::{Balance, Record};
use mms_spec::foreign;
use serde::{Deserialize, Serialize};

/// The names of components.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The steps of a run so far.
pub struct History {
    path: PathBuf,
    /// Lines, the names first.
    text: String,
}

/// The identity of the rows that were written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// The length of the rows.
    bytes: u64,
    /// The CRC-32 of the rows.
    checksum: u32,
}

impl History {
    /// A history in `dimension` dimensions, for a file in a folder that is there.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn new(path: &Path, dimension: usize) -> anyhow::Result<Self> {
        let history = Self { path: path.to_owned(), text: line(&names(dimension)) };
        // Fails before any work is done.
        history.keep().with_context(|| option(path))?;
        Ok(history)
    }

    /// The history of a run that resumes after a step: the rows of the file up to it, if they are the rows that the run wrote.
    ///
    /// # Errors
    /// A file that lacks such rows, or where they were changed.
    pub fn from(path: &Path, step: usize, mark: Option<Mark>) -> anyhow::Result<Self> {
        let name = "name the file that the run wrote, or none";
        let lacks = || {
            let option = option(path);
            format!("{option}: it does not hold the {step} steps before the checkpoint; {name}")
        };
        let Some(Mark { bytes, checksum }) = mark else { bail!(lacks()) };
        let rows = read::first(path, bytes).with_context(lacks)?;
        if (rows.len() as u64) < bytes {
            bail!(lacks());
        }
        match String::from_utf8(rows) {
            Ok(text) if crc32fast::hash(text.as_bytes()) == checksum => {
                Ok(Self { path: path.to_owned(), text })
            }
            _ => bail!(
                "{}: its rows up to step {step} are not those that were written before the checkpoint, and were \
                 changed since; {name}",
                option(path)
            ),
        }
    }

    /// Adds a step.
    pub fn push(&mut self, record: &Record) {
        let Record { step, time, displacement, diagnostics } = record;
        let Balance { time: of, kinetic_energy, strain_energy, body_work, energy_residual, .. } =
            diagnostics.balance.clone().unwrap_or_default();
        let force = diagnostics.balance.as_ref().map(|it| it.surface_force.clone());
        let mut row = vec![step.to_string()];
        let mut push = |number: Option<f64>| row.push(number.map_or_else(String::new, text));
        for number in [*time, displacement.l1, displacement.l2, displacement.linf] {
            push(Some(number));
        }
        diagnostics.jacobian.into_iter().for_each(|number| push(Some(number)));
        push(Some(diagnostics.mass));
        diagnostics.momentum.iter().for_each(|&number| push(Some(number)));
        force.unwrap_or_default().into_iter().for_each(|number| push(Some(number)));
        [Some(of), Some(kinetic_energy), strain_energy, Some(body_work), energy_residual]
            .into_iter()
            .for_each(push);
        self.text += &line(&row);
    }

    /// The identity of the rows so far.
    pub fn mark(&self) -> Mark {
        Mark { bytes: self.text.len() as u64, checksum: crc32fast::hash(self.text.as_bytes()) }
    }

    /// Writes the rows so far, unless the file is a stream, which cannot be replaced.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn keep(&self) -> anyhow::Result<()> {
        if is_stream(&self.path) { Ok(()) } else { self.write() }
    }

    /// Writes all rows.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self) -> anyhow::Result<()> {
        write_whole(&self.path, &self.text)
            .with_context(|| format!("cannot write `{}`", foreign::path(&self.path)))
    }
}

/// The option that names the file.
fn option(path: &Path) -> String {
    format!("`--history {}`", foreign::path(path))
}

/// Numbers and names, none of which needs quotes.
fn line(row: &[String]) -> String {
    row.join(",") + "\n"
}

/// All digits that a number has.
fn text(number: f64) -> String {
    format!("{number:e}")
}

/// The names of the columns.
fn names(dimension: usize) -> Vec<String> {
    let components = |name: &str| {
        AXES[..dimension].iter().map(|axis| format!("{name}_{axis}")).collect::<Vec<_>>()
    };
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
    [
        words(&["step", "time", "displacement_l1", "displacement_l2", "displacement_linf"]),
        words(&["jacobian_least", "jacobian_greatest", "mass"]),
        components("momentum"),
        components("surface_force"),
        words(&["time_of_energies", "kinetic_energy", "strain_energy", "body_work"]),
        words(&["energy_residual"]),
    ]
    .concat()
}
