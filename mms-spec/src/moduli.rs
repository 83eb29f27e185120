//! The moduli of an isotropic solid, any two of which determine the others: a field may state another pair than the one in
//! which its material is written.
//!
//! The conversions come from linear elasticity in three dimensions (Bonet & Wood, Nonlinear Continuum Mechanics for Finite
//! Element Analysis, 2008, section 6.6). A converted material is like any other: its parameters are the stated pair, and its
//! own moduli are the first definitions.

use crate::diagnostic::Diagnostic;
use crate::field::FieldSpec;
use crate::formula::Formula;
use crate::material::MaterialSpec;
use crate::source::{Sources, Span, Spanned};
use crate::symbols::{LetSpec, MaterialParameter};

/// Two moduli that determine the others.
pub type Pair = [&'static str; 2];

/// Young's modulus and Poisson's ratio.
pub const ENGINEERING: Pair = ["young", "nu"];

const LAME: Pair = ["lambda", "mu"];
const BULK_AND_SHEAR: Pair = ["kappa", "mu"];

/// The names of all moduli.
pub const MODULI: [&str; 5] = ["lambda", "mu", "kappa", "young", "nu"];

/// The pairs that a field may state.
const PAIRS: [Pair; 3] = [LAME, ENGINEERING, BULK_AND_SHEAR];

/// The pairs in which a material may be written.
const OWN: [Pair; 2] = [LAME, BULK_AND_SHEAR];

/// A modulus of a material, the stated pair, and the modulus in terms of the pair.
const CONVERSIONS: [(&str, Pair, &str); 5] = [
    ("lambda", ENGINEERING, "young*nu/((1 + nu)*(1 - 2*nu))"),
    ("lambda", BULK_AND_SHEAR, "kappa - 2*mu/3"),
    ("kappa", ENGINEERING, "young/(3*(1 - 2*nu))"),
    ("kappa", LAME, "lambda + 2*mu/3"),
    ("mu", ENGINEERING, "young/(2*(1 + nu))"),
];

const DOCS: [(&str, &str); 3] =
    [("young", "Young's modulus"), ("nu", "Poisson's ratio"), ("kappa", "bulk modulus")];

/// The pair in which a material is written, and the pairs that a field may state instead: none if the material uses one of
/// their names for something else.
pub fn pairs(material: &MaterialSpec) -> Option<(Pair, Vec<Pair>)> {
    let is_parameter =
        |name: &str| material.parameters.iter().any(|parameter| parameter.name.value == name);
    let is_defined =
        |name: &str| material.lets.iter().any(|definition| definition.name.value == name);
    let own = OWN.into_iter().find(|pair| pair.iter().all(|name| is_parameter(name)))?;
    let is_free = |name: &str| own.contains(&name) || !(is_parameter(name) || is_defined(name));
    let others = PAIRS.into_iter().filter(|pair| *pair != own);
    Some((own, others.filter(|pair| pair.iter().all(|name| is_free(name))).collect()))
}

/// Rewrites a material in the moduli that the field states. Reports moduli that are no pair, and removes them so that they
/// cause no further messages.
pub fn convert(
    sources: &mut Sources,
    field: &FieldSpec,
    material: &mut MaterialSpec,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some((own, others)) = pairs(material) else { return };
    let is_modulus =
        |name: &str| own.contains(&name) || others.iter().flatten().any(|it| *it == name);
    let given: Vec<&Spanned<String>> = field
        .material
        .arguments
        .iter()
        .map(|(name, _)| name)
        .filter(|name| is_modulus(&name.value))
        .collect();
    let is_given = |pair: &Pair| {
        given.len() == pair.len() && given.iter().all(|name| pair.contains(&name.value.as_str()))
    };
    if is_given(&own) || field.incomplete || material.incomplete {
        return;
    }
    if let Some(pair) = others.iter().copied().find(is_given) {
        rewrite(sources, own, pair, material);
        return;
    }
    diagnostics.push(mistake(field, &material.name.shown(), &given, own, &others));
    let span = field.material.span;
    let given = given.iter().map(|name| (name.value.clone(), name.span));
    material.parameters.retain(|parameter| !own.contains(&parameter.name.value.as_str()));
    let missing = own.into_iter().filter(|name| given.clone().all(|(given, _)| given != **name));
    let lets = missing.map(|name| definition(name, span, Formula::reported(span)));
    material.lets.splice(0..0, lets);
    material.parameters.extend(given.map(|(value, span)| MaterialParameter {
        name: Spanned { value, span },
        unit: None,
        doc: None,
    }));
}

fn mistake(
    field: &FieldSpec,
    material: &str,
    given: &[&Spanned<String>],
    own: Pair,
    others: &[Pair],
) -> Diagnostic {
    let shown = |names: &[&str]| -> String {
        let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
        names.join(if names.len() > 2 { ", " } else { " and " })
    };
    let names: Vec<&str> = given.iter().map(|name| name.value.as_str()).collect();
    let found = match names.as_slice() {
        [] => "found none".to_string(),
        [one] => format!("found `{one}` alone"),
        several => format!("found {}", shown(several)),
    };
    let accepted: Vec<_> = [own].iter().chain(others).map(|pair| shown(pair)).collect();
    let span = given.last().map_or(field.material.model.span, |name| name.span);
    Diagnostic::error(span, format!("the moduli of `{material}` must be one pair"))
        .label(found)
        .help(format!("give {}", accepted.join(", or ")))
}

/// Replaces the material's own pair by the stated one.
fn rewrite(sources: &mut Sources, own: Pair, pair: Pair, material: &mut MaterialSpec) {
    let place = material.parameters.iter().position(|it| own.contains(&it.name.value.as_str()));
    let (moduli, others): (Vec<_>, Vec<_>) = std::mem::take(&mut material.parameters)
        .into_iter()
        .partition(|parameter| own.contains(&parameter.name.value.as_str()));
    let stress = moduli.iter().find_map(|parameter| parameter.unit.clone());
    let mut text = |name: &str, text: &str| {
        let source = sources.add("moduli", format!("{name} = {text}"));
        let start = name.len() + " = ".len();
        (sources.span(source, 0, name.len()), sources.span(source, start, start + text.len()))
    };
    let given = pair.map(|name| {
        if let Some(own) = moduli.iter().find(|parameter| parameter.name.value == name) {
            return own.clone();
        }
        let (span, unit) = text(name, "1");
        let unit = match name {
            "nu" => stress.as_ref().map(|_| Spanned { value: "1".into(), span: unit }),
            _ => stress.clone(),
        };
        let doc = DOCS.iter().find(|(known, _)| *known == name).map(|(_, doc)| (*doc).into());
        MaterialParameter { name: Spanned { value: name.into(), span }, unit, doc }
    });
    let converted =
        CONVERSIONS.iter().filter(|(name, from, _)| own.contains(name) && *from == pair);
    let lets: Vec<_> = converted
        .map(|(name, _, conversion)| {
            let (span, value) = text(name, conversion);
            definition(name, span, Formula::plain(conversion, value))
        })
        .collect();
    material.parameters = others;
    let place = place.unwrap_or(0).min(material.parameters.len());
    material.parameters.splice(place..place, given);
    material.lets.splice(0..0, lets);
    material.moduli = Some(pair);
}

fn definition(name: &str, span: Span, value: Formula) -> LetSpec {
    LetSpec { name: Spanned { value: name.into(), span }, value }
}
