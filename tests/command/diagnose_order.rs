//! `mms diagnose` of results of two meshes: it is never milder than `mms judge`.

use std::f64::consts::PI;
use std::fmt::Write as _;

use serde_json::Value;

use super::judge_orders::{RUNS, files};
use super::mms::Folder;
use crate::sampled::sampled;

/// One in so many runs is tried.
const SHARE: usize = 10;

/// The time at which results are written, and h of the meshes.
const TIME: f64 = 0.01;
const SIZES: [f64; 2] = [1.0 / 32.0, 1.0 / 64.0];

/// Writes results of `bar_1d` on both meshes, whose errors are those of a wave, c h^q; returns the arguments that name them.
fn written(folder: &Folder, factor: f64, order: f64) -> String {
    for h in SIZES {
        let count = (1.0 / h).round() as usize;
        let points: String =
            (0..count).map(|k| format!(" --at {}", (k as f64 + 0.5) * h)).collect();
        let values =
            folder.mms(&format!("eval bar_1d --time {TIME} --json{points}")).exits(0).json();
        let mut text = "X,time,u_x\n".to_owned();
        for point in values["points"].as_array().expect("points") {
            let number = |key: &str| point[key][0].as_f64().expect("a number");
            let wave = (9.0 * PI * number("at")).sin();
            let u = number("displacement") + factor * h.powf(order) * wave;
            writeln!(text, "{:e},{TIME},{u:e}", number("at")).expect("a string");
        }
        folder.write(&format!("u{count}.csv"), &text);
    }
    "bar_1d u32.csv u64.csv".into()
}

fn order(document: &Value) -> f64 {
    document["order"]["observed_order"].as_f64().expect("an order")
}

#[test]
fn errors_that_judge_fails_are_never_nothing() {
    let folder = Folder::new();
    for (factor, at, says) in [(2e-5, 0.0, "it does not fall"), (1e-3, 1.0, "time stepping")] {
        let files = written(&folder, factor, at);
        folder.mms(&format!("judge {files}")).exits(1);
        let found = folder.mms(&format!("diagnose {files} --json")).exits(1).json();
        assert!((order(&found) - at).abs() < 0.1, "{found}");
        assert_ne!(found["finding"], "nothing");
        assert!(found["order"]["says"].as_str().expect("a sentence").contains(says), "{found}");
        folder.mms(&format!("diagnose {files}")).exits(1).prints("fail (`mms judge`)");
    }
}

#[test]
fn the_expected_order_is_the_users() {
    let folder = Folder::new();
    let files = written(&folder, 0.02, 2.0);
    let right = folder.mms(&format!("diagnose {files}")).exits(0);
    right.prints("pass (`mms judge`)").prints("nothing: ");
    folder.mms(&format!("diagnose {files} --expected-order 3")).exits(1);
    let files = written(&folder, 1e-3, 1.0);
    folder.mms(&format!("diagnose {files} --expected-order 1")).exits(0);
    folder.mms(&format!("diagnose {files} --quantity u --expected-order u=1")).exits(0);
    let none = folder.mms(&format!("diagnose {files} --quantity v")).exits(2);
    none.complains("nothing to diagnose; expected v, as `--quantity` says");
    let steps = folder.mms(&format!("diagnose {files} --time-step 1e-4,2e-4,3e-4")).exits(2);
    steps.complains("`--time-step`: 3 values for 2 files");
}

#[test]
fn a_method_sets_the_order_and_the_size() {
    let folder = Folder::new();
    let first = "shape=linear,integrator=usl,formulation=total,particles_per_cell=2";
    for n in [16, 32] {
        let options = "--shape linear --integrator usl --formulation total --frames 2";
        folder.mms(&format!("run bar_1d --cells {n} {options} --vtk first{n}")).exits(0);
    }
    let files = "bar_1d first16 first32 --h 1/16,1/32 --quantity u";
    let unknown = folder.mms(&format!("diagnose {files} --json")).exits(1).json();
    let known = unknown["order"]["like"]["method"].as_str().expect("a method of that order");
    assert!(known.contains("integrator=usl"), "{unknown}");
    for like in [known, first] {
        let run = folder.mms(&format!("diagnose {files} --like {like}")).exits(0);
        run.prints("nothing: ").complains("expected order of displacement: 0.9");
    }
}

/// Runs of a code that shares nothing with this project, on the two finest meshes.
#[test]
fn right_runs_of_finite_elements_are_nothing() {
    let folder = Folder::new();
    for run in sampled(RUNS, SHARE) {
        let (field, files) = files(run);
        let [.., coarse, fine] = &files;
        let options = "--time 0.012 --map X=points --json";
        let found = folder.mms(&format!("diagnose {field} {coarse} {fine} {options}"));
        assert_eq!(found.exits(0).json()["finding"], "nothing", "{run:?}");
    }
}
