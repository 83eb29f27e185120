//! The JSON Schemas of the documents that `--json` prints, as they are stored.

use anyhow::bail;
use mms_spec::suggest::advice;
use serde_json::{Map, Value, json};

/// The schemas of all documents and their parts, made of the types in `mms-documents`.
const STORED: &str = include_str!("../../docs/documents.schema.json");

/// The key of all schemas.
const ALL: &str = "$defs";

/// The JSON Schema of a document, or of a part of one, with the parts that it needs.
///
/// # Errors
/// There is no document of that name.
pub fn document(name: &str) -> anyhow::Result<Value> {
    let stored: Value = serde_json::from_str(STORED)?;
    let Some(all) = stored[ALL].as_object() else { bail!("no schemas are stored") };
    let Some((name, _)) = all.get_key_value(name) else {
        let advice = advice(name, all.keys().map(String::as_str), |_| {
            "docs/reference/json.md lists them".into()
        });
        bail!("`{name}`: no document of that name; {advice}");
    };
    let mut needed = vec![name.as_str()];
    let mut at = 0;
    while let Some(&name) = needed.get(at) {
        links(&all[name], &mut needed);
        at += 1;
    }
    let is_needed = |(name, _): &(&String, &Value)| needed.contains(&name.as_str());
    let parts: Map<_, _> =
        all.iter().filter(is_needed).map(|(name, part)| (name.clone(), part.clone())).collect();
    Ok(json!({
        "$schema": stored["$schema"],
        "title": format!("The document `{name}` of mms"),
        "$ref": format!("#/{ALL}/{name}"),
        ALL: parts,
    }))
}

/// Adds the names of the schemas that a schema links to.
fn links<'a>(schema: &'a Value, found: &mut Vec<&'a str>) {
    match schema {
        Value::Object(keys) => keys.iter().for_each(|(key, value)| match value.as_str() {
            Some(link) if key == "$ref" => {
                let name = link.rsplit('/').next().unwrap_or_default();
                if !found.contains(&name) {
                    found.push(name);
                }
            }
            _ => links(value, found),
        }),
        Value::Array(items) => items.iter().for_each(|item| links(item, found)),
        _ => {}
    }
}
