//! Judged results and errors of any solver.

use maud::{Markup, html};
use mms_documents::judge::{Judge, JudgedQuantity};
use mms_documents::study::{JudgedLevel, JudgedNorm};

use super::excluded::exclusions;
use super::mark::{Column, count, is_good, number, numbers, order, small, table, verdict};
use super::{Section, Verdicts};
use crate::axis::short;
use crate::plot::{Curve, Line, Plot, STYLES};

impl Section for Judge {
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
                    (Some(quantity), Some(norm)) if is_of_several(self) => {
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
            @for warning in self.warnings.iter().flatten() { p.alert { (warning) } }
            @for (at, quantity) in self.quantities.iter().enumerate() {
                (one(self, quantity, &format!("{id}-{}", at + 1)))
            }
            @if let Some(Some(all)) = &self.excluded { (exclusions(all)) }
        }
    }
}

/// The levels of a norm; none of a grid of h and dt.
fn known(norm: &JudgedNorm) -> &[JudgedLevel] {
    norm.levels.as_ref().and_then(Option::as_deref).unwrap_or_default()
}

/// The cells of a row: the expected order, the observed order, and the quantity and norm that decide.
pub fn deciding(judge: &Judge) -> [Markup; 3] {
    let name = |it: &Option<String>| it.clone().unwrap_or_default();
    [
        number(judge.expected_order, |it| it.to_string()),
        order(judge.observed_order),
        html! { (name(&judge.quantity)) " " (name(&judge.norm)) },
    ]
}

fn is_of_several(judge: &Judge) -> bool {
    judge.quantities.len() > 1
}

/// The caption of a table. A quantity alone may have no name of its own.
fn errors_of(judge: &Judge, quantity: &JudgedQuantity) -> String {
    match is_of_several(judge) {
        true => format!("Errors of {}", quantity.name),
        false => "Errors".to_owned(),
    }
}

fn length(judge: &Judge) -> &'static str {
    if judge.refinement == "time" { "dt" } else { "h" }
}

fn one(judge: &Judge, quantity: &JudgedQuantity, id: &str) -> Markup {
    html! {
        @if is_of_several(judge) {
            h4 { (quantity.name) }
            p { (verdict(&quantity.verdict, is_good(&quantity.verdict))) }
        }
        @for sentence in &quantity.says { p { (sentence) } }
        @if let Some(svg) = plot(judge, quantity).svg(&format!("{id}-plot")) {
            figure { (svg) figcaption { "Both axes are logarithmic; the triangle has the expected slope." } }
        }
        @if quantity.norms.iter().any(|norm| !known(norm).is_empty()) { (levels(judge, quantity)) }
    }
}

fn levels(judge: &Judge, quantity: &JudgedQuantity) -> Markup {
    let mut columns = vec![numbers(length(judge)), numbers("runs")];
    for norm in &quantity.norms {
        columns.extend([Column::Number(norm.norm.clone().into()), numbers("order")]);
    }
    let longest = quantity.norms.iter().max_by_key(|norm| known(norm).len());
    let levels = longest.map_or(&[][..], known);
    let rows = levels.iter().enumerate().map(|(at, level)| {
        let mut cells = vec![small(Some(level.length)), count(Some(level.runs.len()))];
        for norm in &quantity.norms {
            let own = known(norm).get(at);
            cells.extend([small(own.and_then(|it| it.error)), order(own.and_then(|it| it.order))]);
        }
        cells
    });
    table(&errors_of(judge, quantity), &columns, rows)
}

/// The lengths of levels of a quantity at which a run stopped.
fn stopped(quantity: &JudgedQuantity) -> Vec<f64> {
    let levels = quantity.norms.iter().flat_map(known);
    let mut places: Vec<f64> = levels.filter(|it| it.error.is_none()).map(|it| it.length).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    places
}

/// The figure of a judgement: a line for each norm, or for the deciding norm of each of several quantities. A grid of h and dt
/// has points over h.
pub fn figure(judge: &Judge) -> Plot {
    if let [quantity] = judge.quantities.as_slice() {
        let plot = plot(judge, quantity);
        return if judge.refinement == "space and time" { of_grid(judge, plot) } else { plot };
    }
    let deciding = |it: &JudgedQuantity| it.norms.iter().position(|norm| norm.norm == it.norm);
    let curve = |(at, quantity): (usize, &JudgedQuantity)| {
        let mut plot = plot(judge, quantity);
        let own = plot.curves.swap_remove(deciding(quantity)?);
        let name = format!("{} {}", quantity.name, own.name);
        let (style, is_hollow) = (at % STYLES, at / STYLES % 2 == 1);
        Some(Curve { name, style, is_hollow, ..own })
    };
    let curves: Vec<Curve> = judge.quantities.iter().enumerate().filter_map(curve).collect();
    let mut stopped: Vec<f64> = judge.quantities.iter().flat_map(stopped).collect();
    stopped.sort_by(f64::total_cmp);
    stopped.dedup();
    Plot {
        title: format!("Convergence of {}", judge.source),
        description: format!("The deciding norm of {} quantities.", curves.len()),
        axes: [axis(judge), "error"],
        curves,
        slope: judge.expected_order,
        stopped,
        marks_points: true,
        ..Plot::default()
    }
}

/// The plot of a grid of h and dt: the errors of its runs over h.
fn of_grid(judge: &Judge, plot: Plot) -> Plot {
    let norms = ["l1", "l2", "linf"];
    let curve = |(style, name): (usize, &str)| {
        let points = judge.levels.iter().filter_map(|it| {
            Some([it.cell_size?, [it.errors.l1, it.errors.l2, it.errors.linf][style]?])
        });
        let points = points.collect();
        Curve { name: name.to_owned(), points, style, line: Line::None, ..Curve::default() }
    };
    let curves = norms.into_iter().enumerate().map(curve).collect();
    Plot { curves, slope: None, ..plot }
}

fn axis(judge: &Judge) -> &'static str {
    if judge.refinement == "time" { "time step dt" } else { "cell size h" }
}

fn plot(judge: &Judge, quantity: &JudgedQuantity) -> Plot {
    let curve = |(at, norm): (usize, &JudgedNorm)| Curve {
        name: norm.norm.clone(),
        order: norm.observed_order,
        points: known(norm).iter().filter_map(|it| Some([it.length, it.error?])).collect(),
        style: at % STYLES,
        is_hollow: at / STYLES % 2 == 1,
        line: Line::Solid,
    };
    let curves: Vec<Curve> = quantity.norms.iter().enumerate().map(curve).collect();
    let described = curves.iter().flat_map(|curve| {
        let of = |[at, error]: &[f64; 2]| format!("{} {} {error:.2e}", curve.name, short(*at));
        curve.points.iter().map(of)
    });
    Plot {
        title: format!("Convergence of {} of {}", quantity.name, judge.source),
        description: format!("{}.", described.collect::<Vec<_>>().join("; ")),
        axes: [axis(judge), "error"],
        curves,
        slope: judge.expected_order,
        stopped: stopped(quantity),
        marks_points: true,
        ..Plot::default()
    }
}
