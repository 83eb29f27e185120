//! The displacement as it is written: the points where it has no value.
//!
//! Canonical form cancels: sqrt(X)*sqrt(X) becomes X, which is defined for X < 0, too. So the formulas are evaluated operation
//! by operation, as they are written in the file.

use mms_math::Scalar as _;

use crate::compile::Compiled;
use mms_mechanics::sample::{Sample, samples};
use mms_program::interpret::{Number as _, binary, unary};
use mms_program::precise::Precise;
use mms_spec::source::Span;
use mms_spec::syntax;
use mms_spec::syntax::{Ast, NodeKind, Operator};
use mms_spec::{FieldSpec, Formula, RigidSpec};
use mms_symbolic::expr::Function;
use mms_symbolic::sorted::SortedMap;

/// The number of points of the domain where u is evaluated.
pub const POINTS: usize = 32;

/// The budget of all points together, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 50_000_000;
/// The steps of an operation.
const STEPS_OF_OPERATION: u64 = 60;
/// The steps of a power.
const STEPS_OF_POWER: u64 = 3_000;
/// The steps of a function.
const STEPS_OF_FUNCTION: u64 = 10_000;

/// The largest integer exponent for repeated multiplication; the power function computes greater ones.
const MAX_REPEATED: f64 = 4096.0;

/// An operation that has no value at some points of the domain.
#[derive(Clone, Debug)]
pub struct Gap {
    /// The component of u, from 0 on; `None` for the rigid motion on top of u.
    pub component: Option<usize>,
    /// The place of the operation in the file.
    pub span: Span,
    /// The number of points, out of [`POINTS`], without a value.
    pub points: usize,
    /// X and t of the first of these points.
    pub first: (Vec<f64>, f64),
}

/// A value, and the operation to blame if it is undefined.
type Traced = (Precise, Option<Span>);

/// The components of u, and the formulas of a rigid motion, that have no value somewhere, each with the operation to blame at
/// the first such point.
pub fn gaps(compiled: &Compiled) -> Vec<Gap> {
    let field = &compiled.field;
    let Some([lets, formulas]) = parsed(field) else { return Vec::new() };
    let parameters = compiled.parameters::<Precise>(&SortedMap::new());
    let mut found: Vec<Option<Gap>> = vec![None; formulas.len()];
    for point in samples(&compiled.program, &parameters, points(compiled)) {
        let mut names = leaves(compiled, &parameters, &point);
        for (definition, ast) in field.lets.iter().zip(&lets) {
            let value = evaluate(ast, &names);
            names.insert(&definition.name.value, value);
        }
        for (index, ast) in formulas.iter().enumerate() {
            let Some(span) = evaluate(ast, &names).1 else { continue };
            let coordinates = point.coordinates.iter().map(Precise::to_f64).collect();
            let first = (coordinates, point.time.to_f64());
            let component = (index < field.displacement.len()).then_some(index);
            let gap = found[index].get_or_insert(Gap { component, span, points: 0, first });
            gap.points += 1;
        }
    }
    found.into_iter().flatten().collect()
}

/// The number of points where u is evaluated: [`POINTS`], or fewer if that takes too long.
pub fn points(compiled: &Compiled) -> usize {
    let Some(formulas) = parsed(&compiled.field) else { return POINTS };
    let steps = |ast: &Ast| ast.nodes.iter().map(|node| steps(&node.kind)).sum::<u64>();
    let of_one: u64 = formulas.iter().flatten().map(steps).sum();
    POINTS.min((STEPS / of_one.max(1)) as usize)
}

fn steps(kind: &NodeKind) -> u64 {
    match kind {
        NodeKind::Call { .. } => STEPS_OF_FUNCTION,
        NodeKind::Binary(Operator::Power, ..) => STEPS_OF_POWER,
        _ => STEPS_OF_OPERATION,
    }
}

