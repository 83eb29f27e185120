//! The rigid motion of a twin, with Q and d named.

use super::motion::Formulas;
use super::name::Name;
use super::reading::Reading;
use mms_codegen::compile::Compiled;
use mms_mechanics::model::Rotation;
use mms_mechanics::tensor::Tensor;
use mms_spec::RigidSpec;
use mms_symbolic::expr::{Expr, Function, Rational, Symbol};

/// The suffix for names of this module that a field already uses.
const SUFFIX: &str = "rigid";

/// u* = Q x + d - X, where x = X + u0 is the position that the field alone gives.
pub(super) fn moved(
    reading: &mut Reading,
    compiled: &Compiled,
    formulas: &Formulas,
    displacement: Vec<Expr>,
) -> Vec<Expr> {
    let Some(rigid) = &compiled.field.rigid else { return displacement };
    let dimension = displacement.len();
    let index = |k: usize| if dimension == 1 { String::new() } else { (k + 1).to_string() };
    let reference: Vec<Expr> =
        (0..dimension).map(|axis| reading.graph.symbol(Symbol::Coordinate(axis))).collect();
    let position: Vec<Expr> = displacement
        .iter()
        .enumerate()
        .map(|(k, own)| {
            let own = reading.named(Name::indexed("u0", index(k)), *own, SUFFIX);
            let position = reading.graph.add(reference[k], own);
            reading.named(Name::indexed("x0", index(k)), position, SUFFIX)
        })
        .collect();
    let turned = match rotation(reading, formulas, rigid) {
        Some(rotation) => rotation.apply(&mut reading.graph, &position),
        None => position,
    };
    let translation: Vec<Expr> = (rigid.translation.iter().flatten().enumerate())
        .filter_map(|(k, formula)| {
            let value = formulas.read_alone(reading, formula)?;
            Some(reading.named(Name::indexed("d", index(k)), value, SUFFIX))
        })
        .collect();
    (0..dimension)
        .map(|k| {
            let mut terms = vec![(turned[k], Rational::ONE), (reference[k], Rational::NEG_ONE)];
            terms.extend(translation.get(k).map(|d| (*d, Rational::ONE)));
            reading.graph.sum(terms)
        })
        .collect()
}

/// Q = I + sin a K + (1 - cos a) K^2 with K the quarter turn, as a person writes it (Rodrigues 1840).
fn rotation(reading: &mut Reading, formulas: &Formulas, rigid: &RigidSpec) -> Option<Tensor> {
    let angle = formulas.read_alone(reading, rigid.angle()?)?;
    let angle = reading.named(Name::plain("angle"), angle, SUFFIX);
    let rotation = match &rigid.rotation {
        Some(mms_spec::Rotation::Space { axis, .. }) => {
            let axis: Vec<Expr> =
                axis.iter().filter_map(|n| formulas.read_alone(reading, n)).collect();
            Rotation::Space { axis: axis.try_into().ok()?, angle }
        }
        _ => Rotation::Plane { angle },
    };
    let graph = &mut reading.graph;
    let quarter = rotation.quarter_turn(graph);
    let (one, sine) = (graph.number(1), graph.call(Function::Sin, &[angle]));
    let cosine = graph.call(Function::Cos, &[angle]);
    let rest = graph.sub(one, cosine);
    let square = quarter.mul(graph, &quarter).scale(graph, rest);
    let turned = quarter.scale(graph, sine).add(graph, &square);
    let rotation = Tensor::identity(graph, quarter.dimension()).add(graph, &turned);
    Some(Tensor::from_fn(rotation.dimension(), |row, column| {
        let name = Name::indexed("Q", format!("{}{}", row + 1, column + 1));
        reading.named(name, rotation.at(row, column), SUFFIX)
    }))
}
