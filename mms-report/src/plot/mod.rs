//! Curves over two logarithmic axes: on a page, whose style sheet colours them, or in a [`Figure`] for print.
//!
//! All views are one list of lines, marks and texts (`drawing`), which `svg` and `pdf` write. On a page the picture is as wide
//! as the text and its legend is below it; a figure is a file of its own, in millimetres. Marks and dashes distinguish the
//! curves without colours.

mod axis;
mod drawing;
mod figure;
mod helvetica;
mod pdf;
mod svg;

use maud::{Markup, html};

pub use axis::{short, steps};
pub use figure::{Figure, FileFormat, Width};

use axis::{Ticks, apart, labels, span, ticks, unit};
use drawing::{Anchor, Item, Role, TEXT, Text, Words, cross, mark};

/// The ratio of the least error to the round-off floor above which the floor is not drawn: it would compress the curves.
const FAR: f64 = 1e3;

/// The number of colours, each with its mark and its dashes.
pub const STYLES: usize = 6;

/// A picture.
#[derive(Clone, Default)]
pub struct Plot {
    /// The title, for readers who do not see the picture.
    pub title: String,
    /// The numbers of the picture in words.
    pub description: String,
    /// The text above the legend of a figure: the method, or the study.
    pub head: String,
    /// The quantities along the axes.
    pub axes: [Axis; 2],
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

/// The quantity along an axis.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Axis {
    /// The name of the quantity.
    pub name: String,
    /// The unit of the quantity, if one is known.
    pub unit: Option<String>,
}

impl Axis {
    /// A quantity of this unit, if one is known.
    pub fn of(name: impl Into<String>, unit: Option<&String>) -> Self {
        Axis { name: name.into(), unit: unit.cloned() }
    }

    /// The name with the unit in parentheses; a number has none.
    fn words(&self) -> Words {
        match self.unit.as_deref() {
            None | Some("1" | "") => Words::plain(&self.name),
            Some(own) => unit(Words::plain(format!("{} (", self.name)), own).and(")", false),
        }
    }
}

/// Points and how they are drawn.
#[derive(Clone, Default)]
pub struct Curve {
    /// The name of the curve in the legend.
    pub name: String,
    /// The observed order, which the legend of a figure adds.
    pub order: Option<f64>,
    /// Points in any order; a logarithmic axis leaves out 0 and infinity.
    pub points: Vec<[f64; 2]>,
    /// The colour, mark and dashes of the curve, below [`STYLES`].
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

impl Curve {
    /// Styles the curve: `number` modulo [`STYLES`] selects colour, mark and dashes. The first [`STYLES`] numbers have full marks,
    /// the next ones rings, and so on in turn.
    pub fn styled(self, number: usize) -> Self {
        Curve { style: number % STYLES, is_hollow: number / STYLES % 2 == 1, ..self }
    }

    fn mark(&self, centre: [f64; 2]) -> Item {
        mark(self.style % STYLES, self.is_hollow, centre)
    }

    /// A line in the look of the curve, if it has one.
    fn line(&self, points: Vec<[f64; 2]>) -> Option<Item> {
        match self.line {
            Line::None => None,
            Line::Solid => Some(Item::line(Role::Line(self.style % STYLES), points)),
            Line::Dashed => Some(Item::line(Role::Dashed, points)),
        }
    }

    fn drawn(&self, frame: &Frame) -> Vec<Item> {
        let points = self.points.iter().filter(is_shown).map(|it| frame.place(*it));
        let places: Vec<[f64; 2]> = points.collect();
        let mut items = Vec::new();
        items.extend(self.line(places.clone()).filter(|_| places.len() > 1));
        if self.line != Line::Dashed {
            items.extend(places.into_iter().map(|it| self.mark(it)));
        }
        items
    }

    /// The sign of the curve in a legend.
    fn sign(&self) -> Vec<Item> {
        let mut items = Vec::new();
        items.extend(self.line(vec![[1.0, 8.0], [27.0, 8.0]]));
        items.extend((self.line != Line::Dashed).then(|| self.mark([14.0, 8.0])));
        items
    }
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

/// The height reserved below a triangle for its label `1`, in pixels.
const BELOW_TRIANGLE: f64 = 17.0;

/// The positions of numbers on the picture.
struct Frame {
    x: (f64, f64),
    y: (f64, f64),
    area: Area,
}

impl Frame {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let along =
            |value: f64, (from, to): (f64, f64)| (value.ln() - from.ln()) / (to.ln() - from.ln());
        let Area { left, right, top, bottom } = self.area;
        [left + along(x, self.x) * (right - left), bottom + along(y, self.y) * (top - bottom)]
    }
}

/// A row of a legend: its sign, in a box of 28 by 16 pixels, and its text.
struct Entry {
    sign: Vec<Item>,
    words: Words,
}

impl Plot {
    /// Whether the floor is close enough to be drawn.
    pub fn shows_floor(&self) -> bool {
        let least = self.points().map(|[_, error]| error).fold(f64::INFINITY, f64::min);
        self.floor.iter().any(|[_, floor]| floor * FAR > least)
    }

