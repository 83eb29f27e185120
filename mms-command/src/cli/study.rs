//! `mms study`: the observed order of a method on a field.

mod cause;
mod excluded;
mod periods;
mod refined;
mod several;
mod usual;

use std::collections::btree_map::{BTreeMap, Entry};
use std::path::PathBuf;
use std::rc::Rc;

use anyhow::{Context as _, bail};
use clap::{Args, Parser};
use mms_analysis::period::period;
use mms_codegen::selection::Selection;
use mms_convergence::{ExpectedOrder, Fit, TOLERANCE, Verdict, fit, is_near};
use mms_exact::{Input, Open, units, validate_division};
use mms_judge::{Follow as Search, Unfollowed};
use mms_lab::trial::Progress as Follow;
use mms_mechanics::sample::domain;
use mms_options::field::{Motion, open};
use mms_options::method::{MethodOptions, Precision, finite, positive};
use mms_report::{Comparison, Phases as InPhase, Study as Report, UnstartedLevel};
use mms_runtime::scene::{Scene, Solvable};
use mms_runtime::study::{Phase, Phases, Refinement, Series, Watch, differences};
use mms_runtime::{Division, Method, Real, Refusal, Run};

use self::cause::Named;
use self::periods::Periods;
use self::refined::{PARTS, halved, quartered};
use self::usual::filled;
use super::figure::FigureFile;
use super::format::{Detail, Printing};
use super::methods::Methods;
use super::{CommandOutcome, output_folder, print, replaced, say};
use crate::provenance::{self, Provenance};
use crate::session::estimate::estimate;
use crate::session::progress::{Progress, StatusLine};

/// Run the built-in solver on finer and finer grids, or with smaller and smaller time steps: errors, observed orders,
/// verdict.
///
/// For the results of your own solver, use `mms judge` or `mms campaign`.
///
/// A study in time (`--refine time`) uses one grid, by default of 128 cells in one dimension, 32 in two and 8 in three. Its
/// orders are computed from the differences between successive levels, in which the error of space cancels.
///
/// Several methods, as in `--shape linear,cpgimp`, are studied one after the other and compared: every combination of the
/// listed options. The exit code is 0 if all pass.
///
/// Before the runs, stderr shows the number of time steps and, if the study takes more than about a second, its estimated
/// duration, from a few steps of one run. A duration of minutes is a warning.
///
/// The study writes convergence.svg, convergence.csv and convergence.json.
#[derive(Args)]
pub struct Study {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// A saved scene: a TOML file whose keys are `field` and these options. Options of the command line replace its keys.
    #[arg(long = "study", value_name = "FILE")]
    _saved: Option<PathBuf>,
    /// The levels, as numbers of cells along the longest edge of the body, or along each axis, as in 16x8. By default
    /// 8,16,32,64,128 in one dimension, 8,16,32,64 in two and 4,8,16 in three.
    #[arg(long, value_name = "N[xN..],..", value_delimiter = ',')]
    cells: Vec<Division>,
    /// The refinement: `both`, cells and time step, at a fixed Courant number; `space`, the cells, with a quarter of the time
    /// step of the finest level; `time`, the time step.
    #[arg(long, value_name = "both|space|time", default_value_t)]
    refine: Refinement,
    /// The number of levels of a study in time, each with half the time step of the level before; by default 4.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(2..=16))]
    levels: Option<u8>,
    /// Fit l2 = C_h h^p + C_t dt^q to the levels, and to further runs of each with a half and a quarter of its time step.
    /// Needs three or more grids.
    #[arg(long)]
    fit: bool,
    /// Run whole periods of the field in place of its time window, and compare amplitude and phase of the computed motion
    /// with the exact ones in the Nth period, as in 1,10,100. Needs a field that is periodic in time.
    #[arg(long, value_name = "N,..", value_delimiter = ',', conflicts_with = "end_time", value_parser = clap::value_parser!(u32).range(1..))]
    periods: Vec<u32>,
    #[command(flatten)]
    methods: Methods,
    /// The expected order; by default the order in the field's [[study]] entry for the method, else 2.
    #[arg(long, value_name = "P", value_parser = finite)]
    expected_order: Option<f64>,
    /// The expected error constant C of l2 = C h^P, or C dt^P in time, on the finest level; a pass then also needs C within 1
    /// %. A defect may change the constant and leave the order. By default only the order is judged.
    #[arg(long, value_name = "C", value_parser = positive)]
    expected_constant: Option<f64>,
    /// After a pass, list the mistakes that it excludes, and from which size on: mistakes that `mms diagnose` knows, and
    /// whose error, in runs of the built-in solver, would have changed the verdict. Takes some seconds more.
    #[arg(long, conflicts_with = "periods")]
    excluded: bool,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The folder to write convergence.svg, .csv and .json to; by default target/mms/FIELD.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    motion: Motion,
    #[command(flatten)]
    figure: FigureFile,
    #[command(flatten)]
    detail: Detail,
    #[command(flatten)]
    printing: Printing,
}

