//! `[[check]]` and `[[extreme]]`: closed forms from paper, and parameters at their limits.

use crate::diagnostic::{Diagnostic, quoted};
use crate::foreign::Foreign;
use crate::formula::Formula;
use crate::names::Names;
use crate::own::Own;
use crate::quantity::Quantity;
use crate::source::{Span, Spanned};
use crate::space::Space;
use crate::suggest::advice;
use crate::symbols::{LetSpec, lets};
use crate::table::{Reader, Table, list};
use crate::value::{plural, unknown_word};

/// The names of the extremes at which every field is evaluated; a field's own extremes have other names.
pub const REGIMES: &[&str] = &[
    "declared",
    "displacement_1e-4",
    "displacement_1e-8",
    "displacement_1e-12",
    "displacement_1e-15",
    "jacobian_1e-3",
    "jacobian_1e-6",
    "jacobian_1e3",
    "lambda_mu_1e8",
    "lambda_mu_0",
    "moduli_1e-9",
    "moduli_1e9",
    "lengths_1e-9",
    "lengths_1e9",
    "origin_1e6",
    "time_1e6",
    "subnormal_inputs",
    "largest_inputs",
    "subnormal_amplitude",
    "largest_amplitude",
];

/// A closed form that a quantity must equal.
#[derive(Clone, Debug)]
pub struct CheckSpec {
    /// The quantity.
    pub quantity: Spanned<Quantity>,
    /// The components, row-major.
    pub equals: Vec<Formula>,
    /// The names that only this check defines.
    pub lets: Vec<LetSpec>,
    /// The source of the closed form.
    pub source: Option<Foreign>,
}

/// A set of parameters at which evaluation is tested, named after its extreme property.
#[derive(Clone, Debug)]
pub struct ExtremeSpec {
    /// The name.
    pub name: Spanned<Foreign>,
    /// The parameters that differ from their defaults, in the order of the file.
    pub set: Vec<(Spanned<String>, Formula)>,
    /// The table.
    pub span: Span,
}

/// Reads one `[[check]]`; `field` has the names that the field defines.
pub(super) fn check<'a>(
    table: &Table<'a>,
    (space, own): (Space, [&[Own]; 2]),
    field: &Names,
    reader: &mut Reader<'a>,
) -> Option<CheckSpec> {
    let lets = match table.get("let") {
        Some(entry) => reader
            .open_table(&entry, "the check's `let`")
            .map(|names| lets(&names, &mut field.clone(), reader)),
        None => None,
    };
    let lets = lets.unwrap_or_default();
    let quantity = quantity(table, own, reader);
    let source = reader.optional_foreign(table, "source");
    let equals = reader.required(table, "equals");
    let Some(quantity) = quantity else {
        reader.stray.extend(lets.into_iter().map(|definition| definition.value));
        if let Some(equals) = equals {
            reader.keep_strays(&equals);
        }
        return None;
    };
    let count = space.components(quantity.value.shape());
    let name = quantity.value.name();
    let reason = match space {
        Space::Cartesian(_) => {
            format!("`{name}` has {} in {}", plural(count, "component"), space.noun())
        }
        Space::Axisymmetric { .. } => {
            format!("`{name}` of this field has {}", plural(count, "component"))
        }
    };
    let equals = match equals {
        Some(equals) => reader.formulas(&equals, count, &reason),
        None => vec![Formula::reported(table.span); count],
    };
    Some(CheckSpec { quantity, equals, lets, source })
}

fn quantity<'a>(
    table: &Table<'a>,
    [possible, known]: [&[Own]; 2],
    reader: &mut Reader<'a>,
) -> Option<Spanned<Quantity>> {
    let found = reader.required_string(table, "quantity")?;
    let span = found.span;
    let value = Quantity::among(possible, &found.value);
    match value {
        Some(value) if value.takes_normal() => {
            let help = match value {
                Quantity::Traction => {
                    "check `first_piola_kirchhoff`, or claim the traction in [boundary]"
                }
                _ => "check the flux",
            };
            let message = format!("a check cannot be about `{}`", value.name());
            reader.report(
                Diagnostic::error(span, message).label("needs the normal of a boundary").help(help),
            );
            None
        }
        Some(value) if !value.is_on_request() => Some(Spanned { value, span }),
        _ => {
            let names = Quantity::pointwise().map(Quantity::name);
            let known = known.iter().map(|own| own.described().name.as_str());
            let names: Vec<_> = names.chain(known).collect();
            reader.report(unknown_word(&found, "quantity", &names));
            None
        }
    }
}

/// Reads every `[[extreme]]`; `parameters` are the names of the field's parameters.
pub(super) fn extremes<'a>(
    tables: &[Table<'a>],
    parameters: &[&str],
    reader: &mut Reader<'a>,
) -> Vec<ExtremeSpec> {
    let mut extremes: Vec<ExtremeSpec> = Vec::new();
    for table in tables {
        let name = reader.required_string(table, "name");
        let set = set(table, parameters, reader);
        let Some(name) = name else {
            reader.stray.extend(set.into_iter().map(|(_, value)| value));
            continue;
        };
        if extremes.iter().any(|earlier| earlier.name.value == *name.value) {
            let message = format!("the extreme {} is defined twice", quoted(&name.value));
            reader.report(Diagnostic::error(name.span, message).label("give it another name"));
        } else if REGIMES.contains(&&*name.value) {
            let message = format!("{} is a regime of every field", quoted(&name.value));
            reader.report(Diagnostic::error(name.span, message).label("give it another name"));
        }
        let name = Spanned { value: name.value.into(), span: name.span };
        extremes.push(ExtremeSpec { name, set, span: table.span });
    }
    extremes
}

fn set<'a>(
    table: &Table<'a>,
    parameters: &[&str],
    reader: &mut Reader<'a>,
) -> Vec<(Spanned<String>, Formula)> {
    let Some(entry) = reader.required(table, "set") else { return Vec::new() };
    let Some(settings) = reader.open_table(&entry, "`set`") else { return Vec::new() };
    let mut set = Vec::new();
    for setting in &settings.entries {
        let name = &setting.key;
        let value = reader.formula(&name.value, setting.value);
        if parameters.contains(&name.value.as_str()) || reader.is_incomplete() {
            set.push((name.clone(), value));
        } else {
            reader.report(unknown_parameter(name, parameters));
            reader.stray.push(value);
        }
    }
    set
}

fn unknown_parameter(name: &Spanned<String>, parameters: &[&str]) -> Diagnostic {
    let message = format!("unknown parameter {}", quoted(&name.value));
    let diagnostic = Diagnostic::error(name.span, message).label("not in [parameters]");
    let all = |_: &str| match parameters {
        [] => "this field has no parameters".into(),
        _ => format!("the parameters are {}", list(parameters)),
    };
    diagnostic.help(advice(&name.value, parameters.iter().copied(), all))
}
