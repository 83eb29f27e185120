//! Deliberate mistakes (fault injection), and the rows that must catch them.
//!
//! A suite that does not fail for a seeded defect is no verification suite. Each defect is switched on for the whole process,
//! and the quick levels of the rows that list it under `catches` are run; all rows are run if none lists it, or with
//! `--all-rows`. First the same rows are run without a defect: an unexpected verdict ends the command. Then each row must catch
//! every defect that it lists. If all rows were run with all defects, each row must also catch a defect that at most six rows
//! catch, or have a `witness`: a property that no other row tests. Results are kept in a folder of their own in the store.
//! Beside the verdicts, plausibility checks inspect each run as people do ([`plausibility`](mms_lab::plausibility)).

mod visual;

use std::num::NonZero;

use anyhow::ensure;
use mms_files::store::Store;
use mms_lab::outcome::SolverOutcome;
use mms_lab::plausibility::Objections;
use mms_mechanics::defect as compiler;
use mms_options::field::{find, interpreted};
use mms_runtime::defect as solver;
use mms_spec::suggest::did_you_mean;
use visual::{VisualInspection, Watched};

use super::matrix::MatrixRow;
use super::plan::RunPlan;
use super::verdict::{Judgement, judge};
use super::work::{Fields, Watcher, outcomes};

/// A deliberate mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// A defect of `mms-runtime`.
    Solver(solver::Defect),
    /// A defect of `mms-codegen`: fields are compiled anew, and interpreted.
    Compiler(compiler::Defect),
}

impl Defect {
    /// All defects.
    pub fn all() -> impl Iterator<Item = Self> {
        let of_compiler = compiler::Defect::ALL.iter().map(|&defect| Defect::Compiler(defect));
        of_compiler.chain(solver::Defect::ALL.iter().map(|&defect| Defect::Solver(defect)))
    }

    /// The name that users write.
    pub fn name(self) -> &'static str {
        match self {
            Defect::Solver(defect) => defect.name(),
            Defect::Compiler(defect) => defect.name(),
        }
    }

    /// A description of the mistake.
    pub fn what(self) -> &'static str {
        match self {
            Defect::Solver(defect) => defect.what(),
            Defect::Compiler(defect) => defect.what(),
        }
    }

    /// The place of the mistake.
    pub fn place(self) -> &'static str {
        match self {
            Defect::Solver(_) => "solver",
            Defect::Compiler(_) => "compiler",
        }
    }

    /// The defects with these names; all, if there are none.
    ///
    /// # Errors
    /// A name that no defect has.
    pub fn named(names: &[String]) -> anyhow::Result<Vec<Self>> {
        for name in names {
            let known = Self::all().map(Self::name);
            let near = did_you_mean(name, known).map(|near| format!("; did you mean `{near}`?"));
            let is_known = Self::all().any(|defect| defect.name() == name);
            ensure!(is_known, "`--defects={name}`: no such defect{}", near.unwrap_or_default());
        }
        let asked = |defect: &Self| names.is_empty() || names.iter().any(|it| it == defect.name());
        Ok(Self::all().filter(asked).collect())
    }
}

/// Refuses rows that list a defect that does not exist.
///
/// # Errors
/// The row, and the name.
pub fn validate(rows: &[MatrixRow]) -> anyhow::Result<()> {
    for row in rows {
        for name in &row.catches {
            let is_known = Defect::all().any(|defect| defect.name() == name);
            ensure!(is_known, "row `{}` catches `{name}`: no such defect", row.name);
        }
    }
    Ok(())
}

/// A guard: the process makes a mistake until it is dropped.
struct ActiveDefect;

impl ActiveDefect {
    fn new(defect: Option<Defect>) -> Self {
        match defect {
            Some(Defect::Solver(defect)) => solver::select(Some(defect)),
            Some(Defect::Compiler(defect)) => compiler::select(Some(defect)),
            None => {}
        }
        ActiveDefect
    }
}

impl Drop for ActiveDefect {
    fn drop(&mut self) {
        solver::select(None);
        compiler::select(None);
    }
}

/// The results of a row, with a defect or without one.
pub struct RowResult<'a> {
    /// The row.
    pub row: &'a MatrixRow,
    /// The verdict.
    pub judgement: Judgement,
    /// The objections of the plausibility checks to the runs of the row.
    pub objections: Objections,
}

/// The setup of runs of rows with defects.
pub struct DefectRuns<'a> {
    /// The identity of this program.
    pub program: String,
    /// The results of this command, with and without a defect; other commands do not use them.
    pub store: Store,
    /// The number of runs at the same time.
    pub threads: NonZero<usize>,
    /// The receiver of messages.
    pub watcher: &'a dyn Watcher,
}

impl DefectRuns<'_> {
    /// Runs the quick levels of some rows, with a mistake in the program or without one, and returns their verdicts.
    ///
    /// # Errors
    /// The store cannot be read or written.
    pub fn run_rows<'a>(
        &self,
        defect: Option<Defect>,
        rows: &[&'a MatrixRow],
    ) -> anyhow::Result<Vec<RowResult<'a>>> {
        let mut plan = RunPlan::new(rows, true, &self.program)?;
        let coarsest: Vec<usize> =
            plan.levels.iter().filter_map(|levels| levels.first().copied()).collect();
        for (at, job) in plan.jobs.iter_mut().enumerate() {
            job.key.defect = Some(defect.map_or("none", Defect::name));
            if coarsest.contains(&at) {
                job.key.run += visual::WEIGHED;
            }
        }
        let fields = Fields::new(match defect {
            Some(Defect::Compiler(_)) => interpreted,
            _ => find,
        });
        let runner = VisualInspection { fields };
        let _active = ActiveDefect::new(defect);
        let all = outcomes(&plan.jobs, &self.store, self.threads, &runner, self.watcher)?;
        let shown = rows.iter().zip(&plan.levels).map(|(row, levels)| {
            let levels: Vec<&Watched> = levels.iter().map(|&at| &all[at]).collect();
            let outcomes: Vec<SolverOutcome> =
                levels.iter().map(|level| level.outcome.clone()).collect();
            let seen: Vec<_> = levels.iter().map(|level| level.seen.as_ref()).collect();
            RowResult { row, judgement: judge(row, &outcomes), objections: Objections::of(&seen) }
        });
        Ok(shown.collect())
    }
}