/// The quantities whose errors a study computes.
const COMPARED: [&str; 4] =
    ["displacement", "velocity", "deformation_gradient", "first_piola_kirchhoff"];

/// A run, and its phase in the periods that are wanted; or why it was not started.
type Solved = Result<(Run, Vec<Option<Phase>>), UnstartedLevel>;

/// A study on its own, with the defaults of its options.
#[derive(Parser)]
struct Alone {
    #[command(flatten)]
    study: Study,
}

/// One of the methods, and the field in the form that it takes.
struct Case {
    options: MethodOptions,
    input: Rc<Input>,
    method: Method,
}

impl Case {
    /// The options that name the method.
    fn named(&self) -> Named {
        let Method { formulation, shape, integrator, setup } = &self.method;
        let arithmetic = self.options.arithmetic;
        vec![
            ("formulation", formulation.to_string()),
            ("shape", shape.to_string()),
            ("integrator", integrator.to_string()),
            ("transfer", setup.transfer.to_string()),
            ("precision", arithmetic.precision.name().to_owned()),
            ("form", arithmetic.form.name().to_owned()),
        ]
    }
}

/// Runs `mms` without arguments: the study of `bar_1d`, the bar of Wallstedt and Guilkey's slides, with contiguous-particle
/// GIMP.
pub(super) fn default_study() -> anyhow::Result<CommandOutcome> {
    Alone::parse_from(["mms", "bar_1d"]).study.run(&["mms".to_owned()])
}

/// Runs the studies of a command line whose first word is `study`, on a field that `open` opens; prints and writes nothing.
/// `search` follows the search for excluded mistakes.
///
/// # Errors
/// Options or a field that cannot be studied.
pub fn studies(
    words: &[String],
    open: Open<'_>,
    progress: &dyn Follow,
    search: &dyn Search,
) -> anyhow::Result<Comparison> {
    let study = Alone::try_parse_from(words)?.study;
    study.validate()?;
    let cases = study.cases(open, progress)?;
    let command: Vec<_> = [&["mms".to_owned()], words].concat();
    let input = cases[0].input.provenance(&study.set);
    let provenance = provenance::new("study", &command, input);
    let studies = study.reports(&cases, &command, &provenance, (progress, search))?;
    Ok(Comparison { studies, provenance })
}

impl Study {
    /// Runs the study, with these words of a command line, including the words of a study file.
    pub(super) fn run(self, words: &[String]) -> anyhow::Result<CommandOutcome> {
        self.validate()?;
        let progress = Progress::new();
        let cases = self.cases(&open, &progress)?;
        let input = &cases[0].input;
        let folder = output_folder(self.output.as_deref(), input.name.raw())?;
        self.figure.validate()?;
        let provenance = provenance::new("study", words, input.provenance(&self.set));
        let studies = self.reports(&cases, words, &provenance, (&progress, &StatusLine::new()))?;
        let is_started = studies.iter().any(Report::is_started);
        let report = Comparison { studies, provenance };
        if is_started || self.printing.is_json() {
            self.printing.print_in(self.detail, &report)?;
        }
        if !is_started {
            say(format_args!("error: the study of `{}` cannot be started", input.name.shown()));
            return Ok(CommandOutcome::RunFailed);
        }
        replaced::tell(&folder, "convergence", &report.provenance);
        let mut written = report.write(&folder)?;
        written.extend(self.figure.write(|| report.figure())?);
        if self.printing.is_text() {
            print(&format!("\nwrote {}", written.join(", ")))?;
        }
        Ok(if report.is_passed() { CommandOutcome::AsExpected } else { CommandOutcome::Refuted })
    }

    /// The study of a command line whose first word is `study`, without the machine in its provenance; `None` if no level could
    /// be started.
    pub fn without_machine(words: &[String]) -> anyhow::Result<Option<Report>> {
        let mut report = studies(words, &open, &Progress::new(), &Unfollowed)?;
        report.studies.iter_mut().for_each(|it| it.provenance.machine = None);
        Ok(report.studies.into_iter().next().filter(Report::is_started))
    }

