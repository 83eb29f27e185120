//! Messages about a field that is not what it claims to be.

use super::branches::BranchViolation;
use super::computed;
use super::limits::Must;
use super::sign::Sign;
use super::solid::Part;
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::Formulas;
use crate::bounds::witness::{Witness, digits};
use crate::compile::Compiled;
use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::quantity::Quantity;
use mms_spec::source::Span;
use mms_spec::{BoundarySpec, Claim};
use mms_symbolic::expr::{Expr, Graph, Symbol};

/// The budget of the search for a parameter to blame, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 20_000_000;

/// J is not positive.
pub fn inverted(compiled: &Compiled, witness: &Witness, value: f64) -> Diagnostic {
    let place = place(compiled, witness);
    let label = format!("J is {} at {place}", digits(value));
    let message = "the field turns matter inside out: J = det F is not positive";
    let jacobian = |_: &mut Graph| Some(compiled.derived.quantities[&Quantity::Jacobian][0]);
    if let Some((span, name)) = culprit(compiled, witness, jacobian) {
        return Diagnostic::error(span, message)
            .label(label)
            .help(format!("it is positive there for the default of `{name}`: narrow the range"));
    }
    Diagnostic::error(displacement(compiled), message)
        .label(label)
        .help("reduce the amplitude, or shrink the body or the time window")
}

/// J is not proved to be positive.
pub fn not_positive(compiled: &Compiled, witness: &Witness, value: f64) -> Diagnostic {
    let label = format!("near {}; bounded by {}", place(compiled, witness), digits(value));
    Diagnostic::error(displacement(compiled), "J = det F is not proved to be positive")
        .label(label)
        .help("reduce the amplitude, or write u in a form that bounds itself more sharply")
}

/// The density, or a modulus at F = I, is not positive, or not proved to be; `None` if it is proved.
pub fn not_solid(compiled: &Compiled, part: Part, sign: &Sign) -> Option<Diagnostic> {
    let (is, witness, value) = match sign {
        Sign::Positive(_) => return None,
        Sign::Refuted(witness, value) => ("not", witness, *value),
        Sign::Unproved(witness, value) => ("not proved to be", witness, *value),
    };
    let (message, help) = match part {
        Part::Density => (
            format!("the density is {is} positive everywhere"),
            "the body force is per unit mass: b = a - Div P/rho0",
        ),
        Part::Modulus(_) => (
            format!("the moduli at F = I are {is} positive definite within the ranges"),
            "an isotropic solid has mu > 0 and 3 lambda + 2 mu > 0, that is young > 0 and -1 < nu < 1/2",
        ),
    };
    let (name, place) = (part.name(), place(compiled, witness));
    let label = match sign {
        Sign::Refuted(..) => format!("{name} is {} at {place}", digits(value)),
        _ if value.is_infinite() => format!("{name} has no bound near {place}"),
        _ => format!("near {place}, where {name} is bounded by {}", digits(value)),
    };
    let formula = |graph: &mut Graph| part.formula(graph, compiled);
    let (span, advice) = match culprit(compiled, witness, formula) {
        Some((span, name)) => {
            (span, format!("it is positive there for the default of `{name}`: narrow the range"))
        }
        None => match first_range(compiled, part) {
            Some(span) => (span, "narrow the ranges".into()),
            None => {
                let material = &compiled.field.material;
                let span = material.density.as_ref().map_or(material.span, |it| it.span);
                (span, "shrink the body, or change the formula".into())
            }
        },
    };
    Some(Diagnostic::error(span, message).label(label).help(advice).help(help))
}

/// The range of the first parameter that has one and that the density or a modulus depends on.
fn first_range(compiled: &Compiled, part: Part) -> Option<Span> {
    let mut graph = room(compiled);
    let chart = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    let formula = part.formula(&mut graph, compiled)?;
    let formula = chart.pull_back(&mut graph, &[formula])[0];
    let symbols = graph.symbols(formula);
    let index = chart.varying_parameters().find(|it| symbols.contains(&Symbol::Parameter(*it)))?;
    range(compiled, index)
}

