//! `[parameters]` and `[let]`: the names that a file defines.

use crate::diagnostic::{Diagnostic, quoted};
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
    /// The formula; it may use the names above it.
    pub value: Formula,
}

/// A number that users may change when the compiled field runs.
#[derive(Clone, Debug)]
pub struct ParameterSpec {
    /// The name.
    pub name: Spanned<String>,
    /// The default value; it may use the parameters above it.
    pub value: Formula,
    /// The unit, as written.
    pub unit: Option<Spanned<String>>,
    /// The symbol in LaTeX math.
    pub symbol: Option<Spanned<String>>,
    /// A description, in one line.
    pub doc: Option<Foreign>,
    /// The least and the greatest allowed value.
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
    /// A description, in one line.
    pub doc: Option<Foreign>,
}

/// Reads definitions in the order of the file. A formula whose name is refused is kept as a stray one.
pub(super) fn lets<'a>(
    table: &Table<'a>,
    names: &mut Names,
    reader: &mut Reader<'a>,
) -> Vec<LetSpec> {
    let mut lets = Vec::new();
    for Entry { key, value } in &table.entries {
        // If the header of another table replaces a formula, that table contains the definitions below it.
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
        let mut parameter = parameter(entry, reader);
        if names.define(&entry.key, reader) {
            parameter.symbol =
                parameter.symbol.filter(|symbol| is_new(symbol, &parameters, reader));
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
        symbol: None,
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
    parameter.symbol = table.get("symbol").and_then(|symbol| math(&symbol, reader));
    parameter.doc = reader.optional_foreign(&table, "doc");
    parameter.range = table
        .get("range")
        .map(|range| reader.pair(&range, "expected the least and the greatest value"));
    parameter
}

/// The symbol of a parameter, if it is valid in LaTeX math without changing the text around it.
fn math<'a>(entry: &Entry<'a>, reader: &mut Reader<'a>) -> Option<Spanned<String>> {
    let symbol = reader.string(entry)?;
    let fault = if symbol.value.trim().is_empty() {
        "is empty"
    } else if symbol.value.contains(|c: char| c.is_control() || "$%&#".contains(c)) {
        "has a character that ends or hides the formula around it"
    } else if !has_pairs(&symbol.value) {
        "has braces without their partners"
    } else {
        return Some(symbol);
    };
    reader.report(
        Diagnostic::error(symbol.span, format!("the symbol of a parameter {fault}"))
            .label("expected math of LaTeX, such as `E`, `\\\\lambda` or `\\\\rho_0`")
            .help("without `symbol` the formulas show the name of the parameter"),
    );
    None
}

/// Whether each brace of a text has its partner; a backslash at the end would escape the next brace.
fn has_pairs(text: &str) -> bool {
    let (mut open, mut characters) = (0_usize, text.chars());
    while let Some(character) = characters.next() {
        match character {
            '\\' if characters.next().is_none() => return false,
            '{' => open += 1,
            '}' if open == 0 => return false,
            '}' => open -= 1,
            _ => {}
        }
    }
    open == 0
}

/// Whether no parameter above has this symbol; reports the second one with the same symbol.
fn is_new(symbol: &Spanned<String>, above: &[ParameterSpec], reader: &mut Reader<'_>) -> bool {
    let same = |it: &&ParameterSpec| it.symbol.as_ref().is_some_and(|it| it.value == symbol.value);
    let Some(first) = above.iter().find(same) else { return true };
    let name = quoted(&first.name.value);
    reader.report(
        Diagnostic::error(
            symbol.span,
            format!("the symbol {} is declared twice", quoted(&symbol.value)),
        )
        .label(format!("also the symbol of {name}"))
        .help("formulas would show two parameters alike: choose another symbol"),
    );
    false
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
