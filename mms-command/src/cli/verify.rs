//! `mms verify`: the verification matrix.

#[cfg(feature = "defects")]
mod seeded;

use std::io::IsTerminal as _;
use std::num::NonZero;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::bail;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mms_exact::gallery::FIELDS;
use mms_files::program::identity;
use mms_files::store::{Store, digest};
use mms_files::write::{pretty, write_files};
use mms_lab::rows::Named as _;
use mms_options::field::find;
use mms_report::Shown;
use mms_report::verify::{JudgedRow, List, Report};
use mms_spec::suggest::advice;
use mms_verify::matrix::{MATRIX, MatrixRow, rows};
use mms_verify::plan::{Job, RunPlan};
use mms_verify::verdict::judge;
use mms_verify::work::{Fields, Watcher, outcomes};

use super::format::Printing;
use super::{CommandOutcome, print, say, this_command, validate_output};
use crate::provenance;

/// Run the verification matrix: test each mode of the built-in solver on a field that isolates it, and compare each verdict
/// with theory.
///
/// Results are stored as runs finish. After an interruption, the same command continues from the store; a newly built program
/// starts again. Several processes may share a store.
#[derive(Args)]
pub struct Verify {
    /// Run fewer levels and rows: within a minute on two processors, where the whole matrix takes some minutes.
    #[arg(long)]
    quick: bool,
    /// Run only this row, as in boundary/roller, or the rows of this group, as in boundary; may be repeated.
    #[arg(long, value_name = "NAME")]
    row: Vec<String>,
    /// List the rows and the verdicts that theory expects, and run nothing.
    #[arg(long)]
    list: bool,
    /// Put deliberate mistakes into the solver and the compiler, one after the other: all, or the named ones. Each must make
    /// a verdict fail. A defect is tested on the quick levels of the rows that are declared to catch it. The program must be
    /// built with `--features defects`.
    #[arg(long, value_name = "NAME", num_args = 0.., require_equals = true, value_delimiter = ',', conflicts_with = "list")]
    defects: Option<Vec<String>>,
    /// Test every defect on every row of the quick matrix; takes about an hour.
    #[arg(long, requires = "defects")]
    all_rows: bool,
    /// The folder for results.
    #[arg(long, value_name = "DIR", default_value = "target/mms/verify")]
    store: PathBuf,
    /// The folder to write verification.json, or defects.json, to: the document of `--json`.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The number of runs at the same time; by default the number of processors.
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
    #[command(flatten)]
    printing: Printing,
    /// Print the page docs/verification.md or, with --defects, docs/defects.md.
    #[arg(long, conflicts_with_all = ["list", "json", "format"])]
    page: bool,
}

