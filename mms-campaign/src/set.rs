//! The parameters of a study, of which some may be lists: `set = { load = [0.25, 0.5, 1], nu = 0.3 }`.
//!
//! A step is one set of values: the first step has the first number of each list, the second step the second. A parameter with
//! a single number has it in all steps.

use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::source::Span;
use toml::de::DeValue;

use crate::table::{Reader, Table, Value, digits};

/// A point of a parameter sweep: the parameters of one step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct SweepPoint {
    /// The stepped parameters, as part of the name of a folder; empty if there are none.
    pub name: String,
    /// All parameters, as `name=value`.
    pub set: Vec<String>,
}

/// A parameter: its values, and, if they are a list, its place.
struct Setting {
    name: String,
    values: Vec<String>,
    list: Option<Span>,
}

/// The steps of `set`: one if no parameter is stepped.
pub(crate) fn steps(reader: &mut Reader, table: &Table<'_>) -> Vec<SweepPoint> {
    let Some(value) = table.value("set") else { return vec![SweepPoint::default()] };
    let expected = "a table of numbers or of lists of them, as in { young = 1e6, load = [0.5, 1] }";
    let entries = reader.of_value(value, "set", expected, |_| value.get_ref().as_table());
    let Some(entries) = entries else { return Vec::new() };
    let settings: Vec<Setting> = entries
        .iter()
        .filter_map(|(name, value)| setting(reader, name.get_ref().as_ref(), value))
        .collect();
    let Some(count) = count(reader, &settings) else { return Vec::new() };
    let steps: Vec<SweepPoint> = (0..count).map(|at| step(&settings, at)).collect();
    validate_distinct(reader, &settings, &steps);
    steps
}

/// The values of a parameter.
fn setting(reader: &mut Reader, name: &str, value: &Value<'_>) -> Option<Setting> {
    let span = reader.span(value);
    let (values, list) = match value.get_ref() {
        DeValue::Array(items) if !items.is_empty() => {
            (items.iter().map(digits).collect::<Option<Vec<_>>>(), Some(span))
        }
        DeValue::Array(_) => (None, None),
        _ => (digits(value).map(|value| vec![value]), None),
    };
    let Some(values) = values else {
        let message =
            format!("`set`: {}: expected a number, or a list of one number or more", quoted(name));
        reader.report(Diagnostic::error(span, message).label("found this"));
        return None;
    };
    Some(Setting { name: name.to_owned(), values, list })
}

/// The number of steps; `None` if lists have different lengths.
fn count(reader: &mut Reader, settings: &[Setting]) -> Option<usize> {
    let mut lists = settings.iter().filter_map(|it| Some((it, it.list?)));
    let Some((first, _)) = lists.next() else { return Some(1) };
    let count = first.values.len();
    let mut agree = true;
    for (other, span) in lists.filter(|(it, _)| it.values.len() != count) {
        agree = false;
        let message = format!(
            "`set`: {} has {} values, and {} {count}",
            quoted(&other.name),
            other.values.len(),
            quoted(&first.name)
        );
        let help = "lists are stepped together: give as many values in each";
        reader.report(Diagnostic::error(span, message).label("counted here").help(help));
    }
    agree.then_some(count)
}

fn step(settings: &[Setting], at: usize) -> SweepPoint {
    let value = |it: &Setting| {
        let value = if it.list.is_some() { &it.values[at] } else { &it.values[0] };
        format!("{}={value}", it.name)
    };
    let stepped = settings.iter().filter(|it| it.list.is_some()).map(value);
    // A fraction contains a slash.
    let is_odd = |c: char| !(c.is_alphanumeric() || matches!(c, '=' | '.' | '_' | '+' | '-'));
    let name = stepped.map(|it| it.replace(is_odd, "_")).collect::<Vec<_>>().join(",");
    SweepPoint { name, set: settings.iter().map(value).collect() }
}

/// Refuses duplicate steps, whose results would be confused.
fn validate_distinct(reader: &mut Reader, settings: &[Setting], steps: &[SweepPoint]) {
    let twice = (0..steps.len()).find(|&at| steps[..at].iter().any(|it| it.name == steps[at].name));
    let span = settings.iter().find_map(|it| it.list);
    if let (Some(at), Some(span)) = (twice, span) {
        let message = format!("`set`: two steps are {}", quoted(&steps[at].name));
        let found = Diagnostic::error(span, message).label("the same values twice");
        reader.report(found.help("leave one of them out"));
    }
}
