//! Compares the units in the headers of tables with the units of the field.

use anyhow::bail;
use mms_exact::Exact;
use mms_results::names::{Meaning, Role};
use mms_results::{Snapshot, is_time};
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;
use mms_spec::units::{Dimension, Unit, system};

/// Refuses a column whose unit measures something else than its quantity, or belongs to another system than the units of the
/// field's parameters. Ignores unknown units.
///
/// # Errors
/// The column, its unit, and the unit that is expected.
pub fn validate(snapshot: &Snapshot, meanings: &[Meaning], exact: &Exact) -> anyhow::Result<()> {
    let parameters = &exact.input().compiled.model.parameters;
    let of_field: Vec<(&str, Unit)> = parameters
        .iter()
        .filter_map(|it| it.unit.as_deref())
        .filter_map(|text| Some((text, Unit::known(text)?)))
        .collect();
    let mut all: Vec<(&str, &str, Option<Dimension>)> = Vec::new();
    for meaning in meanings {
        let units = meaning.units(snapshot);
        all.extend(
            units.into_iter().map(|(name, unit)| (name, unit, dimension(meaning.role, exact))),
        );
    }
    let times = snapshot.units.iter().filter(|(name, _)| is_time(name));
    all.extend(times.map(|(name, unit)| (name.as_str(), unit.as_str(), Some(Dimension::time()))));
    for (name, text, expected) in all {
        let Some(unit) = known(text) else { continue };
        if let Some(expected) = expected.filter(|it| *it != unit.dimension) {
            bail!(
                "{}: the unit of `{}` is {}, and the quantity is measured in {expected}: correct the header, or name \
                 another column with `--map`",
                snapshot.path,
                shown(name),
                shown(text)
            );
        }
        let units = of_field.iter().map(|(_, it)| it);
        if system::consistent(units.clone()).is_none()
            && system::consistent(units.chain([&unit])).is_some()
        {
            let mut names: Vec<&str> = of_field.iter().map(|(text, _)| *text).collect();
            names.sort_unstable();
            names.dedup();
            bail!(
                "{}: `{}` is in {}, which is not of the field's system of units ({}); values are not converted: write it \
                 in the field's units",
                snapshot.path,
                shown(name),
                shown(text),
                names.join(", ")
            );
        }
    }
    Ok(())
}

/// The dimension of a quantity.
fn dimension(role: Role, exact: &Exact) -> Option<Dimension> {
    let unit = match role {
        Role::Reference | Role::Position | Role::Place => Quantity::Position.unit(),
        _ => exact.input().compiled.quantity(role.name()).ok()?.unit(),
    };
    Some(Unit::known(unit)?.dimension)
}

/// The unit of a header; powers may lack their marks, as in `N/mm2`.
pub fn known(text: &str) -> Option<Unit> {
    let text = if matches!(text, "-" | "" | "--") { "1" } else { text };
    Unit::known(text).or_else(|| {
        let mut marked = String::new();
        let mut last = ' ';
        for letter in text.chars() {
            if letter.is_ascii_digit() && last.is_alphabetic() {
                marked.push('^');
            }
            marked.push(letter);
            last = letter;
        }
        Unit::known(&marked)
    })
}
