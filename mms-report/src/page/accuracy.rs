//! The errors of formulas by rounding, and the cost of digits.

use maud::{Markup, html};
use mms_documents::accuracy::{Accuracy, AccuracyRow};
use mms_program::precision::Precision;
use mms_spec::Form;

use super::mark::{Column, count, number, numbers, table, verdict, words};
use super::{Section, Verdicts};
use crate::accuracy::{eps, is_promised};
use crate::front::front;
use crate::plot::{Axis, Curve, Line, Plot};

/// Whether an error with a bound was not measured.
fn is_unmeasured(row: &AccuracyRow) -> bool {
    row.within_bound.is_none() && is_promised(&row.form, &row.regime)
}

impl Section for Accuracy {
    fn title(&self) -> String {
        format!("{}: errors against arbitrary precision", self.field)
    }

    fn verdicts(&self) -> Verdicts {
        let promised = || self.rows.iter().filter_map(|row| row.within_bound);
        let unmeasured = self.rows.iter().filter(|row| is_unmeasured(row)).count();
        let (all, expected) =
            (promised().count() + unmeasured, promised().filter(|within| *within).count());
        if all == 0 && !self.rows.is_empty() {
            return Verdicts { word: "nothing is promised of it".into(), ..Verdicts::default() };
        }
        Verdicts::several(expected, all, &format!("within {} eps", self.bound_eps))
    }

    fn plots(&self) -> Vec<Plot> {
        vec![plot(self)]
    }

    fn body(&self, id: &str) -> Markup {
        let plot = plot(self);
        html! {
            p {
                "Errors at " (count(Some(self.points))) " points, in units of round-off (eps) of each precision. "
                "The stable form promises at most " (self.bound_eps) " eps of the largest value of a quantity, "
                "as the field is declared and at displacements down to 1e-12 of its size."
            }
            @if let Some(svg) = plot.svg(&format!("{id}-plot")) {
                figure {
                    (svg)
                    figcaption {
                        "A mark for each precision and form, as declared: the largest error of any quantity, and the time of all "
                        "quantities together. Both axes are logarithmic; on the dashed line nothing is both faster and closer."
                    }
                }
            }
            (regimes(self))
            details.bulk {
                summary { "The worst of each quantity" }
                (rows("The regime with the largest error, of each quantity, precision and form", &worst(self)))
            }
            // Printed on paper only if it is open.
            details.bulk {
                summary { "All " (self.rows.len()) " rows" }
                (rows("Every regime", &self.rows.iter().collect::<Vec<_>>()))
            }
            @if !self.left_out.is_empty() {
                details {
                    summary { "Left out" }
                    ul { @for it in &self.left_out {
                        li { (it.regime) @if let Some(quantity) = &it.quantity { ", " (quantity) } @if let Some(precision) = &it.precision { " in " (precision) } ": " (it.reason) }
                    } }
                }
            }
        }
    }
}

/// The largest errors of each regime.
fn regimes(accuracy: &Accuracy) -> Markup {
    let mut regimes: Vec<&str> = Vec::new();
    for row in &accuracy.rows {
        if !regimes.contains(&row.regime.as_str()) {
            regimes.push(&row.regime);
        }
    }
    let ways = || {
        let all = Precision::ALL.into_iter().flat_map(|it| Form::ALL.map(|form| (it, form)));
        let all = all.map(|(precision, form)| (precision.name(), form.name()));
        let is_there = |way: &(&str, &str)| {
            accuracy.rows.iter().any(|row| (row.precision.as_str(), row.form.as_str()) == *way)
        };
        all.filter(is_there)
    };
    let columns: Vec<_> = std::iter::once(words("regime"))
        .chain(
            ways().map(|(precision, form)| Column::Number(format!("{precision}, {form}").into())),
        )
        .collect();
    let rows = regimes.into_iter().map(|regime| {
        let largest = |(precision, form): (&str, &str)| {
            let of = |row: &&AccuracyRow| {
                row.regime == regime && row.precision == precision && row.form == form
            };
            let errors = accuracy.rows.iter().filter(of).filter_map(|row| row.max_scaled_eps);
            number(errors.reduce(f64::max), eps)
        };
        std::iter::once(html! { (regime) }).chain(ways().map(largest)).collect()
    });
    table("Largest error of any quantity, in eps of its largest value", &columns, rows)
}

