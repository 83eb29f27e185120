//! The concentration of an error: the part of the body, the time, and the decrease from mesh to mesh.

use mms_runtime::body::bounding_box;
use mms_runtime::{Body, Face, Vector};

use crate::answer::ErrorPlace;
use crate::body::{away, faces};
use crate::evidence::{Mesh, Snapshot, nearest};
use crate::exact::{Exact, vectors};

/// The width of a layer, in cells.
const CELLS: f64 = 2.0;
/// The least part of the squared error in a layer where an error is concentrated.
const MOST: f64 = 0.5;
/// The least ratio of this part to the layer's part of the points.
const CROWDED: f64 = 3.0;

/// A point with its squared error.
type Weighed<const D: usize> = (Vector<f64, D>, f64);

/// Finds where the error of the finest mesh is at the last time; `smooth` is the smooth part of its square.
pub fn of<const D: usize>(
    exact: &Exact<'_, D>,
    meshes: &[Mesh],
    smooth: f64,
) -> Option<ErrorPlace> {
    let fine = meshes.last()?;
    let snapshot = fine.snapshots.last()?;
    let points = squared(exact, snapshot)?;
    let (at, _) = points.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let [lower, upper] = bounding_box(&exact.domain.body).ok()?;
    let width = CELLS * fine.cell_size / (upper - lower).max();
    let is_near =
        |face: &Face| is_crowded(&points, |x| away(&exact.domain.body, *face, x) <= width);
    let face = faces(&exact.domain.body).into_iter().find(is_near);
    let is_box = matches!(exact.domain.body, Body::Box { .. });
    let plane = (face.is_none() && is_box).then(|| plane(&points, lower, upper, fine.cell_size));
    let before = meshes.iter().rev().find(|it| it.cell_size > fine.cell_size);
    let order = before.and_then(|before| {
        let [coarse, last] = [nearest(before, snapshot.time)?, snapshot].map(|it| mean(exact, it));
        let refined = before.cell_size / fine.cell_size;
        Some((coarse? / last?).ln() / refined.ln()).filter(|it| it.is_finite())
    });
    Some(ErrorPlace {
        at: at.as_slice().to_vec(),
        time: snapshot.time,
        face,
        plane: plane.flatten(),
        order,
        smooth,
    })
}

/// The points, each with the squared error of the first quantity.
fn squared<const D: usize>(exact: &Exact<'_, D>, snapshot: &Snapshot) -> Option<Vec<Weighed<D>>> {
    let points = vectors::<D>(&snapshot.reference);
    let (quantity, values) = snapshot.values.first()?;
    let right = exact.values(*quantity, snapshot.time, &points);
    let components = quantity.components(D);
    let each = values.chunks(components).zip(right.chunks(components));
    let square = |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    let all: Vec<Weighed<D>> = points.into_iter().zip(each.map(square)).collect();
    all.iter().all(|(_, square)| square.is_finite()).then_some(all)
}

/// The root mean square error.
fn mean<const D: usize>(exact: &Exact<'_, D>, snapshot: &Snapshot) -> Option<f64> {
    let all = squared(exact, snapshot)?;
    Some((all.iter().map(|it| it.1).sum::<f64>() / all.len().max(1) as f64).sqrt())
}

/// Whether the points that satisfy `is_in` are few and have most of the error.
fn is_crowded<const D: usize>(
    points: &[Weighed<D>],
    is_in: impl Fn(&Vector<f64, D>) -> bool,
) -> bool {
    let inside = || points.iter().filter(|(x, _)| is_in(x));
    let all: f64 = points.iter().map(|it| it.1).sum();
    let error = inside().map(|it| it.1).sum::<f64>() / all;
    error > MOST && error > CROWDED * inside().count() as f64 / points.len() as f64
}

/// The axis and the position of a layer across the body that has most of the error.
fn plane<const D: usize>(
    points: &[Weighed<D>],
    lower: Vector<f64, D>,
    upper: Vector<f64, D>,
    cell_size: f64,
) -> Option<(usize, f64)> {
    let layer = |axis: usize| {
        let all: f64 = points.iter().map(|it| it.1).sum();
        let middle = points.iter().map(|(x, square)| x[axis] * square).sum::<f64>() / all;
        let is_in = |x: &Vector<f64, D>| (x[axis] - middle).abs() <= CELLS / 2.0 * cell_size;
        let is_inside = lower[axis] < middle && middle < upper[axis];
        (is_inside && is_crowded(points, is_in)).then_some((axis, middle))
    };
    (0..D).find_map(layer)
}
