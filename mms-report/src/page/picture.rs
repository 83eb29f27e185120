//! Bodies in motion: shapes in a plane at several times, in one scale, coloured in eight steps.

use std::fmt::Write as _;

use maud::{Markup, html};

use crate::plot::{short, steps};

/// Steps of the colour scale.
pub const STEPS: usize = 8;

/// The width of a picture in its own units, which are whole numbers.
const WIDTH: f64 = 1000.0;

/// The width of a thumbnail.
const SMALL_WIDTH: f64 = 200.0;

/// The smallest size at which a body is drawn: a point has no size.
const SMALLEST: f64 = 1e-150;

/// A body at a time.
#[derive(Clone, PartialEq)]
pub struct Moment {
    /// The time.
    pub time: f64,
    /// The painted shapes, one over the other.
    pub shapes: Vec<PaintedShape>,
    /// Lines around it: its outline at rest.
    pub outline: Vec<Vec<[f64; 2]>>,
}

/// A polygon, or a dot if it has one corner.
#[derive(Clone, PartialEq)]
pub struct PaintedShape {
    /// The corners; coordinates are to the right and upwards.
    pub corners: Vec<[f64; 2]>,
    /// The colour, less than [`STEPS`].
    pub step: usize,
}

/// The meaning of the colours.
pub struct Scale {
    /// The quantity, with its unit where one is known.
    pub name: String,
    /// The value where the first colour begins, and the value where the last one ends.
    pub range: [f64; 2],
    /// Whether equal steps are equal factors.
    pub is_logarithmic: bool,
}

impl Scale {
    /// The colour of a value.
    pub fn step(&self, value: f64) -> usize {
        let [from, to] = self.range;
        let share = match self.is_logarithmic {
            true => (value / from).ln() / (to / from).ln(),
            false => (value - from) / (to - from),
        };
        ((share * STEPS as f64).max(0.0) as usize).min(STEPS - 1)
    }

    fn html(&self) -> Markup {
        let how = if self.is_logarithmic { ", in equal factors" } else { "" };
        html! {
            p.scale {
                (self.name) ": " (short(self.range[0])) " "
                svg viewBox="0 0 160 12" aria-hidden="true" xmlns="http://www.w3.org/2000/svg" {
                    @for step in 0..STEPS {
                        rect class=(format!("c{step}")) x=(20 * step) y="0" width="20" height="12" {}
                    }
                }
                " " (short(self.range[1])) (how)
            }
        }
    }
}

/// A point of a body on paper, to the right and upwards; a body in space is seen from X = Y = Z.
pub fn project(point: &[f64]) -> [f64; 2] {
    match *point {
        [x] => [x, 0.0],
        [x, y] => [x, y],
        [x, y, z, ..] => [(y - x) / 2f64.sqrt(), (2.0 * z - x - y) / 6f64.sqrt()],
        [] => [0.0; 2],
    }
}

/// The room for the numbers of axes, beside a picture and below it.
const MARGIN: [i64; 2] = [170, 110];

/// The map from the bounds of all moments to the bounds of a picture.
struct Window {
    /// The width of the picture in its own units.
    width: f64,
    /// The least and the greatest place to the right and upwards.
    bounds: [[f64; 2]; 2],
    left: f64,
    top: f64,
    scale: f64,
    height: f64,
}

