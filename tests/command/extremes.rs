//! `mms extremes`: the cases that fail, and their messages.

use serde_json::Value;

use super::mms::{Folder, assert_close, keys};

/// The document of some rows of the bar.
fn document(options: &str, code: i32) -> Value {
    Folder::new().mms(&format!("extremes bar_1d --quick --json {options}")).exits(code).json()
}

fn row<'a>(document: &'a Value, name: &str) -> &'a Value {
    let rows = document["rows"].as_array().expect("rows");
    rows.iter().find(|row| row["name"] == name).unwrap_or_else(|| panic!("no row {name}"))
}

#[test]
fn every_row_of_the_bar_is_as_theory_expects() {
    let document = document("", 0);
    let own = ["field", "method", "quick", "declared_l2", "rows", "stability", "unexpected"];
    assert_eq!(keys(&document), [&own[..], &["provenance"]].concat());
    assert_eq!(document["unexpected"], Value::Array(Vec::new()));
    for row in document["rows"].as_array().expect("rows") {
        let own = [
            "name",
            "setting",
            "theory",
            "allowed_factor",
            "allowed_diagnoses",
            "l2",
            "bound",
            "diagnosis",
            "reason",
            "verdict",
            "expected",
        ];
        assert_eq!(keys(row), own);
        // A row has an error within its bound, or a reason.
        match row["l2"].as_f64() {
            Some(error) => {
                assert!(row["bound"].as_f64().is_some_and(|bound| error <= bound), "{row:#}")
            }
            None => {
                assert!(row["reason"].as_str().is_some_and(|reason| !reason.is_empty()), "{row:#}")
            }
        }
    }
    // Units change only rounding, and the error of a small motion is proportional to the motion.
    let declared = document["declared_l2"].as_f64().expect("an error");
    for name in ["units/soft", "units/stiff", "units/small", "units/large"] {
        assert_close(row(&document, name)["l2"].as_f64().expect("an error"), declared, 1e-9);
    }
    let [small, smaller] = ["displacement/1e-8", "displacement/1e-12"];
    let [small, smaller] =
        [small, smaller].map(|name| row(&document, name)["l2"].as_f64().expect("an error"));
    assert_close(small, smaller, 1e-3);
    for (name, diagnosis) in [("grid/beyond", "too_large"), ("courant/2", "unstable_step")] {
        assert_eq!(row(&document, name)["diagnosis"], diagnosis);
    }
}

/// A cell in space may hold 1000 times the material of a bar that is pressed in its middle. No bound is claimed for such a
/// grid, and rounding decides whether the bar turns inside out (for every other Courant number from 0.395 to 0.405). A grid
/// that moves with the material follows the same motion in second order.
#[test]
fn a_nearly_inverted_body_is_within_its_bound_or_the_grid_is_said_to_be_too_coarse() {
    let folder = Folder::new();
    let verdicts = |field: &str| {
        let command = format!("extremes {field} --quick --json --row inversion");
        let document = folder.mms(&command).exits(0).json();
        let verdicts = document["rows"].as_array().expect("rows").iter();
        verdicts.map(|row| row["verdict"].as_str().expect("a word").to_owned()).collect::<Vec<_>>()
    };
    let coarse = verdicts("periodic_bar");
    assert_eq!(coarse.len(), 2);
    assert!(coarse.iter().all(|it| ["unresolved", "stops"].contains(&it.as_str())), "{coarse:?}");
    let study = "study periodic_bar --set amplitude=0.1575 --cells 16,32,64";
    folder.mms(study).exits(1);
    folder.mms(&format!("{study} --formulation total --shape linear --courant 0.013")).exits(0);
    assert_eq!(verdicts("bar_1d"), ["within bound"; 2]);
    // Its J is least at a corner of body and time window, where no random point is.
    assert!(verdicts("axis_aligned_1d").iter().all(|verdict| verdict != "left out"));
}

