//! A field file with resolved names: expressions instead of text.

mod domain;
pub mod energy;
pub mod given;
mod superposed;
mod written;

pub use superposed::{RigidMotion, Rotation};

use crate::invariant::InvariantKind;
use crate::meanings::Meanings;
use crate::region::Region;
use crate::resolve::Scope;
use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::foreign::Foreign;
use mms_spec::quantity::Quantity;
use mms_spec::source::{Span, Spanned};
use mms_spec::syntax;
use mms_spec::{FieldSpec, Formula, LetSpec, MaterialSpec, Space};
use mms_symbolic::expr::print::Names;
use mms_symbolic::expr::{Expr, Graph, Rational, Symbol};
use mms_symbolic::pass::substitute::substitute;

use energy::Givens;
pub use given::OwnQuantities;
use mms_symbolic::sorted::SortedMap;
use written::Read;
pub use written::{Part, Written};

/// A parameter of a field.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name of the parameter.
    pub name: String,
    /// The default value, in terms of the parameters before this one.
    pub default: Expr,
    /// The least and the greatest allowed value, in terms of the parameters before this one.
    pub range: Option<[Expr; 2]>,
    /// The unit, if the file states one.
    pub unit: Option<String>,
    /// The description.
    pub doc: Option<Foreign>,
}

/// The reference body, in terms of the parameters.
pub type Body = Region<Expr>;

impl Body {
    /// The coordinates of a reference position in which the body is a block: X itself, or radius and angles.
    pub fn coordinates(&self, reference: &[f64]) -> Vec<f64> {
        let Region::Block(block) = self else { return reference.to_vec() };
        let padded = std::array::from_fn(|axis| reference.get(axis).copied().unwrap_or(0.0));
        block.system.local(padded)[..reference.len()].to_vec()
    }
}

/// The body and the time window of a field's claims, in terms of the parameters.
#[derive(Clone, Debug)]
pub struct Domain {
    /// The reference body.
    pub body: Body,
    /// The first and last time; 0 and 1 for a static field, in which nothing depends on t.
    pub time: [Expr; 2],
    /// Whether the field is static: its file has no time window.
    pub is_static: bool,
}

/// A closed form that a quantity must agree with.
#[derive(Clone, Debug)]
pub struct Check {
    /// The quantity that the closed form is for.
    pub quantity: Quantity,
    /// The components.
    pub equals: Vec<Expr>,
    /// The publication.
    pub source: Option<Foreign>,
    /// The place in the file.
    pub span: Span,
}

