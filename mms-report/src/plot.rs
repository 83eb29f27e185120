//! Curves over two logarithmic axes, as SVG: on a page, whose style sheet colours them, or as a figure for print.
//!
//! Both are one drawing. On a page it is as wide as the text and its legend stands below; a [`figure`](Plot::figure) is a file
//! of its own, in millimetres, with its style sheet inside and its legend beside the curves. Marks and dashes tell the curves
//! apart without colours, which are those of Okabe and Ito, "Color Universal Design" (2008).

use maud::{Markup, PreEscaped, html};

use crate::axis::{apart, label, span, ticks};

/// A round-off floor further below all errors than this factor would press them together.
const FAR: f64 = 1e3;

/// The number of colours, each with its mark and its dashes.
pub const STYLES: usize = 6;

/// A picture.
#[derive(Default)]
pub struct Plot {
    /// The title, for readers who do not see the picture.
    pub title: String,
    /// The numbers of the picture in words.
    pub description: String,
    /// The quantities along the axes.
    pub axes: [&'static str; 2],
    /// The curves.
    pub curves: Vec<Curve>,
    /// The slope of a triangle under the two leftmost points.
    pub slope: Option<f64>,
    /// The errors that round-off alone may make.
    pub floor: Vec<[f64; 2]>,
    /// The places of runs that stopped, which are marked at the upper edge.
    pub stopped: Vec<f64>,
    /// Whether the places of points are written along the first axis, rather than decades.
    pub marks_points: bool,
}

/// Points and how they are drawn.
#[derive(Default)]
pub struct Curve {
    /// Its name in the legend.
    pub name: String,
    /// The observed order, which the legend of a figure adds.
    pub order: Option<f64>,
    /// Points in any order; a logarithmic axis leaves out 0 and infinity.
    pub points: Vec<[f64; 2]>,
    /// Its colour, mark and dashes, below [`STYLES`].
    pub style: usize,
    /// Whether its marks are rings.
    pub is_hollow: bool,
    /// The line through its points.
    pub line: Line,
}

/// A line through points.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub enum Line {
    /// No line.
    None,
    /// A line with marks.
    #[default]
    Solid,
    /// A dashed line without marks.
    Dashed,
}

/// The width of a figure in print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Width {
    /// One column, 85 mm, with the legend below the curves.
    Column,
    /// The page, 170 mm, with the legend beside the curves.
    #[default]
    Page,
}

/// Numbers that a logarithmic axis shows: a drawing beyond them would have coordinates that are not finite.
const SHOWN: std::ops::RangeInclusive<f64> = 1e-150..=1e150;

fn is_shown(point: &&[f64; 2]) -> bool {
    point.iter().all(|it| SHOWN.contains(it))
}

