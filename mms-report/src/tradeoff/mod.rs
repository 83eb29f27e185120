//! Error against cost, as a table, a sentence, a JSON document and a picture.

pub mod page;

use std::path::Path;

use mms_documents::provenance::Provenance;
use mms_documents::tradeoff as documents;
use mms_files::words::{bytes, duration};
use mms_files::write::{pretty, write_files};
use mms_lab::tradeoff::search::{
    Cost, Goal, Prediction, SearchProblem, TradeoffResult, Trial, cost,
};
use mms_lab::tradeoff::setting::{Axis, Setting};
use mms_spec::foreign::Foreign;

use super::front::front;
use super::page::Section as _;
use super::plot::Figure;
use crate::shown::Shown;
use crate::table::TextTable;
use crate::text::next;

/// The result of a search for a field.
pub struct Report<'a> {
    /// The field's name.
    pub field: Foreign,
    /// The field's title.
    pub title: Foreign,
    /// The unit of the displacement, if the field states units.
    pub unit: Option<String>,
    /// The problem that the search solves.
    pub problem: SearchProblem,
    /// The runs and predictions of the search.
    pub found: TradeoffResult,
    /// Whether all runs are shown, or only runs on the front, runs of the default and runs that stopped.
    pub all: bool,
    /// The command that runs a setting on a grid.
    pub command: &'a dyn Fn(&Setting, usize) -> String,
    /// The words of the command to type next.
    pub next: Option<Vec<String>>,
    /// The provenance.
    pub provenance: Provenance,
}

/// The factor around the choice's error within which runs determine the cost of more accuracy.
const NEAR: f64 = 10.0;

/// A factor for a person.
fn factor(value: f64) -> String {
    if value < 10.0 { format!("{value:.1}") } else { format!("{value:.0}") }
}