impl Window {
    fn around(moments: &[Moment], width: f64) -> Self {
        let shapes = moments.iter().flat_map(|it| it.shapes.iter().map(|shape| &shape.corners));
        let points = shapes.chain(moments.iter().flat_map(|it| &it.outline)).flatten();
        let (mut least, mut greatest) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for axis in 0..2 {
                least[axis] = least[axis].min(point[axis]);
                greatest[axis] = greatest[axis].max(point[axis]);
            }
        }
        let size = [greatest[0] - least[0], greatest[1] - least[1]];
        let longest = size[0].max(size[1]).max(SMALLEST);
        let margin = 0.03 * longest;
        let scale = width / (size[0].max(0.2 * longest) + 2.0 * margin);
        Self {
            width,
            bounds: [0, 1].map(|axis| [least[axis], greatest[axis]]),
            left: least[0] - margin,
            top: greatest[1] + margin,
            scale,
            height: ((size[1] + 2.0 * margin) * scale).ceil(),
        }
    }

    fn place(&self, [x, y]: [f64; 2]) -> [i64; 2] {
        [
            ((x - self.left) * self.scale).round() as i64,
            ((self.top - y) * self.scale).round() as i64,
        ]
    }

    /// Axes with numbers, below the picture and, if there are two, beside it.
    fn axes(&self, names: &[String]) -> Markup {
        let height = self.height as i64;
        let [[left, right], [bottom, top]] = self.bounds;
        let across = |x: f64| self.place([x, bottom])[0];
        let up = |y: f64| self.place([left, y])[1];
        html! {
            @if let Some(name) = names.first() {
                path.axis d=(format!("M0 {height}H{}", self.width)) {}
                @for value in steps([left, right]) {
                    @let x = across(value);
                    path.axis d=(format!("M{x} {height}v14")) {}
                    text x=(x) y=(height + 50) text-anchor="middle" { (short(value)) }
                }
                text x=(self.width / 2.0) y=(height + 96) text-anchor="middle" { (name) }
            }
            @if let Some(name) = names.get(1) {
                path.axis d=(format!("M0 0V{height}")) {}
                @for value in steps([bottom, top]) {
                    @let y = up(value);
                    path.axis d=(format!("M0 {y}h-14")) {}
                    text x="-22" y=(y + 12) text-anchor="end" { (short(value)) }
                }
                @let middle = height / 2;
                text x="-136" y=(middle) text-anchor="middle" transform=(format!("rotate(-90 -136 {middle})")) { (name) }
            }
        }
    }

    /// A line through points, its steps relative to the point before.
    fn line(&self, points: &[[f64; 2]], path: &mut String) {
        let mut before = [0; 2];
        for (at, point) in points.iter().enumerate() {
            let [x, y] = self.place(*point);
            let _ = match at {
                0 => write!(path, "M{x} {y}l"),
                _ => write!(path, "{} {} ", x - before[0], y - before[1]),
            };
            before = [x, y];
        }
    }
}

/// The pictures of some moments side by side, and the meaning of their colours. `dot` is the size of dots, in the units of the
/// points; `axes` are the names to the right and upwards, or none.
pub fn pictures(
    id: &str,
    of: &str,
    moments: &[Moment],
    scale: &Scale,
    dot: f64,
    axes: &[String],
) -> Markup {
    let window = Window::around(moments, WIDTH);
    let is_flat = window.height < 0.25 * WIDTH;
    let dot = (dot * window.scale).round().max(4.0) as i64;
    let [beside, below] = [1, 0].map(|axis| if axes.len() > axis { MARGIN[1 - axis] } else { 0 });
    let [wide, high] = [WIDTH as i64 + beside, window.height as i64 + below];
    html! {
        div class=(if is_flat { "moments flat" } else { "moments" }) {
            @for (number, moment) in moments.iter().enumerate() {
                @let label = format!("{id}-{number}");
                div {
                    svg viewBox=(format!("{} 0 {wide} {high}", -beside)) role="img" aria-labelledby=(label) xmlns="http://www.w3.org/2000/svg" {
                        title id=(label) { (of) " at t = " (short(moment.time)) }
                        (shapes(moment, &window, dot))
                        (window.axes(axes))
                        @if !moment.outline.is_empty() {
                            @let mut path = String::new();
                            @for line in &moment.outline { @let () = window.line(line, &mut path); }
                            path.rest d=(path.trim_end()) {}
                        }
                    }
                    p aria-hidden="true" { "t = " (short(moment.time)) }
                }
            }
        }
        (scale.html())
    }
}

/// A moment without axes and scale, as small as a word.
pub fn thumbnail(of: &str, moment: &Moment) -> Markup {
    let window = Window::around(std::slice::from_ref(moment), SMALL_WIDTH);
    html! {
        svg.thumbnail viewBox=(format!("0 0 {} {}", window.width, window.height)) role="img" aria-label=(of) xmlns="http://www.w3.org/2000/svg" {
            (shapes(moment, &window, 1))
        }
    }
}

