//! Corners of faces that can move: the edge of a body where two such faces meet is softer than each of them.
//!
//! A corner has no length scale: if a displacement near it lowers the energy, the same displacement at half the size does, too,
//! and grows twice as fast. So the sign of the least ratio of the second variation to the integral of mu |grad v|^2, over
//! displacements of the quadrant between both faces, tells whether any displacement grows. A mesh that is graded towards the
//! corner bounds the ratio from above: if the bound is negative, so is the ratio.

use mms_codegen::compile::Compiled;
use mms_mechanics::face::fixed_coordinate;
use mms_spec::{Claim, Face};
use nalgebra::{DMatrix, SMatrix, SVector};

use crate::chart::components;
use crate::elasticity::Elasticity;
use crate::least::least;
use crate::mesh::{GAUSS, quadratic};
use crate::pencil::Pencil;
use crate::subject::Subject;
use crate::waves::Recent;

/// The number of places along an edge of a body of three dimensions at which the softest state is searched.
const PLACES: usize = 3;
/// The number of times at which the softest state is searched.
const TIMES: usize = 7;

/// The number of elements along each side of the quadrant, in two and in three dimensions.
const ELEMENTS: [usize; 2] = [5, 4];
/// The ratio of the length of each element to the next.
const GRADING: f64 = 0.25;

/// The result at a corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// The faces that meet there.
    pub faces: [Face; 2],
    /// The least second variation over the integral of |grad v|^2 times the modulus at rest.
    pub coercivity: f64,
    /// X.
    pub at: Vec<f64>,
    /// t.
    pub time: f64,
}

/// Evaluates every corner of two faces that are loaded, free or on rollers, in the state whose tangent is softest. Two rollers
/// allow only displacements that are symmetric about both, as in the body.
pub fn corners<const D: usize>(compiled: &Compiled, subject: &mut Subject<'_, D>) -> Vec<Corner> {
    if D == 1 {
        return Vec::new();
    }
    let claimed = compiled.field.boundary.iter().map(|it| (it.face.value, it.claim.value));
    let moving: Vec<_> = claimed
        .filter(|(_, claim)| !matches!(claim, Claim::Fixed | Claim::Prescribed))
        .filter(|(face, _)| subject.chart.has(*face))
        .collect();
    let pairs = moving
        .iter()
        .enumerate()
        .flat_map(|(at, one)| moving[at + 1..].iter().map(move |other| [*one, *other]));
    let meet = |pair: &[(Face, Claim); 2]| {
        let [first, second] = pair.map(|(face, _)| fixed_coordinate(face).0);
        first != second && pair.iter().any(|(_, claim)| *claim != Claim::Roller)
    };
    pairs.filter(meet).filter_map(|pair| corner(subject, pair)).collect()
}

fn corner<const D: usize>(
    subject: &mut Subject<'_, D>,
    pair: [(Face, Claim); 2],
) -> Option<Corner> {
    let faces = pair.map(|(face, _)| face);
    let times = if subject.is_static { 2 } else { TIMES };
    let counts = [&vec![PLACES; D - 2][..], &[times]].concat();
    let mut recent = Recent::new();
    let softest = least(&counts, |fractions| {
        let place = on_edge(faces, &fractions[..D - 2]);
        let state = recent.state(subject, &place, fractions[D - 2])?;
        Some(state.elasticity.least_eigenvalue() / state.modulus)
    })?;
    let place = on_edge(faces, &softest.at[..D - 2]);
    let time = subject.time(softest.at[D - 2]);
    let state = subject.state(&subject.chart.place(&place), time)?;
    let frame = frame(subject, faces, &place);
    let rolls = pair.map(|(_, claim)| claim == Claim::Roller);
    let pencil = quadrant(&state.elasticity, &frame, rolls);
    Some(Corner {
        faces,
        coercivity: pencil.least(&[], state.modulus)? / state.modulus,
        at: components(&subject.chart.place(&place)),
        time,
    })
}

/// The fractions of a point where two faces meet, from the fraction along their edge.
fn on_edge<const D: usize>(faces: [Face; 2], along: &[f64]) -> [f64; D] {
    let ends = faces.map(fixed_coordinate);
    std::array::from_fn(|own| match ends.iter().find(|(axis, _)| *axis == own) {
        Some((_, is_upper)) => f64::from(u8::from(*is_upper)),
        None => along.first().copied().unwrap_or(0.5),
    })
}

