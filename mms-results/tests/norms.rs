//! Compares norms with sums and quadratures computed in another way.

use mms_results::Cells;
use mms_results::cell::{CellShape, Local};
use mms_results::comparison::Comparison;
use mms_results::mesh::Mesh;
use mms_results::norm::{largest, lengths, of_differences, over_points};
use mms_results::over_cells::{Carried, Exact, SolutionPart};

use crate::sampled::sampled;

/// One of this many kinds of cells is integrated finely.
const SHARE: usize = 3;

#[test]
fn norms_over_points_are_their_definitions() {
    let errors: Vec<f64> = lengths(&[3.0, 4.0, 1.0, 0.0], &[0.0, 0.0, 1.0, 0.0], 2).collect();
    assert_eq!(errors, [5.0, 0.0]);
    let norms = over_points(errors.iter().copied(), None).unwrap();
    assert_eq!((norms.l1, norms.l2, norms.linf, norms.at), (2.5, 12.5_f64.sqrt(), 5.0, 0));
    let differences = of_differences(&[3.0, 4.0, 1.0, 0.0], &[0.0, 0.0, 1.0, 0.0], 2, None);
    assert_eq!(differences, Some(norms));
    assert_eq!((largest(&[-3.0, 2.0]), largest(&[])), (3.0, 0.0));
    let weighted = over_points(errors.iter().copied(), Some(&[1.0, 3.0])).unwrap();
    assert_eq!((weighted.l1, weighted.l2, weighted.linf), (1.25, 2.5, 5.0));
    assert_eq!(over_points([], None), None);
    assert_eq!(over_points(errors.iter().copied(), Some(&[0.0, 0.0])), None);
}

/// Scaling errors by a power of two scales their norms, for very small and very large errors.
#[test]
fn norms_neither_underflow_nor_overflow() {
    let errors = [3.0, 4.0, 12.0, 1.0, 0.25, 7.0];
    let norms = |scale: f64| {
        let computed: Vec<f64> = errors.iter().map(|it| it * scale).collect();
        of_differences(&computed, &[0.0; 6], 2, None).expect("norms")
    };
    let usual = norms(1.0);
    for power in [-1000, -600, -465, -464, 464, 465, 600, 1000] {
        let (scale, found) = (2f64.powi(power), norms(2f64.powi(power)));
        let near = |a: f64, b: f64| (a / scale / b - 1.0).abs() < 1e-14;
        assert!(near(found.l1, usual.l1) && near(found.l2, usual.l2), "2^{power}: {found:?}");
        assert!(near(found.linf, usual.linf), "2^{power}: {found:?}");
    }
    // Errors on both sides of the threshold of scaling.
    let mixed = over_points([0.9e140, 1.1e140, 0.9e140], None).expect("norms");
    assert!((mixed.l2 / (2.83_f64 / 3.0).sqrt() - 1e140).abs() < 1e126, "{mixed:?}");
}

/// The exact numbers come in blocks of any size.
#[test]
fn a_comparison_is_that_of_all_points_at_once() {
    let rows = 300_000;
    let number = |at: usize, step: f64| (at as f64 * step).fract() - 0.5;
    let exact: Vec<f64> = (0..2 * rows).map(|at| number(at, 1.618)).collect();
    let computed: Vec<f64> = (0..2 * rows).map(|at| exact[at] + 1e-3 * number(at, 2.45)).collect();
    let weights: Vec<f64> = (0..rows).map(|at| 1.0 + number(at, 0.77)).collect();
    for weights in [None, Some(&weights[..])] {
        let mut comparison = Comparison::new(&computed, 2, weights);
        let mut rest = &exact[..];
        let mut size = 2;
        while !rest.is_empty() {
            let (block, after) = rest.split_at(rest.len().min(size));
            assert_eq!(comparison.add(block), Ok(()));
            (rest, size) = (after, 3 * size);
        }
        assert_eq!(comparison.norms(), of_differences(&computed, &exact, 2, weights));
        assert_eq!(comparison.largest(), largest(&exact));
        assert_eq!(comparison.unit(), None);
    }
    let thousandths: Vec<f64> = computed.iter().map(|it| 1e3 * it).collect();
    let mut comparison = Comparison::new(&thousandths, 2, None);
    assert_eq!(comparison.add(&exact[..3000]), Ok(()));
    assert_eq!(comparison.unit(), Some(3));
    let wrong = [1.0, f64::NAN, f64::INFINITY, 1.0];
    assert_eq!(comparison.add(&wrong), Err(1));
    assert_eq!(comparison.norms(), of_differences(&thousandths[..3000], &exact[..3000], 2, None));
    assert_eq!(Comparison::new(&[], 2, None).norms(), None);
}

