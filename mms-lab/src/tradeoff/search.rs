//! The search: from a few coarse runs of everything to a few fine runs of the best.
//!
//! | step | runs |
//! |---|---|
//! | screen | every formulation and shape function on two coarse grids: which error, which order |
//! | tune | the best of them, one axis at a time, on the finer of these grids |
//! | reach | the setting with the best prediction, on finer and coarser grids, until the goal is met with little to spare |
//! | surround | the choice on two coarser grids, and the default on the one that it needs |
//!
//! A prediction follows a power law in the number of cells n: the error is of the observed order, memory grows with n^D,
//! particle-steps and time with n^(D+1). Predictions only decide what is run next: the chosen run was made, and meets the goal.
//! `docs/reference/study.md` has the numbers.

use anyhow::Context as _;
use mms_files::words::{bytes, duration};

use super::setting::{Axis, Setting};

/// The cost to minimise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Cost {
    /// The particle-steps times the time of one, measured in the longest runs with the same method.
    #[default]
    Seconds,
    /// The number of particles times the number of steps, the same on every machine.
    ParticleSteps,
    /// The largest number of bytes at one time.
    Memory,
}

impl Cost {
    /// A value for a person.
    pub fn show(self, value: f64) -> String {
        match self {
            Cost::Seconds => duration(value),
            Cost::ParticleSteps => format!("{value:.2e} particle-steps"),
            Cost::Memory => bytes(value),
        }
    }

    /// The words after a factor of the cost, as in "2 times as long".
    pub fn verb(self) -> &'static str {
        match self {
            Cost::Seconds => "times as long",
            Cost::ParticleSteps => "times as many particle-steps",
            Cost::Memory => "times the memory",
        }
    }
}

/// The goal that the choice has to meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// An error of at most this, at the least cost.
    Error(f64),
    /// A cost of at most this, with the least error.
    Cost(f64),
}

/// A run and its result.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The setting.
    pub setting: Setting,
    /// Cells along the longest edge of the body.
    pub cells: usize,
    /// Particles; 0 if it was not started.
    pub particles: usize,
    /// Steps; 0 if it was not started.
    pub steps: usize,
    /// The largest error of the displacement over time and particles, or the reason why it is missing.
    pub error: Result<f64, String>,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// The largest memory in use at a time, in bytes.
    pub memory: f64,
}

impl Trial {
    /// Particles times steps.
    pub fn particle_steps(&self) -> f64 {
        self.particles as f64 * self.steps as f64
    }
}

/// Makes runs.
pub trait Runner {
    /// The outcome of a run.
    ///
    /// # Errors
    /// The run could not be tried.
    fn run(&mut self, setting: &Setting, cells: usize) -> anyhow::Result<Trial>;
}

/// The problem that a search solves: a goal, a cost, and limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchProblem {
    /// The dimension of the body.
    pub dimension: usize,
    /// Numbers of cells are multiples of this.
    pub grain: usize,
    /// The goal that the choice has to meet.
    pub goal: Goal,
    /// The cost to minimise.
    pub cost: Cost,
    /// The largest predicted number of particle-steps of a run; others are not begun.
    pub most_work: f64,
    /// The approximate number of particle-steps on one cell, with one particle in it and a Courant number of 1.
    pub unit_work: f64,
}

impl SearchProblem {
    /// The coarse grids that everything is tried on.
    pub fn screen(&self) -> [usize; 2] {
        let coarse = [32, 16, 4][self.dimension - 1];
        let coarse = self.round_up_to_grain(coarse as f64);
        [coarse, 2 * coarse]
    }

    /// The predicted number of particle-steps of a setting on a grid, before any run.
    pub fn work(&self, setting: &Setting, cells: usize) -> f64 {
        let dimension = self.dimension as i32;
        let particles = (setting.particles as f64).powi(dimension);
        self.unit_work * particles * (cells as f64).powi(dimension + 1) / setting.courant
    }

    /// The nearest number of cells that is not less.
    fn round_up_to_grain(&self, cells: f64) -> usize {
        ((cells / self.grain as f64).ceil().max(1.0) as usize).saturating_mul(self.grain)
    }

    /// The power of the number of cells with which the cost grows.
    fn growth(&self) -> f64 {
        let dimension = self.dimension as f64;
        if self.cost == Cost::Memory { dimension } else { dimension + 1.0 }
    }
}

