//! The convergence picture: errors over cell size, both logarithmic, with the expected slope.

use anyhow::anyhow;
use mms_runtime::Errors;
use mms_runtime::study::Refinement;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::{Study, method};

const SIZE: (u32, u32) = (760, 520);
/// Colours that are told apart without seeing colour well (Okabe & Ito 2008).
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];
/// In other fonts `l1` and `linf` look like `I1` and `Iinf`.
const LABELS: (&str, u32) = ("monospace", 14);
const TEXT: (&str, u32) = ("sans-serif", 15);
const SLOPE: RGBColor = RGBColor(90, 90, 90);
/// How far below the upper edge runs that stopped are marked.
const EDGE: f64 = 1.15;

/// A name, and points of a length and an error.
pub(super) type Line = (String, Vec<(f64, f64)>);

/// Lines over h or dt.
pub(super) struct Picture {
    pub caption: String,
    /// What is along the axes.
    pub axes: [&'static str; 2],
    pub lines: Vec<Line>,
    /// h or dt of all levels.
    pub lengths: Vec<f64>,
    /// h or dt of levels with a run that stopped, which are marked at the upper edge.
    pub stopped: Vec<f64>,
    /// The slope that is expected.
    pub order: f64,
}

/// The picture of a study as SVG text: a line for each norm.
pub fn draw(study: &Study) -> anyhow::Result<String> {
    let caption =
        format!("{}: {}", study.field.shown(), method::line(&study.method, study.arithmetic));
    let line = |name: &str, norm: fn(&Errors) -> f64| (name.to_owned(), points(study, norm));
    let lines = vec![
        line("l1", |errors| errors.l1),
        line("l2", |errors| errors.l2),
        line("linf", |errors| errors.linf),
    ];
    Picture::of(&[study], caption, lines).svg()
}

/// The picture of several methods: a line for l2 of each.
pub fn draw_all(studies: &[Study], names: &[String]) -> anyhow::Result<String> {
    let lines = names.iter().zip(studies);
    let lines = lines.map(|(name, study)| (name.clone(), points(study, |errors| errors.l2)));
    let caption = format!("{}: l2 of {} methods", studies[0].field.shown(), studies.len());
    Picture::of(&studies.iter().collect::<Vec<_>>(), caption, lines.collect()).svg()
}

/// The points (h, error) of one norm that a logarithmic axis can show.
fn points(study: &Study, norm: fn(&Errors) -> f64) -> Vec<(f64, f64)> {
    let points = study.points().into_iter().filter_map(|point| {
        let error = norm(&point.errors?);
        (error > 0.0).then_some((point.length, error))
    });
    points.collect()
}

/// h or dt of the levels that have no error.
fn stopped(study: &Study) -> Vec<f64> {
    let points = study.points().into_iter();
    points.filter(|it| it.errors.is_none()).map(|it| it.length).collect()
}

/// What a refinement is drawn over.
fn over(refinement: Refinement) -> &'static str {
    if refinement == Refinement::Time { "time step dt" } else { "cell size h" }
}

impl Picture {
    fn of(studies: &[&Study], caption: String, lines: Vec<Line>) -> Self {
        let runs = studies.iter().flat_map(|study| study.started());
        let refinement = studies[0].refinement;
        Self {
            caption,
            axes: [
                over(refinement),
                match studies[0].differences {
                    Some(_) => "largest difference of displacements to the next level",
                    None if studies[0].method.setup.relax => "displacement error at equilibrium",
                    None => "largest displacement error over time",
                },
            ],
            lines,
            lengths: runs.map(|run| refinement.length(&run.level)).collect(),
            stopped: studies.iter().flat_map(|study| stopped(study)).collect(),
            order: studies[0].expected.order,
        }
    }

    pub fn svg(&self) -> anyhow::Result<String> {
        let mut svg = String::new();
        draw_into(self, &mut svg).map_err(|error| anyhow!("cannot draw the picture: {error}"))?;
        Ok(svg)
    }
}

fn draw_into(picture: &Picture, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let all: Vec<_> = picture.lines.iter().flat_map(|(_, points)| points.clone()).collect();
    let slope = slope(&all, picture.order);
    let lengths = || picture.lengths.iter().copied();
    let sizes = span(lengths(), 1.25);
    let errors = span(all.iter().chain(&slope).map(|(_, error)| *error), 2.0);
    let sizes_shown = apart(lengths(), sizes);
    let (errors_shown, errors_between) = ticks(errors);
    let mut chart = ChartBuilder::on(&root)
        .caption(&picture.caption, ("sans-serif", 18))
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
        .x_desc(picture.axes[0])
        .y_desc(picture.axes[1])
        .x_label_formatter(&|h| format!("{h:.2e}"))
        .y_label_formatter(&|error| format!("{error:.0e}"))
        .bold_line_style(RGBColor(210, 210, 210))
        .light_line_style(RGBColor(240, 240, 240))
        .draw()?;
    for ((name, points), colour) in picture.lines.iter().zip(COLOURS.iter().cycle()) {
        chart
            .draw_series(
                LineSeries::new(points.iter().copied(), colour.stroke_width(2)).point_size(4),
            )?
            .label(name)
            .legend(|(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
    }
    if !slope.is_empty() {
        chart
            .draw_series(DashedLineSeries::new(slope, 6, 4, SLOPE.stroke_width(2)))?
            .label(format!("slope {}", picture.order))
            .legend(|(x, y)| {
                let ends = [(x, y), (x + 18, y)];
                DashedPathElement::new(ends, 6, 4, SLOPE.stroke_width(2))
            });
    }
    if !picture.stopped.is_empty() {
        let edge = errors.1 / EDGE;
        let marks =
            picture.stopped.iter().map(|&it| Cross::new((it, edge), 5, SLOPE.stroke_width(2)));
        chart
            .draw_series(marks)?
            .label("stopped")
            .legend(|(x, y)| Cross::new((x + 9, y), 5, SLOPE.stroke_width(2)));
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
pub fn span(values: impl Iterator<Item = f64>, factor: f64) -> (f64, f64) {
    let (least, greatest) = values
        .fold((f64::INFINITY, 0.0_f64), |(least, greatest), v| (least.min(v), greatest.max(v)));
    if greatest > 0.0 { (least / factor, greatest * factor) } else { (0.1, 1.0) }
}

/// Those of the values whose labels do not overlap on a logarithmic axis.
pub fn apart(values: impl Iterator<Item = f64>, range: (f64, f64)) -> Vec<f64> {
    let room = (range.1 / range.0).ln() / 9.0;
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|next, kept| (*next / *kept).ln() < room);
    values
}

/// Labelled and unlabelled places on a logarithmic axis: decades if there are two or more.
pub fn ticks(range: (f64, f64)) -> (Vec<f64>, Vec<f64>) {
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
