//! Assigns each formula of a file the dimension that it must have.

use std::collections::BTreeMap;

use super::dimension::Dimension;
use super::infer::{ExpectedDimension, Formulas, Measure};
use super::parse::Unit;
use super::system;
use crate::balance::{BalanceLaw, BalanceSpec};
use crate::check::CheckSpec;
use crate::diagnostic::Diagnostic;
use crate::domain::{BodySpec, DomainSpec};
use crate::field::FieldSpec;
use crate::formula::Formula;
use crate::material::MaterialSpec;
use crate::names::INVARIANTS;
use crate::rigid::RigidSpec;
use crate::source::{Sources, Spanned};
use crate::space::Space;
use crate::symbols::{LetSpec, ParameterSpec};
use crate::syntax::{self, Ast, NodeKind};

/// The consequence of a wrong density or modulus.
const FORCING: Option<&str> = Some("b = a - Div P/rho0 would not be an acceleration");

/// Checks the units of a field file and of its material file: each unit by itself, and, in a file whose parameters all have
/// one, the system that they form and the dimensions of all formulas.
///
/// Other phases report all other mistakes, and this check reports no consequences of them.
pub fn check(
    sources: &Sources,
    field: &FieldSpec,
    material: Option<&MaterialSpec>,
) -> Vec<Diagnostic> {
    let mut checker = Checker { sources, formulas: Formulas::default(), diagnostics: Vec::new() };
    let arguments = material.map(|material| checker.material(material)).unwrap_or_default();
    checker.field(field, &arguments);
    checker.diagnostics
}

/// The units of a file's parameters, as far as they could be read.
struct Units {
    /// The units in the order of the file.
    units: Vec<Option<Unit>>,
    /// Whether there are parameters, and all have a unit.
    complete: bool,
}

struct Checker<'a> {
    sources: &'a Sources,
    formulas: Formulas,
    diagnostics: Vec<Diagnostic>,
}

