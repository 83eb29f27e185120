//! `mms tradeoff`: error against cost, and what to choose.

use std::path::PathBuf;

use anyhow::{Context as _, anyhow, bail};
use clap::Args;
use mms_codegen::Compiled;
use mms_exact::wave::sound;
use mms_exact::{Input, units};
use mms_files::shell;
use mms_files::store::Store;
use mms_judge::next;
use mms_lab::tradeoff::search::{Cost, Goal, Runner, Search, SearchProblem, TradeoffResult, Trial};
use mms_lab::tradeoff::setting::Setting;
use mms_lab::trial::Trials;
use mms_mechanics::sample::domain;
use mms_options::field::{Motion, Variant, find};
use mms_options::method::positive;
use mms_report::tradeoff::Report;
use mms_report::tradeoff::page::Page;
use mms_runtime::Division;
use mms_runtime::scene::usual_cells;
use mms_spec::Form;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

use super::figure::FigureFile;
use super::format::Printing;
use super::next::{after_search, typed};
use super::{CommandOutcome, print, say, this_command};
use crate::session::progress::Progress;

/// Find the cheapest method, options and grid of the built-in solver for an error, or the least error for a time.
///
/// The search varies shape function, formulation, transfer, integrator, particles per cell, Courant number, precision and
/// form: first all kinds on two coarse grids, then variations of the best, then the grids that these need. The output lists
/// runs with their error and cost, marks the Pareto front (*) and the choice (=>), and states the cost of twice the accuracy
/// and the options that are nowhere worth their cost. The command writes tradeoff.svg and tradeoff.json.
///
/// The error is linf of the displacement, the largest over time and particles. Each run uses one thread and is stored, so
/// that the same command continues after an interruption. The exit code is 1 if the target is not reached.
#[derive(Args)]
pub struct Tradeoff {
    /// A name that `mms list` prints, or the path of a TOML file.
    #[arg(required_unless_present = "page")]
    field: Option<String>,
    /// The largest allowed error, to be reached at the least cost; by default the error of `mms run` without options.
    #[arg(long, value_name = "E", value_parser = positive)]
    target_linf: Option<f64>,
    /// The time of a run in seconds, within which to reach the least error.
    #[arg(long, value_name = "S", conflicts_with = "target_linf", value_parser = positive)]
    budget_seconds: Option<f64>,
    /// The cost to minimise. Seconds are the number of particle-steps, times the measured time of one particle-step with the
    /// method on this machine. Particle-steps and memory are the same on every machine.
    #[arg(long, value_enum, default_value_t)]
    cost: Cost,
    /// The most particle-steps of a run; runs that are predicted to need more are not started.
    #[arg(long, value_name = "N", default_value_t = 1e8, value_parser = positive)]
    most_work: f64,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    motion: Motion,
    /// The folder for results.
    #[arg(long, value_name = "DIR", default_value = "target/mms/tradeoff")]
    store: PathBuf,
    /// The folder to write tradeoff.svg and tradeoff.json to; by default target/mms/FIELD.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Show every run; by default only the front, the default method, and runs that stopped.
    #[arg(long)]
    all: bool,
    #[command(flatten)]
    figure: FigureFile,
    #[command(flatten)]
    printing: Printing,
    /// Print the page docs/tradeoff.md.
    #[arg(long, conflicts_with_all = ["field", "json", "format", "output", "figure", "budget_seconds", "target_linf", "set", "rigid"])]
    page: bool,
}

