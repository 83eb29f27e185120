//! Norms over cells: l2 and h1 by quadrature, l1 and linf by a polynomial that interpolates the errors at its points.
//!
//! The length of an error has a kink where the error is 0, and its maximum may be on an edge. A quadrature with few points
//! misses both: l1 would be 7 % too small, linf 12 %. So the errors at the Gauss points, a grid in the unit cube from which
//! each kind of cell is made, are interpolated by a polynomial along each axis. Its values on a finer grid need no exact
//! solution: they are interpolated axis by axis, and integrated for l1 in cells where errors point to more than one side. The
//! maximum is searched only in cells that may have a larger error than the largest known one. Finally, the exact solution is
//! evaluated where the polynomials have their largest values.

use crate::Mistake;
use crate::cell::{CellShape, Local, gauss};
use crate::mesh::Mesh;
use crate::norm::{Norms, lengths};

mod interpolation;

use interpolation::Interpolation;

/// A part of the exact solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolutionPart {
    /// The values of the quantity, point by point.
    Values,
    /// The derivatives of the quantity by X, row by row: for each component, as many numbers as there are dimensions. On a
    /// meridian, the nine entries of the displacement gradient in R, Z and theta.
    Gradients,
}

/// Evaluates the exact solution at places X, which are listed point by point.
pub type Exact<'a> = &'a mut dyn FnMut(SolutionPart, &[f64]) -> Result<Vec<f64>, Mistake>;

/// The values at the points of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Carried<'a> {
    /// Numbers of all points.
    pub values: &'a [f64],
    /// The number of components of a point.
    pub components: usize,
    /// Whether the error of the gradient is computed, too.
    pub has_gradient: bool,
}

/// The norms of an error over the body.
#[derive(Clone, Debug, PartialEq)]
pub struct OverCells {
    /// The error.
    pub value: Norms,
    /// The place X of the largest error.
    pub place: Vec<f64>,
    /// The seminorm of H1, over the root of the body's measure; 0 if it was not requested.
    pub h1: f64,
}

/// The number of quadrature points in a batch.
const BATCH: usize = 8192;

/// The number of parts into which an axis is divided to integrate l1, by dimension; each part has two Gauss points. Cells of a
/// degree above 2 have several times as many parts, because their errors have more waves.
const PARTS: [usize; 3] = [64, 8, 6];
/// The number of parts into which an axis is divided to search the maximum, by dimension; the error is computed at their ends.
const STEPS: [usize; 3] = [64, 12, 6];

/// The largest ratio of the error anywhere in a cell to the error at its quadrature points.
const BETWEEN: f64 = 1.5;
/// A point of the grid over a cell is a peak, from which the maximum is searched, if its error is at least this fraction of the
/// largest on the grid.
const HIGH: f64 = 0.9;
/// Peaks above this fraction of the largest peak are evaluated with the exact solution.
const NEAR: f64 = 0.97;
/// The largest number of peaks that are evaluated with the exact solution.
const COMPARED: usize = 512;
/// The number of rounds in which a peak is improved.
const ROUNDS: usize = 10;
/// The ratio of the step of a round to the step of the round before.
const SHRINKS: f64 = 0.7;

/// A square matrix of one to three rows, completed by the unit matrix to three.
type Matrix = [[f64; 3]; 3];

/// The functions of a kind of cell at a quadrature point.
struct QuadraturePoint {
    weight: f64,
    /// The ratio of a volume in the reference cell to the volume in the unit cube, at the point.
    factor: f64,
    functions: Vec<f64>,
    /// The derivatives along the axes of the cell.
    slopes: [Vec<f64>; 3],
}

/// A kind of cell with its quadrature, and with matrices for interpolation along an axis.
struct QuadratureRule {
    shape: &'static CellShape,
    points: Vec<QuadraturePoint>,
    fine: Interpolation,
    ends: Interpolation,
    /// The number of parts of an axis in the search for the maximum.
    steps: usize,
}