/// A power law through a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Cells of the run.
    pub cells: f64,
    /// The error of the run.
    pub error: f64,
    /// The cost of the run.
    pub cost: f64,
    /// The particle-steps of the run.
    pub work: f64,
    /// The order of the error; `None` if it does not shrink.
    pub order: Option<f64>,
}

/// The prediction of a power law for another grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The number of cells.
    pub cells: f64,
    /// The error there.
    pub error: f64,
    /// The cost there.
    pub cost: f64,
    /// The particle-steps there.
    pub work: f64,
}

/// Observed orders below the first count as none, and orders above the second are not believed on coarse grids.
const ORDERS: [f64; 2] = [0.5, 2.2];

/// The order that is assumed for a setting with a single run, because coarser ones stopped: the methods are designed for this
/// order.
const ASSUMED: f64 = 2.0;

/// The factor by which another setting has to be better to be preferred: times are not known more accurately.
const GAIN: f64 = 0.9;

/// The largest number of settings that are tuned, and the factor by which their predictions may be worse than the best.
const TUNED: (usize, f64) = (3, 4.0);

/// A run is long if it has at least 1/`LONG` of the particle-steps of the longest run. The fastest long run determines the time
/// of a particle-step, since other programs may slow down the rest.
const LONG: f64 = 8.0;

/// The number of runs of a setting to meet the goal.
const TRIES: usize = 8;

impl Line {
    fn at(&self, ratio: f64, dimension: usize, growth: f64) -> Prediction {
        let order = self.order.unwrap_or(0.0);
        Prediction {
            cells: self.cells * ratio,
            error: self.error * ratio.powf(-order),
            cost: self.cost * ratio.powf(growth),
            work: self.work * ratio.powi(dimension as i32 + 1),
        }
    }

    /// The grid that just meets a goal; `None` if no grid does.
    pub fn meet(&self, problem: &SearchProblem) -> Option<Prediction> {
        let growth = problem.growth();
        let ratio = match (problem.goal, self.order) {
            (Goal::Error(target), Some(order)) => {
                let coarsest = problem.grain as f64 / self.cells;
                (self.error / target).powf(1.0 / order).max(coarsest)
            }
            // Without an order, every grid is predicted to have the same error, so coarser grids are not searched.
            (Goal::Error(target), None) => (self.error <= target).then_some(1.0)?,
            (Goal::Cost(budget), _) => (budget / self.cost).powf(1.0 / growth),
        };
        Some(self.at(ratio, problem.dimension, growth))
    }
}

/// A search.
pub struct Search<'a> {
    runner: &'a mut dyn Runner,
    problem: SearchProblem,
    /// All runs, in the order in which they were made.
    pub trials: Vec<Trial>,
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeoffResult {
    /// All runs, in the order in which they were made.
    pub trials: Vec<Trial>,
    /// The run that meets the goal best, by position.
    pub choice: Option<usize>,
    /// The setting with the best prediction, and the prediction, if no run meets the goal.
    pub predicted: Option<(Setting, Prediction)>,
    /// The predicted cost of the default to meet the goal, or its predicted error at the given cost.
    pub default: Option<Prediction>,
}

impl<'a> Search<'a> {
    /// Searches.
    ///
    /// # Errors
    /// A run that could not be tried.
    pub fn run(
        runner: &'a mut dyn Runner,
        problem: SearchProblem,
    ) -> anyhow::Result<TradeoffResult> {
        let mut search = Search { runner, problem, trials: Vec::new() };
        let mut candidates = search.screen()?;
        let mut tuned = Vec::new();
        for candidate in &candidates {
            tuned.extend(search.tune(*candidate)?);
        }
        candidates.extend(tuned);
        search.reach_best(candidates)?;
        search.reach_others()?;
        search.surround()?;
        let predicted = match search.choice() {
            Some(_) => None,
            None => search.best_prediction(),
        };
        let default = search.line(&Setting::default()).and_then(|line| line.meet(&problem));
        Ok(TradeoffResult { choice: search.choice(), predicted, default, trials: search.trials })
    }

    /// Makes a run that has not been made, unless its predicted work is too large.
    fn trial(&mut self, setting: &Setting, cells: usize) -> anyhow::Result<()> {
        let same = |trial: &Trial| trial.setting == *setting && trial.cells == cells;
        if !self.trials.iter().any(same) && self.work(setting, cells) <= self.problem.most_work {
            let trial = self.runner.run(setting, cells)?;
            self.trials.push(trial);
        }
        Ok(())
    }