/// A field with expressions for its formulas.
#[derive(Clone, Debug)]
pub struct Model {
    /// The parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// The names of symbols for readers: parameters and definitions.
    pub names: Names,
    /// The coordinates, and the numbers of components of vectors and tensors.
    pub space: Space,
    /// R of an axisymmetric field: the divisor in strains around the axis.
    pub radius: Option<Expr>,
    /// u, without the rigid motion. For an axisymmetric field it has three components, and includes the rigid motion.
    pub displacement: Vec<Expr>,
    /// rho0; 1 if the file has none.
    pub density: Expr,
    /// Whether the file has rho0.
    pub has_density: bool,
    /// The parameters of the material, in the field's terms and in the order of the file.
    pub arguments: Vec<Expr>,
    /// W, as a function of the material's invariants.
    pub energy: Expr,
    /// The invariants that W is a function of, and the direction of the fibres.
    pub kind: InvariantKind,
    /// a0 in space, if W is a function of I4.
    pub fibre: Option<Vec<Expr>>,
    /// Poisson's ratio, if the field states it instead of the material's own moduli.
    pub poisson: Option<Expr>,
    /// The reference body and the time window.
    pub domain: Domain,
    /// The given fields of the material, in the order of its file.
    pub givens: Vec<Expr>,
    /// W with each given field at its value in the state of rest.
    pub rest_energy: Expr,
    /// The quantities of given fields and of balances.
    pub own: OwnQuantities,
    /// Closed forms from paper.
    pub checks: Vec<Check>,
    /// The values of each extreme by position of the parameter, in terms of the parameters before it.
    pub extremes: Vec<SortedMap<usize, Expr>>,
    /// The rigid motion on top of u.
    pub rigid: Option<RigidMotion>,
    /// The formulas as written in the file.
    pub written: Written,
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
        let reported = diagnostics.len();
        let mut reader = Reader::new(graph, diagnostics, field.space);
        if field.incomplete {
            reader.scope.tolerate_unknown_names();
        }
        reader.scope.refuse(&field.refused);
        let mut names = reader.names();
        let parameters = reader.parameters(field, &mut names);
        reader.coordinates(field.is_static());
        reader.definitions(&field.lets, &mut names);
        let displacement = reader.formulas(&field.displacement);
        let density = match &field.material.density {
            Some(formula) => {
                let density = reader.formula(formula);
                reader.independent_of_time(density, formula, "density");
                reader.positive(density, formula);
                density
            }
            None => Some(reader.graph.number(1)),
        };
        let mut arguments = reader.arguments(field);
        let poisson = material.and_then(|material| reader.poisson(field, material, &mut arguments));
        reader.own_givens(field);
        let givens = material.map(|material| reader.givens(field, material)).unwrap_or_default();
        let energy = material.and_then(|material| {
            reader.energy(field, material, &arguments, Givens::Values(&givens))
        });
        let rest_energy = match material {
            Some(material) if !material.givens.is_empty() && energy.is_some() => {
                let of_energy = std::mem::take(&mut reader.of_energy);
                let rest = reader.energy(field, material, &arguments, Givens::Rest);
                reader.of_energy = of_energy;
                rest
            }
            _ => energy,
        };
        let fibre = reader.fibre(field, material);
        let kind = material.and_then(|material| reader.kind(field, material, fibre.as_deref()));
        let of_the_field = reader.read.len();
        let domain = reader.domain(&field.domain, field.dimension);
        let checks = field.checks.iter().map(|check| reader.check(check)).collect::<Vec<_>>();
        reader.read.truncate(of_the_field);
        let rigid = field.rigid.as_ref().map(|rigid| reader.rigid(rigid, field.dimension));
        let rigid = match rigid {
            Some(rigid) => rigid.map(Some),
            None => Some(None),
        };
        let (displacement, rigid) = match (displacement, rigid) {
            (Some(displacement), Some(rigid)) if field.space.is_axisymmetric() => {
                (Some(reader.around_the_axis(field, displacement, rigid.as_ref())), Some(None))
            }
            others => others,
        };
        let radius = reader.radius();
        let own = match (&displacement, &rigid) {
            (Some(displacement), Some(rigid)) => {
                reader.own(field, material, displacement, rigid.as_ref())
            }
            _ => None,
        };
        let written = reader.written();
        let extremes = reader.extremes(field);
        reader.check_stray_formulas(field);
        reader.within_bound(field, reported);
        Some(Model {
            parameters: parameters?,
            names,
            space: field.space,
            radius,
            displacement: displacement?,
            density: density?,
            has_density: field.material.density.is_some(),
            arguments: arguments.into_iter().collect::<Option<_>>()?,
            energy: energy?,
            kind: kind?,
            fibre: fibre.filter(|_| material.is_some_and(MaterialSpec::has_fibres)),
            poisson,
            domain: domain?,
            checks: checks.into_iter().collect::<Option<_>>()?,
            extremes,
            rigid: rigid?,
            givens: givens.into_iter().collect::<Option<_>>()?,
            rest_energy: rest_energy?,
            own: own?,
            written,
        })
    }
}

impl Model {
    /// All formulas that may depend on X.
    pub fn in_space(&self) -> Vec<Expr> {
        let fibre = self.fibre.iter().flatten();
        let direction = match &self.kind {
            InvariantKind::Fibrous(direction) => &direction[..],
            InvariantKind::Isotropic | InvariantKind::SmallStrain => &[],
        };
        let others = self.arguments.iter().chain(fibre).chain(direction).chain(&self.poisson);
        let own = self.givens.iter().chain(self.own.values().flatten());
        let scalars = [&self.density, &self.energy, &self.rest_energy];
        self.displacement
            .iter()
            .chain(scalars)
            .chain(&self.radius)
            .chain(others)
            .chain(own)
            .copied()
            .collect()
    }

