//! `mms study`: the observed order of a method on a field.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use mms_runtime::study::{TOLERANCE, judge};
use mms_runtime::{Division, Level, Method, Verdict};

use super::input::{Input, Variant};
use super::method::{MethodOptions, Precision};
use super::progress::Progress;
use super::{Outcome, print, print_json};
use crate::report::{Refused, Study as Report};
use crate::scene::{Scene, Solvable};

/// Run a method on levels of refinement: errors, observed orders, verdict.
///
/// Writes convergence.svg, .csv and .json.
#[derive(Args)]
pub struct Study {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// The levels: cells along the longest edge of the body, or along each axis, as in 16x8. By default 8,16,32,64,128 in one
    /// dimension, 8,16,32,64 in two and 4,8,16 in three.
    #[arg(long, value_name = "N[xN..],..", value_delimiter = ',')]
    cells: Vec<Division>,
    #[command(flatten)]
    method: MethodOptions,
    /// The order to judge against. By default that of the field's [[study]] entry for the method,
    /// else 2.
    #[arg(long, value_name = "P")]
    expected_order: Option<f64>,
    /// Set a parameter; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Where to write convergence.svg, .csv and .json; target/mms/FIELD by default.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    variant: Variant,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

/// What `mms` does without arguments: the slides' bar with contiguous-particle GIMP.
pub fn main_job() -> anyhow::Result<Outcome> {
    /// A study on its own, with the defaults of its options.
    #[derive(clap::Parser)]
    struct MainJob {
        #[command(flatten)]
        study: Study,
    }
    <MainJob as clap::Parser>::parse_from(["mms", "bar_1d"]).study.run()
}

impl Study {
    pub fn run(self) -> anyhow::Result<Outcome> {
        self.validate()?;
        let input = Input::find(&self.field, &self.variant)?;
        let folder = self.folder(&input.name)?;
        let method = self.method.method(input.compiled.field.dimension)?;
        let levels = match self.method.precision {
            Precision::F32 => self.levels(&input.scene(&self.set, |entry| entry.single)?, &method),
            Precision::F64 => self.levels(&input.scene(&self.set, |entry| entry.double)?, &method),
        };
        let started: Vec<_> = levels.iter().flatten().cloned().collect();
        if started.is_empty() {
            anstream::eprintln!("error: the study of `{}` cannot be started", input.name);
            return Ok(Outcome::RunFailed);
        }
        let (expected_order, tolerance) = self.expectation(&input);
        let mut judgement = judge(&started, expected_order, tolerance);
        if started.len() < levels.len() {
            judgement.verdict = Verdict::Fail;
        }
        let report = Report {
            field: input.name.clone(),
            title: input.compiled.field.title.clone(),
            precision: self.method.precision.name(),
            judgement,
            method,
            levels,
            expected_order,
            tolerance,
        };
        if self.json {
            print_json(&report.document())?;
        } else {
            print(&report.table())?;
        }
        let written = report.write(&folder)?;
        if !self.json {
            print(&format!("\nwrote {}", written.join(", ")))?;
        }
        Ok(match report.judgement.verdict {
            Verdict::Pass => Outcome::AsExpected,
            Verdict::Fail | Verdict::NotAsymptotic => Outcome::Refuted,
        })
    }

    /// Where to write. What can be seen to be wrong with it is said before any work is done.
    fn folder(&self, name: &str) -> anyhow::Result<PathBuf> {
        let own = name.trim_start_matches('.');
        let own = if own.is_empty() { "field" } else { own };
        let folder = self.output.clone().unwrap_or_else(|| PathBuf::from("target/mms").join(own));
        if folder.exists() && !folder.is_dir() {
            bail!("`--output {}`: not a folder", folder.display());
        }
        Ok(folder)
    }

    fn validate(&self) -> anyhow::Result<()> {
        if let Some(twice) =
            self.cells.iter().enumerate().find(|(at, n)| self.cells[..*at].contains(n))
        {
            bail!("`--cells`: {} is given twice", twice.1);
        }
        if self.expected_order.is_some_and(|order| !order.is_finite()) {
            bail!("`--expected-order`: expected a finite number");
        }
        Ok(())
    }

    fn levels<T: Solvable>(
        &self,
        scene: &Scene<T>,
        method: &Method,
    ) -> Vec<Result<Level, Refused>> {
        let mut cells = self.cells.clone();
        if cells.is_empty() {
            cells.extend(scene.default_cells().iter().map(|&cells| Division::Uniform(cells)));
        }
        // Orders are those between neighbours, from coarse to fine.
        cells.sort_unstable_by_key(|cells| cells.numbers());
        let progress = Progress::new();
        let mut levels = Vec::new();
        for cells in cells {
            let mut step = |step: usize, steps: usize| progress.step(&cells, step, steps);
            let level = scene.run_level(method, &cells, &mut step);
            match &level {
                Ok(Level { errors: Ok(_), .. }) => {}
                Ok(Level { errors: Err(failure), .. }) => {
                    progress.say(&format!("{cells} cells: {failure}"));
                }
                Err(refusal) => progress.say(&format!("{cells} cells: not started: {refusal}")),
            }
            levels.push(level.map_err(|reason| Refused { cells, reason }));
        }
        progress.finish();
        levels
    }

    /// The order to judge against, and how far from it is still as expected.
    fn expectation(&self, input: &Input) -> (f64, f64) {
        let entry = input.compiled.field.studies.iter().find(|entry| {
            entry.shape == self.method.shape.name()
                && entry.integrator == self.method.integrator.name()
                && entry.formulation.as_deref().unwrap_or("updated")
                    == self.method.formulation.name()
        });
        let order = self.expected_order.or(entry.map(|entry| entry.order)).unwrap_or(2.0);
        (order, entry.and_then(|entry| entry.tolerance).unwrap_or(TOLERANCE))
    }
}
