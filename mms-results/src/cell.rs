//! Cells of degree 1 and 2: their functions, and quadrature over them.
//!
//! The functions of a cell are the polynomials that are 1 at one of its nodes and 0 at the others, found by solving for
//! their coefficients. So a kind of cell is its corners, the corners between which its other nodes lie, and the
//! monomials that it holds; the order of nodes is that of VTK.
//!
//! A pyramid is a hexahedron whose upper face is drawn together to a point. In the coordinates of the hexahedron its
//! functions are polynomials, and over x and y of the pyramid they are the usual rational ones, as (1 - x - z)(1 - y -
//! z)/(1 - z) (G. Bedrosian, Int. J. Numer. Meth. Engng 35, 1992, 95-108).

use std::sync::LazyLock;

/// Reference coordinates; those beyond the dimension are 0.
pub type Local = [f64; 3];

/// How many points of Gauss quadrature has along an axis: it is exact for the square of a polynomial of degree 4, two degrees above
/// the highest of a cell, and one less of a triangle.
pub(crate) const ALONG: usize = 5;

/// What the polynomials of a cell are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Space {
    /// All of a degree.
    Complete(u32),
    /// Those of a degree in each coordinate.
    Product(u32),
    /// Those of degree 2 in one coordinate at most, and 1 in the others (serendipity).
    Serendipity,
    /// Those of degree 1 in the first two together, and in the third.
    Wedge,
    /// Those of degree 1 in each, which do not depend on the first two where the third is 1.
    Pyramid,
}

impl Space {
    fn degree(self) -> u32 {
        match self {
            Space::Complete(degree) | Space::Product(degree) => degree,
            Space::Serendipity => 2,
            Space::Wedge | Space::Pyramid => 1,
        }
    }

    fn holds(self, exponents: [u32; 3]) -> bool {
        match self {
            Space::Complete(degree) => exponents.iter().sum::<u32>() <= degree,
            Space::Product(_) | Space::Pyramid => true,
            Space::Wedge => exponents[0] + exponents[1] <= 1,
            Space::Serendipity => exponents.iter().filter(|&&it| it == 2).count() <= 1,
        }
    }

    fn monomials(self, dimension: usize) -> Vec<[u32; 3]> {
        let most = |axis| if axis < dimension { self.degree() } else { 0 };
        let (x, y, z) = (0..=most(0), 0..=most(1), 0..=most(2));
        let all = z.flat_map(|c| {
            let x = x.clone();
            y.clone().flat_map(move |b| x.clone().map(move |a| [a, b, c]))
        });
        all.filter(|it| self.holds(*it)).collect()
    }
}

