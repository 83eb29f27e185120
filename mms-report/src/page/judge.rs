//! Judged results and errors of any solver.

use maud::{Markup, html};
use mms_documents::judge::{Judge, JudgedQuantity};
use mms_documents::study::{JudgedLevel, JudgedNorm};
use mms_spec::quantity::Quantity;

use super::excluded::exclusions;
use super::mark::{Column, count, is_good, number, numbers, order, small, table, verdict};
use super::{Section, Verdicts};
use crate::plot::{Axis, Curve, Line, Plot, short};

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

    /// A line for each norm, or for the deciding norm of each of several quantities, in a panel for each unit. A grid of h and dt
    /// has points over h.
    fn plots(&self) -> Vec<Plot> {
        if let [quantity] = self.quantities.as_slice() {
            return match self.refinement.as_str() {
                "space and time" => panels(self, "", runs(self), &[]),
                _ => panels_of(self, quantity),
            };
        }
        let deciding = |it: &JudgedQuantity| {
            let at = it.norms.iter().position(|norm| norm.norm == it.norm)?;
            let mut own = lines(self, it).swap_remove(at);
            own.curve.name = format!("{}, {}", symbol(&it.name), own.curve.name);
            Some(own)
        };
        let lines = self.quantities.iter().filter_map(deciding).collect();
        let mut stopped: Vec<f64> = self.quantities.iter().flat_map(stopped).collect();
        stopped.sort_by(f64::total_cmp);
        stopped.dedup();
        panels(self, "", lines, &stopped)
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
        @for (at, plot) in panels_of(judge, quantity).into_iter().enumerate() {
            @if let Some(svg) = plot.svg(&format!("{id}-plot-{}", at + 1)) {
                figure { (svg) figcaption { "Both axes are logarithmic; the triangle has the expected slope." } }
            }
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

/// A line of the picture, with the unit of its errors.
struct Errors {
    unit: Option<String>,
    curve: Curve,
}

/// The symbol of a quantity; a name without a symbol is written in words.
fn symbol(name: &str) -> String {
    let known = Quantity::evaluated().find(|it| it.name() == name);
    known.map_or_else(|| name.replace('_', " "), |it| it.symbol().to_owned())
}

/// The unit of the errors of a quantity in a norm: H1 has the unit of the gradient.
fn unit(judge: &Judge, quantity: &str, norm: &str) -> Option<String> {
    let units = judge.units.as_ref()?;
    let own = units.get(quantity)?;
    match (norm.eq_ignore_ascii_case("h1"), units.get("h")?) {
        (false, _) => Some(own.clone()),
        (true, length) if length == own => Some("1".into()),
        (true, length) if own == "1" => Some(format!("1/{length}")),
        (true, length) => Some(format!("{own}/{length}")),
    }
}

fn lines(judge: &Judge, quantity: &JudgedQuantity) -> Vec<Errors> {
    let line = |norm: &JudgedNorm| Errors {
        unit: unit(judge, &quantity.name, &norm.norm),
        curve: Curve {
            name: norm.norm.clone(),
            order: norm.observed_order,
            points: known(norm).iter().filter_map(|it| Some([it.length, it.error?])).collect(),
            ..Curve::default()
        },
    };
    quantity.norms.iter().map(line).collect()
}

/// The runs of a grid of h and dt: the errors of the first quantity over h.
fn runs(judge: &Judge) -> Vec<Errors> {
    let quantity = judge.quantities.first().map_or("", |it| &it.name);
    let line = |(at, norm): (usize, &str)| {
        let points = judge.levels.iter().filter_map(|it| {
            Some([it.cell_size?, [it.errors.l1, it.errors.l2, it.errors.linf][at]?])
        });
        let (name, points, line) = (norm.to_owned(), points.collect(), Line::None);
        let curve = Curve { name, points, line, ..Curve::default() };
        Errors { unit: unit(judge, quantity, norm), curve }
    };
    ["l1", "l2", "linf"].into_iter().enumerate().map(line).collect()
}

/// The panels of lines, one for each unit, all with the same title.
fn panels(judge: &Judge, of: &str, lines: Vec<Errors>, stopped: &[f64]) -> Vec<Plot> {
    let mut units: Vec<Option<String>> = Vec::new();
    for line in &lines {
        if !units.contains(&line.unit) {
            units.push(line.unit.clone());
        }
    }
    let panel = |unit: Option<String>| {
        let own = lines.iter().filter(|it| it.unit == unit).enumerate();
        let curves: Vec<Curve> = own.map(|(at, it)| it.curve.clone().styled(at)).collect();
        let described = curves.iter().flat_map(|curve| {
            let of = |[at, error]: &[f64; 2]| format!("{} {} {error:.2e}", curve.name, short(*at));
            curve.points.iter().map(of)
        });
        Plot {
            title: format!("Convergence of {of}{}", judge.source),
            description: format!("{}.", described.collect::<Vec<_>>().join("; ")),
            axes: [axis(judge), Axis::of("error", unit.as_ref())],
            slope: judge.expected_order.filter(|_| curves.iter().any(|it| it.line != Line::None)),
            curves,
            stopped: stopped.to_vec(),
            marks_points: true,
            ..Plot::default()
        }
    };
    units.into_iter().map(panel).collect()
}

fn axis(judge: &Judge) -> Axis {
    let (name, symbol) = match judge.refinement.as_str() {
        "time" => ("time step dt", "dt"),
        _ => ("cell size h", "h"),
    };
    Axis::of(name, judge.units.as_ref().and_then(|it| it.get(symbol)))
}

/// The panels of one quantity: a line for each norm.
fn panels_of(judge: &Judge, quantity: &JudgedQuantity) -> Vec<Plot> {
    let lines = lines(judge, quantity);
    panels(judge, &format!("{} of ", quantity.name), lines, &stopped(quantity))
}