impl QuadratureRule {
    /// A rule with `count` points along an axis.
    fn new(shape: &'static CellShape, count: usize) -> Self {
        let (dimension, along) = (shape.dimension, gauss(count));
        let knots: Vec<f64> = along.iter().map(|it| it.0).collect();
        let finer = (shape.highest() as usize).div_ceil(2).max(1);
        let parts = finer * PARTS[dimension - 1];
        let in_parts = |places: &[(f64, f64)]| -> Vec<(f64, f64)> {
            let part = |at: usize| {
                places.iter().map(move |(x, w)| ((at as f64 + x) / parts as f64, w / parts as f64))
            };
            (0..parts).flat_map(part).collect()
        };
        let steps = finer * STEPS[dimension - 1];
        let ends = (0..=steps).map(|at| (at as f64 / steps as f64, 0.0)).collect();
        let quadrature = Interpolation::new(&knots, along);
        let point = |index: usize| {
            let (cube, weight) = quadrature.point(index, dimension);
            let (at, factor) = shape.of_cube(cube);
            let slopes = |axis: usize| match axis < dimension {
                true => shape.derivatives(at, axis),
                false => Vec::new(),
            };
            let slopes = [slopes(0), slopes(1), slopes(2)];
            QuadraturePoint { weight, factor, functions: shape.values(at), slopes }
        };
        QuadratureRule {
            shape,
            points: (0..knots.len().pow(dimension as u32)).map(point).collect(),
            fine: Interpolation::new(&knots, in_parts(&gauss(2))),
            ends: Interpolation::new(&knots, ends),
            steps,
        }
    }

    /// The position of a kind of cell in the list of known ones, to which it is added if it is new.
    fn among(known: &mut Vec<QuadratureRule>, shape: &'static CellShape, count: usize) -> usize {
        let found = known.iter().position(|it| std::ptr::eq(it.shape, shape));
        found.unwrap_or_else(|| {
            known.push(QuadratureRule::new(shape, count));
            known.len() - 1
        })
    }
}

/// The quadrature points of some cells, and the values computed there.
#[derive(Default)]
struct Batch {
    /// Each cell, and the position of its rule.
    cells: Vec<(usize, usize)>,
    places: Vec<f64>,
    weights: Vec<f64>,
    /// The volume around a point divided by its weight in the cube.
    densities: Vec<f64>,
    values: Vec<f64>,
    gradients: Vec<f64>,
    /// The values at the nodes of a cell.
    nodes: Vec<f64>,
}

/// A place in a cell where its error is large.
#[derive(Clone, Copy)]
struct Peak {
    error: f64,
    cell: usize,
    rule: usize,
    /// The place in the cube from which the next round searches.
    search_from: Local,
    /// The place in the cube at which `error` was computed.
    best_place: Local,
}

/// The sums and the largest errors so far.
#[derive(Default)]
struct Totals {
    volume: f64,
    first: f64,
    second: f64,
    gradient: f64,
    /// The largest error confirmed by the exact solution, and its cell.
    largest: (f64, usize),
    /// The largest error of a polynomial.
    best: f64,
    peaks: Vec<Peak>,
    /// Buffers for the work on a cell.
    room: [Vec<f64>; 2],
    numbers: Vec<f64>,
}

