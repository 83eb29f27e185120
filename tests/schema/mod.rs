//! The JSON Schemas refuse exactly what the reader refuses: on every existing file, and on every file with one mistake in a
//! file that has all keys.

mod mutations;
mod verdict;

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use verdict::{Kind, json_of, reader_accepts};

/// Files whose mistakes of form no JSON Schema can detect.
const BEYOND: &[(&str, &str)] = &[
    ("duplicate_name", "parameters and definitions share one set of names"),
    ("study_orders", "studies of one method are compared"),
    ("given_checks", "closed forms are about quantities that the file defines"),
    ("extreme", "a set names parameters of the same file, and names of extremes differ"),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The TOML files of a folder, in the order of their names.
fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|found| found == "toml")).collect();
    files.sort();
    assert!(!files.is_empty(), "{folder} has no files");
    files
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn stem(path: &Path) -> String {
    path.file_stem().expect("a stem").to_string_lossy().into_owned()
}

/// The keys that a document of the schema may have, also in its tables.
fn keys(schema: &Value) -> Vec<&str> {
    let own = schema["properties"].as_object().into_iter().flatten();
    let mut found: Vec<&str> = own.clone().map(|(key, _)| key.as_str()).collect();
    let within = [&schema["items"], &schema["additionalProperties"]];
    let tables = own.map(|(_, table)| table).chain(within);
    found.extend(tables.filter(|table| table.is_object()).flat_map(keys));
    found
}

#[test]
fn the_guide_names_every_key() {
    let guide = text(&root().join("docs/guide/fields.md"));
    let (_, section) = guide.split_once("## All keys").expect("the section");
    let (section, _) = section.split_once("\n## ").expect("the next one");
    let is_apart = |letter: char| !(letter.is_alphanumeric() || letter == '_');
    let words: Vec<&str> = section.split(is_apart).collect();
    let schema = mms_command::schema::field();
    let keys = keys(&schema);
    assert!(keys.len() > 40, "{keys:?}");
    for key in keys {
        assert!(words.contains(&key), "docs/guide/fields.md does not name `{key}`");
    }
}

#[test]
fn every_right_file_is_accepted() {
    let fields = files("fields").into_iter().map(|path| (Kind::Field, path));
    let materials = files("mms-codegen/materials").into_iter().map(|path| (Kind::Material, path));
    let pass = files("mms-codegen/tests/data/pass").into_iter().map(|path| (Kind::of(&path), path));
    for (kind, path) in fields.chain(materials).chain(pass) {
        let document = json_of(&text(&path)).expect("valid TOML");
        let refusals = kind.refusals(&document);
        assert!(refusals.is_empty(), "{}: {refusals:?}", path.display());
    }
}

/// The schema detects the mistakes that the reader detects, except mistakes that need names resolved and formulas parsed.
#[test]
fn the_wrong_files_are_refused_where_their_form_is_wrong() {
    let mut compared = 0;
    for path in files("mms-codegen/tests/data/fail") {
        let (kind, text, name) = (Kind::of(&path), text(&path), stem(&path));
        let Some(document) = json_of(&text) else { continue };
        let accepts = kind.refusals(&document).is_empty();
        let expected = reader_accepts(kind, &text) || BEYOND.iter().any(|(file, _)| *file == name);
        assert_eq!(accepts, expected, "{name}: {:?}", kind.refusals(&document));
        compared += 1;
    }
    assert!(compared > 40, "only {compared} files are valid TOML");
}

#[test]
fn what_is_said_to_be_beyond_a_schema_is() {
    for (name, _) in BEYOND {
        let path = root().join(format!("mms-codegen/tests/data/fail/{name}.toml"));
        assert!(!reader_accepts(Kind::of(&path), &text(&path)), "{name}");
    }
}

/// Editors use draft 7 if they do not support draft 2020-12; both must mean the same.
#[test]
fn the_schemas_are_valid_and_use_keywords_of_both_drafts() {
    const KNOWN: &[&str] = &[
        "$schema",
        "title",
        "description",
        "type",
        "properties",
        "required",
        "enum",
        "const",
        "additionalProperties",
        "propertyNames",
        "items",
        "minItems",
        "maxItems",
        "uniqueItems",
        "minimum",
        "maximum",
        "exclusiveMinimum",
        "pattern",
        "maxLength",
        "minProperties",
        "not",
        "anyOf",
        "allOf",
        "if",
        "then",
    ];
    for schema in [mms_command::schema::field(), mms_command::schema::material()] {
        jsonschema::draft202012::meta::validate(&schema).expect("valid in draft 2020-12");
        let mut older = schema.clone();
        older["$schema"] = "http://json-schema.org/draft-07/schema#".into();
        jsonschema::draft7::meta::validate(&older).expect("valid in draft 7");
        let mut schemas = vec![&schema];
        while let Some(schema) = schemas.pop() {
            for (keyword, value) in schema.as_object().into_iter().flatten() {
                assert!(KNOWN.contains(&keyword.as_str()), "{keyword}");
                match keyword.as_str() {
                    "properties" => schemas.extend(value.as_object().expect("schemas").values()),
                    "anyOf" | "allOf" => schemas.extend(value.as_array().expect("schemas")),
                    "enum" | "const" | "required" => {}
                    _ => schemas.push(value),
                }
            }
        }
    }
}

#[test]
fn every_key_is_explained() {
    for schema in [mms_command::schema::field(), mms_command::schema::material()] {
        let mut schemas = vec![(String::new(), &schema)];
        while let Some((path, schema)) = schemas.pop() {
            if let Some(properties) = schema["properties"].as_object() {
                for (key, value) in properties {
                    let path = format!("{path}.{key}");
                    let length = value["description"].as_str().map_or(0, str::len);
                    assert!((8..120).contains(&length) || path.contains(".boundary."), "{path}");
                    schemas.push((path, value));
                }
            }
            for inner in ["items", "additionalProperties"] {
                if schema[inner].is_object() {
                    schemas.push((path.clone(), &schema[inner]));
                }
            }
        }
    }
}

/// After a deliberate change: `cargo run -- schema > docs/field.schema.json`, and with
/// `--material` to `docs/material.schema.json`.
#[test]
fn the_committed_schemas_are_what_mms_schema_prints() {
    for (option, file) in [("", "field.schema.json"), (" --material", "material.schema.json")] {
        let arguments = format!("schema{option}");
        let run = std::process::Command::new(env!("CARGO_BIN_EXE_mms"))
            .args(arguments.split_whitespace())
            .output()
            .expect("the program starts");
        assert!(run.status.success());
        let printed = String::from_utf8(run.stdout).expect("UTF-8");
        let committed = fs::read_to_string(root().join("docs").join(file)).unwrap_or_default();
        assert!(
            printed == committed,
            "docs/{file} is not what `mms {arguments}` prints; after a look at the difference:\n    \
             cargo run -- {arguments} > docs/{file}"
        );
    }
}
