//! Curves over two logarithmic axes, as SVG whose colours are those of the page.

use maud::{Markup, html};

use crate::picture::{apart, span, ticks};

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
const LEFT: f64 = 76.0;
const BOTTOM: f64 = 52.0;
const MARGIN: f64 = 12.0;

/// A round-off floor further below all errors than this factor would press them together.
const FAR: f64 = 1e3;

/// A picture.
pub struct Plot {
    /// What it shows, for who does not see it.
    pub title: String,
    /// The same at length.
    pub description: String,
    /// What is measured along the axes.
    pub axes: [&'static str; 2],
    /// What is drawn.
    pub curves: Vec<Curve>,
    /// The slope of a triangle under the two leftmost points.
    pub slope: Option<f64>,
    /// What round-off leaves.
    pub floor: Vec<[f64; 2]>,
    /// Whether the places of points are written along the first axis, rather than decades.
    pub marks_points: bool,
}

/// Points and how they are drawn.
pub struct Curve {
    /// Its name in the legend.
    pub name: String,
    /// In any order; what a logarithmic axis cannot show is left out.
    pub points: Vec<[f64; 2]>,
    /// Colour and mark, 0 to 2.
    pub style: usize,
    /// Marks that are rings.
    pub is_hollow: bool,
    /// A line through the points.
    pub line: Line,
}

/// A line through points.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// None.
    None,
    /// With marks.
    Solid,
    /// Without.
    Dashed,
}

/// Numbers that a logarithmic axis shows: beyond them, what is drawn between them would not be finite.
const SHOWN: std::ops::RangeInclusive<f64> = 1e-150..=1e150;

fn is_shown(point: &&[f64; 2]) -> bool {
    point.iter().all(|it| SHOWN.contains(it))
}

/// Where numbers are on the picture.
struct Frame {
    x: (f64, f64),
    y: (f64, f64),
}

impl Frame {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let along =
            |value: f64, (from, to): (f64, f64)| (value.ln() - from.ln()) / (to.ln() - from.ln());
        let height = HEIGHT - MARGIN - BOTTOM;
        let round = |value: f64| (value * 10.0).round() / 10.0;
        [
            round(LEFT + along(x, self.x) * (WIDTH - LEFT - MARGIN)),
            round(MARGIN + (1.0 - along(y, self.y)) * height),
        ]
    }

    fn path(&self, points: &[[f64; 2]]) -> String {
        let place = |point: &[f64; 2]| {
            let [x, y] = self.place(*point);
            format!("{x},{y}")
        };
        points.iter().map(place).collect::<Vec<_>>().join(" ")
    }
}

impl Plot {
    /// Whether the floor is close enough to be drawn.
    pub fn shows_floor(&self) -> bool {
        let least = self.points().map(|[_, error]| error).fold(f64::INFINITY, f64::min);
        self.floor.iter().any(|[_, floor]| floor * FAR > least)
    }

    fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.curves.iter().flat_map(move |curve| curve.points.iter().filter(is_shown).copied())
    }

    /// A triangle that rises by the slope, below the two leftmost points.
    fn triangle(&self) -> Option<[[f64; 2]; 3]> {
        let slope = self.slope.filter(|slope| *slope > 0.0)?;
        let mut places: Vec<f64> = self.points().map(|[x, _]| x).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let [from, to] = *places.get(..2)? else { return None };
        let least = |at: f64| {
            let there = self.points().filter(|[x, _]| *x == at).map(|[_, y]| y);
            there.fold(f64::INFINITY, f64::min)
        };
        let rise = (to / from).powf(slope);
        let low = (least(from)).min(least(to) / rise) / 1.8;
        let corners = [[from, low], [to, low], [to, low * rise]];
        corners.iter().all(|it| is_shown(&it)).then_some(corners)
    }

    /// The picture; nothing, if there is nothing to draw.
    pub fn svg(&self, id: &str) -> Option<Markup> {
        let points: Vec<_> = self.points().collect();
        if points.is_empty() {
            return None;
        }
        let triangle = self.triangle();
        let floor = if self.shows_floor() { self.floor.as_slice() } else { &[] };
        let floor: Vec<[f64; 2]> = floor.iter().filter(is_shown).copied().collect();
        let all = || points.iter().chain(triangle.iter().flatten()).chain(&floor);
        let frame =
            Frame { x: span(all().map(|[x, _]| *x), 1.25), y: span(all().map(|[_, y]| *y), 1.8) };
        let [title, description] = [format!("{id}-title"), format!("{id}-text")];
        Some(html! {
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-labelledby=(format!("{title} {description}")) xmlns="http://www.w3.org/2000/svg" {
                title id=(title) { (self.title) }
                desc id=(description) { (self.description) }
                (self.mesh(&frame, &points))
                @if !floor.is_empty() { polyline.floor points=(frame.path(&floor)) {} }
                @if let Some(corners) = triangle {
                    polygon.slope points=(frame.path(&corners)) {}
                    @let [x, y] = frame.place([corners[1][0], (corners[1][1] * corners[2][1]).sqrt()]);
                    text x=(x + 5.0) y=(y + 4.0) { (self.slope.unwrap_or_default()) }
                    @let [x, y] = frame.place([(corners[0][0] * corners[1][0]).sqrt(), corners[0][1]]);
                    text x=(x) y=(y + 14.0) text-anchor="middle" { "1" }
                }
                @for curve in &self.curves { (drawn(curve, &frame)) }
            }
            (self.legend(!floor.is_empty()))
        })
    }

    /// Axes, their numbers, and lines from these.
    fn mesh(&self, frame: &Frame, points: &[[f64; 2]]) -> Markup {
        let [left, bottom] = frame.place([frame.x.0, frame.y.0]);
        let [right, top] = frame.place([frame.x.1, frame.y.1]);
        let x = match self.marks_points {
            true => apart(points.iter().map(|[x, _]| *x), frame.x),
            false => ticks(frame.x).0,
        };
        let y = ticks(frame.y).0;
        html! {
            g.mesh {
                @for value in &x {
                    @let [at, _] = frame.place([*value, frame.y.0]);
                    line x1=(at) x2=(at) y1=(top) y2=(bottom) {}
                    text x=(at) y=(bottom + 18.0) text-anchor="middle" { (label(*value)) }
                }
                @for value in &y {
                    @let [_, at] = frame.place([frame.x.0, *value]);
                    line x1=(left) x2=(right) y1=(at) y2=(at) {}
                    text x=(left - 8.0) y=(at + 4.0) text-anchor="end" { (label(*value)) }
                }
            }
            path.axes d=(format!("M{left},{top}V{bottom}H{right}")) {}
            text x=((left + right) / 2.0) y=(HEIGHT - 10.0) text-anchor="middle" { (self.axes[0]) }
            @let middle = (top + bottom) / 2.0;
            text x="16" y=(middle) text-anchor="middle" transform=(format!("rotate(-90 16 {middle})")) { (self.axes[1]) }
        }
    }

    fn legend(&self, has_floor: bool) -> Markup {
        html! {
            ul.legend {
                @for curve in &self.curves {
                    li { (key(|| sample(curve))) (curve.name) }
                }
                @if let Some(slope) = self.slope {
                    li { (key(|| html! { path.slope d="M4,12H22V3z" {} })) "slope " (slope) }
                }
                @if has_floor {
                    li { (key(|| html! { line.floor x1="2" x2="26" y1="8" y2="8" {} })) "round-off floor" }
                }
            }
        }
    }
}

/// A sign in the legend, which its name stands beside.
fn key(inside: impl Fn() -> Markup) -> Markup {
    html! { svg.key viewBox="0 0 28 16" aria-hidden="true" xmlns="http://www.w3.org/2000/svg" { (inside()) } }
}

fn class(curve: &Curve) -> String {
    let hollow = if curve.is_hollow { " hollow" } else { "" };
    format!("series s{}{hollow}", curve.style)
}

fn sample(curve: &Curve) -> Markup {
    html! {
        g class=(class(curve)) {
            @match curve.line {
                Line::None => {},
                Line::Solid => line x1="2" x2="26" y1="8" y2="8" {},
                Line::Dashed => line.dashed x1="2" x2="26" y1="8" y2="8" {},
            }
            @if curve.line != Line::Dashed { (mark(curve.style, [14.0, 8.0])) }
        }
    }
}

