//! The diagnosis of the error of a solver.

use maud::{Markup, html};
use mms_documents::diagnose::{Diagnose, ErrorFields, Hypothesis};

use super::mark::{number, numbers, table, words};
use super::picture::{Moment, PaintedShape, Scale, pictures, project};
use super::{Section, Verdicts};

/// The number of hypotheses that are shown.
const SHOWN: usize = 5;

impl Section for Diagnose {
    fn title(&self) -> String {
        format!("{}: {}", self.field, self.evidence)
    }

    fn verdicts(&self) -> Verdicts {
        let word = match self.ranked.first().filter(|_| self.finding == "named") {
            Some(best) => title(best),
            None => self.finding.clone(),
        };
        Verdicts::one(&word, self.finding == "nothing")
    }

    fn body(&self, id: &str) -> Markup {
        html! {
            p {
                "The error is " (number(Some(self.error), |it| format!("{it:.2e}"))) " of the solution; right methods make "
                (number(Some(self.least_expected_error), |it| format!("{it:.1e}"))) " to "
                (number(Some(self.expected_error), |it| format!("{it:.1e}"))) "."
            }
            @if let (Some(best), "named") = (self.ranked.first(), self.finding.as_str()) {
                p { "It acts as " strong { (title(best)) } ": " (best.says) "." }
                @if !best.equivalent_always.is_empty() {
                    p { "The same formula for any field: " (best.equivalent_always.join(", ")) "." }
                }
                @if !best.equivalent_here.is_empty() {
                    p { "Not told apart by these results: " (best.equivalent_here.join(", ")) "." }
                }
            }
            @if self.finding != "nothing" { (hypotheses(self)) }
            @if let Some(like) = &self.like {
                p {
                    "It is " (format!("{:.2}", like.factor)) " times the error of the right method " code { (like.method) }
                    " on such a grid, " (format!("{:.0}", 100.0 * like.apart)) " % apart."
                }
            }
            @if let Some(fields) = &self.fields { (error_fields(self, fields, id)) }
            @if !self.cannot_be_seen.is_empty() {
                p { "These results cannot show: " (self.cannot_be_seen.join(", ")) "." }
            }
            p { "Next: " (self.next) "." }
        }
    }
}

fn hypotheses(diagnosis: &Diagnose) -> Markup {
    let rows = diagnosis.ranked.iter().take(SHOWN).map(|it| {
        let note = if it.plausible { "" } else { "of an impossible size" };
        vec![
            html! { code { (title(it)) } },
            number(it.factor, |it| format!("{it:.4}")),
            number(Some(it.explained), |it| format!("{:.1} %", 100.0 * it)),
            html! { (note) },
        ]
    });
    let columns = [words("hypothesis"), numbers("factor"), numbers("explains"), words("")];
    table("The part of the squared error that each hypothesis explains", &columns, rows)
}

fn title(it: &Hypothesis) -> String {
    let which = it.which.as_ref().map_or(String::new(), |which| format!(" [{which}]"));
    let face = it.face.as_ref().map_or(String::new(), |face| format!(" on {face}"));
    format!("{}{which}{face}", it.hypothesis)
}

/// A name with the unit of a length or a quantity, where the field states units.
fn with_unit(diagnosis: &Diagnose, name: &str, of: &str) -> String {
    match diagnosis.units.as_ref().and_then(|it| it.get(of)) {
        Some(unit) if unit != "1" => format!("{name} ({unit})"),
        _ => name.to_owned(),
    }
}

/// The errors side by side, in one scale.
fn error_fields(diagnosis: &Diagnose, fields: &ErrorFields, id: &str) -> Markup {
    let size = |error: &Vec<f64>| error.iter().map(|it| it * it).sum::<f64>().sqrt();
    let all = fields.error.iter().chain(fields.named.iter().flatten()).map(size);
    let largest = all.fold(f64::MIN_POSITIVE, f64::max);
    let scale = Scale {
        name: with_unit(diagnosis, "error", &fields.quantity),
        range: [0.0, largest],
        is_logarithmic: false,
    };
    // A body in space is seen along a diagonal, on which no axis lies.
    let dimension = fields.points.first().map_or(0, Vec::len);
    let names = if dimension < 3 { &["X", "Y"][..dimension] } else { &[] };
    let axes: Vec<String> = names.iter().map(|name| with_unit(diagnosis, name, "h")).collect();
    let moment = |errors: &[Vec<f64>]| Moment {
        time: fields.time,
        shapes: fields
            .points
            .iter()
            .zip(errors)
            .map(|(x, error)| PaintedShape {
                corners: vec![project(x)],
                step: scale.step(size(error)),
            })
            .collect(),
        outline: Vec::new(),
    };
    let shown = [
        ("The user's error", Some(&fields.error)),
        ("The error of the mistake", fields.named.as_ref()),
    ];
    html! {
        @for (at, (of, errors)) in shown.into_iter().enumerate() {
            @if let Some(errors) = errors {
                figure {
                    (pictures(&format!("{id}-error-{at}"), of, &[moment(errors)], &scale, spacing(fields), &axes))
                    figcaption { (of) " of " (fields.quantity.replace('_', " ")) ": its smooth part, by its length." }
                }
            }
        }
    }
}

/// The approximate distance between points.
fn spacing(fields: &ErrorFields) -> f64 {
    let dimension = fields.points.first().map_or(1, Vec::len);
    let extent = |axis: usize| {
        let along = || fields.points.iter().map(move |x| x[axis]);
        along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
    };
    let widest = (0..dimension).map(extent).fold(0.0, f64::max);
    widest / (fields.points.len() as f64).powf(1.0 / dimension as f64)
}
