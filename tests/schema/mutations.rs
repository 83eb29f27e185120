//! Files with one mistake in a right one.

use mms_spec::quantity::Quantity;
use toml::{Table, Value};

use super::verdict::{Kind, json, reader_accepts};
use crate::sampled::{all_is_tried, sampled};

/// One position in `SHARE` of each file gets its mistakes.
const SHARE: usize = 4;

/// Files that have all keys between them.
const FULL: &[(Kind, &str)] = &[
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/every_key_2d.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/every_key_3d.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/units_cylinder.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/units_sphere.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/units_disk.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/units_polygon.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/units_nothing.toml")),
    (Kind::Field, include_str!("../../mms-codegen/tests/data/pass/units_axisymmetric.toml")),
    (Kind::Field, include_str!("../../fields/bar_1d.toml")),
    (Kind::Material, include_str!("../../mms-codegen/tests/data/pass/material_every_key.toml")),
    (Kind::Field, include_str!("../../fields/plane_strain_gent.toml")),
    (Kind::Material, include_str!("../../mms-codegen/materials/neo_hookean.toml")),
];

/// A step into a file.
#[derive(Clone, Debug, PartialEq)]
enum Step {
    Key(String),
    Item(usize),
}

/// A mistake.
#[derive(Clone, Debug)]
enum Slip {
    /// Replaces the value by another one.
    Replace(Value),
    /// Removes a key or an item.
    Remove,
    /// Renames a key, with the same value.
    Rename(String),
    /// Adds a key.
    Add(String),
    /// Repeats the last item.
    Repeat,
}

/// Values of every type; the strings are formulas, or words of one list and not of others.
fn values() -> Vec<Value> {
    let words =
        ["1", "box", "annulus", "free", "leapfrog", "neo_hookean", "./mine.toml", "sigma", ""];
    let mut values: Vec<_> = words.iter().map(|word| Value::from(*word)).collect();
    values.extend([1, 2, 3, 7, 0, -1, 2_000_000_000].map(Value::from));
    values.extend([1.5, -0.5, f64::INFINITY].map(Value::from));
    values.extend([Value::from(true), Value::Array(Vec::new()), Value::Table(Table::new())]);
    values.push(Value::Array(vec![Value::from("1")]));
    values.push(Value::Array(vec![Value::from(4), Value::from(8)]));
    values.push(Value::Array(vec![Value::from(1.5), Value::from(2), Value::from("3")]));
    values.push(Value::Array(vec![Value::Table(Table::new())]));
    values
}

const KEYS: &[&str] =
    &["zzz", "a b", "", "X", "sin", "I1", "lambda", "nu", "outer", "let", "x_min", "z_min"];

/// Every position in a file, including the whole.
fn places(file: &Value) -> Vec<Vec<Step>> {
    let mut places = vec![Vec::new()];
    let mut next = 0;
    while next < places.len() {
        let place = places[next].clone();
        let inner: Vec<Step> = match at(file, &place) {
            Value::Table(table) => table.keys().cloned().map(Step::Key).collect(),
            Value::Array(items) => (0..items.len()).map(Step::Item).collect(),
            _ => Vec::new(),
        };
        places.extend(inner.into_iter().map(|step| [place.clone(), vec![step]].concat()));
        next += 1;
    }
    places
}

fn at<'a>(file: &'a Value, place: &[Step]) -> &'a Value {
    place.iter().fold(file, |value, step| match step {
        Step::Key(key) => &value[key.as_str()],
        Step::Item(item) => &value[*item],
    })
}

fn at_mut<'a>(file: &'a mut Value, place: &[Step]) -> &'a mut Value {
    place.iter().fold(file, |value, step| match step {
        Step::Key(key) => &mut value[key.as_str()],
        Step::Item(item) => &mut value[*item],
    })
}

/// The mistakes that are possible at a position.
fn slips(file: &Value, place: &[Step]) -> Vec<Slip> {
    let mut slips = Vec::new();
    if !place.is_empty() {
        slips.extend(values().into_iter().map(Slip::Replace));
        slips.push(Slip::Remove);
    }
    if let Some(Step::Key(_)) = place.last() {
        slips.extend(KEYS.iter().map(|key| Slip::Rename(key.to_string())));
    }
    match at(file, place) {
        Value::Table(_) => slips.extend(KEYS.iter().map(|key| Slip::Add(key.to_string()))),
        Value::Array(items) if !items.is_empty() => slips.push(Slip::Repeat),
        _ => {}
    }
    slips
}

/// The file with the mistake, unless it changes nothing.
fn changed(file: &Value, place: &[Step], slip: &Slip) -> Option<Value> {
    let mut changed = file.clone();
    match (slip, place.split_last()) {
        (Slip::Replace(value), _) => *at_mut(&mut changed, place) = value.clone(),
        (Slip::Remove, Some((Step::Key(key), table))) => {
            at_mut(&mut changed, table).as_table_mut()?.remove(key);
        }
        (Slip::Remove, Some((Step::Item(item), array))) => {
            at_mut(&mut changed, array).as_array_mut()?.remove(*item);
        }
        (Slip::Rename(name), Some((Step::Key(key), table))) => {
            let table = at_mut(&mut changed, table).as_table_mut()?;
            let value = table.remove(key)?;
            if table.insert(name.clone(), value).is_some() {
                return None;
            }
        }
        (Slip::Add(name), _) => {
            let table = at_mut(&mut changed, place).as_table_mut()?;
            if table.insert(name.clone(), 1.into()).is_some() {
                return None;
            }
        }
        (Slip::Repeat, _) => {
            let items = at_mut(&mut changed, place).as_array_mut()?;
            items.push(items.last()?.clone());
        }
        _ => return None,
    }
    (changed != *file).then_some(changed)
}

