//! Resolves a parsed formula, with the names in scope, to an expression.

mod sign;

use mms_spec::diagnostic::{Diagnostic, MAX_RENDERED};
use mms_spec::language::{FUNCTIONS, elsewhere};
use mms_spec::source::{Span, Spanned};
use mms_spec::suggest::advice;
use mms_spec::syntax::{Ast, NodeKind, Operator};
use mms_symbolic::expr::{Expr, Function, Graph, Rational, Symbol};
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// Functions that people try, and that a field cannot have.
const NON_SMOOTH: &[&str] =
    &["abs", "sign", "sgn", "min", "max", "floor", "ceil", "round", "mod", "step", "heaviside"];

/// An operation, as written, that may lack a value or a derivative somewhere.
#[derive(Clone, Debug)]
pub struct WrittenOperation {
    /// The place in the file.
    pub span: Span,
    /// The value of the operation itself: a power or a call; for a quotient the divisor, since recording a step must not make a
    /// node. Canonical form may cancel it in expressions that use it.
    pub value: Expr,
    /// Whether the value is a divisor.
    pub is_divisor: bool,
}

impl WrittenOperation {
    /// The value of the step.
    pub fn made(&self, graph: &mut Graph) -> Expr {
        if self.is_divisor { graph.power(self.value, -1) } else { self.value }
    }
}

/// The names that a formula may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    names: SortedMap<String, Expr>,
    /// Names that are defined further down, with those definitions.
    later: SortedMap<String, Span>,
    /// Names whose definitions failed or were refused: using them is a consequence, not a mistake.
    failed: SortedSet<String>,
    /// Names that exist elsewhere in the language, with the reason why they do not here.
    unavailable: SortedMap<String, String>,
    /// Symbols known to be positive.
    positive: SortedSet<Symbol>,
    /// Whether a part of the file could not be read: a name may be defined there.
    incomplete: bool,
    /// The help for an unknown name: the further names that formulas of this kind may use.
    hint: Option<&'static str>,
}

impl Scope {
    /// Defines a name for the formulas after it; `None` marks a definition that failed.
    pub fn define(&mut self, name: &str, value: Option<Expr>) {
        self.later.remove(name);
        match value {
            Some(value) => {
                self.names.insert(name.into(), value);
            }
            None => {
                self.failed.insert(name.into());
            }
        }
    }

    /// The value of a defined name.
    pub fn known(&self, name: &str) -> Option<Expr> {
        self.names.get(name).copied()
    }

    /// Whether the file defines a name, rightly or wrongly.
    pub fn has(&self, name: &str) -> bool {
        self.names.contains_key(name) || self.failed.contains(name) || self.later.contains_key(name)
    }

    /// Marks as failed the reserved names that the file tries to define.
    pub fn refuse(&mut self, names: &[String]) {
        self.failed.extend(names.iter().cloned());
    }

    /// Announces a name that is defined further down.
    pub fn announce(&mut self, name: &Spanned<String>) {
        self.later.insert(name.value.clone(), name.span);
    }

    /// Records why a name of the language is not available in this scope.
    pub fn withhold(&mut self, name: &str, reason: impl Into<String>) {
        self.unavailable.insert(name.into(), reason.into());
    }

    /// Records that definitions may be missing, so that an unknown name is not a mistake.
    pub fn tolerate_unknown_names(&mut self) {
        self.incomplete = true;
    }

    /// Sets the help for unknown names: the further names that formulas of this kind may use.
    pub fn hint(&mut self, hint: &'static str) {
        self.hint = Some(hint);
    }

    /// Records that a symbol is positive.
    pub fn assume_positive(&mut self, symbol: Symbol) {
        self.positive.insert(symbol);
    }