/// The undeformed body has a stress.
pub fn stressed_at_rest(compiled: &Compiled, stress: &[f64], witness: &Witness) -> Diagnostic {
    let largest = stress.iter().map(|it| it.abs()).fold(0.0, f64::max);
    let place = place(compiled, witness);
    let (span, what) = match compiled.own_material() {
        Some(_) => (compiled.material.strain_energy.span, "of this W, "),
        None => (compiled.field.material.model.span, ""),
    };
    Diagnostic::warning(span, "stress at rest: P is not 0 at F = I")
        .label(format!("{what}{} is the largest component, at {place}", digits(largest)))
        .help("a term of W may be missing: with mu/2*(I1 - 3) goes -mu*ln(J)")
        .help("if it is intended, the solver that you test needs the same stress in its undeformed body")
}

/// An operation leaves its branch, or is not proved to stay within it.
pub fn leaves_branch(compiled: &Compiled, exit: &BranchViolation) -> Diagnostic {
    let written = quoted(compiled.sources.slice(exit.span));
    let place = place(compiled, &exit.witness);
    let (why, help) = match exit.must {
        Must::BePositive => ("what must be positive is not", "keep its operand away from 0"),
        Must::NotBeNegative => {
            ("what must not be negative is", "write the simplified formula instead")
        }
        Must::NotVanish => ("what must not be 0 is", "keep its operand away from 0"),
        Must::KeepOffCut => (
            "the point (x, y) of atan2(y, x) is on the negative x axis, and the angle jumps by a turn",
            "turn the axes so that the cut lies outside, or take the angle only in sines and cosines of whole multiples of it",
        ),
        Must::KeepOffOrigin => (
            "both arguments of atan2 are 0",
            "there is no angle about the origin: keep it out of the body",
        ),
    };
    let (message, label) = match exit.is_certain {
        true => (format!("{written} is not analytic everywhere"), format!("{why} at {place}")),
        false => (
            format!("{written} is not proved to be analytic everywhere"),
            format!("near {place}: it may be that {why}"),
        ),
    };
    Diagnostic::error(exit.span, message)
        .label(label)
        .help("derivatives do not see where a function ends or jumps: shrink the body, the time window or a range")
        .help(help)
}

/// A quantity has no value.
pub fn undefined(compiled: &Compiled, quantity: Quantity, witness: &Witness) -> Diagnostic {
    let message = format!("{} has no finite value everywhere", quantity.name());
    Diagnostic::error(displacement(compiled), message)
        .label(format!("none at {}", place(compiled, witness)))
        .help("a division by 0, or a root or logarithm that has no derivative there: shrink the body or the time window, or change u")
}

/// A quantity is not proved to have a value.
pub fn not_finite(compiled: &Compiled, quantity: Quantity, witness: &Witness) -> Diagnostic {
    let message = format!("{} is not proved to be finite everywhere", quantity.name());
    Diagnostic::error(displacement(compiled), message)
        .label(format!("near {}", place(compiled, witness)))
        .help("shrink the body or the time window, or write u in another form")
}

/// A quantity that has a value is not computed in a precision, or not proved to be.
pub fn not_computed(
    compiled: &Compiled,
    precision: &str,
    finding: &computed::ComputedVerdict,
) -> Option<Diagnostic> {
    let (message, label) = match finding {
        computed::ComputedVerdict::Proved | computed::ComputedVerdict::NotApplicable => {
            return None;
        }
        computed::ComputedVerdict::Fails(quantity, witness, cause) => (
            format!("{} is finite everywhere, but not as {precision} computes it", quantity.name()),
            format!("{cause} at {}", place(compiled, witness)),
        ),
        computed::ComputedVerdict::Unproved(quantity, witness) => (
            format!("{} is not proved to be finite as {precision} computes it", quantity.name()),
            format!("near {}", place(compiled, witness)),
        ),
    };
    Some(
        Diagnostic::error(displacement(compiled), message)
            .label(label)
            .help("choose units in which numbers are smaller, shrink the body or the time window, or write u in another form"),
    )
}

