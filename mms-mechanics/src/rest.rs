//! The material at F = I, in three dimensions for every field, with each given field in its state of rest.

use crate::invariant::InvariantKind;
use crate::kinematics::Strain;
use crate::material::{self, Law};
use crate::model::{Model, energy_with};
use crate::tensor::Tensor;
use mms_spec::{FieldSpec, MaterialSpec};
use mms_symbolic::expr::{Expr, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::relations::Relations;

/// The stress and the stiffness at F = I: 9 components of P and 81 of dP/dF, the last index fastest.
pub fn at_rest(graph: &mut Graph, model: &Model) -> [Vec<Expr>; 2] {
    let kind = match (&model.kind, &model.fibre) {
        (InvariantKind::Fibrous(_), Some(fibre)) => InvariantKind::Fibrous(fibre.clone()),
        (kind, _) => kind.clone(),
    };
    let strain = undeformed(graph, &kind);
    let stress = Law::new(graph, model.rest_energy, &kind).first_piola_kirchhoff(graph, &strain);
    let tangent = material::tangent(graph, model.rest_energy, &kind, &strain);
    [stress.components().to_vec(), tangent]
}

/// The indices, among the given fields of the material, of the fields that set a spherical stress at F = I, as a pressure does:
/// the slope of W by such a field is a multiple of I there.
pub fn pressures(
    graph: &mut Graph,
    field: &FieldSpec,
    material: &MaterialSpec,
    model: &Model,
) -> Vec<usize> {
    let symbols: Vec<Symbol> = (0..model.givens.len()).map(Symbol::Local).collect();
    let leaves: Vec<Expr> = symbols.iter().map(|symbol| graph.symbol(*symbol)).collect();
    let energy = energy_with(graph, field, material, &model.arguments, &leaves);
    let Some(energy) = energy else { return Vec::new() };
    let [stress, _] = at_rest(graph, &Model { rest_energy: energy, ..model.clone() });
    let mut places = Vec::new();
    for (place, symbol) in symbols.into_iter().enumerate() {
        let slope = differentiate(graph, &stress, symbol);
        if !graph.is_zero(slope[0]) && is_spherical(graph, &slope) {
            places.push(place);
        }
    }
    places
}

/// Whether 9 components are a multiple of I.
pub fn is_spherical(graph: &Graph, components: &[Expr]) -> bool {
    let on_diagonal = |place: usize| place.is_multiple_of(4);
    let mut all = components.iter().enumerate();
    all.all(|(place, it)| match on_diagonal(place) {
        true => *it == components[0],
        false => graph.is_zero(*it),
    })
}

/// The moduli at F = I with their names: dP/dF is positive definite for strains if and only if all of them are positive.
///
/// Without fibres these are mu and 3 lambda + 2 mu. With fibres they are in the basis whose first axis is the fibres', so that
/// the direction of the fibres does not matter: two shear moduli, the modulus of stretches all around the fibres, and Young's
/// modulus along them.
pub fn moduli(graph: &mut Graph, model: &Model) -> Vec<(&'static str, Expr)> {
    let kind = match &model.kind {
        InvariantKind::Fibrous(_) => {
            InvariantKind::Fibrous([1, 0, 0].map(|entry| graph.number(entry)).to_vec())
        }
        kind => kind.clone(),
    };
    let strain = undeformed(graph, &kind);
    let tangent = material::tangent(graph, model.rest_energy, &kind, &strain);
    let entry = |[i, j, k, l]: [usize; 4]| tangent[((i * 3 + j) * 3 + k) * 3 + l];
    let quarter = Rational::from_parts(1.into(), 4u8.into());
    let shear = [[0, 1, 0, 1], [0, 1, 1, 0], [1, 0, 0, 1], [1, 0, 1, 0]];
    let shear = graph.sum(shear.map(|at| (entry(at), quarter.clone())));
    let [along, coupling, across, sideways] =
        [[0, 0, 0, 0], [0, 0, 1, 1], [1, 1, 1, 1], [1, 1, 2, 2]].map(entry);
    let mut sum = |terms: [(Expr, Rational); 2]| graph.sum(terms);
    match kind {
        InvariantKind::Isotropic | InvariantKind::SmallStrain => {
            let dilatation = sum([(along, Rational::ONE), (coupling, 2.into())]);
            vec![("mu", shear), ("3 lambda + 2 mu", dilatation)]
        }
        InvariantKind::Fibrous(_) => {
            let turned = sum([(across, HALF), (sideways, -HALF)]);
            let around = sum([(across, Rational::ONE), (sideways, Rational::ONE)]);
            let square = graph.power(coupling, 2);
            let lost = graph.div(square, around);
            let young = graph.sum([(along, Rational::ONE), (lost, (-2).into())]);
            vec![
                ("the shear modulus along the fibres", shear),
                ("the shear modulus across the fibres", turned),
                ("the modulus of stretches all around the fibres", around),
                ("Young's modulus along the fibres", young),
            ]
        }
    }
}

fn undeformed(graph: &mut Graph, kind: &InvariantKind) -> Strain {
    let gradient = Tensor::from_fn(3, |_, _| graph.number(0));
    Strain::new(graph, gradient, kind, &Relations::default())
}
