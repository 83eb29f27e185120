//! Norms of errors: over points, and by quadrature over cells.

use crate::cell::Shape;
use crate::{Cells, Mistake};

/// How large an error is. Means are those over points, by their weights, or over the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norms {
    /// The mean.
    pub l1: f64,
    /// The root of the mean square.
    pub l2: f64,
    /// The largest.
    pub linf: f64,
    /// Where that is: a point, a cell.
    pub at: usize,
}

/// Sums of which norms are made.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    weight: f64,
    first: f64,
    second: f64,
    largest: f64,
    at: usize,
}

impl Sums {
    pub(crate) fn add(&mut self, at: usize, weight: f64, error: f64) {
        self.weight += weight;
        self.first += weight * error;
        self.second += weight * error * error;
        if error > self.largest {
            (self.largest, self.at) = (error, at);
        }
    }

    fn norms(self) -> Norms {
        let Sums { weight, first, second, largest, at } = self;
        Norms { l1: first / weight, l2: (second / weight).sqrt(), linf: largest, at }
    }

    /// `None` without a weight above 0.
    pub(crate) fn if_any(self) -> Option<Norms> {
        (self.weight > 0.0 && self.weight.is_finite()).then(|| self.norms())
    }
}

/// The lengths of the differences, each of so many components: of vectors Euclid's, of tensors that of Frobenius.
pub fn lengths(computed: &[f64], exact: &[f64], components: usize) -> impl Iterator<Item = f64> {
    let pairs = computed.chunks_exact(components).zip(exact.chunks_exact(components));
    pairs.map(|(a, b)| length(a, b))
}

fn length(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The norms of errors at points, each with its weight, or all alike. `None` where there are none, or their weights
/// have no sum above 0.
pub fn over_points(
    errors: impl IntoIterator<Item = f64>,
    weights: Option<&[f64]>,
) -> Option<Norms> {
    let mut sums = Sums::default();
    for (at, error) in errors.into_iter().enumerate() {
        sums.add(at, weights.map_or(1.0, |weights| weights[at]), error);
    }
    sums.if_any()
}

/// The norms of the differences at points, as of [`over_points`].
pub fn of_differences(
    computed: &[f64],
    exact: &[f64],
    components: usize,
    weights: Option<&[f64]>,
) -> Option<Norms> {
    over_points(lengths(computed, exact, components), weights)
}

/// The largest absolute value; 0 where there is none.
pub fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most: f64, it| most.max(it.abs()))
}

/// The same of finite numbers, in one pass.
///
/// # Errors
/// The first number that is not finite.
pub fn largest_if_finite(of: &[f64]) -> Result<f64, usize> {
    // So many together, without a branch for each.
    const TOGETHER: usize = 1024;
    let mut most = 0.0_f64;
    for (block, numbers) in of.chunks(TOGETHER).enumerate() {
        if !numbers.iter().fold(true, |all, it| all & it.is_finite()) {
            let at = numbers.iter().position(|it| !it.is_finite());
            return Err(block * TOGETHER + at.unwrap_or_default());
        }
        most = most.max(largest(numbers));
    }
    Ok(most)
}

/// What of the exact solution is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// Its values: so many components at each place.
    Values,
    /// Their derivatives by X: row by row, as many more as there are dimensions.
    Gradients,
}

/// The exact solution at places X, whose coordinates stand one after the other.
pub type Exact<'a> = &'a mut dyn FnMut(Asked, &[f64]) -> Result<Vec<f64>, Mistake>;

/// The norms of an error and of its gradient, by quadrature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverCells {
    /// Of the error.
    pub value: Norms,
    /// Of its gradient: `l2` is the seminorm of H1, by the root of the body's measure.
    pub gradient: Norms,
}

/// A mesh in the reference configuration.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Its cells; those of a lower dimension than its own are left out.
    pub cells: &'a Cells,
    /// X of its points, one after the other.
    pub points: &'a [f64],
    /// Its dimension.
    pub dimension: usize,
}

/// The quadrature points of some cells: the cell of each, X, weight, and what was computed.
#[derive(Default)]
struct Batch {
    cell: Vec<usize>,
    places: Vec<f64>,
    weights: Vec<f64>,
    values: Vec<f64>,
    gradients: Vec<f64>,
}

/// How many quadrature points are taken at once.
const BATCH: usize = 4096;

/// The functions of a kind of cell at its quadrature points, and at its nodes, which have no weight: the largest error
/// may be there.
struct Tabulated {
    shape: &'static Shape,
    points: Vec<(f64, Vec<f64>, Vec<Vec<f64>>)>,
}

