//! `mms judge FIELD FILE..`: results of the project's own solver, of a finite-element mesh, and of wrong files.

use serde_json::Value;

use super::mms::{Folder, Run};

/// The meshes of the runs.
const CELLS: [usize; 3] = [8, 16, 32];

/// Runs of the bar on three meshes, and the errors that each reports at the end.
fn runs(folder: &Folder) -> Vec<Value> {
    let run = |cells: usize| {
        let run =
            folder.mms(&format!("run bar_1d --cells {cells} --vtk out{cells} --frames 4 --json"));
        run.exits(0).json()["errors"].clone()
    };
    CELLS.map(run).into()
}

/// The end of the bar's time window.
fn end(folder: &Folder) -> String {
    let list = folder.read("out8/bar_1d.pvd");
    let last = list.rsplit_once("timestep=\"").expect("a time").1;
    last.split('"').next().expect("a time").to_owned()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[track_caller]
fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() < tolerance, "{a} and {b}");
}

/// A table of points of the bar with X and columns that `change` computes from X and the exact u.
fn exact(
    folder: &Folder,
    points: usize,
    time: &str,
    change: impl Fn(f64, f64) -> String,
) -> String {
    let places: Vec<f64> = (0..points).map(|at| (at as f64 + 0.5) / points as f64).collect();
    let at: Vec<_> = places.iter().flat_map(|x| ["--at".to_owned(), x.to_string()]).collect();
    let rest = ["eval", "bar_1d", "--time", time, "--quantity", "u", "--json"].map(str::to_owned);
    let run = folder.run(&[rest.as_slice(), &at].concat()).exits(0).json();
    let found = run["points"].as_array().expect("points");
    let row = |(x, point): (&f64, &Value)| change(*x, number(&point["displacement"][0])) + "\n";
    places.iter().zip(found).map(row).collect()
}

#[test]
fn a_run_is_judged_as_it_judges_itself() {
    let folder = Folder::new();
    let runs = runs(&folder);
    let end = end(&folder);
    let run = folder.mms(&format!(
        "judge bar_1d out8/bar_1d.pvd out16 out32/*.pvd --time {end} --h 0.125,0.0625,0.03125 --json"
    ));
    let document = run.json();
    let quantities = document["quantities"].as_array().expect("quantities");
    let norms = |name: &str| {
        let found = quantities.iter().find(|it| it["name"] == name);
        found.unwrap_or_else(|| panic!("no {name}"))["norms"].as_array().expect("norms").clone()
    };
    // Leapfrog has v half a step earlier than the time of a state.
    for name in ["displacement", "deformation_gradient"] {
        for norm in norms(name) {
            let word = norm["norm"].as_str().expect("a norm");
            for (level, run) in norm["levels"].as_array().expect("levels").iter().zip(&runs) {
                let own = &run[name]["at_end"][word];
                near(number(&level["error"]), number(own), 1e-9);
            }
        }
    }
    assert!(quantities.iter().any(|it| it["name"] == "cauchy_stress"));
    assert_eq!(document["samplings"]["displacement"], "points");
    near(number(&document["levels"][0]["cell_size"]), 0.125, 1e-12);
    near(
        number(&document["levels"][2]["l2"]),
        number(&runs[2]["displacement"]["at_end"]["l2"]),
        1e-9,
    );
}

#[test]
fn counts_of_points_give_h_and_the_verdict_its_exit_code() {
    let folder = Folder::new();
    runs(&folder);
    let run = folder.mms("judge bar_1d out8 out16 out32 --quantity u").exits(0);
    run.prints("h: the distance of neighbouring points").prints("X: X = x - u");
    run.prints("at 5 times").prints("pass: observed order 2.0");
    // The bar has lambda = 0.
    let document = folder.mms("judge bar_1d out8 out16 out32 --quantity u --json").json();
    let excluded = document["excluded"].as_array().expect("what is excluded");
    let mistake = |name: &str| excluded.iter().find(|it| it["hypothesis"] == name).expect("a name");
    assert_eq!(mistake("lambda_factor")["excluded"], false);
    assert_eq!(mistake("force_sign")["excluded"], true);
    // The error is some thousandths of u, and b causes u.
    let part = mistake("force_factor")["from"].as_f64().expect("a size");
    assert!((1e-4..1e-2).contains(&part), "{part}");
    let higher = folder.mms("judge bar_1d out8 out16 out32 --quantity u --expected-order 3");
    higher.exits(1).prints("fail");
}

