//! Compares norms over cells of meshes with fine rules along each axis of each cell. The functions of cells are typed by hand.

use mms_results::Cells;
use mms_results::mesh::Mesh;
use mms_results::over_cells::{Carried, SolutionPart};

use crate::sampled::sampled;

/// Kinds whose functions are products along the axes: lines, quads and hexahedra of degree 1 and 2.
const KINDS: [u8; 6] = [3, 21, 9, 28, 12, 29];

/// One of this many kinds of cells is tested.
const SHARE: usize = 2;

/// The wave vector of the exact solution.
const K: [f64; 3] = [1.9, 2.7, -1.4];

/// A component of the exact solution, and its derivative by the phase.
fn exact(x: &[f64], component: usize) -> [f64; 2] {
    let phase: f64 = x.iter().zip(K).map(|(x, k)| k * x).sum();
    let phase = phase + component as f64;
    [phase.sin(), phase.cos()]
}

/// A mesh of n cells along each axis, at X = (xi + s xi^2)/(1 + s) along each, with s = 0.2: cells of several sizes. The values
/// at the points are exact plus an error of a method's order.
struct Case {
    cells: Cells,
    points: Vec<f64>,
    values: Vec<f64>,
    dimension: usize,
    components: usize,
}

fn case(kind: u8, n: usize, components: usize) -> Case {
    let shape = crate::shape(kind);
    let (dimension, degree) = (shape.dimension, shape.degree() as usize);
    let side = degree * n + 1;
    let axes = |mut index: usize, count: usize| {
        let along = move |_| {
            let at = index % count;
            index /= count;
            at
        };
        (0..dimension).map(along).collect::<Vec<_>>()
    };
    let place = |at: usize| {
        let xi = at as f64 / (side - 1) as f64;
        (xi + 0.2 * xi * xi) / 1.2
    };
    let points: Vec<f64> =
        (0..side.pow(dimension as u32)).flat_map(|it| axes(it, side)).map(place).collect();
    let mut cells = Cells::default();
    for index in 0..n.pow(dimension as u32) {
        let first = axes(index, n);
        for node in &shape.nodes {
            let along = (0..dimension).rev().fold(0, |all, axis| {
                all * side + degree * first[axis] + (degree as f64 * node[axis]) as usize
            });
            cells.points.push(along);
        }
        cells.ends.push(cells.points.len());
        cells.types.push(kind);
    }
    let error = 0.3 * (2.0 / n as f64).powi(degree as i32 + 1);
    let value = |x: &[f64], component: usize| {
        exact(x, component)[0] + error * (1.7 * x[0] + 0.4 + component as f64).cos()
    };
    let values = points.chunks(dimension);
    let values = values.flat_map(|x| (0..components).map(move |it| value(x, it))).collect();
    Case { cells, points, values, dimension, components }
}

