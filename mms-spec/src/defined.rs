//! The quantities that a field file and its material define, and the closed forms for them.

use crate::balance::{BalanceLaw, BalanceSpec};
use crate::diagnostic::Diagnostic;
use crate::field::FieldSpec;
use crate::foreign::Foreign;
use crate::material::MaterialSpec;
use crate::own::{Described, Own, Part};
use crate::quantity::Quantity;
use crate::source::Spanned;

/// A given field of a field: one of the material that the field sets, or one of its own.
#[derive(Clone, Copy, Debug)]
struct Given<'a> {
    name: &'a str,
    unit: Option<&'a Spanned<String>>,
    doc: Option<&'a Foreign>,
}

/// The given fields of a field: first the material's, in the order of its file, then the field's own.
fn givens<'a>(field: &'a FieldSpec, material: Option<&'a MaterialSpec>) -> Vec<Given<'a>> {
    let taken = material.iter().flat_map(|material| &material.givens);
    let mut givens: Vec<_> = taken
        .map(|it| Given { name: &it.name.value, unit: it.unit.as_ref(), doc: it.doc.as_ref() })
        .collect();
    for own in &field.givens {
        if givens.iter().all(|taken| taken.name != own.name.value) {
            let (unit, doc) = (own.unit.as_ref(), own.doc.as_ref());
            givens.push(Given { name: &own.name.value, unit, doc });
        }
    }
    givens
}

/// The quantities that a field file and its material define: of the given fields, then of the balances.
pub fn own_quantities(field: &FieldSpec, material: Option<&MaterialSpec>) -> Vec<Own> {
    quantities_of(field, givens(field, material))
}

/// The quantities that a field file may define with any material: any formula of `[material]` may set a given field.
pub(super) fn possible_quantities(field: &FieldSpec) -> Vec<Own> {
    let of_material = field.material.arguments.iter();
    let of_material =
        of_material.map(|(name, _)| Given { name: &name.value, unit: None, doc: None });
    quantities_of(field, of_material.chain(givens(field, None)).collect())
}

/// Assigns the closed forms of a field to the quantities that it has once its material is known. Reports closed forms for a
/// parameter of the material.
pub fn settle_checks(field: &mut FieldSpec, own: &[Own], diagnostics: &mut Vec<Diagnostic>) {
    for check in &mut field.checks {
        let Quantity::Own(possible) = check.quantity.value else { continue };
        match own.iter().find(|own| own.name == possible.name) {
            Some(own) => check.quantity.value = Quantity::Own(*own),
            None => {
                let message = format!("`{}` is no given field of this field", possible.of);
                diagnostics.push(
                    Diagnostic::error(check.quantity.span, message)
                        .label("a parameter of the material is no quantity")
                        .help("a material file lists the given fields that it takes under [given]"),
                );
            }
        }
    }
    field.checks.retain(|check| match check.quantity.value {
        Quantity::Own(possible) => own.contains(&possible),
        _ => true,
    });
}

fn quantities_of(field: &FieldSpec, givens: Vec<Given<'_>>) -> Vec<Own> {
    let mut all = Vec::new();
    for given in givens {
        let parts = Part::OF_GIVEN.into_iter();
        for part in parts.filter(|part| *part != Part::Rate || !field.is_static()) {
            let unit = given.unit.map_or("", |unit| unit.value.as_str());
            let unit = match part {
                _ if unit.is_empty() => String::new(),
                Part::Gradient => format!("{unit}/m"),
                Part::Rate => format!("{unit}/s"),
                _ => unit.to_owned(),
            };
            let what = match given.doc {
                Some(doc) => format!("{}: {}", given.name, doc.in_a_comment()),
                None => given.name.to_owned(),
            };
            let doc = match part {
                Part::Gradient => format!("Gradient by X of the given field {what}."),
                Part::Rate => format!("Rate at fixed X of the given field {what}."),
                _ => format!("Given field {what}."),
            };
            all.push(described(&all, given.name, part, unit, doc));
        }
    }
    for balance in &field.balances {
        let name = &balance.name.value;
        for part in balance.parts() {
            let doc = doc_of_balance(balance, *part);
            all.push(described(&all, name, *part, String::new(), doc));
        }
    }
    all
}

fn described(before: &[Own], of: &str, part: Part, unit: String, doc: String) -> Own {
    let name = part.name(of);
    let symbol = match part {
        Part::Gradient => format!("grad_{of}"),
        Part::Rate => format!("d{of}_dt"),
        _ => name.clone(),
    };
    Own::new(Described { place: before.len(), part, of: of.to_owned(), name, symbol, unit, doc })
}

fn doc_of_balance(balance: &BalanceSpec, part: Part) -> String {
    let name = &balance.name.value;
    match (part, &balance.law) {
        (Part::Source, BalanceLaw::Flow { storage: Some(_), flux: Some(_) }) => format!(
            "Source of the balance of {name}, d(storage)/dt + Div(flux), per reference volume; a positive source adds to it."
        ),
        (Part::Source, BalanceLaw::Flow { flux: None, .. }) => format!(
            "Source of the balance of {name}, d(storage)/dt, per reference volume; a positive source adds to it."
        ),
        (Part::Source, _) => format!(
            "Source of the balance of {name}, Div(flux), per reference volume; a positive source adds to it."
        ),
        (Part::Flux, _) => format!("Flux Q of {name} through reference area."),
        (Part::NormalFlux, _) => {
            format!(
                "Outward flux Q.N of {name} through reference area, for the reference unit normal N."
            )
        }
        _ => format!("Residual of the constraint {name}."),
    }
}
