//! Upper bounds of eigenvalues of symmetric matrices whose entries are known within intervals.
//!
//! A matrix is its midpoint, in double precision, and a radius: adding a matrix moves no eigenvalue by more than its Frobenius
//! norm (Weyl). A few hundred operations round by less than 1e-12 of the norm; the bounds allow for 1e-9 of it, a thousand
//! times as much.

use mms_math::Scalar as _;

use mms_program::interval::Interval;

/// The allowance for rounding in a bound, relative to the bound.
pub(super) const ROUNDING: f64 = 1e-9;

/// The number of squarings of a matrix: tr (A^32)^(1/32) exceeds the largest eigenvalue by 3.5 % at most in three dimensions.
const SQUARINGS: u32 = 5;

/// The midpoints of intervals, and the Frobenius norm of their radii; infinite if one has no bounds.
pub fn split(entries: &[Interval]) -> (Vec<f64>, f64) {
    let middles: Vec<f64> = entries.iter().map(|entry| entry.middle()).collect();
    let radius = |(entry, middle): (&Interval, &f64)| {
        (entry.upper() - middle).max(middle - entry.lower()).powi(2)
    };
    let squares: f64 = entries.iter().zip(&middles).map(radius).sum();
    let is_bounded = entries.iter().all(|entry| entry.is_defined() && entry.farthest().is_finite());
    let radius = if is_bounded { squares.sqrt() * (1.0 + ROUNDING) } else { f64::INFINITY };
    (middles, radius)
}

/// An upper bound of the magnitudes of the eigenvalues of a symmetric row-major matrix.
pub fn spectral_radius(matrix: &[f64]) -> f64 {
    match matrix.len() {
        1 => radius_of::<1>(matrix),
        4 => radius_of::<2>(matrix),
        9 => radius_of::<3>(matrix),
        16 => radius_of::<4>(matrix),
        _ => radius_of::<9>(matrix),
    }
}

/// The spectral radius of a matrix of order N at most: rows and columns of zeros add an eigenvalue of 0.
fn radius_of<const N: usize>(matrix: &[f64]) -> f64 {
    let order = matrix.len().isqrt();
    let mut scale = 0.0_f64;
    for entry in matrix {
        scale = scale.max(entry.abs());
    }
    if scale == 0.0 || !scale.is_finite() {
        return scale;
    }
    let mut power = [[0.0; N]; N];
    for (row, entries) in matrix.chunks_exact(order).enumerate() {
        for (entry, value) in power[row].iter_mut().zip(entries) {
            *entry = value / scale;
        }
    }
    for _ in 0..SQUARINGS {
        power = squared(&power);
    }
    let mut trace = power[0][0];
    for k in 1..N {
        trace += power[k][k];
    }
    scale * trace.powf(1.0 / f64::from(1 << SQUARINGS)) * (1.0 + ROUNDING)
}

fn squared<const N: usize>(a: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut square = [[0.0; N]; N];
    for row in 0..N {
        for column in 0..N {
            let mut sum = a[row][0] * a[0][column];
            for k in 1..N {
                sum += a[row][k] * a[k][column];
            }
            square[row][column] = sum;
        }
    }
    square
}

fn product(a: &[f64], b: &[f64], order: usize) -> Vec<f64> {
    let entry = |row: usize, column: usize| -> f64 {
        (0..order).map(|k| a[row * order + k] * b[k * order + column]).sum()
    };
    (0..order * order).map(|k| entry(k / order, k % order)).collect()
}