impl Verify {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let all = rows()?;
        let rows = self.select(&all)?;
        if self.list {
            self.printing.print(&List { rows: &rows, quick: self.quick })?;
            return Ok(CommandOutcome::AsExpected);
        }
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        let threads = self.threads.or(std::thread::available_parallelism().ok());
        let threads = threads.unwrap_or(NonZero::<usize>::MIN);
        if let Some(names) = &self.defects {
            return self.show_defects(names, &all, &rows, threads);
        }
        let plan = RunPlan::new(&rows, self.quick, &identity()?)?;
        let (store, set_aside) = Store::open(&self.store)?;
        let progress = Progress::new(&plan.jobs);
        set_aside.iter().for_each(|what| progress.set_aside(what));
        let fields = Fields::new(find);
        let outcomes = outcomes(&plan.jobs, &store, threads, &fields, &progress)?;
        progress.finish();
        let judged = rows.iter().zip(&plan.levels).map(|(row, levels)| {
            let levels: Vec<_> = levels.iter().map(|&at| outcomes[at].clone()).collect();
            let judgement = judge(row, &levels);
            Ok(JudgedRow { row, study: row.study()?.0, levels, judgement })
        });
        let report = Report {
            quick: self.quick,
            rows: judged.collect::<anyhow::Result<_>>()?,
            provenance: this_command("verify", input()),
        };
        self.tell("verification", &report, || report.page())?;
        Ok(match report.unexpected().next() {
            None => CommandOutcome::AsExpected,
            Some(_) => CommandOutcome::Refuted,
        })
    }

    /// Writes the document to the folder for it, and prints the result as it is wanted.
    fn tell(
        &self,
        name: &str,
        report: &impl Shown,
        page: impl FnOnce() -> String,
    ) -> anyhow::Result<()> {
        if let Some(folder) = &self.output {
            for path in write_files(folder, name, [("json", pretty(&report.document())?)])? {
                say(path);
            }
        }
        if self.page { print(&page()) } else { self.printing.print(report) }
    }

    #[cfg(not(feature = "defects"))]
    fn show_defects(
        &self,
        _: &[String],
        _: &[MatrixRow],
        _: &[&MatrixRow],
        _: NonZero<usize>,
    ) -> anyhow::Result<CommandOutcome> {
        bail!(
            "this program has no defects in it; `cargo run --release --features defects -- verify --defects` builds and runs one that has"
        )
    }

    /// The selected rows.
    fn select<'a>(&self, all: &'a [MatrixRow]) -> anyhow::Result<Vec<&'a MatrixRow>> {
        let is = |row: &MatrixRow, name: &str| row.name == name || row.group() == name;
        for name in &self.row {
            if all.iter().any(|row| is(row, name)) {
                continue;
            }
            let names = all.iter().flat_map(|row| [row.name.as_str(), row.group()]);
            let advice = advice(name, names, |_| "`mms verify --list` lists them".into());
            bail!("`--row {name}`: no such row or group; {advice}");
        }
        let asked =
            |row: &&MatrixRow| self.row.is_empty() || self.row.iter().any(|name| is(row, name));
        let rows: Vec<_> = all.iter().filter(asked).collect();
        let quick: Vec<_> =
            rows.iter().copied().filter(|row| !self.quick || row.quick > 0).collect();
        if quick.is_empty() {
            bail!("`--quick` leaves out all of the rows that `--row` names");
        }
        Ok(quick)
    }
}

/// The input of the matrix: its rows, and the fields of the gallery.
fn input() -> provenance::Input {
    let fields = FIELDS.iter().map(|entry| entry.text).collect::<String>();
    let hash = digest([MATRIX, &fields]);
    provenance::Input { field: None, rigid: None, window: None, set: Vec::new(), hash }
}

/// A bar on a terminal, a line per run elsewhere.
struct Progress {
    bar: ProgressBar,
    count: usize,
    done: AtomicUsize,
    /// The work that is one unit of the bar.
    unit: f64,
}

/// Units of the bar, about.
const UNITS: f64 = 1e6;

impl Progress {
    fn new(jobs: &[Job]) -> Self {
        let bar = match std::io::stderr().is_terminal() {
            true => ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(5)),
            false => ProgressBar::hidden(),
        };
        if let Ok(style) =
            ProgressStyle::with_template("{msg} {bar:40} {percent:>3}% {eta:>4} left")
        {
            bar.set_style(style);
        }
        let work: f64 = jobs.iter().map(|job| job.work).sum();
        let progress =
            Self { bar, count: jobs.len(), done: AtomicUsize::new(0), unit: work / UNITS };
        progress.bar.set_length(jobs.iter().map(|job| progress.units(job, 1, 1)).sum());
        progress
    }

    /// The units of some of a run's steps.
    fn units(&self, job: &Job, step: usize, steps: usize) -> u64 {
        (job.work / self.unit * step as f64 / steps as f64) as u64
    }

    /// Counts a run that has ended.
    fn count(&self) -> String {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        let message = format!("{done} of {} runs", self.count);
        self.bar.set_message(message.clone());
        message
    }

    fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watcher for Progress {
    fn found(&self, job: &Job) {
        self.count();
        // A stored result takes no time, and does not change the estimate for the remaining runs.
        self.bar.dec_length(self.units(job, 1, 1));
    }

    fn step(&self, job: &Job, step: usize, steps: usize) {
        self.bar.inc(self.units(job, step, steps) - self.units(job, step - 1, steps));
    }

    fn done(&self, job: &Job, outcome: &mms_lab::outcome::SolverOutcome) {
        let count = self.count();
        if self.bar.is_hidden() {
            let end = outcome.failure().unwrap_or_else(|| "done".into());
            let left = self.bar.eta().as_secs();
            say(format_args!("{count}, about {left} s left: {}: {end}", job.command));
        }
    }

    fn set_aside(&self, what: &str) {
        self.bar.suspend(|| say(format_args!("warning: {what}")));
    }
}