impl Mesh<'_> {
    /// The volume of each point: the integral of its function over the cells, as in a lumped mass; on a meridian per radian.
    ///
    /// # Errors
    /// A cell that is flat, or turned inside out.
    pub fn volumes(&self) -> Result<Vec<f64>, Mistake> {
        let mut volumes = vec![0.0; self.points.len() / self.dimension];
        let none = Carried { values: &[], components: 0, has_gradient: false };
        let mut rules = Vec::new();
        let mut batch = Batch::default();
        for (cell, shape, points) in self.full() {
            if !shape.has_functions() {
                let (area, middle) = self.polygon(points);
                if area == 0.0 || !area.is_finite() {
                    return Err(Mistake::new(format!("cell {cell} is flat: its area is {area:e}")));
                }
                // The volume is divided equally among the points, because no functions are known.
                let part = area.abs() * self.radius(&middle) / points.len() as f64;
                points.iter().for_each(|&point| volumes[point] += part);
                continue;
            }
            // Exact for the function of a point times the volume of a cell with straight edges, and for the volume of a cell
            // with curved edges. The radius adds one degree.
            let degree = shape.highest() as usize + usize::from(self.is_meridian);
            let rule = QuadratureRule::among(&mut rules, shape, (degree + 2).max(2 * degree));
            batch.clear();
            self.place(&mut batch, cell, &rules[rule], points, none)?;
            for (weight, at) in batch.weights.iter().zip(&rules[rule].points) {
                let parts = points.iter().zip(&at.functions);
                parts.for_each(|(&point, value)| volumes[point] += weight * value);
            }
        }
        Ok(volumes)
    }

    /// The ratio of the body's volume to the mesh's volume at a place: the radius on a meridian.
    fn radius(&self, place: &[f64]) -> f64 {
        if self.is_meridian { place[0] } else { 1.0 }
    }

    /// The norms over the body of the error of the values at its points.
    ///
    /// # Errors
    /// A cell that is flat, or turned inside out; errors of the exact solution.
    pub fn measure(&self, carried: Carried<'_>, exact: Exact<'_>) -> Result<OverCells, Mistake> {
        let mut totals = Totals::default();
        let mut rules: Vec<QuadratureRule> = Vec::new();
        let mut batch = Batch::default();
        for (cell, shape, points) in self.full() {
            if !shape.has_functions() {
                return Err(Mistake::new(format!(
                    "cell {cell} is a polygon: what is between its points is not known"
                )));
            }
            let rule = QuadratureRule::among(&mut rules, shape, shape.along());
            self.place(&mut batch, cell, &rules[rule], points, carried)?;
            batch.cells.push((cell, rule));
            if batch.weights.len() >= BATCH {
                self.add(&mut totals, &mut batch, &rules, carried, exact)?;
            }
        }
        self.add(&mut totals, &mut batch, &rules, carried, exact)?;
        if totals.volume.is_nan() || totals.volume <= 0.0 {
            return Err(Mistake::new("no cell of the dimension of the field"));
        }
        let place = self.climb(&mut totals, &rules, carried, exact)?;
        let (linf, at) = totals.largest;
        let root = |sum: f64| (sum / totals.volume).sqrt();
        let value = Norms { l1: totals.first / totals.volume, l2: root(totals.second), linf, at };
        Ok(OverCells { value, place, h1: root(totals.gradient) })
    }

    /// Adds the points of quadrature of a cell to a batch.
    fn place(
        &self,
        batch: &mut Batch,
        cell: usize,
        rule: &QuadratureRule,
        points: &[usize],
        Carried { values, components, has_gradient }: Carried<'_>,
    ) -> Result<(), Mistake> {
        let dimension = self.dimension;
        // X and the values, node by node.
        let size = dimension + components;
        let own = |&point: &usize| {
            let carried = &values[point * components..][..components];
            self.point(point).iter().chain(carried).copied()
        };
        batch.nodes.clear();
        batch.nodes.extend(points.iter().flat_map(own));
        // The values at a point, and their derivatives along the axes of the cell.
        let mut sums = vec![0.0; 4 * size];
        let mut sign = 0.0;
        for QuadraturePoint { weight, factor, functions, slopes } in &rule.points {
            sums.fill(0.0);
            let by = [functions, &slopes[0], &slopes[1], &slopes[2]];
            for (by, sums) in by.into_iter().zip(sums.chunks_exact_mut(size)) {
                for (factor, node) in by.iter().zip(batch.nodes.chunks_exact(size)) {
                    sums.iter_mut().zip(node).for_each(|(to, it)| *to += factor * it);
                }
            }
            // dX_i/dxi_j.
            let mut jacobian = UNIT;
            for (row, column) in
                (0..dimension * dimension).map(|it| (it / dimension, it % dimension))
            {
                jacobian[row][column] = sums[(1 + column) * size + row];
            }
            let (determinant, inverse) = inverted(&jacobian);
            let is_sound =
                determinant * sign >= 0.0 && determinant != 0.0 && determinant.is_finite();
            if !is_sound {
                return Err(Mistake::new(format!(
                    "cell {cell} is flat, or folded: det dX/dxi = {determinant:e}"
                )));
            }
            sign = determinant.signum();
            let density = factor * determinant.abs() * self.radius(&sums[..dimension]);
            batch.weights.push(weight * density);
            batch.densities.push(density);
            batch.places.extend(&sums[..dimension]);
            batch.values.extend(&sums[dimension..size]);
            if has_gradient {
                for component in dimension..size {
                    let by = |axis: usize| {
                        let along = |j: usize| sums[(1 + j) * size + component] * inverse[j][axis];
                        (0..dimension).map(along).sum::<f64>()
                    };
                    batch.gradients.extend((0..dimension).map(by));
                    if self.is_meridian {
                        batch.gradients.push(0.0);
                    }
                }
                if self.is_meridian {
                    around(&mut batch.gradients, &sums[..size]);
                }
            }
        }
        Ok(())
    }

    /// Adds the errors of a batch, and empties it.
    fn add(
        &self,
        totals: &mut Totals,
        batch: &mut Batch,
        rules: &[QuadratureRule],
        Carried { components, has_gradient, .. }: Carried<'_>,
        exact: Exact<'_>,
    ) -> Result<(), Mistake> {
        if batch.weights.is_empty() {
            return Ok(());
        }
        let less = |numbers: &mut [f64], exact: &[f64]| {
            numbers.iter_mut().zip(exact).for_each(|(to, it)| *to -= it);
        };
        less(&mut batch.values, &exact(SolutionPart::Values, &batch.places)?);
        if has_gradient {
            less(&mut batch.gradients, &exact(SolutionPart::Gradients, &batch.places)?);
            let squares = batch.gradients.chunks_exact(batch.gradients.len() / batch.weights.len());
            let squares = batch.weights.iter().zip(squares.map(square));
            totals.gradient += squares.map(|(weight, it)| weight * it).sum::<f64>();
        }
        let mut first = 0;
        for &(cell, rule) in &batch.cells {
            let own = first..first + rules[rule].points.len();
            first = own.end;
            let errors = &batch.values[own.start * components..own.end * components];
            let of_points = [&batch.weights[own.clone()], &batch.densities[own]];
            totals.add_cell((cell, rule), &rules[rule], errors, of_points);
        }
        batch.clear();
        Ok(())
    }

    /// Evaluates the exact solution where the polynomials have their largest values, and climbs by parabolas beside these places.
    /// Returns the place X of the largest error; the middle of its cell, if it is at a point of quadrature.
    fn climb(
        &self,
        totals: &mut Totals,
        rules: &[QuadratureRule],
        carried: Carried<'_>,
        exact: Exact<'_>,
    ) -> Result<Vec<f64>, Mistake> {
        totals.keep_peaks();
        let dimension = self.dimension;
        totals.peaks.iter_mut().for_each(|it| it.error = 0.0);
        let mut part = 0.5;
        for _ in 0..ROUNDS {
            let step_of = |peak: &Peak| part / rules[peak.rule].steps as f64;
            let beside = |peak: &Peak| {
                let (at, step) = (peak.search_from, step_of(peak));
                let moved = (0..2 * dimension).map(move |which| {
                    let (axis, by) = (which / 2, if which % 2 == 0 { -step } else { step });
                    let mut at = at;
                    at[axis] = (at[axis] + by).clamp(0.0, 1.0);
                    at
                });
                std::iter::once(at).chain(moved)
            };
            let tried: Vec<Peak> = totals
                .peaks
                .iter()
                .flat_map(|peak| beside(peak).map(|at| Peak { search_from: at, ..*peak }))
                .collect();
            let errors = self.errors_at(&tried, rules, carried, exact)?;
            let count = 2 * dimension + 1;
            let each = totals.peaks.iter_mut().zip(errors.chunks(count).zip(tried.chunks(count)));
            for (peak, (errors, tried)) in each {
                for (error, tried) in errors.iter().zip(tried).filter(|it| !it.0.is_nan()) {
                    if *error > peak.error {
                        (peak.error, peak.best_place) = (*error, tried.search_from);
                    }
                }
                for (axis, beside) in errors[1..].chunks(2).enumerate() {
                    let (rise, bend) =
                        (beside[1] - beside[0], 2.0 * errors[0] - beside[0] - beside[1]);
                    let far = if bend > 0.0 {
                        (rise / (2.0 * bend)).clamp(-1.0, 1.0)
                    } else {
                        rise.signum()
                    };
                    peak.search_from[axis] =
                        (peak.search_from[axis] + far * step_of(peak)).clamp(0.0, 1.0);
                }
            }
            part *= SHRINKS;
        }
        let mut best_place = [0.5; 3];
        for peak in &totals.peaks {
            if peak.error > totals.largest.0 {
                (totals.largest, best_place) = ((peak.error, peak.cell), peak.best_place);
            }
        }
        let cell = totals.largest.1;
        let points = self.full().find(|it| it.0 == cell);
        Ok(points.map_or_else(Vec::new, |(_, shape, points)| {
            let functions = shape.values(shape.of_cube(best_place).0);
            let sum = |axis: usize| {
                points.iter().zip(&functions).map(|(&at, n)| n * self.point(at)[axis]).sum()
            };
            (0..dimension).map(sum).collect()
        }))
    }

    /// The errors at places in cells.
    fn errors_at(
        &self,
        all: &[Peak],
        rules: &[QuadratureRule],
        Carried { values, components, .. }: Carried<'_>,
        exact: Exact<'_>,
    ) -> Result<Vec<f64>, Mistake> {
        let (mut places, mut computed) = (Vec::new(), Vec::new());
        for peak in all {
            let start = peak.cell.checked_sub(1).map_or(0, |before| self.cells.ends[before]);
            let points = &self.cells.points[start..self.cells.ends[peak.cell]];
            let shape = rules[peak.rule].shape;
            let functions = shape.values(shape.of_cube(peak.search_from).0);
            let sum = |of: &[f64], size: usize, to: &mut Vec<f64>| {
                let each = |k: usize| {
                    let parts = points.iter().zip(&functions);
                    parts.map(|(point, n)| n * of[point * size + k]).sum::<f64>()
                };
                to.extend((0..size).map(each));
            };
            sum(self.points, self.dimension, &mut places);
            sum(values, components, &mut computed);
        }
        let exact = exact(SolutionPart::Values, &places)?;
        Ok(lengths(&computed, &exact, components).collect())
    }
}