/// Shapes in their order; neighbours of one colour share an element.
fn shapes(moment: &Moment, window: &Window, dot: i64) -> Markup {
    html! {
        @for group in moment.shapes.chunk_by(|a, b| a.step == b.step) {
            @let mut path = String::new();
            @for shape in group { @let () = draw(shape, window, dot, &mut path); }
            path class=(format!("c{}", group[0].step)) d=(path) {}
        }
    }
}

fn draw(shape: &PaintedShape, window: &Window, dot: i64, path: &mut String) {
    if let [point] = shape.corners[..] {
        let [x, y] = window.place(point);
        let _ = write!(path, "M{} {}h{dot}v{dot}h-{dot}z", x - dot / 2, y - dot / 2);
        return;
    }
    window.line(&shape.corners, path);
    path.truncate(path.trim_end().len());
    path.push('z');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_part_their_range_evenly() {
        let range = [1e-8, 1.0];
        let linear = Scale { name: String::new(), range: [0.0, 8.0], is_logarithmic: false };
        let logarithmic = Scale { name: String::new(), range, is_logarithmic: true };
        for step in 0..STEPS {
            assert_eq!(linear.step(step as f64 + 0.5), step);
            assert_eq!(logarithmic.step(3.0 * 10f64.powi(step as i32 - 8)), step);
        }
        assert_eq!([linear.step(-1.0), linear.step(9.0), logarithmic.step(0.0)], [0, 7, 0]);
    }

    #[test]
    fn a_body_in_space_is_seen_upright_and_from_the_front() {
        let [right, up] = project(&[0.0, 0.0, 1.0]);
        assert!(right == 0.0 && up > 0.0);
        assert!(project(&[0.0, 1.0, 0.0])[0] > 0.0 && project(&[1.0, 0.0, 0.0])[0] < 0.0);
    }

    #[test]
    fn axes_have_round_numbers_at_their_places() {
        let corners = vec![[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]];
        let shapes = vec![PaintedShape { corners, step: 0 }];
        let moment = Moment { time: 0.0, shapes, outline: Vec::new() };
        let scale = Scale { name: "error (mm)".into(), range: [0.0, 1.0], is_logarithmic: false };
        let names = ["X (mm)".to_owned(), "Y (mm)".to_owned()];
        let drawn = |axes: &[String]| {
            pictures("id", "it", std::slice::from_ref(&moment), &scale, 0.0, axes).into_string()
        };
        let page = format!("<div>{}</div>", drawn(&names));
        let document = roxmltree::Document::parse(&page).expect("XML");
        let texts = document.descendants().filter(|it| it.has_tag_name("text"));
        let found: Vec<(&str, f64)> = texts
            .map(|it| {
                let place = if it.attribute("text-anchor") == Some("end") { "y" } else { "x" };
                let at = it.attribute(place).and_then(|at| at.parse().ok()).expect("a place");
                (it.text().expect("a text"), at)
            })
            .collect();
        let names: Vec<&str> = found.iter().map(|it| it.0).collect();
        assert_eq!(
            names,
            [
                "0", "0.05", "0.1", "0.15", "0.2", "X (mm)", "0", "0.02", "0.04", "0.06", "0.08",
                "0.1", "Y (mm)"
            ]
        );
        // Equal lengths are drawn equally long along both axes.
        assert!(
            (found[4].1 - found[0].1 - 2.0 * (found[6].1 - found[11].1)).abs() <= 2.0,
            "{found:?}"
        );
        assert!(!drawn(&[]).contains("<text"));
    }

    #[test]
    fn all_moments_have_one_scale_and_stay_inside() {
        let square = |size: f64| Moment {
            time: size,
            shapes: vec![PaintedShape {
                corners: vec![[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]],
                step: 3,
            }],
            outline: Vec::new(),
        };
        let window = Window::around(&[square(1.0), square(2.0)], WIDTH);
        let corners = [window.place([0.0, 0.0]), window.place([2.0, 2.0])];
        assert!(corners.iter().flatten().all(|it| (0..=1000).contains(it)), "{corners:?}");
        assert!(corners[0][1] > corners[1][1], "upwards is upwards");
    }
}
