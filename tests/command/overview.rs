//! `mms list`, and the command line itself.

use mms::gallery::FIELDS;
use mms_codegen::compile::MATERIALS;
use mms_runtime::{IntegratorName, ShapeName};
use serde_json::json;

use super::mms::Folder;

#[test]
fn list_names_every_field_material_and_method() {
    let run = Folder::new().mms("list").exits(0);
    let fields = FIELDS.iter().map(|entry| entry.name);
    let materials = MATERIALS.iter().map(|(stem, _)| *stem);
    let methods = ShapeName::NAMES.iter().chain(IntegratorName::NAMES).copied();
    for name in fields.chain(materials).chain(methods) {
        run.prints(name);
    }
}

#[test]
fn list_as_a_document_has_the_same_names() {
    let document = Folder::new().mms("list --json").exits(0).json();
    let fields = document["fields"].as_array().expect("fields").iter();
    let fields: Vec<_> = fields.map(|field| field["name"].as_str().expect("a name")).collect();
    assert_eq!(fields, FIELDS.iter().map(|entry| entry.name).collect::<Vec<_>>());
    assert_eq!(document["shapes"], json!(ShapeName::NAMES));
    assert_eq!(document["integrators"], json!(IntegratorName::NAMES));
    let materials: Vec<_> = MATERIALS.iter().map(|(stem, _)| *stem).collect();
    assert_eq!(document["materials"], json!(materials));
}

#[test]
fn bad_usage_exits_2_and_prints_nothing() {
    for arguments in [
        "nonsense",
        "--nonsense",
        "list extra",
        "show",
        "check",
        "study",
        "eval",
        "new",
        "schema extra",
    ] {
        Folder::new().mms(arguments).exits(2).complains("error:").prints_nothing();
    }
}

#[test]
fn help_and_version_exit_0() {
    let help = Folder::new().mms("--help").exits(0);
    for command in ["list", "show", "check", "eval", "study", "new", "schema"] {
        help.prints(command);
    }
    Folder::new().mms("--version").exits(0).prints(env!("CARGO_PKG_VERSION"));
}