impl Report<'_> {
    fn trials(&self) -> &[Trial] {
        &self.found.trials
    }

    /// The cost of a run.
    pub fn cost(&self, trial: &Trial, measure: Cost) -> f64 {
        cost(self.trials(), trial, measure)
    }

    /// Cost and error of a run that has both.
    fn point(&self, trial: &Trial) -> Option<(f64, f64)> {
        let error = trial.error.clone().ok()?;
        let cost = self.cost(trial, self.problem.cost);
        (cost > 0.0).then_some((cost, error))
    }

    /// The runs that no other one beats in both, from cheap to accurate.
    pub fn front(&self) -> Vec<&Trial> {
        let all = self.trials().iter().filter_map(|trial| Some((trial, self.point(trial)?)));
        let (trials, points): (Vec<_>, Vec<_>) = all.unzip();
        front(&points).into_iter().map(|at| trials[at]).collect()
    }

    /// The run to choose.
    pub fn choice(&self) -> Option<&Trial> {
        self.found.choice.map(|at| &self.trials()[at])
    }

    /// Whether the choice has no error at all.
    fn is_exact(&self) -> bool {
        self.choice().is_some_and(|trial| trial.error == Ok(0.0))
    }

    /// s of cost = C error^-s, of the runs on the front around the choice.
    pub fn exponent(&self) -> Option<f64> {
        let (_, error) = self.point(self.choice()?)?;
        let points = self.front().into_iter().filter_map(|trial| self.point(trial));
        let near = points.filter(|point| point.1 < NEAR * error && error < NEAR * point.1);
        let logarithms: Vec<_> = near.map(|(cost, error)| (error.ln(), cost.ln())).collect();
        slope(&logarithms).map(|slope| -slope)
    }

    /// The values that were tried and were on the front in no run; with the reason, if no run of them ended. Empty if the
    /// choice has no error, because a higher cost gains nothing then.
    pub fn dominated(&self) -> Vec<String> {
        if self.is_exact() {
            return Vec::new();
        }
        let front = self.front();
        let mut dominated = Vec::new();
        for axis in Axis::ALL {
            let mut seen: Vec<String> = Vec::new();
            for trial in self.trials() {
                let word = trial.setting.word(axis);
                let same = |other: &Trial| other.setting.word(axis) == word;
                if seen.contains(&word) {
                    continue;
                }
                seen.push(word.clone());
                if front.iter().any(|other| same(other)) {
                    continue;
                }
                let ended = self.trials().iter().any(|other| same(other) && other.error.is_ok());
                dominated.push(if ended { word } else { format!("{word} (stops)") });
            }
        }
        dominated
    }

    /// The ratio of the cost of the default method to the cost of the choice, by their power laws.
    pub fn gain(&self) -> Option<f64> {
        let (default, choice) = (self.found.default?, self.choice()?);
        match self.problem.goal {
            Goal::Error(_) => Some(default.cost / self.cost(choice, self.problem.cost)),
            Goal::Cost(_) => Some(default.error / choice.error.clone().ok()?),
        }
    }

    fn run(&self, trial: &Trial, front: bool) -> documents::Trial {
        let Setting { formulation, shape, integrator, transfer, .. } = trial.setting;
        let started = trial.steps > 0;
        documents::Trial {
            command: (self.command)(&trial.setting, trial.cells),
            formulation: formulation.name().to_owned(),
            shape: shape.name().to_owned(),
            integrator: integrator.name().to_owned(),
            transfer: transfer.to_string(),
            particles_per_cell: trial.setting.particles,
            courant: trial.setting.courant,
            precision: trial.setting.arithmetic.precision.name().to_owned(),
            form: trial.setting.arithmetic.form.name().to_owned(),
            cells: trial.cells,
            particles: started.then_some(trial.particles),
            steps: started.then_some(trial.steps),
            linf: trial.error.as_ref().ok().copied(),
            particle_steps: started.then(|| trial.particle_steps()),
            seconds: trial.error.is_ok().then(|| self.cost(trial, Cost::Seconds)),
            memory: started.then_some(trial.memory),
            front,
            failure: trial.error.as_ref().err().cloned(),
        }
    }

    /// The runs from cheap to expensive, and runs that stopped.
    fn table(&self) -> TextTable {
        let caption = format!("{}: error against cost", self.field.shown());
        let header = ["", "cells", "linf", "particle-steps", "time", "memory", "setting"];
        let mut table = TextTable::new(caption, header).right(1..6);
        let front = self.front();
        let mut ended: Vec<_> =
            self.trials().iter().filter_map(|trial| Some((self.point(trial)?, trial))).collect();
        ended.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
        for ((_, error), trial) in ended {
            let is = |other: &Trial| std::ptr::eq(other, trial);
            let is_best = front.iter().any(|other| is(other));
            if !self.all && !is_best && trial.setting != Setting::default() {
                continue;
            }
            table.add_row([
                match () {
                    () if self.choice().is_some_and(is) => "=>",
                    () if is_best => "*",
                    () => "",
                }
                .to_owned(),
                trial.cells.to_string(),
                format!("{error:.2e}"),
                format!("{:.2e}", trial.particle_steps()),
                duration(self.cost(trial, Cost::Seconds)),
                bytes(trial.memory),
                trial.setting.to_string(),
            ]);
        }
        for trial in self.trials() {
            let Err(reason) = &trial.error else { continue };
            let what = format!("{}: {}", trial.setting, cause(reason));
            let [cells, none] = [trial.cells.to_string(), "-".to_owned()];
            let stopped = "stopped".to_owned();
            table.add_row([String::new(), cells, stopped, none.clone(), none.clone(), none, what]);
        }
        table
    }

    /// The recommendation in sentences.
    pub fn advice(&self) -> String {
        let measure = self.problem.cost;
        let mut sentences = Vec::new();
        match (self.choice(), self.problem.goal) {
            _ if self.trials().is_empty() => sentences.push(format!(
                "No run was made: each is predicted to take more than {:.1e} particle-steps; raise `--most-work`.",
                self.problem.most_work
            )),
            (Some(trial), goal) => {
                let error = trial.error.as_ref().map_or(f64::INFINITY, |error| *error);
                let asked = match goal {
                    Goal::Error(target) => format!("For a largest error of {target:e}"),
                    Goal::Cost(budget) => format!("Within {}", measure.show(budget)),
                };
                let took = measure.show(self.cost(trial, measure));
                sentences.push(format!(
                    "{asked} choose {}, on {} cells: {error:.2e} in {took}.",
                    trial.setting, trial.cells
                ));
            }
            (None, Goal::Error(target)) => sentences.push(self.unreached(target)),
            (None, Goal::Cost(budget)) => sentences.push(format!(
                "No run costs as little as {}: allow more.",
                measure.show(budget)
            )),
        }
        if self.is_exact() {
            sentences.push(self.exact());
        }
        if self.choice().is_some() {
            sentences.push(self.compared());
        }
        if let Some(exponent) = self.exponent() {
            sentences.push(format!(
                "Half the error costs {} {} there: along the front the cost grows as 1/error^{exponent:.2}.",
                factor(2f64.powf(exponent)),
                measure.verb()
            ));
        }
        let dominated = self.dominated();
        if !dominated.is_empty() {
            sentences.push(format!(
                "Dominated in every run, for all other choices: {}.",
                dominated.join(", ")
            ));
        }
        sentences.join("\n")
    }

    /// The number of runs that are as exact as the choice.
    fn exact(&self) -> String {
        let errors: Vec<_> = self.trials().iter().filter_map(|it| it.error.clone().ok()).collect();
        let exact = errors.iter().filter(|error| **error == 0.0).count();
        format!(
            "{exact} of the {} runs that ended make no error: only their cost distinguishes them.",
            errors.len()
        )
    }

    /// The default beside the choice.
    fn compared(&self) -> String {
        let setting = Setting::default();
        if self.choice().is_some_and(|trial| trial.setting == setting) {
            return "That is the default method.".into();
        }
        let (gain, default) = match (self.gain(), self.found.default) {
            (Some(gain), Some(default)) => (gain, default),
            _ => return format!("The default, {setting}, does not reach it: {}.", self.why_not()),
        };
        match self.problem.goal {
            Goal::Error(_) => format!(
                "The default, {setting}, takes {} {} for that, on about {:.0} cells.",
                factor(gain),
                self.problem.cost.verb(),
                default.cells
            ),
            Goal::Cost(_) => {
                format!(
                    "The default, {setting}, has {} times that error, {:.2e}.",
                    factor(gain),
                    default.error
                )
            }
        }
    }

    /// The reason why the default meets no goal.
    pub fn why_not(&self) -> String {
        let own = self.trials().iter().filter(|trial| trial.setting == Setting::default());
        let reason = own.filter_map(|trial| trial.error.as_ref().err()).next();
        reason.cloned().unwrap_or_else(|| "its error does not shrink with the cells".into())
    }

    /// The reason why no run meets a target.
    pub fn unreached(&self, target: f64) -> String {
        let least = self.front().last().and_then(|trial| Some((trial.error.clone().ok()?, *trial)));
        let least = least.map_or("no run reached its end".into(), |(error, trial)| {
            format!("the least is {error:.2e}, of {} on {} cells", trial.setting, trial.cells)
        });
        let more = match &self.found.predicted {
            Some((setting, it)) => format!(
                "{setting} is predicted to get there on {:.0} cells in {:.1e} particle-steps, where runs of more \
                 than {:.1e} are left out: raise `--most-work`",
                it.cells, it.work, self.problem.most_work
            ),
            None => "no setting is predicted to get there: errors no longer shrink with the cells, or runs stop".into(),
        };
        format!("An error of {target:e} is not reached: {least}; {more}.")
    }

    /// Writes tradeoff.json and tradeoff.svg, and returns their paths.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        let files = [("json", pretty(&self.document())?), ("svg", self.figure().svg())];
        write_files(folder, "tradeoff", files)
    }

    /// The figure of the runs.
    pub fn figure(&self) -> Figure {
        let title = format!("{}: error against cost", self.field.shown());
        Figure::new(title, self.document().plots())
    }
}

