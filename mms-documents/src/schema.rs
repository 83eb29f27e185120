//! The JSON Schemas of all documents, and the tables of the reference page.

use std::fmt::Write as _;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use crate::*;

/// A document: its heading on the page, and its schema.
type Document = (&'static str, fn(&mut SchemaGenerator) -> Schema);

fn of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    generator.subschema_for::<T>()
}

/// The documents in the order of the page.
const DOCUMENTS: [Document; 28] = [
    ("list", of::<list::List>),
    ("explain", of::<explain::Explain>),
    ("show", of::<show::Show>),
    ("check", of::<check::Check>),
    ("eval", of::<eval::Eval>),
    ("state", of::<state::State>),
    ("emit", of::<emit::Emit>),
    ("emit-all", of::<emit::EmitAll>),
    ("accuracy", of::<accuracy::Accuracy>),
    ("run", of::<run::Run>),
    ("study", of::<study::Study>),
    ("studies", of::<study::Studies>),
    ("judge", of::<judge::Judge>),
    ("judge-baseline", of::<judge::JudgeBaseline>),
    ("judge-same", of::<judge::JudgeSame>),
    ("judge-explained", of::<judge::JudgeExplained>),
    ("diagnose", of::<diagnose::Diagnose>),
    ("diagnose-plan", of::<diagnose::DiagnosePlan>),
    ("hypotheses", of::<diagnose::Hypotheses>),
    ("campaign", of::<campaign::Campaign>),
    ("campaign-runs", of::<campaign::CampaignRuns>),
    ("campaign-suggest", of::<campaign::CampaignSuggest>),
    ("verify", of::<verify::Verify>),
    ("verify-list", of::<verify::VerifyList>),
    ("verify-defects", of::<verify::VerifyDefects>),
    ("tradeoff", of::<tradeoff::Tradeoff>),
    ("extremes", of::<extremes::Extremes>),
    ("provenance", of::<provenance::Provenance>),
];

/// The schemas of all types as one JSON Schema. The name of each definition is its heading on the page.
pub fn schemas() -> Value {
    let mut generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    for (_, add) in DOCUMENTS {
        add(&mut generator);
    }
    let definitions = generator.take_definitions(true);
    let renamed = definitions.into_iter().map(|(name, mut schema)| {
        nulls_told(&mut schema);
        (heading(&name), linked(schema))
    });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "The documents of mms",
        "$defs": renamed.collect::<Map<_, _>>(),
    })
}

/// Converts a name such as `JudgedNorm` to a heading such as `judged-norm`.
fn heading(name: &str) -> String {
    let mut heading = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !heading.is_empty() {
            heading.push('-');
        }
        heading.extend(letter.to_lowercase());
    }
    heading
}

/// The mark of a key that may be missing and may also be null.
const OR_NULL: &str = "x-or-null";

/// Removes null from the types of keys that are left out instead.
fn nulls_told(schema: &mut Value) {
    let required: Vec<_> = schema["required"].as_array().cloned().unwrap_or_default();
    for (key, value) in schema["properties"].as_object_mut().into_iter().flatten() {
        let Some(keys) = value.as_object_mut() else { continue };
        if keys.remove(OR_NULL).is_some() || required.contains(&json!(key)) {
            continue;
        }
        if let Some(Value::Array(kinds)) = keys.get_mut("type") {
            kinds.retain(|kind| kind != "null");
        }
        if let Some(Value::Array(choices)) = keys.get_mut("anyOf") {
            choices.retain(|choice| choice["type"] != "null");
        }
    }
}

/// A schema with its links renamed to headings.
fn linked(schema: Value) -> Value {
    match schema {
        Value::Object(keys) => {
            let link = |(key, value): (String, Value)| match (key.as_str(), &value) {
                ("$ref", Value::String(link)) => {
                    let name = link.rsplit('/').next().unwrap_or_default();
                    (key, json!(format!("#/$defs/{}", heading(name))))
                }
                _ => (key, linked(value)),
            };
            Value::Object(keys.into_iter().map(link).collect())
        }
        Value::Array(items) => Value::Array(items.into_iter().map(linked).collect()),
        other => other,
    }
}

/// The heading that a schema links to.
fn target(schema: &Value) -> Option<&str> {
    schema["$ref"].as_str()?.strip_prefix("#/$defs/")
}

/// The type of a value in the words of the page, and whether it may be null.
fn words(schema: &Value) -> (String, bool) {
    if let Some(target) = target(schema) {
        return (format!("[{target}](#{target})"), false);
    }
    if let Some(choices) = schema["anyOf"].as_array().or(schema["oneOf"].as_array()) {
        let found: Vec<_> = choices.iter().map(words).collect();
        let mut named: Vec<_> =
            found.iter().map(|(word, _)| word.clone()).filter(|it| !it.is_empty()).collect();
        named.dedup();
        return (named.join(" or "), found.iter().any(|(_, is_null)| *is_null));
    }
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    let of = |inner: &Value| {
        let (word, is_null) = words(inner);
        if is_null { format!("{word} or null") } else { word }
    };
    let word = |kind: &&str| match *kind {
        "string" => "text".to_owned(),
        "integer" | "number" => "number".to_owned(),
        "array" => format!("list of {}", of(&schema["items"])),
        "object" => format!("names to {}", of(&schema["additionalProperties"])),
        other => other.to_owned(),
    };
    let named: Vec<_> = kinds.iter().filter(|kind| **kind != "null").map(word).collect();
    (named.join(" or "), kinds.contains(&"null"))
}

/// The headings that a schema links to, in the order of its keys.
fn links<'a>(schema: &'a Value, found: &mut Vec<&'a str>) {
    if let Some(target) = target(schema) {
        found.push(target);
    }
    match schema {
        Value::Object(keys) => keys.values().for_each(|value| links(value, found)),
        Value::Array(items) => items.iter().for_each(|value| links(value, found)),
        _ => {}
    }
}

/// A comment without the ends of its lines.
fn comment(schema: &Value) -> String {
    schema["description"]
        .as_str()
        .unwrap_or_default()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// The table of a type, below its heading.
fn table(page: &mut String, level: &str, heading: &str, schema: &Value) {
    let _ = write!(page, "\n{level} {heading}\n\n{}\n\n", comment(schema));
    page.push_str("| key | type | meaning |\n|---|---|---|\n");
    let required: Vec<_> =
        schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    for (key, value) in schema["properties"].as_object().into_iter().flatten() {
        let (word, is_null) = words(value);
        let optional = if required.contains(&key.as_str()) { "" } else { "optional " };
        let null = if is_null { " or null" } else { "" };
        let _ = writeln!(page, "| `{key}` | {optional}{word}{null} | {} |", comment(value));
    }
}

/// The tables of all documents. The table of a part follows the first document that has it.
pub fn tables(schemas: &Value) -> String {
    let mut page = String::new();
    let documents = DOCUMENTS.map(|(name, _)| name);
    let mut printed = Vec::new();
    for document in documents {
        let mut waiting = vec![document];
        while !waiting.is_empty() {
            let heading = waiting.remove(0);
            let is_own = heading == document;
            if printed.contains(&heading) || !is_own && documents.contains(&heading) {
                continue;
            }
            printed.push(heading);
            let schema = &schemas["$defs"][heading];
            let level = if is_own { "##" } else { "###" };
            table(&mut page, level, heading, schema);
            let mut parts = Vec::new();
            links(&schema["properties"], &mut parts);
            waiting.splice(0..0, parts);
        }
    }
    page
}
