//! Cells of any degree: their shape functions, and quadrature over them.
//!
//! The functions of a cell are the polynomials that are 1 at one of its nodes and 0 at the others. So a kind of cell is defined
//! by its corners, by the corners between which its other nodes lie, and by its polynomials. The order of nodes is the order of
//! VTK. The number of points determines the degree of a Lagrange cell. Polygons have only points and edges.
//!
//! A pyramid is a hexahedron whose upper face is collapsed to a point. In the coordinates of the hexahedron its functions are
//! polynomials, and over x and y of the pyramid they are the usual rational ones, as (1 - x - z)(1 - y - z)/(1 - z) (G.
//! Bedrosian, Int. J. Numer. Meth. Engng 35, 1992, 95-108).

mod functions;
mod lagrange;
mod rows;

use std::sync::{LazyLock, OnceLock};

use functions::{Functions, Products, Solved};
pub(crate) use lagrange::last_edges;
use rows::{CellType, HEX, ROWS};

/// Reference coordinates; 0 beyond the dimension.
pub type Local = [f64; 3];

/// The least number of Gauss points along an axis.
const LEAST_GAUSS_POINTS: u32 = 5;
/// The number of Gauss points along an axis less the degree of the cell. For a cell of degree d, the rule integrates the square
/// of a polynomial of degree d + 2 exactly, or of degree d + 1 on a triangle.
const POINTS_ABOVE_DEGREE: u32 = 3;

/// The most corners of a polygon.
const MOST_SIDES: usize = 64;

/// The geometric form of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// A line, a square, a cube.
    Cube,
    /// A triangle, a tetrahedron.
    Simplex,
    /// A triangle along a line.
    Wedge,
    /// A cube whose upper face is a point.
    Pyramid,
    /// A polygon.
    Polygon,
}

/// The polynomial space of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Space {
    /// All polynomials up to a degree.
    Complete(u32),
    /// Polynomials of a degree in each coordinate.
    Product([u32; 3]),
    /// Polynomials of a total degree in the first two coordinates, and of another degree in the third.
    Wedge([u32; 2]),
    /// Polynomials of degree 1 in each coordinate that do not depend on the first two where the third is 1.
    Pyramid,
    /// Polynomials of degree 2 in at most one coordinate, and 1 in the others (serendipity).
    Serendipity,
    /// The serendipity polynomials, and polynomials of degree 2 in the third and one other coordinate: with nodes in the
    /// middles of the upright sides.
    Sides,
    /// Polynomials of degree 2 in a wedge, except products of degree 2 both in the plane and along it (serendipity).
    WedgeSerendipity,
}

impl Space {
    fn form(self) -> Form {
        match self {
            Space::Complete(_) => Form::Simplex,
            Space::Wedge(_) | Space::WedgeSerendipity => Form::Wedge,
            Space::Pyramid => Form::Pyramid,
            Space::Product(_) | Space::Serendipity | Space::Sides => Form::Cube,
        }
    }

    /// The degrees along the axes.
    fn degrees(self) -> [u32; 3] {
        match self {
            Space::Complete(degree) => [degree; 3],
            Space::Product(degrees) => degrees,
            Space::Wedge([plane, along]) => [plane, plane, along],
            Space::Pyramid => [1; 3],
            Space::Serendipity | Space::Sides | Space::WedgeSerendipity => [2; 3],
        }
    }

    /// The monomials of the spaces that are no products.
    fn monomials(self, dimension: usize) -> Vec<[u32; 3]> {
        let most = |axis| if axis < dimension { 2 } else { 0 };
        let all = (0..=most(2))
            .flat_map(|c| (0..=most(1)).flat_map(move |b| (0..=most(0)).map(move |a| [a, b, c])));
        let squares = |it: &[u32; 3]| it.iter().filter(|&&power| power == 2).count();
        let holds = |it: &[u32; 3]| match self {
            Space::Sides => squares(it) <= 1 || squares(it) == 2 && it[2] == 2,
            Space::WedgeSerendipity => it[0] + it[1] <= if it[2] == 2 { 1 } else { 2 },
            _ => squares(it) <= 1,
        };
        all.filter(holds).collect()
    }

    fn functions(self, dimension: usize, nodes: &[Local]) -> Functions {
        let products =
            |nodes: &[Local]| Products::new(self.form(), dimension, self.degrees(), nodes);
        match self {
            Space::Complete(_) | Space::Product(_) | Space::Wedge(_) => {
                Functions::Products(products(nodes))
            }
            Space::Pyramid => Functions::Pyramid(products(HEX)),
            Space::Serendipity | Space::Sides | Space::WedgeSerendipity => {
                Functions::Solved(Solved::new(nodes, self.monomials(dimension)))
            }
        }
    }
}

