//! Error against cost, and what to choose.

use maud::{Markup, html};
use mms_documents::tradeoff::{Cost, Tradeoff, Trial};
use mms_files::words::{bytes, duration};

use super::mark::{count, number, numbers, seconds, small, table, words};
use super::{Section, Verdicts};
use crate::plot::{Axis, Curve, Line, Plot};

/// The cost of a run; nothing if the run stopped.
fn cost_of(tradeoff: &Tradeoff, run: &Trial) -> Option<f64> {
    match tradeoff.cost {
        Cost::Seconds => run.seconds,
        Cost::ParticleSteps => run.particle_steps,
        Cost::Memory => run.memory,
    }
}

/// A cost with its unit.
fn cost_shown(tradeoff: &Tradeoff, value: f64) -> String {
    match tradeoff.cost {
        Cost::Seconds => duration(value),
        Cost::ParticleSteps => format!("{value:.2e} particle-steps"),
        Cost::Memory => bytes(value),
    }
}

/// The axis of costs.
fn axis(cost: Cost) -> Axis {
    let (name, unit) = match cost {
        Cost::Seconds => ("time of the run", Some("s".into())),
        Cost::ParticleSteps => ("particle-steps", None),
        Cost::Memory => ("memory", Some("bytes".into())),
    };
    Axis::of(name, unit.as_ref())
}

fn method(run: &Trial) -> String {
    format!("{} {} {} {}", run.formulation, run.shape, run.integrator, run.transfer)
}

impl Section for Tradeoff {
    fn title(&self) -> String {
        format!("{}: error against cost", self.field)
    }

    fn verdicts(&self) -> Verdicts {
        let word = if self.choice.is_some() { "reached" } else { "not reached" };
        Verdicts::one(word, self.choice.is_some())
    }

    fn plots(&self) -> Vec<Plot> {
        vec![plot(self)]
    }

    fn body(&self, id: &str) -> Markup {
        let (mut front, others): (Vec<_>, Vec<_>) = self.runs.iter().partition(|run| run.front);
        let own = |run: &Trial| cost_of(self, run).unwrap_or(f64::INFINITY);
        front.sort_by(|a, b| own(a).total_cmp(&own(b)));
        html! {
            (advice(self))
            @if let Some(svg) = plot(self).svg(&format!("{id}-plot")) {
                figure {
                    (svg)
                    figcaption {
                        "Down and left is better; both axes are logarithmic. No run is both cheaper and closer than one of the "
                        "Pareto front. The dashed line is the goal."
                    }
                }
            }
            (trials(self, "The Pareto front", &front))
            // On paper only if it is open.
            details.bulk {
                summary { "The " (others.len()) " other runs" }
                (trials(self, "Runs that others beat, and runs that stopped", &others))
            }
        }
    }
}

/// The goal of the search in words.
fn goal(tradeoff: &Tradeoff) -> Option<String> {
    let target = tradeoff.target_linf.map(|target| format!("for a largest error of {target:.2e}"));
    target.or_else(|| tradeoff.budget_seconds.map(|it| format!("within {}", duration(it))))
}

/// The recommended method, and the cost of a smaller error.
fn advice(tradeoff: &Tradeoff) -> Markup {
    html! {
        p {
            @if let Some(goal) = goal(tradeoff) { "Goal: the best method " (goal) ". " }
            @match &tradeoff.choice {
                Some(choice) => {
                    "Choose " strong { (method(choice)) } ", " (choice.precision) ", " (choice.form) " form, "
                    (choice.particles_per_cell) @if choice.particles_per_cell == 1 { " particle" } @else { " particles" }
                    " per cell and direction, Courant "
                    (choice.courant) ", on " (choice.cells) " cells: " (small(choice.linf)) " in "
                    (number(cost_of(tradeoff, choice), |cost| cost_shown(tradeoff, cost))) "."
                }
                None => { "No run that was made reaches it." }
            }
            @if tradeoff.choice.as_ref().is_some_and(|choice| choice.linf == Some(0.0)) {
                " It makes no error: only its cost distinguishes it from other runs without error."
            }
            @if let Some(next) = &tradeoff.predicted {
                " The best prediction is " (next.setting) " on " (number(Some(next.cells), |it| format!("{it:.0}")))
                " cells, with " (small(Some(next.linf))) "."
            }
            @if let Some(gain) = tradeoff.gain {
                " The method of " code { "mms run" } " without options has "
                (number(Some(gain), |it| format!("{it:.1}")))
                @if tradeoff.target_linf.is_some() { " times the cost." } @else { " times the error." }
            }
            @if let Some(exponent) = tradeoff.exponent {
                " Half the error costs " (number(Some(2f64.powf(exponent)), |it| format!("{it:.1}"))) " times as much there."
            }
        }
        @if let Some(choice) = &tradeoff.choice { p { code { (choice.command) } } }
        @if !tradeoff.dominated.is_empty() {
            p { "Dominated in every run, for all other choices: " (tradeoff.dominated.join(", ")) "." }
        }
    }
}