impl Tabulated {
    fn new(shape: &'static Shape) -> Self {
        let point = |(at, weight)| {
            let slopes = (0..shape.dimension).map(|axis| shape.derivatives(at, axis));
            (weight, shape.values(at), slopes.collect())
        };
        let nodes = shape.extremes().map(|node| (node, 0.0));
        Tabulated {
            shape,
            points: shape.quadrature().into_iter().chain(nodes).map(point).collect(),
        }
    }

    /// The position of a kind of cell among those that are known, which it joins.
    fn among(known: &mut Vec<Tabulated>, shape: &'static Shape) -> usize {
        let found = known.iter().position(|it| it.shape.kind() == shape.kind());
        found.unwrap_or_else(|| {
            known.push(Tabulated::new(shape));
            known.len() - 1
        })
    }
}

impl<'a> Mesh<'a> {
    /// Cells of the dimension of the mesh, by their positions.
    pub fn full(&self) -> impl Iterator<Item = (usize, &'static Shape, &'a [usize])> {
        let dimension = self.dimension;
        self.cells.iter().enumerate().filter_map(move |(cell, (kind, points))| {
            let shape = Shape::of(kind).filter(|shape| shape.dimension == dimension)?;
            (shape.nodes.len() == points.len()).then_some((cell, shape, points))
        })
    }

    /// The types of cells that may be of the dimension of the mesh, and are not known.
    pub fn unknown(&self) -> Option<u8> {
        let lines = [1, 2, 4];
        self.cells
            .types
            .iter()
            .copied()
            .find(|kind| Shape::of(*kind).is_none() && !lines.contains(kind))
    }

    fn point(&self, point: usize) -> &'a [f64] {
        &self.points[point * self.dimension..][..self.dimension]
    }

    /// The shortest and the longest of the longest edges of the cells; `None` where there are none of full dimension.
    pub fn sizes(&self) -> Option<[f64; 2]> {
        let longest = |(_, shape, points): (usize, &'static Shape, &[usize])| {
            let edges = shape.edges().into_iter();
            edges
                .map(|[a, b]| length(self.point(points[a]), self.point(points[b])))
                .fold(0.0, f64::max)
        };
        let both = |range: Option<[f64; 2]>, size: f64| {
            Some(range.map_or([size; 2], |[least, most]| [least.min(size), most.max(size)]))
        };
        self.full().map(longest).fold(None, both)
    }

    /// X at the middle of the reference cell of each, of all cells of full dimension.
    pub fn middles(&self) -> Vec<f64> {
        let middle = |(_, shape, points): (usize, &'static Shape, &'a [usize])| {
            let values = shape.values(shape.middle());
            let of = move |axis| {
                points.iter().zip(&values).map(|(&point, n)| n * self.point(point)[axis]).sum()
            };
            (0..self.dimension).map(of).collect::<Vec<f64>>()
        };
        self.full().flat_map(middle).collect()
    }

    /// The volume of each point: the integral of its function over the cells, as in a lumped mass.
    ///
    /// # Errors
    /// A cell that is flat, or turned inside out.
    pub fn volumes(&self) -> Result<Vec<f64>, Mistake> {
        let mut volumes = vec![0.0; self.points.len() / self.dimension];
        let mut tables: Vec<Tabulated> = Vec::new();
        for (cell, shape, points) in self.full() {
            let table = Tabulated::among(&mut tables, shape);
            let mut batch = Batch::default();
            self.place(&mut batch, cell, &tables[table], points, (&[], 0))?;
            for (weight, (_, functions, _)) in batch.weights.iter().zip(&tables[table].points) {
                let parts = points.iter().zip(functions);
                parts.for_each(|(&point, value)| volumes[point] += weight * value);
            }
        }
        Ok(volumes)
    }

    /// Edges of cells in a plane that no other cell has, each as X of its ends and of the node between them, if there is
    /// one; of those with ends that are asked for. Edges are told by their ends: pieces of a mesh have points of their own.
    pub fn free_edges(&self, is_asked: &dyn Fn([&[f64]; 2]) -> bool) -> Vec<Vec<&'a [f64]>> {
        let mut found = Vec::new();
        for (_, shape, points) in self.full() {
            for ends @ [a, b] in shape.edges() {
                let places = ends.map(|it| self.point(points[it]));
                if is_asked(places) {
                    let middle =
                        [0, 1, 2].map(|at| (shape.nodes[a][at] + shape.nodes[b][at]) / 2.0);
                    let between = shape.nodes.iter().position(|it| *it == middle);
                    let between = between.map(|it| self.point(points[it]));
                    found.push(places.into_iter().chain(between).collect::<Vec<_>>());
                }
            }
        }
        let key = |edge: &Vec<&[f64]>| {
            // -0 is 0.
            let mut ends = [edge[0], edge[1]].map(|x| [x[0], x[1]].map(|it| (it + 0.0).to_bits()));
            ends.sort_unstable();
            ends
        };
        found.sort_by_key(key);
        let alone = found.chunk_by(|a, b| key(a) == key(b)).filter(|it| it.len() == 1);
        alone.map(|it| it[0].clone()).collect()
    }

    /// The norms over the body of what its points carry: numbers of so many components.
    ///
    /// # Errors
    /// A cell that is flat, or turned inside out; what the exact solution says.
    pub fn measure(
        &self,
        values: &[f64],
        components: usize,
        exact: Exact<'_>,
    ) -> Result<OverCells, Mistake> {
        let mut sums = [Sums::default(); 2];
        let mut tables: Vec<Tabulated> = Vec::new();
        let mut batch = Batch::default();
        for (cell, shape, points) in self.full() {
            let table = Tabulated::among(&mut tables, shape);
            self.place(&mut batch, cell, &tables[table], points, (values, components))?;
            if batch.weights.len() >= BATCH {
                std::mem::take(&mut batch).measure(&mut sums, components, self.dimension, exact)?;
            }
        }
        batch.measure(&mut sums, components, self.dimension, exact)?;
        if sums[0].weight.is_nan() || sums[0].weight <= 0.0 {
            return Err(Mistake::new("no cell of the dimension of the field"));
        }
        let [value, gradient] = sums.map(Sums::norms);
        Ok(OverCells { value, gradient })
    }

    /// Adds the quadrature points of a cell to a batch.
    fn place(
        &self,
        batch: &mut Batch,
        cell: usize,
        table: &Tabulated,
        points: &[usize],
        (values, components): (&[f64], usize),
    ) -> Result<(), Mistake> {
        let dimension = self.dimension;
        let of = |weights: &[f64], of_point: &dyn Fn(usize) -> f64| -> f64 {
            points.iter().zip(weights).map(|(&point, weight)| weight * of_point(point)).sum()
        };
        let mut sign = 0.0;
        for (weight, functions, slopes) in &table.points {
            // dX_i/dxi_j.
            let jacobian: Vec<Vec<f64>> = (0..dimension)
                .map(|row| {
                    slopes.iter().map(|it| of(it, &|point| self.point(point)[row])).collect()
                })
                .collect();
            let (determinant, inverse) = inverted(&jacobian);
            let is_sound =
                determinant * sign >= 0.0 && determinant != 0.0 && determinant.is_finite();
            if !is_sound && *weight == 0.0 {
                continue;
            }
            if !is_sound {
                return Err(Mistake::new(format!(
                    "cell {cell} is flat, or folded: det dX/dxi = {determinant:e}"
                )));
            }
            sign = determinant.signum();
            batch.cell.push(cell);
            batch.weights.push(weight * determinant.abs());
            batch
                .places
                .extend((0..dimension).map(|axis| of(functions, &|point| self.point(point)[axis])));
            for component in 0..components {
                let value = |point: usize| values[point * components + component];
                batch.values.push(of(functions, &value));
                let local: Vec<f64> = slopes.iter().map(|it| of(it, &value)).collect();
                let by =
                    |axis: usize| (0..dimension).map(|j| local[j] * inverse[j][axis]).sum::<f64>();
                batch.gradients.extend((0..dimension).map(by));
            }
        }
        Ok(())
    }
}

