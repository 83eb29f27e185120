//! A coarse mesh of a body: elements that are quadratic in each coordinate of its chart.
//!
//! Displacements at a node are components along the directions in which the coordinates grow, so that a roller constrains one
//! of them on a curved face too.

use mms_codegen::compile::Compiled;
use mms_mechanics::face::fixed_coordinate;
use mms_spec::{Claim, Face};
use nalgebra::{SMatrix, SVector};

use crate::chart::Chart;

/// The number of elements along each axis, by dimension.
const ELEMENTS: [usize; 3] = [8, 4, 2];

/// The number of elements along an axis on which the body closes on itself.
const ELEMENTS_AROUND: usize = 8;

/// Points of an element along each axis, as fractions of it, and their weights (Gauss, three points).
pub(crate) const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 4.0 / 9.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// A node.
#[derive(Clone, Debug)]
pub struct Node<const D: usize> {
    /// X.
    pub place: SVector<f64, D>,
    /// The directions of its displacements, as columns.
    pub basis: SMatrix<f64, D, D>,
    /// The components that the field prescribes.
    pub is_constrained: [bool; D],
    /// Whether no element has this node: in the middle of a disc, the elements share one of the nodes that coincide.
    pub is_unused: bool,
}

/// A point at which integrals are evaluated.
#[derive(Clone, Debug)]
pub struct Quadrature<const D: usize> {
    /// X.
    pub place: SVector<f64, D>,
    /// The volume of the quadrature point.
    pub weight: f64,
    /// The nodes whose shapes are not 0 there: number, value, gradient.
    pub shapes: Vec<(usize, f64, SVector<f64, D>)>,
}

/// The nodes of a body, and the points at which integrals over it are evaluated.
#[derive(Clone, Debug)]
pub struct Mesh<const D: usize> {
    /// The nodes.
    pub nodes: Vec<Node<D>>,
    /// The points of all elements.
    pub points: Vec<Quadrature<D>>,
    /// The number of elements along each axis.
    pub elements: [usize; D],
}

impl<const D: usize> Mesh<D> {
    /// The mesh of the body of a field, fixed where the field prescribes the displacement.
    pub fn new(compiled: &Compiled, chart: &Chart<D>) -> Self {
        let elements = std::array::from_fn(|axis| match chart.is_closed(axis) {
            true => ELEMENTS_AROUND,
            false => ELEMENTS[D - 1],
        });
        let lattice = Lattice { chart, elements };
        let nodes = (0..lattice.count()).map(|number| lattice.node(compiled, number)).collect();
        let cells = 0..elements.iter().product();
        let points = cells.flat_map(|cell| lattice.quadrature(cell)).collect();
        Mesh { nodes, points, elements }
    }
}

/// The claims about the faces: the displacement is prescribed if the field claims nothing.
fn claims(compiled: &Compiled) -> impl Iterator<Item = (Face, Claim)> {
    let field = &compiled.field;
    Face::of(&field.domain.body, field.space).into_iter().map(|face| {
        let claimed = field.boundary.iter().find(|boundary| boundary.face.value == face);
        (face, claimed.map_or(Claim::Prescribed, |boundary| boundary.claim.value))
    })
}

/// The nodes of a chart by their positions along each axis.
struct Lattice<'a, const D: usize> {
    chart: &'a Chart<D>,
    elements: [usize; D],
}

