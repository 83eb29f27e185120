//! The rows of the matrix: the run, the expectation of theory, and its reason.

use anyhow::{Context as _, bail, ensure};
use mms_convergence::TOLERANCE;
use mms_exact::gallery::{self, Entry};
use mms_lab::outcome::{Norms, Quantity, SolverOutcome};
use mms_lab::rows::{Named, read};
use mms_options::Study;
use mms_runtime::Setup;
use serde::Deserialize;

/// The rows, in their order.
pub const MATRIX: &str = include_str!("matrix.toml");

/// A row as it is written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatrixRow {
    /// `group/mode`.
    pub name: String,
    /// The arguments of `mms study`, with all levels.
    pub study: String,
    /// The number of levels, from the coarsest on, that `--quick` runs; if it is 0, `--quick` leaves the row out.
    #[serde(default)]
    pub quick: usize,
    /// Refine the time step alone: the levels have the cells of the study, and its Courant number halved this
    /// many times, one after the other.
    #[serde(default)]
    pub halvings: usize,
    /// The quantity whose error is measured.
    #[serde(default)]
    pub quantity: Quantity,
    /// The order that theory expects.
    pub order: ExpectedConvergence,
    /// The expected order of linf, where it is lower.
    pub linf: Option<f64>,
    /// The tolerance of the observed order.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
    /// l2 over h^order, or over dt^order, at the finest level that `--quick` runs, or of all if it runs none; in
    /// the units of the field.
    pub constant: Option<f64>,
    /// The reason, and its source.
    pub theory: String,
    /// The deliberate mistakes that this row must catch; `--defects` runs the row with each of them.
    #[serde(default)]
    pub catches: Vec<String>,
    /// A property that no other row tests.
    pub witness: Option<String>,
}

/// The expectation of theory on the error.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub enum ExpectedConvergence {
    /// An error of this order.
    Order(f64),
    /// An error without an order.
    Word(Word),
}

/// The cases without an order.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Word {
    /// The error does not shrink, or the run stops.
    None,
    /// The only error is rounding.
    Exact,
}

impl std::fmt::Display for ExpectedConvergence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ExpectedConvergence::Order(order) => write!(f, "{order}"),
            ExpectedConvergence::Word(Word::None) => f.write_str("none"),
            ExpectedConvergence::Word(Word::Exact) => f.write_str("exact"),
        }
    }
}

fn tolerance() -> f64 {
    TOLERANCE
}

impl MatrixRow {
    /// The study, parsed.
    ///
    /// # Errors
    /// Arguments that `mms study` does not have, a field that is not of the gallery.
    pub fn study(&self) -> anyhow::Result<(Study, &'static Entry)> {
        let study = Study::read(&self.study)?;
        let entry = gallery::find(&study.field);
        let entry = entry.with_context(|| format!("no field `{}` in the gallery", study.field))?;
        Ok((study, entry))
    }

    /// The number of levels that are run.
    pub fn levels(&self, quick: bool) -> usize {
        let all = match self.halvings {
            0 => self.study().map_or(0, |(study, _)| study.cells.len()),
            halvings => halvings + 1,
        };
        if quick { self.quick.min(all) } else { all }
    }

    /// The arguments of `mms run` for a level, as text and parsed.
    ///
    /// # Errors
    /// As [`MatrixRow::study`]; cells that are no word of their own behind `--cells`.
    pub fn level(&self, level: usize) -> anyhow::Result<(String, Study)> {
        let (study, _) = self.study()?;
        let mut words: Vec<String> = self.study.split_whitespace().map(str::to_owned).collect();
        if self.halvings == 0 {
            let cells = words.iter().position(|word| word == "--cells").map(|at| at + 1);
            let cells = cells.and_then(|at| words.get_mut(at));
            *cells.context("cells have to be written as `--cells A,B,..`")? =
                study.cells[level].to_string();
        } else {
            let courant = Setup::default().courant / f64::powi(2.0, level as i32);
            words.extend(["--courant".to_owned(), courant.to_string()]);
        }
        let line = words.join(" ");
        let study = Study::read(&line)?;
        Ok((line, study))
    }
}

impl MatrixRow {
    /// The length that the row refines, for a run: h or dt.
    pub fn size(&self, outcome: &SolverOutcome) -> Option<f64> {
        let time_alone = self.halvings > 0;
        outcome.run().map(|run| if time_alone { run.time_step } else { run.cell_size })
    }

    /// The errors of a run that the row judges, if the run reached its end.
    pub fn errors(&self, outcome: &SolverOutcome) -> Option<Norms> {
        let SolverOutcome::Finished { errors, mean_velocity, .. } = outcome else { return None };
        let Quantity::MeanVelocity(exact) = &self.quantity else { return Some(*errors) };
        if mean_velocity.len() != exact.len() {
            return None;
        }
        let squares = mean_velocity.iter().zip(exact).map(|(v, exact)| (v - exact).powi(2));
        Some([squares.sum::<f64>().sqrt(); 3])
    }
}

impl Named for MatrixRow {
    fn name(&self) -> &str {
        &self.name
    }

    fn validate(&self) -> anyhow::Result<()> {
        let (study, _) = self.study()?;
        ensure!(self.halvings == 0 || study.cells.len() == 1, "halvings take one grid");
        let levels = self.levels(false);
        ensure!(levels >= 2 && self.quick <= levels && self.quick != 1, "too few levels");
        (0..levels).try_for_each(|level| self.level(level).map(drop))?;
        ensure!(
            self.tolerance > 0.0 && self.tolerance < 0.5,
            "the tolerance has to be in ]0, 0.5["
        );
        match (self.order, self.constant) {
            (ExpectedConvergence::Order(order), Some(constant)) => {
                ensure!(order >= 1.0 && constant > 0.0, "order and constant have to be positive");
            }
            (ExpectedConvergence::Order(_), None) => bail!("an order needs its error constant"),
            (ExpectedConvergence::Word(_), Some(_)) => bail!("a constant needs an order"),
            (ExpectedConvergence::Word(_), None) => {}
        }
        ensure!(!self.theory.is_empty(), "no theory");
        let earns_its_place = !self.catches.is_empty() || self.witness.is_some();
        ensure!(earns_its_place, "it catches no defect, and is the witness of nothing");
        ensure!(self.catches.is_empty() || self.quick > 0, "defects are shown to `--quick` alone");
        Ok(())
    }
}

/// The rows of the matrix.
///
/// # Errors
/// A row without a meaning; a test reads them all.
pub fn rows() -> anyhow::Result<Vec<MatrixRow>> {
    read(MATRIX)
}
