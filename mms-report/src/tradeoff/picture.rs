//! Errors over cost, both logarithmic: down and left is better.

use anyhow::anyhow;
use mms_lab::tradeoff::search::{Cost, Goal, Trial};
use mms_lab::tradeoff::setting::Setting;
use plotters::prelude::*;

use super::super::picture::{span, ticks};
use super::Report;

const SIZE: (u32, u32) = (760, 520);
const TEXT: (&str, u32) = ("sans-serif", 15);
/// Colours that are told apart without seeing colour well (Okabe & Ito 2008).
const FRONT: RGBColor = RGBColor(0, 114, 178);
const DEFAULT: RGBColor = RGBColor(213, 94, 0);
const CHOICE: RGBColor = RGBColor(0, 158, 115);
const OTHER: RGBColor = RGBColor(170, 170, 170);
const GOAL: RGBColor = RGBColor(90, 90, 90);

/// The picture as SVG text.
pub fn draw(report: &Report) -> anyhow::Result<String> {
    let mut svg = String::new();
    draw_into(report, &mut svg).map_err(|error| anyhow!("cannot draw the picture: {error}"))?;
    Ok(svg)
}

fn draw_into(report: &Report, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    // An error of nothing is nowhere on an axis of logarithms.
    let point = |trial: &Trial| report.point(trial).filter(|(_, error)| *error > 0.0);
    let points = |take: &dyn Fn(&Trial) -> bool| -> Vec<(f64, f64)> {
        report.trials().iter().filter(|trial| take(trial)).filter_map(point).collect()
    };
    let is_default = |trial: &Trial| trial.setting == Setting::default();
    let all = points(&|_| true);
    let costs = span(all.iter().map(|point| point.0), 2.0);
    let (target, budget) = match report.plan.goal {
        Goal::Error(target) => (Some(target), None),
        Goal::Cost(budget) => (None, Some(budget)),
    };
    let errors = span(all.iter().map(|point| point.1).chain(target), 2.0);
    let ((costs_shown, costs_between), (errors_shown, errors_between)) =
        (ticks(costs), ticks(errors));
    let mut chart = ChartBuilder::on(&root)
        .caption(format!("{}: error against cost", report.field.shown()), ("sans-serif", 18))
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(72)
        .build_cartesian_2d(
            (costs.0..costs.1)
                .log_scale()
                .with_key_points(costs_shown)
                .with_light_points(costs_between),
            (errors.0..errors.1)
                .log_scale()
                .with_key_points(errors_shown)
                .with_light_points(errors_between),
        )?;
    chart
        .configure_mesh()
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .x_desc(match report.plan.cost {
            Cost::Seconds => "seconds",
            Cost::ParticleSteps => "particle-steps",
            Cost::Memory => "bytes",
        })
        .y_desc("largest displacement error over time and particles")
        .x_label_formatter(&|cost| format!("{cost:.0e}"))
        .y_label_formatter(&|error| format!("{error:.0e}"))
        .bold_line_style(RGBColor(210, 210, 210))
        .light_line_style(RGBColor(240, 240, 240))
        .draw()?;
    let goal = match (target, budget) {
        (Some(target), _) => vec![(costs.0, target), (costs.1, target)],
        (_, Some(budget)) => vec![(budget, errors.0), (budget, errors.1)],
        _ => Vec::new(),
    };
    chart
        .draw_series(DashedLineSeries::new(goal, 6, 4, GOAL.stroke_width(1)))?
        .label("goal")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], GOAL.stroke_width(1)));
    let front: Vec<_> = report.front().into_iter().filter_map(point).collect();
    let circles = points(&|trial| !is_default(trial));
    chart
        .draw_series(circles.into_iter().map(|at| Circle::new(at, 4, OTHER.filled())))?
        .label("run")
        .legend(|(x, y)| Circle::new((x + 9, y), 4, OTHER.filled()));
    chart
        .draw_series(LineSeries::new(front, FRONT.stroke_width(2)).point_size(3))?
        .label("Pareto front")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], FRONT.stroke_width(2)));
    let mut default = points(&is_default);
    default.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart
        .draw_series(LineSeries::new(default, DEFAULT.stroke_width(1)).point_size(4))?
        .label("default method")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], DEFAULT.stroke_width(1)));
    if let Some(at) = report.choice().and_then(point) {
        chart
            .draw_series([Circle::new(at, 8, CHOICE.stroke_width(3))])?
            .label("choice")
            .legend(|(x, y)| Circle::new((x + 9, y), 6, CHOICE.stroke_width(3)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(TEXT)
        .background_style(WHITE)
        .border_style(GOAL)
        .draw()?;
    root.present()?;
    Ok(())
}