impl Tradeoff {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        if self.budget_seconds.is_some() && self.cost != Cost::Seconds {
            bail!("`--budget-seconds`: the cost is then in seconds; leave out `--cost`");
        }
        let (store, set_aside) = Store::open(&self.store)?;
        set_aside.iter().for_each(|what| say(format_args!("warning: {what}")));
        let mut trials = Trials::new(store, Box::new(Progress::new()))?;
        if self.page {
            return self.print_page(&mut trials);
        }
        let Some(field) = &self.field else { bail!("no field") };
        let input = self.input(field)?;
        input.validate_settings(&self.set)?;
        let folder = super::output_folder(self.output.as_deref(), input.name.raw())?;
        self.figure.validate()?;
        let mut runner =
            SettingRunner { trials: &mut trials, field, set: &self.set, motion: &self.motion };
        let target = self.target_linf.map(Goal::Error);
        let goal = target.or_else(|| self.budget_seconds.map(Goal::Cost));
        // Without a goal, any error is accepted until the error of the default is known.
        let mut problem = self.problem(&input, goal.unwrap_or(Goal::Error(f64::INFINITY)))?;
        if goal.is_none() {
            problem.goal = runner.usual(&problem)?;
        }
        let found = Search::run(&mut runner, problem)?;
        trials.finish();
        let command = |setting: &Setting, cells: usize| self.command(field, setting, cells);
        let mut report = self.report(&input, problem, found, &command)?;
        let run = |it: &Trial| {
            let words = arguments(field, &self.set, &self.motion, &it.setting, it.cells);
            next::command(std::iter::once("run".to_owned()).chain(words))
        };
        report.next = after_search(&report, run, &typed());
        let mut written = report.write(&folder)?;
        written.extend(self.figure.write(|| report.figure())?);
        self.printing.print(&report)?;
        if self.printing.is_text() {
            print(&format!("\nwrote {}", written.join(", ")))?;
        }
        Ok(if report.choice().is_some() {
            CommandOutcome::AsExpected
        } else {
            CommandOutcome::Refuted
        })
    }

    fn input(&self, field: &str) -> anyhow::Result<Input> {
        let input = find(field, &Variant::new(self.motion.clone(), Form::Stable))?;
        input.validate_moving()?;
        Ok(input)
    }

    fn report<'a>(
        &self,
        input: &Input,
        problem: SearchProblem,
        found: TradeoffResult,
        command: &'a dyn Fn(&Setting, usize) -> String,
    ) -> anyhow::Result<Report<'a>> {
        let [field, title] = [input.name.clone(), input.compiled.field.title.clone()];
        let provenance = this_command("tradeoff", input.provenance(&self.set));
        let unit = units(&input.compiled, ["displacement"]);
        let unit = unit.and_then(|it| it.get("displacement").cloned());
        Ok(Report {
            field,
            title,
            unit,
            problem,
            found,
            all: self.all,
            command,
            next: None,
            provenance,
        })
    }

    fn problem(&self, input: &Input, goal: Goal) -> anyhow::Result<SearchProblem> {
        let scene = input.scene(&self.set, |code| code.double)?;
        let dimension = input.compiled.field.dimension;
        let grain = scene.edges().map_or(1, |edges| grain(&edges));
        let longest = scene.cell_size(&Division::Uniform(1));
        let unit_work = unit_work(&input.compiled, &input.settings(&self.set)?, longest);
        let (cost, most_work) = (self.cost, self.most_work);
        Ok(SearchProblem { dimension, grain, goal, cost, most_work, unit_work })
    }

    /// The page, of some fields and targets.
    fn print_page(&self, trials: &mut Trials) -> anyhow::Result<CommandOutcome> {
        let mut page = Page::default();
        for field in Page::FIELDS {
            let input = self.input(field)?;
            for target in Page::TARGETS {
                let problem = self.problem(&input, Goal::Error(target))?;
                let mut runner =
                    SettingRunner { trials, field, set: &self.set, motion: &self.motion };
                let found = Search::run(&mut runner, problem)?;
                let command = |setting: &Setting, cells: usize| self.command(field, setting, cells);
                page.add(&self.report(&input, problem, found, &command)?);
            }
        }
        trials.finish();
        print(page.text())?;
        Ok(CommandOutcome::AsExpected)
    }

    fn command(&self, field: &str, setting: &Setting, cells: usize) -> String {
        let arguments = arguments(field, &self.set, &self.motion, setting, cells);
        shell::command(["run".to_owned()].into_iter().chain(arguments))
    }
}