    /// Whether no point has a place on the axes.
    pub fn is_empty(&self) -> bool {
        self.points().next().is_none()
    }

    /// Removes the head. The name of each curve then begins with the head or, if the plot had none, with the name of the file.
    pub fn named(mut self, file: &str) -> Self {
        let head = std::mem::take(&mut self.head);
        let of = if head.is_empty() { file } else { &head };
        self.curves.iter_mut().for_each(|it| it.name = format!("{of}: {}", it.name));
        self
    }

    /// Adds the curves of another plot over the same axes. The slope stays if both have it.
    pub fn add(&mut self, other: Plot) {
        self.description += &format!(" {}", other.description);
        for curve in other.curves {
            let number = self.curves.len();
            self.curves.push(curve.styled(number));
        }
        self.stopped.extend(other.stopped);
        self.slope = self.slope.filter(|_| self.slope == other.slope);
        // A floor belongs to one method.
        self.floor.clear();
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
        let (mut least, greatest) = span(all().map(|[_, y]| y), 1.8);
        if let Some([[_, base], ..]) = triangle {
            // The label `1` below the triangle must lie above the axis.
            let part = BELOW_TRIANGLE / (area.bottom - area.top);
            let lower = ((base.ln() - part * greatest.ln()) / (1.0 - part)).exp();
            least = least.min(lower).max(least.min(*SHOWN.start()));
        }
        Frame {
            x: span(all().map(|[x, _]| x).chain(self.stopped_shown()), 1.25),
            y: (least, greatest),
            area,
        }
    }

    fn stopped_shown(&self) -> impl Iterator<Item = f64> {
        self.stopped.iter().copied().filter(|it| SHOWN.contains(it))
    }

    /// The width of the widest number along the second axis.
    fn widest_number(&self) -> f64 {
        let y = self.frame(AREA_ON_PAGE).y;
        labels(&ticks(y).numbers).iter().map(Words::width).fold(0.0, f64::max)
    }

    /// The picture for a page; `None` if there is nothing to draw.
    pub fn svg(&self, id: &str) -> Option<Markup> {
        if self.is_empty() {
            return None;
        }
        let [width, height] = ON_PAGE;
        let [title, description] = [format!("{id}-title"), format!("{id}-text")];
        let drawn = self.drawn(&self.frame(AREA_ON_PAGE));
        Some(html! {
            svg viewBox=(format!("0 0 {width} {height}")) role="img" aria-labelledby=(format!("{title} {description}")) xmlns="http://www.w3.org/2000/svg" {
                title id=(title) { (self.title) }
                desc id=(description) { (self.description) }
                (svg::items(&drawn, true))
            }
            ul.legend {
                @for Entry { sign, words } in self.legend(false) {
                    li { svg.key viewBox="0 0 28 16" aria-hidden="true" xmlns="http://www.w3.org/2000/svg" { (svg::items(&sign, true)) } @for part in &words.0 { (part.text) } }
                }
            }
        })
    }

    /// Axes, floor, triangle, curves and marks of runs that stopped.
    fn drawn(&self, frame: &Frame) -> Vec<Item> {
        let mut items = self.mesh(frame);
        let place = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().map(|it| frame.place(*it)).collect()
        };
        let floor = self.floor_shown();
        items.extend((!floor.is_empty()).then(|| Item::line(Role::Dashed, place(&floor))));
        if let Some(corners) = self.triangle() {
            items.push(Item::shape(Role::Slope, place(&corners)));
            let [x, y] = frame.place([corners[1][0], (corners[1][1] * corners[2][1]).sqrt()]);
            let slope = Words::plain(self.slope.unwrap_or_default().to_string());
            items.push(Item::text([x + 4.0, y + 4.0], Anchor::Start, slope));
            let [x, y] = frame.place([(corners[0][0] * corners[1][0]).sqrt(), corners[0][1]]);
            items.push(Item::text([x, y + 12.0], Anchor::Middle, Words::plain("1")));
        }
        items.extend(self.curves.iter().flat_map(|curve| curve.drawn(frame)));
        let edge = frame.area.top + 7.0;
        items.extend(
            self.stopped_shown().flat_map(|at| cross([frame.place([at, frame.y.1])[0], edge])),
        );
        items
    }

