//! The motion that a field prescribes: its body with a grid on it at some times, coloured by the displacement of each place.

use std::f64::consts::TAU;

use dashu_ratio::RBig;
use maud::{Markup, html};
use mms_codegen::Compiled;
use mms_mechanics::Output;
use mms_mechanics::extent::Extent;
use mms_mechanics::sample::domain;
use mms_program::interpret::{Interpreter, Point};
use mms_runtime::math::coordinates::{Numbers, System};
use mms_runtime::math::polygon;
use mms_spec::quantity::Quantity;
use mms_symbolic::sorted::SortedMap;

use super::picture::{Moment, PaintedShape, Scale, pictures, project, thumbnail};
use crate::plot::short;

/// Times of a picture, from the first to the last of the window.
const MOMENTS: usize = 6;

/// The share of the size of the body below which displacements are drawn larger.
const SMALL: f64 = 0.05;

/// The motion of a field.
pub struct Motion {
    moments: Vec<Moment>,
    scale: Scale,
    /// The factor by which displacements are multiplied.
    factor: f64,
    is_static: bool,
}

/// A cell of the grid: the reference positions of its corners, in order.
type Cell = Vec<Vec<f64>>;

impl Motion {
    /// The motion of a field with some parameters set; `None` if u is not finite.
    pub fn of(compiled: &Compiled, set: &SortedMap<usize, RBig>) -> Option<Self> {
        let parameters = compiled.parameters::<f64>(set);
        let mut interpreter = Interpreter::new(&compiled.program, &parameters);
        let (body, time) = domain(&compiled.program, &parameters);
        let cells = cells(&body);
        if cells.is_empty() {
            // Without a body there is nothing to draw.
            return None;
        }
        let output = Output::Quantity(Quantity::Displacement);
        let mut moved = Vec::new();
        for moment in 0..MOMENTS {
            let time = time[0] + (time[1] - time[0]) * moment as f64 / (MOMENTS - 1) as f64;
            interpreter.set_time(&time);
            let plan = interpreter.plan(&[output]);
            let mut at = |place: &Vec<f64>| {
                interpreter.set_point(&plan, Point::at(place));
                interpreter.output(output)
            };
            let cells: Vec<Vec<Vec<f64>>> =
                cells.iter().map(|cell| cell.iter().map(&mut at).collect()).collect();
            moved.push((time, cells));
        }
        let all = || moved.iter().flat_map(|(_, cells)| cells.iter().flatten());
        if !all().flatten().all(|it| it.is_finite()) {
            return None;
        }
        let largest = all().map(|u| length(u)).fold(0.0, f64::max);
        let factor = magnification(largest / size(&cells));
        let scale = Scale { name: "|u|".into(), range: [0.0, largest], is_logarithmic: false };
        let mut moments: Vec<_> = moved
            .iter()
            .map(|(time, moved)| Moment {
                time: *time,
                shapes: shapes(&cells, moved, factor, &scale),
                outline: outline(&cells),
            })
            .collect();
        let is_static = moments.iter().all(|moment| moment.shapes == moments[0].shapes);
        if is_static {
            moments.truncate(1);
        }
        Some(Self { moments, scale, factor, is_static })
    }

    /// The body at its largest displacement.
    pub fn thumbnail(&self, name: &str) -> Markup {
        let moved = |it: &&Moment| it.shapes.iter().map(|shape| shape.step).sum::<usize>();
        let farthest = self.moments.iter().max_by_key(moved);
        html! { @if let Some(it) = farthest { (thumbnail(&format!("The body of {name}, deformed"), it)) } }
    }

    /// The pictures, with their captions.
    pub fn html(&self, id: &str, name: &str) -> Markup {
        html! {
            figure {
                (pictures(id, &format!("The body of {name}"), &self.moments, &self.scale, 0.0, &[]))
                figcaption {
                    "The motion that the field prescribes, exact and not of a run: a grid on the body, "
                    @if self.is_static { "which is at rest," } @else { "at six times of its window," }
                    " coloured by the size of the displacement."
                    @if self.factor != 1.0 { " Displacements are drawn " (short(self.factor)) " times as large." }
                    @if self.moments.iter().any(|it| !it.outline.is_empty()) { " Dashed: the reference body." }
                }
            }
        }
    }
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|it| it * it).sum::<f64>().sqrt()
}

/// The longest edge of the box around all cells.
fn size(cells: &[Cell]) -> f64 {
    let extent = |axis: usize| {
        let along = || cells.iter().flatten().map(|place| place[axis]);
        along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
    };
    (0..cells[0][0].len()).map(extent).fold(0.0, f64::max)
}

