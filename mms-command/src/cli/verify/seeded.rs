//! `mms verify --defects`, in a program that has them.

use std::io::IsTerminal as _;
use std::num::NonZero;

use anyhow::bail;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mms_files::program::identity;
use mms_files::store::Store;
use mms_lab::plausibility::Objections;
use mms_report::defects::{Report, Showing};
use mms_verify::defects::{Defect, DefectRuns, RowResult, validate};
use mms_verify::matrix::MatrixRow;
use mms_verify::plan::Job;
use mms_verify::work::Watcher;

use super::super::{CommandOutcome, say, this_command};
use super::{Verify, input};

/// The folder in a store where results of defects are kept: none of them is trusted without.
const FOLDER: &str = "defects";

impl Verify {
    /// Shows defects to rows of the quick matrix.
    pub(super) fn show_defects(
        &self,
        names: &[String],
        all: &[MatrixRow],
        rows: &[&MatrixRow],
        threads: NonZero<usize>,
    ) -> anyhow::Result<CommandOutcome> {
        validate(all)?;
        let rows: Vec<&MatrixRow> = rows.iter().copied().filter(|row| row.quick > 0).collect();
        if rows.is_empty() {
            bail!("`--defects` tests defects on the quick matrix, which has none of these rows");
        }
        let defects = Defect::named(names)?;
        let (store, set_aside) = Store::open(&self.store.join(FOLDER))?;
        let progress = Progress::new(defects.len());
        set_aside.iter().for_each(|what| progress.set_aside(what));
        let stage = DefectRuns { program: identity()?, store, threads, watcher: &progress };

        // Without a defect every row has to be as expected, or it would catch them all.
        let chosen = |defect: &Defect| match self.all_rows {
            true => rows.clone(),
            false => claimants(*defect, &rows),
        };
        let needed = |row: &&&MatrixRow| {
            defects.iter().any(|defect| chosen(defect).iter().any(|it| it.name == row.name))
        };
        let needed: Vec<&MatrixRow> = rows.iter().filter(needed).copied().collect();
        let right = stage.run_rows(None, &needed)?;
        if let Some(odd) = right.iter().find(|shown| !shown.judgement.as_expected()) {
            let reason = odd.judgement.reason.as_deref().unwrap_or_default();
            bail!("`{}` is not as theory expects without any defect: {reason}", odd.row.name);
        }

        let mut showings = Vec::new();
        for &defect in &defects {
            let shown = stage.run_rows(Some(defect), &chosen(&defect))?;
            let objections = shown.iter().fold(Objections::default(), |objections, it| {
                let without = right.iter().find(|other| other.row.name == it.row.name);
                objections.or(it
                    .objections
                    .not_in(without.map_or(Objections::default(), |it| it.objections)))
            });
            let showing = Showing { defect, rows: shown, objections };
            progress.shown(&showing);
            showings.push(showing);
        }
        progress.bar.finish_and_clear();
        let provenance = this_command("defects", input());
        let report =
            Report { rows, showings, whole: self.all_rows && names.is_empty(), provenance };
        self.tell("defects", &report, || report.page())?;
        Ok(if report.as_expected() { CommandOutcome::AsExpected } else { CommandOutcome::Refuted })
    }
}

/// The rows that say that they catch a defect; all, if none does.
fn claimants<'a>(defect: Defect, rows: &[&'a MatrixRow]) -> Vec<&'a MatrixRow> {
    let claims = |row: &&&MatrixRow| row.catches.iter().any(|name| name == defect.name());
    let claimants: Vec<_> = rows.iter().filter(claims).copied().collect();
    if claimants.is_empty() { rows.to_vec() } else { claimants }
}

/// A bar on a terminal, a line per defect elsewhere.
struct Progress {
    bar: ProgressBar,
}

impl Progress {
    fn new(count: usize) -> Self {
        let bar = match std::io::stderr().is_terminal() {
            true => ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(5)),
            false => ProgressBar::hidden(),
        };
        let style = "{pos} of {len} defects {bar:40} {eta:>4} left, {msg}";
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style);
        }
        bar.set_length(count as u64);
        Self { bar }
    }

    fn shown(&self, showing: &Showing<'_>) {
        self.bar.inc(1);
        let by = |shown: &RowResult<'_>| shown.row.name.clone();
        let by = showing.caught().map(by).next().unwrap_or_else(|| "nothing".into());
        let name = showing.defect.name();
        if self.bar.is_hidden() {
            let (at, all) = (self.bar.position(), self.bar.length().unwrap_or_default());
            let left = self.bar.eta().as_secs();
            say(format_args!("{at} of {all} defects, about {left} s left: {name}: caught by {by}"));
        }
    }
}

impl Watcher for Progress {
    fn found(&self, _: &Job) {}

    fn step(&self, _: &Job, _: usize, _: usize) {}

    fn done(&self, job: &Job, _: &mms_lab::outcome::SolverOutcome) {
        self.bar.set_message(job.command.clone());
    }

    fn set_aside(&self, what: &str) {
        self.bar.suspend(|| say(format_args!("warning: {what}")));
    }
}