/// The arguments of `mms run` for a setting on a grid.
fn arguments(
    field: &str,
    set: &[String],
    motion: &Motion,
    setting: &Setting,
    cells: usize,
) -> Vec<String> {
    let mut arguments = vec![field.to_owned(), "--cells".into(), cells.to_string()];
    arguments.extend(setting.options());
    arguments.extend(set.iter().flat_map(|set| ["--set".to_owned(), set.clone()]));
    arguments.extend(motion.arguments());
    arguments.extend(["--threads".to_owned(), "1".to_owned()]);
    arguments
}

/// Runs settings on a field.
struct SettingRunner<'a> {
    trials: &'a mut Trials,
    field: &'a str,
    set: &'a [String],
    motion: &'a Motion,
}

impl Runner for SettingRunner<'_> {
    fn run(&mut self, setting: &Setting, cells: usize) -> anyhow::Result<Trial> {
        let arguments = arguments(self.field, self.set, self.motion, setting, cells);
        let trial = self.trials.run(&arguments)?;
        let size = trial.outcome.run();
        let error = match (trial.outcome.failure(), trial.outcome.norms()) {
            (None, Some([_, _, linf])) => Ok(linf),
            (reason, _) => Err(reason.unwrap_or_default()),
        };
        Ok(Trial {
            setting: *setting,
            cells,
            particles: size.map_or(0, |size| size.particles),
            steps: size.map_or(0, |size| size.steps),
            error,
            seconds: size.map_or(0.0, |size| size.seconds),
            memory: trial.memory as f64,
        })
    }
}

impl SettingRunner<'_> {
    /// The error of a run without options, as a goal.
    fn usual(&mut self, problem: &SearchProblem) -> anyhow::Result<Goal> {
        let (setting, cells) = (Setting::default(), usual_cells(problem.dimension));
        let work = problem.work(&setting, cells);
        if work > problem.most_work {
            bail!(
                "`--most-work {:e}`: the default method, whose error is the target, is predicted to take {work:.1e}; \
                 raise it, or give `--target-linf` or `--budget-seconds`",
                problem.most_work
            );
        }
        let trial = self.run(&setting, cells)?;
        let error = trial.error.map_err(|reason| {
            anyhow!("the default method gives no error as a target: {reason}\ngive `--target-linf` or `--budget-seconds`")
        })?;
        (error > 0.0).then_some(Goal::Error(error)).context(
            "the default method makes no error that could be the target: give `--target-linf` or `--budget-seconds`",
        )
    }
}

/// Estimates the particle-steps of a run on one cell as long as the `longest` edge of the body, with one particle in it and a
/// Courant number of 1: the part of the cell that the body fills, times the number of times that a wave crosses the cell.
fn unit_work(compiled: &Compiled, set: &SortedMap<usize, Rational>, longest: f64) -> f64 {
    let (extent, [start, end]) = domain(&compiled.program, &compiled.parameters::<f64>(set));
    let [_, speed] = sound(compiled, set);
    let dimension = extent.dimension() as i32;
    let part = extent.measure() / longest.powi(dimension);
    part * speed * (end - start) / longest
}

/// The least number of cells along the longest edge that divides all edges into whole numbers of cells, as its multiples do; 1
/// if that number would be above 64.
fn grain(edges: &[f64]) -> usize {
    const MOST: usize = 64;
    let longest = edges.iter().fold(0.0, |longest: f64, edge| longest.max(*edge));
    let divides = |cells: usize| {
        edges.iter().all(|edge| {
            let along = edge / longest * cells as f64;
            along.round() >= 1.0 && (along - along.round()).abs() < 1e-6
        })
    };
    (1..=MOST).find(|&cells| divides(cells)).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::grain;

    #[test]
    fn cells_divide_every_edge() {
        assert_eq!(grain(&[2.0]), 1);
        assert_eq!(grain(&[1.0, 1.0, 1.0]), 1);
        assert_eq!(grain(&[3.0, 1.0]), 3);
        assert_eq!(grain(&[1.0, 0.4]), 5);
        assert_eq!(grain(&[1.0, std::f64::consts::FRAC_1_PI]), 1);
    }
}