    /// The predicted number of particle-steps of a setting on a grid: by its finest run, if there is one.
    fn work(&self, setting: &Setting, cells: usize) -> f64 {
        match self.finished(setting).last() {
            Some(run) => {
                let ratio = cells as f64 / run.cells as f64;
                run.particle_steps() * ratio.powi(self.problem.dimension as i32 + 1)
            }
            None => self.problem.work(setting, cells),
        }
    }

    /// The cost of a run.
    fn cost(&self, trial: &Trial) -> f64 {
        cost(&self.trials, trial, self.problem.cost)
    }

    /// The settings that are worth tuning, the best first.
    fn screen(&mut self) -> anyhow::Result<Vec<Setting>> {
        let mut predicted = Vec::new();
        for kind in Setting::kinds() {
            for cells in self.problem.screen() {
                self.trial(&kind, cells)?;
            }
        }
        for kind in Setting::kinds() {
            predicted.extend(self.loss(&kind).map(|loss| (loss, kind)));
        }
        predicted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let least = predicted.first().map_or(0.0, |(loss, _)| *loss);
        let (most, factor) = TUNED;
        let good = predicted.into_iter().filter(|(loss, _)| *loss <= least * factor);
        Ok(good.take(most).map(|(_, setting)| setting).collect())
    }

    /// The best settings around one: in the best precision and form, and in the default precision and form.
    fn tune(&mut self, start: Setting) -> anyhow::Result<Vec<Setting>> {
        let [coarse, fine] = self.problem.screen();
        let mut best = start;
        for round in 0..2 {
            let before = best;
            for axis in [Axis::Transfer, Axis::Integrator, Axis::Courant, Axis::Particles] {
                // The parts of a method are tried only once.
                if round == 0 || matches!(axis, Axis::Courant | Axis::Particles) {
                    best = self.improve(best, axis, fine)?;
                }
            }
            if best == before {
                break;
            }
        }
        let mut found = vec![best];
        // The other form may be interpreted, and take long.
        for (axis, cells) in [(Axis::Precision, fine), (Axis::Form, coarse)] {
            let better = self.improve(best, axis, cells)?;
            if better != best {
                found.push(better);
                best = better;
            }
        }
        Ok(found)
    }

    /// Follows the neighbours of a setting along an axis as long as they are better on a grid.
    fn improve(&mut self, start: Setting, axis: Axis, cells: usize) -> anyhow::Result<Setting> {
        self.trial(&start, cells)?;
        let mut best = start;
        for row in start.neighbours(axis) {
            for setting in row {
                self.trial(&setting, cells)?;
                let [old, new] = [&best, &setting].map(|it| self.loss_on(it, cells));
                match (old, new) {
                    (None, Some(_)) => best = setting,
                    (Some(old), Some(new)) if new < GAIN * old => best = setting,
                    // One step along the axis may change too little: go on unless the loss grows by more than 1/`GAIN`.
                    (Some(old), Some(new)) if new < old / GAIN => {}
                    _ => break,
                }
            }
        }
        Ok(best)
    }

    /// The setting's power law through its run on a grid, with its own order or, if that is not known, the order of the default
    /// setting with its formulation and shape function.
    fn line_on(&self, setting: &Setting, cells: usize) -> Option<Line> {
        let same = |trial: &&Trial| trial.setting == *setting && trial.cells == cells;
        let trial = self.trials.iter().find(same)?;
        let kind = Setting {
            formulation: setting.formulation,
            shape: setting.shape,
            ..Setting::default()
        };
        let order = self.order(setting).or_else(|| self.order(&kind)).unwrap_or(ASSUMED);
        self.through(trial, order)
    }

    /// The setting's power law through its finest run.
    fn line(&self, setting: &Setting) -> Option<Line> {
        let runs = self.finished(setting);
        self.line_on(setting, runs.last()?.cells)
    }

    fn through(&self, trial: &Trial, order: f64) -> Option<Line> {
        let error = *trial.error.as_ref().ok()?;
        let order = (order >= ORDERS[0]).then_some(order.min(ORDERS[1]));
        let (cells, cost, work) = (trial.cells as f64, self.cost(trial), trial.particle_steps());
        Some(Line { cells, error, cost, work, order })
    }

