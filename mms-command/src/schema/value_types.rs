//! The schema of the value of a key.

use mms_codegen::materials::MATERIALS;
use mms_spec::format::{self, Key, Length, ValueType, quantities};
use mms_spec::language::FUNCTIONS;
use mms_spec::names::{AXISYMMETRIC, COORDINATES, INVARIANTS, MAX_NAME, ReservingFile};
use mms_spec::quantity::Quantity;
use mms_spec::{Claim, Face, MAX_COUNT, MAX_VERTICES};
use serde_json::{Map, Value, json};

/// Adds the keywords of one schema to another.
pub fn extend(schema: &mut Value, more: Value) {
    if let (Value::Object(schema), Value::Object(more)) = (schema, more) {
        schema.extend(more);
    }
}

/// A table that has these keys and no others.
pub fn table(keys: &[Key]) -> Value {
    json!({
        "type": "object",
        "properties": properties(keys),
        "required": required(keys),
        "additionalProperties": false,
    })
}

/// An array of exactly `components` values.
pub fn count(components: usize) -> Value {
    json!({ "minItems": components, "maxItems": components })
}

fn properties(keys: &[Key]) -> Value {
    let described = |key: &Key| {
        let mut schema = json!({ "description": key.doc });
        extend(&mut schema, value(&key.value_type));
        (key.name.to_string(), schema)
    };
    Value::Object(keys.iter().map(described).collect())
}

fn required(keys: &[Key]) -> Vec<&'static str> {
    keys.iter().filter(|key| key.required).map(|key| key.name).collect()
}

fn value(value_type: &ValueType) -> Value {
    match value_type {
        ValueType::Text => json!({ "type": "string" }),
        ValueType::Flag => json!({ "type": "boolean" }),
        ValueType::Dimension => json!({ "enum": [1, 2, 3] }),
        ValueType::Count => whole_number(),
        ValueType::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
        ValueType::Levels => json!({
            "type": "array",
            "items": whole_number(),
            "minItems": 2,
            "uniqueItems": true,
        }),
        ValueType::Quantity => quantity(),
        ValueType::Word(words) => json!({ "enum": words() }),
        ValueType::Model => model(),
        ValueType::Formula => formula(),
        ValueType::Formulas(length) => formulas(*length),
        ValueType::Table(keys) => table(keys),
        ValueType::Tables(keys) => json!({ "type": "array", "items": table(keys) }),
        ValueType::Names(file, of_each) => json!({
            "type": "object",
            "propertyNames": name(*file),
            "additionalProperties": value(of_each),
        }),
        ValueType::Material(keys) => json!({
            "type": "object",
            "properties": properties(keys),
            "required": required(keys),
            "propertyNames": name(ReservingFile::Material),
            "additionalProperties": formula(),
        }),
        ValueType::Vertices => json!({
            "type": "array",
            "items": formulas(Length::Exactly(2)),
            "minItems": 3,
            "maxItems": MAX_VERTICES,
        }),
        ValueType::Name => {
            json!({ "type": "string", "pattern": "^[a-z][a-z0-9_]*$", "maxLength": MAX_NAME })
        }
        ValueType::Words => json!({
            "type": "array",
            "items": value(&ValueType::Name),
            "uniqueItems": true,
        }),
        ValueType::Faces => faces(),
        ValueType::Rotation(keys) => {
            let mut schema = table(keys);
            schema["type"] = json!(["string", "number", "object"]);
            schema
        }
    }
}

/// A quantity that may have a closed form: one that every field has, or a name that the file defines. The names of other built-in
/// quantities are refused.
fn quantity() -> Value {
    let known = quantities();
    let is_other = |quantity: &Quantity| !known.contains(&quantity.name());
    let all = Quantity::ALL.iter().chain(Quantity::ON_REQUEST);
    let others: Vec<_> = all.filter(|it| is_other(it)).map(|it| it.name()).collect();
    json!({
        "anyOf": [
            { "enum": known },
            { "type": "string", "pattern": "^[A-Za-z_][A-Za-z0-9_]*$", "not": { "enum": others } },
        ]
    })
}

fn whole_number() -> Value {
    json!({ "type": "integer", "minimum": 1, "maximum": MAX_COUNT })
}

fn formula() -> Value {
    json!({ "type": ["string", "number"] })
}

fn formulas(length: Length) -> Value {
    let (least, most) = match length {
        Length::Dimension => (1, 3),
        Length::Quantity => (1, 9),
        Length::Exactly(length) => (length, length),
    };
    json!({ "type": "array", "items": formula(), "minItems": least, "maxItems": most })
}

fn model() -> Value {
    let stems: Vec<_> = MATERIALS.iter().map(|(stem, _)| *stem).collect();
    json!({ "anyOf": [{ "enum": stems }, { "type": "string", "pattern": "\\.toml$" }] })
}

/// The names that a file may define.
fn name(file: ReservingFile) -> Value {
    let others = match file {
        ReservingFile::Field => &[],
        ReservingFile::Axisymmetric => AXISYMMETRIC,
        ReservingFile::Material => INVARIANTS,
    };
    let given = COORDINATES.iter().chain(others).map(|(name, _)| *name);
    let reserved: Vec<_> = given.chain(FUNCTIONS.iter().copied()).collect();
    json!({
        "pattern": "^[A-Za-z_][A-Za-z0-9_]*$",
        "maxLength": MAX_NAME,
        "not": { "enum": reserved },
    })
}

fn faces() -> Value {
    let claim = |face: &Face| {
        let claims = Claim::about(*face);
        let meanings = claims.iter().map(|claim| format!("{}: {}", claim.name(), claim.meaning()));
        let meanings: Vec<_> = meanings.collect();
        let claim = json!({ "description": meanings.join("; "), "enum": format::claims(*face) });
        (face.name().to_string(), claim)
    };
    let properties: Map<_, _> = Face::ALL.iter().map(claim).collect();
    // The edges of a polygon have names of their own.
    json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": { "enum": format::claims(Face::Outer) },
        "propertyNames": { "pattern": "^[a-z][a-z0-9_]*$" },
    })
}