impl<const D: usize> Lattice<'_, D> {
    /// The number of positions along an axis.
    fn along(&self, axis: usize) -> usize {
        2 * self.elements[axis] + usize::from(!self.chart.is_closed(axis))
    }

    fn count(&self) -> usize {
        (0..D).map(|axis| self.along(axis)).product()
    }

    fn positions(&self, mut number: usize) -> [usize; D] {
        std::array::from_fn(|axis| {
            let position = number % self.along(axis);
            number /= self.along(axis);
            position
        })
    }

    /// The number of a node: positions share a node where the body closes on itself, and where all angles are one place.
    fn number(&self, positions: [usize; D]) -> usize {
        let at = |end: usize| {
            std::array::from_fn(|axis| positions[axis] == end * 2 * self.elements[axis])
        };
        let is_one = self.chart.collapsed(at(0), at(1));
        (0..D).rev().fold(0, |number, axis| {
            let position = if is_one[axis] { 0 } else { positions[axis] % self.along(axis) };
            number * self.along(axis) + position
        })
    }

    fn fractions(&self, positions: [usize; D]) -> [f64; D] {
        std::array::from_fn(|axis| positions[axis] as f64 / (2 * self.elements[axis]) as f64)
    }

    fn node(&self, compiled: &Compiled, number: usize) -> Node<D> {
        let positions = self.positions(number);
        let fractions = self.fractions(positions);
        let is_unused = self.number(positions) != number;
        let mut is_constrained = [is_unused; D];
        for (face, claim) in claims(compiled) {
            let (axis, is_upper) = fixed_coordinate(face);
            let end = if is_upper { 2 * self.elements[axis] } else { 0 };
            if positions[axis] != end || !self.chart.has(face) {
                continue;
            }
            match claim {
                Claim::Fixed | Claim::Prescribed => is_constrained = [true; D],
                Claim::Roller => is_constrained[axis] = true,
                Claim::Free | Claim::Traction | Claim::Axis => {}
            }
        }
        let basis = self.chart.basis(&fractions);
        Node { place: self.chart.place(&fractions), basis, is_constrained, is_unused }
    }

    fn quadrature(&self, cell: usize) -> Vec<Quadrature<D>> {
        let mut rest = cell;
        let first: [usize; D] = std::array::from_fn(|axis| {
            let position = rest % self.elements[axis];
            rest /= self.elements[axis];
            position
        });
        (0..3_usize.pow(D as u32)).map(|point| self.point(first, ternary(point))).collect()
    }

    /// The Gauss point with these indices in an element.
    fn point(&self, first: [usize; D], gauss: [usize; D]) -> Quadrature<D> {
        let inside = gauss.map(|position| GAUSS[position][0]);
        let fractions: [f64; D] = std::array::from_fn(|axis| {
            (first[axis] as f64 + inside[axis]) / self.elements[axis] as f64
        });
        let (scales, basis) = (self.chart.scales(&fractions), self.chart.basis(&fractions));
        let sides: [f64; D] = std::array::from_fn(|axis| scales[axis] / self.elements[axis] as f64);
        let weights = gauss.iter().zip(sides).map(|(position, side)| GAUSS[*position][1] * side);
        let shapes = (0..3_usize.pow(D as u32)).map(|node| {
            let local = ternary::<D>(node);
            let values: [[f64; 2]; D] =
                std::array::from_fn(|axis| quadratic(local[axis], inside[axis]));
            let value = values.iter().map(|[value, _]| value).product();
            let slope = SVector::from_fn(|along, _| {
                let factors = (0..D).map(|axis| values[axis][usize::from(axis == along)]);
                factors.product::<f64>() / sides[along]
            });
            let positions = std::array::from_fn(|axis| 2 * first[axis] + local[axis]);
            (self.number(positions), value, basis * slope)
        });
        let shapes = shapes.collect();
        Quadrature { place: self.chart.place(&fractions), weight: weights.product(), shapes }
    }
}

fn ternary<const D: usize>(mut number: usize) -> [usize; D] {
    std::array::from_fn(|_| {
        let digit = number % 3;
        number /= 3;
        digit
    })
}

/// The quadratic polynomial that is 1 at one of the fractions 0, 1/2 and 1 and 0 at the others, and its slope.
pub(crate) fn quadratic(node: usize, x: f64) -> [f64; 2] {
    match node {
        0 => [(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x - 3.0],
        1 => [4.0 * x * (1.0 - x), 4.0 - 8.0 * x],
        _ => [x * (2.0 * x - 1.0), 4.0 * x - 1.0],
    }
}