/// The row of the largest error, for each quantity, precision and form.
fn worst(accuracy: &Accuracy) -> Vec<&AccuracyRow> {
    let mut worst: Vec<&AccuracyRow> = Vec::new();
    for row in &accuracy.rows {
        let same = |other: &&mut &AccuracyRow| {
            (&other.quantity, &other.precision, &other.form)
                == (&row.quantity, &row.precision, &row.form)
        };
        match worst.iter_mut().find(same) {
            Some(other) if row.max_scaled_eps > other.max_scaled_eps => *other = row,
            Some(_) => {}
            None => worst.push(row),
        }
    }
    worst
}

/// The regime of the picture: the declared one, or else the first.
fn regime(accuracy: &Accuracy) -> &str {
    let mut regimes = accuracy.rows.iter().map(|row| row.regime.as_str());
    let first = regimes.clone().next().unwrap_or_default();
    regimes.find(|regime| *regime == "declared").unwrap_or(first)
}

/// Error over time, if times were measured.
pub fn plot(accuracy: &Accuracy) -> Plot {
    let mut curves = Vec::new();
    for (style, precision) in Precision::ALL.into_iter().enumerate() {
        for form in Form::ALL {
            let rows = || {
                accuracy.rows.iter().filter(|row| {
                    row.regime == regime(accuracy)
                        && row.precision == precision.name()
                        && row.form == form.name()
                })
            };
            // If one time is missing, the sum is missing; an error that is not finite has no place.
            let Some(time) = rows().map(|row| row.ns_per_point).sum::<Option<f64>>() else {
                continue;
            };
            let errors = rows().map(|row| row.max_scaled_eps.unwrap_or(f64::NAN));
            let error = precision.eps() * errors.fold(0.0, f64::max);
            if time > 0.0 {
                curves.push(Curve {
                    name: format!("{}, {}", precision.name(), form.name()),
                    points: vec![[time, error]],
                    style,
                    is_hollow: form == Form::Fast,
                    line: Line::None,
                    ..Curve::default()
                });
            }
        }
    }
    let points = curves.iter().flat_map(|curve| &curve.points);
    let points: Vec<_> = points.map(|[time, error]| (*time, *error)).collect();
    let front: Vec<_> = front(&points).into_iter().map(|at| <[f64; 2]>::from(points[at])).collect();
    let described = curves.iter().filter_map(|curve| {
        let [time, error] = curve.points.first()?;
        Some(format!("{}: {time:.3} ns per point, error {error:.1e}", curve.name))
    });
    let description = format!("{}.", described.collect::<Vec<_>>().join("; "));
    if front.len() > 1 {
        let name = "Pareto front".to_owned();
        curves.push(Curve { name, points: front, line: Line::Dashed, ..Curve::default() });
    }
    Plot {
        title: format!("Error over time of {}", accuracy.field),
        description,
        axes: [
            Axis::of("time per point, all quantities", Some(&"ns".to_owned())),
            Axis::of("largest error over largest value", None),
        ],
        curves,
        ..Plot::default()
    }
}

fn rows(caption: &str, rows: &[&AccuracyRow]) -> Markup {
    let columns = [
        words("quantity"),
        words("precision"),
        words("form"),
        words("regime"),
        numbers("median"),
        numbers("99 %"),
        numbers("max"),
        numbers("max/largest"),
        numbers("not finite"),
        numbers("ns/point"),
        words("promise"),
    ];
    let cells = rows.iter().map(|row| {
        let of = |value: Option<f64>| number(value, eps);
        vec![
            html! { (row.quantity) },
            html! { (row.precision) },
            html! { (row.form) },
            html! { (row.regime) },
            of(row.median_eps),
            of(row.p99_eps),
            of(row.max_eps),
            of(row.max_scaled_eps),
            count(Some(row.not_finite)),
            number(row.ns_per_point, |time| format!("{time:.2}")),
            html! {
                @if let Some(within) = row.within_bound { (verdict(if within { "kept" } else { "broken" }, within)) }
                @else if is_unmeasured(row) { (verdict("not measured", false)) }
            },
        ]
    });
    table(caption, &columns, cells)
}