impl Totals {
    /// Adds the errors of a cell at its quadrature points, with the weights and densities there.
    fn add_cell(
        &mut self,
        (cell, rule): (usize, usize),
        of: &QuadratureRule,
        errors: &[f64],
        [weights, densities]: [&[f64]; 2],
    ) {
        let components = errors.len() / weights.len();
        let (mut mean, mut first, mut largest) = (vec![0.0; components], 0.0, 0.0_f64);
        for (weight, error) in weights.iter().zip(errors.chunks_exact(components)) {
            let square = square(error);
            mean.iter_mut().zip(error).for_each(|(to, it)| *to += it);
            self.volume += weight;
            self.second += weight * square;
            first += weight * square.sqrt();
            largest = largest.max(square);
        }
        let largest = largest.sqrt();
        if largest > self.largest.0 {
            self.largest = (largest, cell);
        }
        let along = |error: &[f64]| mean.iter().zip(error).map(|(a, b)| a * b).sum::<f64>();
        // If the product of each error vector with their mean is positive, the error does not vanish inside the cell, and the
        // Gauss rule integrates its length well. In one dimension the fine rule is cheap, and always used.
        let is_smooth = of.shape.dimension > 1
            && errors.chunks_exact(components).all(|error| along(error) >= 0.0);
        self.first += if is_smooth { first } else { self.integral(of, errors, densities) };
        if BETWEEN * largest > self.best {
            self.search((cell, rule), of, errors, components);
        }
    }

