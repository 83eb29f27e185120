//! Checks the declarations of a field about its material at points of the body; this is no proof.

use mms_math::Scalar as _;

use super::{Declared, digits};
use mms_mechanics::extent::{Extent, halton};
use mms_mechanics::model::energy::{INCOMPRESSIBLE, POISSON};
use mms_mechanics::tensor::dot;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_program::schedule::schedule;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::source::Span;
use mms_symbolic::expr::{Expr, HALF, Rational, Symbol};
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::sorted::SortedMap;

/// The number of points of the body where a material is checked, beside the corners.
pub const POINTS: usize = 128;

/// Values that violate a condition, and the point where they do.
pub(super) struct Counterexample {
    exprs: Vec<Expr>,
    /// The values of the expressions at the point.
    pub values: Vec<Precise>,
    /// The point; empty if the values are the same everywhere.
    point: Vec<Precise>,
}

impl Counterexample {
    /// The first value, in a sentence.
    fn says(&self, is: &str) -> String {
        match &self.values[0] {
            value if value.is_defined() => format!("{is} {}", digits(value)),
            _ => "this is not defined".to_string(),
        }
    }
}

impl Declared<'_> {
    /// Reports a density that is not positive.
    pub(super) fn density(&mut self, extent: &Extent<Precise>) {
        let (density, Some(formula)) = (self.model.density, &self.field.material.density) else {
            return;
        };
        // A number is judged when it is read, and so is a density that changes in time.
        if self.is_judged(density) {
            return;
        }
        let zero = Precise::from_f64(0.0);
        if let Some(found) = self.sought(extent, &[density], |values| !values[0].at_most(&zero)) {
            let span = formula.span;
            let help = "the body force is per unit mass: b = a - Div P/rho0";
            let diagnostic = Diagnostic::error(span, "the density must be positive");
            self.refute(diagnostic, &found.says("this is"), &found, help);
        }
    }

    /// Reports a direction of fibres that is not a unit vector.
    pub(super) fn fibre(&mut self, extent: &Extent<Precise>) {
        let (Some(direction), Some(formulas)) = (&self.model.fibre, &self.field.material.fibre)
        else {
            return;
        };
        let graph = &mut self.graph;
        let relations = Relations::find(graph, direction);
        let pairs = direction.iter().map(|component| (*component, *component));
        let square = dot(graph, pairs);
        let square = reduce(graph, &[square], &relations)[0];
        let is_one = graph.as_number(square).is_some_and(Rational::is_one);
        if is_one || graph.symbols(square).contains(&Symbol::Time) {
            return;
        }
        let length = graph.power(square, HALF);
        let [one, rounding] = [1.0, 1e-60].map(Precise::from_f64);
        let is_unit =
            |values: &[Precise]| (values[0].clone() - one.clone()).magnitude().at_most(&rounding);
        if let Some(found) = self.sought(extent, &[length], is_unit)
            && let [first, .., last] = formulas.as_slice()
        {
            let span = Span { end: last.span.end, ..first.span };
            let divisor = self.graph.print(length, &self.model.names);
            let help = format!("divide each component by `{divisor}`");
            let message = "the direction of the fibres must have the length 1";
            let label = found.says("its length is");
            self.refute(Diagnostic::error(span, message), &label, &found, &help);
        }
    }

    /// Reports an impossible Poisson's ratio if the moduli are made of it.
    pub(super) fn poisson(&mut self, extent: &Extent<Precise>) {
        let Some(ratio) = self.model.poisson.filter(|ratio| !self.is_judged(*ratio)) else {
            return;
        };
        let mut arguments = self.field.material.arguments.iter();
        let Some((_, formula)) = arguments.find(|(name, _)| name.value == "nu") else { return };
        let [least, greatest] = [-1.0, 0.5].map(Precise::from_f64);
        let is_right =
            |values: &[Precise]| !values[0].at_most(&least) && !greatest.at_most(&values[0]);
        if let Some(found) = self.sought(extent, &[ratio], is_right) {
            let diagnostic = Diagnostic::error(formula.span, POISSON);
            self.refute(diagnostic, &found.says("this is"), &found, INCOMPRESSIBLE);
        }
    }

    /// Whether an expression was judged when it was read: a number, or an expression that changes in time.
    fn is_judged(&self, expr: Expr) -> bool {
        let is_number = self.graph.as_number(expr).is_some();
        is_number || self.graph.symbols(expr).contains(&Symbol::Time)
    }

    /// Searches for a point where values are undefined, or where they violate a condition.
    pub(super) fn sought(
        &self,
        extent: &Extent<Precise>,
        exprs: &[Expr],
        is_right: impl Fn(&[Precise]) -> bool,
    ) -> Option<Counterexample> {
        let program = schedule(&self.graph, &SortedMap::from([((), exprs.to_vec())]));
        let mut interpreter = Interpreter::within(self.graph.work(), &program, &self.parameters);
        let plan = interpreter.plan(&[()]);
        let mut symbols = exprs.iter().flat_map(|expr| self.graph.symbols(*expr));
        let varies = symbols.any(|symbol| matches!(symbol, Symbol::Coordinate(_)));
        let count = if varies { usize::MAX } else { 1 };
        // A sample may be smaller: half of the remaining budget is kept for the other checks.
        let floor = self.graph.work().left() / 2;
        let affordable =
            |(index, _): &(usize, Vec<Precise>)| *index == 0 || self.graph.work().left() > floor;
        let mut points = points(extent).take(count).enumerate().take_while(affordable);
        points.find_map(|(_, point)| {
            interpreter.set_point(&plan, Point::at(&point));
            let values = interpreter.output(());
            let is_right = values.iter().all(Precise::is_defined) && is_right(&values);
            let point = if varies { point } else { Vec::new() };
            (!is_right).then(|| Counterexample { exprs: exprs.to_vec(), values, point })
        })
    }

    /// Reports values that violate a condition, and where.
    pub(super) fn refute(
        &mut self,
        diagnostic: Diagnostic,
        label: &str,
        found: &Counterexample,
        help: &str,
    ) {
        let mut label = label.to_string();
        if !found.point.is_empty() {
            let coordinates = self.field.space.axes().iter().zip(&found.point);
            let place: Vec<_> =
                coordinates.map(|(axis, value)| format!("{axis} = {}", digits(value))).collect();
            label.push_str(&format!(" at {}", place.join(", ")));
        }
        let diagnostic = self.with_parameters(diagnostic.label(label), &found.exprs);
        self.report(diagnostic.help(help));
    }
}

/// The corners of a body, and points spread over it.
fn points(extent: &Extent<Precise>) -> impl Iterator<Item = Vec<Precise>> {
    let dimension = extent.dimension();
    let corners = (0..1usize << dimension).map(move |corner| {
        let end = |axis: usize| Precise::from_f64(f64::from(u8::from(corner >> axis & 1 == 1)));
        (0..dimension).map(end).collect::<Vec<_>>()
    });
    let inside = (1..=POINTS).map(|index| halton(index).to_vec());
    corners.chain(inside).map(|fractions| extent.point(&fractions))
}