/// The rounding of u = x - X to six digits has no order.
#[test]
fn floors_of_files_are_found() {
    let folder = Folder::new();
    for (name, points) in [("a", 8), ("b", 16), ("c", 32)] {
        let error = 1e-4 * (8.0 / points as f64).powi(4);
        let row = |x: f64, u: f64| format!("{x:.6},{:.6}", x + u + error);
        let table = exact(&folder, points, "0.005", row);
        folder.write(&format!("{name}.csv"), &format!("X,x\n{table}"));
    }
    let run =
        folder.mms("judge bar_1d a.csv b.csv c.csv --time 0.005 --h 4,2,1 --expected-order 4");
    let run = run.exits(0);
    run.prints(
        "`c.csv`: the error of displacement is at its floor of 5.0e-7, which rounding of the file",
    );
    run.prints("u = x - X").prints("observed order 3.97 (l2; 2 levels, h 4.000e0 to h 2.000e0)");
}

/// Numbers of single precision that were written with the digits of double precision may be slightly outside the body.
#[test]
fn single_precision_is_seen_behind_its_digits() {
    let folder = Folder::new();
    let rows: String = (0..=4)
        .map(|at| f64::from(0.2_f32 * at as f32))
        .fold(String::new(), |all, x| all + &format!("0.01,{x},0\n"));
    assert!(f64::from(0.8_f32) > 0.8 && rows.contains("0.800000011920929"), "{rows}");
    folder.write("a.csv", &format!("time,X,u\n{rows}"));
    let judge = "judge bar_1d a.csv --h 1 --set length=0.8";
    folder.mms(judge).exits(1).prints("X: X as given");
    // With one more digit it is a double-precision number outside the body.
    folder.write("a.csv", &format!("time,X,u\n{rows}0.01,0.8000000119209291,0\n"));
    folder.mms(judge).exits(2);
}

/// If the digits of a time allow two neighbouring times, the nearer one is chosen.
#[test]
fn each_time_is_judged_once() {
    let folder = Folder::new();
    let both = |of: f64| {
        for (name, points) in [("a", 4), ("b", 8), ("c", 16)] {
            // Only the second time has an error.
            let rows = ["0.01", "0.02"].map(|time| {
                let error = if time == "0.02" { of / f64::from(points).powi(2) } else { 0.0 };
                let row = |x: f64, u: f64| format!("{time},{x},{}", u + error);
                exact(&folder, points as usize, time, row)
            });
            folder.write(&format!("{name}.csv"), &format!("t,X,u\n{}", rows.concat()));
        }
        folder.mms("judge bar_1d a.csv b.csv c.csv --h 4,2,1 --json").exits(0).json()
    };
    for of in [1e-2, 2e-2] {
        let document = both(of);
        assert_eq!(document["times"], serde_json::json!([0.01, 0.02]));
        near(number(&document["levels"][2]["l2"]), of / 256.0, 1e-6);
    }
}

#[test]
fn cells_are_measured_by_quadrature() {
    let folder = Folder::new();
    for cells in [4, 8, 16] {
        folder.write(&format!("mesh{cells}.vtk"), &mesh(&folder, cells));
    }
    let files = "mesh4.vtk mesh8.vtk mesh16.vtk";
    let either = folder.mms(&format!("judge axis_aligned_2d {files} --time 0.02"));
    either.exits(2).complains("`--map X=points` or `--map x=points`");
    let document = folder
        .mms(&format!("judge axis_aligned_2d {files} --time 0.02 --map X=points --json"))
        .json();
    let norms = document["quantities"][0]["norms"].as_array().expect("norms");
    let order = |name: &str| {
        let norm = norms.iter().find(|it| it["norm"] == name).expect("a norm");
        (number(&norm["expected_order"]), number(&norm["levels"][2]["order"]))
    };
    for (name, expected) in [("l2", 2.0), ("h1", 1.0)] {
        let (said, found) = order(name);
        assert_eq!(said, expected);
        assert!((found - expected).abs() < 0.15, "{name}: {found}");
    }
    assert_eq!(document["samplings"]["displacement"], "cells");
    near(number(&document["levels"][0]["cell_size"]), 0.25, 1e-12);
}

