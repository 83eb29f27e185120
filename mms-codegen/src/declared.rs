//! Checks the numbers that a field declares: its parameters, its body, its time window and its material, with the defaults when
//! it is compiled, and with the values that a user sets.
//!
//! The conditions, in 77 digits: each parameter lies within its `range`; lower < upper; 0 <= inner < outer; angles ascend, by
//! at most a turn; edges of a polygon do not cross (`body`); first < last time; no claim is on a face without extent. At the
//! corners of the body and at 128 points in it: rho0 > 0, the direction of fibres has the length 1, and Poisson's ratio lies
//! between -1 and 1/2; at F = I, W has two derivatives by each invariant, and the material is elliptic (`elasticity`). This is
//! a sample, not a proof. The parameters of each `[[extreme]]` must fulfil the same conditions.

mod body;
pub(crate) mod elasticity;
mod material;

use mms_math::Scalar as _;

use mms_mechanics::model::Model;
use mms_mechanics::model::parameter_values;
use mms_program::interpret::Interpreter;
use mms_program::precise::Precise;
use mms_program::schedule::schedule;
use mms_spec::diagnostic::{Diagnostic, MAX_RENDERED, quoted};
use mms_spec::source::Span;
use mms_spec::{ExtremeSpec, Face, FieldSpec, Formula, MaterialSpec};
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::sorted::{SortedMap, SortedSet};
use mms_symbolic::work::Work;

/// The budget of checking the numbers of a field: at its parameters alone, and at all of its extremes.
const STEPS: u64 = 50_000_000;
const STEPS_OF_PARAMETERS: u64 = 20_000_000;
const STEPS_OF_EXTREMES: u64 = 100_000_000;

/// The steps of copying a node.
const STEPS_OF_COPY: u64 = 20;

/// The largest number of parameter values in a message.
const MAX_SHOWN: usize = 6;

/// The mistakes in the numbers of a field whose formulas have been resolved; `set` holds the parameters that do not have their
/// default.
pub fn check(
    graph: &Graph,
    model: &Model,
    specs: (&FieldSpec, &MaterialSpec),
    set: &SortedMap<usize, Expr>,
) -> Vec<Diagnostic> {
    let mut graph = graph.clone();
    graph.make_room();
    graph.work().allow(STEPS);
    judge(graph, model, specs, set)
}

/// The first mistake of a field at the values of each of its extremes.
pub fn extremes(
    graph: &Graph,
    model: &Model,
    (field, material): (&FieldSpec, &MaterialSpec),
) -> Vec<Diagnostic> {
    let work = Work::new(graph.work().stop().clone());
    work.allow(STEPS_OF_EXTREMES);
    let (mut found, mut seen) = (Vec::new(), 0);
    for (extreme, set) in field.extremes.iter().zip(&model.extremes) {
        if work.is_over() || found.len() >= MAX_RENDERED {
            break;
        }
        work.spend(STEPS_OF_COPY * graph.len() as u64);
        let mut graph = graph.clone();
        graph.make_room();
        graph.work().allow(work.left().min(STEPS));
        let before = graph.work().left();
        let left = graph.work().share();
        let wrong = judge(graph, model, (field, material), set).into_iter().next();
        work.spend(before - left.left());
        if work.is_over() {
            // This mistake may only mean that the budget is spent.
            break;
        }
        seen += 1;
        found.extend(wrong.map(|wrong| at_extreme(extreme, wrong)));
    }
    let unseen = field.extremes.get(seen).filter(|_| work.is_over());
    found.extend(unseen.map(|extreme| too_long(extreme.span, "the extremes of this field")));
    found
}

/// A mistake of a field at the values of an extreme, at the place of the extreme.
fn at_extreme(extreme: &ExtremeSpec, wrong: Diagnostic) -> Diagnostic {
    let name = quoted(extreme.name.value.raw());
    let message = format!("the extreme {name} is no state of this field: {}", wrong.message);
    let set = extreme.set.iter();
    let set: Vec<_> = set
        .take(MAX_SHOWN)
        .map(|(name, value)| format!("{} = {}", name.value, value.text))
        .collect();
    let span = extreme.set.first().map_or(extreme.span, |(name, _)| name.span);
    let label = if wrong.label.is_empty() { "with this".into() } else { wrong.label };
    let mut diagnostic = Diagnostic::error(span, message).label(label);
    diagnostic.help = wrong.help;
    diagnostic.help(format!(
        "extremes must fulfil the conditions of defaults; this one sets {}",
        set.join(", ")
    ))
}

