//! `mms state`: exact states, compared with formulas typed here, with differences of themselves, and with `mms judge`.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use serde_json::Value;

use super::mms::{Folder, assert_close, numbers};

/// The columns of a table.
fn table(folder: &Folder, name: &str) -> BTreeMap<String, Vec<f64>> {
    let text = folder.read(name);
    let mut lines = text.lines();
    let names: Vec<_> = lines.next().expect("a header").split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|it| it.parse().expect("a number")).collect())
        .collect();
    let column = |at: usize| rows.iter().map(|row| row[at]).collect();
    names.iter().enumerate().map(|(at, name)| ((*name).to_owned(), column(at))).collect()
}

/// A strip that is bent about the origin, by more than a turn.
const BENT: &str = r#"
[field]
title = "A bent strip"
dimension = 2
[displacement]
u = ["X*cos(Y) - X", "X*sin(Y) - Y"]
[material]
model = "neo_hookean"
lambda = 1
mu = 1
density = 1
[domain]
shape = "box"
lower = [1, 0]
upper = [2, 7]
time = [0, 1]
"#;

#[test]
fn a_state_of_the_bar_has_the_numbers_of_its_closed_form() {
    let folder = Folder::new();
    let run = folder.mms("state bar_1d --cells 8 --time 0,0.013 -o bar.csv");
    run.exits(0).prints("x_min: fixed, u = 0").prints("time window: 0.0 to 0.063");
    let state = table(&folder, "bar.csv");
    assert_eq!(state["X"].len(), 32);
    let (c, young) = (1000f64.sqrt(), 1e6);
    for at in 0..32 {
        let (x, t) = (state["X"][at], state["time"][at]);
        let phase = PI * c * t;
        let amplitude = 0.2 * phase.cos();
        let f = 1.0 + 2.0 * amplitude * (1.0 - x);
        let stress = young / 2.0 * (f - 1.0 / f);
        let b = x * (2.0 - x) * (-(PI * c).powi(2) * amplitude)
            + young / 1000.0 * (1.0 + f.powi(-2)) * amplitude;
        assert_close(state["u"][at], amplitude * x * (2.0 - x), 1e-14);
        assert_close(state["x"][at], x + amplitude * x * (2.0 - x), 1e-14);
        assert_close(state["F"][at], f, 1e-14);
        assert!((state["v"][at] + 0.2 * PI * c * phase.sin() * x * (2.0 - x)).abs() < 1e-12);
        assert_close(state["P"][at], stress, 1e-12);
        // In one dimension the lateral stretches are 1.
        assert_close(state["sigma"][at], stress, 1e-12);
        assert!((state["b"][at] - b).abs() < 1e-10 * 1000.0, "{b}");
        assert_close(state["density"][at], 1000.0 / f, 1e-14);
        assert_close(state["volume"][at], f / 16.0, 1e-14);
        assert_close(state["mass"][at], 1000.0 / 16.0, 1e-14);
        assert_close(state["density"][at] * state["volume"][at], state["mass"][at], 1e-14);
    }
}

#[test]
fn every_format_is_judged_exact_to_round_off() {
    let folder = Folder::new();
    for (ending, given) in [("csv", "N.csv"), ("vtu", "N.pvd"), ("npz", "N_*.npz")] {
        let mut files = Vec::new();
        for cells in [3, 6] {
            let stem = format!("{ending}{cells}");
            let command = format!(
                "state generalized_vortex --cells {cells} --time 0.3,0.5 -o {stem}.{ending} \
                 --quantity u,v,a,F,P,sigma,kirchhoff_stress,b,rho,J,W,E,S,p,von_mises"
            );
            folder.mms(&command).exits(0);
            files.push(given.replace('N', &stem));
        }
        let judge = format!("judge generalized_vortex {} --json", files.join(" "));
        let document = folder.mms(&judge).exits(0).json();
        let quantities = document["quantities"].as_array().expect("quantities");
        assert_eq!(quantities.len(), 15, "{ending}");
        for quantity in quantities {
            for norm in quantity["norms"].as_array().expect("norms") {
                for level in norm["levels"].as_array().expect("levels") {
                    // X, u, F and all other quantities are read back to the bit.
                    assert_eq!(level["error"], 0.0, "{ending}, {}", quantity["name"]);
                }
            }
            assert_eq!(quantity["verdict"], "exact to round-off", "{ending}, {}", quantity["name"]);
        }
        let notes = document["notes"].to_string();
        assert!(!notes.contains("digits"), "{notes}");
    }
}

