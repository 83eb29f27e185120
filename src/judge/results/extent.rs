//! What part of the body results cover, and how far their points are from each other.

use anyhow::ensure;
use mms_mechanics::extent::Extent;
use mms_results::lattice::Lattice;
use mms_results::norm::Mesh;
use mms_spec::Face;

use super::ALIKE;
use super::files::placed;
use crate::judge::Objection;
use crate::session::exact::Exact;

/// What part of the body may be missing that rounding and the meshing of curved sides leave.
const ROUNDING: f64 = 1e-7;

/// How far the ends of an edge may be from a curved side that it lies on, in parts of its length.
const BESIDE: f64 = 0.05;

/// How many spacings of points may be without one.
const EMPTY: f64 = 3.0;

/// How many points tell how far neighbours are from each other.
const LOOKED_AT: usize = 1000;

/// How much of the body is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Covered {
    /// Cells, or none.
    pub cells: usize,
    /// Points.
    pub points: usize,
    /// h: the edge of a cube as large as a cell, or as what belongs to a point.
    pub size: f64,
    /// How far neighbouring points are from each other, where there are no cells and all are as far.
    pub neighbour: Option<f64>,
    /// What is missing, in a word: `the cells cover 0.5 of the body`.
    pub part: Option<String>,
}

/// Finds how much of the body cells cover.
///
/// # Errors
/// They do not cover all of it, unless a part is enough; or some lie over others.
pub fn of_cells(
    mesh: &Mesh<'_>,
    (exact, is_part): (&Exact, bool),
    rounding: f64,
    path: &str,
) -> anyhow::Result<Covered> {
    let volumes = mesh.volumes().map_err(|mistake| placed(mistake.of(path)))?;
    let measure: f64 = volumes.iter().sum();
    let dimension = mesh.dimension;
    let body = &exact.body;
    let share = (measure + beside_curves(mesh, body)) / body.measure();
    let least = match body {
        Extent::Box([lower, upper]) => {
            lower.iter().zip(upper).map(|(a, b)| b - a).fold(f64::INFINITY, f64::min)
        }
        Extent::Annulus([inner, outer], _) => outer - inner,
    };
    let most = ROUNDING + 8.0 * dimension as f64 * rounding / least;
    let covers = format!("the cells cover {} of the body", of(share));
    ensure!(share <= 1.0 + most, "{path}: {covers}: some of them lie over others");
    let part = (share < 1.0 - most).then_some(covers);
    if let Some(part) = part.as_ref().filter(|_| !is_part) {
        let unknown = mesh
            .unknown()
            .map(|kind| format!("; those of type {kind} of VTK are not known, and are left out"));
        anyhow::bail!(
            "{path}: {part}{}; expected all of it; `--part` judges a part, as a symmetric half",
            unknown.unwrap_or_default()
        );
    }
    let cells = mesh.full().count();
    let size = (measure / cells as f64).powf(1.0 / dimension as f64);
    let points = mesh.points.len() / dimension;
    Ok(Covered { cells, points, size, neighbour: None, part })
}

/// A share with three digits, of nearly all with what is missing.
fn of(share: f64) -> String {
    match (1.0 - share).abs() < 5e-4 {
        true => format!("all but {:.1e}", 1.0 - share),
        false => format!("{}", (1000.0 * share).round() / 1000.0),
    }
}

/// The area between the edges of cells and the circles that they stand for: outside them on the outer one, and, with the
/// other sign, inside them on the inner one.
fn beside_curves(mesh: &Mesh<'_>, body: &Extent<f64>) -> f64 {
    let Extent::Annulus([inner, outer], _) = body else { return 0.0 };
    let distance = |a: &[f64], b: &[f64]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let on = |face: Face, radius: f64| -> f64 {
        let is_on = |[a, b]: [&[f64]; 2]| {
            let most = BESIDE * distance(a, b);
            [a, b].into_iter().all(|end| body.distance_to(face, end) <= most)
        };
        let edges = mesh.free_edges(&is_on);
        edges.iter().map(|edge| beside(edge, radius)).sum()
    };
    on(Face::Outer, *outer) - on(Face::Inner, *inner)
}

