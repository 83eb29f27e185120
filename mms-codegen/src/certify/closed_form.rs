//! Compares each `[[check]]` of a file, a closed form from paper, with the derived quantity, in arbitrary precision.

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

/// The number of points of the domain where a closed form is compared.
pub const POINTS: usize = 128;

/// The budget of all closed forms together, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 100_000_000;

/// The comparison of one closed form.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The quantity that the closed form is for.
    pub quantity: Quantity,
    /// The publication of the closed form.
    pub source: Option<Foreign>,
    /// The place of the closed form in the file.
    pub span: Span,
    /// The number of points where both were evaluated: [`POINTS`], or fewer if that takes too long.
    pub points: usize,
    /// The verdict.
    pub verdict: ClosedFormVerdict,
}

/// The result of comparing one closed form.
#[derive(Clone, Debug)]
pub enum ClosedFormVerdict {
    /// Both have the same value at every point.
    Agrees,
    /// One evaluation would take too long, so that nothing was compared.
    Unmeasured,
    /// The closed form and the quantity have different values at a point.
    Differs(Difference),
    /// The values differ nowhere, but at some points one or both do not exist.
    Undefined {
        /// The number of these points.
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
    /// The index of the component, row-major.
    pub component: usize,
    /// The derived value; NaN where it is undefined.
    pub derived: f64,
    /// The closed form's value; NaN where it is undefined.
    pub expected: f64,
}

/// Compares every closed form of a field at [`POINTS`] points: the tolerance of each component is 1e-20 of the largest
/// component at that point.
pub fn compare(compiled: &Compiled) -> Vec<Comparison> {
    let checks = compiled.model.checks.iter().enumerate();
    let work = compiled.graph.work().clone();
    work.allow(STEPS);
    let parameters = compiled.parameters::<Precise>(&Default::default());
    let program = compiled.checks();
    let all = samples(&compiled.program, &parameters, POINTS);
    let compared = |(index, check): (usize, &Check)| {
        // Each closed form may spend an equal part of the remaining budget.
        let part = work.left() / (compiled.model.checks.len() - index) as u64;
        let own = work.clone();
        own.allow(part);
        let (points, finding) = finding(&program, &parameters, &all, index, check.quantity, &own);
        work.spend(part - own.left().min(part));
        let source = check.source.clone();
        Comparison { quantity: check.quantity, source, span: check.span, points, verdict: finding }
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
) -> (usize, ClosedFormVerdict) {
    let outputs = [Output::Quantity(quantity), Output::Expected(check)];
    // Preparing the interpreter reads every instruction.
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
            return (compared, ClosedFormVerdict::Differs(found(component)));
        }
    }
    let points = undefined.len();
    let finding = match undefined.into_iter().next() {
        Some(first) => ClosedFormVerdict::Undefined { points, first },
        None if compared == 0 => ClosedFormVerdict::Unmeasured,
        None => ClosedFormVerdict::Agrees,
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
