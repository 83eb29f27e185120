//! Values of a point cloud at other points, by moving least squares: locally, a polynomial of second degree.
//!
//! Errors are compared at the same points, so that smooth functions capture the same part of each.

use std::collections::HashMap;

use mms_runtime::Vector;
use mms_runtime::nalgebra::{DMatrix, DVector};

/// The radius around a point within which values count, divided by the spacing of the cloud.
const RADIUS: f64 = 3.2;

/// The map from values of a cloud to values at points: for each point, weights of some values.
#[derive(Clone, Debug, Default)]
pub struct Sampling(Vec<Vec<(usize, f64)>>);

impl Sampling {
    /// The map from a cloud to points; `measure` is the length, area or volume of the body.
    pub fn new<const D: usize>(
        cloud: &[Vector<f64, D>],
        points: &[Vector<f64, D>],
        measure: f64,
    ) -> Self {
        let spacing = (measure / cloud.len().max(1) as f64).powf(1.0 / D as f64);
        let radius = RADIUS * spacing;
        let cells = Cells::new(cloud, radius);
        Sampling(points.iter().map(|x| weights(cloud, &cells.near(x), x, radius)).collect())
    }

    /// The values at the points, from values of the cloud, both point by point.
    pub fn values(&self, of_cloud: &[f64], components: usize) -> Vec<f64> {
        let one = |terms: &Vec<(usize, f64)>, component: usize| -> f64 {
            terms.iter().map(|(at, weight)| weight * of_cloud[at * components + component]).sum()
        };
        let each = self.0.iter();
        each.flat_map(|terms| (0..components).map(|component| one(terms, component))).collect()
    }
}

/// A cloud sorted into cubes with edges of one length.
struct Cells<const D: usize> {
    edge: f64,
    members: HashMap<[i64; D], Vec<usize>>,
}

impl<const D: usize> Cells<D> {
    fn new(cloud: &[Vector<f64, D>], edge: f64) -> Self {
        let mut cells = Cells { edge, members: HashMap::new() };
        for (at, x) in cloud.iter().enumerate() {
            cells.members.entry(cells.of(x)).or_default().push(at);
        }
        cells
    }

    fn of(&self, x: &Vector<f64, D>) -> [i64; D] {
        std::array::from_fn(|axis| (x[axis] / self.edge).floor() as i64)
    }

    /// The members that may be within an edge of a point.
    fn near(&self, x: &Vector<f64, D>) -> Vec<usize> {
        let middle = self.of(x);
        let neighbour = |number: usize| {
            let step = |axis: usize| (number / 3usize.pow(axis as u32) % 3) as i64 - 1;
            std::array::from_fn(|axis| middle[axis] + step(axis))
        };
        let found = (0..3usize.pow(D as u32)).filter_map(|it| self.members.get(&neighbour(it)));
        found.flatten().copied().collect()
    }
}

/// The monomials up to second degree: 1, the coordinates, and their products.
fn polynomial<const D: usize>(x: &Vector<f64, D>) -> Vec<f64> {
    let squares = (0..D).flat_map(|i| (0..=i).map(move |j| x[i] * x[j]));
    std::iter::once(1.0).chain(x.iter().copied()).chain(squares).collect()
}

/// The weights of the values near X; if there are too few, the nearest value alone.
fn weights<const D: usize>(
    cloud: &[Vector<f64, D>],
    near: &[usize],
    x: &Vector<f64, D>,
    radius: f64,
) -> Vec<(usize, f64)> {
    let offset = |at: &usize| (cloud[*at] - x) / radius;
    let near: Vec<usize> = near.iter().copied().filter(|at| offset(at).norm() < 1.0).collect();
    let count = polynomial(&Vector::<f64, D>::zeros()).len();
    let basis =
        DMatrix::from_fn(near.len(), count, |row, column| polynomial(&offset(&near[row]))[column]);
    let weight =
        DVector::from_fn(near.len(), |row, _| (1.0 - offset(&near[row]).norm_squared()).powi(2));
    let weighed =
        DMatrix::from_fn(near.len(), count, |row, column| weight[row] * basis[(row, column)]);
    let normal = basis.transpose() * &weighed;
    // The value of the polynomial at the point is its first coefficient.
    let first = DVector::from_fn(count, |row, _| if row == 0 { 1.0 } else { 0.0 });
    let solved = normal.cholesky().map(|it| weighed * it.solve(&first));
    match solved.filter(|it| it.iter().all(|it| it.is_finite())) {
        Some(found) => near.into_iter().zip(found.iter().copied()).collect(),
        None => nearest(cloud, x).map_or(Vec::new(), |at| vec![(at, 1.0)]),
    }
}

fn nearest<const D: usize>(cloud: &[Vector<f64, D>], x: &Vector<f64, D>) -> Option<usize> {
    let away = |at: &usize| (cloud[*at] - x).norm_squared();
    (0..cloud.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_second_degree_are_met_at_any_points() {
        let lattice = |k: usize| Vector::<f64, 2>::new((k % 9) as f64 + 0.5, (k / 9) as f64 + 0.5);
        let cloud: Vec<_> = (0..81).map(lattice).map(|x| x / 9.0).collect();
        let of = |x: &Vector<f64, 2>| [1.0 + x[0] - 2.0 * x[1] * x[0], 3.0 * x[1] * x[1] - x[0]];
        let values: Vec<f64> = cloud.iter().flat_map(of).collect();
        // Corners, sides and the inside.
        let points: Vec<_> =
            (0..36).map(|k| Vector::<f64, 2>::new((k % 6) as f64, (k / 6) as f64) / 5.0).collect();
        let found = Sampling::new(&cloud, &points, 1.0).values(&values, 2);
        let right: Vec<f64> = points.iter().flat_map(of).collect();
        assert!(found.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }

    #[test]
    fn a_cloud_that_is_too_thin_gives_its_nearest_value() {
        let cloud = [Vector::<f64, 2>::new(0.2, 0.2), Vector::<f64, 2>::new(0.8, 0.8)];
        let found = Sampling::new(&cloud, &[Vector::<f64, 2>::new(0.7, 0.6)], 1.0);
        assert_eq!(found.values(&[3.0, 5.0], 1), [5.0]);
    }
}
