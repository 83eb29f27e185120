//! `mms run`: one simulation.

use clap::Args;
use mms_runtime::study::Watch;
use mms_runtime::{Division, Method, Refusal};

use super::input::{Input, Variant};
use super::method::{MethodOptions, Precision};
use super::progress::Progress;
use super::{Outcome, print, print_json};
use crate::report::run::Run as Report;
use crate::scene::{Scene, Solvable};

/// Run one simulation: errors in u, v, F and P, and what it took.
#[derive(Args)]
pub struct Run {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// Cells along the longest edge of the body, or along each axis, as in 32 or 32x16. By default 32 in
    /// one dimension, 16 in two and 8 in three.
    #[arg(long, value_name = "N[xN..]")]
    cells: Option<Division>,
    #[command(flatten)]
    method: MethodOptions,
    /// Set a parameter; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    variant: Variant,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl Run {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let input = Input::find(&self.field, &self.variant)?;
        let dimension = input.compiled.field.dimension;
        let method = self.method.method_for(&input, &self.set)?;
        let cells = self.cells.unwrap_or(Division::Uniform([32, 16, 8][dimension - 1]));
        let run = match self.method.precision {
            Precision::F32 => {
                self.solve(&input.scene(&self.set, |entry| entry.single)?, &method, &cells)
            }
            Precision::F64 => {
                self.solve(&input.scene(&self.set, |entry| entry.double)?, &method, &cells)
            }
        };
        let run = match run {
            Ok(run) => run,
            Err(refusal) => {
                anstream::eprintln!("error: `{}` cannot be run: {refusal}", input.name);
                return Ok(Outcome::RunFailed);
            }
        };
        let failed = run.level.errors.is_err();
        let report = Report {
            field: input.name.clone(),
            title: input.compiled.field.title.clone(),
            precision: self.method.precision.name(),
            method,
            run,
        };
        if self.json {
            print_json(&report.document())?;
        } else {
            print(&report.text())?;
        }
        if let Err(failure) = &report.run.level.errors {
            anstream::eprintln!("error: {failure}");
        }
        Ok(if failed { Outcome::RunFailed } else { Outcome::AsExpected })
    }

    fn solve<T: Solvable>(
        &self,
        scene: &Scene<T>,
        method: &Method,
        cells: &Division,
    ) -> Result<mms_runtime::Run, Refusal> {
        let progress = Progress::new();
        let mut step = |step: usize, steps: usize| progress.step(cells, step, steps);
        let run = scene.run(method, cells, Watch::Everything, &mut step);
        progress.finish();
        run
    }
}