/// The normals of both faces, and the direction of their edge in space, as columns.
fn frame<const D: usize>(
    subject: &Subject<'_, D>,
    faces: [Face; 2],
    place: &[f64; D],
) -> SMatrix<f64, D, D> {
    let [first, second] = faces.map(|face| subject.chart.frame(face, place).0);
    let edge = || {
        let basis = subject.chart.basis(place);
        let is_along = |axis: &usize| faces.iter().all(|face| fixed_coordinate(*face).0 != *axis);
        (0..D).find(is_along).map(|axis| basis.column(axis).into_owned())
    };
    let columns: Vec<SVector<f64, D>> = [first, second].into_iter().chain(edge()).collect();
    SMatrix::from_columns(&columns)
}

/// The second variation of a quadrant in one state, and the integral of |grad v|^2, for v that vanishes at a distance and is
/// constant along the edge. Components of v are along the frame; on a roller the component along its normal is 0.
fn quadrant<const D: usize>(
    elasticity: &Elasticity<D>,
    frame: &SMatrix<f64, D, D>,
    rolls: [bool; 2],
) -> Pencil {
    let [first, second] = [0, 1].map(|column| frame.column(column).into_owned());
    let block = |v, w| frame.transpose() * elasticity.contract(v, w) * frame;
    let (aa, ab, bb) = (block(&first, &first), block(&first, &second), block(&second, &second));
    let line = Line::new(ELEMENTS[D - 2]);
    let nodes = line.mass.nrows();
    let free: Vec<[usize; 3]> = (0..nodes * nodes * D)
        .map(|number| [number / D / nodes, number / D % nodes, number % D])
        .filter(|[a, b, axis]| {
            !(rolls[0] && *a == 0 && *axis == 0 || rolls[1] && *b == 0 && *axis == 1)
        })
        .collect();
    let order = free.len();
    let [mut stiffness, mut mass] = [(); 2].map(|()| DMatrix::zeros(order, order));
    for (row, [a, b, i]) in free.iter().copied().enumerate() {
        for (column, [p, q, k]) in free.iter().copied().enumerate() {
            let across = line.stiffness[(a, p)] * line.mass[(b, q)];
            let along = line.mass[(a, p)] * line.stiffness[(b, q)];
            let mixed = line.slope[(a, p)] * line.slope[(q, b)];
            let turned = line.slope[(p, a)] * line.slope[(b, q)];
            stiffness[(row, column)] =
                aa[(i, k)] * across + bb[(i, k)] * along + ab[(i, k)] * mixed + ab[(k, i)] * turned;
            mass[(row, column)] = if i == k { across + along } else { 0.0 };
        }
    }
    Pencil { stiffness, mass }
}

/// Integrals over a side of the quadrant of products of two shapes: of both, of both slopes, and of the slope of the first
/// times the second. The last node is fixed.
struct Line {
    mass: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    slope: DMatrix<f64>,
}

impl Line {
    fn new(elements: usize) -> Self {
        let nodes = 2 * elements;
        let [mut mass, mut stiffness, mut slope] = [(); 3].map(|()| DMatrix::zeros(nodes, nodes));
        let mut start = 0.0;
        for element in 0..elements {
            let end = GRADING.powi((elements - 1 - element) as i32);
            let length = end - start;
            start = end;
            for (point, a, b) in products() {
                let (row, column) = (2 * element + a, 2 * element + b);
                if row == nodes || column == nodes {
                    continue;
                }
                let [inside, weight] = GAUSS[point];
                let [[value_a, slope_a], [value_b, slope_b]] =
                    [a, b].map(|node| quadratic(node, inside));
                mass[(row, column)] += weight * length * value_a * value_b;
                stiffness[(row, column)] += weight / length * slope_a * slope_b;
                slope[(row, column)] += weight * slope_a * value_b;
            }
        }
        Line { mass, stiffness, slope }
    }
}

/// Each point of an element with each pair of its nodes.
fn products() -> impl Iterator<Item = (usize, usize, usize)> {
    (0..27).map(|number| (number / 9, number / 3 % 3, number % 3))
}
