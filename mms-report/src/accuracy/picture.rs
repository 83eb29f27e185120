//! Errors over time, for each precision and form, both logarithmic: down and left is better.

use anyhow::anyhow;
use mms_program::precision::Precision;
use mms_spec::Form;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::super::front::front;
use super::super::picture::{span, ticks};
use super::Report;

const SIZE: (u32, u32) = (760, 520);
const TEXT: (&str, u32) = ("sans-serif", 15);
const FRONT: RGBColor = RGBColor(90, 90, 90);
/// Colours that are told apart without seeing colour well (Okabe & Ito 2008).
const COLOURS: [RGBColor; 3] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 158, 115)];

/// A precision in a form: what all quantities take together, and the worst of their errors.
struct Mark {
    precision: Precision,
    form: Form,
    ns_per_point: f64,
    error: f64,
}

/// The picture as SVG text.
pub fn draw(report: &Report) -> anyhow::Result<String> {
    let mut svg = String::new();
    draw_into(report, &mut svg).map_err(|error| anyhow!("cannot draw the picture: {error}"))?;
    Ok(svg)
}

/// The regime that is shown: the declared one if it was measured, or else the first that was.
fn regime(report: &Report) -> &str {
    let mut regimes = report.accuracy.rows.iter().map(|row| row.regime.raw());
    let first = regimes.clone().next().unwrap_or("declared");
    regimes.find(|regime| *regime == "declared").unwrap_or(first)
}

fn marks(report: &Report) -> Vec<Mark> {
    let mut marks = Vec::new();
    for precision in Precision::ALL {
        for form in Form::ALL {
            let rows = report.accuracy.rows.iter().filter(|row| {
                row.precision == precision && row.form == form && row.regime == regime(report)
            });
            let errors = rows.map(|row| row.errors.max_scaled_eps * precision.eps());
            let error = errors.fold(0.0, f64::max);
            let times =
                report.times.iter().filter(|(of, time)| *of == form && time.precision == precision);
            let ns_per_point: f64 = times.map(|(_, time)| time.ns_per_point).sum();
            // A logarithmic axis has no place for others.
            if error > 0.0 && error.is_finite() && ns_per_point > 0.0 {
                marks.push(Mark { precision, form, ns_per_point, error });
            }
        }
    }
    marks
}

/// Those that no other one beats in both, from fast to accurate.
fn best(marks: &[Mark]) -> Vec<(f64, f64)> {
    let points: Vec<_> = marks.iter().map(|mark| (mark.ns_per_point, mark.error)).collect();
    front(&points).into_iter().map(|at| points[at]).collect()
}

fn draw_into(report: &Report, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let marks = marks(report);
    let times = span(marks.iter().map(|mark| mark.ns_per_point), 3.0);
    let errors = span(marks.iter().map(|mark| mark.error), 100.0);
    let ((times_shown, times_between), (decades, _)) = (ticks(times), ticks(errors));
    let errors_shown: Vec<f64> = decades.iter().copied().step_by(decades.len() / 10 + 1).collect();
    let caption = format!("{}: {}, {} points", report.field.shown(), regime(report), report.points);
    let mut chart = ChartBuilder::on(&root)
        .caption(caption, ("sans-serif", 18))
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(72)
        .build_cartesian_2d(
            (times.0..times.1)
                .log_scale()
                .with_key_points(times_shown)
                .with_light_points(times_between),
            (errors.0..errors.1).log_scale().with_key_points(errors_shown),
        )?;
    chart
        .configure_mesh()
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .x_desc("all of these quantities together, ns per point")
        .y_desc("largest error over largest value")
        .x_label_formatter(&|time| format!("{time}"))
        .y_label_formatter(&|error| format!("{error:.0e}"))
        .bold_line_style(RGBColor(210, 210, 210))
        .light_line_style(RGBColor(240, 240, 240))
        .draw()?;
    if !marks.is_empty() {
        chart
            .draw_series(DashedLineSeries::new(best(&marks), 6, 4, FRONT.stroke_width(2)))?
            .label("Pareto front")
            .legend(|(x, y)| {
                DashedPathElement::new([(x, y), (x + 18, y)], 6, 4, FRONT.stroke_width(2))
            });
    }
    for form in Form::ALL {
        let marks = marks.iter().filter(|mark| mark.form == form);
        let circles = marks.clone().map(|mark| {
            let style = style(colour(mark.precision), form);
            Circle::new((mark.ns_per_point, mark.error), 6, style)
        });
        chart
            .draw_series(circles)?
            .label(form.name())
            .legend(move |(x, y)| Circle::new((x + 9, y), 6, style(FRONT, form)));
        // The other form is never far.
        for mark in marks.filter(|mark| mark.form == Form::Stable) {
            let at = EmptyElement::at((mark.ns_per_point, mark.error));
            let name = Text::new(mark.precision.name(), (10, -18), TEXT.into_font());
            chart.draw_series([at + name])?;
        }
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(TEXT)
        .background_style(WHITE)
        .border_style(FRONT)
        .draw()?;
    root.present()?;
    Ok(())
}

fn colour(precision: Precision) -> RGBColor {
    match precision {
        Precision::F32 => COLOURS[0],
        Precision::F64 => COLOURS[1],
        Precision::Wide => COLOURS[2],
    }
}

/// A disc for the stable form, a ring for the fast one.
fn style(colour: RGBColor, form: Form) -> ShapeStyle {
    match form {
        Form::Stable => colour.filled(),
        Form::Fast => colour.stroke_width(2),
    }
}
