//! Convergence studies.

use maud::{Markup, html};
use mms_documents::study::{
    Fit, Level, LevelDifference, LevelErrors, Phase, Studies, Study, StudyOfMethod,
};
use serde::Deserialize as _;
use serde_json::Value;

use super::excluded::exclusions;
use super::mark::{Column, count, number, numbers, order, seconds, small, table, words};
use super::method::{method, name, whole};
use super::phase::phase;
use super::{Section, Verdicts};
use crate::plot::{Axis, Curve, Plot, short};

/// Each error and its order.
fn norms(errors: &LevelErrors) -> [Markup; 6] {
    [
        small(errors.l1),
        order(errors.order_l1),
        small(errors.l2),
        order(errors.order_l2),
        small(errors.linf),
        order(errors.order_linf),
    ]
}

/// The heads of [`norms`].
const NORMS: [Column; 6] = [
    numbers("l1"),
    numbers("order"),
    numbers("l2"),
    numbers("order"),
    numbers("linf"),
    numbers("order"),
];

impl Section for StudyOfMethod {
    fn title(&self) -> String {
        let refined = match self.refinement.as_str() {
            "both" => "",
            "space" => ", in space",
            _ => ", in time",
        };
        format!("{}: {}{refined}", self.field, name(&self.method))
    }

    fn verdicts(&self) -> Verdicts {
        Verdicts::one(&self.verdict, self.verdict == "pass")
    }

    fn plots(&self) -> Vec<Plot> {
        vec![plot(self)]
    }

    fn body(&self, id: &str) -> Markup {
        let plot = plot(self);
        html! {
            p {
                @match self.observed_order {
                    Some(observed) => {
                        "The observed order is " (order(Some(observed))) " in l2"
                        @if let Some([low, high]) = self.order_interval {
                            ", between " (order(Some(low))) " and " (order(Some(high)))
                        }
                        "; expected is " (self.expected_order) "."
                        @if let Some(largest) = judged(self).last().and_then(|(_, norms)| norms.order_linf) {
                            " On the finest pair it is " (order(Some(largest))) " in linf."
                        }
                    }
                    None => { "No observed order; expected " (self.expected_order) "." }
                }
                @if let Some(constant) = self.error_constant {
                    " On the finest level l2 = " (small(Some(constant))) " " i { (length(self)) } sup { (self.expected_order) }
                    @match self.expected_error_constant {
                        Some(expected) => { "; expected is " (number(Some(expected), |it| format!("{it:e}"))) ", within 1 %." }
                        None => { "; no constant is expected, so that the order alone is judged." }
                    }
                }
                @if let Some(it) = &self.fit { (fit(it)) }
            }
            @if let Some(svg) = plot.svg(&format!("{id}-plot")) {
                figure { (svg) figcaption { (caption(self, &plot)) } }
            }
            (levels(self))
            @if let Some(differences) = &self.differences { (steps(differences)) }
            @else { (others(self)) }
            @if let Some(it) = &self.phase { (in_phase(self, it)) }
            @if let Some(Some(all)) = &self.excluded { (exclusions(all)) }
            (method(&self.method))
        }
    }
}

/// Reads a study of one method or of several.
pub fn read(document: &Value) -> serde_json::Result<Box<dyn Section>> {
    Ok(match document.get("studies") {
        Some(_) => Box::new(Studies::deserialize(document)?),
        None => Box::new(Study::deserialize(document)?.study),
    })
}

/// h or dt, and l2 of the judged errors.
pub fn l2(study: &StudyOfMethod) -> Vec<(Option<f64>, Option<f64>)> {
    judged(study).into_iter().map(|(at, norms)| (at, norms.l2)).collect()
}

/// The names of the levels that are judged.
pub fn names_of_levels(study: &StudyOfMethod) -> Vec<String> {
    match &study.differences {
        Some(steps) => steps.iter().map(|it| format!("dt {}", short(it.time_step))).collect(),
        None => study.levels.iter().map(|it| format!("{} cells", it.cells)).collect(),
    }
}

/// The unit of h, dt or a quantity.
pub fn unit<'a>(study: &'a StudyOfMethod, name: &str) -> Option<&'a String> {
    study.units.as_ref()?.get(name)
}

/// The refined length with its unit.
pub fn axis(study: &StudyOfMethod) -> Axis {
    match length(study) {
        "dt" => Axis::of("time step dt", unit(study, "dt")),
        h => Axis::of(format!("cell size {h}"), unit(study, h)),
    }
}

fn length(study: &StudyOfMethod) -> &'static str {
    if study.refinement == "time" { "dt" } else { "h" }
}

/// The refined length of a level: dt in time, else h.
fn refined(study: &StudyOfMethod, level: &Level) -> Option<f64> {
    if study.refinement == "time" { level.time_step } else { level.cell_size }
}

/// The judged errors: errors of levels, or in time the differences to the next level.
pub fn judged(study: &StudyOfMethod) -> Vec<(Option<f64>, &LevelErrors)> {
    match &study.differences {
        Some(steps) => steps.iter().map(|it| (Some(it.time_step), &it.errors)).collect(),
        None => study.levels.iter().map(|it| (refined(study, it), &it.errors)).collect(),
    }
}

