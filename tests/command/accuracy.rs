//! `mms accuracy`: the errors, their printed form, and refusals.

use serde_json::Value;

use super::mms::{BAR, Folder, keys};

const KEYS: [&str; 14] = [
    "quantity",
    "precision",
    "form",
    "regime",
    "median_eps",
    "p99_eps",
    "max_eps",
    "max_scaled_eps",
    "compared",
    "not_finite",
    "overflowed",
    "undefined",
    "within_bound",
    "ns_per_point",
];

fn rows(document: &Value) -> &[Value] {
    document["rows"].as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn the_document_has_a_row_for_each_precision_and_form() {
    let arguments = "accuracy bar_1d --quantity body_force --regime declared --points 20 --json";
    let document = Folder::new().mms(arguments).exits(0).json();
    assert_eq!(keys(&document), ["field", "points", "bound_eps", "rows", "left_out", "provenance"]);
    assert_eq!(
        (document["field"].as_str(), document["points"].as_u64()),
        (Some("bar_1d"), Some(20))
    );
    let names: Vec<_> = rows(&document)
        .iter()
        .map(|row| ["precision", "form"].map(|key| row[key].as_str().unwrap_or_default()).join(" "))
        .collect();
    let expected = ["f32 stable", "f32 fast", "f64 stable", "f64 fast", "wide stable", "wide fast"];
    assert_eq!(names, expected);
    for row in rows(&document) {
        assert_eq!(keys(row), KEYS);
        assert!(row["max_scaled_eps"].as_f64().is_some_and(|eps| eps < 64.0), "{row}");
        assert!(row["ns_per_point"].is_null());
    }
}

#[test]
fn only_what_is_wanted_is_measured() {
    let folder = Folder::new();
    let arguments = "accuracy bar_1d --quantity P --regime declared --points 8";
    let all = folder.mms(&format!("{arguments} --json")).exits(0).json();
    let some = "--precision wide,f32 --form stable --json --output some";
    let document = folder.mms(&format!("{arguments} {some}")).exits(0).json();
    let ways = |row: &Value| [row["precision"].clone(), row["form"].clone()];
    let found: Vec<_> = rows(&document).iter().map(ways).collect();
    assert_eq!(found, [["f32", "stable"], ["wide", "stable"]]);
    // They are the rows of `all`.
    for row in rows(&document) {
        let same = rows(&all).iter().find(|it| ways(it) == ways(row)).expect("the same row");
        assert_eq!(row["max_scaled_eps"], same["max_scaled_eps"]);
    }
    folder.mms("report some").exits(0);
    let page = folder.read("some/report.html");
    assert!(page.contains("wide, stable") && !page.contains("f64, stable"), "{page}");
}

#[test]
fn a_fields_own_extreme_is_a_regime() {
    let folder = Folder::new();
    let own = "\n[[extreme]]\nname = \"soft\"\nset = { young = 1e-3 }\n";
    folder.write("soft.toml", &format!("{BAR}{own}"));
    let arguments = "accuracy soft.toml --quantity P --regime soft --points 8 --json";
    let document = folder.mms(arguments).exits(0).json();
    assert_eq!(rows(&document).len(), 6);
    assert!(rows(&document).iter().all(|row| row["regime"] == "soft"));
}

#[test]
fn what_cannot_be_made_is_left_out_with_the_reason() {
    let run = Folder::new()
        .mms("accuracy generalized_vortex --quantity J --regime jacobian_1e-3 --points 8");
    let stdout = run.exits(1).stdout;
    assert!(stdout.contains("left out: jacobian_1e-3: J lies between"), "{stdout}");
    assert!(stdout.contains("\nnothing was measured"), "{stdout}");
}

/// Div P of this shear is 0, because its u is the real part of an analytic function, but no formula shows it.
const HARMONIC: &str = r#"
[field]
title = "t"
dimension = 3
[parameters]
rho0 = { value = 1000 }
amplitude = { value = 0.1 }
[displacement]
u = ["0", "0", "amplitude*sqrt(sqrt(X^2 + Y^2))*sin(atan2(Y, X)/2)"]
[material]
model = "neo_hookean"
lambda = "6e5"
mu = "4e5"
density = "rho0"
[domain]
shape = "box"
lower = [1, 1, 0]
upper = [2, 2, 1]
time = [0, 1]
"#;

#[test]
fn a_quantity_that_cannot_be_measured_hides_no_other() {
    let folder = Folder::new();
    folder.write("harmonic.toml", HARMONIC);
    let command = "accuracy harmonic.toml --regime declared --precision f64 --points 8 --json";
    let document = folder.mms(&format!("{command} --quantity u,div_p,P")).exits(0).json();
    let named = |list: &str| -> Vec<String> {
        let list = document[list].as_array().expect("a list").iter();
        list.map(|it| it["quantity"].as_str().expect("a name").to_owned()).collect()
    };
    let [u, stress] = ["displacement", "first_piola_kirchhoff"];
    assert_eq!(named("rows"), [u, u, stress, stress]);
    assert_eq!(document["left_out"].as_array().map(Vec::len), Some(1));
    let left_out = &document["left_out"][0];
    assert!(left_out["reason"].as_str().is_some_and(|it| it.contains("1233 digits")), "{left_out}");
    // A promise that was not tested is not kept.
    let command = command.replace("--json", "--quantity div_p");
    folder.mms(&command).exits(1).prints("nothing was measured of the field as declared");
}

#[test]
fn names_that_do_not_exist_are_refused_with_those_that_do() {
    let folder = Folder::new();
    for (arguments, message) in [
        ("accuracy bar_1d --regime declred", "did you mean `declared`?"),
        ("accuracy bar_1d --regime nothing_like_it", "there are declared, displacement_1e-4"),
        ("accuracy bar_2d", "did you mean `bar_1d`?"),
        ("accuracy bar_1d --precision f16", "[possible values: f32, f64, wide]"),
        ("accuracy bar_1d --form fst", "did you mean `fast`?"),
        ("accuracy bar_1d --set young", "expected name=value"),
        ("accuracy bar_1d --set yung=2", "did you mean `young`?"),
    ] {
        let run = folder.mms(arguments).exits(2);
        assert!(run.stderr.contains(message), "{arguments}: {}", run.stderr);
    }
    folder.mms("accuracy bar_1d --points 0").exits(2);
}

#[test]
fn the_picture_needs_times_and_they_a_compiler() {
    let folder = Folder::new();
    let run = folder
        .mms("accuracy bar_1d --quantity body_force --regime declared --points 8 --json -o out")
        .exits(0);
    let timed = !run.stderr.contains("no times: ");
    for row in rows(&run.json()) {
        assert_eq!(row["ns_per_point"].as_f64().is_some(), timed, "{}", run.stderr);
    }
    assert!(folder.path("out/accuracy.json").is_file());
    assert_eq!(folder.path("out/accuracy.svg").is_file(), timed);
    if timed {
        let picture = folder.read("out/accuracy.svg");
        roxmltree::Document::parse(&picture).expect("well-formed");
        assert!(picture.contains("Pareto front") && picture.contains("wide"));
    }
}

/// The root has no value anywhere in the body.
#[test]
fn what_has_no_value_anywhere_is_not_measured_and_is_no_pass() {
    let folder = Folder::new();
    let before = &BAR[..BAR.find("[boundary]").expect("claims")];
    let u = "X*(2*length - X)/length^2 * A";
    assert!(before.contains(u));
    folder.write("root.toml", &before.replace(u, &format!("{u}*sqrt(X/length - 2)")));
    let command = "accuracy root.toml --quantity u --regime declared --form stable --points 8";
    let run = folder.mms(command).exits(1);
    run.prints("not measured").prints("no component has a real value");
    let document = folder.mms(&format!("{command} --json")).exits(1).json();
    for row in document["rows"].as_array().expect("rows") {
        assert_eq!(row["compared"], 0, "{row}");
        for key in ["median_eps", "p99_eps", "max_eps", "max_scaled_eps", "within_bound"] {
            assert!(row[key].is_null(), "{key}: {row}");
        }
    }
}