fn point(tradeoff: &Tradeoff, run: &Trial) -> Option<[f64; 2]> {
    Some([cost_of(tradeoff, run)?, run.linf?])
}

/// The errors of runs over their cost.
pub fn plot(tradeoff: &Tradeoff) -> Plot {
    let points = |on_front: bool| -> Vec<[f64; 2]> {
        let runs = tradeoff.runs.iter().filter(|run| run.front == on_front);
        runs.filter_map(|run| point(tradeoff, run)).collect()
    };
    let by_cost = |mut points: Vec<[f64; 2]>| {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    };
    let curve = |name: &str, style: usize, is_hollow: bool, line: Line, points| Curve {
        name: name.to_owned(),
        points,
        style,
        is_hollow,
        line,
        ..Curve::default()
    };
    let chosen = tradeoff.choice.iter().filter_map(|run| point(tradeoff, run)).collect();
    let all = [points(true), points(false)].concat();
    let ends = |axis: usize| {
        let values = all.iter().map(|point| point[axis]).filter(|value| *value > 0.0);
        values.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], value| {
            [least.min(value), most.max(value)]
        })
    };
    let goal = match (tradeoff.target_linf, tradeoff.budget_seconds) {
        (Some(target), _) => ends(0).map(|cost| [cost, target]).to_vec(),
        (None, Some(budget)) => ends(1).map(|error| [budget, error]).to_vec(),
        (None, None) => Vec::new(),
    };
    let front = by_cost(points(true));
    let described =
        front.iter().map(|[cost, error]| format!("{error:.2e} in {}", cost_shown(tradeoff, *cost)));
    Plot {
        title: format!("Error against cost of {}", tradeoff.field),
        description: format!("The Pareto front: {}.", described.collect::<Vec<_>>().join("; ")),
        axes: [axis(tradeoff.cost), Axis::of("largest error of u", tradeoff.unit.as_ref())],
        curves: vec![
            curve("other runs", 1, true, Line::None, points(false)),
            curve("Pareto front", 0, false, Line::Solid, front),
            curve("choice", 2, false, Line::None, chosen),
            curve("goal", 2, false, Line::Dashed, goal),
        ],
        ..Plot::default()
    }
}

fn trials(tradeoff: &Tradeoff, caption: &str, runs: &[&Trial]) -> Markup {
    let columns = [
        words("method"),
        numbers("cells"),
        numbers("particles per cell"),
        numbers("Courant"),
        words("precision"),
        words("form"),
        numbers("linf"),
        numbers("particle-steps"),
        numbers("time"),
        numbers("memory"),
        words("remark"),
    ];
    let chosen = tradeoff.choice.as_ref().map(|choice| choice.command.as_str());
    let rows = runs.iter().map(|run| {
        let is_chosen = chosen == Some(run.command.as_str());
        vec![
            html! { (method(run)) },
            count(Some(run.cells)),
            count(Some(run.particles_per_cell)),
            number(Some(run.courant), |it| it.to_string()),
            html! { (run.precision) },
            html! { (run.form) },
            small(run.linf),
            small(run.particle_steps),
            seconds(run.seconds),
            number(run.memory, bytes),
            html! { (if is_chosen { "chosen" } else { run.failure.as_deref().unwrap_or_default() }) },
        ]
    });
    table(caption, &columns, rows)
}