/// The reason why the reader refuses a file that no schema can refuse, if there is one.
fn beyond(changed: &Value) -> Option<&'static str> {
    let set = |changed: &Value| -> Vec<String> {
        let extremes = changed.get("extreme").and_then(Value::as_array);
        let sets = extremes.into_iter().flatten().filter_map(|it| it.get("set")?.as_table());
        sets.flat_map(|set| set.keys().cloned()).collect()
    };
    let defined = |table: &str| -> Vec<String> {
        let table = changed.get(table).and_then(Value::as_table);
        table.into_iter().flat_map(|table| table.keys().cloned()).collect()
    };
    let names = |key: &str| -> Vec<Value> {
        let items = changed.get(key).and_then(Value::as_array);
        items.into_iter().flatten().filter_map(|item| item.get("name").cloned()).collect()
    };
    let parameters = defined("parameters");
    if set(changed).iter().any(|name| !parameters.contains(name)) {
        return Some("a set names parameters of the same file");
    }
    let domain = changed.get("domain").and_then(Value::as_table);
    let vertices = domain.and_then(|domain| domain.get("vertices")).and_then(Value::as_array);
    let claimed = defined("boundary");
    let mut edges = claimed.iter().filter_map(|face| face.strip_prefix("edge_")?.parse().ok());
    if vertices.is_some_and(|vertices| edges.any(|edge: usize| edge > vertices.len())) {
        return Some("a polygon has as many edges as vertices");
    }
    let lets = defined("let");
    let checks = changed.get("check").and_then(Value::as_array);
    let own = checks.into_iter().flatten().filter_map(|check| check.get("let")?.as_table());
    let mut own = own.flat_map(|names| names.keys());
    let balances = names("balance");
    let balances = balances.iter().filter_map(|name| name.as_str().map(str::to_owned));
    let owned: Vec<String> = defined("given").into_iter().chain(balances).collect();
    let is_defined = |name: &String| parameters.contains(name) || lets.contains(name);
    if lets.iter().any(|name| parameters.contains(name))
        || owned.iter().enumerate().any(|(at, name)| is_defined(name) || owned[..at].contains(name))
        || own.any(|name| parameters.contains(name) || lets.contains(name))
    {
        return Some("a name is defined twice in one file");
    }
    let mut named: Vec<_> = defined("given");
    named.extend(names("balance").iter().filter_map(|name| Some(name.as_str()?.to_owned())));
    let checks = changed.get("check").and_then(Value::as_array);
    let mut asked = checks.into_iter().flatten().filter_map(|it| it.get("quantity")?.as_str());
    let is_known = |asked: &str| {
        Quantity::from_name(asked).is_some()
            || named.iter().any(|name| asked.starts_with(name.as_str()))
    };
    if asked.any(|asked| !is_known(asked)) {
        return Some("a check names a quantity of the format or of the same file");
    }
    let extremes = names("extreme");
    if (1..extremes.len()).any(|index| extremes[..index].contains(&extremes[index])) {
        return Some("two extremes have one name");
    }
    let is_falling = |study: &Value| {
        let cells = study.get("cells").and_then(Value::as_array).cloned().unwrap_or_default();
        let cells: Vec<_> = cells.iter().filter_map(Value::as_integer).collect();
        cells.windows(2).any(|pair| pair[0] > pair[1])
    };
    let studies = changed.get("study").and_then(Value::as_array);
    if studies.into_iter().flatten().any(is_falling) {
        return Some("cells must increase");
    }
    let parameters = changed.get("parameters").and_then(Value::as_table);
    let symbols =
        parameters.into_iter().flat_map(|it| it.values()).filter_map(|it| it.get("symbol"));
    if symbols.filter_map(Value::as_str).any(|it| it.trim().is_empty()) {
        return Some("a symbol is math of LaTeX");
    }
    None
}

#[test]
fn one_slip_is_refused_by_the_schema_where_the_reader_refuses_it() {
    let (mut accepted, mut refused, mut reasons) = (0, 0, Vec::new());
    for (kind, text) in FULL {
        let file = Value::Table(text.parse().expect("valid TOML"));
        for place in sampled(places(&file), SHARE) {
            for slip in slips(&file, &place) {
                let Some(changed) = changed(&file, &place, &slip) else { continue };
                let text = toml::to_string(&changed).expect("TOML");
                let reader = reader_accepts(*kind, &text);
                let refusals = kind.refusals(&json(&changed));
                if reader == refusals.is_empty() {
                    if reader {
                        accepted += 1
                    } else {
                        refused += 1
                    }
                    continue;
                }
                assert!(!reader, "{place:?} {slip:?} is right, but the schema says {refusals:?}");
                let reason = beyond(&changed);
                let silent = || panic!("{place:?} {slip:?} is wrong, and the schema silent");
                reasons.push(reason.unwrap_or_else(silent));
            }
        }
    }
    let [least_accepted, least_refused] = if all_is_tried() { [1000, 5000] } else { [150, 750] };
    assert!(
        accepted > least_accepted && refused > least_refused,
        "{accepted} and {refused} files were compared"
    );
    assert!(reasons.len() < refused / 20, "{} files are beyond the schema", reasons.len());
    reasons.sort_unstable();
    reasons.dedup();
    assert!(
        reasons.len() == 7 || !all_is_tried(),
        "{reasons:?} are the only reasons that are needed"
    );
}