fn drawn(curve: &Curve, frame: &Frame) -> Markup {
    let points: Vec<_> = curve.points.iter().filter(is_shown).copied().collect();
    html! {
        g class=(class(curve)) {
            @if curve.line != Line::None {
                polyline class=[(curve.line == Line::Dashed).then_some("dashed")] points=(frame.path(&points)) {}
            }
            @if curve.line != Line::Dashed {
                @for point in &points { (mark(curve.style, frame.place(*point))) }
            }
        }
    }
}

/// A disc, a square or a triangle.
fn mark(style: usize, [x, y]: [f64; 2]) -> Markup {
    html! {
        @match style {
            0 => circle cx=(x) cy=(y) r="4.5" {},
            1 => path d=(format!("M{} {}h8v8h-8z", x - 4.0, y - 4.0)) {},
            _ => path d=(format!("M{x} {}l5.5 9.5h-11z", y - 6.0)) {},
        }
    }
}

/// A number at an axis: a power of ten, or three digits.
fn label(value: f64) -> Markup {
    let exponent = value.log10().round();
    let is_power = (value / 10f64.powf(exponent) - 1.0).abs() < 1e-9;
    html! {
        @if is_power && exponent.abs() > 2.0 {
            "10" tspan.exponent dy="-6" { (exponent) }
        } @else {
            (short(value))
        }
    }
}

/// Three digits of a number.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e4).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(errors: [f64; 3], floor: f64) -> Plot {
        let points = |scale: f64| {
            [0.25, 0.125, 0.0625].into_iter().zip(errors).map(move |(h, e)| [h, e * scale])
        };
        let curve = |style: usize| Curve {
            name: format!("curve {style}"),
            points: points(1.0 + style as f64).collect(),
            style,
            is_hollow: false,
            line: Line::Solid,
        };
        Plot {
            title: "errors".into(),
            description: "of three levels".into(),
            axes: ["h", "error"],
            curves: vec![curve(0), curve(1)],
            slope: Some(2.0),
            floor: points(1.0).map(|[h, _]| [h, floor]).collect(),
            marks_points: true,
        }
    }

    #[test]
    fn the_triangle_rises_by_the_slope_and_lies_below_all_curves() {
        let plot = plot([1e-2, 2.5e-3, 6.25e-4], 1e-16);
        let [from, corner, to] = plot.triangle().expect("a triangle");
        let slope = (to[1] / corner[1]).ln() / (corner[0] / from[0]).ln();
        assert!((slope - 2.0).abs() < 1e-12, "{slope}");
        assert_eq!([from[0], to[0]], [0.0625, 0.125]);
        assert!(from[1] < 6.25e-4 && to[1] < 2.5e-3);
    }

    #[test]
    fn a_floor_is_drawn_where_it_is_near() {
        let near = plot([1e-12, 1e-13, 3e-14], 1e-14);
        let far = plot([1e-2, 1e-3, 1e-4], 1e-14);
        for (plot, is_near) in [(near, true), (far, false)] {
            assert_eq!(plot.shows_floor(), is_near);
            let svg = plot.svg("p").expect("a picture").into_string();
            assert_eq!(svg.contains("round-off floor"), is_near);
        }
    }

    #[test]
    fn what_a_logarithmic_axis_cannot_show_is_left_out() {
        let drawn = plot([0.0, 1e-3, f64::NAN], 0.0).svg("p").expect("a picture").into_string();
        assert!(!drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
        assert!(plot([0.0; 3], 0.0).svg("p").is_none());
        for errors in [[1e308, 1e-308, 1e-3], [1e140, 1e-140, 1e-3], [1e-3, 1e-3, f64::INFINITY]] {
            let drawn = plot(errors, 1e-4).svg("p").map_or(String::new(), |it| it.into_string());
            assert!(!drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
        }
    }

    #[test]
    fn numbers_at_axes_have_three_digits() {
        let found = [0.0625, 1.0 / 3.0, 1.5e-7, 12345.0, 0.0].map(short);
        assert_eq!(found, ["0.0625", "0.333", "1.5e-7", "1.23e4", "0"]);
    }
}