fn carried(values: &[f64], components: usize) -> Carried<'_> {
    Carried { values, components, has_gradient: true }
}

/// One cell of a kind, at X = A xi with A below.
struct One {
    cells: Cells,
    points: Vec<f64>,
    dimension: usize,
}

/// The rows of A, which stretches and shears a cell.
const A: [[f64; 3]; 3] = [[0.7, 0.2, 0.1], [0.0, 0.9, -0.3], [0.0, 0.0, 0.6]];

fn place(local: Local, dimension: usize) -> Vec<f64> {
    (0..dimension).map(|row| (0..dimension).map(|j| A[row][j] * local[j]).sum()).collect()
}

/// The place in the reference cell, by back substitution.
fn local(place: &[f64]) -> Local {
    let mut local = [0.0; 3];
    for row in (0..place.len()).rev() {
        let known: f64 = (row + 1..place.len()).map(|j| A[row][j] * local[j]).sum();
        local[row] = (place[row] - known) / A[row][row];
    }
    local
}

impl One {
    fn new(shape: &CellShape) -> Self {
        let (dimension, count) = (shape.dimension, shape.nodes.len());
        let cells =
            Cells { types: vec![shape.kind()], points: (0..count).collect(), ends: vec![count] };
        let points = shape.nodes.iter().flat_map(|&node| place(node, dimension)).collect();
        One { cells, points, dimension }
    }

    fn mesh(&self) -> Mesh<'_> {
        Mesh {
            cells: &self.cells,
            points: &self.points,
            dimension: self.dimension,
            is_meridian: false,
        }
    }
}

/// A smooth function of two components, and its gradient by differences.
fn smooth(x: &[f64]) -> [f64; 2] {
    let phase: f64 = x.iter().zip([1.3, 0.7, -0.4]).map(|(x, k)| k * x).sum();
    [phase.sin(), 0.3 * (2.0 * phase).cos()]
}

fn gradient(of: impl Fn(&[f64]) -> [f64; 2], x: &[f64]) -> Vec<f64> {
    let step = 1e-5;
    let by = |axis: usize| {
        let moved = |by: f64| {
            let mut x = x.to_vec();
            x[axis] += by;
            of(&x)
        };
        let (before, after) = (moved(-step), moved(step));
        [0, 1].map(|row| (after[row] - before[row]) / (2.0 * step))
    };
    let columns: Vec<_> = (0..x.len()).map(by).collect();
    [0, 1].into_iter().flat_map(|row| columns.iter().map(move |column| column[row])).collect()
}

fn exact(asked: SolutionPart, places: &[f64], dimension: usize) -> Vec<f64> {
    let points = places.chunks(dimension);
    match asked {
        SolutionPart::Values => points.flat_map(smooth).collect(),
        SolutionPart::Gradients => points.flat_map(|x| gradient(smooth, x)).collect(),
    }
}

const WEDGE: u8 = 13;
const PYRAMID: u8 = 14;

/// Converts coordinates of the corners to those in which the functions of a cell are known: for a pyramid, coordinates in the
/// cube that is collapsed to it.
fn known(shape: &CellShape, [x, y, z]: Local) -> Local {
    match shape.kind() {
        PYRAMID => [x / (1.0 - z), y / (1.0 - z), z],
        _ => [x, y, z],
    }
}