    /// The cases to study, one at least; reports impossible ones before anything runs.
    fn cases(&self, open: Open<'_>, progress: &dyn Follow) -> anyhow::Result<Vec<Case>> {
        let mut inputs = BTreeMap::new();
        let mut cases = Vec::new();
        let mut impossible = Vec::new();
        for options in self.methods.each() {
            let input = match inputs.entry(options.arithmetic.form) {
                Entry::Occupied(known) => Rc::clone(known.get()),
                Entry::Vacant(new) => {
                    let variant = options.variant(&self.motion);
                    let input =
                        Input::new(open(&self.field)?, &variant.options(Selection::default()))?;
                    Rc::clone(new.insert(Rc::new(input)))
                }
            };
            for cells in &self.cells {
                validate_division("--cells", cells, input.compiled.field.dimension)?;
            }
            let options = filled(options, self.methods.given(), &input.compiled.field);
            let (method, note) = match options.method_for(&input, &self.set) {
                Ok(found) => found,
                // One combination of several, whose options exclude each other.
                Err(error) if self.methods.each().len() > 1 && error.is::<Refusal>() => {
                    impossible.push((options, error));
                    continue;
                }
                Err(error) => return Err(error),
            };
            note.iter().for_each(|it| progress.say(it));
            cases.push(Case { options, input, method });
        }
        if cases.is_empty()
            && let Some((_, error)) = impossible.pop()
        {
            return Err(error);
        }
        for (MethodOptions { formulation, shape, integrator, .. }, error) in impossible {
            progress.say(&format!("left out: {formulation} {shape} {integrator}: {error}"));
        }
        Ok(cases)
    }

    /// The study of a field with one method.
    fn report(
        &self,
        case: &Case,
        provenance: Provenance,
        (progress, search): (&dyn Follow, &dyn Search),
    ) -> anyhow::Result<Report> {
        let Case { options, input, method } = case;
        let mut method = method.clone();
        let periods = self.through_periods(input, &mut method)?;
        let (levels, fit) = match options.arithmetic.precision {
            Precision::F32 => {
                self.solve(&input.scene(&self.set, |code| code.single)?, &method, progress)
            }
            Precision::F64 => {
                self.solve(&input.scene(&self.set, |code| code.double)?, &method, progress)
            }
        };
        let (levels, phases): (Vec<_>, Vec<_>) = levels
            .into_iter()
            .map(|level| match level {
                Ok((run, phases)) => (Ok(run), phases),
                Err(refused) => (Err(refused), Vec::new()),
            })
            .unzip();
        if let Some(periods) = &periods {
            periods.where_they_stopped(&levels).iter().for_each(|it| progress.say(it));
        }
        let phases = periods.map(|periods| InPhase {
            period: periods.length,
            measured: self.wanted(),
            levels: phases,
        });
        let started: Vec<_> = levels.iter().flatten().collect();
        let expected = self.expectation(input, options);
        let differences = (self.refine == Refinement::Time).then(|| differences(&started));
        let series = differences.clone().unwrap_or_else(|| {
            Series::new(started.iter().map(|run| self.refine.displacement(run)))
        });
        let judgement = series.judge(expected);
        let error_constant = series.error_constant(expected.order);
        let is_off = |it| !error_constant.is_some_and(|found| is_near(found, it));
        let has_stopped = started.iter().any(|run| run.level.errors.is_err());
        let is_refused = started.len() < levels.len();
        let verdict = match judgement.verdict() {
            _ if has_stopped || is_refused || self.expected_constant.is_some_and(is_off) => {
                Verdict::Fail
            }
            verdict => verdict,
        };
        let exclusions = match (self.excluded, verdict) {
            (true, Verdict::Pass | Verdict::Exact) => {
                self.exclusions(input, &method, &started, search)?
            }
            (true, _) => {
                progress.say("note: `--excluded`: only a pass excludes mistakes");
                None
            }
            (false, _) => None,
        };
        Ok(Report {
            field: input.name.clone(),
            title: input.compiled.field.title.clone(),
            units: units(&input.compiled, COMPARED),
            arithmetic: options.arithmetic,
            refinement: if method.setup.relax { Refinement::Space } else { self.refine },
            judgement,
            verdict,
            uncertainty: series.uncertainty(),
            error_constant,
            expected_error_constant: self.expected_constant,
            fit,
            phases,
            exclusions,
            causes: Vec::new(),
            next: None,
            differences,
            method,
            levels,
            expected,
            provenance,
        })
    }

