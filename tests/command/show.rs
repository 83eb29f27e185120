//! `mms show`.

use mms_spec::quantity::Quantity;
use serde_json::json;

use super::mms::{Folder, keys};

#[test]
fn show_has_every_quantity_the_material_and_the_claims() {
    let run = Folder::new().mms("show bar_1d").exits(0);
    run.prints("bar_1d: Body force on a 1D bar").prints("Wallstedt & Guilkey");
    run.prints("neo_hookean").prints("x_min: fixed").prints("x_max: free");
    for symbol in ["u", "v", "a", "H", "F", "J", "W", "P", "\u{3c3}", "\u{3c4}", "Div P", "b"] {
        run.prints(&format!("\n  {symbol} = "));
    }
}

#[test]
fn the_bar_reads_like_the_slides() {
    let run = Folder::new().mms("show bar_1d").exits(0);
    run.prints("c = \u{221a}(young/\u{3c1}\u{2080})");
    run.prints("u = A\u{b7}X\u{b7}(2\u{b7}length \u{2212} X)/length\u{b2}");
    run.prints("F = 1 + 2\u{b7}A\u{b7}(length \u{2212} X)/length\u{b2}");
    run.prints("P = young\u{b7}(F \u{2212} 1/F)/2");
    run.prints("Div P = \u{2212}young\u{b7}A\u{b7}(1 + 1/F\u{b2})/length\u{b2}");
}

#[test]
fn show_takes_short_names_and_the_order_of_derivation() {
    let document = Folder::new().mms("show bar_1d --quantity b,P --json").exits(0).json();
    assert_eq!(keys(&document["quantities"]), ["first_piola_kirchhoff", "body_force"]);
}

#[test]
fn show_lists_what_one_quantity_uses() {
    let document = Folder::new().mms("show bar_1d --quantity P --json").exits(0).json();
    let stress = &document["quantities"]["first_piola_kirchhoff"];
    assert_eq!(keys(stress), ["symbols", "where", "formula", "operations"]);
    assert_eq!(stress["symbols"], json!(["P"]));
    assert_eq!(keys(&stress["where"]), ["F"]);
    assert_eq!(stress["formula"], json!(["young*(F - 1/F)/2"]));
}

#[test]
fn show_as_a_document_has_its_keys() {
    let document = Folder::new().mms("show bar_1d --json").exits(0).json();
    let expected = [
        "field",
        "title",
        "dimension",
        "reference",
        "material",
        "strain_energy",
        "material_parameters",
        "rest_stress",
        "moduli_at_rest",
        "transverse_moduli_at_rest",
        "extent",
        "shortest_wavelength",
        "density",
        "definitions",
        "boundary",
        "quantities",
        "operations",
        "visibility",
    ];
    assert_eq!(keys(&document), expected);
    let quantities = Quantity::ALL.iter().map(|quantity| quantity.name());
    assert_eq!(keys(&document["quantities"]), quantities.collect::<Vec<_>>());
    assert_eq!(document["material_parameters"], json!({ "lambda": "0", "mu": "young/2" }));
    assert_eq!(keys(&document["definitions"]), ["c", "A"]);
}

#[test]
fn the_bar_says_what_it_does_not_see() {
    let run = Folder::new().mms("show bar_1d").exits(0);
    run.prints("not seen, since it is zero:\n");
    run.prints("    initial velocity: v = 0 at the first time");
    run.prints("    parameter lambda: b does not depend on it");
    run.prints("    traction on x_max: P N = 0 there");
    let visibility = Folder::new().mms("show bar_1d --json").exits(0).json()["visibility"].clone();
    assert_eq!(visibility["span"], "quadratic");
    assert_eq!(visibility["exact_in_time"], false);
    assert_eq!(visibility["symmetric_gradient"], true);
    let absent: Vec<_> = visibility["absent"].as_array().expect("a list").clone();
    let lambda = absent.iter().find(|found| found["term"] == "parameter.lambda");
    assert_eq!(lambda.expect("lambda")["how"], "zero");
    let present: Vec<_> = visibility["present"].as_array().expect("a list").clone();
    for term in ["acceleration", "volume_change", "parameter.mu", "traction.x_min"] {
        assert!(present.contains(&json!(term)), "{term} in {present:?}");
    }
}