/// The dimension of a cell type of VTK, including types that cannot be read.
pub(crate) fn dimension(kind: u8) -> usize {
    match kind {
        0..=2 => 0,
        3 | 4 | 21 | 35 | 68 | 75 => 1,
        5..=9 | 22 | 23 | 28 | 30 | 34 | 36 | 69 | 70 | 76 | 77 => 2,
        _ => 3,
    }
}

/// The reason why a cell of a VTK type with this number of points cannot be read; `None` if it can. Either its points are
/// control points that the cell does not interpolate, or their places are not defined.
pub(crate) fn refused(kind: u8, points: usize) -> Option<String> {
    match kind {
        75..=81 => Some(format!(
            "a cell of Bezier, type {kind} of VTK, is not read, since its points are control points: write it as one of \
             Lagrange, with values at its nodes"
        )),
        68..=73 if CellShape::of(kind, points).is_none() => Some(format!(
            "a cell of Lagrange, type {kind} of VTK, with {points} points is not read: expected the same degree along all \
             axes, {} at most",
            lagrange::MOST
        )),
        _ => None,
    }
}

/// A kind of cell.
#[derive(Debug)]
pub struct CellShape {
    kind: u8,
    /// The dimension of the cell.
    pub dimension: usize,
    /// The nodes in the reference cell.
    pub nodes: Vec<Local>,
    corners: usize,
    form: Form,
    /// The degree along each axis; 0 for polygons.
    degrees: [u32; 3],
    functions: Functions,
    edges: Vec<[usize; 2]>,
}

static SHAPES: LazyLock<Vec<CellShape>> =
    LazyLock::new(|| ROWS.iter().map(CellShape::of_row).collect());

/// The position of the shape with a number in VTK.
static BY_KIND: LazyLock<[Option<usize>; 256]> = LazyLock::new(|| {
    std::array::from_fn(|kind| ROWS.iter().position(|row| usize::from(row.0) == kind))
});

/// Shapes that are made on first use: Lagrange cells by kind and degree, and polygons by the number of corners.
static LAGRANGE: [[OnceLock<CellShape>; lagrange::MOST + 1]; lagrange::KINDS] =
    [const { [const { OnceLock::new() }; lagrange::MOST + 1] }; lagrange::KINDS];
static POLYGONS: [OnceLock<CellShape>; MOST_SIDES + 1] =
    [const { OnceLock::new() }; MOST_SIDES + 1];

