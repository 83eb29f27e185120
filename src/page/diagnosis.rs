//! What the error of a solver acts as.

use maud::{Markup, html};
use serde::Deserialize;

use super::mark::{number, numbers, table, words};
use super::picture::{Moment, Scale, Shape, pictures, project};
use super::{Section, Verdicts};

/// What `mms diagnose` writes.
#[derive(Deserialize)]
pub struct Diagnosis {
    field: String,
    evidence: String,
    finding: String,
    error: f64,
    least_expected_error: f64,
    expected_error: f64,
    ranked: Vec<Hypothesis>,
    cannot_be_seen: Vec<String>,
    like: Option<Like>,
    fields: Option<Fields>,
    next: String,
}

#[derive(Deserialize)]
struct Hypothesis {
    hypothesis: String,
    says: String,
    factor: Option<f64>,
    explained: f64,
    plausible: bool,
    face: Option<String>,
    which: Option<String>,
    equivalent_always: Vec<String>,
    equivalent_here: Vec<String>,
}

#[derive(Deserialize)]
struct Like {
    method: String,
    factor: f64,
    apart: f64,
}

#[derive(Deserialize)]
struct Fields {
    quantity: String,
    time: f64,
    points: Vec<Vec<f64>>,
    error: Vec<Vec<f64>>,
    named: Option<Vec<Vec<f64>>>,
}

/// Hypotheses that are shown.
const SHOWN: usize = 5;

impl Section for Diagnosis {
    fn title(&self) -> String {
        format!("{}: {}", self.field, self.evidence)
    }

    fn verdicts(&self) -> Verdicts {
        let word = match self.ranked.first().filter(|_| self.finding == "named") {
            Some(best) => best.title(),
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
                p { "It acts as " strong { (best.title()) } ": " (best.says) "." }
                @if !best.equivalent_always.is_empty() {
                    p { "The same formula for any field: " (best.equivalent_always.join(", ")) "." }
                }
                @if !best.equivalent_here.is_empty() {
                    p { "Not told apart by these results: " (best.equivalent_here.join(", ")) "." }
                }
            }
            @if self.finding != "nothing" { (self.hypotheses()) }
            @if let Some(like) = &self.like {
                p {
                    "It is " (format!("{:.2}", like.factor)) " times the error of the right method " code { (like.method) }
                    " on such a grid, " (format!("{:.0}", 100.0 * like.apart)) " % apart."
                }
            }
            @if let Some(fields) = &self.fields { (fields.html(id)) }
            @if !self.cannot_be_seen.is_empty() {
                p { "These results cannot show: " (self.cannot_be_seen.join(", ")) "." }
            }
            p { "Next: " (self.next) "." }
        }
    }
}

impl Diagnosis {
    fn hypotheses(&self) -> Markup {
        let rows = self.ranked.iter().take(SHOWN).map(|it| {
            let note = if it.plausible { "" } else { "of a size that it cannot have" };
            vec![
                html! { code { (it.title()) } },
                number(it.factor, |it| format!("{it:.4}")),
                number(Some(it.explained), |it| format!("{:.1} %", 100.0 * it)),
                html! { (note) },
            ]
        });
        let columns = [words("hypothesis"), numbers("factor"), numbers("explains"), words("")];
        table("What each hypothesis explains of the squared error", &columns, rows)
    }
}

impl Hypothesis {
    fn title(&self) -> String {
        let which = self.which.as_ref().map_or(String::new(), |it| format!(" [{it}]"));
        let face = self.face.as_ref().map_or(String::new(), |it| format!(" on {it}"));
        format!("{}{which}{face}", self.hypothesis)
    }
}

impl Fields {
    /// The errors side by side, in one scale.
    fn html(&self, id: &str) -> Markup {
        let size = |error: &Vec<f64>| error.iter().map(|it| it * it).sum::<f64>().sqrt();
        let all = self.error.iter().chain(self.named.iter().flatten()).map(size);
        let largest = all.fold(f64::MIN_POSITIVE, f64::max);
        let scale = Scale { name: "error", range: [0.0, largest], is_logarithmic: false };
        let moment = |errors: &[Vec<f64>]| Moment {
            time: self.time,
            shapes: self
                .points
                .iter()
                .zip(errors)
                .map(|(x, error)| Shape {
                    corners: vec![project(x)],
                    step: scale.step(size(error)),
                })
                .collect(),
            outline: Vec::new(),
        };
        let shown = [
            ("The user's error", Some(&self.error)),
            ("The error of the mistake", self.named.as_ref()),
        ];
        html! {
            @for (at, (of, errors)) in shown.into_iter().enumerate() {
                @if let Some(errors) = errors {
                    figure {
                        (pictures(&format!("{id}-error-{at}"), of, &[moment(errors)], &scale, self.spacing()))
                        figcaption { (of) " of " (self.quantity.replace('_', " ")) ": what is smooth of it, by its length." }
                    }
                }
            }
        }
    }

    /// About how far points are apart.
    fn spacing(&self) -> f64 {
        let dimension = self.points.first().map_or(1, Vec::len);
        let extent = |axis: usize| {
            let along = || self.points.iter().map(move |x| x[axis]);
            along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
        };
        let widest = (0..dimension).map(extent).fold(0.0, f64::max);
        widest / (self.points.len() as f64).powf(1.0 / dimension as f64)
    }
}