#[test]
fn places_are_brought_back() {
    let folder = Folder::new();
    folder.write("places.csv", "x\n0.4\n0\n1.05\n");
    folder.mms("state bar_1d --points places.csv --at-present --time 0.013 -o state.csv").exits(0);
    let state = table(&folder, "state.csv");
    assert_close(state["X"][0], 0.3669589318356906, 2e-16);
    assert_close(state["b"][0], -222.7899996154359, 1e-15);
    assert_eq!(state["X"][1], 0.0);
    assert!(state["x"].iter().zip([0.4, 0.0, 1.05]).all(|(x, given)| (x - given).abs() < 3e-16));
    folder.write("beyond.csv", "x\n0.4\n1.3\n");
    folder
        .mms("state bar_1d --points beyond.csv --at-present --time 0.013 -o state.csv")
        .exits(2)
        .complains("beyond.csv:3: x = [1.3], t = 0.013: no point of the body is there");
}

#[test]
fn two_points_in_one_place_are_both_named() {
    let folder = Folder::new();
    folder.write("bent.toml", BENT);
    let (sine, cosine) = 0.5f64.sin_cos();
    folder.write("places.csv", &format!("x,y\n{:?},{:?}\n", 1.25 * cosine, 1.25 * sine));
    let run = folder.mms("state bent.toml --points places.csv --at-present --time 0.5 -o s.csv");
    let run = run.exits(2);
    run.complains("places.csv:2: x = [").complains("two points of the body are there, X = [1.25");
    run.complains("6.78318530717958").complains("0.5").complains("give X");
}

