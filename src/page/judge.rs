//! Judged results and errors of any solver.

use maud::{Markup, html};
use serde::Deserialize;

use super::excluded::{Excluded, exclusions};
use super::mark::{Column, count, is_good, number, numbers, order, small, table, verdict};
use super::plot::{Curve, Line, Plot, short};
use super::{Section, Verdicts};

/// What `mms judge` writes.
#[derive(Deserialize)]
pub struct Judgement {
    source: String,
    refinement: String,
    quantity: Option<String>,
    norm: Option<String>,
    expected_order: Option<f64>,
    observed_order: Option<f64>,
    order_interval: Option<[f64; 2]>,
    quantities: Vec<Quantity>,
    verdict: String,
    /// How results were measured; a table of errors has none.
    #[serde(default)]
    notes: Vec<String>,
    #[serde(default)]
    warnings: Vec<String>,
    #[serde(default)]
    excluded: Option<Vec<Excluded>>,
}

#[derive(Deserialize)]
struct Quantity {
    name: String,
    verdict: String,
    norms: Vec<Norm>,
    says: Vec<String>,
}

#[derive(Deserialize)]
struct Norm {
    norm: String,
    levels: Vec<Level>,
}

#[derive(Deserialize)]
struct Level {
    length: f64,
    runs: Vec<f64>,
    error: Option<f64>,
    order: Option<f64>,
}

/// How many colours with their marks there are.
const STYLES: usize = 3;

impl Section for Judgement {
    fn title(&self) -> String {
        match self.refinement.as_str() {
            "space" => self.source.clone(),
            other => format!("{}, in {other}", self.source),
        }
    }

    fn verdicts(&self) -> Verdicts {
        Verdicts::one(&self.verdict, is_good(&self.verdict))
    }

    fn body(&self, id: &str) -> Markup {
        html! {
            p {
                @match (&self.quantity, &self.norm) {
                    (Some(quantity), Some(norm)) if self.is_of_several() => {
                        "The " (norm) " of " (quantity) " decides: "
                    }
                    (_, Some(norm)) => { (norm) " decides: " }
                    _ => {}
                }
                @match self.observed_order {
                    Some(observed) => {
                        "its observed order is " (order(Some(observed)))
                        @if let Some([low, high]) = self.order_interval {
                            ", between " (order(Some(low))) " and " (order(Some(high)))
                        }
                    }
                    None => { "it has no observed order" }
                }
                "; expected is " (number(self.expected_order, |it| it.to_string())) "."
            }
            @if !self.notes.is_empty() { ul { @for note in &self.notes { li { (note) } } } }
            @for warning in &self.warnings { p.alert { (warning) } }
            @for (at, quantity) in self.quantities.iter().enumerate() {
                (self.quantity(quantity, &format!("{id}-{}", at + 1)))
            }
            @if let Some(all) = &self.excluded { (exclusions(all)) }
        }
    }
}

impl Judgement {
    /// What decides, for a row of a table: its expected order, its observed one, and of what.
    pub fn deciding(&self) -> [Markup; 3] {
        let name = |it: &Option<String>| it.clone().unwrap_or_default();
        [
            number(self.expected_order, |it| it.to_string()),
            order(self.observed_order),
            html! { (name(&self.quantity)) " " (name(&self.norm)) },
        ]
    }

    fn is_of_several(&self) -> bool {
        self.quantities.len() > 1
    }

    /// What a table is of; a quantity alone may have no name of its own.
    fn errors_of(&self, quantity: &Quantity) -> String {
        match self.is_of_several() {
            true => format!("Errors of {}", quantity.name),
            false => "Errors".to_owned(),
        }
    }

    fn length(&self) -> &'static str {
        if self.refinement == "time" { "dt" } else { "h" }
    }

    fn quantity(&self, quantity: &Quantity, id: &str) -> Markup {
        html! {
            @if self.is_of_several() {
                h4 { (quantity.name) }
                p { (verdict(&quantity.verdict, is_good(&quantity.verdict))) }
            }
            @for sentence in &quantity.says { p { (sentence) } }
            @if let Some(svg) = self.plot(quantity).svg(&format!("{id}-plot")) {
                figure { (svg) figcaption { "Both axes are logarithmic; the triangle has the expected slope." } }
            }
            @if quantity.norms.iter().any(|norm| !norm.levels.is_empty()) { (self.levels(quantity)) }
        }
    }

    fn levels(&self, quantity: &Quantity) -> Markup {
        let mut columns = vec![numbers(self.length()), numbers("runs")];
        for norm in &quantity.norms {
            columns.extend([Column::Number(norm.norm.clone().into()), numbers("order")]);
        }
        let longest = quantity.norms.iter().max_by_key(|norm| norm.levels.len());
        let levels = longest.map_or(&[][..], |norm| norm.levels.as_slice());
        let rows = levels.iter().enumerate().map(|(at, level)| {
            let mut cells = vec![small(Some(level.length)), count(Some(level.runs.len()))];
            for norm in &quantity.norms {
                let own = norm.levels.get(at);
                cells.extend([
                    small(own.and_then(|it| it.error)),
                    order(own.and_then(|it| it.order)),
                ]);
            }
            cells
        });
        table(&self.errors_of(quantity), &columns, rows)
    }

    fn plot(&self, quantity: &Quantity) -> Plot {
        let curve = |(at, norm): (usize, &Norm)| Curve {
            name: norm.norm.clone(),
            points: norm.levels.iter().filter_map(|it| Some([it.length, it.error?])).collect(),
            style: at % STYLES,
            is_hollow: at / STYLES % 2 == 1,
            line: Line::Solid,
        };
        let curves: Vec<Curve> = quantity.norms.iter().enumerate().map(curve).collect();
        let described = curves.iter().flat_map(|curve| {
            let of = |[at, error]: &[f64; 2]| format!("{} {} {error:.2e}", curve.name, short(*at));
            curve.points.iter().map(of)
        });
        let what = if self.refinement == "time" { "time step dt" } else { "cell size h" };
        Plot {
            title: format!("Convergence of {} of {}", quantity.name, self.source),
            description: format!("{}.", described.collect::<Vec<_>>().join("; ")),
            axes: [what, "error"],
            curves,
            slope: self.expected_order,
            floor: Vec::new(),
            marks_points: true,
        }
    }
}