    /// Replaces the formulas that may depend on X, the closed forms and the named definitions.
    pub fn map_formulas_of_x(&mut self, mut made: impl FnMut(&[Expr]) -> Vec<Expr>) {
        for exprs in [&mut self.displacement, &mut self.arguments, &mut self.givens] {
            *exprs = made(exprs);
        }
        for expr in [&mut self.density, &mut self.energy, &mut self.rest_energy] {
            *expr = made(&[*expr])[0];
        }
        for components in self.own.values_mut() {
            *components = made(components);
        }
        self.fibre = self.fibre.as_deref().map(&mut made);
        self.radius = self.radius.map(|radius| made(&[radius])[0]);
        self.poisson = self.poisson.map(|poisson| made(&[poisson])[0]);
        if let InvariantKind::Fibrous(direction) = &mut self.kind {
            *direction = made(direction);
        }
        for check in &mut self.checks {
            check.equals = made(&check.equals);
        }
        let names = std::mem::take(&mut self.names.expressions);
        let (exprs, texts): (Vec<Expr>, Vec<String>) = names.into_iter().unzip();
        self.names.expressions = made(&exprs).into_iter().zip(texts).collect();
    }
}

/// W of a field that has been resolved, for other values of the material's parameters and given fields.
pub fn energy_with(
    graph: &mut Graph,
    field: &FieldSpec,
    material: &MaterialSpec,
    arguments: &[Expr],
    givens: &[Expr],
) -> Option<Expr> {
    let mut diagnostics = Vec::new();
    let mut reader = Reader::new(graph, &mut diagnostics, field.space);
    let [arguments, givens] =
        [arguments, givens].map(|exprs| exprs.iter().copied().map(Some).collect::<Vec<_>>());
    reader.energy(field, material, &arguments, Givens::Values(&givens))
}

struct Reader<'a> {
    graph: &'a mut Graph,
    diagnostics: &'a mut Vec<Diagnostic>,
    scope: Scope,
    space: Space,
    /// The formulas so far: of the field, and of the density of its material.
    read: Vec<Read>,
    of_energy: Vec<Read>,
}

impl<'a> Reader<'a> {
    fn new(graph: &'a mut Graph, diagnostics: &'a mut Vec<Diagnostic>, space: Space) -> Self {
        let scope = Scope::default();
        Reader { graph, diagnostics, scope, space, read: Vec::new(), of_energy: Vec::new() }
    }
}