/// A kind of cell as data: its number in VTK, dimension, corners, the corners in whose middle each other node lies, and
/// its polynomials.
type Row = (u8, usize, &'static [Local], &'static [&'static [usize]], Space);

const LINE: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
const TRIANGLE: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const QUAD: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const PIXEL: &[Local] = &[QUAD[0], QUAD[1], QUAD[3], QUAD[2]];
const TETRA: &[Local] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const HEX: &[Local] = &[
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];
const WEDGE: &[Local] = &[TETRA[0], TETRA[1], TETRA[2], HEX[4], HEX[5], HEX[7]];
const PYRAMID: &[Local] = &[HEX[0], HEX[1], HEX[2], HEX[3], HEX[4]];
const VOXEL: &[Local] = &[HEX[0], HEX[1], HEX[3], HEX[2], HEX[4], HEX[5], HEX[7], HEX[6]];
const QUAD_EDGES: [&[usize]; 4] = [&[0, 1], &[1, 2], &[2, 3], &[3, 0]];
const HEX_EDGES: [&[usize]; 12] = [
    &[0, 1],
    &[1, 2],
    &[2, 3],
    &[3, 0],
    &[4, 5],
    &[5, 6],
    &[6, 7],
    &[7, 4],
    &[0, 4],
    &[1, 5],
    &[2, 6],
    &[3, 7],
];
const HEX_MIDDLES: [&[usize]; 19] = {
    let mut all: [&[usize]; 19] = [&[]; 19];
    let mut edge = 0;
    while edge < 12 {
        all[edge] = HEX_EDGES[edge];
        edge += 1;
    }
    all[12] = &[0, 4, 7, 3];
    all[13] = &[1, 2, 6, 5];
    all[14] = &[0, 1, 5, 4];
    all[15] = &[3, 7, 6, 2];
    all[16] = &[0, 3, 2, 1];
    all[17] = &[4, 5, 6, 7];
    all[18] = &[0, 1, 2, 3, 4, 5, 6, 7];
    all
};

const ROWS: &[Row] = &[
    (3, 1, LINE, &[], Space::Product(1)),
    (5, 2, TRIANGLE, &[], Space::Complete(1)),
    (8, 2, PIXEL, &[], Space::Product(1)),
    (9, 2, QUAD, &[], Space::Product(1)),
    (10, 3, TETRA, &[], Space::Complete(1)),
    (11, 3, VOXEL, &[], Space::Product(1)),
    (12, 3, HEX, &[], Space::Product(1)),
    (13, 3, WEDGE, &[], Space::Wedge),
    (14, 3, PYRAMID, &[], Space::Pyramid),
    (21, 1, LINE, &[&[0, 1]], Space::Product(2)),
    (22, 2, TRIANGLE, &[&[0, 1], &[1, 2], &[2, 0]], Space::Complete(2)),
    (23, 2, QUAD, &QUAD_EDGES, Space::Serendipity),
    (24, 3, TETRA, &[&[0, 1], &[1, 2], &[2, 0], &[0, 3], &[1, 3], &[2, 3]], Space::Complete(2)),
    (25, 3, HEX, &HEX_EDGES, Space::Serendipity),
    (28, 2, QUAD, &[&[0, 1], &[1, 2], &[2, 3], &[3, 0], &[0, 1, 2, 3]], Space::Product(2)),
    (29, 3, HEX, &HEX_MIDDLES, Space::Product(2)),
];

/// The dimension of a type of cells in VTK, also of such as are not known otherwise.
pub(crate) fn dimension(kind: u8) -> usize {
    match kind {
        0..=2 => 0,
        3 | 4 | 21 | 35 | 68 | 75 => 1,
        5..=9 | 22 | 23 | 28 | 30 | 34 | 36 | 69 | 70 | 76 | 77 => 2,
        _ => 3,
    }
}

/// A kind of cell.
#[derive(Debug)]
pub struct Shape {
    kind: u8,
    /// Its dimension.
    pub dimension: usize,
    /// Where its nodes are in the reference cell.
    pub nodes: Vec<Local>,
    corners: usize,
    space: Space,
    monomials: Vec<[u32; 3]>,
    /// Of the function of each node, the coefficients of the monomials.
    coefficients: Vec<Vec<f64>>,
}

static SHAPES: LazyLock<Vec<Shape>> = LazyLock::new(|| ROWS.iter().map(Shape::new).collect());

/// Where the shape of a number in VTK is.
static BY_KIND: LazyLock<[Option<usize>; 256]> = LazyLock::new(|| {
    std::array::from_fn(|kind| ROWS.iter().position(|row| usize::from(row.0) == kind))
});

impl Shape {
    /// The kind of that number in VTK, if it is one of those that are known.
    pub fn of(kind: u8) -> Option<&'static Shape> {
        // Meshes have as many cells as points, and few kinds.
        BY_KIND[usize::from(kind)].map(|at| &SHAPES[at])
    }

    /// All that are known.
    pub fn all() -> impl Iterator<Item = &'static Shape> {
        SHAPES.iter()
    }

    fn new(&(kind, dimension, corners, between, space): &Row) -> Shape {
        let middle = |of: &&[usize]| {
            std::array::from_fn(|axis| {
                of.iter().map(|&corner| corners[corner][axis]).sum::<f64>() / of.len() as f64
            })
        };
        let nodes: Vec<Local> = corners.iter().copied().chain(between.iter().map(middle)).collect();
        let monomials = space.monomials(dimension);
        let coefficients = match space {
            Space::Pyramid => drawn_together(functions(HEX, &monomials)),
            _ => functions(&nodes, &monomials),
        };
        let corners = corners.len();
        Shape { kind, dimension, nodes, corners, space, monomials, coefficients }
    }

    /// Its number in VTK.
    pub fn kind(&self) -> u8 {
        self.kind
    }

    /// The degree of its functions.
    pub fn degree(&self) -> u32 {
        self.space.degree()
    }

    /// The functions of its nodes at a place.
    pub fn values(&self, at: Local) -> Vec<f64> {
        self.combined(|exponents| value(exponents, at))
    }

    /// Their derivatives by a reference coordinate.
    pub fn derivatives(&self, at: Local, axis: usize) -> Vec<f64> {
        self.combined(|exponents| derivative(exponents, at, axis))
    }

    fn combined(&self, monomial: impl Fn([u32; 3]) -> f64) -> Vec<f64> {
        let monomials: Vec<f64> = self.monomials.iter().map(|&it| monomial(it)).collect();
        let sum = |of: &Vec<f64>| of.iter().zip(&monomials).map(|(c, m)| c * m).sum();
        self.coefficients.iter().map(sum).collect()
    }

    /// The middle of the reference cell: where its centre of volume is.
    pub fn middle(&self) -> Local {
        if self.space == Space::Pyramid {
            return [0.5, 0.5, 0.25];
        }
        let corners = &self.nodes[..self.corners];
        std::array::from_fn(|axis| {
            corners.iter().map(|it| it[axis]).sum::<f64>() / self.corners as f64
        })
    }

    /// Pairs of corners between which there is an edge.
    pub fn edges(&self) -> Vec<[usize; 2]> {
        let differ = |a: usize, b: usize, axis: usize| self.nodes[a][axis] != self.nodes[b][axis];
        let is_along = |a: usize, b: usize| (0..3).filter(|&it| differ(a, b, it)).count() == 1;
        let is_edge = |a: usize, b: usize| match self.space {
            Space::Complete(_) => true,
            Space::Wedge => is_along(a, b) || !differ(a, b, 2),
            Space::Pyramid => is_along(a, b) || differ(a, b, 2),
            Space::Product(_) | Space::Serendipity => is_along(a, b),
        };
        let pairs = (0..self.corners).flat_map(|a| (a + 1..self.corners).map(move |b| [a, b]));
        pairs.filter(|&[a, b]| is_edge(a, b)).collect()
    }

    /// The place that stands for one of a unit cube, and by how much the volume there is smaller. A triangle is a square one
    /// of whose edges is drawn together to a corner, a tetrahedron a cube.
    pub(crate) fn of_cube(&self, [x, y, z]: Local) -> (Local, f64) {
        match (self.space, self.dimension) {
            (Space::Complete(_), 2) => ([x, y * (1.0 - x), 0.0], 1.0 - x),
            (Space::Wedge, _) => ([x, y * (1.0 - x), z], 1.0 - x),
            (Space::Complete(_), _) => {
                let rest = (1.0 - x) * (1.0 - y);
                ([x, y * (1.0 - x), z * rest], (1.0 - x) * rest)
            }
            _ => ([x, y, z], 1.0),
        }
    }
}