impl CellShape {
    /// The shape of this VTK type with this number of points, if it is known.
    pub fn of(kind: u8, points: usize) -> Option<&'static CellShape> {
        // Meshes have as many cells as points, but few kinds.
        if let Some(at) = BY_KIND[usize::from(kind)] {
            return Some(&SHAPES[at]).filter(|it| it.nodes.len() == points);
        }
        if let Some(at) = lagrange::position(kind) {
            let degree = lagrange::degree(at, points)?;
            return Some(LAGRANGE[at][degree].get_or_init(|| CellShape::lagrange(at, degree)));
        }
        match (kind, points) {
            (7, 3) => CellShape::of(5, points),
            (7, 4) => CellShape::of(9, points),
            (7, 5..=MOST_SIDES) => {
                Some(POLYGONS[points].get_or_init(|| CellShape::polygon(points)))
            }
            _ => None,
        }
    }

    /// All shapes with a fixed number of points.
    pub fn all() -> impl Iterator<Item = &'static CellShape> {
        SHAPES.iter()
    }

    fn of_row(&(kind, dimension, corners, between, space): &CellType) -> CellShape {
        let middle = |of: &&[usize]| {
            std::array::from_fn(|axis| {
                of.iter().map(|&corner| corners[corner][axis]).sum::<f64>() / of.len() as f64
            })
        };
        let nodes = corners.iter().copied().chain(between.iter().map(middle)).collect();
        CellShape::new(kind, dimension, nodes, corners.len(), space)
    }

    fn new(
        kind: u8,
        dimension: usize,
        nodes: Vec<Local>,
        corners: usize,
        space: Space,
    ) -> CellShape {
        let functions = space.functions(dimension, &nodes);
        let (form, degrees) = (space.form(), space.degrees());
        let edges = edges(form, &nodes[..corners]);
        CellShape { kind, dimension, nodes, corners, form, degrees, functions, edges }
    }

    fn lagrange(at: usize, degree: usize) -> CellShape {
        let n = degree as u32;
        let (space, dimension, corners) = [
            (Space::Product([n; 3]), 1, 2),
            (Space::Complete(n), 2, 3),
            (Space::Product([n; 3]), 2, 4),
            (Space::Complete(n), 3, 4),
            (Space::Product([n; 3]), 3, 8),
            (Space::Wedge([n; 2]), 3, 6),
        ][at];
        let nodes = lagrange::nodes(at, degree).into_iter();
        let nodes = nodes.map(|it| it.map(|steps| steps as f64 / f64::from(n))).collect();
        CellShape::new(68 + at as u8, dimension, nodes, corners, space)
    }

    fn polygon(corners: usize) -> CellShape {
        let corner = |at: usize| {
            let (sin, cos) = (std::f64::consts::TAU * at as f64 / corners as f64).sin_cos();
            [(1.0 + cos) / 2.0, (1.0 + sin) / 2.0, 0.0]
        };
        let nodes: Vec<Local> = (0..corners).map(corner).collect();
        let (form, functions, degrees) = (Form::Polygon, Functions::None, [0; 3]);
        let edges = edges(form, &nodes);
        CellShape { kind: 7, dimension: 2, nodes, corners, form, degrees, functions, edges }
    }

    /// The number in VTK.
    pub fn kind(&self) -> u8 {
        self.kind
    }

    /// The degree up to which the functions contain all polynomials; 0 if the functions are not known, as for polygons.
    pub fn degree(&self) -> u32 {
        self.degrees[..self.dimension].iter().copied().min().unwrap_or(0)
    }

    /// Whether the shape functions are known.
    pub fn has_functions(&self) -> bool {
        self.form != Form::Polygon
    }

    /// The number of Gauss points along an axis.
    pub(crate) fn along(&self) -> usize {
        LEAST_GAUSS_POINTS.max(self.highest() + POINTS_ABOVE_DEGREE) as usize
    }

    /// The highest degree along an axis.
    pub(crate) fn highest(&self) -> u32 {
        self.degrees[..self.dimension].iter().copied().max().unwrap_or(0)
    }

    /// The values of the shape functions at a place.
    pub fn values(&self, at: Local) -> Vec<f64> {
        self.functions.at(at, None)
    }

    /// The derivatives of the shape functions by a reference coordinate.
    pub fn derivatives(&self, at: Local, axis: usize) -> Vec<f64> {
        self.functions.at(at, Some(axis))
    }

    /// The centre of volume of the reference cell.
    pub fn middle(&self) -> Local {
        if self.form == Form::Pyramid {
            return [0.5, 0.5, 0.25];
        }
        let corners = &self.nodes[..self.corners];
        std::array::from_fn(|axis| {
            corners.iter().map(|it| it[axis]).sum::<f64>() / self.corners as f64
        })
    }

    /// Pairs of corners that are joined by an edge.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The nodes between two corners, in their order.
    pub(crate) fn between(&self, [a, b]: [usize; 2]) -> Vec<usize> {
        let ends = [self.nodes[a], self.nodes[b]];
        let along = |node: &Local| -> f64 {
            (0..3).map(|axis| (node[axis] - ends[0][axis]) * (ends[1][axis] - ends[0][axis])).sum()
        };
        let length = along(&ends[1]);
        let is_on = |node: &Local| {
            let part = along(node) / length;
            let off = |axis: usize| {
                (node[axis] - ends[0][axis] - part * (ends[1][axis] - ends[0][axis])).abs()
            };
            (0..3).all(|axis| off(axis) < 1e-9)
        };
        let others = self.nodes.iter().enumerate().skip(self.corners);
        let mut found: Vec<(usize, f64)> =
            others.filter(|(_, it)| is_on(it)).map(|(at, it)| (at, along(it))).collect();
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        found.into_iter().map(|it| it.0).collect()
    }

    /// The place in the cell for a place of a unit cube, and the ratio of volumes there. A triangle is a square with one edge
    /// collapsed to a corner, a tetrahedron a collapsed cube.
    pub(crate) fn of_cube(&self, [x, y, z]: Local) -> (Local, f64) {
        match (self.form, self.dimension) {
            (Form::Simplex, 2) => ([x, y * (1.0 - x), 0.0], 1.0 - x),
            (Form::Wedge, _) => ([x, y * (1.0 - x), z], 1.0 - x),
            (Form::Simplex, _) => {
                let rest = (1.0 - x) * (1.0 - y);
                ([x, y * (1.0 - x), z * rest], (1.0 - x) * rest)
            }
            _ => ([x, y, z], 1.0),
        }
    }
}

/// Pairs of corners that are joined by an edge.
fn edges(form: Form, corners: &[Local]) -> Vec<[usize; 2]> {
    let differ = |a: usize, b: usize, axis: usize| corners[a][axis] != corners[b][axis];
    let is_along = |a: usize, b: usize| (0..3).filter(|&it| differ(a, b, it)).count() == 1;
    let count = corners.len();
    let is_edge = |a: usize, b: usize| match form {
        Form::Simplex => true,
        Form::Wedge => is_along(a, b) || !differ(a, b, 2),
        Form::Pyramid => is_along(a, b) || differ(a, b, 2),
        Form::Cube => is_along(a, b),
        Form::Polygon => b - a == 1 || b - a == count - 1,
    };
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
    pairs.filter(|&[a, b]| is_edge(a, b)).collect()
}

