//! Smooth functions on a body: polynomials up to a total degree, products of Legendre polynomials along the axes.

use mms_runtime::Vector;
use mms_runtime::body::bounding_box;
use mms_runtime::nalgebra::{DMatrix, DVector, Dyn, SVD};
use mms_runtime::{Body, Refusal};

/// Polynomials on the box around a body.
#[derive(Clone, Debug)]
pub struct Smooth<const D: usize> {
    lower: Vector<f64, D>,
    upper: Vector<f64, D>,
    /// The degree along each axis, of each function.
    degrees: Vec<[usize; D]>,
}

/// The least number of points for each function.
const POINTS: usize = 3;
/// The relative singular value below which points do not separate functions.
const RANK: f64 = 1e-6;

impl<const D: usize> Smooth<D> {
    /// Sets up as many functions as this number of points can tell apart, up to the degrees `most` for one to three dimensions.
    ///
    /// # Errors
    /// A body without extent.
    pub fn new(body: &Body<f64, D>, points: usize, most: [usize; 3]) -> Result<Self, Refusal> {
        let [lower, upper] = bounding_box(body)?;
        let degree =
            (0..=most[D - 1]).rev().find(|degree| POINTS * degrees::<D>(*degree).len() <= points);
        Ok(Smooth { lower, upper, degrees: degrees(degree.unwrap_or(0)) })
    }

    /// The number of functions.
    pub fn count(&self) -> usize {
        self.degrees.len()
    }

    /// The values of all functions at X.
    pub fn values(&self, x: &Vector<f64, D>) -> Vec<f64> {
        let along = self.along(x);
        let value =
            |degrees: &[usize; D]| (0..D).map(|axis| along[axis][degrees[axis]].0).product();
        self.degrees.iter().map(value).collect()
    }

    /// The gradients of all functions at X.
    pub fn gradients(&self, x: &Vector<f64, D>) -> Vec<Vector<f64, D>> {
        let along = self.along(x);
        let gradient = |degrees: &[usize; D]| {
            Vector::from_fn(|axis, _| {
                let factor = |other: usize| {
                    let (value, slope) = along[other][degrees[other]];
                    if other == axis { slope } else { value }
                };
                (0..D).map(factor).product::<f64>()
            })
        };
        self.degrees.iter().map(gradient).collect()
    }

    /// Value and slope of each degree along each axis.
    fn along(&self, x: &Vector<f64, D>) -> [Vec<(f64, f64)>; D] {
        let most = self.degrees.iter().flatten().copied().max().unwrap_or(0);
        std::array::from_fn(|axis| {
            let edge = self.upper[axis] - self.lower[axis];
            let at = 2.0 * (x[axis] - self.lower[axis]) / edge - 1.0;
            legendre(most, at).into_iter().map(|(p, slope)| (p, slope * 2.0 / edge)).collect()
        })
    }

    /// Sets up the fit of values at points.
    pub fn fitting(&self, points: &[Vector<f64, D>]) -> Fitting {
        let rows: Vec<f64> = points.iter().flat_map(|x| self.values(x)).collect();
        let matrix = DMatrix::from_row_slice(points.len(), self.count(), &rows);
        let transposed = matrix.transpose();
        // By the normal equations, which have one row per function.
        let normal = &transposed * &matrix;
        let rank = RANK * RANK * normal.norm();
        Fitting { matrix, transposed, normal: normal.svd(true, true), rank }
    }
}

/// Finds the functions nearest to values at some points.
pub struct Fitting {
    /// The values of the functions at the points, and the transposed matrix.
    matrix: DMatrix<f64>,
    transposed: DMatrix<f64>,
    /// The product of both.
    normal: SVD<f64, Dyn, Dyn>,
    /// The size up to which singular values count as 0.
    rank: f64,
}

impl Fitting {
    /// Finds the coefficients of the functions nearest to values at the points, component by component; and the part of the
    /// squared values that these functions represent.
    pub fn fit(&self, values: &[f64]) -> (Vec<f64>, f64) {
        let (points, count) = self.matrix.shape();
        let components = values.len() / points.max(1);
        let right = DMatrix::from_row_slice(points, components, values);
        let solved = self.normal.solve(&(&self.transposed * &right), self.rank);
        let coefficients = solved.unwrap_or(DMatrix::zeros(count, components));
        let missed = (&right - &self.matrix * &coefficients).norm_squared();
        let all = right.norm_squared();
        let share = if all > 0.0 { 1.0 - missed / all } else { 1.0 };
        (coefficients.as_slice().to_vec(), share)
    }
}

/// All combinations of degrees along the axes whose sum is at most `most`.
fn degrees<const D: usize>(most: usize) -> Vec<[usize; D]> {
    let count = (most + 1).pow(D as u32);
    let digits = |number: usize| {
        std::array::from_fn(|axis| number / (most + 1).pow(axis as u32) % (most + 1))
    };
    (0..count).map(digits).filter(|it: &[usize; D]| it.iter().sum::<usize>() <= most).collect()
}

/// Legendre polynomials of mean square 1 on [-1, 1], and their slopes.
pub(crate) fn legendre(most: usize, x: f64) -> Vec<(f64, f64)> {
    let mut all = vec![(1.0, 0.0), (x, 1.0)];
    for n in 1..most {
        let (n, (p, dp), (q, dq)) = (n as f64, all[n], all[n - 1]);
        let next = ((2.0 * n + 1.0) * x * p - n * q) / (n + 1.0);
        let slope = ((2.0 * n + 1.0) * (p + x * dp) - n * dq) / (n + 1.0);
        all.push((next, slope));
    }
    all.truncate(most + 1);
    let scaled = |(n, (p, dp)): (usize, (f64, f64))| {
        let size = (2.0 * n as f64 + 1.0).sqrt();
        (p * size, dp * size)
    };
    all.into_iter().enumerate().map(scaled).collect()
}

/// The coefficients c for which the sum of c times some columns is nearest to a vector. For columns that are 0 or depend on
/// others, the smallest such coefficients.
pub fn nearest(columns: &[Vec<f64>], to: &[f64]) -> Vec<f64> {
    if columns.is_empty() {
        return Vec::new();
    }
    let matrix = DMatrix::from_fn(to.len(), columns.len(), |row, column| columns[column][row]);
    let scales: Vec<f64> =
        columns.iter().map(|column| size(column).max(f64::MIN_POSITIVE)).collect();
    let scaled = DMatrix::from_fn(to.len(), columns.len(), |row, column| {
        matrix[(row, column)] / scales[column]
    });
    let solved = scaled.svd(true, true).solve(&DVector::from_column_slice(to), 1e-10);
    let found = solved.unwrap_or(DVector::zeros(columns.len()));
    found.iter().zip(scales).map(|(c, scale)| c / scale).collect()
}

/// The length of a vector.
pub fn size(vector: &[f64]) -> f64 {
    vector.iter().map(|it| it * it).sum::<f64>().sqrt()
}

/// One vector less another times a factor.
pub fn less(a: &[f64], factor: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - factor * b).collect()
}
