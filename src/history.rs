//! What every step of a run led to, as a CSV file.
//!
//! Rows are kept until a checkpoint or the end, and the file is replaced as a whole then. What is no plain file, as a FIFO,
//! gets them at the end alone.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use mms_runtime::study::{Balance, Record};

use crate::report::file::is_stream;
use crate::report::write_whole;

/// The names of components.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The steps of a run so far.
pub struct History {
    path: PathBuf,
    /// Rows of texts, the names first.
    rows: Vec<Vec<String>>,
}

impl History {
    /// A history in `dimension` dimensions, for a file in a folder that is there; with the rows of the file up
    /// to a step that the run goes on from.
    ///
    /// # Errors
    /// A file that cannot be written, or that lacks such rows.
    pub fn new(path: &Path, dimension: usize, step: usize) -> anyhow::Result<Self> {
        let history = Self { path: path.to_owned(), rows: vec![names(dimension)] };
        if step == 0 {
            // Said before any work is done.
            history.keep().with_context(|| format!("`--history {}`", path.display()))?;
            return Ok(history);
        }
        history.from(step)
    }

    /// Takes the rows of the file up to a step.
    fn from(mut self, step: usize) -> anyhow::Result<Self> {
        let shown = self.path.display().to_string();
        let lacks = || {
            format!(
                "`--history {shown}`: it does not hold the {step} steps before the checkpoint; name \
                 the file that the run wrote, or none"
            )
        };
        if is_stream(&self.path) {
            bail!(lacks());
        }
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_path(&self.path)
            .with_context(lacks)?;
        for (number, row) in reader.records().take(step + 1).enumerate() {
            let row: Vec<String> = row.with_context(lacks)?.iter().map(str::to_owned).collect();
            let fits = match number {
                0 => row == self.rows[0],
                number => row.first() == Some(&number.to_string()),
            };
            if !fits {
                bail!(lacks());
            }
            if number > 0 {
                self.rows.push(row);
            }
        }
        if self.rows.len() != step + 1 {
            bail!(lacks());
        }
        Ok(self)
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
        self.rows.push(row);
    }

    /// Writes the rows so far, unless what was written could not be replaced.
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
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in &self.rows {
            writer.write_record(row)?;
        }
        let content = String::from_utf8(writer.into_inner()?)?;
        write_whole(&self.path, &content)
            .with_context(|| format!("cannot write `{}`", self.path.display()))
    }
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
