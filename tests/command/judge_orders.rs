//! `mms judge FIELD FILE..`: the expected orders by element, mesh and start.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use super::mms::Folder;
use crate::sampled::sampled;

/// One run in `SHARE` is tried.
const SHARE: usize = 10;

/// Right runs of scikit-fem on four meshes each, as `examples/solvers/scikit_fem/stored.py` makes them: the field's name
/// there, elements, mesh and quantities.
pub const RUNS: [(&str, &str, &str, &str); 20] = [
    ("start", "P1", "regular", "uva"),
    ("start", "P1", "irregular", "uva"),
    ("start", "P2", "regular", "uv"),
    ("start", "P2", "irregular", "uv"),
    ("start", "Q1", "regular", "uva"),
    ("start", "Q1", "irregular", "uva"),
    ("start", "Q2", "regular", "uv"),
    ("start", "Q2", "irregular", "uv"),
    ("wave", "P1", "regular", "uv"),
    ("wave", "P1", "irregular", "uv"),
    ("wave", "P1", "irregular", "ua"),
    ("wave", "P2", "regular", "uv"),
    ("wave", "P2", "regular", "ua"),
    ("wave", "P2", "irregular", "uv"),
    ("wave", "Q1", "regular", "uv"),
    ("wave", "Q1", "regular", "ua"),
    ("wave", "Q1", "irregular", "uv"),
    ("wave", "Q2", "regular", "uv"),
    ("wave", "Q2", "irregular", "uv"),
    ("wave", "Q2", "irregular", "ua"),
];

/// The field of a run, and its files from coarse to fine.
pub fn files(
    (field, elements, mesh, quantities): (&str, &str, &str, &str),
) -> (&'static str, [String; 4]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/data/scikit_fem");
    let cells = if elements.ends_with('1') { [4, 8, 16, 32] } else { [2, 4, 8, 16] };
    let name = |n: i32| format!("{field}_{elements}_{mesh}_{quantities}_{n:02}.vtu");
    let files = cells.map(|n| folder.join(name(n)).to_string_lossy().into_owned());
    (if field == "wave" { "travelling_wave_2d" } else { "starting_square_2d" }, files)
}

/// The arguments that judge the files of a run.
fn judge(run: (&str, &str, &str, &str)) -> String {
    let (field, files) = files(run);
    format!("judge {field} {} --time 0.012 --map X=points --json", files.join(" "))
}

/// The range of expected orders of l2 of a quantity; `None` if it is not judged.
fn expected(document: &Value, quantity: &str) -> Option<[f64; 2]> {
    let all = document["quantities"].as_array().expect("quantities");
    let norms = all.iter().find(|it| it["name"] == quantity)?["norms"].as_array();
    let l2 = norms.expect("norms").iter().find(|it| it["norm"] == "l2").expect("l2");
    let order = l2["expected_order"].as_f64().expect("an order");
    Some([order, l2["highest_order"].as_f64().unwrap_or(order)])
}

#[test]
fn right_runs_of_finite_elements_pass() {
    let folder = Folder::new();
    for run in sampled(RUNS, SHARE) {
        let (field, elements, mesh, quantities) = run;
        let document = folder.mms(&judge(run)).exits(0).json();
        let order = if elements.ends_with('1') { 2.0 } else { 3.0 };
        assert_eq!(expected(&document, "displacement"), Some([order; 2]), "{run:?}");
        // The guide's table.
        let is_rough = field == "wave" && (elements.ends_with('2') || mesh == "irregular");
        let velocity = [if is_rough { order - 1.0 } else { order }, order];
        let acceleration = [if is_rough { order - 2.0 } else { order }, order];
        let is_seen = quantities.contains('v');
        assert_eq!(expected(&document, "velocity"), is_seen.then_some(velocity), "{run:?}");
        let is_seen = quantities.contains('a') && !(is_rough && mesh == "irregular");
        assert_eq!(expected(&document, "acceleration"), is_seen.then_some(acceleration), "{run:?}");
    }
}

#[test]
fn an_option_says_how_a_run_started() {
    let folder = Folder::new();
    let run = judge(("wave", "Q1", "irregular", "uv"));
    let document = folder.mms(&format!("{run} --start projection")).exits(1).json();
    assert_eq!(expected(&document, "velocity"), Some([2.0, 2.0]));
    // Accelerations alone show nothing.
    let run = judge(("wave", "P1", "irregular", "ua"));
    let document = folder.mms(&format!("{run} --quantity a")).exits(2).json();
    assert_eq!(document["verdict"], "no evidence");
    assert!(document["notes"].to_string().contains("need not fall"), "{document}");
    folder.mms(&format!("{run} --start middle")).exits(2).complains("interpolation, projection");
}

