//! The JSON Schemas of field files, of material files and of documents, for editors.
//!
//! Schemas of files are made from the table of keys that the reader uses ([`mms_spec::format`]) and from the reader's own lists
//! of words. They agree with the reader in everything that JSON Schema can express; the rest (the meaning of a formula, whether
//! a name is defined, whether cells increase) is left to `mms check`.
//!
//! The dialect is draft 2020-12. Since editors lag behind, only keywords are used that meant the
//! same in draft 7, and no references.

mod conditions;
pub mod documents;
mod value_types;

use mms_spec::format::{FIELD_FILE, Key, MATERIAL_FILE};
use serde_json::{Value, json};

/// The JSON Schema of a field file.
pub fn field() -> Value {
    let mut schema =
        document("Field file of mms", "One manufactured solution, format 1.", FIELD_FILE);
    schema["allOf"] = conditions::of_field();
    schema
}

/// The JSON Schema of a material file.
pub fn material() -> Value {
    let description = "One strain-energy density, format 1.";
    document("Material file of mms", description, MATERIAL_FILE)
}

fn document(title: &str, description: &str, keys: &[Key]) -> Value {
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "description": description,
    });
    value_types::extend(&mut schema, value_types::table(keys));
    schema
}