impl Batch {
    fn measure(
        self,
        [of_values, of_gradients]: &mut [Sums; 2],
        components: usize,
        dimension: usize,
        exact: Exact<'_>,
    ) -> Result<(), Mistake> {
        if self.weights.is_empty() {
            return Ok(());
        }
        let parts = [
            (of_values, &self.values, components, Asked::Values),
            (of_gradients, &self.gradients, components * dimension, Asked::Gradients),
        ];
        for (sums, computed, components, asked) in parts {
            let exact = exact(asked, &self.places)?;
            for (point, error) in lengths(computed, &exact, components).enumerate() {
                sums.add(self.cell[point], self.weights[point], error);
            }
        }
        Ok(())
    }
}

/// The determinant and the inverse of a matrix of one to three rows, by cofactors.
fn inverted(matrix: &[Vec<f64>]) -> (f64, Vec<Vec<f64>>) {
    let size = matrix.len();
    let entry = |row: usize, column: usize| match (row < size, column < size) {
        (true, true) => matrix[row][column],
        _ => f64::from(row == column),
    };
    let cofactor = |row: usize, column: usize| {
        let [r1, r2, c1, c2] = [row + 1, row + 2, column + 1, column + 2].map(|it| it % 3);
        entry(r1, c1) * entry(r2, c2) - entry(r1, c2) * entry(r2, c1)
    };
    let determinant: f64 = (0..3).map(|column| entry(0, column) * cofactor(0, column)).sum();
    let inverse = (0..size)
        .map(|row| (0..size).map(|column| cofactor(column, row) / determinant).collect())
        .collect();
    (determinant, inverse)
}
