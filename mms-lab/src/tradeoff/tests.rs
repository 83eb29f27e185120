//! The search on methods whose errors and costs are known in closed form.

use mms_options::method::Precision;
use mms_runtime::ShapeName;

use super::search::{Cost, Goal, Runner, Search, SearchProblem, TradeoffResult, Trial};
use super::setting::Setting;

/// Errors and times by formula, and the number of requests.
struct Known<E> {
    error: E,
    runs: usize,
}

impl<E: Fn(&Setting, f64) -> Result<f64, String>> Runner for Known<E> {
    fn run(&mut self, setting: &Setting, cells: usize) -> anyhow::Result<Trial> {
        self.runs += 1;
        let particles = cells * setting.particles;
        let steps = (2.0 * cells as f64 / setting.courant).ceil() as usize;
        Ok(Trial {
            setting: *setting,
            cells,
            particles,
            steps,
            error: (self.error)(setting, cells as f64),
            // With 10 % of a deterministic noise.
            seconds: 1e-7 * (particles * steps) as f64 * (1.0 + 0.1 * (cells as f64).sin()),
            memory: 200.0 * particles as f64,
        })
    }
}

fn problem(goal: Goal, cost: Cost) -> SearchProblem {
    SearchProblem { dimension: 1, grain: 1, goal, cost, most_work: 1e8, unit_work: 2.0 }
}

fn search(
    problem: SearchProblem,
    error: impl Fn(&Setting, f64) -> Result<f64, String>,
) -> (TradeoffResult, usize) {
    let mut known = Known { error, runs: 0 };
    let found = Search::run(&mut known, problem).unwrap();
    (found, known.runs)
}

/// CPDI is best, with 3 particles per cell and the largest possible step; all others converge, too.
fn smooth(setting: &Setting, cells: f64) -> Result<f64, String> {
    if setting.courant > 0.75 {
        return Err("unstable".into());
    }
    let space = match setting.shape {
        ShapeName::Cpdi => 0.1,
        ShapeName::Linear => return Ok(0.05),
        _ => 1.0,
    };
    let sampling = [9.0, 3.0, 1.0, 0.9][setting.particles - 1];
    Ok(space * sampling * (1.0 + setting.courant.powi(2)) / cells.powi(2))
}

fn choice(found: &TradeoffResult) -> &Trial {
    &found.trials[found.choice.expect("a choice")]
}

#[test]
fn the_cheapest_setting_meets_the_target_with_little_to_spare() {
    for cost in [Cost::ParticleSteps, Cost::Seconds] {
        for target in [1e-3, 1e-4, 1e-6] {
            let (found, runs) = search(problem(Goal::Error(target), cost), smooth);
            let best = choice(&found);
            assert_eq!(best.setting.shape, ShapeName::Cpdi);
            assert_eq!((best.setting.courant, best.setting.particles), (0.7, 3), "{best:?}");
            let error = best.error.clone().unwrap();
            // A coarse grid has few numbers of cells to choose from.
            let next = smooth(&best.setting, best.cells as f64 - 1.0).unwrap();
            assert!(error <= target && (next > target || error > 0.88 * target), "{best:?}");
            assert!(runs < 120, "{runs} runs");
            assert_eq!(runs, found.trials.len(), "nothing is run twice");
        }
    }
}

#[test]
fn a_budget_is_kept_and_used() {
    for budget in [1e-3, 0.1, 1.0] {
        let (found, _) = search(problem(Goal::Cost(budget), Cost::Seconds), smooth);
        let best = choice(&found);
        assert_eq!(best.setting.shape, ShapeName::Cpdi);
        let spent = super::search::cost(&found.trials, best, Cost::Seconds);
        assert!(spent <= budget && spent > 0.75 * budget, "{spent} of {budget}");
    }
}

