//! The schema of the value of a key.

use mms_codegen::materials::MATERIALS;
use mms_spec::format::{self, Holds, Key, Length, quantities};
use mms_spec::language::FUNCTIONS;
use mms_spec::names::{AXISYMMETRIC, COORDINATES, INVARIANTS, Keeper, MAX_NAME};
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
        extend(&mut schema, value(&key.holds));
        (key.name.to_string(), schema)
    };
    Value::Object(keys.iter().map(described).collect())
}

fn required(keys: &[Key]) -> Vec<&'static str> {
    keys.iter().filter(|key| key.required).map(|key| key.name).collect()
}

fn value(holds: &Holds) -> Value {
    match holds {
        Holds::Text => json!({ "type": "string" }),
        Holds::Flag => json!({ "type": "boolean" }),
        Holds::Dimension => json!({ "enum": [1, 2, 3] }),
        Holds::Count => whole_number(),
        Holds::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
        Holds::Levels => json!({
            "type": "array",
            "items": whole_number(),
            "minItems": 2,
            "uniqueItems": true,
        }),
        Holds::Quantity => quantity(),
        Holds::Word(words) => json!({ "enum": words() }),
        Holds::Model => model(),
        Holds::Formula => formula(),
        Holds::Formulas(length) => formulas(*length),
        Holds::Table(keys) => table(keys),
        Holds::Tables(keys) => json!({ "type": "array", "items": table(keys) }),
        Holds::Names(keeper, holds) => json!({
            "type": "object",
            "propertyNames": name(*keeper),
            "additionalProperties": value(holds),
        }),
        Holds::Material(keys) => json!({
            "type": "object",
            "properties": properties(keys),
            "required": required(keys),
            "propertyNames": name(Keeper::Material),
            "additionalProperties": formula(),
        }),
        Holds::Vertices => json!({
            "type": "array",
            "items": formulas(Length::Exactly(2)),
            "minItems": 3,
            "maxItems": MAX_VERTICES,
        }),
        Holds::Name => {
            json!({ "type": "string", "pattern": "^[a-z][a-z0-9_]*$", "maxLength": MAX_NAME })
        }
        Holds::Words => json!({
            "type": "array",
            "items": value(&Holds::Name),
            "uniqueItems": true,
        }),
        Holds::Faces => faces(),
        Holds::Rotation(keys) => {
            let mut schema = table(keys);
            schema["type"] = json!(["string", "number", "object"]);
            schema
        }
    }
}

/// A quantity that may have a closed form: one of every field, or any name that no quantity of every field has.
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
fn name(keeper: Keeper) -> Value {
    let others = match keeper {
        Keeper::Field => &[],
        Keeper::Axisymmetric => AXISYMMETRIC,
        Keeper::Material => INVARIANTS,
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