/// Values of cells are measured at cell centres, and are no evidence alone.
#[test]
fn middles_of_cells_are_named_and_are_no_evidence_alone() {
    let folder = Folder::new();
    folder.write("mesh.vtk", &mesh(&folder, 4));
    let judge = "judge axis_aligned_2d mesh.vtk --time 0.02 --map X=points";
    folder.mms(&format!("{judge} --quantity W")).exits(2).complains("(superconvergence)");
    let document = folder.mms(&format!("{judge} --json")).json();
    assert_eq!(document["samplings"]["strain_energy"], "middles of cells");
    let energy = &document["quantities"][1];
    assert_eq!(energy["name"], "strain_energy");
    // Each value is too large by 2.
    for norm in energy["norms"].as_array().expect("norms") {
        near(number(&norm["levels"][0]["error"]), 2.0, 1e-9);
    }
}

#[test]
fn means_are_by_the_weight_that_is_asked_for() {
    let folder = Folder::new();
    // Errors of 1e-3 and 3e-3, in volumes of 3 and 1.
    let row = |x: f64, u: f64| {
        let (error, volume) = if x < 0.5 { (1e-3, 3) } else { (3e-3, 1) };
        format!("{x},{:.17},{volume}", u + error)
    };
    let table = exact(&folder, 2, "0.005", row);
    folder.write("a.csv", &format!("X,u,vol\n{table}"));
    let judge = |options: &str| {
        folder.mms(&format!("judge bar_1d a.csv --time 0.005 --json {options}")).json()
    };
    let [plain, weighted] = ["", "--weight volume"].map(|it| number(&judge(it)["levels"][0]["l1"]));
    near(plain, 2e-3, 1e-9);
    near(weighted, 1.5e-3, 1e-9);
    let none = folder.mms("judge bar_1d a.csv --time 0.005 --weight mass");
    none.exits(2).complains("`--weight mass`: no such column");
}

/// The exact values of a quantity of `axis_aligned_2d` at points.
fn values(folder: &Folder, quantity: &str, points: &[[f64; 2]]) -> Vec<Value> {
    let words = format!("eval axis_aligned_2d --time 0.02 --quantity {quantity} --json");
    let at = points.iter().flat_map(|[x, y]| ["--at".to_owned(), format!("{x},{y}")]);
    let words: Vec<String> = words.split(' ').map(str::to_owned).chain(at).collect();
    let run = folder.run(&words).exits(0).json();
    run["points"].as_array().expect("points").iter().map(|it| it[quantity].clone()).collect()
}

/// A grid of quads on the unit square, with the exact u of `axis_aligned_2d` at its nodes, and W and two other quantities at
/// the centres of its cells, in the legacy format.
fn mesh(folder: &Folder, cells: usize) -> String {
    let side = cells + 1;
    let grid = |count: usize, offset: f64| -> Vec<[f64; 2]> {
        let place = |it: usize| (it as f64 + offset) / cells as f64;
        (0..count * count).map(|at| [at % count, at / count].map(place)).collect()
    };
    let (points, middles) = (grid(side, 0.0), grid(cells, 0.5));
    let (all, count) = (points.len(), middles.len());
    let mut text = format!(
        "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {all} double\n"
    );
    points.iter().for_each(|[x, y]| text += &format!("{x} {y} 0\n"));
    text += &format!("CELLS {count} {}\n", 5 * count);
    for cell in 0..count {
        let first = cell % cells + side * (cell / cells);
        text += &format!("4 {} {} {} {}\n", first, first + 1, first + side + 1, first + side);
    }
    text += &format!("CELL_TYPES {count}\n{}", "9\n".repeat(count));
    text += &format!("POINT_DATA {all}\nVECTORS displacement double\n");
    for u in values(folder, "displacement", &points) {
        text += &format!("{} {} 0\n", number(&u[0]), number(&u[1]));
    }
    text += &format!("CELL_DATA {count}\nSCALARS W double 1\nLOOKUP_TABLE default\n");
    for energy in values(folder, "strain_energy", &middles) {
        text += &format!("{}\n", number(&energy[0]) + 2.0);
    }
    text
}