/// Points spread evenly over a reference cell: a grid; on a simplex, the differences of sorted coordinates, which are spread
/// evenly too; in a pyramid more of them where it is wide.
fn spread(shape: &CellShape, per_edge: usize) -> Vec<Local> {
    let simplex = match shape.kind() {
        5 | 10 | 22 | 24 | 69 | 71 => shape.dimension,
        WEDGE | 26 | 31 | 32 | 73 => 2,
        _ => 0,
    };
    let count = per_edge.pow(shape.dimension as u32);
    let coordinate = |index: usize, axis: usize| {
        ((index / per_edge.pow(axis as u32)) % per_edge) as f64 / per_edge as f64
            + 0.5 / per_edge as f64
    };
    let point = |index: usize| {
        let mut at = [0.0; 3];
        (0..shape.dimension).for_each(|axis| at[axis] = coordinate(index, axis));
        at[..simplex].sort_by(|a, b| b.total_cmp(a));
        (1..simplex).for_each(|axis| at[axis - 1] -= at[axis]);
        match shape.kind() {
            // The part of the volume above z is (1 - z)^3.
            PYRAMID => {
                let [x, y, above] = at;
                let side = above.cbrt();
                [x * side, y * side, 1.0 - side]
            }
            _ => at,
        }
    };
    (0..count).map(point).collect()
}

#[test]
fn norms_over_a_cell_are_those_of_a_sum_over_many_points() {
    let lagrange = [(68, 4), (68, 6), (69, 15), (70, 25), (71, 20)];
    let lagrange = lagrange.map(|(kind, points)| CellShape::of(kind, points).unwrap());
    for shape in sampled(CellShape::all().chain(lagrange), SHARE) {
        let (one, dimension) = (One::new(shape), shape.dimension);
        let values: Vec<f64> = one.points.chunks(dimension).flat_map(smooth).collect();
        let mut asked = |what: SolutionPart, places: &[f64]| Ok(exact(what, places, dimension));
        let found = one.mesh().measure(carried(&values, 2), &mut asked).unwrap();
        let computed = |x: &[f64]| {
            let functions = shape.values(known(shape, local(x)));
            [0, 1].map(|row| {
                functions.iter().enumerate().map(|(node, n)| n * values[2 * node + row]).sum()
            })
        };
        let points = spread(shape, [20_000, 150, 30][dimension - 1]);
        let (mut of_value, mut of_gradient) = (Vec::new(), Vec::new());
        for &at in &points {
            let x = place(at, dimension);
            of_value.extend(lengths(&computed(&x), &smooth(&x), 2));
            let size = 2 * dimension;
            of_gradient.extend(lengths(&gradient(computed, &x), &gradient(smooth, &x), size));
        }
        let value = over_points(of_value, None).unwrap();
        let near = |a: f64, b: f64, most: f64| {
            assert!((a / b - 1.0).abs() < most, "{}: {a} {b}", shape.kind());
        };
        near(found.value.l2, value.l2, 5e-3);
        near(found.value.l1, value.l1, 5e-3);
        near(found.h1, over_points(of_gradient, None).unwrap().l2, 5e-3);
        // The largest of many points is slightly less than the maximum.
        near(found.value.linf, value.linf, [1e-3, 0.01, 0.05][dimension - 1]);
        assert!(found.value.linf > 0.99999 * value.linf, "{}", shape.kind());
    }
}

/// A cell with displaced nodes still represents linear functions of X.
#[test]
fn what_is_linear_has_no_error_on_any_cell() {
    for shape in CellShape::all() {
        let mut one = One::new(shape);
        let wobble = |(at, x): (usize, &mut f64)| *x += 0.03 * ((7 * at) as f64).sin();
        one.points.iter_mut().enumerate().for_each(wobble);
        let linear =
            |x: &[f64]| 0.5 + x.iter().zip([1.0, -2.0, 3.0]).map(|(x, k)| k * x).sum::<f64>();
        let values: Vec<f64> = one.points.chunks(shape.dimension).map(linear).collect();
        let mut asked = |what: SolutionPart, places: &[f64]| {
            let points = places.chunks(shape.dimension);
            Ok(match what {
                SolutionPart::Values => points.map(linear).collect(),
                SolutionPart::Gradients => {
                    points.flat_map(|x| [1.0, -2.0, 3.0][..x.len()].to_vec()).collect()
                }
            })
        };
        let found = one.mesh().measure(carried(&values, 1), &mut asked).unwrap();
        assert!(found.value.linf < 1e-13 && found.h1 < 1e-11, "{}: {found:?}", shape.kind());
    }
}