impl Checker<'_> {
    /// Reads the units of a file's parameters; `lost` says whether part of the file is missing.
    fn units<'a>(
        &mut self,
        texts: impl Iterator<Item = Option<&'a Spanned<String>>>,
        lost: bool,
    ) -> Units {
        let mut complete = !lost;
        let units: Vec<_> = texts
            .map(|text| {
                complete &= text.is_some();
                Unit::parse(self.sources, text?, &mut self.diagnostics)
            })
            .collect();
        complete &= !units.is_empty();
        if complete {
            self.diagnostics.extend(system::consistent(units.iter().flatten()));
        }
        Units { units, complete }
    }

    /// Checks a material file. Returns the dimensions of its parameters, if they are known.
    fn material(&mut self, material: &MaterialSpec) -> BTreeMap<String, Dimension> {
        let parameters = material.parameters.iter().map(|parameter| parameter.unit.as_ref());
        let givens = material.givens.iter().map(|given| given.unit.as_ref());
        let Units { units, complete } = self.units(parameters.chain(givens), material.incomplete);
        let known: BTreeMap<_, _> = (material.names().zip(units))
            .filter_map(|(name, unit)| Some((name.to_owned(), unit?.dimension)))
            .collect();
        if complete {
            self.formulas = Formulas::default();
            self.constants();
            for (name, _) in INVARIANTS {
                self.formulas.define(name, Some(Measure::of(Dimension::NONE)));
            }
            for (name, dimension) in &known {
                self.formulas.define(name, Some(Measure::of(dimension.clone())));
            }
            self.refuse(&material.refused);
            for given in &material.givens {
                let (name, rest) = (&given.name.value, given.rest.as_ref());
                let Some((dimension, rest)) = known.get(name).zip(rest) else { continue };
                let message = format!("the rest value of `{name}` does not have its unit");
                self.value(rest, dimension, message);
            }
            self.definitions(&material.lets);
            let energy = [&material.strain_energy];
            let message = "the strain-energy density must be an energy per volume";
            self.expect(energy, Dimension::stress(), message, FORCING);
        }
        known
    }

    fn field(&mut self, field: &FieldSpec, arguments: &BTreeMap<String, Dimension>) {
        let texts = field.parameters.iter().map(|parameter| parameter.unit.as_ref());
        let Units { units, complete } = self.units(texts, field.incomplete);
        if !complete {
            return;
        }
        self.formulas = Formulas::default();
        self.constants();
        for (parameter, unit) in field.parameters.iter().zip(&units) {
            self.parameter(parameter, unit.as_ref());
        }
        self.coordinates(field.space);
        self.refuse(&field.refused);
        self.definitions(&field.lets);
        self.givens(field);
        let message = "the displacement must be a length";
        self.expect(&field.displacement, Dimension::length(), message, None);
        self.material_use(field, arguments);
        for balance in &field.balances {
            self.balance(balance, field.space);
        }
        self.domain(&field.domain);
        for check in &field.checks {
            self.closed_form(check);
        }
        self.extremes(field, &units);
        if let Some(rigid) = &field.rigid {
            self.rigid(rigid);
        }
    }

    fn constants(&mut self) {
        self.formulas.define("pi", Some(Measure::of(Dimension::NONE)));
    }

    fn coordinates(&mut self, space: Space) {
        for name in space.axes().iter().take(space.coordinates()) {
            self.formulas.define(name, Some(Measure::of(Dimension::length())));
        }
        self.formulas.define("t", Some(Measure::of(Dimension::time())));
    }

    /// Marks names that a file would define and may not: their dimensions are unknown.
    fn refuse(&mut self, names: &[String]) {
        names.iter().for_each(|name| self.formulas.define(name, None));
    }

    /// Parses a formula; its syntax errors are reported elsewhere.
    fn parsed(&self, formula: &Formula) -> Option<Ast> {
        syntax::parse(formula, &mut Vec::new())
    }

    fn expect<'a>(
        &mut self,
        formulas: impl IntoIterator<Item = &'a Formula>,
        dimension: Dimension,
        message: impl Into<String>,
        consequence: Option<&str>,
    ) {
        let expected = ExpectedDimension { dimension, message: message.into(), consequence };
        for formula in formulas {
            let Some(ast) = self.parsed(formula) else { continue };
            self.formulas.expect(&ast, &expected, &mut self.diagnostics);
        }
    }

    fn parameter(&mut self, parameter: &ParameterSpec, unit: Option<&Unit>) {
        let name = &parameter.name.value;
        if let Some(unit) = unit {
            let message = format!("the value of `{name}` does not have its unit");
            self.value(&parameter.value, &unit.dimension, message);
            for bound in parameter.range.iter().flatten() {
                let message = format!("the range of `{name}` does not have its unit");
                self.value(bound, &unit.dimension, message);
            }
        }
        self.formulas.define(name, unit.map(|unit| Measure::of(unit.dimension.clone())));
    }

    /// Checks the value of a parameter: a number that has the unit, or a formula of the same dimension.
    fn value(&mut self, formula: &Formula, dimension: &Dimension, message: String) {
        let Some(ast) = self.parsed(formula) else { return };
        if !is_numeric(&ast) {
            let expected =
                ExpectedDimension { dimension: dimension.clone(), message, consequence: None };
            self.formulas.expect(&ast, &expected, &mut self.diagnostics);
        }
    }

    fn definitions(&mut self, definitions: &[LetSpec]) {
        for definition in definitions {
            let ast = self.parsed(&definition.value);
            let measure = ast.and_then(|ast| self.formulas.infer(&ast, &mut self.diagnostics));
            self.formulas.define(&definition.name.value, measure);
        }
    }

    fn material_use(&mut self, field: &FieldSpec, arguments: &BTreeMap<String, Dimension>) {
        let material = &field.material;
        let message = "the density must be a mass per volume";
        self.expect(&material.density, Dimension::density(), message, FORCING);
        for (name, formula) in material.arguments.iter().chain(&material.givens) {
            let Some(dimension) = arguments.get(&name.value) else { continue };
            let message = format!(
                "`{}` of `{}` must be in {dimension}",
                name.value,
                material.model.value.shown()
            );
            self.expect([formula], dimension.clone(), message, FORCING);
        }
        for (name, _) in &material.givens {
            let measure = arguments.get(&name.value).cloned().map(Measure::of);
            self.formulas.define(&name.value, measure);
        }
        let direction = material.fibre.iter().flatten();
        let message = "the direction of the fibres must be numbers without unit";
        self.expect(direction, Dimension::NONE, message, None);
    }

    /// Checks the file's own given fields: formulas with the dimensions of their units.
    fn givens(&mut self, field: &FieldSpec) {
        for given in &field.givens {
            let name = &given.name.value;
            let unit = given.unit.as_ref();
            let unit = unit.and_then(|unit| Unit::parse(self.sources, unit, &mut self.diagnostics));
            let measure = match unit {
                Some(unit) => {
                    let message = format!("the given field `{name}` does not have its unit");
                    self.expect([&given.value], unit.dimension.clone(), message, None);
                    Some(Measure::of(unit.dimension))
                }
                None => {
                    let ast = self.parsed(&given.value);
                    ast.and_then(|ast| self.formulas.infer(&ast, &mut self.diagnostics))
                }
            };
            self.formulas.define(name, measure);
        }
    }

    /// Checks the flux of a balance, which has the dimension of its storage times a velocity.
    fn balance(&mut self, balance: &BalanceSpec, space: Space) {
        let outer = self.formulas.clone();
        for formula in balance.formulas() {
            self.names_of_balances(formula, space);
        }
        match &balance.law {
            BalanceLaw::Flow { storage: Some(storage), flux: Some(flux) } => {
                if let Some(expected) = self.inferred(storage).and_then(|it| it.times(&velocity()))
                {
                    let name = &balance.name.value;
                    let message =
                        format!("the flux of `{name}` must be its storage times a velocity");
                    let consequence = "d(storage)/dt + Div(flux) would add different units";
                    self.expect(flux, expected, message, Some(consequence));
                }
            }
            _ => {
                for formula in balance.formulas() {
                    self.inferred(formula);
                }
            }
        }
        self.formulas = outer;
    }

    /// The dimension of a formula; none for a number 0 or a formula with a mistake.
    fn inferred(&mut self, formula: &Formula) -> Option<Dimension> {
        let ast = self.parsed(formula)?;
        self.formulas.infer(&ast, &mut self.diagnostics)?.dimension
    }

    /// Defines the names of the language of balances that a formula uses and the file does not define.
    fn names_of_balances(&mut self, formula: &Formula, space: Space) {
        let Some(ast) = self.parsed(formula) else { return };
        let is_direction = |by: &str| space.directions().contains(&by);
        for node in &ast.nodes {
            let NodeKind::Name(name) = &node.kind else { continue };
            if self.formulas.get(name).is_some() {
                continue;
            }
            let measure = match name.rsplit_once('_') {
                Some(("u", by)) if is_direction(by) => Some(Measure::of(Dimension::length())),
                Some(("v", by)) if is_direction(by) => Some(Measure::of(velocity())),
                Some((of, by)) => self.formulas.get(of).and_then(|measure| {
                    let by = match by {
                        "t" => Dimension::time(),
                        _ => Dimension::length(),
                    };
                    measure.dimension.as_ref()?.over(&by).map(Measure::of)
                }),
                None => Some(Measure::of(Dimension::NONE)),
            };
            let is_built_in = name == "J" || name.ends_with(|it: char| it.is_ascii_digit());
            if is_built_in || name.contains('_') {
                self.formulas.define(name, measure);
            }
        }
    }

    fn domain(&mut self, domain: &DomainSpec) {
        match &domain.body {
            BodySpec::Box { lower, upper } => {
                let message = "the corners of the box must be lengths";
                self.expect(lower.iter().chain(upper), Dimension::length(), message, None);
            }
            BodySpec::Round(round) => {
                let message = format!("the radii of the {} must be lengths", round.shape.name);
                let radii = round.inner.iter().chain([&round.outer]);
                self.expect(radii, Dimension::length(), message, None);
                let message = "the ends of the cylinder must be lengths";
                self.expect(round.z.iter().flatten(), Dimension::length(), message, None);
                let message = "an angle must be a number without unit";
                let angles = round.theta.iter().chain(&round.phi).flatten();
                self.expect(angles, Dimension::NONE, message, None);
            }
            BodySpec::Polygon(polygon) => {
                let message = "the vertices of the polygon must be lengths";
                let vertices = polygon.vertices.iter().flatten();
                self.expect(vertices, Dimension::length(), message, None);
            }
            BodySpec::Nothing => {}
        }
        let message = "the ends of the time window must be times";
        match domain.is_moved {
            false => self.expect(domain.time.iter().flatten(), Dimension::time(), message, None),
            true => {
                let time = domain.time.iter().flatten();
                time.for_each(|end| self.value(end, &Dimension::time(), message.into()));
            }
        }
    }

    fn closed_form(&mut self, check: &CheckSpec) {
        let outer = self.formulas.clone();
        self.definitions(&check.lets);
        let quantity = check.quantity.value;
        let message = format!("the closed form of `{}` must have its unit", quantity.name());
        if let Some(unit) = Unit::known(quantity.unit()) {
            self.expect(&check.equals, unit.dimension, message, None);
        }
        self.formulas = outer;
    }

    fn extremes(&mut self, field: &FieldSpec, units: &[Option<Unit>]) {
        for (name, formula) in field.extremes.iter().flat_map(|extreme| &extreme.set) {
            let parameter =
                field.parameters.iter().position(|known| known.name.value == name.value);
            let Some(unit) = parameter.and_then(|index| units[index].as_ref()) else { continue };
            let message = format!("the value of `{}` does not have its unit", name.value);
            self.value(formula, &unit.dimension, message);
        }
    }

    fn rigid(&mut self, rigid: &RigidSpec) {
        let message = "an angle must be a number without unit";
        self.expect(rigid.angle(), Dimension::NONE, message, None);
        let message = "the translation must be a length";
        self.expect(rigid.translation.iter().flatten(), Dimension::length(), message, None);
    }
}

fn velocity() -> Dimension {
    Dimension::mechanical([0, 1, -1])
}

/// Whether a formula has no names except pi: a number in any form.
fn is_numeric(ast: &Ast) -> bool {
    ast.nodes.iter().all(|node| !matches!(&node.kind, NodeKind::Name(name) if name != "pi"))
}
