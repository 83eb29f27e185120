//! Single runs.

use maud::{Markup, html};
use mms_documents::run::{Diagnostics, OverTime, Run, RunErrors};

use super::mark::{count, number, numbers, seconds, small, table, words};
use super::method::{method, name};
use super::{Section, Verdicts};
use crate::plot::short;

impl Section for Run {
    fn title(&self) -> String {
        format!("{}: {}, {} cells", self.field, name(&self.method), self.cells)
    }

    /// A run that reached its end is not judged.
    fn verdicts(&self) -> Verdicts {
        match self.failure {
            None => Verdicts { word: "reached its end".into(), ..Verdicts::default() },
            Some(_) if self.steps.is_none() => Verdicts::one("not started", false),
            Some(_) => Verdicts::one("stopped", false),
        }
    }

    fn body(&self, _: &str) -> Markup {
        html! {
            @if let Some(failure) = &self.failure { p.alert { (failure) } }
            p {
                (count(self.particles)) " particles, " (count(self.steps)) " steps of "
                (small(self.time_step)) ", cells of " (small(self.cell_size)) "."
                @if let Some(ns) = self.ns_per_particle_step { " " (format!("{ns:.0}")) " ns per particle and step." }
            }
            @if let Some(errors) = &self.errors { (norms(errors)) }
            @if let Some(state) = &self.diagnostics { (at_end(state)) }
            @if let Some(parts) = &self.seconds {
                @let parts = [
                    ("forcing", parts.forcing),
                    ("transfer", parts.transfer),
                    ("grid", parts.grid),
                    ("stress", parts.stress),
                ];
                (table("Time taken", &[words("part"), numbers("time")], parts.into_iter().map(|(part, time)| {
                    vec![html! { (part) }, seconds(Some(time))]
                })))
            }
            (method(&self.method))
        }
    }
}

fn norms(errors: &RunErrors) -> Markup {
    let columns = [
        words("error of"),
        numbers("l1"),
        numbers("l2"),
        numbers("linf"),
        numbers("l1 at the end"),
        numbers("l2 at the end"),
        numbers("linf at the end"),
    ];
    let quantities = [
        ("displacement", &errors.displacement),
        ("velocity", &errors.velocity),
        ("deformation_gradient", &errors.deformation_gradient),
        ("first_piola_kirchhoff", &errors.first_piola_kirchhoff),
    ];
    let rows = quantities.into_iter().map(|(quantity, OverTime { over_time, at_end })| {
        let norms = [over_time, at_end].map(|it| [it.l1, it.l2, it.linf]).concat();
        let name = html! { (quantity) };
        std::iter::once(name).chain(norms.into_iter().map(|norm| small(Some(norm)))).collect()
    });
    table("Errors, the largest over time and those at the end", &columns, rows)
}

fn at_end(state: &Diagnostics) -> Markup {
    let shown = |values: &[f64]| {
        html! {
            @for (at, value) in values.iter().enumerate() {
                @if at > 0 { ", " }
                (number(Some(*value), short))
            }
        }
    };
    let rows = [
        ("mass", shown(&[state.mass])),
        ("momentum", shown(&state.momentum)),
        ("kinetic energy", shown(&[state.kinetic_energy])),
        ("least and greatest J", shown(&state.jacobian)),
    ];
    let rows = rows.into_iter().map(|(name, value)| vec![html! { (name) }, value]);
    table("The state at the end", &[words("sum over particles"), numbers("value")], rows)
}