/// A grid of quads or triangles on the unit square, of degree 1 or 2.
fn grid(cells: usize, kind: u8) -> (Cells, Vec<f64>) {
    let degree = if [22, 28].contains(&kind) { 2 } else { 1 };
    let side = degree * cells + 1;
    let mut points = Vec::new();
    for j in 0..side {
        for i in 0..side {
            points.extend([i as f64 / (side - 1) as f64, j as f64 / (side - 1) as f64]);
        }
    }
    let shape = crate::shape(kind);
    let mut found = Cells::default();
    let node = |cell: [usize; 2], at: Local, flipped: bool| {
        let [x, y] = if flipped { [1.0 - at[0], 1.0 - at[1]] } else { [at[0], at[1]] };
        let [i, j] = [x, y].map(|it| (degree as f64 * it) as usize);
        degree * cell[0] + i + side * (degree * cell[1] + j)
    };
    let halves: &[bool] = if [5, 22].contains(&kind) { &[false, true] } else { &[false] };
    for index in 0..cells * cells {
        for &flipped in halves {
            let cell = [index % cells, index / cells];
            found.points.extend(shape.nodes.iter().map(|&at| node(cell, at, flipped)));
            found.ends.push(found.points.len());
            found.types.push(kind);
        }
    }
    (found, points)
}

/// Interpolants of degree p have the orders p + 1 and p: the quadrature of the norms preserves them.
#[test]
fn interpolants_have_their_orders() {
    for (kind, degree) in [(5, 1.0), (9, 1.0), (22, 2.0), (28, 2.0)] {
        let errors = [8, 16].map(|cells| {
            let (found, points) = grid(cells, kind);
            let mesh = Mesh { cells: &found, points: &points, dimension: 2, is_meridian: false };
            let sizes = mesh.sizes().unwrap();
            let edge = if kind == 5 || kind == 22 { 2f64.sqrt() } else { 1.0 } / cells as f64;
            assert!(sizes.iter().all(|size| (size - edge).abs() < 1e-12));
            let values: Vec<f64> = points.chunks(2).flat_map(smooth).collect();
            let mut asked = |what: SolutionPart, places: &[f64]| Ok(exact(what, places, 2));
            mesh.measure(carried(&values, 2), &mut asked).unwrap()
        });
        let order = |norm: &dyn Fn(usize) -> f64| (norm(0) / norm(1)).log2();
        let (l2, h1) = (order(&|at| errors[at].value.l2), order(&|at| errors[at].h1));
        assert!((l2 - degree - 1.0).abs() < 0.02, "{kind}: {l2}");
        assert!((h1 - degree).abs() < 0.02, "{kind}: {h1}");
    }
}

#[test]
fn flat_and_folded_cells_are_named() {
    let quad = Cells { types: vec![9], points: vec![0, 1, 2, 3], ends: vec![4] };
    let mut none = |what: SolutionPart, places: &[f64]| Ok(exact(what, places, 2));
    let said = |points: &[f64], exact: Exact<'_>| {
        let mesh = Mesh { cells: &quad, points, dimension: 2, is_meridian: false };
        mesh.measure(carried(&[0.0; 8], 2), exact).unwrap_err().what
    };
    let flat = said(&[0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 3.0, 0.0], &mut none);
    assert!(flat.contains("cell 0 is flat"), "{flat}");
    let folded = said(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0], &mut none);
    assert!(folded.contains("or folded"), "{folded}");
    let turned = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0];
    let mesh = Mesh { cells: &quad, points: &turned, dimension: 2, is_meridian: false };
    assert!(mesh.measure(carried(&[0.0; 8], 2), &mut none).is_ok());
    let solid = Mesh { cells: &quad, points: &[0.0; 12], dimension: 3, is_meridian: false };
    assert!(solid.measure(carried(&[0.0; 12], 3), &mut none).unwrap_err().what.contains("no cell"));
}