/// Gauss points and weights on [0, 1]: the roots of a Legendre polynomial, by Newton's method.
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
    fn integral(shape: &CellShape, [a, b, c]: [u32; 3]) -> f64 {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        match shape.form {
            Form::Simplex => {
                let all = factorial(a + b + c + shape.dimension as u32);
                factorial(a) * factorial(b) * factorial(c) / all
            }
            Form::Wedge => factorial(a) * factorial(b) / factorial(a + b + 2) / f64::from(c + 1),
            _ => 1.0 / f64::from((a + 1) * (b + 1) * (c + 1)),
        }
    }

    /// All kinds, including Lagrange cells up to degree 6.
    fn shapes() -> impl Iterator<Item = &'static CellShape> {
        let lagrange = (0..lagrange::KINDS).flat_map(|at| {
            let of = move |n| CellShape::of(68 + at as u8, lagrange::nodes(at, n).len()).unwrap();
            (1..=6).map(of)
        });
        CellShape::all().chain(lagrange)
    }

    #[test]
    fn quadrature_is_exact_to_its_degree() {
        for shape in shapes() {
            let along = gauss(shape.along());
            let degree = 2 * along.len() as u32 - 1 - (shape.dimension as u32 - 1);
            assert!(degree >= 2 * (shape.highest() + 1), "{}", shape.kind);
            let most = |axis: usize| if axis < shape.dimension { degree } else { 0 };
            let all = (0..=most(2)).flat_map(|c| {
                (0..=most(1)).flat_map(move |b| (0..=most(0)).map(move |a| [a, b, c]))
            });
            // All monomials of the highest degree, and some below.
            let is_tried = |it: &[u32; 3]| {
                let sum: u32 = it.iter().sum();
                sum == degree || sum < degree && it.iter().all(|power| power % 3 == 0)
            };
            for exponents in all.filter(is_tried) {
                let all = (0..along.len().pow(shape.dimension as u32)).map(|mut index| {
                    let (mut cube, mut weight) = ([0.0; 3], 1.0);
                    for to in &mut cube[..shape.dimension] {
                        (*to, weight) =
                            (along[index % along.len()].0, weight * along[index % along.len()].1);
                        index /= along.len();
                    }
                    let (at, factor) = shape.of_cube(cube);
                    weight * factor * functions::value(exponents, at)
                });
                let sum: f64 = all.sum();
                let exact = integral(shape, exponents);
                assert!((sum - exact).abs() < 1e-14, "{} {exponents:?}: {sum} {exact}", shape.kind);
            }
        }
    }

    /// Polynomials of the degree of a cell are interpolated to round-off, up to the highest degree that is read.
    #[test]
    fn interpolation_loses_few_digits() {
        for (at, most) in [(0, 10), (1, 10), (2, 10), (3, 10), (4, 8), (5, 8)] {
            let mut off = 0.0_f64;
            for n in 1..=most {
                let shape = CellShape::of(68 + at as u8, lagrange::nodes(at, n).len()).unwrap();
                let exact = |x: &Local| (0.4 + 0.3 * x[0] - 0.5 * x[1] + 0.2 * x[2]).powi(n as i32);
                let place = [0.31, 0.22, 0.13];
                let place = [0, 1, 2].map(|it| if it < shape.dimension { place[it] } else { 0.0 });
                let values = shape.values(place);
                let found: f64 = shape.nodes.iter().zip(&values).map(|(x, n)| exact(x) * n).sum();
                off = off.max((found - exact(&place)).abs());
            }
            assert!(off < 64.0 * f64::EPSILON, "{at}: {off:e}");
        }
    }

    #[test]
    fn functions_are_one_at_their_node_and_sum_to_one() {
        for shape in shapes() {
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
        for shape in shapes() {
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
        let of = |kind| CellShape::all().find(|it| it.kind == kind).unwrap();
        let edges = |kind| of(kind).edges().len();
        assert_eq!([3, 5, 9, 8, 10, 12, 11, 25].map(edges), [1, 3, 4, 4, 6, 12, 12, 12]);
        assert_eq!([13, 14].map(edges), [9, 8]);
        assert_eq!(CellShape::of(7, 6).unwrap().edges().len(), 6);
        let cubic = CellShape::of(72, 64).unwrap();
        assert_eq!((cubic.edges().len(), cubic.between([2, 6])), (12, vec![28, 29]));
    }

    /// The functions over x and y of the pyramid itself, where they are rational.
    #[test]
    fn functions_of_a_pyramid_are_those_of_bedrosian() {
        let pyramid = CellShape::of(14, 5).unwrap();
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
