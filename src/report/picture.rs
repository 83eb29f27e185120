//! The convergence picture: errors over cell size, both logarithmic, with the expected slope.

use anyhow::anyhow;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

use mms_runtime::study::{Point, Refinement};

use super::{Study, method};

const SIZE: (u32, u32) = (760, 520);
/// Colours that are told apart without seeing colour well (Okabe & Ito 2008).
const NORMS: [(&str, RGBColor); 3] =
    [("l1", RGBColor(0, 114, 178)), ("l2", RGBColor(213, 94, 0)), ("linf", RGBColor(0, 158, 115))];
/// In other fonts `l1` and `linf` look like `I1` and `Iinf`.
const LABELS: (&str, u32) = ("monospace", 14);
const TEXT: (&str, u32) = ("sans-serif", 15);
const SLOPE: RGBColor = RGBColor(90, 90, 90);

/// The picture as SVG text.
pub fn draw(study: &Study) -> anyhow::Result<String> {
    let mut svg = String::new();
    draw_into(study, &mut svg).map_err(|error| anyhow!("cannot draw the picture: {error}"))?;
    Ok(svg)
}

/// The points (h, error) of one norm that a logarithmic axis can show.
fn points(study: &Study, norm: usize) -> Vec<(f64, f64)> {
    let own: Vec<Point>;
    let points = match &study.differences {
        Some(differences) => differences.points(),
        None => {
            own = study.started().map(|run| study.refinement.displacement(run)).collect();
            &own
        }
    };
    let shown = points.iter().filter_map(|point| {
        let errors = point.errors?;
        let error = [errors.l1, errors.l2, errors.linf][norm];
        (error > 0.0).then_some((point.length, error))
    });
    shown.collect()
}

fn draw_into(study: &Study, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let all: Vec<_> = (0..NORMS.len()).flat_map(|norm| points(study, norm)).collect();
    let slope = slope(&all, study.expected_order);
    let lengths = || study.started().map(|run| study.refinement.length(&run.level));
    let sizes = span(lengths(), 1.25);
    let errors = span(all.iter().chain(&slope).map(|(_, error)| *error), 2.0);
    let sizes_shown = apart(lengths(), sizes);
    let (errors_shown, errors_between) = ticks(errors);
    let caption = format!("{}: {}", study.field, method::line(&study.method, study.precision));
    let mut chart = ChartBuilder::on(&root)
        .caption(caption, ("sans-serif", 18))
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(72)
        .build_cartesian_2d(
            (sizes.0..sizes.1).log_scale().with_key_points(sizes_shown),
            (errors.0..errors.1)
                .log_scale()
                .with_key_points(errors_shown)
                .with_light_points(errors_between),
        )?;
    chart
        .configure_mesh()
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .x_desc(if study.refinement == Refinement::Time { "time step dt" } else { "cell size h" })
        .y_desc(match study.differences {
            Some(_) => "largest difference of displacements to the next level",
            None => "largest displacement error over time",
        })
        .x_label_formatter(&|h| format!("{h:.2e}"))
        .y_label_formatter(&|error| format!("{error:.0e}"))
        .bold_line_style(RGBColor(210, 210, 210))
        .light_line_style(RGBColor(240, 240, 240))
        .draw()?;
    for (norm, (name, colour)) in NORMS.iter().enumerate() {
        chart
            .draw_series(
                LineSeries::new(points(study, norm), colour.stroke_width(2)).point_size(4),
            )?
            .label(*name)
            .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
    }
    if !slope.is_empty() {
        chart
            .draw_series(DashedLineSeries::new(slope, 6, 4, SLOPE.stroke_width(2)))?
            .label(format!("slope {}", study.expected_order))
            .legend(|(x, y)| {
                let ends = [(x, y), (x + 18, y)];
                DashedPathElement::new(ends, 6, 4, SLOPE.stroke_width(2))
            });
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .label_font(LABELS)
        .background_style(WHITE)
        .border_style(SLOPE)
        .draw()?;
    root.present()?;
    Ok(())
}

/// The ends of a line with the expected slope, below the least error of the finest level so that
/// it hides no curve, and no higher than the largest error.
fn slope(all: &[(f64, f64)], order: f64) -> Vec<(f64, f64)> {
    let below = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
    let Some((h, error)) = all.iter().min_by(below) else { return Vec::new() };
    let (largest_size, largest_error) = all
        .iter()
        .fold((*h, *error), |largest, point| (largest.0.max(point.0), largest.1.max(point.1)));
    let start = error / 1.6;
    let growth = (largest_error / start).powf(1.0 / order);
    let end = if order > 0.0 { largest_size.min(h * growth) } else { largest_size };
    vec![(*h, start), (end, start * (end / h).powf(order))]
}

/// The range of some positive values, widened by a factor; a harmless one where there are none.
pub(crate) fn span(values: impl Iterator<Item = f64>, factor: f64) -> (f64, f64) {
    let (least, greatest) = values
        .fold((f64::INFINITY, 0.0_f64), |(least, greatest), v| (least.min(v), greatest.max(v)));
    if greatest > 0.0 { (least / factor, greatest * factor) } else { (0.1, 1.0) }
}

/// Those of the values whose labels do not overlap on a logarithmic axis.
pub(crate) fn apart(values: impl Iterator<Item = f64>, range: (f64, f64)) -> Vec<f64> {
    let room = (range.1 / range.0).ln() / 9.0;
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|next, kept| (*next / *kept).ln() < room);
    values
}

/// Labelled and unlabelled places on a logarithmic axis: decades if there are two or more.
pub(crate) fn ticks(range: (f64, f64)) -> (Vec<f64>, Vec<f64>) {
    let exponents = range.0.log10().floor() as i32..=range.1.log10().ceil() as i32;
    let inside = |digits: &[u8]| -> Vec<f64> {
        let values = exponents.clone().flat_map(|exponent| {
            digits.iter().map(move |digit| f64::from(*digit) * 10f64.powi(exponent))
        });
        values.filter(|value| (range.0..=range.1).contains(value)).collect()
    };
    let decades = inside(&[1]);
    let shown = if decades.len() < 2 { inside(&[1, 2, 5]) } else { decades };
    (shown, inside(&[2, 3, 4, 5, 6, 7, 8, 9]))
}
