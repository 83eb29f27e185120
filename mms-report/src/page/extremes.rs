//! The solver at its limits.

use maud::{Markup, html};
use mms_documents::extremes::Extremes;

use super::mark::{number, numbers, small, table, verdict, words};
use super::method::method;
use super::{Section, Verdicts};
use crate::plot::{Axis, Curve, Line, Plot};

/// The verdict on a row that was not run.
const LEFT_OUT: &str = "left out";

impl Section for Extremes {
    fn title(&self) -> String {
        format!("{}: at the limits", self.field)
    }

    fn verdicts(&self) -> Verdicts {
        let each = || {
            let limits = self.stability.iter().map(|it| it.expected);
            // Extremes that the field could not be put at were not judged.
            let judged = self.rows.iter().filter(|it| it.verdict != LEFT_OUT);
            judged.map(|it| it.expected).chain(limits)
        };
        let (all, expected) = (each().count(), each().filter(|it| *it).count());
        Verdicts::several(expected, all, "as theory expects")
    }

    fn plots(&self) -> Vec<Plot> {
        vec![errors(self), limits(self)]
    }

    fn body(&self, id: &str) -> Markup {
        html! {
            p {
                "As declared, l2 is " (small(Some(self.declared_l2))) " of the largest displacement. At each extreme a run meets "
                "a bound that follows from that, or stops and says what is wrong."
            }
            @for row in self.rows.iter().filter(|row| !row.expected) {
                p.alert { strong { (row.name) } ": " (row.verdict) ": " (row.reason.as_deref().unwrap_or(&row.theory)) }
            }
            @if !self.rows.is_empty() { (rows(self)) }
            @if let Some(svg) = errors(self).svg(&format!("{id}-errors")) {
                figure { (svg) figcaption { "A mark for each run that ended; below the dashed line it is within its bound." } }
            }
            @if !self.stability.is_empty() { (stability(self)) }
            @if let Some(svg) = limits(self).svg(&format!("{id}-limits")) {
                figure { (svg) figcaption { "A mark for each method; below the dashed line the faces are less stable than the interior." } }
            }
            (method(&self.method))
        }
    }
}

fn rows(extremes: &Extremes) -> Markup {
    let columns = [
        words("extreme"),
        numbers("l2"),
        numbers("bound"),
        words("diagnosis"),
        words("may stop with"),
        words("verdict"),
    ];
    let rows = extremes.rows.iter().map(|row| {
        vec![
            html! {
                div.mode {
                    (row.name)
                    p { (row.theory) }
                    p { (row.setting) }
                    @if let Some(reason) = &row.reason { p { (reason) } }
                }
            },
            small(row.l2),
            small(row.bound),
            html! { (row.diagnosis.as_deref().unwrap_or_default()) },
            html! { (row.allowed_diagnoses.join(", ")) },
            verdict(&row.verdict, row.expected),
        ]
    });
    table("Extremes, errors relative to the largest displacement", &columns, rows)
}

fn stability(extremes: &Extremes) -> Markup {
    let columns = [words("method"), numbers("theory"), numbers("measured"), words("verdict")];
    let courant = |value| number(value, |value| format!("{value:.3}"));
    let rows = extremes.stability.iter().map(|it| {
        vec![
            html! { (it.method) },
            courant(it.theory),
            courant(Some(it.measured)),
            verdict(&it.verdict, it.expected),
        ]
    });
    table("The largest stable Courant number", &columns, rows)
}

/// Errors over their bounds.
fn errors(extremes: &Extremes) -> Plot {
    let points = extremes.rows.iter().filter_map(|row| Some((&row.name, [row.bound?, row.l2?])));
    compared(
        &format!("Errors of {} at its extremes", extremes.field),
        ["bound of l2", "l2"],
        "run",
        points.map(|(name, point)| (name.as_str(), point)).collect(),
    )
}

/// The ratio of measured to theoretical limits.
fn limits(extremes: &Extremes) -> Plot {
    let points = extremes.stability.iter();
    compared(
        &format!("Largest stable Courant numbers on {}", extremes.field),
        ["theory", "measured"],
        "method",
        points.filter_map(|it| Some((it.method.as_str(), [it.theory?, it.measured]))).collect(),
    )
}

/// The ratio of a number to its reference, and a line where both are the same.
fn compared(
    title: &str,
    axes: [&'static str; 2],
    name: &str,
    points: Vec<(&str, [f64; 2])>,
) -> Plot {
    let described = points
        .iter()
        .map(|(name, [held_to, value])| format!("{name}: {value:.3e}, {} {held_to:.3e}", axes[0]));
    let description = format!("{}.", described.collect::<Vec<_>>().join("; "));
    let of_bounds = || points.iter().map(|(_, [held_to, _])| *held_to);
    let ends = [of_bounds().fold(f64::INFINITY, f64::min), of_bounds().fold(0.0, f64::max)];
    let curve = |name: &str, line, points| Curve {
        name: name.to_owned(),
        points,
        line,
        ..Curve::default()
    };
    let line = if points.is_empty() { Vec::new() } else { ends.map(|end| [end, end]).to_vec() };
    Plot {
        title: title.to_owned(),
        description,
        axes: axes.map(|name| Axis::of(name, None)),
        curves: vec![
            curve(name, Line::None, points.iter().map(|(_, point)| *point).collect()),
            curve("equal", Line::Dashed, line),
        ],
        ..Plot::default()
    }
}