    /// The periods in which amplitude and phase are measured, in order.
    fn wanted(&self) -> Vec<usize> {
        let mut wanted: Vec<_> = self.periods.iter().map(|&period| period as usize).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }

    /// Extends a method to the end of the last wanted period, with the same number of steps in each period.
    fn through_periods(
        &self,
        input: &Input,
        method: &mut Method,
    ) -> anyhow::Result<Option<Periods>> {
        let Some(&last) = self.wanted().last() else { return Ok(None) };
        let set = input.settings(&self.set)?;
        let length = period(&input.compiled, &set)
            .with_context(|| format!("`--periods`: `{}` has no period", input.name.shown()))?;
        let (_, [start, _]) =
            domain(&input.compiled.program, &input.compiled.parameters::<f64>(&set));
        method.setup.end_time = Some(start + last as f64 * length);
        method.setup.parts = last;
        Ok(Some(Periods { start, length, last }))
    }

    fn validate(&self) -> anyhow::Result<()> {
        if let Some(twice) =
            self.cells.iter().enumerate().find(|(at, n)| self.cells[..*at].contains(n))
        {
            bail!("`--cells`: {} is given twice", twice.1);
        }
        if self.excluded && self.refine == Refinement::Time {
            bail!(
                "`--excluded`: differences between runs exclude no mistake; take a study against the exact solution, without \
                 `--refine time`"
            );
        }
        if self.methods.each().iter().any(|method| method.relax) {
            let told = [
                ("--refine time", self.refine == Refinement::Time),
                ("--fit", self.fit),
                ("--periods", !self.periods.is_empty()),
            ];
            if let Some((option, _)) = told.into_iter().find(|(_, is_given)| *is_given) {
                bail!("`{option}`: an equilibrium has no time; leave it out, or `--relax`");
            }
        }
        if self.refine == Refinement::Time && self.cells.len() > 1 {
            bail!("`--cells`: a study in time has one grid");
        }
        if self.fit && self.refine != Refinement::Both {
            bail!("`--fit`: leave `--refine` at both; the fit refines each of them by itself");
        }
        if self.refine != Refinement::Time && self.levels.is_some() {
            bail!("`--levels`: the levels of a study in space are given by `--cells`");
        }
        if self.expected_constant.is_some() && self.methods.each().len() > 1 {
            bail!("`--expected-constant`: each method has a constant of its own; give one method");
        }
        Ok(())
    }

    /// The levels, and the fit of space and time if an option requests it.
    fn solve<T: Solvable>(
        &self,
        scene: &Scene<T>,
        method: &Method,
        progress: &dyn Follow,
    ) -> (Vec<Solved>, Option<Fit>) {
        let wanted = self.wanted();
        let run = |method: &Method, cells: Division, watch: Watch| {
            let mut progress_of_run = progress.of(cells);
            let mut phases = Phases::new(&wanted, &mut *progress_of_run);
            let run = scene.run(method, &cells, watch, &mut phases);
            let phases = phases.found();
            match run.as_ref().map(|run| &run.level.errors) {
                Ok(Ok(_)) => {}
                Ok(Err(failure)) => progress.say(&format!("{cells} cells: {}", failure.place())),
                Err(refusal) => progress.say(&format!("{cells} cells: not started: {refusal}")),
            }
            run.map(|run| (run, phases)).map_err(|reason| UnstartedLevel { cells, reason })
        };
        let planned = self.planned(scene, method);
        // The number of steps to an equilibrium is not known in advance.
        if !method.setup.relax {
            let estimated =
                estimate(planned.len(), self.refine == Refinement::Space, |run, trial| {
                    let (method, cells, watch) = &planned[run];
                    // The trial ends early; if it cannot be started, the run itself reports the reason.
                    let _ = scene.run(method, cells, *watch, trial);
                });
            estimated.iter().for_each(|it| progress.say(it));
        }
        let levels = self.levels(scene, method, &run);
        let mut all: Vec<_> = levels.iter().flatten().map(|(run, _)| run.level.clone()).collect();
        if self.fit {
            for cells in levels.iter().flatten().map(|(run, _)| run.level.cells) {
                let halved =
                    [1, 2].map(|times| run(&halved(method, times), cells, Watch::Displacement));
                all.extend(halved.into_iter().flatten().map(|(run, _)| run.level));
            }
        }
        progress.finish();
        let errors = all.iter().filter_map(|level| {
            let errors = level.errors.as_ref().ok()?;
            Some([level.cell_size, level.time_step, errors.l2])
        });
        let found = self.fit.then(|| fit(&errors.collect::<Vec<_>>())).flatten();
        if self.fit && found.is_none() {
            progress.say("note: nothing fits the errors of these runs; give three grids or more");
        }
        (levels, found)
    }

