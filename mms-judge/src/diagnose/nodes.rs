//! Points with computed accelerations or residuals: each once, with its volume.

use anyhow::{bail, ensure};
use mms_exact::Exact;
use mms_results::lattice::Lattice;
use mms_results::mesh::Mesh;
use mms_results::names::Values;
use mms_spec::quantity::Quantity;

use crate::results::{distances, placed};

/// Points with one vector each.
pub struct Nodes {
    /// X, point by point.
    pub reference: Vec<f64>,
    /// The vectors, point by point.
    pub values: Vec<f64>,
    /// Reference volumes, which add up to about the volume of the body.
    pub volumes: Option<Vec<f64>>,
}

/// The largest distance of points that are one point, divided by the distance of neighbours.
const ONE: f64 = 1e-6;
/// The largest difference between values of points that are one point, relative to the largest value.
const SAME: f64 = 1e-6;

/// Finds the reference volumes of points: from a column of reference or present volumes, from cells, or from even distances.
///
/// # Errors
/// Inverted cells; points whose volumes cannot be found.
pub fn volumes(
    column: Option<Values<'_>>,
    mesh: &Mesh<'_>,
    (time, rounding, path): (f64, f64, &str),
    exact: &mut Exact,
) -> anyhow::Result<Vec<f64>> {
    let Some(column) = column else {
        if mesh.sizes().is_some() && mesh.has_functions() {
            return mesh.volumes().map_err(|it| placed(it.of(path)));
        }
        return by_distance(mesh.points, rounding, exact).ok_or_else(|| {
            anyhow::anyhow!(
                "{path}: the points are not evenly spaced, so their volumes are unknown; write \
                 reference volumes in a column `volume` (`--map volume=..`), or the cells"
            )
        });
    };
    let volumes = column.numbers.into_owned();
    let stretches = exact.values(Quantity::Jacobian, time, mesh.points)?;
    let before: Vec<f64> = volumes.iter().zip(&stretches).map(|(it, j)| it / j).collect();
    let off = |all: &[f64]| (all.iter().sum::<f64>() / exact.body.measure() - 1.0).abs();
    Ok(if off(&before) < off(&volumes) { before } else { volumes })
}

/// The volumes of evenly spaced points in a box: half a cell on a face, a quarter on an edge.
fn by_distance(points: &[f64], rounding: f64, exact: &Exact) -> Option<Vec<f64>> {
    let count = points.len() / exact.dimension;
    if exact.body.box_bounds().is_none() || count < 2 {
        return None;
    }
    let lattice = Lattice::new(points, exact.dimension, exact.spacing(count));
    let (_, is_even) = distances(&lattice, count);
    if !is_even {
        return None;
    }
    let parts = exact.neighbourhoods(points, rounding);
    let each = exact.body.measure() / parts.iter().sum::<f64>();
    Some(parts.iter().map(|it| it * each).collect())
}

impl Nodes {
    /// Merges points in one place, which each neighbouring cell may write, and adds up their volumes.
    ///
    /// # Errors
    /// Points in one place with different values.
    pub fn merged(self, exact: &Exact, path: &str) -> anyhow::Result<Self> {
        let dimension = exact.dimension;
        let count = self.reference.len() / dimension;
        ensure!(
            self.values.len() == self.reference.len(),
            "{path}: {} numbers for {count} points",
            self.values.len()
        );
        let spacing = exact.spacing(count.max(1));
        let lattice = Lattice::new(&self.reference, dimension, spacing);
        let largest = self.values.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        let at = |row: usize| row * dimension..(row + 1) * dimension;
        let mut merged = Nodes {
            reference: Vec::new(),
            values: Vec::new(),
            volumes: self.volumes.as_ref().map(|_| Vec::new()),
        };
        let mut own: Vec<usize> = Vec::with_capacity(count);
        for row in 0..count {
            let place = &self.reference[at(row)];
            let first = lattice.near(place, ONE * spacing).filter(|other| {
                let apart =
                    |axis: usize| (self.reference[other * dimension + axis] - place[axis]).abs();
                (0..dimension).all(|axis| apart(axis) <= ONE * spacing)
            });
            let first = first.min().unwrap_or(row);
            if first == row {
                own.push(merged.reference.len() / dimension);
                merged.reference.extend(place);
                merged.values.extend(&self.values[at(row)]);
            } else {
                own.push(own[first]);
                let pairs = self.values[at(row)].iter().zip(&self.values[at(first)]);
                if pairs.into_iter().any(|(a, b)| (a - b).abs() > SAME * largest) {
                    bail!(
                        "{path}: points {first} and {row}, counted from 0, are both at X = {place:?} and have other values; \
                         write one value for each node"
                    );
                }
            }
            if let (Some(to), Some(from)) = (&mut merged.volumes, &self.volumes) {
                to.resize(merged.reference.len() / dimension, 0.0);
                to[own[row]] += from[row];
            }
        }
        Ok(merged)
    }
}
