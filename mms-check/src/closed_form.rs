//! Closed forms in the report: whether they agree with the derived quantities.

use std::sync::Arc;

use mms_codegen::Compiled;
use mms_codegen::certify::closed_form::{ClosedFormVerdict, Comparison, Difference};
use mms_diagnosis::answer::Ranked;
use mms_documents::check::{self as documents, ClosedForm};
use mms_spec::foreign::Foreign;

use crate::mistaken;

/// The compared closed forms of a field, each with the name of its mistake if it has one.
pub struct Compared(Vec<(Comparison, Option<Ranked>)>);

impl Compared {
    /// Finds the mistake in each closed form that differs.
    pub fn of(compiled: &Arc<Compiled>, comparisons: Vec<Comparison>) -> Self {
        let named = mistaken::named(compiled, &comparisons);
        Compared(comparisons.into_iter().zip(named).collect())
    }

    /// Whether every closed form agrees.
    pub fn all_agree(&self) -> bool {
        self.0.iter().all(|(it, _)| matches!(it.verdict, ClosedFormVerdict::Agrees))
    }

    /// The closed forms as parts of a document.
    pub fn documents(&self) -> Vec<ClosedForm> {
        self.0.iter().map(|(it, named)| document(it, named.as_ref())).collect()
    }

    /// The lines about all closed forms.
    pub fn lines(&self, compiled: &Compiled) -> Vec<String> {
        let mut lines = Vec::new();
        for (comparison, named) in &self.0 {
            let quantity = comparison.quantity.name();
            let source = comparison.source.as_ref().map(Foreign::shown);
            let source = source.as_deref().unwrap_or("no source given");
            match &comparison.verdict {
                ClosedFormVerdict::Agrees => lines.push(format!(
                    "  check  {quantity} agrees to 1e-20 at {} points ({source})",
                    comparison.points
                )),
                ClosedFormVerdict::Unmeasured => lines.push(format!(
                    "  check  {quantity} was NOT COMPARED: one value takes too long in 77 digits ({source})"
                )),
                ClosedFormVerdict::Differs(found) => {
                    lines.push(format!("  check  {quantity} FAILED ({source})"));
                    lines.push(describe(compiled, comparison, found));
                    lines.extend(named.as_ref().map(mistaken::says));
                }
                ClosedFormVerdict::Undefined { points, first } => {
                    lines.push(format!(
                        "  check  {quantity} is UNDEFINED at {points} of {} points ({source})",
                        comparison.points
                    ));
                    lines.push(describe(compiled, comparison, first));
                    lines.push("    a division by 0, a root or logarithm of a negative number, or an overflow: shrink \
                                [domain], or rewrite the term that has no value there".into());
                }
            }
        }
        lines
    }
}

fn document(comparison: &Comparison, named: Option<&Ranked>) -> ClosedForm {
    let (status, found, undefined) = match &comparison.verdict {
        ClosedFormVerdict::Agrees => ("passed", None, 0),
        ClosedFormVerdict::Differs(found) => ("failed", Some(found), 0),
        ClosedFormVerdict::Undefined { points, first } => ("undefined", Some(first), *points),
        ClosedFormVerdict::Unmeasured => ("unmeasured", None, 0),
    };
    let finite = |number: f64| number.is_finite().then_some(number);
    let difference = found.map(|found| documents::Difference {
        at: found.coordinates.clone(),
        time: found.time,
        component: found.component,
        derived: finite(found.derived),
        expected: finite(found.expected),
    });
    ClosedForm {
        quantity: comparison.quantity.name().to_owned(),
        source: comparison.source.as_ref().map(|it| it.raw().to_owned()),
        points: comparison.points,
        status: status.to_owned(),
        undefined_points: undefined,
        difference,
        acts_as: named.map(mistaken::document),
    }
}

fn describe(compiled: &Compiled, comparison: &Comparison, found: &Difference) -> String {
    let place = compiled.sources.place(comparison.span);
    let value = |value: f64| match value.is_nan() {
        true => "undefined".to_string(),
        false => format!("{value:e}"),
    };
    let apart = match found.derived == found.expected {
        true => ", which differ after the 16th digit",
        false => "",
    };
    format!(
        "    {place}: component {} at X = {:?}, t = {:e}: derived {}, closed form {}{apart}",
        found.component + 1,
        found.coordinates,
        found.time,
        value(found.derived),
        value(found.expected)
    )
}