impl Reader<'_> {
    /// Names for printing that name the coordinates only.
    fn names(&self) -> Names {
        Names { coordinates: self.space.axes(), ..Names::default() }
    }

    /// R of an axisymmetric field.
    fn radius(&mut self) -> Option<Expr> {
        self.space.is_axisymmetric().then(|| self.graph.symbol(Symbol::Coordinate(0)))
    }

    fn formula(&mut self, formula: &Formula) -> Option<Expr> {
        let ast = syntax::parse(formula, self.diagnostics)?;
        let mut steps = Vec::new();
        let value = self.scope.resolve_in_steps(self.graph, &ast, self.diagnostics, &mut steps)?;
        self.read.push(Read::new(&ast, value, formula.span, steps));
        Some(value)
    }

    /// Resolves all formulas, so that each one reports its mistakes.
    fn formulas(&mut self, formulas: &[Formula]) -> Option<Vec<Expr>> {
        let values: Vec<_> = formulas.iter().map(|formula| self.formula(formula)).collect();
        values.into_iter().collect()
    }

    fn parameters(&mut self, field: &FieldSpec, names: &mut Names) -> Option<Vec<Parameter>> {
        let pi = self.graph.pi();
        self.scope.define("pi", Some(pi));
        for name in self.space.axes().iter().chain(&["t"]) {
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
            self.definition_of(name);
            let own = self.read.len();
            let range = parameter.range.as_ref().and_then(|range| {
                let [least, greatest] = range.each_ref().map(|bound| self.formula(bound));
                Some([least?, greatest?])
            });
            self.read.truncate(own);
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

    fn coordinates(&mut self, is_static: bool) {
        let dimension = self.space.coordinates();
        if self.space.is_axisymmetric() {
            for name in ["X", "Y"] {
                self.scope.withhold(name, "this field is axisymmetric: use R and Z");
            }
        }
        for (axis, name) in self.space.axes().iter().enumerate() {
            if axis < dimension {
                let coordinate = self.graph.symbol(Symbol::Coordinate(axis));
                self.scope.define(name, Some(coordinate));
            } else {
                let plural = if dimension == 1 { "dimension" } else { "dimensions" };
                self.scope.withhold(name, format!("the field has {dimension} {plural}"));
            }
        }
        if is_static {
            self.scope.withhold("t", "the field is static: give `time` under [domain] if it moves");
            return;
        }
        let time = self.graph.symbol(Symbol::Time);
        self.scope.define("t", Some(time));
    }

    fn definitions(&mut self, definitions: &[LetSpec], names: &mut Names) {
        for definition in definitions {
            let value = self.formula(&definition.value);
            self.definition_of(&definition.name.value);
            self.scope.define(&definition.name.value, value);
            // A definition that is only another name for a leaf or a number adds no name.
            if let Some(value) =
                value.filter(|value| self.graph.node(*value).children().next().is_some())
            {
                names.expressions.get_or_insert_with(value, || definition.name.value.clone());
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

    /// The values that extremes set.
    fn extremes(&mut self, field: &FieldSpec) -> Vec<SortedMap<usize, Expr>> {
        let names = field.parameters.iter().enumerate();
        let places: SortedMap<&str, usize> =
            names.map(|(index, parameter)| (parameter.name.value.as_str(), index)).collect();
        let mut setting = |(name, value): &(Spanned<String>, Formula)| {
            let index = *places.get(name.value.as_str())?;
            Some((index, self.setting(index, name, value)?))
        };
        let extremes = field.extremes.iter();
        extremes.map(|extreme| extreme.set.iter().filter_map(&mut setting).collect()).collect()
    }

    /// The value that an extreme sets for a parameter: like a default, it may use the parameters above.
    fn setting(&mut self, index: usize, name: &Spanned<String>, value: &Formula) -> Option<Expr> {
        let set = self.constant(value)?;
        let is_above = |symbol: &Symbol| matches!(symbol, Symbol::Parameter(at) if *at < index);
        if self.graph.symbols(set).iter().all(is_above) {
            return Some(set);
        }
        let message =
            format!("the value of {} may only use the parameters above it", quoted(&name.value));
        self.diagnostics.push(
            Diagnostic::error(value.span, message)
                .label("expected numbers, and parameters above that one in [parameters]")
                .help("definitions that are made of this parameter, or of later ones, cannot be used here"),
        );
        None
    }

    /// Parses formulas of keys that were refused, and reports their mistakes.
    fn check_stray_formulas(&mut self, field: &FieldSpec) {
        for stray in &field.stray {
            syntax::parse(stray, self.diagnostics);
        }
    }

    /// Reports a full graph if no formula was reported for it.
    fn within_bound(&mut self, field: &FieldSpec, reported: usize) {
        if !self.graph.is_exhausted() || self.diagnostics.len() > reported {
            return;
        }
        let first = field.displacement.first();
        let span = first.map_or(field.material.span, |formula| formula.span);
        let diagnostic = Diagnostic::error(span, "the formulas of this field are too large");
        let help = self.graph.exhaustion();
        self.diagnostics.push(Diagnostic { help, ..diagnostic.label("with what they use") });
    }

    fn check(&mut self, check: &mms_spec::CheckSpec) -> Option<Check> {
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

/// Converts set values to expressions.
pub fn set_expressions(
    graph: &mut Graph,
    set: &SortedMap<usize, Rational>,
) -> SortedMap<usize, Expr> {
    set.iter().map(|(index, value)| (*index, graph.number(value.clone()))).collect()
}

/// The parameters' values as constants, some of them set by the caller in terms of earlier ones.
pub fn parameter_values(
    graph: &mut Graph,
    model: &Model,
    set: &SortedMap<usize, Expr>,
) -> Vec<Expr> {
    let mut known = SortedMap::new();
    for (index, parameter) in model.parameters.iter().enumerate() {
        let value = *set.get(&index).unwrap_or(&parameter.default);
        let value = substitute(graph, &[value], &known)[0];
        known.insert(Symbol::Parameter(index), value);
    }
    known.into_values().collect()
}

fn is_parameter(symbol: &Symbol) -> bool {
    matches!(symbol, Symbol::Parameter(_))
}