/// Intervals that hold the eigenvalues of every symmetric matrix within these bounds, in ascending order.
///
/// With the midpoint M and the radii R, none is greater than the greatest of M + S R S, nor less than the least of M - S R S,
/// for the diagonal matrices S of signs (Hertz, IEEE Trans. Automat. Control 37, 1992); the eigenvalues between follow from
/// Weyl.
pub fn eigenvalues(entries: &[Interval]) -> Vec<Interval> {
    let (middles, radius) = split(entries);
    let scale = spectral_radius(&middles);
    let order = entries.len().isqrt();
    if !radius.is_finite() || !scale.is_finite() {
        return vec![Interval::UNDEFINED; order];
    }
    let rounding = (scale + radius) * ROUNDING;
    let around = |value: f64| Interval::new(value - radius - rounding, value + radius + rounding);
    let mut bounds: Vec<Interval> = diagonal(middles.clone()).into_iter().map(around).collect();
    if radius == 0.0 {
        return bounds;
    }
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    for signs in 0..1_u32 << (order - 1) {
        let is_opposite = |at: usize| (signs >> (at / order) ^ signs >> (at % order)) & 1 == 1;
        let moved = |sign: f64| -> Vec<f64> {
            let halves = entries.iter().map(|entry| entry.width() / 2.0).enumerate();
            let signed = halves.map(|(at, half)| if is_opposite(at) { -half } else { half });
            middles.iter().zip(signed).map(|(middle, half)| middle + sign * half).collect()
        };
        least = diagonal(moved(-1.0)).into_iter().fold(least, f64::min);
        greatest = diagonal(moved(1.0)).into_iter().fold(greatest, f64::max);
    }
    let all = Interval::new(least - rounding, greatest + rounding);
    bounds.iter_mut().for_each(|value| *value = value.meet(all));
    bounds
}

/// Intervals that hold the singular values of every square matrix within these bounds, in ascending
/// order.
pub fn singular_values(entries: &[Interval]) -> Vec<Interval> {
    let (middles, radius) = split(entries);
    let reach = |value: f64| Interval::new((value - radius).max(0.0), value + radius);
    let around = |square: Interval| {
        let root = square.meet(Interval::new(0.0, f64::INFINITY)).sqrt();
        Interval::new(reach(root.lower()).lower(), reach(root.upper()).upper())
    };
    eigenvalues(&exactly(&gram(&middles))).into_iter().map(around).collect()
}

fn exactly(numbers: &[f64]) -> Vec<Interval> {
    numbers.iter().copied().map(Interval::from_f64).collect()
}

/// A^T A.
fn gram(matrix: &[f64]) -> Vec<f64> {
    product(&transposed(matrix), matrix, matrix.len().isqrt())
}

fn transposed(matrix: &[f64]) -> Vec<f64> {
    let order = matrix.len().isqrt();
    (0..matrix.len()).map(|at| matrix[at % order * order + at / order]).collect()
}