#[test]
fn middles_are_where_cells_are() {
    let (cells, points) = grid(2, 9);
    let mesh = Mesh { cells: &cells, points: &points, dimension: 2, is_meridian: false };
    assert_eq!(mesh.middles(), [0.25, 0.25, 0.75, 0.25, 0.25, 0.75, 0.75, 0.75]);
}

/// Integrals of monomials over a wedge and a pyramid, by their closed forms: a! b!/(a + b + 2)!/(c + 1), and over the
/// pyramid with a unit square below and its apex above a corner c! (a + b + 2)!/(a + b + c + 3)!/(a + 1)/(b + 1).
#[test]
fn monomials_over_wedges_and_pyramids_have_their_integrals() {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    let over_wedge =
        |[a, b, c]: [i32; 3]| factorial(a) * factorial(b) / factorial(a + b + 2) / f64::from(c + 1);
    let over_pyramid = |[a, b, c]: [i32; 3]| {
        let sides = f64::from((a + 1) * (b + 1));
        factorial(c) * factorial(a + b + 2) / factorial(a + b + c + 3) / sides
    };
    let wedge = crate::shape(WEDGE).nodes.concat();
    let pyramid = crate::shape(PYRAMID).nodes.concat();
    for (kind, points) in [(WEDGE, &wedge), (PYRAMID, &pyramid)] {
        let integral = |exponents| match kind {
            WEDGE => over_wedge(exponents),
            _ => over_pyramid(exponents),
        };
        let count = points.len() / 3;
        let cells = Cells { types: vec![kind], points: (0..count).collect(), ends: vec![count] };
        let mesh = Mesh { cells: &cells, points, dimension: 3, is_meridian: false };
        for exponents in (0..216).map(|it| [it % 6, it / 6 % 6, it / 36]) {
            if exponents.iter().sum::<i32>() > 5 {
                continue;
            }
            let monomial =
                |x: &[f64]| x.iter().zip(exponents).map(|(x, n)| x.powi(n)).product::<f64>();
            let mut asked = |what: SolutionPart, places: &[f64]| {
                let is_value = what == SolutionPart::Values;
                let size = if is_value { 1 } else { 3 };
                let value = |x: &[f64]| if is_value { monomial(x) } else { 0.0 };
                Ok(places.chunks(3).flat_map(|x| vec![value(x); size]).collect())
            };
            // An error equal to that monomial, whose mean is its integral over the volume.
            let found = mesh.measure(carried(&vec![0.0; count], 1), &mut asked).unwrap().value.l1;
            let expected = integral(exponents) / integral([0; 3]);
            assert!((found - expected).abs() < 1e-14, "{kind} {exponents:?}: {found} {expected}");
        }
    }
}

/// A cube of six pyramids that meet in its middle, and one of two wedges: linear functions have no error, and the volumes add
/// up to the cube's volume.
#[test]
fn pyramids_and_wedges_fill_a_cube() {
    let corners: Vec<f64> = crate::shape(12).nodes.concat();
    let faces =
        [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
    let pyramids: Vec<Vec<usize>> = faces.iter().map(|face| [&face[..], &[8]].concat()).collect();
    let wedges = vec![vec![0, 1, 2, 4, 5, 6], vec![0, 2, 3, 4, 6, 7]];
    for (kind, cells) in [(PYRAMID, pyramids), (WEDGE, wedges)] {
        let mut points = corners.clone();
        if kind == PYRAMID {
            points.extend([0.5; 3]);
        }
        let ends = (1..=cells.len()).map(|it| it * cells[0].len()).collect();
        let found = Cells { types: vec![kind; cells.len()], points: cells.concat(), ends };
        let mesh = Mesh { cells: &found, points: &points, dimension: 3, is_meridian: false };
        let volume: f64 = mesh.volumes().unwrap().iter().sum();
        assert!((volume - 1.0).abs() < 1e-14, "{kind}: {volume}");
        let longest = if kind == PYRAMID { 1.0 } else { 2f64.sqrt() };
        let sizes = mesh.sizes().unwrap();
        assert!(sizes.iter().all(|it| (it - longest).abs() < 1e-14), "{kind}: {sizes:?}");
    }
}
