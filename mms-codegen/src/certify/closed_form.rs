//! Each `[[check]]` of a file: a closed form from paper against the derived quantity, in
//! arbitrary precision.

use crate::compile::Compiled;
use mms_mechanics::model::Check;
use mms_mechanics::sample::{Sample, samples};
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Number as _, Point};
use mms_program::precise::Precise;
use mms_spec::foreign::Foreign;
use mms_spec::quantity::Quantity;
use mms_spec::source::Span;
use mms_symbolic::expr::Rational;
use mms_symbolic::work::Work;

/// At how many points of the domain a closed form is compared.
pub const POINTS: usize = 128;

/// What all closed forms together may take, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 100_000_000;

/// How one closed form compares.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What it is a closed form of.
    pub quantity: Quantity,
    /// Where it was published.
    pub source: Option<Foreign>,
    /// Where it stands in the file.
    pub span: Span,
    /// At how many points both were evaluated: [`POINTS`], or fewer where that takes too long.
    pub points: usize,
    /// What was found.
    pub finding: Finding,
}

/// What the comparison of one closed form found.
#[derive(Clone, Debug)]
pub enum Finding {
    /// Both have the same value at every point.
    Agrees,
    /// One evaluation would take too long, and nothing was compared.
    Unmeasured,
    /// They have different values at a point.
    Differs(Difference),
    /// Nowhere do they differ, but at some points one or both have no value.
    Undefined {
        /// At how many of the points.
        points: usize,
        /// The first of them.
        first: Difference,
    },
}

/// A point, and the values of closed form and derived quantity there.
#[derive(Clone, Debug)]
pub struct Difference {
    /// X.
    pub coordinates: Vec<f64>,
    /// t.
    pub time: f64,
    /// Which component, row-major.
    pub component: usize,
    /// The derived value; not a number where it is undefined.
    pub derived: f64,
    /// The closed form's value; not a number where it is undefined.
    pub expected: f64,
}

/// Compares every closed form of a field at [`POINTS`] points: each component may differ by 1e-20
/// of the largest component at that point.
pub fn compare(compiled: &Compiled) -> Vec<Comparison> {
    let checks = compiled.model.checks.iter().enumerate();
    let work = compiled.graph.work().clone();
    work.allow(STEPS);
    let parameters = compiled.parameters::<Precise>(&Default::default());
    let program = compiled.checks();
    let all = samples(&compiled.program, &parameters, POINTS);
    let compared = |(index, check): (usize, &Check)| {
        // Each may take its part of what is left.
        let part = work.left() / (compiled.model.checks.len() - index) as u64;
        let own = work.clone();
        own.allow(part);
        let (points, finding) = finding(&program, &parameters, &all, index, check.quantity, &own);
        work.spend(part - own.left().min(part));
        let source = check.source.clone();
        Comparison { quantity: check.quantity, source, span: check.span, points, finding }
    };
    checks.map(compared).collect()
}

fn finding(
    program: &Program,
    parameters: &[Precise],
    points: &[Sample<Precise>],
    check: usize,
    quantity: Quantity,
    work: &Work,
) -> (usize, Finding) {
    let outputs = [Output::Quantity(quantity), Output::Expected(check)];
    // To prepare it takes a look at every instruction.
    work.spend(program.instrs.len() as u64);
    let mut interpreter = Interpreter::within(work, program, parameters);
    let plan = interpreter.plan(&outputs);
    let (mut undefined, mut compared) = (Vec::new(), 0);
    for point in points {
        interpreter.set_time(&point.time);
        interpreter.set_point(&plan, Point::at(&point.coordinates));
        if work.is_over() {
            break;
        }
        compared += 1;
        let [derived, expected] = outputs.map(|output| interpreter.output(output));
        let found = |component: usize| Difference {
            coordinates: point.coordinates.iter().map(Precise::to_f64).collect(),
            time: point.time.to_f64(),
            component,
            derived: derived[component].to_f64(),
            expected: expected[component].to_f64(),
        };
        let lacking = |(a, b): (&Precise, &Precise)| !a.is_defined() || !b.is_defined();
        if let Some(component) = derived.iter().zip(&expected).position(lacking) {
            undefined.push(found(component));
        } else if let Some(component) = differing_component(&derived, &expected) {
            return (compared, Finding::Differs(found(component)));
        }
    }
    let points = undefined.len();
    let finding = match undefined.into_iter().next() {
        Some(first) => Finding::Undefined { points, first },
        None if compared == 0 => Finding::Unmeasured,
        None => Finding::Agrees,
    };
    (compared, finding)
}

fn differing_component(derived: &[Precise], expected: &[Precise]) -> Option<usize> {
    let tolerance = Precise::from_rational(&Rational::from_parts(
        1.into(),
        dashu_int::UBig::from(10u8).pow(20),
    ));
    let mut scale = Precise::from_rational(&Rational::ZERO);
    for value in expected.iter().chain(derived) {
        let magnitude = value.clone().magnitude();
        if !magnitude.at_most(&scale) {
            scale = magnitude;
        }
    }
    let allowed = scale * tolerance;
    derived.iter().zip(expected).position(|(derived, expected)| {
        let difference = (derived.clone() - expected.clone()).magnitude();
        !difference.at_most(&allowed)
    })
}
