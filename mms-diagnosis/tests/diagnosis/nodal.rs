//! Residuals at the nodes of linear triangles on an irregular mesh, assembled here by hand, with mistakes.

use mms_diagnosis::answer::Diagnosis;
use mms_diagnosis::changed::Without;
use mms_diagnosis::hypothesis::all;
use mms_diagnosis::state::{self, Computed, Response};

use super::field::{self, DENSITY, LAMBDA, MU};
use super::{LOADED, Point, Tensor, exact, name, shocked};

const TIME: f64 = 0.013;

/// A code: cells along a side, P as a function of H, b of X, and the traction on the right side of H.
struct Code {
    cells: usize,
    stress: fn(&Tensor) -> Tensor,
    force: fn(&Point) -> Point,
    traction: fn(&Tensor) -> Point,
}

const RIGHT: Code = Code {
    cells: 12,
    stress: |h| field::first(h, [LAMBDA, MU]),
    force: |x| field::body_force(TIME, x),
    traction,
};

/// P N on the right side.
fn traction(h: &Tensor) -> Point {
    field::first(h, [LAMBDA, MU]).column(0).into_owned()
}

/// Nodes row by row, those inside moved by up to a fifth of a cell.
fn nodes(cells: usize) -> Vec<Point> {
    let node = |k: usize| {
        let (i, j) = (k % (cells + 1), k / (cells + 1));
        let is_inner = |at: usize| at > 0 && at < cells;
        let by = if is_inner(i) && is_inner(j) { 0.2 } else { 0.0 };
        let (a, b) = ((12.9 * k as f64).sin() * by, (78.2 * k as f64).cos() * by);
        Point::new(i as f64 + a, j as f64 + b) / cells as f64
    };
    (0..(cells + 1) * (cells + 1)).map(node).collect()
}

/// r of each node: int rho0 (a - b) N + P grad N over the body, less int T N over the right side.
fn assembled(code: &Code) -> Vec<Point> {
    let (cells, nodes) = (code.cells, nodes(code.cells));
    let u: Vec<Point> = nodes.iter().map(|x| field::displacement(TIME, x)).collect();
    let mut r = vec![Point::zeros(); nodes.len()];
    for quad in (0..cells * cells).map(|k| k / cells * (cells + 1) + k % cells) {
        let [a, b, c, d] = [quad, quad + 1, quad + cells + 2, quad + cells + 1];
        for triangle in [[a, b, c], [a, c, d]] {
            let [x, y, z] = triangle.map(|k| nodes[k]);
            let edges = Tensor::from_columns(&[y - x, z - x]);
            let (area, inverse) = (edges.determinant() / 2.0, edges.try_inverse().unwrap());
            let moved = triangle.map(|k| u[k]);
            let stretched = Tensor::from_columns(&[moved[1] - moved[0], moved[2] - moved[0]]);
            let stress = (code.stress)(&(stretched * inverse));
            let slopes = [
                -inverse.transpose() * Point::new(1.0, 1.0),
                inverse.row(0).transpose(),
                inverse.row(1).transpose(),
            ];
            for (at, slope) in triangle.iter().zip(slopes) {
                r[*at] += stress * slope * area;
            }
            // The middles of edges; there two shape functions are a half.
            for [i, j] in [[0, 1], [1, 2], [2, 0]] {
                let middle = (nodes[triangle[i]] + nodes[triangle[j]]) / 2.0;
                let q = field::acceleration(TIME, &middle) - (code.force)(&middle);
                for at in [i, j] {
                    r[triangle[at]] += q * (DENSITY * area / 6.0);
                }
            }
        }
    }
    for k in 0..cells {
        let [a, b] = [k, k + 1].map(|row| row * (cells + 1) + cells);
        let middle = (nodes[a] + nodes[b]) / 2.0;
        let load = (code.traction)(&field::gradient(TIME, &middle));
        let force = load * ((nodes[b] - nodes[a]).norm() / 2.0);
        (r[a], r[b]) = (r[a] - force, r[b] - force);
    }
    r
}