    /// The finished runs of a setting, coarse to fine.
    fn finished(&self, setting: &Setting) -> Vec<&Trial> {
        let own = |trial: &&Trial| trial.setting == *setting && trial.error.is_ok();
        let mut runs: Vec<_> = self.trials.iter().filter(own).collect();
        runs.sort_by_key(|trial| trial.cells);
        runs
    }

    /// The order between the finest run and the finest run with at most 4/5 of its cells; `None` if one of them is missing or
    /// has no error.
    fn order(&self, setting: &Setting) -> Option<f64> {
        let runs = self.finished(setting);
        let fine = runs.last()?;
        let coarse = runs.iter().rev().find(|trial| 5 * trial.cells <= 4 * fine.cells)?;
        let [Ok(coarse_error), Ok(fine_error)] = [&coarse.error, &fine.error] else { return None };
        let order =
            (coarse_error / fine_error).ln() / (fine.cells as f64 / coarse.cells as f64).ln();
        order.is_finite().then_some(order)
    }

    /// The distance of a power law from the goal: the cost that meets an error, or the error that meets a cost.
    fn loss_of_line(&self, line: &Line) -> Option<f64> {
        let met = line.meet(&self.problem)?;
        Some(match self.problem.goal {
            Goal::Error(_) => met.cost,
            Goal::Cost(_) => met.error,
        })
    }

    fn loss_on(&self, setting: &Setting, cells: usize) -> Option<f64> {
        self.loss_of_line(&self.line_on(setting, cells)?)
    }

    fn loss(&self, setting: &Setting) -> Option<f64> {
        self.loss_of_line(&self.line(setting)?)
    }

    /// Runs the setting with the best prediction, if it is within the allowed work; and the settings after it, as long as they
    /// are predicted to be better than the best run.
    fn reach_best(&mut self, mut candidates: Vec<Setting>) -> anyhow::Result<()> {
        while !candidates.is_empty() {
            let loss = |at: &usize| self.loss(&candidates[*at]).unwrap_or(f64::INFINITY);
            let best = (0..candidates.len()).min_by(|a, b| loss(a).total_cmp(&loss(b)));
            let best = best.context("there are candidates")?;
            let predicted = loss(&best);
            let found =
                self.choice().map(|at| &self.trials[at]).map(|trial| match self.problem.goal {
                    Goal::Error(_) => self.cost(trial),
                    Goal::Cost(_) => trial.error.clone().unwrap_or(f64::INFINITY),
                });
            if predicted.is_infinite() || found.is_some_and(|found| predicted > GAIN * found) {
                break;
            }
            let setting = candidates.remove(best);
            self.reach(&setting)?;
        }
        Ok(())
    }

    /// While no run meets the goal, runs the setting, among all that were tried, that is predicted to meet it.
    fn reach_others(&mut self) -> anyhow::Result<()> {
        while self.choice().is_none() {
            let Some((setting, _)) = self.best_prediction() else { break };
            if self.next(&setting).is_none() {
                break;
            }
            self.reach(&setting)?;
        }
        Ok(())
    }

    /// Runs a setting on ever better grids.
    fn reach(&mut self, setting: &Setting) -> anyhow::Result<()> {
        for _ in 0..TRIES {
            let Some(cells) = self.next(setting) else { break };
            self.trial(setting, cells)?;
        }
        Ok(())
    }

    /// The next grid for a setting; `None` if the goal is met with little to spare, or cannot be met.
    fn next(&self, setting: &Setting) -> Option<usize> {
        let line = self.line_near(setting)?;
        let met = line.meet(&self.problem)?;
        let own = self.trials.iter().filter(|trial| trial.setting == *setting);
        let (good, bad): (Vec<&Trial>, Vec<&Trial>) = own.partition(|trial| self.meets(trial));
        let [good, bad] =
            [good, bad].map(|runs| runs.into_iter().map(|it| it.cells).collect::<Vec<_>>());
        let grain = self.problem.grain;
        // The grid must be between the grids known to be too coarse and too fine.
        let (low, high) = match self.problem.goal {
            Goal::Error(_) => {
                let high = good.iter().copied().min();
                (bad.into_iter().filter(|&it| high.is_none_or(|high| it < high)).max(), high)
            }
            Goal::Cost(_) => {
                let low = good.iter().copied().max();
                (low, bad.into_iter().filter(|&it| low.is_none_or(|low| it > low)).min())
            }
        };
        // A grid that is predicted to meet the goal exactly often misses it slightly.
        let cells = match self.problem.goal {
            Goal::Error(_) => self.problem.round_up_to_grain(met.cells * 1.01),
            Goal::Cost(_) => {
                self.problem.round_up_to_grain(met.cells * 0.99).saturating_sub(grain).max(grain)
            }
        };
        let least = low.map_or(grain, |low| low + grain);
        let most = high.map_or(4 * line.cells as usize + grain, |high| high.saturating_sub(grain));
        let near = low.zip(high).is_some_and(|(low, high)| high as f64 <= 1.04 * low as f64);
        if least > most || near {
            return None;
        }
        let cells = cells.clamp(least, most);
        let spare = match (self.problem.goal, low, high) {
            (Goal::Error(_), _, Some(high)) => high as f64 / cells as f64,
            (Goal::Cost(_), Some(low), _) => cells as f64 / low as f64,
            _ => f64::INFINITY,
        };
        (spare > 1.04 && self.work(setting, cells) <= self.problem.most_work).then_some(cells)
    }