/// The eigenvalues of a symmetric matrix of numbers, by rotations that make one entry after the
/// other vanish (Jacobi 1846; Golub & Van Loan, Matrix Computations, 2013, section 8.5).
pub(super) fn diagonal(mut matrix: Vec<f64>) -> Vec<f64> {
    const SWEEPS: usize = 12;
    let order = matrix.len().isqrt();
    for _ in 0..SWEEPS {
        for (p, q) in (0..order).flat_map(|p| (p + 1..order).map(move |q| (p, q))) {
            let off = matrix[p * order + q];
            if off == 0.0 {
                continue;
            }
            let angle = 0.5 * (2.0 * off).atan2(matrix[q * order + q] - matrix[p * order + p]);
            let (sine, cosine) = angle.sin_cos();
            for k in 0..order {
                let (a, b) = (matrix[k * order + p], matrix[k * order + q]);
                matrix[k * order + p] = cosine * a - sine * b;
                matrix[k * order + q] = sine * a + cosine * b;
            }
            for k in 0..order {
                let (a, b) = (matrix[p * order + k], matrix[q * order + k]);
                matrix[p * order + k] = cosine * a - sine * b;
                matrix[q * order + k] = sine * a + cosine * b;
            }
        }
    }
    let mut values: Vec<f64> = (0..order).map(|k| matrix[k * order + k]).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// An upper bound of sqrt(tr (C^-1 A C^-1 A)) for symmetric C and A within these bounds, if no eigenvalue of C is less than
/// `floor` > 0.
///
/// With the midpoint M of C, let r be the largest change from an eigenvalue of M to one of C, and m the least eigenvalue of M.
/// Then C >= (1 - r/m) M in the order of forms, so that the value is at most (|M^-1/2 B M^-1/2| + |A - B|/m)/(1 - r/m) with the
/// midpoint B of A; and at most |A|/floor.
pub fn largest_relative_rate(form: &[Interval], rate: &[Interval], floor: f64) -> f64 {
    let order = form.len().isqrt();
    let ((form, spread), (rate, change)) = (split(form), split(rate));
    if !spread.is_finite() || !change.is_finite() {
        return f64::INFINITY;
    }
    let coarse = (norm(&rate) + change) / floor * (1.0 + ROUNDING);
    let eigenvalues = diagonal(form.clone());
    let least = eigenvalues.into_iter().fold(f64::INFINITY, f64::min) * (1.0 - ROUNDING);
    let share = 1.0 - spread / least;
    if least <= 0.0 || share <= 0.0 {
        return coarse;
    }
    let relative = inverse_times(&form, &rate, order);
    let square = product(&relative, &relative, order);
    let trace: f64 = (0..order).map(|k| square[k * order + k]).sum();
    let sharp = (trace.max(0.0).sqrt() + change / least) / share * (1.0 + ROUNDING);
    sharp.min(coarse)
}

/// An upper bound of |sym(A F^-1)| for A and F within these bounds, if no singular value of F is less than `floor` > 0.
///
/// With the midpoints B and M, L = A F^-1 is L = B M^-1 + ((A - B) - L (F - M)) M^-1, so that it differs from B M^-1 by at most
/// (|A - B| + |L| |F - M|)/m with the least singular value m of M; and |L| by the same rule is at most (|B M^-1| + |A -
/// B|/m)/(1 - |F - M|/m), and at most |A|/floor.
pub fn largest_rate(form: &[Interval], rate: &[Interval], floor: f64) -> f64 {
    let order = form.len().isqrt();
    let (form_radii, rate_radii) = (radii(form), radii(rate));
    let ((form, spread), (rate, change)) = (split(form), split(rate));
    if !spread.is_finite() || !change.is_finite() {
        return f64::INFINITY;
    }
    let coarse = (norm(&rate) + change) / floor * (1.0 + ROUNDING);
    let square = gram(&form);
    let least = eigenvalues(&exactly(&square)).first().map_or(0.0, |square| square.lower());
    if least <= 0.0 {
        return coarse;
    }
    let least = least.sqrt() * (1.0 - ROUNDING);
    // M^-1 = (M^T M)^-1 M^T.
    let inverse = inverse_times(&square, &transposed(&form), order);
    let gradient = product(&rate, &inverse, order);
    let share = 1.0 - spread / least;
    let whole = if share > 0.0 { (norm(&gradient) + change / least) / share } else { coarse };
    let excess = (change + whole.min(coarse) * spread) / least;
    // The bound by entries: each entry of L is at most the entry of B M^-1 plus the excess.
    let size = |matrix: &[f64]| matrix.iter().map(|entry| entry.abs()).collect::<Vec<_>>();
    let reach: Vec<f64> = gradient.iter().map(|entry| entry.abs() + excess).collect();
    let carried = product(&reach, &form_radii, order);
    let changed: Vec<f64> = rate_radii.iter().zip(carried).map(|(a, b)| a + b).collect();
    let changed = product(&changed, &size(&inverse), order);
    let symmetric = |matrix: &[f64]| -> Vec<f64> {
        matrix.iter().zip(transposed(matrix)).map(|(a, b)| (a + b) / 2.0).collect()
    };
    let pairs = size(&symmetric(&gradient)).into_iter().zip(symmetric(&changed));
    let sharp: Vec<f64> = pairs.map(|(value, change)| value + change).collect();
    (norm(&sharp) * (1.0 + ROUNDING)).min(coarse)
}

/// The largest distances of the entries from their midpoints.
fn radii(entries: &[Interval]) -> Vec<f64> {
    entries.iter().map(|entry| entry.width() / 2.0 * (1.0 + ROUNDING)).collect()
}

/// The Frobenius norm of a matrix.
fn norm(matrix: &[f64]) -> f64 {
    matrix.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// A^-1 B of symmetric positive A, by elimination.
fn inverse_times(a: &[f64], b: &[f64], order: usize) -> Vec<f64> {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    for pivot in 0..order {
        let divisor = a[pivot * order + pivot];
        for row in (0..order).filter(|row| *row != pivot) {
            let share = a[row * order + pivot] / divisor;
            for column in 0..order {
                a[row * order + column] -= share * a[pivot * order + column];
                b[row * order + column] -= share * b[pivot * order + column];
            }
        }
    }
    (0..order * order).map(|at| b[at] / a[at / order * (order + 1)]).collect()
}

/// An upper bound of m_i N_J A_iJkL m_k N_L for unit vectors m and N, where A, row-major in (i, J) and (k, L), lies within
/// these bounds: the largest eigenvalue of the acoustic tensors.
///
/// The acoustic tensor is evaluated on a grid of directions N. Let d be the largest angle between a direction and the nearest
/// of the grid, and M and m the extrema of the quadratic form in N over the great circle through both. Then the extrema q and p
/// on the grid satisfy q >= M cos^2 d + m sin^2 d and p <= m cos^2 d + M sin^2 d, so that M <= (q cos^2 d - p sin^2 d)/(cos^2
/// d - sin^2 d).
pub fn largest_acoustic(grid: &Grid, entries: &[Interval]) -> f64 {
    let (tensor, radius) = split(entries);
    if !radius.is_finite() {
        return f64::INFINITY;
    }
    let [greatest, least] = match grid.dimension {
        1 => extrema::<1>(grid, &tensor),
        2 => extrema::<2>(grid, &tensor),
        _ => extrema::<3>(grid, &tensor),
    };
    let (near, far) = (1.0 - grid.sine_squared, grid.sine_squared);
    let bound = (greatest * near - least * far) / (near - far);
    bound * (1.0 + ROUNDING) + radius.min(largest_change(entries))
}

/// The greatest and the least eigenvalue of the acoustic tensors on the grid.
fn extrema<const D: usize>(grid: &Grid, tensor: &[f64]) -> [f64; 2] {
    let (mut greatest, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
    for direction in &grid.directions {
        let mut acoustic = acoustic::<D>(tensor, direction);
        let upper = radius_of::<D>(acoustic.as_flattened());
        for row in 0..D {
            for column in 0..D {
                acoustic[row][column] = -acoustic[row][column];
            }
            acoustic[row][row] += upper;
        }
        greatest = greatest.max(upper);
        least = least.min(upper - radius_of::<D>(acoustic.as_flattened()));
    }
    [greatest, least]
}

/// An upper bound of the change of v A v for unit vectors v while A stays within these bounds.
fn largest_change(entries: &[Interval]) -> f64 {
    let radii = radii(entries);
    let pairs = radii.iter().zip(transposed(&radii));
    spectral_radius(&pairs.map(|(a, b)| (a + b) / 2.0).collect::<Vec<_>>())
}

/// The symmetric part of A_iJkL N_J N_L.
fn acoustic<const D: usize>(tensor: &[f64], normal: &[f64; 3]) -> [[f64; D]; D] {
    let order = D * D;
    let mut whole = [[0.0; D]; D];
    for i in 0..D {
        for k in 0..D {
            for j in 0..D {
                for l in 0..D {
                    let entry = tensor[(i * D + j) * order + k * D + l];
                    whole[i][k] += entry * normal[j] * normal[l];
                }
            }
        }
    }
    let mut symmetric = whole;
    for i in 0..D {
        for k in 0..D {
            symmetric[i][k] = (whole[i][k] + whole[k][i]) / 2.0;
        }
    }
    symmetric
}

/// Unit vectors, and the squared sine of the largest angle between any direction and the nearest of them or of their opposites.
pub struct Grid {
    dimension: usize,
    directions: Vec<[f64; 3]>,
    sine_squared: f64,
}

impl Grid {
    /// The grid of directions in a line, a plane or space.
    pub fn new(dimension: usize) -> Self {
        let (directions, sine_squared) = match dimension {
            1 => (vec![[1.0, 0.0, 0.0]], 0.0),
            2 => {
                const COUNT: u32 = 8;
                let step = std::f64::consts::PI / f64::from(COUNT);
                let at = |k| [(step * f64::from(k)).cos(), (step * f64::from(k)).sin(), 0.0];
                let sine_squared = (step / 2.0).sin().powi(2) * (1.0 + ROUNDING);
                ((0..COUNT).map(at).collect(), sine_squared)
            }
            _ => {
                // Points on three faces of a cube, 1/2 apart. On a face the point farthest from all of them is the middle of
                // the four about the centre: tan^2 = 1/8, sin^2 = 1/9.
                let steps = [-1.0, -0.5, 0.0, 0.5, 1.0];
                let mut directions = Vec::new();
                for axis in 0..3 {
                    for (a, b) in steps.iter().flat_map(|a| steps.map(|b| (*a, b))) {
                        let length = f64::sqrt(1.0 + a * a + b * b);
                        let mut direction = [0.0; 3];
                        direction[axis] = 1.0 / length;
                        direction[(axis + 1) % 3] = a / length;
                        direction[(axis + 2) % 3] = b / length;
                        directions.push(direction);
                    }
                }
                (directions, (1.0 + ROUNDING) / 9.0)
            }
        };
        Grid { dimension, directions, sine_squared }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hertz bounds the extreme eigenvalues, and Weyl the others.
    #[test]
    fn eigenvalues_of_intervals_are_sharp_at_the_ends() {
        let [one, three] = [1.0, 3.0].map(|middle| Interval::new(middle - 0.125, middle + 0.125));
        let zero = Interval::from_f64(0.0);
        let bounds = eigenvalues(&[one, zero, zero, three]);
        let weyl = 0.125 * 2.0_f64.sqrt();
        let expected = [[0.875, 1.0 + weyl], [3.0 - weyl, 3.125]];
        for (bound, [lower, upper]) in bounds.into_iter().zip(expected) {
            assert!((bound.lower() - lower).abs() < 1e-7, "{bound:?}");
            assert!((bound.upper() - upper).abs() < 1e-7, "{bound:?}");
        }
    }

    /// The matrix of ones has the eigenvalues 0 and its order.
    #[test]
    fn a_matrix_of_every_order_has_its_eigenvalues() {
        for order in 1..=9_usize {
            let greatest = order as f64;
            let ones = vec![1.0; order * order];
            let radius = spectral_radius(&ones);
            assert!((greatest..greatest * (1.0 + 1e-8)).contains(&radius), "{order}: {radius}");
            let bounds = eigenvalues(&exactly(&ones));
            assert_eq!(bounds.len(), order);
            for (place, bound) in bounds.into_iter().enumerate() {
                let value = if place + 1 == order { greatest } else { 0.0 };
                assert!(bound.lower() <= value && value <= bound.upper(), "{order}: {bound:?}");
                assert!(bound.width() < 1e-7, "{order}: {bound:?}");
            }
        }
    }

    /// The rates of a C and of an F with exact entries, by hand.
    #[test]
    fn rates_of_numbers_are_those_numbers() {
        let near = |bound: f64, value: f64| (value..value * (1.0 + 1e-8)).contains(&bound);
        // C^-1 A has the rows (1/2, 3/4) and (1/3, -1/9).
        let [form, rate] = [[4.0, 0.0, 0.0, 9.0], [2.0, 3.0, 3.0, -1.0]].map(|m| exactly(&m));
        let relative = f64::sqrt(1.0 / 4.0 + 2.0 * 3.0 / 4.0 / 3.0 + 1.0 / 81.0);
        let bound = largest_relative_rate(&form, &rate, 0.1);
        assert!(near(bound, relative), "{bound} {relative}");
        // A F^-1 has the rows (1, 1) and (3/2, -1/3).
        let bound = largest_rate(&exactly(&[2.0, 0.0, 0.0, 3.0]), &rate, 0.1);
        let symmetric = f64::sqrt(1.0 + 2.0 * 1.25 * 1.25 + 1.0 / 9.0);
        assert!(near(bound, symmetric), "{bound} {symmetric}");
    }
}