/// The area between an edge and an arc of that radius about the origin, from the rays through its ends.
fn beside(edge: &[&[f64]], radius: f64) -> f64 {
    let cross = |a: &[f64], b: &[f64]| a[0] * b[1] - a[1] * b[0];
    let (a, b) = (edge[0], edge[1]);
    let angle = cross(a, b).atan2(a[0] * b[0] + a[1] * b[1]);
    // Half the integral of x dy - y dx, of a parabola through three points as well.
    let swept = match edge.get(2) {
        None => cross(a, b) / 2.0,
        Some(middle) => (4.0 * (cross(a, middle) + cross(middle, b)) - cross(a, b)) / 6.0,
    };
    (radius * radius * angle / 2.0).abs() - swept.abs()
}

/// Finds how much of the body points without cells fill.
pub fn of_points(points: &[f64], exact: &Exact, rounding: f64) -> Covered {
    let (body, dimension) = (&exact.body, exact.dimension);
    let count = points.len() / dimension;
    let spacing = exact.spacing(count);
    let lattice = Lattice::new(points, dimension, spacing);
    let distances = lattice.distances(count / LOOKED_AT + 1);
    let mean = distances.iter().sum::<f64>() / distances.len() as f64;
    let range = |pick: fn(f64, f64) -> f64| distances.iter().copied().reduce(pick);
    let is_even = range(f64::max).zip(range(f64::min)).is_some_and(|(a, b)| a <= ALIKE * b);
    // A point on a face has half of its neighbourhood in the body, on an edge a quarter.
    let mut parts = vec![1.0; count];
    let rows = exact.faces(points, rounding).into_iter().flat_map(|(_, rows)| rows);
    rows.for_each(|row| parts[row] /= 2.0);
    let all: f64 = parts.iter().sum();
    let part = empty(&lattice, points, body, spacing).map(|place| {
        format!(
            "the points leave part of the body empty: within {:.2e}, {EMPTY} spacings of {count} points that fill it, \
             there is none at X = {place:?}",
            EMPTY * spacing
        )
    });
    let few = (count < 1 << dimension).then(|| format!("{count} points fill no body"));
    Covered {
        cells: 0,
        points: count,
        size: (body.measure() / all).powf(1.0 / dimension as f64),
        neighbour: (is_even || part.is_some()).then_some(mean).filter(|it| *it > 0.0),
        part: part.or(few),
    }
}

/// A place of the body that is far from all points; or a layer at a side of a box without one.
fn empty(
    lattice: &Lattice<'_>,
    points: &[f64],
    body: &Extent<f64>,
    spacing: f64,
) -> Option<Vec<f64>> {
    let (dimension, reach) = (body.dimension(), EMPTY * spacing);
    let [lower, upper] = match body {
        Extent::Box([lower, upper]) => [lower.clone(), upper.clone()],
        Extent::Annulus([_, outer], _) => [vec![-outer; 2], vec![*outer; 2]],
    };
    let bounds = (0..dimension).map(|axis| {
        let along = || points.iter().skip(axis).step_by(dimension).copied();
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    });
    if let Extent::Box(_) = body {
        let middle = || lower.iter().zip(&upper).map(|(a, b)| (a + b) / 2.0).collect::<Vec<_>>();
        for (axis, [least, most]) in bounds.enumerate() {
            for (side, gap) in
                [(lower[axis], least - lower[axis]), (upper[axis], upper[axis] - most)]
            {
                if gap > reach / 2.0 {
                    let mut place = middle();
                    place[axis] = side;
                    return Some(place);
                }
            }
        }
    }
    // Places so near to each other that none of them misses an empty part by much.
    let step = reach / 2.0;
    let counts: Vec<usize> =
        lower.iter().zip(&upper).map(|(a, b)| ((b - a) / step).ceil() as usize + 1).collect();
    let place = |mut index: usize| -> Vec<f64> {
        let along = |axis: usize| {
            let at = index % counts[axis];
            index /= counts[axis];
            (lower[axis] + at as f64 * step).min(upper[axis])
        };
        (0..dimension).map(along).collect()
    };
    let places = (0..counts.iter().product()).map(place);
    let mut places = places.filter(|it| body.distance(it) == 0.0);
    // Most have a point beside them, in the same cell of the lattice.
    let is_alone = |place: &[f64]| lattice.near(place, 0.0).next().is_none();
    places.find(|it| is_alone(it) && lattice.within(it, reach).next().is_none())
}

/// What is said of points that leave part of the body empty.
pub fn objection(part: &str) -> Objection {
    let why = format!(
        "{part}. What is not there may be wrong: give all points, or judge a part, such as a line or a probe, with `--part`"
    );
    Objection { why, is_to_all: false }
}