/// The mistakes of a field at these values of its parameters, within the budget of the graph.
fn judge(
    mut graph: Graph,
    model: &Model,
    (field, material): (&FieldSpec, &MaterialSpec),
    set: &SortedMap<usize, Expr>,
) -> Vec<Diagnostic> {
    if field.incomplete || graph.is_exhausted() {
        return Vec::new();
    }
    let steps = graph.work().left();
    let at_first = steps.min(STEPS_OF_PARAMETERS);
    graph.work().allow(at_first);
    let values = parameter_values(&mut graph, model, set);
    let parameters = evaluate(&graph, &[], &values);
    if graph.work().is_over() {
        // The parameters are evaluated many times, so their budget is smaller than for other numbers.
        let span = field.parameters.first().map_or(field.material.span, |first| first.name.span);
        return vec![too_long(span, "the parameters of this field")];
    }
    graph.work().allow(steps - at_first + graph.work().left());
    let mut declared =
        Declared { graph, model, field, material, parameters, diagnostics: Vec::new() };
    // An expression of a parameter without a value has no value either.
    if declared.parameters_exist() {
        declared.ranges();
        declared.domain();
    }
    if declared.graph.work().is_over() {
        // A value that the spent budget left uncomputed looks like an undefined one.
        return vec![too_long(field.material.span, "the domain and the material of this field")];
    }
    declared.diagnostics
}

/// The mistake of a part that would take too long to evaluate with all digits.
fn too_long(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error(span, format!("{what} take too long to evaluate in 77 digits"))
        .label("here, or in what it uses")
        .help("use fewer functions in it: thousands of them are too many")
}

/// The values of expressions in the parameters.
fn evaluate(graph: &Graph, parameters: &[Precise], exprs: &[Expr]) -> Vec<Precise> {
    let program = schedule(graph, &SortedMap::from([((), exprs.to_vec())]));
    Interpreter::within(graph.work(), &program, parameters).output(())
}

/// The values of expressions in the parameters at their defaults.
pub(super) fn values(graph: &Graph, model: &Model, exprs: &[Expr]) -> Vec<f64> {
    let mut graph = graph.clone();
    let defaults = parameter_values(&mut graph, model, &SortedMap::new());
    let parameters = evaluate(&graph, &[], &defaults);
    evaluate(&graph, &parameters, exprs).iter().map(Precise::to_f64).collect()
}

/// A part of the domain, as written and in numbers.
struct Bound<'a> {
    formula: &'a Formula,
    expr: Expr,
    value: Precise,
}

struct Declared<'a> {
    graph: Graph,
    model: &'a Model,
    field: &'a FieldSpec,
    material: &'a MaterialSpec,
    parameters: Vec<Precise>,
    diagnostics: Vec<Diagnostic>,
}

impl<'a> Declared<'a> {
    fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports parameters without a value, except those that only depend on another one without a value.
    fn parameters_exist(&mut self) -> bool {
        let undefined: SortedSet<Symbol> = (0..self.parameters.len())
            .filter(|index| !self.parameters[*index].is_defined())
            .map(Symbol::Parameter)
            .collect();
        for (index, parameter) in self.field.parameters.iter().enumerate() {
            let symbol = Symbol::Parameter(index);
            if self.diagnostics.len() >= MAX_RENDERED || !undefined.contains(&symbol) {
                continue;
            }
            let causes = self.graph.symbols(self.model.parameters[index].default);
            if causes.is_disjoint(&undefined) {
                let message =
                    format!("the value of `{}` is not a real number", parameter.name.value);
                self.diagnostics.push(
                    Diagnostic::error(parameter.value.span, message)
                        .label("not defined for the values of the parameters above it"),
                );
            }
        }
        undefined.is_empty()
    }

    fn ranges(&mut self) {
        let model = self.model;
        let with_range: Vec<_> = model
            .parameters
            .iter()
            .enumerate()
            .filter_map(|(index, parameter)| Some((index, parameter.range?)))
            .collect();
        let exprs: Vec<Expr> = with_range.iter().flat_map(|(_, range)| *range).collect();
        let bounds = evaluate(&self.graph, &self.parameters, &exprs);
        for ((index, _), range) in with_range.into_iter().zip(bounds.chunks_exact(2)) {
            let spec = &self.field.parameters[index];
            let Some([first, last]) = &spec.range else { continue };
            let span = Span { end: last.span.end, ..first.span };
            let (name, value) = (&spec.name.value, &self.parameters[index]);
            self.diagnostics.extend(range_mistake(name, value, &range[0], &range[1], span));
        }
    }

    fn domain(&mut self) {
        let reported = self.diagnostics.len();
        let extent = self.body();
        self.axis();
        // A wrong body has no points.
        if let Some(extent) = extent.filter(|_| self.diagnostics.len() == reported) {
            self.density(&extent);
            self.fibre(&extent);
            self.poisson(&extent);
            // Moduli may be made of a ratio that is wrong.
            if self.diagnostics.len() == reported {
                self.elasticity(&extent);
            }
        }
        let formulas = self.field.domain.time.as_ref().map(|time| time.each_ref());
        let time = formulas.and_then(|it| self.bounds(it, self.model.domain.time));
        if let Some([first, last]) = time {
            self.ascending("the time window is empty", "it starts at", &first, &last);
        }
    }

