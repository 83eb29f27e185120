//! `mms list`, `mms show`, and the command line itself.

use mms::gallery::FIELDS;
use mms_codegen::compile::MATERIALS;
use mms_runtime::{IntegratorName, ShapeName};
use serde_json::json;

use super::mms::{Folder, keys};

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
fn show_has_every_quantity_the_material_and_the_claims() {
    let run = Folder::new().mms("show bar_1d").exits(0);
    run.prints("bar_1d: Body force on a 1D bar").prints("Wallstedt & Guilkey");
    run.prints("neo_hookean").prints("x_min: fixed").prints("x_max: free");
    for symbol in ["u", "v", "a", "H", "F", "J", "W", "P", "sigma", "tau", "b"] {
        run.prints(&format!("\n  {symbol} = "));
    }
}

#[test]
fn show_takes_short_names() {
    let document = Folder::new().mms("show bar_1d --quantity b,P --json").exits(0).json();
    assert_eq!(keys(&document["quantities"]), ["first_piola_kirchhoff", "body_force"]);
}

#[test]
fn show_of_a_file_is_that_of_the_gallery() {
    let folder = Folder::with_bar("copy.toml");
    let (named, copied) = (folder.mms("show bar_1d").exits(0), folder.mms("show copy.toml"));
    assert_eq!(copied.exits(0).stdout, named.stdout.replacen("bar_1d:", "copy:", 1));
}

#[test]
fn show_refuses_unknown_names_with_a_suggestion() {
    let folder = Folder::new();
    folder.mms("show bar_1").exits(2).complains("did you mean `bar_1d`?");
    let run = folder.mms("show bar_1d --quantity body_forc").exits(2);
    run.complains("did you mean `body_force`?").prints_nothing();
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
