//! `--rigid`: the rigid twin of any field, on every command.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::mms::{BAR, Folder, assert_close, numbers};

/// A square that is sheared, and its closed form.
const SQUARE: &str = r#"
[field]
title     = "A sheared square"
dimension = 2
[displacement]
u = ["Y*t/4", "X*t^2/8"]
[material]
model   = "neo_hookean"
lambda  = 2
mu      = 1
density = 1
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
time  = [0, 1]
[[check]]
quantity = "jacobian"
equals   = ["1 - t^3/32"]
"#;

fn point(run: &super::mms::Run) -> Value {
    run.json()["points"][0].clone()
}

/// In one dimension the motion is a translation 3 L s^2, where s is the elapsed part of the time window.
#[test]
fn the_standard_motion_accelerates_the_bar() {
    let folder = Folder::new();
    let of = |option: &str| {
        let at = "--at 0.3 --time 0.01 --quantity u,v,a,b,F,P --json";
        point(&folder.mms(&format!("eval bar_1d {at} {option}")).exits(0))
    };
    let (rest, moving) = (of(""), of("--rigid"));
    let window = 2.0 / 1000_f64.sqrt();
    let added = |key: &str| numbers(&moving[key])[0] - numbers(&rest[key])[0];
    assert_close(added("displacement"), 3.0 * (0.01 / window).powi(2), 1e-13);
    assert_close(added("velocity"), 6.0 * 0.01 / window.powi(2), 1e-13);
    assert_close(added("acceleration"), 6.0 / window.powi(2), 1e-12);
    assert_close(added("body_force"), 6.0 / window.powi(2), 1e-12);
    for key in ["deformation_gradient", "first_piola_kirchhoff"] {
        assert_eq!(rest[key], moving[key]);
    }
}

/// b* = Q b + Q'' x + 2 Q' v + d'' where Q is a rotation by pi t/2, at t = 1: a quarter turn.
#[test]
fn a_given_motion_turns_the_square() {
    let folder = Folder::new();
    folder.write("square.toml", SQUARE);
    let of = |rigid: &[&str]| {
        let arguments = ["eval", "square.toml", "--at", "0.5,0.25", "--time", "1", "--json"];
        point(&folder.run(&[&arguments[..], rigid].concat()).exits(0))
    };
    let motion = r#"rotation = "pi*t/2", translation = ["t^2", "3*t"]"#;
    let (rest, moving) = (of(&[]), of(&["--rigid", motion]));
    let vector = |of: &Value, key: &str| -> [f64; 2] {
        numbers(&of[key]).try_into().expect("two components")
    };
    let [u, v] = vector(&rest, "displacement");
    let [u1, v1] = vector(&rest, "velocity");
    let (x, y) = (0.5 + u, 0.25 + v);
    let rate = PI / 2.0;
    let [b, c] = vector(&rest, "body_force");
    let expected =
        [-c + rate * rate * y - 2.0 * rate * u1 + 2.0, b - rate * rate * x - 2.0 * rate * v1];
    for (found, expected) in vector(&moving, "body_force").into_iter().zip(expected) {
        assert_close(found, expected, 1e-12);
    }
    let expected = [-y + 1.0 - 0.5, x + 3.0 - 0.25];
    for (found, expected) in vector(&moving, "displacement").into_iter().zip(expected) {
        assert_close(found, expected, 1e-12);
    }
}

#[test]
fn faces_that_were_at_rest_move_and_closed_forms_are_left_out() {
    let folder = Folder::with_bar("bar.toml");
    let check = folder.mms("check bar.toml --rigid --json").exits(0).json();
    assert_eq!(check["files"][0]["checks"], json!([]));
    let show = folder.mms("show bar_1d --rigid --json").exits(0).json();
    assert_eq!(show["boundary"], json!({ "x_min": "prescribed", "x_max": "free" }));
    folder.mms("show bar_1d --rigid").exits(0).prints("3·");
}

#[test]
fn emitted_code_says_what_motion_it_has() {
    let folder = Folder::new();
    let text = folder.mms("emit bar_1d --rigid --target rust-mms-math").exits(0).stdout;
    assert!(text.contains("Rigid motion: translation = "), "{text}");
}

/// The bar is prescribed at one end and free at the other, and moves by three times its length.
#[test]
fn a_study_follows_the_twin() {
    let folder = Folder::new();
    let study = folder.mms("study bar_1d --rigid --cells 8,16,32 --json").exits(0).json();
    assert_eq!(study["verdict"], "pass");
}

#[test]
fn what_is_no_motion_is_refused() {
    let folder = Folder::with_bar("bar.toml");
    folder
        .mms("eval --rigid bar_1d --at 0.3 --time 0")
        .exits(2)
        .complains("`--rigid` must follow the field");
    folder
        .run(&["eval", "bar_1d", "--at", "0.3", "--time", "0", "--rigid", "rotation = \"t\""])
        .exits(2)
        .complains("a 1-dimensional field cannot rotate")
        .complains("--> rigid:1:11");
    folder
        .write("moving.toml", &format!("{BAR}\n[rigid]\ntranslation = [\"length*t*c/length\"]\n"));
    folder
        .mms("show moving.toml --rigid")
        .exits(2)
        .complains("the field has a rigid motion already");
}
