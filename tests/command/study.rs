//! `mms study`: its document, and how it ends.

use serde_json::Value;

use super::mms::{BAR, Folder, keys};

/// The document of a study of the gallery's bar that ends with this exit code.
fn document(arguments: &str, code: i32) -> Value {
    Folder::new().mms(&format!("study bar_1d --json {arguments}")).exits(code).json()
}

#[test]
fn the_document_has_the_promised_keys_in_their_order() {
    let document = document("--cells 8,16", 0);
    assert_eq!(
        keys(&document),
        ["field", "method", "levels", "expected_order", "observed_order", "verdict"]
    );
    assert_eq!(
        keys(&document["method"]),
        [
            "shape",
            "integrator",
            "formulation",
            "transfer",
            "flip_fraction",
            "precision",
            "particles_per_cell",
            "fill",
            "jitter",
            "seed",
            "offset",
            "periodic",
            "courant",
            "time_step",
            "end_time",
        ]
    );
    let level = [
        "cells",
        "cell_size",
        "time_step",
        "steps",
        "particles",
        "l1",
        "l2",
        "linf",
        "order_l1",
        "order_l2",
        "order_linf",
        "seconds",
        "failure",
    ];
    assert_eq!(keys(&document["levels"][0]), level);
    assert_eq!(keys(&document["levels"][1]), level);
}

#[test]
fn the_first_level_has_no_orders_and_the_next_have_theirs() {
    let document = document("--cells 8,16,32", 0);
    for norm in ["l1", "l2", "linf"] {
        let order = |level: usize| document["levels"][level][&format!("order_{norm}")].as_f64();
        let error = |level: usize| document["levels"][level][norm].as_f64().expect("an error");
        assert_eq!(order(0), None);
        for level in [1, 2] {
            let expected = (error(level - 1) / error(level)).log2();
            let order = order(level).expect("an order");
            assert!((order - expected).abs() < 1e-12, "{norm}: {order}, {expected}");
        }
    }
    assert_eq!(document["observed_order"], document["levels"][2]["order_l2"]);
    assert_eq!(document["expected_order"], 2.0);
    assert_eq!(document["verdict"], "pass");
}

#[test]
fn a_level_that_stops_has_null_errors_and_the_others_have_theirs() {
    // Above the stable time step, the run with the most steps is inverted before its end.
    let document = document("--cells 8,32,16 --courant 0.8", 1);
    let stopped = &document["levels"][2];
    assert_eq!(stopped["cells"], 32, "levels are sorted from coarse to fine");
    for key in ["l1", "l2", "linf", "order_l1", "order_l2", "order_linf"] {
        assert!(stopped[key].is_null(), "{key}: {document:#}");
        assert!(document["levels"][1][key].is_f64(), "{document:#}");
    }
    let failure = stopped["failure"].as_str().expect("a reason");
    for part in ["step", "time", "particle", "inverted", "try a smaller Courant number"] {
        assert!(failure.contains(part), "{failure}");
    }
    assert_eq!(document["verdict"], "fail");
}

#[test]
fn a_study_whose_every_level_stops_exits_1() {
    let folder = Folder::new();
    let run = folder.mms("study bar_1d --cells 8,16 --courant 3 --json").exits(1);
    run.complains("8 cells: stopped in step").complains("16 cells: stopped in step");
    let document = run.json();
    assert_eq!(document["verdict"], "fail");
    assert!(document["observed_order"].is_null(), "{document:#}");
    folder.mms("study bar_1d --cells 8,16 --courant 3").exits(1).prints("stopped");
}

#[test]
fn a_study_whose_every_level_is_refused_exits_3() {
    // A time window that is one for every modulus: else the settings are refused before the study.
    let folder = Folder::new();
    let window = "\"2*length/c\"";
    assert!(BAR.contains(window), "the bar's time window has changed");
    let text = BAR.replace(window, "\"duration\"");
    let duration = "[parameters]\nduration = { value = 0.06, unit = \"s\" }\n";
    folder.write("bar.toml", &text.replacen("[parameters]", duration, 1));
    let cases = [
        ("--cells 1000000000000", "use fewer cells"),
        ("--cells 8,16 --set young=0", "the wave speed is 0"),
        ("--cells 8,16 --set young=-1", "the wave speed is NaN"),
    ];
    for (arguments, reason) in cases {
        let run = folder.mms(&format!("study bar.toml {arguments}")).exits(3);
        run.complains("not started: ").complains(reason).prints_nothing();
        run.complains("the study of `bar` cannot be started");
    }
    assert!(!folder.path("target").exists(), "nothing is written about a study that never ran");
}

#[test]
fn a_level_that_is_refused_among_others_fails_the_study() {
    let document = document("--cells 1000000000000,8", 1);
    let refused = &document["levels"][1];
    assert_eq!(refused["cells"], 1_000_000_000_000_u64);
    assert!(refused["l2"].is_null() && refused["steps"].is_null(), "{document:#}");
    assert!(refused["failure"].as_str().is_some_and(|text| text.contains("fewer cells")));
    assert!(document["levels"][0]["l2"].is_f64(), "{document:#}");
    assert_eq!(document["verdict"], "fail");
}

#[test]
fn one_level_shows_no_order() {
    assert_eq!(document("--cells 8", 1)["verdict"], "not asymptotic");
}

#[test]
fn the_expected_order_may_be_given() {
    let first = document("--cells 8,16,32 --integrator usl --expected-order 1", 0);
    assert_eq!(first["verdict"], "pass");
    assert_eq!(first["expected_order"], 1.0);
    assert_eq!(document("--cells 8,16,32 --expected-order 1", 1)["verdict"], "not asymptotic");
    assert_eq!(document("--cells 8,16,32 --expected-order 3", 1)["verdict"], "fail");
}

#[test]
fn bad_settings_exit_2_and_name_the_option() {
    let cases = [
        ("--courant 0", "--courant"),
        ("--courant=-1", "--courant"),
        ("--courant nan", "--courant"),
        ("--particles-per-cell 0", "--particles-per-cell"),
        ("--particles-per-cell=-1", "--particles-per-cell"),
        ("--cells 0", "--cells"),
        ("--cells 8,", "--cells"),
        ("--cells 8,x", "--cells"),
        ("--expected-order nan", "--expected-order"),
        ("--shape cpgmp", "known are: linear, ugimp, cpgimp"),
        ("--integrator rk4", "known are: usl, usf, musl, leapfrog"),
        ("--precision f16", "[possible values: f32, f64]"),
        ("--set yuong=1", "did you mean `young`?"),
    ];
    for (arguments, message) in cases {
        let run = Folder::new().mms(&format!("study bar_1d {arguments}")).exits(2);
        run.complains(message).prints_nothing();
    }
}