    /// The planned runs, unless a level is refused; in space, their time steps are still to be replaced by the finest level's.
    fn planned<T: Real>(
        &self,
        scene: &Scene<T>,
        method: &Method,
    ) -> Vec<(Method, Division, Watch)> {
        match self.refine {
            Refinement::Time => {
                let cells = self.grid_of_time(scene);
                let levels = (0..self.levels_in_time()).map(|level| halved(method, level));
                levels.map(|method| (method, cells, Watch::Parts(PARTS))).collect()
            }
            Refinement::Both => {
                let grids = self.grids(scene);
                let levels = grids.iter().map(|cells| (method.clone(), *cells, Watch::Everything));
                let fitted = grids.iter().filter(|_| self.fit).flat_map(|cells| {
                    [1, 2].map(|times| (halved(method, times), *cells, Watch::Displacement))
                });
                levels.chain(fitted).collect()
            }
            Refinement::Space => {
                let grids = self.grids(scene).into_iter();
                grids.map(|cells| (quartered(method), cells, Watch::Everything)).collect()
            }
        }
    }

    /// The grid of a study in time, and how many levels it has.
    fn grid_of_time<T: Real>(&self, scene: &Scene<T>) -> Division {
        let cells = self.cells.first().copied();
        cells.unwrap_or(Division::Uniform(scene.cells_of_a_study_in_time()))
    }

    fn levels_in_time(&self) -> u32 {
        self.levels.map_or(4, u32::from)
    }

    fn levels<T: Real>(
        &self,
        scene: &Scene<T>,
        method: &Method,
        run: &dyn Fn(&Method, Division, Watch) -> Solved,
    ) -> Vec<Solved> {
        match self.refine {
            _ if method.setup.relax => {
                let cells = self.grids(scene).into_iter();
                cells.map(|cells| run(method, cells, Watch::Everything)).collect()
            }
            Refinement::Time => {
                let cells = self.grid_of_time(scene);
                let levels = (0..self.levels_in_time()).map(|level| halved(method, level));
                levels.map(|method| run(&method, cells, Watch::Parts(PARTS))).collect()
            }
            Refinement::Both => {
                let cells = self.grids(scene).into_iter();
                cells.map(|cells| run(method, cells, Watch::Everything)).collect()
            }
            Refinement::Space => {
                // In a quarter of the usual step, the error of time is a sixteenth.
                let (mut method, mut levels) = (quartered(method), Vec::new());
                for cells in self.grids(scene).into_iter().rev() {
                    let level = run(&method, cells, Watch::Everything);
                    if let (None, Ok((run, _))) = (method.setup.time_step, &level) {
                        method.setup.time_step = Some(run.level.time_step);
                    }
                    levels.push(level);
                }
                levels.reverse();
                levels
            }
        }
    }

    /// The levels of a study in space, from coarse to fine: orders are those between neighbours.
    fn grids<T: Real>(&self, scene: &Scene<T>) -> Vec<Division> {
        let mut cells = self.cells.clone();
        if cells.is_empty() {
            cells.extend(scene.default_cells().iter().map(|&cells| Division::Uniform(cells)));
        }
        let size = |cells: &Division| scene.cell_size(cells);
        cells.sort_by(|a, b| size(b).total_cmp(&size(a)));
        cells
    }

    /// The order to judge against, and how far from it is still as expected.
    fn expectation(&self, input: &Input, method: &MethodOptions) -> ExpectedOrder {
        let entry = input.compiled.field.studies.iter().find(|entry| {
            let (shape, integrator) = (method.shape.name(), method.integrator.name());
            entry.is_of(shape, integrator, method.formulation.name())
        });
        let order = self.expected_order.or(entry.map(|entry| entry.order)).unwrap_or(2.0);
        ExpectedOrder::new(order, entry.and_then(|entry| entry.tolerance).unwrap_or(TOLERANCE))
    }
}