/// 1, or a round number that makes a small displacement visible.
fn magnification(ratio: f64) -> f64 {
    if ratio >= SMALL || ratio == 0.0 {
        return 1.0;
    }
    let wanted = 0.1 / ratio;
    let decade = 10f64.powf(wanted.log10().floor());
    decade * [5.0, 2.0, 1.0].into_iter().find(|digit| digit * decade <= wanted).unwrap_or(1.0)
}

/// `count` equal parts of a range, as their ends.
fn parts(from: f64, to: f64, count: usize) -> impl Iterator<Item = [f64; 2]> + Clone {
    let at = move |part: usize| from + (to - from) * part as f64 / count as f64;
    (0..count).map(move |part| [at(part), at(part + 1)])
}

/// The number of cells along an edge, such that the longest edge has `most`.
fn divisions(edge: f64, longest: f64, most: usize) -> usize {
    ((edge / longest * most as f64).round() as usize).max(2)
}

fn cells(body: &Extent<f64>) -> Vec<Cell> {
    match body {
        Extent::Block(block) if block.system == System::Cartesian => of_box(&block.bounds),
        Extent::Block(block) => {
            let parts_along = |axis: usize| {
                let [from, to] = block.bounds[axis];
                let count = match block.system.is_angle(axis) {
                    true => ((32.0 * (to - from) / TAU).round() as usize).max(8),
                    false => 4,
                };
                parts(from, to, count)
            };
            let place = |at: [f64; 3]| -> Vec<f64> {
                let place = block.system.position(&mut Numbers::new(), &at);
                place[..block.bounds.len()].to_vec()
            };
            if block.bounds.len() == 2 {
                return quads(parts_along(0), parts_along(1))
                    .map(|quad| quad.map(|[radius, angle]| place([radius, angle, 0.0])).into())
                    .collect();
            }
            // Radius, theta and phi are left-handed, so that seen from outside they run the other way.
            let is_mirrored = block.system == System::Spherical;
            let along = |axis: usize| faces(axis, block.bounds[axis], parts_along);
            let all = (0..3).flat_map(along).map(|cell| {
                let corners = cell.iter().map(|at| place([at[0], at[1], at[2]]));
                if is_mirrored { corners.rev().collect() } else { corners.collect() }
            });
            // Cells that are points or lines are left out, as at an inner radius of 0.
            all.filter(|cell: &Cell| spread(cell) > 0.0).collect()
        }
        Extent::Polygon(vertices) => {
            let quads = polygon::quadrilaterals(vertices).into_iter();
            quads
                .map(|quad| {
                    let mut cell: Cell = quad.corners.map(Vec::from).into();
                    if polygon::area(&quad.corners) < 0.0 {
                        cell.reverse();
                    }
                    cell
                })
                .collect()
        }
        Extent::Nothing(_) => Vec::new(),
    }
}

/// The least extent of the diagonals of a cell.
fn spread(cell: &[Vec<f64>]) -> f64 {
    let between = |a: usize, b: usize| {
        cell[a].iter().zip(&cell[b]).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
    };
    between(0, 2).min(between(1, 3))
}

fn of_box(bounds: &[[f64; 2]]) -> Vec<Cell> {
    let edges: Vec<f64> = bounds.iter().map(|[from, to]| to - from).collect();
    let longest = edges.iter().copied().fold(0.0, f64::max);
    let along = |axis: usize, most: usize| {
        let [from, to] = bounds[axis];
        parts(from, to, divisions(edges[axis], longest, most))
    };
    match edges.len() {
        1 => along(0, 24).map(|[a, b]| vec![vec![a], vec![b]]).collect(),
        2 => quads(along(0, 10), along(1, 10)).map(|quad| quad.map(Vec::from).into()).collect(),
        _ => (0..3).flat_map(|axis| faces(axis, bounds[axis], |axis| along(axis, 6))).collect(),
    }
}

/// Rectangles, their corners counter-clockwise.
fn quads<P: Iterator<Item = [f64; 2]> + Clone>(
    first: P,
    second: P,
) -> impl Iterator<Item = [[f64; 2]; 4]> {
    first.flat_map(move |[a, b]| second.clone().map(move |[c, d]| [[a, c], [b, c], [b, d], [a, d]]))
}

