//! The density of a material in a field's terms: its arguments, the invariants, the fibres.

use super::Reader;
use crate::invariant::{INVARIANTS, InvariantKind, VOLUME};
use crate::resolve::Scope;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::foreign::Foreign;
use mms_spec::language::{elsewhere, modulus};
use mms_spec::moduli::{ENGINEERING, MODULI};
use mms_spec::source::Spanned;
use mms_spec::suggest::advice;
use mms_spec::syntax;
use mms_spec::{FieldSpec, MaterialSpec, Space};
use mms_symbolic::expr::print::Names;
use mms_symbolic::expr::{Expr, HALF, Rational};

/// The condition on Poisson's ratio.
pub const POISSON: &str = "Poisson's ratio must lie between -1 and 1/2";
/// The advice for a ratio of 1/2.
pub const INCOMPRESSIBLE: &str = "a solid that is nearly incompressible has a ratio such as 0.4999";

/// The given fields with which a density is read.
#[derive(Clone, Copy)]
pub(super) enum Givens<'a> {
    /// Given values, in the order of the material's file.
    Values(&'a [Option<Expr>]),
    /// The values of the given fields in the state of rest.
    Rest,
}

impl Reader<'_> {
    /// The arguments of the material, in the field's terms.
    pub(super) fn arguments(&mut self, field: &FieldSpec) -> Vec<Option<Expr>> {
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
    pub(super) fn energy(
        &mut self,
        field: &FieldSpec,
        material: &MaterialSpec,
        arguments: &[Option<Expr>],
        givens: Givens<'_>,
    ) -> Option<Expr> {
        let mut inner = Scope::default();
        if material.incomplete {
            inner.tolerate_unknown_names();
        }
        let pi = self.graph.pi();
        inner.define("pi", Some(pi));
        self.invariants(&mut inner);
        let known: Vec<&str> = material.names().collect();
        let mut complete = true;
        for ((name, _), value) in field.material.arguments.iter().zip(arguments) {
            complete &= value.is_some();
            if known.contains(&name.value.as_str()) {
                inner.define(&name.value, *value);
            } else if !material.incomplete && !material.refused.contains(&name.value) {
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
            if !field.incomplete && !material.incomplete {
                self.missing(field, "material parameter", name, parameter.doc.as_ref());
            }
        }
        inner.refuse(&material.refused);
        let outer = std::mem::replace(&mut self.scope, inner);
        let of_the_field = std::mem::take(&mut self.read);
        let values = match givens {
            Givens::Values(values) => values.to_vec(),
            Givens::Rest => self.rest(material),
        };
        for (given, value) in material.givens.iter().zip(values) {
            complete &= value.is_some();
            self.scope.define(&given.name.value, value);
        }
        for definition in &material.lets {
            self.scope.announce(&definition.name);
        }
        self.definitions(&material.lets, &mut Names::default());
        let energy = self.formula(&material.strain_energy);
        for stray in &material.stray {
            syntax::parse(stray, self.diagnostics);
        }
        self.scope = outer;
        self.of_energy = std::mem::replace(&mut self.read, of_the_field);
        energy.filter(|_| complete)
    }

    /// The given fields in the state of rest, in terms of the arguments.
    fn rest(&mut self, material: &MaterialSpec) -> Vec<Option<Expr>> {
        let mut values = Vec::new();
        for given in &material.givens {
            values.push(match &given.rest {
                Some(formula) => self.formula(formula),
                None => Some(self.graph.number(0)),
            });
        }
        values
    }

    /// Reports a parameter or a given field of the material that the field does not set.
    pub(super) fn missing(
        &mut self,
        field: &FieldSpec,
        kind: &str,
        name: &str,
        doc: Option<&Foreign>,
    ) {
        let model = &field.material.model;
        let what = doc.map(Foreign::shown);
        let what = what.as_deref().unwrap_or("no description");
        let message = format!("{kind} `{name}` of `{}` is missing", model.value.shown());
        self.diagnostics.push(
            Diagnostic::error(model.span, message)
                .label(format!("needs `{name}`: {what}"))
                .help(format!("add `{name} = \"...\"` under [material]")),
        );
    }

    fn unknown_argument(&mut self, field: &FieldSpec, name: &Spanned<String>, known: &[&str]) {
        let model = field.material.model.value.shown();
        let message = format!("`{}` is not a parameter of `{model}`", name.value);
        let diagnostic = Diagnostic::error(name.span, message).label("unknown parameter");
        let among = || {
            advice(&name.value, known.iter().copied(), |all| match all {
                "" => "it has none: a material file lists them in [parameters]".into(),
                _ => format!("its parameters are {all}"),
            })
        };
        let has_moduli = known.is_empty() || MODULI.iter().any(|it| known.contains(it));
        let of_modulus = modulus(&name.value).filter(|_| has_moduli);
        let help = of_modulus.or_else(|| elsewhere(&name.value)).map_or_else(among, str::to_owned);
        self.diagnostics.push(diagnostic.help(help));
    }

    /// The invariants in terms of their departures from the undeformed state.
    fn invariants(&mut self, scope: &mut Scope) {
        for invariant in &INVARIANTS {
            let value = invariant.value(self.graph);
            scope.define(invariant.name, Some(value));
            if invariant.symbol == VOLUME {
                let square = self.graph.power(value, 2);
                scope.define("I3", Some(square));
            }
        }
        for name in ["X", "Y", "Z", "t"] {
            scope.withhold(
                name,
                "a material does not depend on place or time; a field's parameters may",
            );
        }
    }

    /// The direction of the fibres, in the field's terms.
    pub(super) fn fibre(
        &mut self,
        field: &FieldSpec,
        material: Option<&MaterialSpec>,
    ) -> Option<Vec<Expr>> {
        let formulas = field.material.fibre.as_ref()?;
        let what = "the direction of the fibres";
        let direction = self.formulas(formulas);
        for (axis, formula) in formulas.iter().enumerate() {
            let component = direction.as_ref().map(|direction| direction[axis]);
            self.independent_of_time(component, formula, what);
        }
        if let (Some(direction), Space::Axisymmetric { swirl: false }) = (&direction, self.space) {
            let is_absent = |axis: usize| self.graph.is_zero(direction[axis]);
            let leans = !(is_absent(0) && is_absent(1));
            if leans && !is_absent(2) {
                self.diagnostics.push(
                    Diagnostic::error(formulas[2].span, "these fibres twist the body")
                        .label("they run around the axis, and lean")
                        .help("give a `swirl` under [displacement], if only 0, so that b has its component along the hoop"),
                );
            }
        }
        let (material, first) = (material?, formulas.first()?);
        if !material.has_fibres() && !material.incomplete {
            let message = format!("`{}` has no fibres", field.material.model.value.shown());
            self.diagnostics.push(
                Diagnostic::error(first.span, message)
                    .label("its density is no function of I4")
                    .help("remove `fibre`, or choose a material that uses I4"),
            );
        }
        direction
    }

    /// The kind of invariants that the density uses. Reports invariants that exclude each other, and fibres without a
    /// direction.
    pub(super) fn kind(
        &mut self,
        field: &FieldSpec,
        material: &MaterialSpec,
        fibre: Option<&[Expr]>,
    ) -> Option<InvariantKind> {
        let small = material.small_strain();
        let large = material.first_use(&["I1", "I2", "I3", "J", "I4"]);
        match (small, large) {
            (Some(small), Some(large)) => {
                let label = format!("of the small strain, and `{}` of F", large.value);
                let message = format!("`{}` and `{}` do not go together", small.value, large.value);
                self.diagnostics.push(
                    Diagnostic::error(small.span, message)
                        .label(label)
                        .help("write W in eps_trace and eps_squared, or in I1, I2, I3, I4 and J"),
                );
                None
            }
            (Some(small), None) => {
                if let Some(claim) = material.claims_indifference {
                    let message = "this material is not frame-indifferent";
                    self.diagnostics.push(
                        Diagnostic::error(claim, message)
                            .label(format!("a rotation changes `{}`, and W with it", small.value))
                            .help("remove this key, or write W in I1, I2, I3, I4 and J"),
                    );
                }
                Some(InvariantKind::SmallStrain)
            }
            (None, _) if !material.has_fibres() => Some(InvariantKind::Isotropic),
            (None, _) => {
                if field.material.fibre.is_none() && !field.incomplete {
                    let model = &field.material.model;
                    let message =
                        format!("`{}` needs the direction of its fibres", model.value.shown());
                    self.diagnostics.push(
                        Diagnostic::error(model.span, message)
                            .label("its density is a function of I4")
                            .help(
                                "add `fibre = [1, 0, 0]`, a unit vector in space, under [material]",
                            ),
                    );
                }
                fibre.map(|fibre| InvariantKind::Fibrous(fibre[..self.space.rows()].to_vec()))
            }
        }
    }

    /// Poisson's ratio, if the moduli of the material are made of it. A number that makes no moduli is reported, and removed
    /// from the arguments.
    pub(super) fn poisson(
        &mut self,
        field: &FieldSpec,
        material: &MaterialSpec,
        arguments: &mut [Option<Expr>],
    ) -> Option<Expr> {
        material.moduli.filter(|pair| *pair == ENGINEERING)?;
        let index = field.material.arguments.iter().position(|(name, _)| name.value == "nu")?;
        let (_, formula) = &field.material.arguments[index];
        let number = arguments[index].and_then(|value| self.graph.as_number(value));
        if let Some(number) = number.filter(|it| **it <= Rational::NEG_ONE || **it >= HALF) {
            let label = format!("this is {number}");
            self.diagnostics
                .push(Diagnostic::error(formula.span, POISSON).label(label).help(INCOMPRESSIBLE));
            arguments[index] = None;
        }
        arguments[index]
    }
}