    /// The setting's power law through the run that is nearest to the goal.
    fn line_near(&self, setting: &Setting) -> Option<Line> {
        let distance = |line: &Line| match self.problem.goal {
            Goal::Error(target) => (line.error / target).ln().abs(),
            Goal::Cost(budget) => (line.cost / budget).ln().abs(),
        };
        let runs = self.finished(setting).into_iter();
        let lines = runs.filter_map(|trial| self.line_on(setting, trial.cells));
        lines.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Whether a run meets the goal.
    fn meets(&self, trial: &Trial) -> bool {
        let Ok(error) = trial.error else { return false };
        match self.problem.goal {
            Goal::Error(target) => error <= target,
            Goal::Cost(budget) => self.cost(trial) <= budget,
        }
    }

    /// The best run that meets the goal; the first of equal ones.
    fn choice(&self) -> Option<usize> {
        let loss = |at: &usize| match (self.problem.goal, &self.trials[*at].error) {
            (Goal::Error(_), _) => self.cost(&self.trials[*at]),
            (_, Ok(error)) => *error,
            (_, Err(_)) => f64::INFINITY,
        };
        let met = (0..self.trials.len()).filter(|at| self.meets(&self.trials[*at]));
        met.min_by(|a, b| loss(a).total_cmp(&loss(b)))
    }

    /// Makes runs around the choice.
    fn surround(&mut self) -> anyhow::Result<()> {
        if let Some(choice) = self.choice().map(|at| self.trials[at].clone()) {
            for part in [2f64.sqrt(), 2.0] {
                let cells = self.problem.round_up_to_grain(choice.cells as f64 / part);
                self.trial(&choice.setting, cells)?;
            }
        }
        let default = Setting::default();
        for _ in 0..2 {
            let Some(cells) = self.next(&default) else { break };
            self.trial(&default, cells)?;
        }
        Ok(())
    }

    /// The setting with the best prediction.
    fn best_prediction(&self) -> Option<(Setting, Prediction)> {
        let mut settings: Vec<Setting> = Vec::new();
        for trial in &self.trials {
            if !settings.contains(&trial.setting) {
                settings.push(trial.setting);
            }
        }
        let lines = settings.into_iter().filter_map(|it| {
            let line = self.line(&it)?;
            // A finer run has stopped: its power law has ended.
            let stopped = |trial: &Trial| trial.error.is_err() && trial.cells as f64 > line.cells;
            let has_ended = self.trials.iter().any(|trial| trial.setting == it && stopped(trial));
            let met = line.meet(&self.problem).filter(|_| !has_ended)?;
            Some((self.loss_of_line(&line)?, it, met))
        });
        let best = lines.min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, setting, prediction)| (setting, prediction))
    }
}

/// The cost of `trial`, one of `trials`.
pub fn cost(trials: &[Trial], trial: &Trial, cost: Cost) -> f64 {
    match cost {
        Cost::Memory => trial.memory,
        Cost::ParticleSteps => trial.particle_steps(),
        Cost::Seconds => {
            let same = |it: &&Trial| it.error.is_ok() && it.setting.same_step(&trial.setting);
            let runs = || trials.iter().filter(same).chain([trial]);
            let longest = runs().map(Trial::particle_steps).fold(0.0, f64::max);
            let long = runs().filter(|it| it.particle_steps() * LONG >= longest);
            let each = long.map(|it| it.seconds / it.particle_steps().max(1.0));
            each.fold(f64::INFINITY, f64::min) * trial.particle_steps()
        }
    }
}