/// Memory does not grow with the steps: more, smaller ones are better, as long as they reduce the error.
#[test]
fn what_is_to_be_small_decides() {
    let memory = search(problem(Goal::Error(1e-5), Cost::Memory), smooth).0;
    let work = search(problem(Goal::Error(1e-5), Cost::ParticleSteps), smooth).0;
    assert!(choice(&memory).memory < choice(&work).memory);
    assert!(choice(&memory).particle_steps() > choice(&work).particle_steps());
}

/// A floor that coarse grids do not show: the precision without it is taken in the end.
#[test]
fn round_off_that_shows_late_sends_the_search_back() {
    let floor = |setting: &Setting, cells: f64| {
        let error = smooth(setting, cells)?;
        Ok(if setting.arithmetic.precision == Precision::F32 { error.max(2e-5) } else { error })
    };
    let cheap = |setting: &Setting, cells: f64| {
        floor(setting, cells).map(|error| {
            if setting.arithmetic.precision == Precision::F32 { error / 1.5 } else { error }
        })
    };
    let (coarse, _) = search(problem(Goal::Error(1e-3), Cost::ParticleSteps), cheap);
    assert_eq!(choice(&coarse).setting.arithmetic.precision, Precision::F32);
    let (fine, _) = search(problem(Goal::Error(1e-6), Cost::ParticleSteps), cheap);
    assert_eq!(choice(&fine).setting.arithmetic.precision, Precision::F64);
    assert!(choice(&fine).error.clone().unwrap() <= 1e-6);
}

#[test]
fn what_is_out_of_reach_is_predicted_and_not_run() {
    let limited =
        SearchProblem { most_work: 1e6, ..problem(Goal::Error(1e-7), Cost::ParticleSteps) };
    let (found, _) = search(limited, smooth);
    assert!(found.choice.is_none());
    let (setting, prediction) = found.predicted.expect("a prediction");
    assert_eq!(setting.shape, ShapeName::Cpdi);
    assert!(prediction.work > 1e6 && prediction.error <= 1.001e-7, "{prediction:?}");
    assert!(found.trials.iter().all(|trial| trial.particle_steps() <= 1e6));
}

/// The limit also holds for the first runs, before there is anything to predict from.
#[test]
fn no_run_takes_more_than_it_may() {
    for (most_work, is_run) in [(1.0, false), (2e4, true)] {
        let limited =
            SearchProblem { most_work, ..problem(Goal::Error(1e-2), Cost::ParticleSteps) };
        let (found, _) = search(limited, smooth);
        assert_eq!(!found.trials.is_empty(), is_run);
        assert!(found.trials.iter().all(|trial| trial.particle_steps() <= 1.01 * most_work));
    }
}

/// A grid has at least one cell, for any error.
#[test]
fn an_error_of_nothing_is_met_on_the_coarsest_grid() {
    let (found, _) = search(problem(Goal::Error(1e-3), Cost::ParticleSteps), |_, _| Ok(0.0));
    assert_eq!(choice(&found).cells, 1);
    let default = found.default.expect("a prediction");
    assert!((default.cells, default.error) == (1.0, 0.0) && default.work > 0.0, "{default:?}");
}

#[test]
fn where_nothing_converges_there_is_no_choice_and_no_prediction() {
    let (found, _) = search(problem(Goal::Error(1e-6), Cost::ParticleSteps), |_, _| Ok(0.1));
    assert_eq!((found.choice, found.predicted), (None, None));
    let (found, runs) =
        search(problem(Goal::Error(1e-6), Cost::Seconds), |_, _| Err("stopped".into()));
    assert_eq!((found.choice, found.predicted, found.default), (None, None, None));
    assert_eq!(runs, 2 * Setting::kinds().len());
}

/// If the edges of a body are as 3 to 1, numbers of cells are multiples of 3.
#[test]
fn numbers_of_cells_divide_the_edges() {
    let grained = SearchProblem { grain: 3, ..problem(Goal::Error(1e-4), Cost::ParticleSteps) };
    let (found, _) = search(grained, smooth);
    assert!(found.choice.is_some());
    assert!(found.trials.iter().all(|trial| trial.cells % 3 == 0));
}