#[test]
fn one_quantity_comes_without_what_the_field_sees() {
    let document = Folder::new().mms("show bar_1d --quantity b --json").exits(0).json();
    assert_eq!(document["visibility"], json!(null));
}

#[test]
fn show_of_a_file_is_that_of_the_gallery() {
    let folder = Folder::with_bar("copy.toml");
    let (named, copied) = (folder.mms("show bar_1d").exits(0), folder.mms("show copy.toml"));
    assert_eq!(copied.exits(0).stdout, named.stdout.replacen("bar_1d:", "copy:", 1));
}

#[test]
fn show_writes_pages_of_latex_and_mathml() {
    let folder = Folder::new();
    folder.mms("show bar_1d --format latex").exits(0).prints("\\begin{document}");
    folder.mms("show bar_1d --format mathml").exits(0).prints("<math display=\"block\"");
    let text = folder.mms("show bar_1d --format text").exits(0);
    assert_eq!(text.stdout, folder.mms("show bar_1d").exits(0).stdout);
}

#[test]
fn show_refuses_unknown_names_with_a_suggestion() {
    let folder = Folder::new();
    folder.mms("show bar_1").exits(2).complains("did you mean `bar_1d`?");
    let run = folder.mms("show bar_1d --quantity body_forc").exits(2);
    run.complains("did you mean `body_force`?").prints_nothing();
    folder.mms("show bar_1d --format word").exits(2).complains("possible values: text, latex");
}

#[test]
fn show_prints_one_thing_at_a_time() {
    let folder = Folder::new();
    for arguments in
        ["--format latex --json", "--script sympy --json", "--script sympy --quantity b"]
    {
        let run = folder.mms(&format!("show bar_1d {arguments}")).exits(2);
        run.complains("cannot be used with").prints_nothing();
    }
}

#[test]
fn a_script_needs_points_where_the_field_is_defined() {
    let folder = Folder::with_bar("bar.toml");
    // A motion that is not defined in the bar.
    let motion = "X*(2*length - X)/length^2 * A";
    let text = folder.read("bar.toml").replace(motion, "A*exp(exp(100 + X/length))");
    let text = text.replace("\"fixed\"", "\"prescribed\"").replace("\"free\"", "\"traction\"");
    folder.write("bar.toml", &text);
    let run = folder.mms("show bar.toml --script sympy").exits(2);
    run.complains("nothing to compare").prints_nothing();
}

#[test]
fn operations_are_counted_before_and_after_by_stage_and_by_kind() {
    let folder = Folder::new();
    for quantities in ["body_force", "body_force,P", "all"] {
        let run = folder.mms(&format!("show bar_1d --quantity {quantities} --json")).exits(0);
        let operations = &run.json()["operations"];
        let count = |value: &serde_json::Value| value.as_u64().expect("a count");
        let sum = |key: &str| -> u64 {
            operations[key].as_object().expect("an object").values().map(count).sum()
        };
        let (before, after) = (count(&operations["before"]), count(&operations["after"]));
        assert!(0 < after && after <= before, "{operations}");
        assert_eq!(sum("by_stage"), after, "{operations}");
        assert_eq!(sum("by_kind"), after, "{operations}");
        let stages: Vec<_> =
            operations["by_stage"].as_object().expect("an object").keys().collect();
        assert_eq!(stages, ["parameter", "point", "point_time", "time"]);
    }
    // The cost of one quantity is the cost of its own program.
    let run = folder.mms("show bar_1d --quantity b --json").exits(0);
    let document = run.json();
    let alone = &document["quantities"]["body_force"]["operations"]["total"];
    assert_eq!(document["operations"]["after"], *alone);
}