/// Judges one table of the bar.
fn judge(table: &str, options: &str) -> Run {
    let folder = Folder::new();
    folder.write("a.csv", table);
    folder.mms(&format!("judge bar_1d a.csv {options}"))
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let said = |table: &str, words: &str| {
        judge(table, "").exits(2).complains(words);
    };
    said(
        "time,X,u\n0.01,0.5,0\n0.01,1.25,0\n",
        "a.csv:3: X = [1.25] lies outside the body by 2.5e-1",
    );
    said("time,X,u\n0.01,0.5,0\n0.01,0.75,nan\n", "a.csv:3: u is NaN");
    said(
        "time,X,u\n0.01,0.5,0\n9,0.75,0\n",
        "a.csv:3: t = 9 is outside the time window of the field, 0 to 0.06",
    );
    said(
        "time,X,u\n0.01,0.5,0\n0.01,0.5,0\n",
        "a.csv:3: X = [0.5] is where another point is: a.csv:2",
    );
    said(
        "time,X,Y,ux,uy\n0.01,0.5,0.5,0,0\n",
        "a.csv:2: `X` has a component of 0.5 beyond the 1 of the field",
    );
    said("X,u\n0.5,0\n", "1 of its 1 results have no time");
    said("time,u\n0.01,0\n", "no positions found: expected X, or x and u");
    said("time,X,temperature\n0.01,0.5,0\n", "no quantity found that can be judged");
    said(
        "time,X,u,displacement\n0.01,0.5,0,0\n",
        "both `u` and `displacement` may be displacement",
    );
    said("time,X,stress\n0.01,0.5,0\n", "`--map sigma=stress` or `--map P=stress`");
    judge("X,u\n0.5,0\n", "--time 0.01 --h 1,2").exits(2).complains("`--h`: 2 values for 1 files");
    judge("X,u\n0.5,0\n", "--time 0.01 --map u=w")
        .exits(2)
        .complains("no array `w`; the file has `X`, `u`");
    judge("X,u\n0.5,0\n", "--map q=u").exits(2).complains("expected one of X, x");
    Folder::new().mms("judge bar_1d none.csv").exits(2).complains("No such file");
    Folder::new().mms("judge bar_1d").exits(2);
}

#[test]
fn another_unit_and_the_exact_solution_are_suspected() {
    let folder = Folder::new();
    let table = exact(&folder, 8, "0.005", |x, u| format!("{x},{}", 1000.0 * u));
    folder.write("a.csv", &format!("X,u\n{table}"));
    let unit = folder.mms("judge bar_1d a.csv --time 0.005").exits(1);
    assert!(unit.stderr.contains("displacement is 10^3 times as large"), "{}", unit.stderr);
    let table = exact(&folder, 8, "0.005", |x, u| format!("{x},{u:e}"));
    folder.write("b.csv", &format!("X,u\n{table}"));
    let same = folder.mms("judge bar_1d b.csv --time 0.005").exits(0);
    same.prints("exact to round-off: no observed order");
    same.complains(
        "exact to round-off on every mesh: displacement. Are these results of the solver",
    );
}

#[test]
fn two_results_are_compared() {
    let folder = Folder::new();
    folder.write("a.csv", "X,u\n0.25,1\n0.5,2\n0.75,3\n");
    folder.write("b.csv", "X,u,v\n0.25,1\n".replace("0.25,1", "0.25,1,0").as_str());
    folder.mms("judge --same a.csv b.csv").exits(2).complains("a.csv:3: this point has no partner");
    folder.write("b.csv", "X,u,v\n0.25,1,0\n0.5,2.5,0\n0.75,3,0\n");
    let document = folder.mms("judge --same a.csv b.csv --json").exits(0).json();
    let u = &document["differences"][1];
    assert_eq!((u["array"].as_str(), number(&u["largest"])), (Some("u"), 0.5));
    assert_eq!(u["where"], "a.csv:3");
    assert_eq!(document["alone"][0], "v");
    folder.mms("judge --same a.csv b.csv").exits(0).prints("only in one of them: v");
}

#[test]
fn one_mesh_is_held_to_what_was_saved() {
    let folder = Folder::new();
    runs(&folder);
    folder.mms("judge bar_1d out8 out16 out32 --quantity u --output saved").exits(0);
    folder
        .mms("judge bar_1d out8 --quantity u --baseline saved/convergence.json")
        .exits(0)
        .prints("pass");
    let other =
        "judge bar_1d out8 --quantity u --set amplitude=0.19 --baseline saved/convergence.json";
    folder.mms(other).exits(1).prints("fail");
    let missing =
        folder.mms("judge bar_1d out8 --h 1 --quantity u --baseline saved/convergence.json");
    missing.exits(2).complains("has no mesh of h = 1, only");
}
