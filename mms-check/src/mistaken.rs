//! Finds the mistake that gives a closed form which differs.

use std::sync::Arc;

use mms_codegen::Compiled;
use mms_codegen::certify::closed_form::{ClosedFormVerdict, Comparison};
use mms_diagnosis::answer::Ranked;
use mms_diagnosis::closed_form::ClosedForm;
use mms_diagnosis::scene::closed_form;
use mms_diagnosis::table::Measure;
use mms_documents::check::Mistaken;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;
use mms_symbolic::sorted::SortedMap;

/// The kind of closed form for a diagnosis of a quantity, if there is one.
fn closed_form_of(quantity: Quantity) -> Option<ClosedForm> {
    match quantity {
        Quantity::BodyForce => Some(ClosedForm::BodyForce),
        Quantity::FirstPiolaKirchhoff => Some(ClosedForm::Stress(Measure::FirstPiola)),
        Quantity::CauchyStress => Some(ClosedForm::Stress(Measure::Cauchy)),
        Quantity::SecondPiolaKirchhoff => Some(ClosedForm::Stress(Measure::SecondPiola)),
        _ => None,
    }
}

/// The mistake that each closed form of a field contains, if a hypothesis gives it.
pub fn named(compiled: &Arc<Compiled>, comparisons: &[Comparison]) -> Vec<Option<Ranked>> {
    let named = |(check, it): (usize, &Comparison)| match it.verdict {
        ClosedFormVerdict::Differs(_) => {
            closed_form_of(it.quantity).and_then(|it| of(compiled, check, it))
        }
        _ => None,
    };
    comparisons.iter().enumerate().map(named).collect()
}

/// The mistake that gives the closed form of a check.
fn of(compiled: &Arc<Compiled>, check: usize, of: ClosedForm) -> Option<Ranked> {
    let (program, defaults) = (compiled.checks(), SortedMap::new());
    let (dimension, parameters) = (compiled.field.dimension, compiled.parameters(&defaults));
    let outputs = [Output::Expected(check)];
    let values = |time: f64, points: &[f64]| {
        let mut interpreter = Interpreter::<f64, _>::new(&program, &parameters);
        let plan = interpreter.plan(&outputs);
        interpreter.set_time(&time);
        let at = |point: &[f64]| {
            interpreter.set_point(&plan, Point::at(point));
            interpreter.output(outputs[0])
        };
        points.chunks_exact(dimension).flat_map(at).collect()
    };
    let scene = mms_interpreted::scene(compiled.clone(), &defaults).ok()?;
    closed_form(&scene, of, &values)
}

/// Mistakes that give the same formula.
fn others(it: &Ranked) -> Vec<String> {
    [it.equivalent_always.as_slice(), it.equivalent_here.as_slice()].concat()
}

/// The mistake as a line of text.
pub fn says(it: &Ranked) -> String {
    let others = others(it);
    let or = match others.is_empty() {
        true => String::new(),
        false => format!("; it may as well be {}", others.join(", ")),
    };
    format!("    it acts as {}: {}{or}", it.title(), it.says)
}

/// The mistake as a part of a document.
pub fn document(it: &Ranked) -> Mistaken {
    Mistaken {
        hypothesis: it.title(),
        says: it.says.clone(),
        factor: it.factor.first().copied().filter(|_| it.factor.len() == 1),
        equivalent: others(it).into_iter().map(|it| it.to_string()).collect(),
    }
}