/// Points do not show a mesh, so that only the option lowers an order.
#[test]
fn velocities_at_points_have_the_order_of_u_unless_an_option_says_less() {
    let folder = Folder::new();
    for n in [4, 8, 16] {
        let mut points = "X,Y\n".to_owned();
        for at in 0..(n + 1) * (n + 1) {
            let of = |k: usize| k as f64 / n as f64;
            writeln!(points, "{},{}", of(at / (n + 1)), of(at % (n + 1))).expect("a string");
        }
        folder.write("points.csv", &points);
        let state = "--points points.csv --time 0.012 --quantity u,v -o exact.csv";
        folder.mms(&format!("state travelling_wave_2d {state}")).exits(0);
        let exact = folder.read("exact.csv");
        let (header, rows) = exact.split_once('\n').expect("rows");
        let names: Vec<&str> = header.split(',').collect();
        let off = |name: &str| match name.get(..2) {
            Some("u_") => 0.1 * (n as f64).powi(-2),
            Some("v_") => 10.0 * (n as f64).powf(-1.4),
            _ => 0.0,
        };
        let mut wrong = header.to_owned();
        for row in rows.lines() {
            let numbers = row.split(',').map(|it| it.parse::<f64>().expect("a number"));
            let moved = numbers.zip(&names).map(|(it, name)| (it + off(name)).to_string());
            wrong += &format!("\n{}", moved.collect::<Vec<_>>().join(","));
        }
        folder.write(&format!("{n}.csv"), &format!("{wrong}\n"));
    }
    let judge = "judge travelling_wave_2d 4.csv 8.csv 16.csv";
    folder.mms(judge).exits(1).prints("fail: observed order 1.40");
    let run = folder.mms(&format!("{judge} --start interpolation")).exits(0);
    run.prints("expected order of v: from 1 on").prints("expected 1 to 2");
}

/// The state of a field at the points of a grid as `N.csv`, u with an error of order 2, and of order 1.7 at one corner.
fn with_a_corner(folder: &Folder, field: &str, n: usize) {
    let of = |k: usize| k as f64 / n as f64;
    let mut points = "X,Y\n".to_owned();
    for at in 0..(n + 1) * (n + 1) {
        writeln!(points, "{},{}", of(at / (n + 1)), of(at % (n + 1))).expect("a string");
    }
    folder.write("points.csv", &points);
    let state = "--points points.csv --time 0.012 --quantity u -o exact.csv";
    folder.mms(&format!("state {field} {state}")).exits(0);
    let exact = folder.read("exact.csv");
    let (header, rows) = exact.split_once('\n').expect("rows");
    let column = header.split(',').position(|it| it.starts_with("u_")).expect("a column of u");
    let mut wrong = header.to_owned();
    let rows: Vec<&str> = rows.lines().collect();
    for (at, row) in rows.iter().enumerate() {
        let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
        let is_corner = at + 1 == rows.len();
        let error = if is_corner { 3.0 * (n as f64).powf(-1.7) } else { (n as f64).powi(-2) };
        let u: f64 = cells[column].parse().expect("a number");
        cells[column] = (u + 0.01 * error).to_string();
        wrong += &format!("\n{}", cells.join(","));
    }
    folder.write(&format!("{n}.csv"), &format!("{wrong}\n"));
}

/// A right solver fails where the motion itself is unstable: the judgement repeats what `mms check` says of it.
#[test]
fn a_judgement_that_does_not_pass_repeats_the_warning_about_the_motion() {
    let folder = Folder::new();
    [4, 8, 16].iter().for_each(|&n| with_a_corner(&folder, "sheared_block_2d", n));
    let judge = "judge sheared_block_2d 4.csv 8.csv 16.csv";
    let warning = "`mms check` warns: a disturbance of the corner of x_max and y_max grows";
    let run = folder.mms(judge).exits(1);
    run.prints(warning).prints("; `--set amplitude=0.1` makes the motion smaller");
    let run = folder.mms(&format!("{judge} --expected-order u:linf=1.7")).exits(0);
    assert!(!run.stdout.contains(warning), "{}", run.stdout);
}

#[test]
fn a_lower_order_at_a_corner_alone_is_told_with_its_place() {
    let folder = Folder::new();
    [4, 8, 16].iter().for_each(|&n| with_a_corner(&folder, "travelling_wave_2d", n));
    let judge = "judge travelling_wave_2d 4.csv 8.csv 16.csv";
    let run = folder.mms(judge).exits(1);
    run.prints("linf alone fails, with order 1.70")
        .prints("the largest error of the finest mesh is at X = (1, 1), where the faces x_max and y_max meet")
        .prints("`--expected-order u:linf=1.7` expects that")
        .prints(&format!("\nnext: mms {judge} --expected-order=u:linf=1.7"));
    folder.mms(&format!("{judge} --expected-order u:linf=1.7")).exits(0);
    // A table has no places.
    folder.write(
        "errors.csv",
        "h,l2,linf\n0.25,1.6e-2,8.0e-2\n0.125,4.0e-3,2.46e-2\n0.0625,1.0e-3,7.58e-3\n",
    );
    let run = folder.mms("judge --errors errors.csv").exits(1);
    run.prints("the order is lost at few points; `--expected-order linf=1.7` expects that");
    // A layer at a face is a mistake, and no corner.
    folder.write(
        "errors.csv",
        "h,u_l1,u_l2,u_linf\n0.25,1,1,1\n0.125,0.25,0.353,0.5\n0.0625,0.0625,0.125,0.25\n",
    );
    let run = folder.mms("judge --errors errors.csv").exits(1);
    assert!(!run.stdout.contains("linf alone"), "{run}");
}