/// The two faces of a box across an axis; seen from outside, corners are counter-clockwise.
fn faces<P: Iterator<Item = [f64; 2]> + Clone>(
    axis: usize,
    ends: [f64; 2],
    along: impl Fn(usize) -> P,
) -> Vec<Cell> {
    let [second, third] = [(axis + 1) % 3, (axis + 2) % 3];
    let place = |end: f64, [a, b]: [f64; 2]| {
        let mut place = vec![0.0; 3];
        [place[axis], place[second], place[third]] = [end, a, b];
        place
    };
    let of = |end: usize| {
        let cells = quads(along(second), along(third));
        cells.map(move |quad| {
            let mut cell: Cell = quad.map(|corner| place(ends[end], corner)).into();
            if end == 0 {
                cell.reverse();
            }
            cell
        })
    };
    of(0).chain(of(1)).collect()
}

/// The displaced cells, on paper. For a body in space, the cells that face the viewer, the farthest first.
fn shapes(
    cells: &[Cell],
    moved: &[Vec<Vec<f64>>],
    factor: f64,
    scale: &Scale,
) -> Vec<PaintedShape> {
    let height = 0.06 * size(cells);
    let mut shapes = Vec::new();
    for (cell, moved) in cells.iter().zip(moved) {
        let mean = moved.iter().map(|u| length(u)).sum::<f64>() / moved.len() as f64;
        let places: Vec<Vec<f64>> = cell
            .iter()
            .zip(moved)
            .map(|(place, u)| place.iter().zip(u).map(|(x, u)| x + factor * u).collect())
            .collect();
        let depth: f64 = places.iter().flatten().sum();
        let mut corners: Vec<_> = places.iter().map(|place| project(place)).collect();
        if let [[a, _], [b, _]] = corners[..] {
            corners = vec![[a, 0.0], [b, 0.0], [b, height], [a, height]];
        }
        if places[0].len() < 3 || area(&corners) > 0.0 {
            shapes.push((depth, PaintedShape { corners, step: scale.step(mean) }));
        }
    }
    if cells[0][0].len() == 3 {
        shapes.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    }
    shapes.into_iter().map(|(_, shape)| shape).collect()
}

/// Positive, if the corners are counter-clockwise.
fn area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0
}

/// The edges of plane cells that no other cell has, as they are at rest.
fn outline(cells: &[Cell]) -> Vec<Vec<[f64; 2]>> {
    if cells[0][0].len() != 2 {
        return Vec::new();
    }
    // Where an annulus closes, equal points differ by rounding.
    let unit = 1e-9 * size(cells);
    let key = |place: &[f64]| [(place[0] / unit).round() as i64, (place[1] / unit).round() as i64];
    let edges = || cells.iter().flat_map(|cell| cell.iter().zip(cell.iter().cycle().skip(1)));
    let mut seen = SortedMap::<_, usize>::new();
    for (a, b) in edges() {
        let (a, b) = (key(a), key(b));
        *seen.get_or_default((a.min(b), a.max(b))) += 1;
    }
    let is_outside = |(a, b): &(&Vec<f64>, &Vec<f64>)| {
        let (a, b) = (key(a), key(b));
        seen[&(a.min(b), a.max(b))] == 1
    };
    edges().filter(is_outside).map(|(a, b)| vec![project(a), project(b)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mms_exact::gallery;

    #[test]
    fn small_displacements_are_magnified_by_round_numbers() {
        assert_eq!([0.3, 0.05, 0.0].map(magnification), [1.0; 3]);
        assert_eq!([0.04, 1e-2, 3e-4].map(magnification), [2.0, 10.0, 200.0]);
    }

    #[test]
    fn bodies_of_every_dimension_have_their_pictures() {
        for name in ["bar_1d", "expanding_ring", "twisted_column"] {
            let compiled = gallery::find(name).unwrap().compile().unwrap();
            let motion = Motion::of(&compiled, &SortedMap::new()).expect("a finite motion");
            assert_eq!(motion.moments.len(), MOMENTS, "{name}");
            assert!(motion.scale.range[1] > 0.0, "{name}");
        }
    }

    #[test]
    fn three_faces_of_a_box_are_seen() {
        let unit = |axis: usize| faces(axis, [0.0, 1.0], |_| parts(0.0, 1.0, 2));
        let cells: Vec<_> = (0..3).flat_map(unit).collect();
        let rest: Vec<_> = cells.iter().map(|cell| vec![vec![0.0; 3]; cell.len()]).collect();
        let scale = Scale { name: String::new(), range: [0.0, 1.0], is_logarithmic: false };
        assert_eq!(cells.len(), 24);
        assert_eq!(shapes(&cells, &rest, 1.0, &scale).len(), 12);
    }
}
