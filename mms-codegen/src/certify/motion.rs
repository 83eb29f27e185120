//! The motion of a field in the variables of a chart, which proofs bound: H, C - I and its rate, J, the density,
//! and the stress as a function of H.

use crate::bounds::chart::Chart;
use crate::compile::Compiled;
use mms_mechanics::Response;
use mms_mechanics::invariant::{InvariantKind, SUPPLIED_VOLUME};
use mms_mechanics::kinematics::Strain;
use mms_mechanics::tensor::Tensor;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::replace;
use mms_symbolic::sorted::SortedMap;

/// The motion of a field in the variables of a chart.
///
/// Strains are reduced, so that rotations cancel in them, and on an annulus they are in the basis of radius and angle: a value
/// that does not depend on a rotation is bounded as sharply as without the rotation.
#[derive(Clone, Debug)]
pub struct ChartMotion {
    dimension: usize,
    /// H in the basis of space, for a material whose stress does not follow from C alone.
    pub oriented: Option<Vec<Expr>>,
    /// H, in the basis of the chart's coordinates.
    pub gradient: Vec<Expr>,
    /// dH/dt.
    pub gradient_rate: Vec<Expr>,
    /// C - I, in the basis of the chart's coordinates.
    pub right: Vec<Expr>,
    /// dC/dt.
    pub right_rate: Vec<Expr>,
    /// J.
    pub jacobian: Expr,
    /// 2 J^2 D : D, in two dimensions.
    pub squared_rate: Option<Expr>,
    /// rho0.
    pub density: Expr,
    /// P at a gradient H that is supplied; for isotropic materials, with [`SUPPLIED_VOLUME`] for
    /// J - 1.
    pub stress: Vec<Expr>,
}

impl ChartMotion {
    /// The motion of a compiled field.
    pub fn new(graph: &mut Graph, chart: &Chart, compiled: &Compiled) -> Self {
        let derived = &compiled.derived;
        let dimension = compiled.field.space.rows();
        let cartesian = gradient(graph, compiled);
        let cartesian = chart.pull_back(graph, &cartesian);
        let gradient = chart.in_local_basis(graph, &cartesian);
        let strain = strain(graph, &gradient);
        let right = strain.right.components().to_vec();
        let right_rate = differentiate(graph, &right, Symbol::Time);
        let squared_rate = squared_rate(graph, strain.jacobian, &right_rate);
        let gradient_rate = differentiate(graph, &gradient, Symbol::Time);
        let density = chart.pull_back(graph, &[compiled.model.density])[0];
        let stress = chart.pull_back(graph, &derived.responses[&Response::FirstPiolaKirchhoff]);
        // Rotations of the deformed and of the reference body then only rotate the stress, so that C in any basis determines
        // it.
        let is_isotropic = compiled.model.kind == InvariantKind::Isotropic;
        let stress = if is_isotropic { principal(graph, &stress, dimension) } else { stress };
        ChartMotion {
            dimension,
            oriented: (!is_isotropic).then_some(cartesian),
            gradient,
            gradient_rate,
            right,
            right_rate,
            jacobian: strain.jacobian,
            squared_rate,
            density,
            stress,
        }
    }

    /// The number of rows of H.
    pub fn dimension(&self) -> usize {
        self.dimension
    }
}

/// 2 J^2 D : D = 2 (dJ/dt)^2 - det dC/dt in two dimensions, since tr A^2 = (tr A)^2 - 2 det A for A = C^-1 dC/dt, and tr A = 2
/// dJ/dt/J.
fn squared_rate(graph: &mut Graph, jacobian: Expr, right_rate: &[Expr]) -> Option<Expr> {
    let [first, shear, _, second] = right_rate else { return None };
    let rate = differentiate(graph, &[jacobian], Symbol::Time)[0];
    let [rate, shear] = [rate, *shear].map(|factor| graph.power(factor, 2));
    let product = graph.mul(*first, *second);
    let one = Rational::ONE;
    Some(graph.sum([(rate, Rational::from(2)), (shear, one.clone()), (product, -one)]))
}

/// Writes a stress in terms of the symbol for J - 1.
fn principal(graph: &mut Graph, stress: &[Expr], dimension: usize) -> Vec<Expr> {
    let gradient =
        Tensor::from_fn(dimension, |row, column| graph.symbol(Symbol::Gradient(row, column)));
    let jacobian =
        Strain::new(graph, gradient, &InvariantKind::Isotropic, &Relations::default()).jacobian;
    let values = without_volume(graph, jacobian);
    replace(graph, stress, &values)
}

/// H of the field, without the rigid motion if the field has one. The strain is the same, and the stress differs by the
/// rotation only, which then need not cancel.
pub fn gradient(graph: &mut Graph, compiled: &Compiled) -> Vec<Expr> {
    if compiled.model.rigid.is_none() {
        return compiled.derived.quantities[&Quantity::DisplacementGradient].clone();
    }
    let displacement = &compiled.model.displacement;
    let columns: Vec<Vec<Expr>> = (0..displacement.len())
        .map(|axis| differentiate(graph, displacement, Symbol::Coordinate(axis)))
        .collect();
    (0..displacement.len()).flat_map(|row| columns.iter().map(move |column| column[row])).collect()
}

/// The strain of a gradient, reduced if that makes it shorter.
fn strain(graph: &mut Graph, gradient: &[Expr]) -> Strain {
    let dimension = gradient.len().isqrt();
    let tensor = || Tensor::from_fn(dimension, |row, column| gradient[row * dimension + column]);
    let plain = Strain::new(graph, tensor(), &InvariantKind::Isotropic, &Relations::default());
    let reduced = graph.attempt(|graph| {
        let relations = Relations::find(graph, gradient);
        Strain::new(graph, tensor(), &InvariantKind::Isotropic, &relations)
    });
    let length = |strain: &Strain| {
        graph.reachable(&[strain.right.components(), &[strain.jacobian]].concat()).len()
    };
    match reduced {
        Some(reduced) if length(&reduced) <= length(&plain) => reduced,
        _ => plain,
    }
}

/// J, J - 1 and the expression of which J is a multiple, each in terms of [`SUPPLIED_VOLUME`]. Interval arithmetic alone would
/// not know that J is positive where it is small.
pub fn without_volume(graph: &mut Graph, jacobian: Expr) -> SortedMap<Expr, Expr> {
    if graph.as_number(jacobian).is_some() {
        return SortedMap::new();
    }
    let one = graph.number(1);
    let change = graph.symbol(SUPPLIED_VOLUME);
    let whole = graph.add(one, change);
    let less_one = graph.sub(jacobian, one);
    let (content, primitive) = graph.split_content(jacobian);
    let scaled = graph.scale(whole, Rational::ONE / content);
    SortedMap::from([(less_one, change), (primitive, scaled), (jacobian, whole)])
}
