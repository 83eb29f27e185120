//! Single runs.

use std::collections::BTreeMap;

use maud::{Markup, html};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::mark::Column::{Number, Text};
use super::mark::{count, list, plain, seconds, small, table};
use super::{Section, Verdicts};

/// What `mms run` writes.
#[derive(Deserialize)]
pub struct Run {
    field: String,
    method: Map<String, Value>,
    cells: Value,
    cell_size: f64,
    time_step: f64,
    steps: usize,
    particles: usize,
    errors: Option<BTreeMap<String, Times>>,
    diagnostics: Option<State>,
    ns_per_particle_step: Option<f64>,
    seconds: Option<BTreeMap<String, f64>>,
    failure: Option<String>,
}

#[derive(Deserialize)]
struct Times {
    over_time: Norms,
    at_end: Norms,
}

#[derive(Deserialize)]
struct Norms {
    l1: f64,
    l2: f64,
    linf: f64,
}

#[derive(Deserialize)]
struct State {
    mass: f64,
    momentum: Vec<f64>,
    kinetic_energy: f64,
    jacobian: [f64; 2],
}

impl Section for Run {
    fn title(&self) -> String {
        let word = |key: &str| plain(self.method.get(key).unwrap_or(&Value::Null));
        let cells = plain(&self.cells);
        format!("{}: {} {}, {cells} cells", self.field, word("shape"), word("integrator"))
    }

    /// A run that reached its end is not judged.
    fn verdicts(&self) -> Verdicts {
        match self.failure {
            None => Verdicts { word: "reached its end".into(), ..Verdicts::default() },
            Some(_) => Verdicts::one("stopped", false),
        }
    }

    fn body(&self, _: &str) -> Markup {
        html! {
            @if let Some(failure) = &self.failure { p.alert { (failure) } }
            p {
                (count(Some(self.particles))) " particles, " (count(Some(self.steps))) " steps of "
                (small(Some(self.time_step))) ", cells of " (small(Some(self.cell_size))) "."
                @if let Some(ns) = self.ns_per_particle_step { " " (format!("{ns:.0}")) " ns per particle and step." }
            }
            @if let Some(errors) = &self.errors { (norms(errors)) }
            @if let Some(state) = &self.diagnostics { (at_end(state)) }
            @if let Some(parts) = &self.seconds {
                (table("What it took", &[Text("part"), Number("time")], parts.iter().map(|(part, time)| {
                    vec![html! { (part) }, seconds(Some(*time))]
                })))
            }
            details {
                summary { "The method" }
                (list(&self.method))
            }
        }
    }
}

fn norms(errors: &BTreeMap<String, Times>) -> Markup {
    let columns = [
        Text("error of"),
        Number("l1"),
        Number("l2"),
        Number("linf"),
        Number("l1 at the end"),
        Number("l2 at the end"),
        Number("linf at the end"),
    ];
    let rows = errors.iter().map(|(quantity, Times { over_time, at_end })| {
        let norms = [over_time, at_end].map(|it| [it.l1, it.l2, it.linf]).concat();
        let name = html! { (quantity.replace('_', " ")) };
        std::iter::once(name).chain(norms.into_iter().map(|norm| small(Some(norm)))).collect()
    });
    table("Errors, the largest over time and those at the end", &columns, rows)
}

fn at_end(state: &State) -> Markup {
    let numbers = |values: &[f64]| html! {
        @for (at, value) in values.iter().enumerate() {
            @if at > 0 { ", " }
            (small(Some(*value)))
        }
    };
    let rows = [
        ("mass", numbers(&[state.mass])),
        ("momentum", numbers(&state.momentum)),
        ("kinetic energy", numbers(&[state.kinetic_energy])),
        ("least and greatest J", numbers(&state.jacobian)),
    ];
    let rows = rows.into_iter().map(|(name, value)| vec![html! { (name) }, value]);
    table("The state at the end", &[Text("sum over particles"), Number("value")], rows)
}
