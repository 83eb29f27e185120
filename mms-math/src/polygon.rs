//! Polygons in the plane: tests for crossing edges, triangles, and distances of points.

use std::vec;
use std::vec::Vec;

/// A vertex.
pub type Vertex = [f64; 2];

/// The reason why vertices make no polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Two vertices, with these indices, are the same point.
    Repeated(usize, usize),
    /// Two edges, each named by the index of its first vertex, have a point in common that is no vertex of both.
    Crossing(usize, usize),
}

/// Twice the area of a triangle, positive if its corners are counter-clockwise.
fn doubled([a, b, c]: [Vertex; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// The area, positive if the vertices are counter-clockwise.
pub fn area(vertices: &[Vertex]) -> f64 {
    let Some(first) = vertices.first() else { return 0.0 };
    vertices.windows(2).map(|pair| doubled([*first, pair[0], pair[1]])).sum::<f64>() / 2.0
}

/// The ends of an edge, named by the index of its first vertex.
pub fn edge(vertices: &[Vertex], first: usize) -> [Vertex; 2] {
    [vertices[first], vertices[(first + 1) % vertices.len()]]
}

/// The first reason why vertices make no polygon; `None` if its edges meet in its vertices only.
pub fn mistake(vertices: &[Vertex]) -> Option<Mistake> {
    let count = vertices.len();
    let pairs = || (0..count).flat_map(|second| (0..second).map(move |first| (first, second)));
    if let Some((first, second)) = pairs().find(|(a, b)| vertices[*a] == vertices[*b]) {
        return Some(Mistake::Repeated(first, second));
    }
    let meet = |(first, second): &(usize, usize)| {
        let [a, b] = edge(vertices, *first);
        let [c, d] = edge(vertices, *second);
        let is_next = |first: usize, second: usize| (first + 1) % count == second;
        // Neighbours share a vertex; one must not fold back onto the other.
        match (is_next(*first, *second), is_next(*second, *first)) {
            (true, _) => is_on([a, b], d) || is_on([c, d], a),
            (_, true) => is_on([c, d], b) || is_on([a, b], c),
            _ => crosses([a, b], [c, d]),
        }
    };
    pairs().find(meet).map(|(first, second)| Mistake::Crossing(first, second))
}

fn is_on([a, b]: [Vertex; 2], point: Vertex) -> bool {
    let within = |k: usize| (a[k].min(b[k])..=a[k].max(b[k])).contains(&point[k]);
    doubled([a, b, point]) == 0.0 && within(0) && within(1)
}

fn crosses([a, b]: [Vertex; 2], [c, d]: [Vertex; 2]) -> bool {
    let opposite = |x: f64, y: f64| (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0);
    let beside = |line: [Vertex; 2], point: Vertex| doubled([line[0], line[1], point]);
    (opposite(beside([a, b], c), beside([a, b], d))
        && opposite(beside([c, d], a), beside([c, d], b)))
        || [c, d].into_iter().any(|end| is_on([a, b], end))
        || [a, b].into_iter().any(|end| is_on([c, d], end))
}

/// Triangles that fill a polygon without overlap, by the indices of their vertices: ears are cut off one by one (Meisters, Am.
/// Math. Mon. 82 (1975) 648-651). For two polygons with the same number of vertices, the triangles of one cover the other too,
/// since their signed areas add up to a winding number of 1 inside.
pub fn triangles(vertices: &[Vertex]) -> Vec<[usize; 3]> {
    let sign = area(vertices).signum();
    let (mut left, mut found): (Vec<usize>, _) = ((0..vertices.len()).collect(), Vec::new());
    while left.len() > 3 {
        let count = left.len();
        let ear = |at: usize| [left[(at + count - 1) % count], left[at], left[(at + 1) % count]];
        let turn = |ear: [usize; 3]| sign * doubled(ear.map(|corner| vertices[corner]));
        let is_whole = |at: &usize| {
            let ear = ear(*at);
            let corners = ear.map(|corner| vertices[corner]);
            let others = left.iter().filter(|other| !ear.contains(other));
            turn(ear) > 0.0 && !others.map(|it| vertices[*it]).any(|it| holds(corners, sign, it))
        };
        // The most compact of the ears that may be cut, so that no needle remains; due to rounding there may be none.
        let shape = |at: &usize| compactness(ear(*at).map(|corner| vertices[corner]));
        let best = (0..count).filter(is_whole).max_by(|a, b| shape(a).total_cmp(&shape(b)));
        let flattest =
            || (0..count).min_by(|a, b| turn(ear(*a)).abs().total_cmp(&turn(ear(*b)).abs()));
        let Some(at) = best.or_else(flattest) else { break };
        found.push(ear(at));
        left.remove(at);
    }
    if let [a, b, c] = left[..] {
        found.push([a, b, c]);
    }
    found
}

/// Whether a closed triangle of that orientation contains a point.
fn holds([a, b, c]: [Vertex; 3], sign: f64, point: Vertex) -> bool {
    [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| sign * doubled([from, to, point]) >= 0.0)
}

/// The area of a triangle over the area of the square on its longest side.
fn compactness(corners: [Vertex; 3]) -> f64 {
    let [a, b, c] = corners;
    let squared = |a: Vertex, b: Vertex| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    doubled(corners).abs() / squared(a, b).max(squared(b, c)).max(squared(c, a))
}

/// Whether a point lies inside: an odd number of edges is on its right.
pub fn contains(vertices: &[Vertex], [x, y]: Vertex) -> bool {
    let on_right = |first: &usize| {
        let [a, b] = edge(vertices, *first);
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    (0..vertices.len()).filter(on_right).count() % 2 == 1
}

/// The point of an edge that is nearest to a point, and the distance.
pub fn nearest([a, b]: [Vertex; 2], point: Vertex) -> (Vertex, f64) {
    let along = [b[0] - a[0], b[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / square;
    let part = part.clamp(0.0, 1.0);
    let foot = [a[0] + part * along[0], a[1] + part * along[1]];
    (foot, (point[0] - foot[0]).hypot(point[1] - foot[1]))
}

/// The outward unit normal of an edge, for both orientations of the vertices.
pub fn normal(vertices: &[Vertex], first: usize) -> Vertex {
    let [a, b] = edge(vertices, first);
    let length = (b[0] - a[0]).hypot(b[1] - a[1]) * area(vertices).signum();
    [(b[1] - a[1]) / length, (a[0] - b[0]) / length]
}

/// The quadrilaterals of a polygon, three from each of its triangles: a corner, the middles of its two sides, and the centroid.
/// The first and the last of their sides may lie on edges of the polygon.
pub fn quadrilaterals(vertices: &[Vertex]) -> Vec<Quadrilateral> {
    let count = vertices.len();
    let middle = |a: Vertex, b: Vertex| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    // The edge of the polygon between two consecutive vertices.
    let between = |a: usize, b: usize| match () {
        () if (a + 1) % count == b => Some(a),
        () if (b + 1) % count == a => Some(b),
        () => None,
    };
    let mut found = Vec::new();
    for triangle in triangles(vertices) {
        let corners = triangle.map(|corner| vertices[corner]);
        if doubled(corners) == 0.0 {
            continue;
        }
        let [a, b, c] = corners;
        let centre = [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0];
        for at in 0..3 {
            let [own, next, last] = [at, (at + 1) % 3, (at + 2) % 3];
            let ends = [middle(corners[own], corners[next]), middle(corners[own], corners[last])];
            found.push(Quadrilateral {
                corners: [corners[own], ends[0], centre, ends[1]],
                edges: [
                    between(triangle[own], triangle[next]),
                    between(triangle[own], triangle[last]),
                ],
            });
        }
    }
    found
}

/// A quadrilateral, part of a polygon.
#[derive(Clone, Copy, Debug)]
pub struct Quadrilateral {
    /// The corners in their order.
    pub corners: [Vertex; 4],
    /// The edge of the polygon that the side between the first and the second corner lies on, and the edge that the side
    /// between the first and the last corner lies on, if any.
    pub edges: [Option<usize>; 2],
}

impl Quadrilateral {
    /// The point at fractions of the way from the first corner to the second, and to the last.
    pub fn point(&self, [s, t]: [f64; 2]) -> Vertex {
        let [a, b, c, d] = self.corners;
        core::array::from_fn(|k| {
            (1.0 - s) * (1.0 - t) * a[k]
                + s * (1.0 - t) * b[k]
                + s * t * c[k]
                + (1.0 - s) * t * d[k]
        })
    }

    /// The derivatives of the point by each fraction.
    pub fn slopes(&self, [s, t]: [f64; 2]) -> [Vertex; 2] {
        let [a, b, c, d] = self.corners;
        [
            core::array::from_fn(|k| (1.0 - t) * (b[k] - a[k]) + t * (c[k] - d[k])),
            core::array::from_fn(|k| (1.0 - s) * (d[k] - a[k]) + s * (c[k] - b[k])),
        ]
    }

    /// The mean lengths of the sides in both directions.
    pub fn lengths(&self) -> [f64; 2] {
        let [a, b, c, d] = self.corners;
        let length = |a: Vertex, b: Vertex| (a[0] - b[0]).hypot(a[1] - b[1]);
        [(length(a, b) + length(d, c)) / 2.0, (length(a, d) + length(b, c)) / 2.0]
    }
}

/// Pads the triangles to a power of two, with copies of the last one.
pub fn padded(mut triangles: Vec<[usize; 3]>) -> Vec<[usize; 3]> {
    let last = triangles.last().copied();
    let missing = triangles.len().next_power_of_two() - triangles.len();
    triangles.extend(last.into_iter().flat_map(|last| vec![last; missing]));
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLE: [Vertex; 6] =
        [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];

    fn reversed(vertices: &[Vertex]) -> Vec<Vertex> {
        vertices.iter().rev().copied().collect()
    }

    #[test]
    fn triangles_and_quadrilaterals_fill_polygons() {
        let comb: Vec<Vertex> =
            (0..12).map(|k| [f64::from(k), if k % 2 == 0 { 0.25 } else { 3.0 }]).collect();
        let comb: Vec<Vertex> = [[12.0, -1.0], [-1.0, -1.0]].into_iter().chain(comb).collect();
        let with_middles = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0]];
        for vertices in [ANGLE.to_vec(), reversed(&ANGLE), comb.clone(), with_middles] {
            assert_eq!(mistake(&vertices), None);
            let triangles = triangles(&vertices);
            assert_eq!(triangles.len(), vertices.len() - 2);
            let corners = |it: &[usize; 3]| it.map(|corner| vertices[corner]);
            let sum: f64 = triangles.iter().map(|it| doubled(corners(it)).abs() / 2.0).sum();
            assert!((sum - area(&vertices).abs()).abs() < 1e-12, "{vertices:?}");
            for triangle in &triangles {
                let [a, b, c] = corners(triangle);
                let centre = [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0];
                assert!(contains(&vertices, centre), "{vertices:?}, {triangle:?}");
            }
            let quads = quadrilaterals(&vertices);
            let sum: f64 = quads.iter().map(|it| area(&it.corners).abs()).sum();
            assert!((sum - area(&vertices).abs()).abs() < 1e-12, "{vertices:?}");
            // Each edge has two sides on it.
            let sides: Vec<usize> = quads.iter().flat_map(|it| it.edges).flatten().collect();
            let twice = |edge: usize| sides.iter().filter(|side| **side == edge).count() == 2;
            assert!((0..vertices.len()).all(twice), "{sides:?}");
        }
    }

    #[test]
    fn normals_look_outward_whichever_way_the_vertices_run() {
        for vertices in [ANGLE.to_vec(), reversed(&ANGLE)] {
            for first in 0..vertices.len() {
                let [a, b] = edge(&vertices, first);
                let normal = normal(&vertices, first);
                let at = |k: usize, side: f64| (a[k] + b[k]) / 2.0 + side * 1e-3 * normal[k];
                assert!(contains(&vertices, [at(0, -1.0), at(1, -1.0)]));
                assert!(!contains(&vertices, [at(0, 1.0), at(1, 1.0)]));
            }
        }
    }

    #[test]
    fn edges_that_cross_touch_or_fold_back_are_found() {
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(mistake(&bow), Some(Mistake::Crossing(0, 2)));
        let twice = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]];
        assert_eq!(mistake(&twice), Some(Mistake::Repeated(0, 2)));
        let folded = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
        assert_eq!(mistake(&folded), Some(Mistake::Crossing(0, 1)));
        let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
        assert!(matches!(mistake(&touching), Some(Mistake::Crossing(0, 2 | 3))));
        assert_eq!(mistake(&ANGLE), None);
    }
}