/// The definitions, and the formulas of u and of a rigid motion.
fn parsed(field: &FieldSpec) -> Option<[Vec<Ast>; 2]> {
    let parse = |formula: &Formula| syntax::parse(formula, &mut Vec::new());
    let lets = field.lets.iter().map(|definition| parse(&definition.value));
    let motion = field.rigid.iter().flat_map(RigidSpec::formulas);
    let formulas = field.displacement.iter().chain(motion).map(parse);
    Some([lets.collect::<Option<_>>()?, formulas.collect::<Option<_>>()?])
}

/// The names that a formula may use beside definitions.
fn leaves<'a>(
    compiled: &'a Compiled,
    parameters: &[Precise],
    point: &Sample<Precise>,
) -> SortedMap<&'a str, Traced> {
    let mut names = SortedMap::new();
    for (parameter, value) in compiled.model.parameters.iter().zip(parameters) {
        names.insert(parameter.name.as_str(), (value.clone(), None));
    }
    let axes = compiled.field.space.axes().iter().copied();
    let given = axes.zip(point.coordinates.iter().cloned());
    let given = given.chain([("t", point.time.clone()), ("pi", Precise::pi())]);
    names.extend(given.map(|(name, value)| (name, (value, None))));
    names
}

/// The value of a formula, and the first operation without a value whose operands have one.
fn evaluate(ast: &Ast, names: &SortedMap<&str, Traced>) -> Traced {
    let mut values: Vec<Traced> = Vec::with_capacity(ast.nodes.len());
    for node in &ast.nodes {
        let of = |operand: &usize| values[*operand].0.clone();
        let (value, operands) = match &node.kind {
            NodeKind::Number(number) => (Precise::from_rational(number), Vec::new()),
            NodeKind::Name(name) => {
                // Every name was resolved before this evaluation.
                let known = names.get(name.as_str()).cloned();
                values.push(known.unwrap_or((Precise::from_f64(f64::NAN), Some(node.span))));
                continue;
            }
            NodeKind::Negate(operand) => (-of(operand), vec![*operand]),
            NodeKind::Binary(operator, left, right) => {
                (operate(*operator, of(left), of(right)), vec![*left, *right])
            }
            NodeKind::Call { name, arguments } => (
                call(&name.value, &arguments.iter().map(of).collect::<Vec<_>>()),
                arguments.clone(),
            ),
        };
        let inherited = operands.iter().find_map(|operand| values[*operand].1);
        let own = (!value.is_defined()).then_some(node.span);
        values.push((value, inherited.or(own)));
    }
    values.pop().unwrap_or((Precise::from_f64(0.0), None))
}

fn operate(operator: Operator, a: Precise, b: Precise) -> Precise {
    match operator {
        Operator::Add => a + b,
        Operator::Subtract => a - b,
        Operator::Multiply => a * b,
        Operator::Divide => a / b,
        Operator::Power => power(a, b),
    }
}

/// A power; an integer one exists for bases of any sign.
fn power(base: Precise, exponent: Precise) -> Precise {
    let count = exponent.to_f64();
    if count.fract() != 0.0 || count.abs() > MAX_REPEATED {
        return base.powf(exponent);
    }
    let one = Precise::from_f64(1.0);
    let product = (0..count.abs() as u32).fold(one.clone(), |power, _| power * base.clone());
    if count < 0.0 { one / product } else { product }
}

fn call(name: &str, arguments: &[Precise]) -> Precise {
    let function = Function::ALL.iter().find(|function| function.name() == name);
    match (function, arguments) {
        (Some(function), [x]) => unary(*function, None, x.clone()),
        (Some(function), [a, b]) => binary(*function, a.clone(), b.clone()),
        // hypot is the one function that the graph does not have.
        (None, [a, b]) => (a.clone() * a.clone() + b.clone() * b.clone()).sqrt(),
        _ => Precise::from_f64(f64::NAN),
    }
}