    /// The integral of the length of a polynomial.
    fn integral(&mut self, of: &QuadratureRule, errors: &[f64], densities: &[f64]) -> f64 {
        let dimension = of.shape.dimension;
        let components = errors.len() / densities.len();
        let size = components + 1;
        let pairs = errors.chunks_exact(components).zip(densities);
        self.numbers.clear();
        pairs.for_each(|(error, density)| self.numbers.extend(error.iter().chain([density])));
        of.fine.apply(&self.numbers, dimension, size, &mut self.room);
        let lengths = self.room[0].chunks_exact(size);
        let sum: f64 = lengths.map(|it| it[components] * square(&it[..components]).sqrt()).sum();
        // All weights along an axis are equal.
        of.fine.places[0].1.powi(dimension as i32) * sum
    }

    /// Searches the maximum of a polynomial: at the ends of parts, and, where it is large there, by a parabola along each axis.
    fn search(
        &mut self,
        (cell, rule): (usize, usize),
        of: &QuadratureRule,
        errors: &[f64],
        components: usize,
    ) {
        let dimension = of.shape.dimension;
        of.ends.apply(errors, dimension, components, &mut self.room);
        self.numbers.clear();
        self.numbers.extend(self.room[0].chunks_exact(components).map(square));
        let squares = &self.numbers;
        let least = HIGH * HIGH * squares.iter().copied().fold(0.0, f64::max);
        let steps = of.steps;
        let side = steps + 1;
        for (at, &own) in squares.iter().enumerate().filter(|(_, own)| **own >= least) {
            let (mut place, mut most) = (of.ends.point(at, dimension).0, own);
            for axis in 0..dimension {
                let stride = side.pow((dimension - 1 - axis) as u32);
                let along = at / stride % side;
                if along == 0 || along == steps {
                    continue;
                }
                let (before, after) = (squares[at - stride], squares[at + stride]);
                let bend = 2.0 * own - before - after;
                // Otherwise a neighbour is larger and becomes a peak itself, or the values do not curve downwards.
                if bend > 0.0 && before.max(after) <= own {
                    place[axis] += (after - before) / (2.0 * bend) / steps as f64;
                    most += (after - before).powi(2) / (8.0 * bend);
                }
            }
            let error = most.sqrt();
            self.best = self.best.max(error);
            if error > NEAR * self.best {
                self.peaks.push(Peak { error, cell, rule, search_from: place, best_place: place });
            }
        }
        if self.peaks.len() > 4 * COMPARED {
            self.keep_peaks();
        }
    }