/// The functions of a hexahedron as those of a pyramid: the upper four are one.
fn drawn_together(mut of_hexahedron: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let upper = of_hexahedron.split_off(4);
    let sum = |at: usize| upper.iter().map(|function| function[at]).sum();
    of_hexahedron.push((0..upper[0].len()).map(sum).collect());
    of_hexahedron
}

fn value(exponents: [u32; 3], at: Local) -> f64 {
    (0..3).map(|axis| at[axis].powi(exponents[axis] as i32)).product()
}

fn derivative(mut exponents: [u32; 3], at: Local, axis: usize) -> f64 {
    match exponents[axis] {
        0 => 0.0,
        power => {
            exponents[axis] -= 1;
            f64::from(power) * value(exponents, at)
        }
    }
}

/// The coefficients of the polynomials that are 1 at one node and 0 at the others, by elimination.
fn functions(nodes: &[Local], monomials: &[[u32; 3]]) -> Vec<Vec<f64>> {
    let count = nodes.len();
    let unit = |row: usize| (0..count).map(move |column| f64::from(row == column));
    let mut rows: Vec<Vec<f64>> = nodes
        .iter()
        .enumerate()
        .map(|(row, &node)| monomials.iter().map(|&it| value(it, node)).chain(unit(row)).collect())
        .collect();
    for column in 0..count {
        let largest =
            |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
        let pivot = (column..count).max_by(largest).unwrap_or(column);
        rows.swap(column, pivot);
        let by = rows[column][column];
        rows[column].iter_mut().for_each(|it| *it /= by);
        let pivot = rows[column].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(row, _)| *row != column) {
            let factor = row[column];
            row.iter_mut().zip(&pivot).for_each(|(it, pivot)| *it -= factor * pivot);
        }
    }
    (0..count).map(|node| rows.iter().map(|row| row[count + node]).collect()).collect()
}

