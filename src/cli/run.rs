//! `mms run`: one simulation.

use std::path::PathBuf;

use clap::Args;
use mms_runtime::Division;
use mms_runtime::study::{Frame, Observer, Watch};

use super::input::{Input, Variant};
use super::method::{MethodOptions, Precision};
use super::progress::{OfRun, Progress};
use super::{Outcome, print, print_json};
use crate::report::run::Run as Report;
use crate::scene::usual_cells;
use crate::vtk::Writer;

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
    /// Write states for ParaView to this folder: FIELD.pvd, which is the file to open, and one .vtu file
    /// for each.
    #[arg(long, value_name = "DIR")]
    vtk: Option<PathBuf>,
    /// How many states to write after the initial one.
    #[arg(long, value_name = "N", default_value_t = 20, requires = "vtk", value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

/// Who follows a run.
struct Followers<'a> {
    progress: OfRun<'a>,
    vtk: Option<Writer>,
}

impl Observer for Followers<'_> {
    fn begin(&mut self, particles: usize, steps: usize) {
        self.progress.begin(particles, steps);
    }

    fn step(&mut self, step: usize, steps: usize) {
        self.progress.step(step, steps);
    }

    fn wants(&self, step: usize, steps: usize) -> bool {
        self.vtk.as_ref().is_some_and(|vtk| vtk.wants(step, steps))
    }

    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        let Some(vtk) = &mut self.vtk else { return Ok(()) };
        vtk.write(frame).map_err(|error| format!("{error:#}"))
    }
}

impl Run {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let input = Input::find(&self.field, &self.variant)?;
        let dimension = input.compiled.field.dimension;
        let method = self.method.method_for(&input, &self.set)?;
        let cells = self.cells.unwrap_or(Division::Uniform(usual_cells(dimension)));
        let vtk = self.vtk.as_deref().map(|folder| {
            Writer::new(folder, input.name.trim_start_matches('.'), self.frames as usize)
        });
        let progress = Progress::new();
        let mut followers = Followers { progress: progress.of(cells), vtk: vtk.transpose()? };
        let run = match self.method.precision {
            Precision::F32 => {
                let scene = input.scene(&self.set, |entry| entry.single)?;
                scene.run(&method, &cells, Watch::Everything, &mut followers)
            }
            Precision::F64 => {
                let scene = input.scene(&self.set, |entry| entry.double)?;
                scene.run(&method, &cells, Watch::Everything, &mut followers)
            }
        };
        progress.finish();
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
            if let Some(vtk) = &followers.vtk {
                print(&format!("\nwrote {}", vtk.list().display()))?;
            }
        }
        if let Err(failure) = &report.run.level.errors {
            anstream::eprintln!("error: {failure}");
        }
        Ok(if failed { Outcome::RunFailed } else { Outcome::AsExpected })
    }
}