    /// Keeps the peaks that may be the largest.
    fn keep_peaks(&mut self) {
        self.peaks.retain(|it| it.error > NEAR * self.best);
        self.peaks.sort_by(|a, b| b.error.total_cmp(&a.error));
        self.peaks.truncate(COMPARED);
    }
}

/// Adds the derivatives around the axis to the rows of a displacement gradient; `place` contains R, Z and u.
fn around(gradient: &mut Vec<f64>, place: &[f64]) {
    let (radius, u) = (place[0], &place[2..]);
    let turn = u.get(2).map_or(0.0, |turn| turn / radius);
    gradient.extend(vec![0.0; 3 * (3 - u.len())]);
    let first = gradient.len() - 9;
    gradient[first + 2] = -turn;
    gradient[first + 8] = u[0] / radius;
}

fn square(numbers: &[f64]) -> f64 {
    numbers.iter().map(|it| it * it).sum()
}

impl Batch {
    fn clear(&mut self) {
        self.cells.clear();
        let numbers = [
            &mut self.places,
            &mut self.weights,
            &mut self.densities,
            &mut self.values,
            &mut self.gradients,
        ];
        numbers.into_iter().for_each(Vec::clear);
    }
}

const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The determinant and the inverse of a matrix, by cofactors.
fn inverted(matrix: &Matrix) -> (f64, Matrix) {
    let cofactor = |row: usize, column: usize| {
        let [r1, r2, c1, c2] = [row + 1, row + 2, column + 1, column + 2].map(|it| it % 3);
        matrix[r1][c1] * matrix[r2][c2] - matrix[r1][c2] * matrix[r2][c1]
    };
    let determinant: f64 = (0..3).map(|column| matrix[0][column] * cofactor(0, column)).sum();
    let inverse = [0, 1, 2].map(|row| [0, 1, 2].map(|column| cofactor(column, row) / determinant));
    (determinant, inverse)
}
