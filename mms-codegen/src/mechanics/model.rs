//! A field file with its names resolved: expressions instead of text.

use crate::diagnostic::Diagnostic;
use crate::expr::print::Names;
use crate::expr::resolve::Scope;
use crate::expr::{Expr, Graph, Rational, Symbol};
use crate::quantity::Quantity;
use crate::selection::Meanings;
use crate::source::{Span, Spanned};
use crate::spec::{self, FieldSpec, Formula, LetSpec, MaterialSpec};
use crate::suggest::did_you_mean;
use crate::syntax;

const AXES: [&str; 3] = ["X", "Y", "Z"];

/// A parameter of a field.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its default value, in terms of the parameters before it.
    pub default: Expr,
    /// The least and the greatest value it may take, in terms of the parameters before it.
    pub range: Option<[Expr; 2]>,
    /// Its unit, where the file states one.
    pub unit: Option<String>,
    /// What it is.
    pub doc: Option<String>,
}

/// The reference body.
#[derive(Clone, Debug)]
pub enum Body {
    /// A box with edges along the axes.
    Box {
        /// The least coordinates.
        lower: Vec<Expr>,
        /// The greatest coordinates.
        upper: Vec<Expr>,
    },
    /// A plane ring, or a sector of it, about the origin.
    Annulus {
        /// The inner radius.
        inner: Expr,
        /// The outer radius.
        outer: Expr,
        /// The first and last angle.
        theta: [Expr; 2],
    },
}

impl Body {
    /// The coordinates between whose bounds the body is a box: X itself, or radius and angle.
    pub fn coordinates(&self, reference: &[f64]) -> Vec<f64> {
        match (self, reference) {
            (Body::Annulus { .. }, [x, y]) => vec![x.hypot(*y), y.atan2(*x)],
            _ => reference.to_vec(),
        }
    }
}

/// The body and the time window that a field's claims are about, in terms of the parameters.
#[derive(Clone, Debug)]
pub struct Domain {
    /// The reference body.
    pub body: Body,
    /// The first and last time.
    pub time: [Expr; 2],
}

/// A closed form that a quantity must agree with.
#[derive(Clone, Debug)]
pub struct Check {
    /// What it is a closed form of.
    pub quantity: Quantity,
    /// Its components.
    pub equals: Vec<Expr>,
    /// Where it was published.
    pub source: Option<String>,
    /// Where it stands in the file.
    pub span: Span,
}

/// A field whose formulas are expressions.
#[derive(Clone, Debug)]
pub struct Model {
    /// The parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// The names a reader knows: parameters and definitions.
    pub names: Names,
    /// u.
    pub displacement: Vec<Expr>,
    /// rho0.
    pub density: Expr,
    /// W, as a function of the material's invariants.
    pub energy: Expr,
    /// The reference body and the time window.
    pub domain: Domain,
    /// Closed forms from paper.
    pub checks: Vec<Check>,
}

impl Model {
    /// Resolves all formulas of a field and of its material. Reports every mistake, and returns
    /// `None` if there was one.
    pub fn resolve(
        graph: &mut Graph,
        field: &FieldSpec,
        material: Option<&MaterialSpec>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Model> {
        let mut reader = Reader { graph, diagnostics, scope: Scope::default() };
        if field.incomplete {
            reader.scope.tolerate_unknown_names();
        }
        let mut names = Names::default();
        let parameters = reader.parameters(field, &mut names);
        reader.coordinates(field.dimension);
        reader.definitions(&field.lets, &mut names);
        let displacement = reader.formulas(&field.displacement);
        let density = reader.formula(&field.material.density);
        reader.independent_of_time(density, &field.material.density, "density");
        reader.positive(density, &field.material.density);
        let arguments = reader.arguments(field);
        let energy = material.and_then(|material| reader.energy(field, material, &arguments));
        let domain = reader.domain(&field.domain);
        let checks = field.checks.iter().map(|check| reader.check(check)).collect::<Vec<_>>();
        reader.variations(field);
        Some(Model {
            parameters: parameters?,
            names,
            displacement: displacement?,
            density: density?,
            energy: energy?,
            domain: domain?,
            checks: checks.into_iter().collect::<Option<_>>()?,
        })
    }
}

struct Reader<'a> {
    graph: &'a mut Graph,
    diagnostics: &'a mut Vec<Diagnostic>,
    scope: Scope,
}

