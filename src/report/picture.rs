//! The convergence picture: errors over cell size, both logarithmic, with the expected slope.

use anyhow::anyhow;
use plotters::prelude::*;

use super::Study;

const SIZE: (u32, u32) = (760, 520);
/// Colours that are told apart without seeing colour well (Okabe & Ito 2008).
const NORMS: [(&str, RGBColor); 3] =
    [("l1", RGBColor(0, 114, 178)), ("l2", RGBColor(213, 94, 0)), ("linf", RGBColor(0, 158, 115))];

/// The picture as SVG text.
pub fn draw(study: &Study) -> anyhow::Result<String> {
    let mut svg = String::new();
    draw_into(study, &mut svg).map_err(|error| anyhow!("cannot draw the picture: {error}"))?;
    Ok(svg)
}

/// The points (h, error) of one norm that a logarithmic axis can show.
fn points(study: &Study, norm: usize) -> Vec<(f64, f64)> {
    let levels = study.levels.iter();
    levels
        .filter_map(|level| {
            let errors = level.errors.as_ref().ok()?;
            let error = [errors.l1, errors.l2, errors.linf][norm];
            (error > 0.0).then_some((level.cell_size, error))
        })
        .collect()
}

fn draw_into(study: &Study, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let all: Vec<_> = (0..NORMS.len()).flat_map(|norm| points(study, norm)).collect();
    let sizes = span(study.levels.iter().map(|level| level.cell_size), 1.25);
    let errors = span(all.iter().map(|(_, error)| *error), 2.0);
    let caption = format!("{}: {}", study.field, study.method_line());
    let mut chart = ChartBuilder::on(&root)
        .caption(caption, ("sans-serif", 16))
        .margin(16)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d((sizes.0..sizes.1).log_scale(), (errors.0..errors.1).log_scale())?;
    chart
        .configure_mesh()
        .x_desc("cell size h")
        .y_desc("largest displacement error over time")
        .x_label_formatter(&|h| format!("{h:.0e}"))
        .y_label_formatter(&|error| format!("{error:.0e}"))
        .light_line_style(RGBColor(236, 236, 236))
        .draw()?;
    for (norm, (name, colour)) in NORMS.iter().enumerate() {
        let points = points(study, norm);
        chart
            .draw_series(
                LineSeries::new(points.iter().copied(), colour.stroke_width(2)).point_size(4),
            )?
            .label(*name)
            .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
    }
    // The expected slope, through the finest l2 error.
    let finest = points(study, 1).into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((h, error)) = finest {
        let slope = |size: f64| (size, error * (size / h).powf(study.expected_order));
        let line: Vec<_> = [h, sizes.1 / 1.25].map(slope).to_vec();
        chart
            .draw_series(DashedLineSeries::new(line, 6, 4, BLACK.stroke_width(1)))?
            .label(format!("slope {}", study.expected_order))
            .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], BLACK.stroke_width(1)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE)
        .border_style(BLACK)
        .draw()?;
    root.present()?;
    Ok(())
}

/// The range of some positive values, widened by a factor; a harmless one where there are none.
fn span(values: impl Iterator<Item = f64>, factor: f64) -> (f64, f64) {
    let (least, greatest) = values
        .fold((f64::INFINITY, 0.0_f64), |(least, greatest), v| (least.min(v), greatest.max(v)));
    if greatest > 0.0 { (least / factor, greatest * factor) } else { (0.1, 1.0) }
}