fn diagnosed(code: &Code) -> Diagnosis {
    without(Without::default(), code)
}

fn without(without: Without, code: &Code) -> Diagnosis {
    let exact = exact(&LOADED, code.cells as f64);
    let numbers =
        |points: Vec<Point>| points.iter().flat_map(|x| x.as_slice().to_vec()).collect::<Vec<_>>();
    let response = Response {
        computed: Computed::NodalResidual,
        time: TIME,
        reference: numbers(nodes(code.cells)),
        values: numbers(assembled(code)),
        volumes: None,
        degree: None,
        without,
        step: None,
    };
    state::diagnose(&exact, &response, &all(&exact)).unwrap()
}

#[test]
fn nodal_residuals_name_a_term() {
    assert_eq!(name(&diagnosed(&RIGHT)), "nothing");
    let twice = Code { force: |x| field::body_force(TIME, x) * 2.0, ..RIGHT };
    assert_eq!(name(&diagnosed(&twice)), "force_twice");
    let sign = Code {
        force: |x| field::acceleration(TIME, x) * 2.0 - field::body_force(TIME, x),
        ..RIGHT
    };
    assert_eq!(name(&diagnosed(&sign)), "force_sign");
    let transposed = Code { stress: |h| field::first(h, [LAMBDA, MU]).transpose(), ..RIGHT };
    assert_eq!(name(&diagnosed(&transposed)), "stress_transposed");
    let swapped = Code { stress: |h| field::first(h, [MU, LAMBDA]), ..RIGHT };
    assert_eq!(name(&diagnosed(&swapped)), "moduli_swapped");
    // Coarse elements have larger errors at the kink where compression ends.
    let shocked =
        Code { cells: 24, stress: |h| field::first(h, [LAMBDA, MU]) + shocked(TIME, h), ..RIGHT };
    let shocked = diagnosed(&shocked);
    assert_eq!(name(&shocked), "artificial_viscosity");
    assert!((shocked.ranked[0].factor[0] / 6.0 - 1.0).abs() < 0.05, "{:?}", shocked.ranked[0]);
    let loaded = |traction| diagnosed(&Code { traction, ..RIGHT }).ranked.swap_remove(0).title();
    assert_eq!(loaded(|h| -traction(h)), "traction_sign on x_max");
    let turned = loaded(|h| {
        let f = h + Tensor::identity();
        let (sin, cos) = (f[(1, 0)] - f[(0, 1)]).atan2(f[(0, 0)] + f[(1, 1)]).sin_cos();
        Tensor::new(cos, -sin, sin, cos) * traction(h)
    });
    assert_eq!(turned, "traction_follower on x_max");
    // The local stretch of the side.
    let present = loaded(|h| traction(h) * h[(0, 1)].hypot(1.0 + h[(1, 1)]));
    assert_eq!(present, "traction_present_area on x_max");
}

#[test]
fn nodal_residuals_of_a_part_of_the_balance_are_those_of_a_right_code() {
    let all = Without::default();
    let force = Code { force: |_| Point::zeros(), ..RIGHT };
    assert_eq!(name(&without(Without { body_force: true, ..all }, &force)), "nothing");
    let stiff = Code { stress: |h| field::first(h, [LAMBDA, MU]) * 1.2, ..force };
    assert_eq!(name(&without(Without { body_force: true, ..all }, &stiff)), "moduli_factor");
    let stress = Code { stress: |_| Tensor::zeros(), ..RIGHT };
    assert_eq!(name(&without(Without { stress: true, ..all }, &stress)), "nothing");
    let traction = Code { traction: |_| Point::zeros(), ..RIGHT };
    assert_eq!(name(&without(Without { traction: true, ..all }, &traction)), "nothing");
}