/// Gauss's points and weights on [0, 1]: the roots of Legendre's polynomial, by Newton's method.
pub(crate) fn gauss(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    (0..count)
        .map(|k| {
            let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (mut before, mut last) = (1.0, x);
                for degree in 2..=count {
                    let d = degree as f64;
                    (before, last) = (last, ((2.0 * d - 1.0) * x * last - (d - 1.0) * before) / d);
                }
                slope = n * (x * last - before) / (x * x - 1.0);
                x -= last / slope;
            }
            ((1.0 - x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral of x^a y^b z^c over a unit cube, or over a simplex: a! b! c!/(a + b + c + D)!.
    fn integral(shape: &Shape, [a, b, c]: [u32; 3]) -> f64 {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        match shape.space {
            Space::Complete(_) => {
                let all = factorial(a + b + c + shape.dimension as u32);
                factorial(a) * factorial(b) * factorial(c) / all
            }
            Space::Wedge => factorial(a) * factorial(b) / factorial(a + b + 2) / f64::from(c + 1),
            _ => 1.0 / f64::from((a + 1) * (b + 1) * (c + 1)),
        }
    }

    #[test]
    fn quadrature_is_exact_to_its_degree() {
        for shape in Shape::all() {
            let degree = 2 * ALONG as u32 - 1 - (shape.dimension as u32 - 1);
            for exponents in Space::Complete(degree).monomials(shape.dimension) {
                let along = gauss(ALONG);
                let all = (0..along.len().pow(shape.dimension as u32)).map(|mut index| {
                    let (mut cube, mut weight) = ([0.0; 3], 1.0);
                    for to in &mut cube[..shape.dimension] {
                        (*to, weight) =
                            (along[index % along.len()].0, weight * along[index % along.len()].1);
                        index /= along.len();
                    }
                    let (at, factor) = shape.of_cube(cube);
                    weight * factor * value(exponents, at)
                });
                let sum: f64 = all.sum();
                let exact = integral(shape, exponents);
                assert!((sum - exact).abs() < 1e-14, "{} {exponents:?}: {sum} {exact}", shape.kind);
            }
        }
    }

    #[test]
    fn functions_are_one_at_their_node_and_sum_to_one() {
        for shape in Shape::all() {
            for (node, &at) in shape.nodes.iter().enumerate() {
                for (other, value) in shape.values(at).into_iter().enumerate() {
                    assert!((value - f64::from(node == other)).abs() < 1e-13);
                }
            }
            let sum: f64 = shape.values([0.3, 0.2, 0.1]).iter().sum();
            assert!((sum - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let (at, step) = ([0.3, 0.2, 0.1], 1e-6);
        for shape in Shape::all() {
            for axis in 0..shape.dimension {
                let moved = |by: f64| {
                    let mut place = at;
                    place[axis] += by;
                    shape.values(place)
                };
                let (before, after) = (moved(-step), moved(step));
                for (node, slope) in shape.derivatives(at, axis).into_iter().enumerate() {
                    let difference = (after[node] - before[node]) / (2.0 * step);
                    assert!((slope - difference).abs() < 1e-8, "{} {node}", shape.kind);
                }
            }
        }
    }

    #[test]
    fn edges_are_as_many_as_they_should_be() {
        let edges = |kind| Shape::of(kind).unwrap().edges().len();
        assert_eq!([3, 5, 9, 8, 10, 12, 11, 25].map(edges), [1, 3, 4, 4, 6, 12, 12, 12]);
        assert_eq!([13, 14].map(edges), [9, 8]);
    }

    /// Over x and y of the pyramid itself, where they are rational.
    #[test]
    fn functions_of_a_pyramid_are_those_of_bedrosian() {
        let pyramid = Shape::of(14).unwrap();
        for [x, y, z] in [[0.1, 0.2, 0.3], [0.0, 0.6, 0.4], [0.05, 0.01, 0.9]] {
            let found = pyramid.values([x / (1.0 - z), y / (1.0 - z), z]);
            let (right, behind) = (1.0 - z - x, 1.0 - z - y);
            let rational = [right * behind, x * behind, x * y, right * y].map(|it| it / (1.0 - z));
            for (a, b) in found.iter().zip(rational.iter().chain([&z])) {
                assert!((a - b).abs() < 1e-14, "{found:?}");
            }
        }
    }
}
