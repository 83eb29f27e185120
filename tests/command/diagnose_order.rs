//! `mms diagnose` of results of two meshes: it is never milder than `mms judge`.

use std::f64::consts::PI;
use std::fmt::Write as _;

use serde_json::Value;

use super::judge_orders::{RUNS, files};
use super::mms::Folder;
use crate::sampled::sampled;

/// One run in `SHARE` is tried.
const SHARE: usize = 10;

/// The time at which results are written; below, h of the meshes.
const TIME: f64 = 0.01;
const SIZES: [f64; 2] = [1.0 / 32.0, 1.0 / 64.0];

/// Writes results of `bar_1d` on both meshes, with the errors of a wave, c h^q; returns the arguments that name them.
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

/// Runs of a code that shares nothing with this project, on its two finest meshes.
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

/// The error of the method is in both runs.
#[test]
fn a_right_run_is_a_reference() {
    let folder = Folder::new();
    let files = written(&folder, 0.5, 2.0);
    let copies = ["right32.csv", "right64.csv"];
    for (file, copy) in ["u32.csv", "u64.csv"].into_iter().zip(copies) {
        folder.write(copy, &folder.read(file));
    }
    let reference = format!("--reference {}", copies.join(","));
    folder.mms(&format!("diagnose {files} {reference}")).exits(0).prints("nothing: ");
    for file in ["u32.csv", "u64.csv"] {
        let text = folder.read(file);
        let scaled = |line: &str| {
            let (start, u) = line.rsplit_once(',').expect("columns");
            u.parse().map_or(line.into(), |u: f64| format!("{start},{:e}", 1.02 * u))
        };
        folder.write(file, &text.lines().map(|line| scaled(line) + "\n").collect::<String>());
    }
    let run = folder.mms(&format!("diagnose {files} {reference}")).exits(1);
    run.prints("output_factor          1.0200   100.0 %");
    let one = folder.mms(&format!("diagnose {files} --reference right32.csv")).exits(2);
    one.complains("`--reference`: 1 for 2 files");
    let other = folder.mms("diagnose bar_1d u32.csv --reference right64.csv").exits(2);
    other.complains("expected the same points in the same order");
}

const RUBBER: &str = r#"
[material]
title         = "Two terms"
strain_energy = "c1*(I1 - 3 - 2*ln(J)) + c2/3*J*(J - 1)^2"

[parameters]
c1 = { unit = "Pa" }
c2 = { unit = "Pa" }
"#;

/// A rod at rest, with a material of its own.
const ROD: &str = r#"
[field]
title     = "A rod at rest"
dimension = 1
[parameters]
first  = { value = 200 }
second = { value = 600 }
[displacement]
u = ["0.1*sin(X)"]
[material]
model   = "./rubber.toml"
c1      = "first"
c2      = "second"
density = "2"
[domain]
shape = "box"
lower = [0]
upper = [1]
time  = [0, 1]
[boundary]
x_min = "fixed"
x_max = "traction"
"#;

fn rod() -> Folder {
    let folder = Folder::new();
    folder.write("rubber.toml", RUBBER);
    folder.write("rod.toml", ROD);
    folder
}

#[test]
fn parameters_of_own_materials_are_named() {
    let folder = rod();
    // P of uniaxial strain.
    let of_volume = |f: f64| (f - 1.0) * (3.0 * f - 1.0) / 3.0;
    let stress = |c1: f64, c2: f64, f: f64| 2.0 * c1 * (f - 1.0 / f) + c2 * of_volume(f);
    let mistakes = [
        (400.0, 600.0, "parameter_twice [c1]"),
        (200.0, 0.0, "parameter_missing [c2]"),
        (200.0, 612.0, "parameter_factor [c2]"),
    ];
    for (c1, c2, named) in mistakes {
        let mut text = "F11,P11\n".to_owned();
        for k in 1..20 {
            let f = 0.8 + 0.03 * f64::from(k);
            writeln!(text, "{f},{:e}", stress(c1, c2, f)).expect("a string");
        }
        folder.write("law.csv", &text);
        let run = folder.mms("diagnose rod.toml law.csv --quantity stress").exits(1);
        run.prints(&format!("named: {named}"));
    }
}

#[test]
fn results_at_rest_need_no_time() {
    let folder = rod();
    for cells in [16, 32] {
        let mut text = "X,u\n".to_owned();
        for k in 0..=cells {
            let x = f64::from(k) / f64::from(cells);
            let error = 0.01 * x * (2.0 - x) / f64::from(cells * cells);
            writeln!(text, "{x},{:e}", 0.1 * x.sin() + error).expect("a string");
        }
        folder.write(&format!("u{cells}.csv"), &text);
    }
    let files = "rod.toml u16.csv u32.csv";
    folder.mms(&format!("diagnose {files}")).exits(0).prints("pass (`mms judge`)");
    let like = folder.mms(&format!("diagnose {files} --like shape=linear")).exits(2);
    like.complains("nothing moves in this field");
}