    /// Resolves a formula. Reports every mistake in it, and returns `None` if there was one.
    pub fn resolve(
        &self,
        graph: &mut Graph,
        ast: &Ast,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Expr> {
        self.resolve_in_steps(graph, ast, diagnostics, &mut Vec::new())
    }

    /// Resolves a formula, and returns its powers, quotients and calls as steps.
    pub fn resolve_in_steps(
        &self,
        graph: &mut Graph,
        ast: &Ast,
        diagnostics: &mut Vec<Diagnostic>,
        steps: &mut Vec<WrittenOperation>,
    ) -> Option<Expr> {
        if graph.is_exhausted() {
            return None;
        }
        let reported = diagnostics.len();
        let mut resolver = Resolver { scope: self, graph, diagnostics, steps };
        let mut values = Vec::<Option<Partial>>::with_capacity(ast.nodes.len());
        for node in &ast.nodes {
            let value = resolver.node(&node.kind, node.span, ast, &mut values);
            values.push(value);
        }
        let root = values.pop().flatten().map(|root| root.finish(graph));
        if graph.is_exhausted() {
            // Reports from a full graph are meaningless, so one report replaces them.
            diagnostics.truncate(reported);
            diagnostics.extend(ast.nodes.last().map(|formula| {
                let diagnostic = Diagnostic::error(formula.span, "the formula is too large");
                Diagnostic { help: graph.exhaustion(), ..diagnostic.label("with what it uses") }
            }));
            return None;
        }
        root
    }
}

/// A value under construction. A chain such as a + b - c is collected first and made canonical
/// once, so that long formulas take linear time.
enum Partial {
    Done(Expr),
    Sum(Vec<(Expr, Rational)>),
    Product(Vec<(Expr, Rational)>),
}

impl Partial {
    fn finish(self, graph: &mut Graph) -> Expr {
        match self {
            Partial::Done(expr) => expr,
            Partial::Sum(terms) => graph.sum(terms),
            Partial::Product(factors) => graph.product(factors),
        }
    }

    fn into_terms(self, graph: &mut Graph) -> Vec<(Expr, Rational)> {
        match self {
            Partial::Sum(terms) => terms,
            other => vec![(other.finish(graph), Rational::ONE)],
        }
    }

    fn into_factors(self, graph: &mut Graph) -> Vec<(Expr, Rational)> {
        match self {
            Partial::Product(factors) => factors,
            other => vec![(other.finish(graph), Rational::ONE)],
        }
    }
}

struct Resolver<'a> {
    scope: &'a Scope,
    graph: &'a mut Graph,
    diagnostics: &'a mut Vec<Diagnostic>,
    steps: &'a mut Vec<WrittenOperation>,
}