/// The function of a node along an axis, and its slope.
fn along(degree: usize, node: f64, x: f64) -> [f64; 2] {
    match (degree, node) {
        (1, 0.0) => [1.0 - x, -1.0],
        (1, _) => [x, 1.0],
        (_, 0.0) => [(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x - 3.0],
        (_, 0.5) => [4.0 * x * (1.0 - x), 4.0 - 8.0 * x],
        _ => [x * (2.0 * x - 1.0), 4.0 * x - 1.0],
    }
}

/// Places and weights of a rule along an axis.
type Rule = Vec<(f64, f64)>;

/// Simpson's rule on a number of intervals, including their ends.
fn simpson(intervals: usize) -> Rule {
    let weight = |at: usize| match at {
        0 => 1.0,
        _ if at == intervals => 1.0,
        _ if at % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let place = |at: usize| at as f64 / intervals as f64;
    (0..=intervals).map(|at| (place(at), weight(at) / (3.0 * intervals as f64))).collect()
}

/// Four Gauss points on each interval: exact to degree 7 there.
fn gauss(intervals: usize) -> Rule {
    let root = 2.0 * (6.0_f64 / 5.0).sqrt() / 7.0;
    let [inner, outer] = [(3.0 / 7.0 - root).sqrt(), (3.0 / 7.0 + root).sqrt()];
    let [more, less] = [18.0 + 30.0_f64.sqrt(), 18.0 - 30.0_f64.sqrt()].map(|it| it / 36.0);
    let four = [(-outer, less), (-inner, more), (inner, more), (outer, less)];
    let n = intervals as f64;
    let on = |at: usize| four.map(|(x, w)| ((at as f64 + (1.0 + x) / 2.0) / n, w / 2.0 / n));
    (0..intervals).flat_map(on).collect()
}

/// l1, l2, linf and h1 by a rule along each axis of a cell.
fn by(rule: &Rule, case: &Case) -> [f64; 4] {
    let Case { dimension, components, .. } = *case;
    let (mut volume, mut sums, mut largest) = (0.0, [0.0; 3], 0.0_f64);
    for (kind, points) in case.cells.iter() {
        let shape = crate::shape(kind);
        let degree = shape.degree() as usize;
        for mut index in 0..rule.len().pow(dimension as u32) {
            let (mut xi, mut w) = ([0.0; 3], 1.0);
            for to in &mut xi[..dimension] {
                let (place, weight) = rule[index % rule.len()];
                index /= rule.len();
                (*to, w) = (place, w * weight);
            }
            // X and u, and their derivatives: dX is diagonal.
            let size = dimension + components;
            let mut found = vec![[0.0; 4]; size];
            for (node, &point) in shape.nodes.iter().zip(points) {
                let parts: Vec<_> =
                    (0..dimension).map(|axis| along(degree, node[axis], xi[axis])).collect();
                let by = |which: usize| -> f64 {
                    let slope = |axis: usize| usize::from(axis + 1 == which);
                    (0..dimension).map(|axis| parts[axis][slope(axis)]).product()
                };
                let own = case.points[point * dimension..][..dimension]
                    .iter()
                    .chain(&case.values[point * components..][..components]);
                for (to, x) in found.iter_mut().zip(own) {
                    (0..=dimension).for_each(|which| to[which] += by(which) * x);
                }
            }
            let x: Vec<f64> = found[..dimension].iter().map(|it| it[0]).collect();
            let det: f64 = (0..dimension).map(|axis| found[axis][axis + 1]).product();
            let (mut square, mut of_gradient) = (0.0, 0.0);
            for component in 0..components {
                let own = found[dimension + component];
                let [value, slope] = exact(&x, component);
                square += (own[0] - value).powi(2);
                for axis in 0..dimension {
                    let by_x = own[axis + 1] / found[axis][axis + 1];
                    of_gradient += (by_x - K[axis] * slope).powi(2);
                }
            }
            volume += w * det;
            let each = [square.sqrt(), square, of_gradient];
            sums.iter_mut().zip(each).for_each(|(to, it)| *to += w * det * it);
            largest = largest.max(square.sqrt());
        }
    }
    let [first, second, gradient] = sums.map(|it| it / volume);
    [first, second.sqrt(), largest, gradient.sqrt()]
}

fn measured(case: &Case) -> [f64; 4] {
    let Case { cells, points, values, dimension, components } = case;
    let (dimension, components) = (*dimension, *components);
    let mut asked = |what: SolutionPart, places: &[f64]| {
        let all = places.chunks(dimension);
        let each = |x: &[f64]| -> Vec<f64> {
            let of = |component: usize| match (what, exact(x, component)) {
                (SolutionPart::Values, [value, _]) => vec![value],
                (SolutionPart::Gradients, [_, slope]) => {
                    K[..dimension].iter().map(|k| k * slope).collect()
                }
            };
            (0..components).flat_map(of).collect()
        };
        Ok(all.flat_map(each).collect())
    };
    let carried = Carried { values, components, has_gradient: true };
    let found =
        Mesh { cells, points, dimension, is_meridian: false }.measure(carried, &mut asked).unwrap();
    [found.value.l1, found.value.l2, found.value.linf, found.h1]
}

#[test]
fn norms_are_those_of_fine_rules_on_every_mesh() {
    // Simpson's rule has a place near the maximum of a cubic polynomial, at 0.211 of an edge.
    let rules = [(256, 16), (24, 4), (10, 2)].map(|(a, b)| [simpson(a), gauss(b)]);
    let meshes: [&[usize]; 3] = [&[4, 8, 16, 32], &[3, 6, 12], &[2, 4]];
    for kind in sampled(KINDS, SHARE) {
        let dimension = crate::shape(kind).dimension;
        // One component is 0 along surfaces, several only at points.
        for components in if dimension == 2 { vec![1, 2] } else { vec![dimension] } {
            let off = meshes[dimension - 1].iter().map(|&n| {
                let case = case(kind, n, components);
                let [closed, open] = rules[dimension - 1].each_ref().map(|rule| by(rule, &case));
                let fine = [closed[0], open[1], closed[2], open[3]];
                let found = measured(&case);
                [0, 1, 2, 3].map(|norm| found[norm] / fine[norm] - 1.0)
            });
            let off: Vec<_> = off.collect();
            for (norm, most, varies) in
                [(0, 0.01, 3e-3), (1, 1e-6, 1e-6), (2, 0.01, 3e-3), (3, 1e-6, 1e-6)]
            {
                let all = || off.iter().map(|it| it[norm]);
                let (high, low) = (all().fold(f64::MIN, f64::max), all().fold(f64::MAX, f64::min));
                let is_right = high.max(-low) <= most && high - low <= varies;
                assert!(is_right, "{kind}, {components} components: {off:?}");
            }
        }
    }
}