    /// Axes, their numbers, and lines from these.
    fn mesh(&self, frame: &Frame) -> Vec<Item> {
        let Area { left, right, top, bottom } = frame.area;
        let x = match self.marks_points {
            true => {
                let points = self.points().map(|[x, _]| x).chain(self.stopped_shown());
                Ticks { numbers: apart(points, frame.x, right - left), strokes: Vec::new() }
            }
            false => ticks(frame.x),
        };
        let y = ticks(frame.y);
        let across = |value: f64| frame.place([value, frame.y.0])[0];
        let up = |value: f64| frame.place([frame.x.0, value])[1];
        let mut items = Vec::new();
        for (value, words) in x.numbers.iter().zip(labels(&x.numbers)) {
            let at = across(*value);
            items.push(Item::line(Role::Mesh, [[at, top], [at, bottom]]));
            items.push(Item::line(Role::Axes, [[at, bottom], [at, bottom + 4.0]]));
            items.push(Item::text([at, bottom + 17.0], Anchor::Middle, words));
        }
        for (value, words) in y.numbers.iter().zip(labels(&y.numbers)) {
            let at = up(*value);
            items.push(Item::line(Role::Mesh, [[left, at], [right, at]]));
            items.push(Item::line(Role::Axes, [[left - 4.0, at], [left, at]]));
            items.push(Item::text([left - 7.0, at + 4.0], Anchor::End, words));
        }
        for at in x.strokes.into_iter().map(across) {
            items.push(Item::line(Role::Axes, [[at, bottom], [at, bottom + 2.5]]));
        }
        for at in y.strokes.into_iter().map(up) {
            items.push(Item::line(Role::Axes, [[left - 2.5, at], [left, at]]));
        }
        items.push(Item::line(Role::Axes, [[left, top], [left, bottom], [right, bottom]]));
        let middle = (left + right) / 2.0;
        items.push(Item::text([middle, bottom + 36.0], Anchor::Middle, self.axes[0].words()));
        items.push(Item::Text(Text {
            at: [12.0, (top + bottom) / 2.0],
            anchor: Anchor::Middle,
            is_turned: true,
            is_bold: false,
            size: TEXT,
            words: self.axes[1].words(),
        }));
        items
    }

