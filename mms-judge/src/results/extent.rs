//! The part of the body that results cover, and the distances of their points.

use std::f64::consts::TAU;

use anyhow::ensure;
use mms_exact::Exact;
use mms_mechanics::extent::Extent;
use mms_results::lattice::Lattice;
use mms_results::mesh::{Mesh, swept};
use mms_results::motion::{Motion, ReferenceBody, resolve};
use mms_results::names::Meaning;
use mms_results::{Cells, Snapshot};
use mms_runtime::math::coordinates::{Side, System};
use mms_spec::Face;

use super::ALIKE;
use super::files::placed;
use crate::measured::Objection;

/// The part of the body that may be missing because of rounding and the meshing of curved sides.
const ROUNDING: f64 = 1e-7;

/// The largest distance of the ends of an edge from a curved side that it belongs to, over its length.
const BESIDE: f64 = 0.05;

/// The largest gap without a point, in spacings of points.
const EMPTY: f64 = 3.0;

/// The number of points from which the distances of neighbours are found.
const LOOKED_AT: usize = 1000;

/// The part of the body that results cover.
#[derive(Clone, Debug, PartialEq)]
pub struct Covered {
    /// The number of cells; 0 without cells.
    pub cells: usize,
    /// The number of points.
    pub points: usize,
    /// h: the edge of a cube as large as a cell, or as the region of a point; or the distance of neighbouring points.
    pub size: f64,
    /// Whether there are no cells, and neighbouring points are evenly spaced.
    pub is_even: bool,
    /// The missing part in words: `the cells cover 0.5 of the body`.
    pub part: Option<String>,
}

/// Finds the part of the body that cells cover.
///
/// # Errors
/// Cells that do not cover all of it, unless a part is enough; or that overlap.
pub fn of_cells(
    mesh: &Mesh<'_>,
    (exact, is_part): (&Exact, bool),
    rounding: f64,
    path: &str,
) -> anyhow::Result<Covered> {
    // The share of a body of revolution is the share of its meridian.
    let flat = Mesh { is_meridian: false, ..*mesh };
    let volumes = flat.volumes().map_err(|mistake| placed(mistake.of(path)))?;
    let measure: f64 = volumes.iter().sum();
    let dimension = mesh.dimension;
    let body = &exact.body;
    let share = (measure + beside_curves(mesh, body)) / body.measure();
    let least = thickness(body);
    let facets = facets(mesh, body);
    let most = ROUNDING + 8.0 * dimension as f64 * rounding / least + facets;
    let covers = format!("the cells cover {} of the body", of(share));
    ensure!(share <= 1.0 + most, "{path}: {covers}: some of them overlap");
    let part = (share < 1.0 - most).then_some(covers);
    if let Some(part) = part.as_ref().filter(|_| !is_part) {
        let unknown = mesh
            .unknown()
            .map(|kind| format!("; cells of type {kind} of VTK are not known, and are left out"));
        anyhow::bail!(
            "{path}: {part}{}; expected all of it; `--part` judges a part, as a symmetric half",
            unknown.unwrap_or_default()
        );
    }
    let cells = mesh.full().count();
    let size = (measure / cells as f64).powf(1.0 / dimension as f64);
    let points = mesh.points.len() / dimension;
    Ok(Covered { cells, points, size, is_even: false, part })
}

/// X and u of a snapshot at a time.
///
/// # Errors
/// Positions that cannot be read, or that lie outside the body.
pub fn motion<'a>(
    snapshot: &'a Snapshot,
    meanings: &[Meaning],
    time: f64,
    (exact, is_part): (&Exact, bool),
) -> anyhow::Result<Motion<'a>> {
    let outside = Filled { exact, cells: &snapshot.cells, is_part };
    let mut back = exact.inverse(time, snapshot.rows());
    resolve(snapshot, meanings, exact.dimension, &outside, Some(&mut back)).map_err(placed)
}

/// The body of a field, for points or for the cells between them.
struct Filled<'a> {
    exact: &'a Exact,
    cells: &'a Cells,
    /// Whether a part of the body is enough, so that filling it shows nothing.
    is_part: bool,
}

impl ReferenceBody for Filled<'_> {
    fn distance(&self, point: &[f64]) -> f64 {
        self.exact.body.distance(point)
    }

    fn is_filled(&self, points: &[f64]) -> bool {
        let (cells, dimension) = (self.cells, self.exact.dimension);
        let mesh = Mesh { cells, points, dimension, is_meridian: false };
        match mesh.sizes() {
            _ if self.is_part => false,
            Some(_) => of_cells(&mesh, (self.exact, false), SINGLE, "").is_ok(),
            None => of_points(points, self.exact, SINGLE).part.is_none(),
        }
    }
}

