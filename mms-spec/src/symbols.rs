//! `[parameters]` and `[let]`: the names that a file defines.

use crate::foreign::Foreign;
use crate::format::{MATERIAL_PARAMETER, PARAMETER};
use crate::formula::Formula;
use crate::names::Names;
use crate::source::Spanned;
use crate::table::{Entry, Reader, Table};

/// A name for an expression.
#[derive(Clone, Debug)]
pub struct LetSpec {
    /// The name.
    pub name: Spanned<String>,
    /// What it stands for; it may use the names above it.
    pub value: Formula,
}

/// A number that users may change when the compiled field runs.
#[derive(Clone, Debug)]
pub struct ParameterSpec {
    /// The name.
    pub name: Spanned<String>,
    /// The value it has by default; it may use the parameters above it.
    pub value: Formula,
    /// The unit, as written.
    pub unit: Option<Spanned<String>>,
    /// One line on what it is.
    pub doc: Option<Foreign>,
    /// The least and the greatest value it may take.
    pub range: Option<[Formula; 2]>,
    /// Whether a selection makes it a constant.
    pub frozen: bool,
}

/// A parameter of a material: its value comes from the field.
#[derive(Clone, Debug)]
pub struct MaterialParameter {
    /// The name.
    pub name: Spanned<String>,
    /// The unit, as written.
    pub unit: Option<Spanned<String>>,
    /// One line on what it is.
    pub doc: Option<Foreign>,
}

/// Definitions in the order of the file. One whose name is refused is kept as a stray formula.
pub(super) fn lets<'a>(
    table: &Table<'a>,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<LetSpec> {
    let mut lets = Vec::new();
    for Entry { key, value } in &table.entries {
        // The header of another table in place of a formula takes the definitions below it.
        reader.lost_names |= value.get_ref().is_table();
        let value = reader.formula(&key.value, value);
        if names.define(key, reader) {
            lets.push(LetSpec { name: key.clone(), value });
        } else {
            reader.stray.push(value);
        }
    }
    lets
}

/// The parameters of a field, in the order of the file.
pub(super) fn parameters<'a>(
    table: &Table<'a>,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<ParameterSpec> {
    let mut parameters = Vec::new();
    for entry in &table.entries {
        let parameter = parameter(entry, reader);
        if names.define(&entry.key, reader) {
            parameters.push(parameter);
        } else {
            reader.stray.push(parameter.value);
            reader.stray.extend(parameter.range.into_iter().flatten());
        }
    }
    parameters
}

fn parameter<'a>(entry: &Entry<'a>, reader: &mut Reader<'a>) -> ParameterSpec {
    let name = entry.key.clone();
    let mut parameter = ParameterSpec {
        value: Formula::reported(name.span),
        name,
        unit: None,
        doc: None,
        range: None,
        frozen: false,
    };
    if !entry.value.get_ref().is_table() {
        let instead = format!("write {} = {{ value = ... }}", entry.key.value);
        let key = &entry.key.value;
        reader.wrong_type_because(key, entry.value, "a table with its `value`", Some(instead));
        return parameter;
    }
    let label = format!("the parameter `{}`", entry.key.value);
    let Some(table) = reader.table(entry, &label, PARAMETER) else {
        return parameter;
    };
    parameter.value = reader.required_formula(&table, "value");
    parameter.unit = table.get("unit").and_then(|unit| reader.string(&unit));
    parameter.doc = reader.optional_foreign(&table, "doc");
    parameter.range = table
        .get("range")
        .map(|range| reader.pair(&range, "expected the least and the greatest value"));
    parameter
}

/// The parameters of a material, in the order of the file.
pub(super) fn material_parameters<'a>(
    table: &Table<'a>,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<MaterialParameter> {
    let mut parameters = Vec::new();
    for entry in &table.entries {
        let label = format!("the parameter `{}` of a material", entry.key.value);
        let fields = reader.table(entry, &label, MATERIAL_PARAMETER);
        let unit = fields
            .as_ref()
            .and_then(|fields| fields.get("unit"))
            .and_then(|unit| reader.string(&unit));
        let doc = fields.as_ref().and_then(|fields| reader.optional_foreign(fields, "doc"));
        if names.define(&entry.key, reader) {
            parameters.push(MaterialParameter { name: entry.key.clone(), unit, doc });
        }
    }
    parameters
}