/// In the interior of an endless grid theory and bisection agree; faces may be less stable.
#[test]
fn the_largest_stable_courant_number_is_that_of_theory() {
    let methods = [
        ("--formulation total --shape linear", 0.756),
        ("--formulation total --shape linear --particles-per-cell 1", 0.707),
        ("--formulation total --shape linear --integrator musl", 1.732),
        ("--formulation total --shape linear --transfer apic", 1.0),
        ("--formulation total --shape linear --transfer pic", 0.791),
    ];
    for (method, limit) in methods {
        let document = document(&format!("--row stability {method}"), 0);
        let found = &document["stability"][0];
        assert_close(found["theory"].as_f64().expect("a number"), limit, 1e-3);
        assert_close(found["measured"].as_f64().expect("a number"), limit, 0.05);
        assert_eq!(found["verdict"], "as in the interior", "{method}");
    }
}

/// A step between the proved stable step and the largest stable step; a row with its own Courant number names its purpose
/// itself.
#[test]
fn an_unstable_step_is_run_where_it_is_allowed() {
    let rows = "--row units/soft --row courant/2 --formulation total --shape linear --courant 0.75";
    let folder = Folder::new();
    let run = folder.mms(&format!("extremes bar_1d --quick {rows}")).exits(3);
    run.complains("does not run as declared").complains("the stable one").prints_nothing();
    let document = document(&format!("{rows} --allow-unstable"), 0);
    assert_eq!(row(&document, "units/soft")["verdict"], "within bound");
    assert_eq!(row(&document, "courant/2")["diagnosis"], "unstable_step");
}

/// The options work as in any command: parameters that are set, and a motion on top.
#[test]
fn the_field_is_taken_as_it_is_asked_for() {
    let declared = |options: &str| {
        let rows = "--row units/soft --row displacement/1e-8 --row grid/beyond --row stability";
        let document = document(&format!("{rows} {options}"), 0);
        document["declared_l2"].as_f64().expect("an error")
    };
    let plain = declared("");
    assert_ne!(declared("--set amplitude=0.1"), plain);
    assert_ne!(declared("--rigid"), plain);
}

#[test]
fn what_is_printed_is_written_too() {
    let folder = Folder::new();
    let run = folder.mms("extremes bar_1d --quick --row units/soft --json --output found").exits(0);
    let written: Value = serde_json::from_str(&folder.read("found/extremes.json")).expect("JSON");
    assert_eq!(written, run.json());
    assert_eq!(written["provenance"]["kind"], "extremes");
}

#[test]
fn a_field_that_cannot_be_put_somewhere_says_why() {
    let folder = Folder::new();
    let ring =
        "extremes expanding_ring --shape cpdi --quick --row origin --row incompressible/0.49";
    folder
        .mms(ring)
        .exits(1)
        .prints("nothing was measured")
        .prints("left out")
        .prints("an annulus lies about the origin");
}

#[test]
fn what_makes_no_sense_is_refused_with_the_reason() {
    let folder = Folder::new();
    let cases = [
        ("extremes", "FIELD", 2),
        ("extremes bar", "no field `bar`", 2),
        ("extremes bar_1d --row units/sof", "did you mean `units/soft`?", 2),
        ("extremes bar_1d --row 12", "there are displacement/1e-4", 2),
        ("extremes bar_1d --courant 0", "expected a positive number", 2),
        ("extremes bar_1d --courant 5", "does not run as declared", 3),
        ("extremes bar_1d --formulation total --shape linear --courant 0.9", "the stable one", 3),
        (
            "extremes bar_1d --formulation total --shape linear --courant 0.9 --allow-unstable",
            "is inverted",
            3,
        ),
        ("extremes bar_1d --particles-per-cell 3x3", "2 numbers for 1 dimension", 2),
        ("extremes bar_1d --set amplitud=1", "did you mean `amplitude`?", 2),
        ("extremes bar_1d --max-nodes 10", "--max-nodes", 2),
    ];
    for (arguments, reason, code) in cases {
        folder.mms(arguments).exits(code).complains(reason).prints_nothing();
    }
}

#[test]
fn a_field_that_can_be_put_nowhere_is_not_measured() {
    let command = "extremes expanding_ring --shape cpdi --quick --row origin --json";
    let document = Folder::new().mms(command).exits(1).json();
    assert_eq!(document["unexpected"], serde_json::json!(["nothing was measured"]));
}
