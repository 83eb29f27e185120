//! The given fields and the further balances of a field, in Python: the names of the language of balances are derived by SymPy.

use super::python::Renamed;
use super::{axes, translated};
use mms_codegen::compile::Compiled;
use mms_spec::own::Part;
use mms_spec::syntax::{self, NodeKind};
use mms_spec::{BalanceLaw, BalanceSpec, Formula, Space};
use mms_symbolic::sorted::SortedSet;

/// The names that the formulas of balances use and the file does not define.
pub(super) fn used(compiled: &Compiled) -> Vec<String> {
    let formulas = compiled.field.balances.iter().flat_map(BalanceSpec::formulas);
    let asts = formulas.filter_map(|formula| syntax::parse(formula, &mut Vec::new()));
    let names = asts.flat_map(|ast| ast.nodes).filter_map(|node| match node.kind {
        NodeKind::Name(name) => Some(name),
        _ => None,
    });
    let known = compiled.field.space.axes().iter().chain(&["t", "pi"]);
    let known: SortedSet<&str> = known.copied().collect();
    let names: SortedSet<String> = names
        .filter(|name| !known.contains(name.as_str()) && !is_defined(compiled, name))
        .collect();
    names.into_iter().collect()
}

fn is_defined(compiled: &Compiled, name: &str) -> bool {
    let field = &compiled.field;
    field.parameters.iter().any(|it| it.name.value == name)
        || field.lets.iter().any(|it| it.name.value == name)
        || field.givens.iter().any(|it| it.name.value == name)
        || compiled.material.given(name).is_some()
}

/// The lines of `field` that define these names.
pub(super) fn definitions(compiled: &Compiled, names: &Renamed) -> Vec<String> {
    let used = used(compiled);
    if used.is_empty() {
        return Vec::new();
    }
    let (axes, space) = (axes(&compiled.field), compiled.field.space);
    let deformed = match space {
        Space::Cartesian(_) => format!("in_space([{axes}], u)"),
        Space::Axisymmetric { .. } => format!("around_the_axis({axes}, u)"),
    };
    let mut lines = vec![format!("    deformed = {deformed}")];
    for name in &used {
        lines.push(format!("    {} = {}", names.name(name), meaning(name, space, names)));
    }
    lines
}

fn meaning(name: &str, space: Space, names: &Renamed) -> String {
    let axis = |text: &str| space.directions().iter().position(|axis| *axis == text);
    if name == "J" {
        return "determinant(deformed)".into();
    }
    match name.rsplit_once('_') {
        Some(("u", by)) if axis(by).is_some() => {
            return format!("u[{}]", axis(by).unwrap_or_default());
        }
        Some(("v", by)) if axis(by).is_some() => {
            return format!("diff(u[{}], t)", axis(by).unwrap_or_default());
        }
        Some((of, by)) => return format!("diff({}, {by})", names.name(of)),
        None => {}
    }
    let letters = name.trim_end_matches(|it: char| it.is_ascii_digit());
    let places = name[letters.len()..].bytes().map(|digit| (digit - b'1').to_string());
    let place = places.collect::<Vec<_>>().join(", ");
    match letters {
        "H" => format!("(deformed - eye(3))[{place}]"),
        "F" => format!("deformed[{place}]"),
        "Finv" => format!("(deformed.adjugate() / determinant(deformed))[{place}]"),
        "C" => format!("(deformed.T * deformed)[{place}]"),
        _ => format!("((deformed.T * deformed).adjugate() / determinant(deformed) ** 2)[{place}]"),
    }
}

/// The lines of `field` that collect the quantities of the file's own: a dictionary of lists.
pub(super) fn quantities(compiled: &Compiled, names: &Renamed) -> Vec<String> {
    let space = compiled.field.space;
    let axes = &space.axes()[..space.coordinates()];
    let mut lines = vec!["    own = {}".to_string()];
    for own in compiled.model.own.keys() {
        let given = names.name(&own.of);
        let balance = compiled.field.balances.iter().find(|it| it.name.value == own.of);
        let components = match (own.part, balance.map(|balance| &balance.law)) {
            (Part::Value, _) => given.to_owned(),
            (Part::Gradient, _) => {
                let mut slopes: Vec<_> =
                    axes.iter().map(|axis| format!("diff({given}, {axis})")).collect();
                slopes.resize(space.vector(), "Integer(0)".into());
                slopes.join(", ")
            }
            (Part::Rate, _) => format!("diff({given}, t)"),
            (Part::Residual, Some(BalanceLaw::Constraint { residual })) => {
                translated(residual, names)
            }
            (Part::Source, Some(BalanceLaw::Flow { storage, flux })) => {
                let storage =
                    storage.iter().map(|it| format!("diff({}, t)", translated(it, names)));
                let spread = flux.iter().flatten().take(usize::from(space.is_axisymmetric()));
                let spread = spread.map(|it| format!("({})/R", translated(it, names)));
                let flux = flux.iter().flatten().zip(axes);
                let flux =
                    flux.map(|(it, axis)| format!("diff({}, {axis})", translated(it, names)));
                storage.chain(flux).chain(spread).collect::<Vec<_>>().join(" + ")
            }
            (_, Some(BalanceLaw::Flow { flux, .. })) => list(flux.iter().flatten(), names),
            _ => continue,
        };
        lines.push(format!("    own[\"{}\"] = [{components}]", own.name));
    }
    lines
}

fn list<'a>(formulas: impl Iterator<Item = &'a Formula>, names: &Renamed) -> String {
    formulas.map(|formula| translated(formula, names)).collect::<Vec<_>>().join(", ")
}
