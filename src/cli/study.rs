//! `mms study`: the observed order of a method on a field.

use std::io::IsTerminal as _;
use std::path::PathBuf;

use anyhow::{Context as _, bail};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mms_codegen::program::interpret::Number;
use mms_runtime::study::{TOLERANCE, judge};
use mms_runtime::{IntegratorName, Level, Method, Real, ShapeName, Verdict};

use super::input::{Input, Variant};
use super::{Outcome, print, print_json};
use crate::report::{Refused, Study as Report};
use crate::scene::Scene;

/// The precision of the solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Precision {
    /// Single.
    F32,
    /// Double.
    #[default]
    F64,
}

impl Precision {
    /// The word of the command line.
    fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
        }
    }
}

/// Run a method on levels of refinement: errors, observed orders, verdict.
///
/// Writes convergence.svg, .csv and .json.
#[derive(Args)]
pub struct Study {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// The shape function: linear, ugimp or cpgimp.
    #[arg(long, default_value_t = ShapeName::Cpgimp)]
    shape: ShapeName,
    /// The time integrator: usf, usl, musl or leapfrog.
    #[arg(long, default_value_t = IntegratorName::Leapfrog)]
    integrator: IntegratorName,
    /// The levels: cells along the longest edge of the body. By default 8,16,32,64,128 in one
    /// dimension, 8,16,32,64 in two and 4,8,16 in three.
    #[arg(long, value_name = "N,N,..", value_delimiter = ',')]
    cells: Vec<usize>,
    /// Particles per cell along each axis.
    #[arg(long, default_value_t = 2)]
    particles_per_cell: usize,
    /// time_step * c0 / cell_size, c0 being the fastest wave speed at F = I.
    #[arg(long, default_value_t = 0.4)]
    courant: f64,
    /// The precision to compute in.
    #[arg(long, value_enum, default_value_t)]
    precision: Precision,
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
        let levels = match self.precision {
            Precision::F32 => {
                let scene = self.scene(&input, |entry| entry.single)?;
                self.levels(&scene)
            }
            Precision::F64 => {
                let scene = self.scene(&input, |entry| entry.double)?;
                self.levels(&scene)
            }
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
            precision: self.precision.name(),
            judgement,
            method: self.method(),
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
        if !(self.courant > 0.0 && self.courant.is_finite()) {
            bail!("`--courant {}`: expected a positive number", self.courant);
        }
        if self.particles_per_cell == 0 {
            bail!("`--particles-per-cell 0`: expected at least 1");
        }
        if self.cells.contains(&0) {
            bail!("`--cells`: a level needs at least 1 cell");
        }
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

    fn method(&self) -> Method {
        Method {
            shape: self.shape,
            integrator: self.integrator,
            particles_per_cell: self.particles_per_cell,
            courant: self.courant,
        }
    }

    /// The compiled field, where it is of the gallery, and the interpreted one otherwise.
    fn scene<T: Real + Number>(
        &self,
        input: &Input,
        build: impl Fn(&crate::gallery::Entry) -> fn(&[T]) -> Option<Scene<T>>,
    ) -> anyhow::Result<Scene<T>> {
        let set = input.settings(&self.set)?;
        match input.entry {
            Some(entry) => build(entry)(&input.compiled.parameters::<T>(&set))
                .context("the gallery is out of step with its field files: build again"),
            None => Ok(crate::interpreted::scene(input.compiled.clone(), &set)),
        }
    }

    fn levels<T: Real>(&self, scene: &Scene<T>) -> Vec<Result<Level, Refused>> {
        let (default, method) = (scene.default_cells(), self.method());
        let mut cells = if self.cells.is_empty() { default.to_vec() } else { self.cells.clone() };
        // Orders are those between neighbours, from coarse to fine.
        cells.sort_unstable();
        let progress = Progress::new();
        let mut levels = Vec::new();
        for cells in cells {
            let mut step = |step: usize, steps: usize| progress.step(cells, step, steps);
            let level = scene.run_level(&method, cells, &mut step);
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
            entry.shape == self.shape.name()
                && entry.integrator == self.integrator.name()
                && entry.formulation.as_deref().unwrap_or("updated") == "updated"
        });
        let order = self.expected_order.or(entry.map(|entry| entry.order)).unwrap_or(2.0);
        (order, entry.and_then(|entry| entry.tolerance).unwrap_or(TOLERANCE))
    }
}

/// A bar on a terminal, a line per level elsewhere.
struct Progress {
    bar: ProgressBar,
}

impl Progress {
    fn new() -> Self {
        let bar = if std::io::stderr().is_terminal() {
            ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(10))
        } else {
            ProgressBar::hidden()
        };
        if let Ok(style) =
            ProgressStyle::with_template("{msg} {bar:40} {percent:>3}% {eta:>4} left")
        {
            bar.set_style(style);
        }
        Progress { bar }
    }

    fn step(&self, cells: usize, step: usize, steps: usize) {
        if step <= 1 {
            self.bar.reset();
            self.bar.set_length(steps as u64);
            self.bar.set_message(format!("{cells} cells"));
        }
        self.bar.set_position(step as u64);
        if step == steps && self.bar.is_hidden() {
            anstream::eprintln!("{cells} cells: {steps} steps done");
        }
    }

    fn say(&self, line: &str) {
        self.bar.suspend(|| anstream::eprintln!("{line}"));
    }

    fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