    /// The value of a bound, if it has one.
    fn bound(&mut self, formula: &'a Formula, expr: Expr) -> Option<Bound<'a>> {
        let value = evaluate(&self.graph, &self.parameters, &[expr]).swap_remove(0);
        let bound = Bound { formula, expr, value };
        if bound.value.is_defined() {
            return Some(bound);
        }
        let message = "this bound is not a real number";
        let diagnostic =
            Diagnostic::error(formula.span, message).label("not defined for these parameters");
        let diagnostic = self.with_parameters(diagnostic, &[expr]);
        self.report(diagnostic);
        None
    }

    /// The values of two bounds, if both have one.
    fn bounds(&mut self, formulas: [&'a Formula; 2], exprs: [Expr; 2]) -> Option<[Bound<'a>; 2]> {
        let [first, last] = [0, 1].map(|end| self.bound(formulas[end], exprs[end]));
        Some([first?, last?])
    }

    /// Reports two bounds if the second is not greater than the first.
    fn ascending(&mut self, message: &str, first_is: &str, first: &Bound<'_>, last: &Bound<'_>) {
        if !last.value.at_most(&first.value) {
            return;
        }
        let label =
            format!("this is {}, and {first_is} {}", digits(&last.value), digits(&first.value));
        let diagnostic = Diagnostic::error(last.formula.span, message).label(label);
        let diagnostic = self.with_parameters(diagnostic, &[first.expr, last.expr]);
        self.report(diagnostic);
    }

    /// Reports a rotation about an axis of length 0.
    fn axis(&mut self) {
        let rotation = self.model.rigid.as_ref().and_then(|rigid| rigid.rotation.as_ref());
        let Some(square) = rotation.and_then(|rotation| rotation.axis_squared(&mut self.graph))
        else {
            return;
        };
        let value = &evaluate(&self.graph, &self.parameters, &[square])[0];
        let Some(mms_spec::Rotation::Space { axis, .. }) =
            self.field.rigid.as_ref().and_then(|rigid| rigid.rotation.as_ref())
        else {
            return;
        };
        if !value.is_defined() || value.at_most(&Precise::from_f64(0.0)) {
            let span = Span { end: axis[2].span.end, ..axis[0].span };
            let diagnostic = Diagnostic::error(span, "the axis of the rotation has no direction")
                .label(format!("its length squared is {}", digits(value)))
                .help("give three components that are not all 0; the length does not matter");
            let diagnostic = self.with_parameters(diagnostic, &[square]);
            self.report(diagnostic);
        }
    }

    /// Reports claims on faces that this body does not have.
    fn refuse_claims(&mut self, faces: &[Face], message: &str, label: &str) {
        for claim in &self.field.boundary {
            if faces.contains(&claim.face.value) {
                let diagnostic = Diagnostic::error(claim.face.span, message).label(label);
                self.diagnostics.push(diagnostic.help("remove this claim"));
            }
        }
    }

    /// Adds the values of the parameters that expressions depend on.
    fn with_parameters(&self, diagnostic: Diagnostic, exprs: &[Expr]) -> Diagnostic {
        let mut indices: Vec<usize> = Vec::new();
        for symbol in exprs.iter().flat_map(|expr| self.graph.symbols(*expr)) {
            match symbol {
                Symbol::Parameter(index) if !indices.contains(&index) => indices.push(index),
                _ => {}
            }
        }
        if indices.is_empty() || indices.len() > MAX_SHOWN {
            return diagnostic;
        }
        let values: Vec<_> = indices
            .into_iter()
            .map(|index| {
                let name = &self.model.parameters[index].name;
                format!("`{name}` is {}", digits(&self.parameters[index]))
            })
            .collect();
        diagnostic.help(format!("here {}", values.join(", ")))
    }
}

/// The mistake in the range of a parameter, or in its value there, if any.
fn range_mistake(
    name: &str,
    value: &Precise,
    least: &Precise,
    greatest: &Precise,
    span: Span,
) -> Option<Diagnostic> {
    if !(least.is_defined() && greatest.is_defined()) {
        let message = format!("the range of `{name}` is not one of real numbers");
        let label = "not defined for the values of the parameters above it";
        return Some(Diagnostic::error(span, message).label(label));
    }
    let shown = format!("{} to {}", digits(least), digits(greatest));
    if !least.at_most(greatest) {
        let message = format!("the range of `{name}` is reversed");
        return Some(
            Diagnostic::error(span, message)
                .label(format!("this is {shown}"))
                .help("write the least value first"),
        );
    }
    if least.at_most(value) && value.at_most(greatest) {
        return None;
    }
    let message = format!("`{name}` is {}, outside its range", digits(value));
    Some(Diagnostic::error(span, message).label(format!("expected {shown}")))
}

/// Formats a number of any size for a message, in few digits.
fn digits(value: &Precise) -> String {
    crate::bounds::witness::digits(value.to_f64())
}
