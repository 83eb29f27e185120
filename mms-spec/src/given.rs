//! Given fields: functions of X and t, such as a pressure or a temperature, that a material uses or that a field file defines.

use crate::foreign::Foreign;
use crate::format::{GIVEN, MATERIAL_GIVEN};
use crate::formula::Formula;
use crate::names::Names;
use crate::own::Part;
use crate::source::Spanned;
use crate::table::{Reader, Table};

/// A given field of a material file: its values come from the field file.
#[derive(Clone, Debug)]
pub struct MaterialGiven {
    /// The name.
    pub name: Spanned<String>,
    /// The unit, as written.
    pub unit: Option<Spanned<String>>,
    /// A description, in one line.
    pub doc: Option<Foreign>,
    /// The value in the state of rest, at which the material is judged; 0 if the file has none.
    pub rest: Option<Formula>,
}

/// A given field of a field file itself.
#[derive(Clone, Debug)]
pub struct GivenSpec {
    /// The name.
    pub name: Spanned<String>,
    /// The function of X and t; it may use the names above it.
    pub value: Formula,
    /// The unit, as written.
    pub unit: Option<Spanned<String>>,
    /// A description, in one line.
    pub doc: Option<Foreign>,
}

/// The given fields of a material, in the order of the file.
pub(super) fn material_givens<'a>(
    table: &Table<'a>,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<MaterialGiven> {
    let mut givens = Vec::new();
    for entry in &table.entries {
        let label = format!("the given field `{}` of a material", entry.key.value);
        let keys = reader.table(entry, &label, MATERIAL_GIVEN);
        let name = entry.key.clone();
        let mut given = MaterialGiven { name, unit: None, doc: None, rest: None };
        if let Some(keys) = &keys {
            given.unit = keys.get("unit").and_then(|unit| reader.string(&unit));
            given.doc = reader.optional_foreign(keys, "doc");
            given.rest = keys.get("rest").map(|rest| reader.formula("rest", rest.value));
        }
        if names.define_own(&entry.key, &Part::OF_GIVEN, reader) && names.define(&entry.key, reader)
        {
            givens.push(given);
        } else {
            reader.stray.extend(given.rest);
        }
    }
    givens
}

/// The given fields of a field file, in the order of the file.
pub(super) fn givens<'a>(
    table: &Table<'a>,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<GivenSpec> {
    let mut givens = Vec::new();
    for entry in &table.entries {
        let name = &entry.key.value;
        if !entry.value.get_ref().is_table() {
            let instead = format!("write {name} = {{ value = ... }}");
            let expected = "a table with its `value`";
            reader.wrong_type_because(name, entry.value, expected, Some(instead));
            reader.lost_names = true;
            continue;
        }
        let label = format!("the given field `{name}`");
        let Some(keys) = reader.table(entry, &label, GIVEN) else { continue };
        let value = reader.required_formula(&keys, "value");
        let unit = keys.get("unit").and_then(|unit| reader.string(&unit));
        let doc = reader.optional_foreign(&keys, "doc");
        if names.define_own(&entry.key, &Part::OF_GIVEN, reader) && names.define(&entry.key, reader)
        {
            givens.push(GivenSpec { name: entry.key.clone(), value, unit, doc });
        } else {
            reader.stray.push(value);
        }
    }
    givens
}