/// The rounding of coordinates in single precision, for a body of size 1.
const SINGLE: f64 = 1e-7;

/// A share with three digits; if nearly all is there, the missing share.
fn of(share: f64) -> String {
    match (1.0 - share).abs() < 5e-4 {
        true => format!("all but {:.1e}", 1.0 - share),
        false => format!("{}", (1000.0 * share).round() / 1000.0),
    }
}

/// The least distance between opposite faces of a body.
fn thickness(body: &Extent<f64>) -> f64 {
    match body {
        Extent::Block(block) => {
            let lengths = block.bounds.iter().enumerate();
            let lengths = lengths.filter(|(axis, _)| !block.system.is_angle(*axis));
            lengths.map(|(_, [a, b])| b - a).fold(f64::INFINITY, f64::min)
        }
        _ => body.size(),
    }
}

/// The part of a body in space by which facets of cells may miss or exceed its curved faces: a facet with longest edge s and
/// its corners on a circle of radius R is at most s^2/(8 R) from the circle.
fn facets(mesh: &Mesh<'_>, body: &Extent<f64>) -> f64 {
    let Extent::Block(block) = body else { return 0.0 };
    if block.system == System::Cartesian || block.bounds.len() < 3 {
        return 0.0;
    }
    let longest = mesh.sizes().map_or(0.0, |[_, longest]| longest);
    let on = |radius: f64| {
        let mut sides: Vec<Side> = block.bounds.iter().copied().map(Side::Between).collect();
        sides[0] = Side::At(radius);
        // A sphere is curved in two directions.
        let ways = if block.system == System::Spherical { 2.0 } else { 1.0 };
        ways * block.system.measure(&sides) * longest.powi(2) / (8.0 * radius)
    };
    let radii = block.bounds[0].into_iter().filter(|radius| *radius > 0.0);
    radii.map(on).sum::<f64>() / body.measure()
}

/// The area between the edges of cells and the circles that they approximate: outside the edges on the outer circle, and, with
/// the other sign, inside them on the inner circle.
fn beside_curves(mesh: &Mesh<'_>, body: &Extent<f64>) -> f64 {
    let Extent::Block(block) = body else { return 0.0 };
    if block.system != System::Polar || block.bounds.len() != 2 {
        return 0.0;
    }
    let [inner, outer] = block.bounds[0];
    let distance = |a: &[f64], b: &[f64]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let on = |face: Face, radius: f64| -> f64 {
        let is_on = |[a, b]: [&[f64]; 2]| {
            let most = BESIDE * distance(a, b);
            [a, b].into_iter().all(|end| body.distance_to(face, end) <= most)
        };
        let edges = mesh.free_edges(&is_on);
        edges.iter().map(|edge| beside(edge, radius)).sum()
    };
    on(Face::Outer, outer) - on(Face::Inner, inner)
}

/// The area between an edge and an arc of a radius about the origin, within the rays through the ends of the edge.
fn beside(edge: &[&[f64]], radius: f64) -> f64 {
    let cross = |a: &[f64], b: &[f64]| a[0] * b[1] - a[1] * b[0];
    let (a, b) = (edge[0], edge[1]);
    let angle = cross(a, b).atan2(a[0] * b[0] + a[1] * b[1]);
    (radius * radius * angle / 2.0).abs() - swept(edge).abs()
}

/// Finds the part of the body that points without cells fill.
pub fn of_points(points: &[f64], exact: &Exact, rounding: f64) -> Covered {
    let (body, dimension) = (&exact.body, exact.dimension);
    let count = points.len() / dimension;
    let spacing = exact.spacing(count);
    let lattice = Lattice::new(points, dimension, spacing);
    let (mean, is_even) = distances(&lattice, count);
    let part = empty(&lattice, points, body, spacing).map(|place| {
        format!(
            "the points leave part of the body empty: within {:.2e}, {EMPTY} spacings of {count} points that fill it, \
             there is none at X = {place:?}",
            EMPTY * spacing
        )
    });
    let neighbourhoods = || exact.neighbourhoods(points, rounding).iter().sum::<f64>();
    let neighbour = (is_even || part.is_some()).then_some(mean).filter(|it| *it > 0.0);
    let size = neighbour
        .unwrap_or_else(|| (body.measure() / neighbourhoods()).powf(1.0 / dimension as f64));
    let few = (count < 1 << dimension).then(|| format!("{count} points fill no body"));
    Covered { cells: 0, points: count, size, is_even: neighbour.is_some(), part: part.or(few) }
}