impl Reader<'_> {
    fn formula(&mut self, formula: &Formula) -> Option<Expr> {
        let ast = syntax::parse(formula, self.diagnostics)?;
        self.scope.resolve(self.graph, &ast, self.diagnostics)
    }

    /// Resolves all, so that every one reports its mistakes.
    fn formulas(&mut self, formulas: &[Formula]) -> Option<Vec<Expr>> {
        let values: Vec<_> = formulas.iter().map(|formula| self.formula(formula)).collect();
        values.into_iter().collect()
    }

    fn parameters(&mut self, field: &FieldSpec, names: &mut Names) -> Option<Vec<Parameter>> {
        let pi = self.graph.pi();
        self.scope.define("pi", Some(pi));
        for name in AXES.iter().chain(&["t"]) {
            self.scope.withhold(name, "parameters are constants");
        }
        for parameter in &field.parameters {
            self.scope.announce(&parameter.name);
        }
        for definition in &field.lets {
            self.scope.announce(&definition.name);
        }
        let mut parameters = Vec::new();
        let mut meanings = Meanings::default();
        for (index, parameter) in field.parameters.iter().enumerate() {
            let name = &parameter.name.value;
            let default = self.formula(&parameter.value);
            let range = parameter.range.as_ref().and_then(|range| {
                let [least, greatest] = range.each_ref().map(|bound| self.formula(bound));
                Some([least?, greatest?])
            });
            let symbol = Symbol::Parameter(index);
            if default.is_some_and(|value| self.scope.is_positive(self.graph, value)) {
                self.scope.assume_positive(symbol);
            }
            let meaning = meanings.next(self.graph, parameter, default);
            self.scope.define(name, meaning);
            let default = if parameter.frozen { meaning } else { default };
            names.parameters.push(name.clone());
            parameters.push(default.map(|default| Parameter {
                name: name.clone(),
                default,
                range,
                unit: parameter.unit.as_ref().map(|unit| unit.value.clone()),
                doc: parameter.doc.clone(),
            }));
        }
        parameters.into_iter().collect()
    }

    fn coordinates(&mut self, dimension: usize) {
        for (axis, name) in AXES.iter().enumerate() {
            if axis < dimension {
                let coordinate = self.graph.symbol(Symbol::Coordinate(axis));
                self.scope.define(name, Some(coordinate));
            } else {
                let plural = if dimension == 1 { "dimension" } else { "dimensions" };
                self.scope.withhold(name, format!("the field has {dimension} {plural}"));
            }
        }
        let time = self.graph.symbol(Symbol::Time);
        self.scope.define("t", Some(time));
    }

    fn definitions(&mut self, definitions: &[LetSpec], names: &mut Names) {
        for definition in definitions {
            let value = self.formula(&definition.value);
            self.scope.define(&definition.name.value, value);
            // A definition that is only another name for a leaf or a number names nothing new.
            if let Some(value) =
                value.filter(|value| self.graph.node(*value).children().next().is_some())
            {
                names.expressions.entry(value).or_insert_with(|| definition.name.value.clone());
            }
        }
    }

    fn positive(&mut self, density: Option<Expr>, formula: &Formula) {
        let number = density.and_then(|density| self.graph.as_number(density));
        if let Some(number) = number.filter(|number| **number <= Rational::ZERO) {
            let label = format!("this is {number}");
            self.diagnostics.push(
                Diagnostic::error(formula.span, "the density must be positive")
                    .label(label)
                    .help("the body force is per unit mass: b = a - Div P/rho0"),
            );
        }
    }

    fn independent_of_time(&mut self, value: Option<Expr>, formula: &Formula, what: &str) {
        let Some(value) = value else { return };
        if self.graph.symbols(value).contains(&Symbol::Time) {
            self.diagnostics.push(
                Diagnostic::error(formula.span, format!("{what} depends on time"))
                    .label("expected parameters and reference coordinates only")
                    .help("the mass and the elastic law of a material point do not change"),
            );
        }
    }

    /// The arguments of the material, in the field's terms.
    fn arguments(&mut self, field: &FieldSpec) -> Vec<Option<Expr>> {
        let arguments = field.material.arguments.iter();
        arguments
            .map(|(name, formula)| {
                let value = self.formula(formula);
                let what = format!("material parameter `{}`", name.value);
                self.independent_of_time(value, formula, &what);
                value
            })
            .collect()
    }

    /// The density of the material, in terms of the invariants and of the arguments.
    fn energy(
        &mut self,
        field: &FieldSpec,
        material: &MaterialSpec,
        arguments: &[Option<Expr>],
    ) -> Option<Expr> {
        let mut inner = Scope::default();
        if material.incomplete {
            inner.tolerate_unknown_names();
        }
        let pi = self.graph.pi();
        inner.define("pi", Some(pi));
        self.invariants(&mut inner);
        let known: Vec<&str> =
            material.parameters.iter().map(|parameter| parameter.name.value.as_str()).collect();
        let mut complete = true;
        for ((name, _), value) in field.material.arguments.iter().zip(arguments) {
            complete &= value.is_some();
            if known.contains(&name.value.as_str()) {
                inner.define(&name.value, *value);
            } else if !material.incomplete {
                complete = false;
                self.unknown_argument(field, name, &known);
            }
        }
        for parameter in &material.parameters {
            let name = &parameter.name.value;
            if field.material.arguments.iter().any(|(given, _)| given.value == *name) {
                continue;
            }
            complete = false;
            inner.define(name, None);
            if field.incomplete {
                continue;
            }
            let model = &field.material.model;
            let what = parameter.doc.as_deref().unwrap_or("no description");
            let message = format!("material parameter `{name}` of `{}` is missing", model.value);
            self.diagnostics.push(
                Diagnostic::error(model.span, message)
                    .label(format!("needs `{name}`: {what}"))
                    .help(format!("add `{name} = \"...\"` under [material]")),
            );
        }
        let outer = std::mem::replace(&mut self.scope, inner);
        for definition in &material.lets {
            self.scope.announce(&definition.name);
        }
        self.definitions(&material.lets, &mut Names::default());
        let energy = self.formula(&material.strain_energy);
        for stray in &material.stray {
            syntax::parse(stray, self.diagnostics);
        }
        self.scope = outer;
        energy.filter(|_| complete)
    }

    fn unknown_argument(&mut self, field: &FieldSpec, name: &Spanned<String>, known: &[&str]) {
        let model = &field.material.model.value;
        let message = format!("`{}` is not a parameter of `{model}`", name.value);
        let diagnostic = Diagnostic::error(name.span, message).label("unknown parameter");
        self.diagnostics.push(match did_you_mean(&name.value, known.iter().copied()) {
            Some(near) => diagnostic.help(format!("did you mean `{near}`?")),
            None => diagnostic.help(format!("its parameters are {}", known.join(", "))),
        });
    }

    /// I1, I2, I3 and J in terms of their departures from the undeformed state.
    fn invariants(&mut self, scope: &mut Scope) {
        use super::material::{FIRST, SECOND, VOLUME};
        for (name, symbol, at_identity) in [("I1", FIRST, 3), ("I2", SECOND, 3), ("J", VOLUME, 1)] {
            let (shift, constant) = (self.graph.symbol(symbol), self.graph.number(at_identity));
            let invariant = self.graph.add(constant, shift);
            scope.define(name, Some(invariant));
            if name == "J" {
                let square = self.graph.power(invariant, 2);
                scope.define("I3", Some(square));
            }
        }
        for name in ["I4", "eps_trace", "eps_squared"] {
            scope.withhold(name, "densities are functions of I1, I2, I3 and J");
        }
        for name in AXES.iter().chain(&["t"]) {
            scope.withhold(name, "a material knows no place and no time; a field's parameters may");
        }
    }

    fn domain(&mut self, domain: &spec::DomainSpec) -> Option<Domain> {
        // Everything is resolved before anything may be missing: each formula reports its mistakes.
        let [first, last] = domain.time.each_ref().map(|time| self.constant(time));
        let body = self.body(&domain.body)?;
        Some(Domain { body, time: [first?, last?] })
    }

    fn body(&mut self, body: &spec::Body) -> Option<Body> {
        match body {
            spec::Body::Box { lower, upper } => {
                let (lower, upper) = (self.constants(lower), self.constants(upper));
                Some(Body::Box { lower: lower?, upper: upper? })
            }
            spec::Body::Annulus { inner, outer, theta } => {
                let (inner, outer) = (self.constant(inner), self.constant(outer));
                let [first, last] = match theta {
                    Some(theta) => theta.each_ref().map(|angle| self.constant(angle)),
                    None => {
                        let pi = self.graph.pi();
                        [Some(self.graph.number(0)), Some(self.graph.scale(pi, 2))]
                    }
                };
                Some(Body::Annulus { inner: inner?, outer: outer?, theta: [first?, last?] })
            }
        }
    }

    fn constants(&mut self, formulas: &[Formula]) -> Option<Vec<Expr>> {
        let values: Vec<_> = formulas.iter().map(|formula| self.constant(formula)).collect();
        values.into_iter().collect()
    }

    /// A formula that only parameters may enter.
    fn constant(&mut self, formula: &Formula) -> Option<Expr> {
        let value = self.formula(formula)?;
        let symbols = self.graph.symbols(value);
        let intruder = symbols.into_iter().find(|symbol| !matches!(symbol, Symbol::Parameter(_)));
        let Some(intruder) = intruder else { return Some(value) };
        let name = Names::default().symbol(intruder);
        self.diagnostics.push(
            Diagnostic::error(formula.span, "the domain must be fixed")
                .label(format!("depends on {name}"))
                .help("use parameters, and definitions that contain no X, Y, Z or t"),
        );
        None
    }

    /// Formulas that no quantity depends on: a fibre, extremes, a rigid motion, and those of keys that were
    /// refused.
    fn variations(&mut self, field: &FieldSpec) {
        self.formulas(field.material.fibre.as_deref().unwrap_or_default());
        for (_, value) in field.extremes.iter().flat_map(|extreme| &extreme.set) {
            self.constant(value);
        }
        if let Some(rigid) = &field.rigid {
            let rotation = match &rigid.rotation {
                Some(spec::Rotation::Plane(angle)) => vec![angle],
                Some(spec::Rotation::Space { axis, angle }) => axis.iter().chain([angle]).collect(),
                None => Vec::new(),
            };
            for formula in rotation.into_iter().chain(rigid.translation.iter().flatten()) {
                self.formula(formula);
            }
            let message = "rigid motions are read, but not yet composed with the field";
            let diagnostic = Diagnostic::error(rigid.span, message);
            self.diagnostics.push(
                diagnostic.label("would be left out of every quantity").help("remove [rigid]"),
            );
        }
        for stray in &field.stray {
            syntax::parse(stray, self.diagnostics);
        }
    }

    fn check(&mut self, check: &spec::CheckSpec) -> Option<Check> {
        let outer = self.scope.clone();
        for definition in &check.lets {
            self.scope.announce(&definition.name);
        }
        self.definitions(&check.lets, &mut Names::default());
        let equals = self.formulas(&check.equals);
        self.scope = outer;
        Some(Check {
            quantity: check.quantity.value,
            equals: equals?,
            source: check.source.clone(),
            span: check.equals.first().map_or(check.quantity.span, |formula| formula.span),
        })
    }
}