/// The place of the curves on a picture, in pixels.
#[derive(Clone, Copy)]
struct Area {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// The picture on a page, in pixels.
const ON_PAGE: [f64; 2] = [640.0, 400.0];
const AREA_ON_PAGE: Area = Area { left: 76.0, right: 628.0, top: 12.0, bottom: 348.0 };

/// The style sheet of a figure.
const PRINT: &str = include_str!("plot.css");

/// Pixels in a millimetre, as CSS defines them.
const PER_MM: f64 = 96.0 / 25.4;

/// The height of a line of a legend.
const LEGEND_LINE: f64 = 17.0;

/// Where numbers are on the picture.
struct Frame {
    x: (f64, f64),
    y: (f64, f64),
    area: Area,
}

impl Frame {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let along =
            |value: f64, (from, to): (f64, f64)| (value.ln() - from.ln()) / (to.ln() - from.ln());
        let round = |value: f64| (value * 100.0).round() / 100.0;
        let Area { left, right, top, bottom } = self.area;
        [
            round(left + along(x, self.x) * (right - left)),
            round(bottom + along(y, self.y) * (top - bottom)),
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

/// A row of a legend: its sign, in a box of 28 by 16 pixels, and its text.
struct Entry {
    sign: Markup,
    text: String,
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

    fn floor_shown(&self) -> Vec<[f64; 2]> {
        let floor = if self.shows_floor() { self.floor.as_slice() } else { &[] };
        floor.iter().filter(is_shown).copied().collect()
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

    fn frame(&self, area: Area) -> Frame {
        let (triangle, floor) = (self.triangle(), self.floor_shown());
        let all = || self.points().chain(triangle.into_iter().flatten()).chain(floor.clone());
        let stopped = self.stopped.iter().copied().filter(|it| SHOWN.contains(it));
        Frame {
            x: span(all().map(|[x, _]| x).chain(stopped), 1.25),
            y: span(all().map(|[_, y]| y), 1.8),
            area,
        }
    }

    /// The picture for a page; `None` if there is nothing to draw.
    pub fn svg(&self, id: &str) -> Option<Markup> {
        self.points().next()?;
        let [width, height] = ON_PAGE;
        let [title, description] = [format!("{id}-title"), format!("{id}-text")];
        Some(html! {
            svg viewBox=(format!("0 0 {width} {height}")) role="img" aria-labelledby=(format!("{title} {description}")) xmlns="http://www.w3.org/2000/svg" {
                title id=(title) { (self.title) }
                desc id=(description) { (self.description) }
                (self.drawn(&self.frame(AREA_ON_PAGE)))
            }
            ul.legend {
                @for Entry { sign, text } in self.legend(false) {
                    li { svg.key viewBox="0 0 28 16" aria-hidden="true" xmlns="http://www.w3.org/2000/svg" { (sign) } (text) }
                }
            }
        })
    }

    /// The picture as an SVG file for print, under a caption.
    pub fn figure(&self, caption: &str, width: Width) -> String {
        let legend = self.legend(true);
        let longest = legend.iter().map(|it| it.text.chars().count()).max().unwrap_or(0) as f64;
        let (millimetres, beside) = match width {
            Width::Column => (85.0, 0.0),
            Width::Page => (170.0, 52.0 + 6.2 * longest.min(32.0)),
        };
        let whole = (millimetres * PER_MM).round();
        let right = whole - 12.0 - beside;
        let area = Area { left: 64.0, right, top: 34.0, bottom: 34.0 + 0.66 * (right - 64.0) };
        let below = area.bottom + 46.0;
        let (at, height) = match width {
            Width::Column => {
                ([area.left, below + 6.0], below + 12.0 + LEGEND_LINE * legend.len() as f64)
            }
            Width::Page => ([area.right + 16.0, area.top], below),
        };
        let height = height.round();
        let picture = html! {
            svg width=(format!("{millimetres}mm")) height=(format!("{:.1}mm", height / PER_MM)) viewBox=(format!("0 0 {whole} {height}")) role="img" aria-label=(caption) xmlns="http://www.w3.org/2000/svg" {
                title { (self.title) }
                desc { (self.description) }
                style { (PreEscaped(PRINT)) }
                rect.paper width=(whole) height=(height) {}
                text.caption x=(area.left) y="20" { (caption) }
                (self.drawn(&self.frame(area)))
                @for (row, Entry { sign, text }) in legend.iter().enumerate() {
                    @let y = at[1] + LEGEND_LINE * row as f64;
                    g.key transform=(format!("translate({} {y})", at[0])) { (sign) text x="34" y="12" { (text) } }
                }
            }
        };
        picture.into_string() + "\n"
    }

    /// Axes, floor, triangle, curves and marks of runs that stopped.
    fn drawn(&self, frame: &Frame) -> Markup {
        let (triangle, floor) = (self.triangle(), self.floor_shown());
        let edge = frame.area.top + 7.0;
        html! {
            (self.mesh(frame))
            @if !floor.is_empty() { polyline.floor points=(frame.path(&floor)) {} }
            @if let Some(corners) = triangle {
                polygon.slope points=(frame.path(&corners)) {}
                @let [x, y] = frame.place([corners[1][0], (corners[1][1] * corners[2][1]).sqrt()]);
                text x=(x + 5.0) y=(y + 4.0) { (self.slope.unwrap_or_default()) }
                @let [x, y] = frame.place([(corners[0][0] * corners[1][0]).sqrt(), corners[0][1]]);
                text x=(x) y=(y + 14.0) text-anchor="middle" { "1" }
            }
            @for curve in &self.curves { (drawn(curve, frame)) }
            @for place in self.stopped.iter().filter(|it| SHOWN.contains(*it)) {
                @let [x, _] = frame.place([*place, frame.y.1]);
                (cross([x, edge]))
            }
        }
    }

    /// Axes, their numbers, and lines from these.
    fn mesh(&self, frame: &Frame) -> Markup {
        let Area { left, right, top, bottom } = frame.area;
        let stopped = self.stopped.iter().copied().filter(|it| SHOWN.contains(it));
        let x = match self.marks_points {
            true => apart(self.points().map(|[x, _]| x).chain(stopped), frame.x),
            false => ticks(frame.x),
        };
        let y = ticks(frame.y);
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
            text x=((left + right) / 2.0) y=(bottom + 40.0) text-anchor="middle" { (self.axes[0]) }
            @let middle = (top + bottom) / 2.0;
            @let side = (left - 60.0).max(12.0);
            text x=(side) y=(middle) text-anchor="middle" transform=(format!("rotate(-90 {side} {middle})")) { (self.axes[1]) }
        }
    }

    /// The rows of the legend; those of a figure name observed orders.
    fn legend(&self, with_orders: bool) -> Vec<Entry> {
        let mut entries: Vec<Entry> = self
            .curves
            .iter()
            .filter(|curve| curve.points.iter().any(|it| is_shown(&it)))
            .map(|curve| {
                let order = curve.order.filter(|_| with_orders);
                let order = order.map_or_else(String::new, |order| format!(", order {order:.2}"));
                Entry { sign: sample(curve), text: format!("{}{order}", curve.name) }
            })
            .collect();
        entries.extend(self.slope.filter(|_| self.triangle().is_some()).map(|slope| Entry {
            sign: html! { path.slope d="M4,12H22V3z" {} },
            text: format!("slope {slope}"),
        }));
        entries.extend((!self.floor_shown().is_empty()).then(|| Entry {
            sign: html! { line.floor x1="2" x2="26" y1="8" y2="8" {} },
            text: "round-off floor".into(),
        }));
        entries.extend(
            (!self.stopped.is_empty())
                .then(|| Entry { sign: cross([14.0, 8.0]), text: "stopped".into() }),
        );
        entries
    }
}

fn class(curve: &Curve) -> String {
    let hollow = if curve.is_hollow { " hollow" } else { "" };
    format!("series s{}{hollow}", curve.style % STYLES)
}

fn sample(curve: &Curve) -> Markup {
    html! {
        g class=(class(curve)) {
            @match curve.line {
                Line::None => {},
                Line::Solid => line.line x1="2" x2="26" y1="8" y2="8" {},
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
                polyline class=(if curve.line == Line::Dashed { "dashed" } else { "line" }) points=(frame.path(&points)) {}
            }
            @if curve.line != Line::Dashed {
                @for point in &points { (mark(curve.style, frame.place(*point))) }
            }
        }
    }
}

/// The mark of a style: a disc, a square, a triangle, a diamond, a triangle on its tip, a bar.
fn mark(style: usize, [x, y]: [f64; 2]) -> Markup {
    let path = |corners: &str| html! { path.mark d=(format!("M{x} {y}{corners}")) {} };
    match style % STYLES {
        0 => html! { circle.mark cx=(x) cy=(y) r="4.5" {} },
        1 => path("m-4 -4h8v8h-8z"),
        2 => path("m0 -6l5.5 9.5h-11z"),
        3 => path("m0 -6l5 6l-5 6l-5 -6z"),
        4 => path("m0 6l5.5 -9.5h-11z"),
        _ => path("m-5.5 -2.5h11v5h-11z"),
    }
}

/// A cross for a run that stopped.
fn cross([x, y]: [f64; 2]) -> Markup {
    html! { path.cross d=(format!("M{x} {y}m-4 -4l8 8m0 -8l-8 8")) {} }
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
            order: Some(1.99),
            points: points(1.0 + style as f64).collect(),
            style,
            ..Curve::default()
        };
        Plot {
            title: "errors".into(),
            description: "of three levels".into(),
            axes: ["h", "error"],
            curves: vec![curve(0), curve(1)],
            slope: Some(2.0),
            floor: points(1.0).map(|[h, _]| [h, floor]).collect(),
            stopped: Vec::new(),
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
    fn a_logarithmic_axis_leaves_out_zero_and_infinity() {
        let texts = |plot: Plot| {
            let page = plot.svg("p").map_or(String::new(), |it| it.into_string());
            [page, plot.figure("caption", Width::Page), plot.figure("caption", Width::Column)]
        };
        for errors in [
            [0.0, 1e-3, f64::NAN],
            [0.0; 3],
            [1e308, 1e-308, 1e-3],
            [1e140, 1e-140, 1e-3],
            [1e-3, 1e-3, f64::INFINITY],
        ] {
            for floor in [0.0, 1e-4] {
                for text in texts(plot(errors, floor)) {
                    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
                }
            }
        }
        assert!(plot([0.0; 3], 0.0).svg("p").is_none());
    }

    /// All that a figure draws lies on its paper, at both widths, whatever its curves are called.
    #[test]
    fn a_figure_is_a_file_with_orders_in_its_legend() {
        for (width, millimetres) in [(Width::Page, "170mm"), (Width::Column, "85mm")] {
            let mut plot = plot([1e-2, 2.5e-3, 6.25e-4], 1e-16);
            plot.stopped = vec![0.5];
            let svg = plot.figure("bar <1d> & more", width);
            let document = roxmltree::Document::parse(&svg).expect("XML");
            let root = document.root_element();
            assert_eq!(root.attribute("width"), Some(millimetres));
            let size: Vec<f64> = root
                .attribute("viewBox")
                .expect("a size")
                .split(' ')
                .map(|it| it.parse().expect("a number"))
                .collect();
            for node in document.descendants() {
                let number = |name| node.attribute(name).and_then(|it| it.parse::<f64>().ok());
                for (names, most) in [(["x", "cx", "x2"], size[2]), (["y", "cy", "y2"], size[3])] {
                    for value in names.into_iter().filter_map(number) {
                        assert!((0.0..=most).contains(&value), "{value} of {most}: {node:?}");
                    }
                }
            }
            let texts: Vec<&str> = document.descendants().filter_map(|it| it.text()).collect();
            for text in ["bar <1d> & more", "curve 1, order 1.99", "slope 2", "stopped"] {
                assert!(texts.contains(&text), "{text}: {texts:?}");
            }
        }
    }
}