impl Resolver<'_> {
    /// Resolves a node. Each node is the operand of one other, so its value can be moved.
    fn node(
        &mut self,
        kind: &NodeKind,
        span: Span,
        ast: &Ast,
        values: &mut [Option<Partial>],
    ) -> Option<Partial> {
        let expr = match kind {
            NodeKind::Number(number) => Some(self.graph.number(number.clone())),
            NodeKind::Name(name) => self.name(name, span),
            NodeKind::Negate(operand) => {
                let operand = values[*operand].take()?.finish(self.graph);
                Some(self.graph.scale(operand, -1))
            }
            NodeKind::Binary(operator, left, right) => {
                let (a, b) = (values[*left].take(), values[*right].take());
                let b = b.map(|b| b.finish(self.graph));
                let (left, right) = (ast.nodes[*left].span, ast.nodes[*right].span);
                return self.binary(*operator, a?, b?, [span, left, right]);
            }
            NodeKind::Call { name, arguments } => {
                let spans: Vec<_> = arguments.iter().map(|index| ast.nodes[*index].span).collect();
                let values: Vec<_> = arguments
                    .iter()
                    .map(|index| values[*index].take().map(|value| value.finish(self.graph)))
                    .collect();
                let value = self.call(name, &values, &spans);
                self.steps.extend(value.map(|value| WrittenOperation {
                    span,
                    value,
                    is_divisor: false,
                }));
                value
            }
        };
        expr.map(Partial::Done)
    }

    fn report(&mut self, diagnostic: Diagnostic) -> Option<Expr> {
        self.diagnostics.push(diagnostic);
        None
    }

    fn name(&mut self, name: &str, span: Span) -> Option<Expr> {
        if self.scope.failed.contains(name) {
            return None;
        }
        if let Some(expr) = self.scope.names.get(name) {
            return Some(*expr);
        }
        if let Some(definition) = self.scope.later.get(name) {
            return self.report(forward_reference(name, span, *definition));
        }
        if let Some(reason) = self.scope.unavailable.get(name) {
            let diagnostic = Diagnostic::error(span, format!("`{name}` is not available here"));
            return self.report(diagnostic.label(reason.clone()));
        }
        if let Some(arity) = arity(name) {
            let call = if arity == 1 { format!("{name}(x)") } else { format!("{name}(y, x)") };
            let diagnostic = Diagnostic::error(span, format!("`{name}` is a function"));
            return self.report(diagnostic.label(format!("expected a call such as `{call}`")));
        }
        if self.scope.incomplete {
            return None;
        }
        let diagnostic =
            Diagnostic::error(span, format!("unknown name `{name}`")).label("not defined");
        // Further messages are not shown, and the search for similar names is slow.
        if self.diagnostics.len() >= MAX_RENDERED {
            return self.report(diagnostic);
        }
        let candidates = self.scope.names.keys().map(String::as_str);
        let among = || {
            advice(name, candidates, |_| match self.scope.names.is_empty() {
                true => "expected a number".into(),
                false => format!("names in scope: {}", self.known_names()),
            })
        };
        let mut diagnostic = diagnostic.help(elsewhere(name).map_or_else(among, str::to_owned));
        diagnostic.help.extend(self.scope.hint.map(str::to_owned));
        self.report(diagnostic)
    }

    fn known_names(&self) -> String {
        let names: Vec<_> = self.scope.names.keys().map(|name| format!("`{name}`")).collect();
        names.join(", ")
    }

    fn binary(
        &mut self,
        operator: Operator,
        a: Partial,
        b: Expr,
        [span, left, right]: [Span; 3],
    ) -> Option<Partial> {
        match operator {
            Operator::Add | Operator::Subtract => {
                let mut terms = a.into_terms(self.graph);
                let plus = operator == Operator::Add;
                terms.push((b, if plus { Rational::ONE } else { Rational::NEG_ONE }));
                Some(Partial::Sum(terms))
            }
            Operator::Divide if self.graph.is_zero(b) => {
                let diagnostic = Diagnostic::error(right, "division by zero");
                self.diagnostics.push(diagnostic.label("this is exactly 0"));
                None
            }
            Operator::Multiply | Operator::Divide => {
                let mut factors = a.into_factors(self.graph);
                let exponent = match operator {
                    Operator::Multiply => Rational::ONE,
                    _ => Rational::NEG_ONE,
                };
                if operator == Operator::Divide && self.graph.as_number(b).is_none() {
                    self.steps.push(WrittenOperation { span, value: b, is_divisor: true });
                }
                factors.push((b, exponent));
                Some(Partial::Product(factors))
            }
            Operator::Power => {
                let base = a.finish(self.graph);
                let value = self.power(base, b, left, right);
                self.steps.extend(value.map(|value| WrittenOperation {
                    span,
                    value,
                    is_divisor: false,
                }));
                value.map(Partial::Done)
            }
        }
    }

    fn power(&mut self, base: Expr, exponent: Expr, left: Span, right: Span) -> Option<Expr> {
        let Some(number) = self.graph.as_number(exponent).cloned() else {
            let symbols = self.graph.symbols(base);
            let is_of_parameters = symbols.iter().all(|it| matches!(it, Symbol::Parameter(_)));
            if is_of_parameters && !self.scope.is_positive(self.graph, base) {
                return self.report(
                    Diagnostic::error(left, "a variable exponent needs a positive base")
                        .label("not proved positive")
                        .help("write the exponent as a number, or the base as exp(..) of its logarithm"),
                );
            }
            // The proofs about branches decide whether another base is positive over the body.
            return Some(self.graph.call(Function::Powf, &[base, exponent]));
        };
        match self.graph.as_number(base) {
            Some(zero) if zero.is_zero() && number < Rational::ZERO => {
                return self.report(
                    Diagnostic::error(left, "division by zero")
                        .label("0 to a negative power")
                        .help(format!("the exponent is {number}")),
                );
            }
            Some(negative) if *negative < Rational::ZERO && !number.is_int() => {
                return self.report(
                    Diagnostic::error(left, "a root of a negative number is not real")
                        .label(format!("this is {negative}"))
                        .help("cbrt(x) is the real cube root of either sign"),
                );
            }
            _ => {}
        }
        let power = self.graph.power(base, number);
        let unfolded =
            self.graph.as_number(base).is_some() && self.graph.as_number(power).is_none();
        if unfolded && self.graph.as_number(exponent).is_some_and(Rational::is_int) {
            return self.report(
                Diagnostic::error(right, "the power of a number is too long")
                    .label("the exact result has thousands of digits"),
            );
        }
        Some(power)
    }

    fn call(
        &mut self,
        name: &Spanned<String>,
        values: &[Option<Expr>],
        spans: &[Span],
    ) -> Option<Expr> {
        let Some(arity) = arity(&name.value) else {
            let diagnostic = self.unknown_function(name);
            return self.report(diagnostic);
        };
        if values.len() != arity {
            let plural = if arity == 1 { "argument" } else { "arguments" };
            let message =
                format!("`{}` takes {arity} {plural}, found {}", name.value, values.len());
            return self.report(
                Diagnostic::error(name.span, message).label(format!("expected {arity} {plural}")),
            );
        }
        let arguments: Vec<Expr> = values.iter().copied().collect::<Option<_>>()?;
        self.outside_domain(&name.value, arguments[0], spans[0])?;
        if name.value == "hypot" {
            let (x, y) = (self.graph.power(arguments[0], 2), self.graph.power(arguments[1], 2));
            let squares = self.graph.add(x, y);
            return Some(self.graph.call(Function::Sqrt, &[squares]));
        }
        let function = Function::ALL.iter().find(|function| function.name() == name.value)?;
        Some(self.graph.call(*function, &arguments))
    }

    /// Refuses an argument that is a number outside the function's domain.
    fn outside_domain(&mut self, function: &str, argument: Expr, span: Span) -> Option<()> {
        let Some(number) = self.graph.as_number(argument) else { return Some(()) };
        let outside = match function {
            "ln" => *number <= Rational::ZERO,
            "sqrt" => *number < Rational::ZERO,
            "asin" | "acos" => *number > Rational::ONE || *number < Rational::NEG_ONE,
            _ => false,
        };
        if !outside {
            return Some(());
        }
        let message = format!("`{function}` is not defined at {number}");
        self.diagnostics.push(Diagnostic::error(span, message).label("outside the domain"));
        None
    }

    fn unknown_function(&self, name: &Spanned<String>) -> Diagnostic {
        let shown = &name.value;
        if NON_SMOOTH.contains(&shown.as_str()) {
            return Diagnostic::error(name.span, format!("`{shown}` is not smooth"))
                .label("a manufactured solution is differentiated up to twice")
                .help("a smooth field has a body force; choose one of the smooth functions");
        }
        if self.scope.names.contains_key(shown) {
            return Diagnostic::error(name.span, format!("`{shown}` is not a function"))
                .label("called like a function")
                .help(format!("a product needs its sign: `{shown}*(...)`"));
        }
        let diagnostic = Diagnostic::error(name.span, format!("unknown function `{shown}`"))
            .label("not a function");
        let functions = FUNCTIONS.iter().copied();
        let among = || advice(shown, functions, |all| format!("the functions are {all}"));
        diagnostic.help(elsewhere(shown).map_or_else(among, str::to_owned))
    }
}

/// The number of arguments of a function of the language. `hypot` is a square root in the graph.
fn arity(name: &str) -> Option<usize> {
    if name == "hypot" {
        return Some(2);
    }
    let function = Function::ALL.iter().find(|function| function.name() == name)?;
    FUNCTIONS.contains(&name).then(|| function.arity())
}

fn forward_reference(name: &str, span: Span, definition: Span) -> Diagnostic {
    // While a formula is resolved, its own definition is still announced.
    let own = span.source == definition.source && definition.end <= span.start;
    let message = if own {
        format!("`{name}` is defined by itself")
    } else {
        format!("`{name}` is used before it is defined")
    };
    let help = if own {
        "a definition may use only the names above it"
    } else {
        "definitions are read in order: move this one below"
    };
    Diagnostic::error(span, message).label("not defined yet").help(help)
}