/// A claim does not hold.
pub fn refuted(
    compiled: &Compiled,
    claim: &BoundarySpec,
    witness: &Witness,
    value: f64,
) -> Diagnostic {
    let (face, word) = (claim.face.value.name(), claim.claim.value);
    let message = format!(
        "`{face}` is no `{}` face: {} does not hold everywhere",
        word.name(),
        word.meaning()
    );
    let help = match word {
        Claim::Axis => "leave the claim out where the body does not reach the axis",
        _ => "`prescribed` and `traction` claim nothing about the values",
    };
    Diagnostic::error(claim.claim.span, message)
        .label(format!("{} instead of 0 at {}", digits(value), place(compiled, witness)))
        .help(help)
}

/// A claim is not proved.
pub fn unproved(claim: &BoundarySpec, interval: [f64; 2]) -> Diagnostic {
    let (face, word) = (claim.face.value.name(), claim.claim.value);
    let message =
        format!("`{face}` is not proved to be a `{}` face: {}", word.name(), word.meaning());
    let found = format!("lies in [{}, {}]", digits(interval[0]), digits(interval[1]));
    let (label, help) = match word {
        Claim::Prescribed | Claim::Traction => (
            format!("what has to be finite {found}"),
            "shrink the body or the time window, or write u in another form",
        ),
        Claim::Fixed | Claim::Roller | Claim::Free => (
            format!("what should be 0 {found}"),
            "write u so that the claim follows term by term, or claim `prescribed` or `traction`",
        ),
        Claim::Axis => (
            format!("what should be 0 {found}"),
            "write u_R and the swirl as R times another formula",
        ),
    };
    Diagnostic::error(claim.claim.span, message).label(label).help(help)
}

fn place(compiled: &Compiled, witness: &Witness) -> String {
    let names: Vec<String> =
        compiled.model.parameters.iter().map(|parameter| parameter.name.clone()).collect();
    witness.describe(compiled.field.space.axes(), &names)
}

fn displacement(compiled: &Compiled) -> Span {
    compiled.field.displacement.first().map_or(compiled.field.material.span, |it| it.span)
}

/// The parameter whose range is to blame for a formula that is not positive: with its default instead, the formula is positive
/// at the same place and time.
fn culprit(
    compiled: &Compiled,
    witness: &Witness,
    formula: impl FnOnce(&mut Graph) -> Option<Expr>,
) -> Option<(Span, String)> {
    if witness.parameters.is_empty() {
        return None;
    }
    let mut graph = room(compiled);
    let chart = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    let formula = formula(&mut graph)?;
    let formula = chart.pull_back(&mut graph, &[formula]);
    let formulas = Formulas::new(&mut graph, &chart, &formula);
    let mut values = formulas.run::<f64>(&chart);
    let defaults = compiled.parameters::<f64>(&Default::default());
    let coordinates = compiled.model.domain.body.coordinates(&witness.coordinates);
    let place = |reset: usize| -> Vec<f64> {
        let parameters = witness
            .parameters
            .iter()
            .map(|(index, value)| if *index == reset { defaults[*index] } else { *value });
        parameters.chain([witness.time]).chain(coordinates.iter().copied()).collect()
    };
    let to_blame = |index: &usize| values.values(&place(*index))[0] > 0.0;
    let index = witness.parameters.iter().map(|(index, _)| *index).find(to_blame)?;
    Some((range(compiled, index)?, compiled.field.parameters[index].name.value.clone()))
}

/// The place of the range of a parameter in the file.
fn range(compiled: &Compiled, index: usize) -> Option<Span> {
    let [first, last] = compiled.field.parameters[index].range.as_ref()?;
    Some(Span { end: last.span.end, ..first.span })
}

/// A copy of the field's graph, with room and steps for a search.
fn room(compiled: &Compiled) -> Graph {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    graph.work().allow(STEPS);
    graph
}