impl Shown for Report<'_> {
    type Document = documents::Tradeoff;

    fn text(&self) -> String {
        let next = next(self.next.as_ref()).map_or(String::new(), |line| format!("\n{line}"));
        format!(
            "{}: {}\n\n{}\n\n{}{next}",
            self.field.shown(),
            self.title.shown(),
            self.table(),
            self.advice()
        )
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table()]
    }

    fn document(&self) -> documents::Tradeoff {
        let front = self.front();
        let runs = self.trials().iter().map(|trial| {
            let on_front = front.iter().any(|other| std::ptr::eq(*other, trial));
            self.run(trial, on_front)
        });
        let (target, budget) = match self.problem.goal {
            Goal::Error(target) => (Some(target), None),
            Goal::Cost(budget) => (None, Some(budget)),
        };
        let cost = self.problem.cost;
        let prediction = |setting: &Setting, it: &Prediction| documents::Prediction {
            setting: setting.to_string(),
            cells: it.cells,
            linf: it.error,
            seconds: (cost == Cost::Seconds).then_some(it.cost),
            memory: (cost == Cost::Memory).then_some(it.cost),
            particle_steps: it.work,
        };
        documents::Tradeoff {
            field: self.field.raw().to_owned(),
            unit: self.unit.clone(),
            cost: match cost {
                Cost::Seconds => documents::Cost::Seconds,
                Cost::ParticleSteps => documents::Cost::ParticleSteps,
                Cost::Memory => documents::Cost::Memory,
            },
            target_linf: target,
            budget_seconds: budget,
            runs: runs.collect(),
            choice: self.choice().map(|trial| self.run(trial, true)),
            predicted: self.found.predicted.as_ref().map(|(setting, it)| prediction(setting, it)),
            default: self.found.default.as_ref().map(|it| prediction(&Setting::default(), it)),
            gain: self.gain(),
            exponent: self.exponent(),
            dominated: self.dominated(),
            next_command: self.next.clone(),
            provenance: self.provenance.clone(),
        }
    }
}

/// The reason why a run stopped, without its place and advice.
fn cause(reason: &str) -> &str {
    let from = reason.find(": ").map_or(0, |at| at + 2);
    let rest = &reason[from..];
    rest.split([',', ';']).next().unwrap_or(rest)
}

/// The slope of the line that is nearest to some points, by least squares.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
    let (x, y) = (x / count, y / count);
    let along: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    let square: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    (square > 1e-6).then(|| along / square)
}