/// The errors of a study over h or dt.
pub fn plot(study: &StudyOfMethod) -> Plot {
    let rows = judged(study);
    let curve = |(style, name): (usize, &str)| {
        let points = rows
            .iter()
            .filter_map(|(at, norms)| Some([(*at)?, [norms.l1, norms.l2, norms.linf][style]?]));
        let points = points.collect();
        let order = study.norms.iter().find(|it| it.norm == name);
        let order = order.and_then(|it| it.observed_order);
        Curve { name: name.to_owned(), order, points, style, ..Curve::default() }
    };
    let curves: Vec<_> = ["l1", "l2", "linf"].into_iter().enumerate().map(curve).collect();
    let floor = match study.differences {
        Some(_) => Vec::new(),
        None => study
            .levels
            .iter()
            .filter_map(|it| Some([refined(study, it)?, it.round_off.flatten()?]))
            .collect(),
    };
    let what = if study.differences.is_some() {
        "difference to the next level"
    } else if study.method.relax {
        "error of u at equilibrium"
    } else {
        "largest error of u over time"
    };
    let described = rows.iter().filter_map(|(at, norms)| {
        Some(format!("{} {}: l2 {:.2e}", length(study), short((*at)?), norms.l2?))
    });
    Plot {
        title: format!("Convergence of {}", study.title()),
        description: format!("{}.", described.collect::<Vec<_>>().join("; ")),
        head: whole(&study.method),
        axes: [axis(study), Axis::of(what, unit(study, "displacement"))],
        curves,
        slope: Some(study.expected_order),
        floor,
        stopped: stopped(&rows),
        marks_points: true,
    }
}

/// The places of levels without an error.
pub fn stopped(rows: &[(Option<f64>, &LevelErrors)]) -> Vec<f64> {
    rows.iter().filter(|(_, norms)| norms.l2.is_none()).filter_map(|(at, _)| *at).collect()
}

/// The caption of the picture.
fn caption(study: &StudyOfMethod, plot: &Plot) -> String {
    let mut text = format!(
        "Both axes are logarithmic; the triangle has the expected slope, {}.",
        study.expected_order
    );
    let highest = plot.floor.iter().map(|[_, floor]| *floor).fold(0.0, f64::max);
    if highest > 0.0 {
        text += &match plot.shows_floor() {
            true => format!(
                " Below the dashed line, at most {highest:.1e}, an error may be round-off alone."
            ),
            false => format!(
                " The predicted round-off floor, at most {highest:.1e}, lies far below the picture."
            ),
        };
    }
    text
}

fn in_phase(study: &StudyOfMethod, phases: &Phase) -> Markup {
    let levels = study.levels.iter();
    match study.refinement.as_str() {
        "time" => {
            phase(phases, "time step", &levels.map(|it| small(it.time_step)).collect::<Vec<_>>())
        }
        _ => phase(phases, "cells", &levels.map(|it| html! { (it.cells) }).collect::<Vec<_>>()),
    }
}

fn levels(study: &StudyOfMethod) -> Markup {
    let mut columns = vec![words("cells"), numbers("particles"), numbers("steps")];
    columns.extend(NORMS);
    // A page that is the same on all machines has no times.
    let is_timed = study.levels.iter().any(|level| level.seconds.is_some());
    columns.push(numbers("round-off"));
    columns.extend(is_timed.then_some(numbers("time")));
    columns.push(words("remark"));
    let rows = study.levels.iter().enumerate().map(|(at, level)| {
        let mut cells = vec![html! { (level.cells) }, count(level.particles), count(level.steps)];
        cells.extend(norms(&level.errors));
        let noise = study.noise.get(at).is_some_and(|noise| *noise).then_some("noise");
        let remark = level.failure.as_deref().or(noise).unwrap_or_default();
        cells.push(small(level.round_off.flatten()));
        cells.extend(is_timed.then(|| seconds(level.seconds)));
        cells.push(html! { (remark) });
        cells
    });
    let when = if study.method.relax { "at equilibrium" } else { "the largest over time" };
    table(&format!("Errors of the displacement, {when}"), &columns, rows)
}

/// The errors of v, F and P.
fn others(study: &StudyOfMethod) -> Markup {
    let quantities = &study.quantities;
    let others = [
        ("deformation_gradient", &quantities.deformation_gradient),
        ("first_piola_kirchhoff", &quantities.first_piola_kirchhoff),
        ("velocity", &quantities.velocity),
    ];
    let mut columns = vec![words("cells")];
    columns.extend(NORMS);
    html! {
        details {
            summary { "Errors of other quantities" }
            @for (name, levels) in others {
                @let rows = levels.iter().zip(&study.levels).map(|(errors, level)| {
                    let mut cells = vec![html! { (level.cells) }];
                    cells.extend(norms(errors));
                    cells
                });
                (table(&format!("Errors of the {}", name), &columns, rows))
            }
        }
    }
}

fn steps(differences: &[LevelDifference]) -> Markup {
    let mut columns = vec![numbers("time step")];
    columns.extend(NORMS);
    let rows = differences.iter().map(|difference| {
        let mut cells = vec![small(Some(difference.time_step))];
        cells.extend(norms(&difference.errors));
        cells
    });
    table("Differences of displacements to the next level", &columns, rows)
}

fn fit(fit: &Fit) -> Markup {
    html! {
        " Over all runs, l2 = " (small(Some(fit.space_constant))) " " i { "h" } sup { (order(Some(fit.space_order))) }
        " + " (small(Some(fit.time_constant))) " " i { "dt" } sup { (order(Some(fit.time_order))) }
        ", within " (format!("{:.1}", 100.0 * fit.residual)) " %."
    }
}