/// The mean distance of neighbours among `count` points, and whether the points are evenly spaced.
pub fn distances(lattice: &Lattice<'_>, count: usize) -> (f64, bool) {
    let all = lattice.distances(count / LOOKED_AT + 1);
    let range = |pick: fn(f64, f64) -> f64| all.iter().copied().reduce(pick);
    let is_even = range(f64::max).zip(range(f64::min)).is_some_and(|(a, b)| a <= ALIKE * b);
    (all.iter().sum::<f64>() / all.len() as f64, is_even)
}

/// Finds a place of the body that is far from all points, in lengths and also in parts of its edges: a plate may have as many
/// points across as along.
fn empty(
    lattice: &Lattice<'_>,
    points: &[f64],
    body: &Extent<f64>,
    spacing: f64,
) -> Option<Vec<f64>> {
    let found = far(lattice, points, body, EMPTY * spacing)?;
    let dimension = body.dimension();
    let Extent::Block(_) = body else { return Some(found) };
    let parts: Vec<f64> = points.chunks(dimension).flat_map(|it| parts(body, it)).collect();
    let spacing = (dimension as f64 / parts.len() as f64).powf(1.0 / dimension as f64);
    let unit = Extent::cuboid(vec![0.0; dimension], vec![1.0; dimension]);
    far(&Lattice::new(&parts, dimension, spacing), &parts, &unit, EMPTY * spacing)?;
    Some(found)
}

/// The position of a point from one end of the body to the other: along each edge of a box; along the angle, the radius and the
/// third coordinate of a round body; empty for another body.
fn parts(body: &Extent<f64>, point: &[f64]) -> Vec<f64> {
    let Extent::Block(block) = body else { return Vec::new() };
    let padded = std::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0));
    let at = block.system.local(padded);
    let part = |axis: usize| {
        let [a, b] = block.bounds[axis];
        match block.system != System::Cartesian && axis == 1 {
            true => (at[1] - a).rem_euclid(TAU) / (b - a),
            false => (at[axis] - a) / (b - a),
        }
    };
    let mut order: Vec<usize> = (0..block.bounds.len()).collect();
    if block.system != System::Cartesian {
        order.swap(0, 1);
    }
    order.into_iter().map(part).collect()
}

/// Finds a place of the body farther than `reach` from all points; or one at a side of a box, if a layer beside it of half that
/// width has no point.
fn far(lattice: &Lattice<'_>, points: &[f64], body: &Extent<f64>, reach: f64) -> Option<Vec<f64>> {
    let dimension = body.dimension();
    let lengths = match body {
        Extent::Block(block) if block.system == System::Cartesian => {
            for (axis, [lower, upper]) in block.bounds.iter().enumerate() {
                let along = || points.iter().skip(axis).step_by(dimension).copied();
                let below = along().fold(f64::INFINITY, f64::min) - lower;
                let above = upper - along().fold(f64::NEG_INFINITY, f64::max);
                for (side, gap) in [(0.0, below), (1.0, above)] {
                    if gap > reach / 2.0 {
                        let mut parts = vec![0.5; dimension];
                        parts[axis] = side;
                        return Some(body.point(&parts));
                    }
                }
            }
            block.bounds.iter().map(|[a, b]| b - a).collect()
        }
        Extent::Block(block) => {
            let outer = block.bounds[0][1];
            let length = |axis: usize| {
                let [a, b] = block.bounds[axis];
                if block.system.is_angle(axis) { outer * (b - a) } else { b - a }
            };
            let mut lengths: Vec<f64> = (0..dimension).map(length).collect();
            lengths.swap(0, 1);
            lengths
        }
        _ => vec![2.0 * body.size(); dimension],
    };
    // The places are so dense that they miss no empty part by much.
    let counts: Vec<usize> =
        lengths.iter().map(|it| (1.5 * it / reach).ceil().max(1.0) as usize).collect();
    let place = |mut index: usize| -> Vec<f64> {
        let part = |count: &usize| {
            let at = index % (count + 1);
            index /= count + 1;
            at as f64 / *count as f64
        };
        body.point(&counts.iter().map(part).collect::<Vec<_>>())
    };
    let mut places = (0..counts.iter().map(|it| it + 1).product()).map(place);
    places.find(|it| !lattice.has_within(it, reach))
}

/// The objection to points that leave part of the body empty.
pub fn objection(part: &str) -> Objection {
    let why = format!(
        "{part}. The missing part may be wrong: give all points, or judge a part, such as a line or a probe, with `--part`"
    );
    Objection { why, is_to_all: false }
}