    /// The rows of the legend; with the observed orders in a figure.
    fn legend(&self, with_orders: bool) -> Vec<Entry> {
        let row = |sign: Vec<Item>, text: String| Entry { sign, words: Words::plain(text) };
        let mut entries: Vec<Entry> = self
            .curves
            .iter()
            .filter(|curve| curve.points.iter().any(|it| is_shown(&it)))
            .map(|curve| {
                let order = curve.order.filter(|_| with_orders);
                let order = order.map_or_else(String::new, |order| format!(", order {order:.2}"));
                let order = order.replace('-', "\u{2212}");
                row(curve.sign(), format!("{}{order}", curve.name))
            })
            .collect();
        entries.extend(self.slope.filter(|_| self.triangle().is_some()).map(|slope| {
            let triangle = Item::shape(Role::Slope, [[5.0, 13.0], [22.0, 13.0], [22.0, 4.0]]);
            row(vec![triangle], format!("slope {slope}"))
        }));
        let floor = || Item::line(Role::Dashed, [[1.0, 8.0], [27.0, 8.0]]);
        entries.extend(
            (!self.floor_shown().is_empty()).then(|| row(vec![floor()], "round-off floor".into())),
        );
        entries.extend(
            (!self.stopped.is_empty()).then(|| row(cross([14.0, 8.0]).into(), "stopped".into())),
        );
        entries
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
            order: Some(1.99),
            points: points(1.0 + style as f64).collect(),
            style,
            ..Curve::default()
        };
        Plot {
            title: "errors".into(),
            description: "of three levels".into(),
            head: "cpGIMP, leapfrog".into(),
            axes: [Axis::of("h", Some(&"m".into())), Axis::of("error", Some(&"Pa/m^2".into()))],
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
            let figure = Figure::new("caption".into(), vec![plot]);
            let file =
                |width| String::from_utf8_lossy(&figure.file(FileFormat::Svg, width)).into_owned();
            [page, file(Width::Page), file(Width::Column)]
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

    /// The numbers of a path, and the places of its points.
    fn places(node: roxmltree::Node<'_, '_>) -> Vec<[f64; 2]> {
        let number = |name| node.attribute(name).and_then(|it| it.parse::<f64>().ok());
        let own = number("x").zip(number("y")).or_else(|| number("cx").zip(number("cy")));
        let path = node.attribute("d").unwrap_or_default();
        let numbers: Vec<f64> = path
            .split(|c: char| !(c.is_ascii_digit() || ".-".contains(c)))
            .filter_map(|it| it.parse().ok())
            .collect();
        own.map(|(x, y)| [x, y]).into_iter().chain(numbers.as_chunks().0.iter().copied()).collect()
    }

    /// All that a figure draws lies on its paper, at both widths, with one panel and with three.
    #[test]
    fn a_figure_is_a_file_with_orders_in_its_legend() {
        for (width, wide, panels) in [
            (Width::Page, "170.00mm", 1),
            (Width::Column, "85.00mm", 1),
            (Width::Page, "170.00mm", 3),
            (Width::Column, "85.00mm", 3),
        ] {
            let mut plot = plot([1e-2, 2.5e-3, 6.25e-4], 1e-16);
            plot.stopped = vec![0.5];
            let title = "bar <1d> & more".to_owned();
            let figure = Figure::new(title, vec![plot; panels]);
            let svg = String::from_utf8(figure.file(FileFormat::Svg, width)).expect("text");
            let document = roxmltree::Document::parse(&svg).expect("XML");
            let root = document.root_element();
            assert_eq!(root.attribute("width"), Some(wide));
            let size: Vec<f64> = root
                .attribute("viewBox")
                .expect("a size")
                .split(' ')
                .map(|it| it.parse().expect("a number"))
                .collect();
            let mut count = 0;
            for node in document.descendants() {
                for [x, y] in places(node) {
                    assert!((0.0..=size[2]).contains(&x), "{x} of {}: {node:?}", size[2]);
                    assert!((0.0..=size[3]).contains(&y), "{y} of {}: {node:?}", size[3]);
                    count += 1;
                }
            }
            assert!(count > 60 * panels, "{count}");
            let texts: Vec<&str> = document.descendants().filter_map(|it| it.text()).collect();
            let head = if panels == 1 { "cpGIMP, leapfrog" } else { "(b) cpGIMP, leapfrog" };
            for text in [
                "bar <1d> & more",
                head,
                "curve 1, order 1.99",
                "slope 2",
                "stopped",
                "\u{2212}3",
                "error (Pa/m",
                "h (m)",
            ] {
                assert!(texts.contains(&text), "{text}: {texts:?}");
            }
        }
    }

    /// A PDF file has the operators of the same drawing, the fonts that each reader has, and no picture of pixels.
    #[test]
    fn a_pdf_file_has_lines_and_letters() {
        let plot = plot([1e-2, 2.5e-3, 6.25e-4], 1e-16);
        let figure = Figure::new("errors of \u{3c3}".into(), vec![plot]);
        let bytes = figure.file(FileFormat::Pdf, Width::Column);
        let text: String = bytes.iter().map(|it| char::from(*it)).collect();
        assert!(text.starts_with("%PDF-1.") && text.trim_end().ends_with("%%EOF"));
        assert!(text.contains("/Helvetica") && !text.contains("/XObject"));
        let width = 85.0 / 25.4 * 72.0;
        let found = text.split("/MediaBox [0 0 ").nth(1).and_then(|it| it.split(' ').next());
        let found: f64 = found.and_then(|it| it.parse().ok()).expect("a width");
        assert!((found - width).abs() < 1e-2, "{found}");
        for shown in ["(curve 1, order 1.99) Tj", "<9633> Tj", "(slope 2) Tj"] {
            assert!(text.contains(shown), "{shown}: {text}");
        }
        // One curve has a disc of four arcs at each of its three points, and in the legend.
        assert_eq!(text.matches(" c\n").count(), 4 * 4);
        // An entry of the table of places leads to its object.
        let table = text.split("startxref\n").nth(1).expect("a place");
        let table: usize = table.split_whitespace().next().unwrap().parse().expect("a number");
        assert!(bytes[table..].starts_with(b"xref"));
    }
}