#[test]
fn what_is_left_out_is_0_and_nothing_else() {
    let folder = Folder::new();
    folder.write("points.csv", "X,Y\n0.25,0.5\n1,0.75\n");
    let state = |name: &str, more: &str| {
        let command =
            format!("state sheared_block_2d --points points.csv --time 0.02 -o {name} {more}");
        folder.mms(&command).exits(0);
        table(&folder, name)
    };
    let whole = state("whole.csv", "");
    for (term, starts) in [
        ("body_force", &["b_"][..]),
        ("stress", &["P_", "sigma_"]),
        ("traction", &["traction_"]),
        ("stress,body_force", &["P_", "sigma_", "b_"]),
    ] {
        let left = state("left.csv", &format!("--without {term}"));
        assert_eq!(left.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
        for (name, values) in &left {
            let is_left_out = starts.iter().any(|start| name.starts_with(start));
            let is_zero = values.iter().all(|it| *it == 0.0);
            assert!(if is_left_out { is_zero } else { *values == whole[name] }, "{term}: {name}");
        }
        assert!(starts.iter().all(|start| {
            whole
                .iter()
                .any(|(name, values)| name.starts_with(start) && values.iter().any(|it| *it != 0.0))
        }));
    }
}

/// Tractions are P N with the normals of the faces of a square and of a ring, and 0 at all other points.
#[test]
fn tractions_are_those_of_the_faces_on_which_points_lie() {
    let folder = Folder::new();
    folder.write("points.csv", "X,Y\n0.5,0.5\n1,0.75\n0,0\n0.25,1\n");
    folder.mms("state plane_strain_gent --points points.csv --time 0.02 -o s.csv").exits(0);
    let state = table(&folder, "s.csv");
    for (face, normal, on) in [
        ("x_min", [-1.0, 0.0], &[2][..]),
        ("x_max", [1.0, 0.0], &[1]),
        ("y_min", [0.0, -1.0], &[2]),
        ("y_max", [0.0, 1.0], &[3]),
    ] {
        for point in 0..4 {
            for row in ["x", "y"] {
                let entry = |column: &str| state[&format!("P_{row}{column}")][point];
                let whole = entry("x") * normal[0] + entry("y") * normal[1];
                let expected = if on.contains(&point) { whole } else { 0.0 };
                let found = state[&format!("traction_{face}_{row}")][point];
                assert!(
                    (found - expected).abs() <= 1e-12 * whole.abs(),
                    "{face} {point}: {found} {expected}"
                );
            }
        }
    }
    folder
        .mms("state bar_1d --cells 4 --time 0.01 --quantity traction -o s.csv")
        .exits(2)
        .complains("no point lies on a face");
}

/// Differences of an affine motion, by u in X and in t, a method that the code does not use.
#[test]
fn an_affine_part_is_linear_and_its_force_is_its_acceleration() {
    let folder = Folder::new();
    let middle = [0.5, 0.5];
    folder.write("points.csv", "X,Y\n0.5,0.5\n0.125,0.5\n0.5,0.875\n0.25,0.75\n");
    let (time, step) = (0.02, 1e-5);
    let command = |more: &str, name: &str| {
        let times = format!("{},{time},{}", time - step, time + step);
        let command = format!(
            "state axis_aligned_2d --points points.csv --time {times} {more} -o {name} --quantity u,F,sigma,b,a"
        );
        folder.mms(&command).exits(0);
        table(&folder, name)
    };
    let (whole, affine) = (command("", "whole.csv"), command("--affine", "affine.csv"));
    let at = |state: &BTreeMap<String, Vec<f64>>, name: &str, point: usize| state[name][4 + point];
    for name in ["u_x", "u_y", "F_xx", "F_yy"] {
        assert_close(at(&affine, name, 0), at(&whole, name, 0), 1e-13);
    }
    for point in 0..4 {
        for name in ["F_xx", "F_xy", "F_yx", "F_yy", "sigma_xx", "sigma_xy", "sigma_yy"] {
            assert_eq!(at(&affine, name, point), at(&affine, name, 0), "{name}");
        }
        for row in ["x", "y"] {
            let offset = ["X", "Y"].map(|axis| affine[axis][4 + point]);
            let slope =
                |column: &str, same: f64| at(&affine, &format!("F_{row}{column}"), 0) - same;
            let [sx, sy] = [slope("x", f64::from(row == "x")), slope("y", f64::from(row == "y"))];
            let u = format!("u_{row}");
            let linear =
                at(&affine, &u, 0) + sx * (offset[0] - middle[0]) + sy * (offset[1] - middle[1]);
            assert!((at(&affine, &u, point) - linear).abs() < 1e-15, "{point}");
            let [before, now, after] = [0, 4, 8].map(|start| affine[&u][start + point]);
            let second = (before - 2.0 * now + after) / (step * step);
            let b = at(&affine, &format!("b_{row}"), point);
            assert_eq!(b, at(&affine, &format!("a_{row}"), point));
            assert!((second - b).abs() < 1e-4 * (1.0 + b.abs()), "{point}: {second} is not {b}");
        }
    }
}

/// A rigid motion rotates the stress and changes nothing else.
#[test]
fn an_affine_part_takes_a_rigid_motion_on_top() {
    let folder = Folder::new();
    let state = |more: &str| {
        let run = folder.mms(&format!(
            "state sheared_block_2d --cells 2 --time 0.03 -o s.csv --quantity J,E,sigma --affine {more}"
        ));
        run.exits(0);
        table(&folder, "s.csv")
    };
    let (plain, turned) = (state(""), state("--rigid"));
    for name in ["J", "E_xx", "E_xy", "E_yy", "mass"] {
        for (a, b) in plain[name].iter().zip(&turned[name]) {
            assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{name}: {a} {b}");
        }
    }
    for at in 0..plain["J"].len() {
        let trace =
            |state: &BTreeMap<String, Vec<f64>>| state["sigma_xx"][at] + state["sigma_yy"][at];
        assert_close(trace(&turned), trace(&plain), 1e-10);
        assert!((turned["sigma_xy"][at] / plain["sigma_xy"][at] - 1.0).abs() > 0.1);
    }
}

#[test]
fn cells_and_volumes_of_a_file_are_kept() {
    let folder = Folder::new();
    folder.write(
        "mesh.vtk",
        "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\
         CELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\nPOINT_DATA 4\nSCALARS volume double 1\nLOOKUP_TABLE default\n\
         0.25\n0.25\n0.25\n0.25\n",
    );
    folder.mms("state axis_aligned_2d --points mesh.vtk --time 0.03 -o mesh.vtu").exits(0);
    // For a mesh, norms are over its cells, which judge finds.
    let document = folder.mms("judge axis_aligned_2d mesh.vtu --json").json();
    assert_eq!(document["samplings"]["displacement"], "cells");
    folder.mms("state axis_aligned_2d --points mesh.vtu --time 0.03 -o again.csv").exits(0);
    let again = table(&folder, "again.csv");
    assert_eq!(again["reference_volume"], [0.25; 4]);
    assert_eq!(again["X"], [0.0, 1.0, 1.0, 0.0]);
}

#[test]
fn what_cannot_be_written_is_refused() {
    let folder = Folder::with_bar("bar.toml");
    folder.write("points.csv", "X\n0.5\n1.25\n");
    folder.write("negative.csv", "X,volume\n0.5,1\n0.75,-1\n");
    folder.write("twice.csv", "time,X\n0,0.5\n1,0.5\n");
    for (arguments, said) in [
        ("bar.toml --cells 4 --time 0 -o s.txt", "expected a file that ends in .csv, .vtu or .npz"),
        ("bar.toml --time 0 -o s.csv", "<--points <FILE>|--cells <N[xN..]>>"),
        (
            "bar.toml --cells 4 --time 1 -o s.csv",
            "`--time 1`: outside the time window of `bar`, 0.0 to 0.063",
        ),
        (
            "bar.toml --points points.csv --time 0 -o s.csv",
            "points.csv:3: X = [1.25] lies outside the body by 2.5e-1",
        ),
        (
            "bar.toml --points points.csv --time 0 -o points.csv",
            "that file is read, and would be lost",
        ),
        ("bar.toml --points twice.csv --time 0 -o s.csv", "results at 2 times"),
        ("bar.toml --cells 4 --time 0,0.01,0 -o s.csv", "`--time`: 0 is given twice"),
        (
            "bar.toml --points negative.csv --time 0 -o s.csv",
            "negative.csv:3: the volume is -1; expected a positive number",
        ),
        ("bar.toml --cells 4x4 --time 0 -o s.csv", "`--cells 4x4`: 2 numbers for 1 dimension(s)"),
        (
            "bar.toml --cells 4 --at-present --time 0 -o s.csv",
            "`--at-present`: it is about points of a file",
        ),
        ("bar.toml --cells 4 --time 0 --quantity stres -o s.csv", "unknown quantity `stres`"),
        ("bar.toml --cells 4 --time 0 --without forces -o s.csv", "body_force, stress, traction"),
    ] {
        folder.mms(&format!("state {arguments}")).exits(2).complains(said);
    }
    assert!(!folder.path("s.csv").exists());
}

#[test]
fn eval_takes_the_points_of_a_file() {
    let folder = Folder::new();
    folder.write("points.csv", "X\n0.25\n1.5\n0.75\n");
    let run =
        folder.mms("eval bar_1d --points points.csv --time 0.01 --quantity u,b --json").exits(0);
    run.complains("`--points points.csv`: 1 of its points");
    let document = run.json();
    let single =
        folder.mms("eval bar_1d --at 0.25 --at 1.5 --at 0.75 --time 0.01 --quantity u,b --json");
    assert_eq!(document["points"], single.json()["points"]);
    assert_eq!(document["outside_body"], Value::from(vec![1]));
    folder.mms("eval bar_1d --time 0.01").exits(2).complains("--at <X,Y>");
}

/// The file, or a file beside a table, contains the time window, the extent of the motion and the claims of faces.
#[test]
fn states_tell_the_data_of_their_field() {
    let folder = Folder::new();
    let state = |file: &str| {
        let run = folder.mms(&format!("state bar_1d --cells 4 --time 0.01 -o {file} --json"));
        run.exits(0).json()
    };
    let document = state("s.csv");
    assert_eq!(document["files"], serde_json::json!(["s.csv", "s.csv.json"]));
    let beside: serde_json::Value = serde_json::from_str(&folder.read("s.csv.json")).expect("JSON");
    for key in ["time_window", "body", "motion", "faces"] {
        assert_eq!(beside[key], document[key], "{key}");
    }
    assert_eq!(beside["faces"][1], serde_json::json!({"face": "x_max", "claim": "free"}));
    state("s.vtu");
    let text = folder.read("s.vtu");
    let xml = roxmltree::Document::parse(&text).expect("XML");
    let data = |name: &str| {
        let node = xml.descendants().find(|it| it.attribute("Name") == Some(name));
        let node = node.unwrap_or_else(|| panic!("no {name}"));
        assert_eq!(node.parent().map(|it| it.tag_name().name()), Some("FieldData"));
        let text = node.text().unwrap_or_default();
        text.split(' ').map(|it| it.parse().expect("a number")).collect::<Vec<f64>>()
    };
    assert_eq!(data("time_window"), numbers(&document["time_window"]));
    assert_eq!(data("motion_upper"), numbers(&document["motion"]["upper"]));
    let word: String = data("face_x_max").iter().map(|it| char::from(*it as u8)).collect();
    assert_eq!(word, "free\0");
}
