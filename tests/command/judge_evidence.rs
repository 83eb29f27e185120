//! `mms judge FIELD FILE..`: results that are no evidence, the part of the body that results cover, and their times and meshes.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use super::mms::{Folder, Run};

const WAVE: &str = "judge travelling_wave_2d";

/// A file of `data/judge`.
fn data(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/data/judge");
    folder.join(name).to_string_lossy().into_owned()
}

/// Judges files of `data/judge` against the wave.
fn judge(files: &str, options: &str) -> Run {
    let files: Vec<String> = files.split(' ').map(data).collect();
    Folder::new().mms(&format!("{WAVE} {} {options}", files.join(" ")))
}

/// The numbers of one key, for all levels.
fn of_levels(document: &Value, key: &str) -> Vec<f64> {
    let levels = document["levels"].as_array().expect("levels").iter();
    levels.filter_map(|level| level[key].as_f64()).collect()
}

#[track_caller]
fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance;
    assert!(
        found.len() == expected.len() && found.iter().zip(expected).all(is_near),
        "{found:?}, {expected:?}"
    );
}

/// The exact state at points of a table or a mesh; u alone if no other quantities are requested.
fn state(folder: &Folder, field: &str, points: &str, to: &str, options: &str) {
    let state = format!("state {field} --points {points} -o {to} {options}");
    folder.mms(&state).exits(0);
}

/// A table of the points of a grid of the unit square, (n + 1) x (n + 1), that `is_wanted` selects.
fn grid(n: usize, is_wanted: impl Fn(f64, f64) -> bool) -> String {
    let of = |at: usize| at as f64 / n as f64;
    let places = (0..(n + 1) * (n + 1)).map(|at| (of(at / (n + 1)), of(at % (n + 1))));
    let mut table = "X,Y\n".to_owned();
    for (x, y) in places.filter(|&(x, y)| is_wanted(x, y)) {
        writeln!(table, "{x},{y}").expect("a string");
    }
    table
}

/// The state of the wave at such points as `NAME.csv`, with errors of second order in u.
fn wave(folder: &Folder, name: &str, n: usize, is_wanted: impl Fn(f64, f64) -> bool) {
    folder.write("points.csv", &grid(n, is_wanted));
    let options = "--time 0.0158 --quantity u,b";
    state(folder, "travelling_wave_2d", "points.csv", "exact.csv", options);
    let exact = folder.read("exact.csv");
    let mut lines = exact.lines();
    let header = lines.next().expect("a header");
    let names: Vec<&str> = header.split(',').collect();
    let row = |line: &str| {
        let number = |(name, it): (&&str, &str)| match name.starts_with("u_") {
            true => (it.parse::<f64>().expect("a number") + 0.1 / (n * n) as f64).to_string(),
            false => it.to_owned(),
        };
        names.iter().zip(line.split(',')).map(number).collect::<Vec<_>>().join(",")
    };
    let rows: Vec<String> = lines.map(row).collect();
    folder.write(&format!("{name}.csv"), &format!("{header}\n{}\n", rows.join("\n")));
}

#[test]
fn the_start_is_no_evidence() {
    let files = "start_4.pvd start_8.pvd";
    let run = judge(files, "--map X=points").exits(2);
    run.prints("no evidence: observed order 1.90").prints("the solver was given all these values");
    run.prints("left out: 2 results, at times that other files lack");
    run.complains("the solver was given all values that were compared: displacement");
    let document = judge(files, "--map X=points --json").exits(2).json();
    assert_eq!(document["verdict"], "no evidence");
    assert_eq!(document["quantities"][0]["norms"][1]["verdict"], "no evidence");
    assert_eq!(document["excluded"], Value::Null);
    // The exact solution at a later time is no match.
    let folder = Folder::new();
    folder.write("points.csv", &grid(4, |_, _| true));
    for (time, code) in [("0", 2), ("0.0158", 0)] {
        let options = format!("--time {time} --quantity u,v,sigma");
        state(&folder, "travelling_wave_2d", "points.csv", "exact.csv", &options);
        folder.mms(&format!("{WAVE} exact.csv")).exits(code);
    }
}

#[test]
fn walls_and_loads_are_no_evidence_alone() {
    let folder = Folder::new();
    let is_wall = |x: f64, y: f64| [x, y].iter().any(|it| [0.0, 1.0].contains(it));
    for n in [4, 8, 16] {
        wave(&folder, &format!("walls{n}"), n, is_wall);
        wave(&folder, &n.to_string(), n, |_, _| true);
    }
    let walls = "walls4.csv walls8.csv walls16.csv --part";
    folder.mms(&format!("{WAVE} {walls} --quantity u")).exits(2).prints("no evidence");
    let all = "4.csv 8.csv 16.csv";
    folder.mms(&format!("{WAVE} {all} --quantity b")).exits(2).prints("no evidence");
    folder.mms(&format!("{WAVE} {all}")).exits(0);
    // A judgement without evidence is no baseline either.
    folder.mms(&format!("{WAVE} 8.csv --quantity b --output saved")).exits(2);
    let baseline = "--quantity b --baseline saved/convergence.json";
    folder.mms(&format!("{WAVE} 8.csv {baseline}")).exits(2).prints("no evidence");
}

#[test]
fn cells_cover_the_body_or_a_part_that_is_asked_for() {
    let files = "half_8.vtu half_16.vtu";
    let run = judge(files, "--map X=points").exits(2);
    run.complains("half_8.vtu: the cells cover 0.5 of the body").complains("`--part`");
    let run = judge(files, "--map X=points --part").exits(0);
    run.prints("only a part of the body is judged").prints("the cells cover 0.5 of the body");
}

/// A mesh of quads between two radii and angles, in the legacy format; straight, with or without its last cell.
fn ring(counts: [usize; 2], radii: [f64; 2], angles: [f64; 2], cells: usize) -> String {
    let [across, along] = counts;
    let mut text = format!(
        "# vtk DataFile Version 3.0\nring\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n",
        (across + 1) * (along + 1)
    );
    let between = |[a, b]: [f64; 2], at: usize, of: usize| a + (b - a) * at as f64 / of as f64;
    for j in 0..=along {
        for i in 0..=across {
            let (sine, cosine) = between(angles, j, along).sin_cos();
            let radius = between(radii, i, across);
            writeln!(text, "{} {} 0", radius * cosine, radius * sine).expect("a string");
        }
    }
    writeln!(text, "CELLS {cells} {}", 5 * cells).expect("a string");
    for cell in 0..cells {
        let first = cell % across + (across + 1) * (cell / across);
        let above = first + across + 1;
        writeln!(text, "4 {first} {} {} {above}", first + 1, above + 1).expect("a string");
    }
    text + &format!("CELL_TYPES {cells}\n{}", "9\n".repeat(cells))
}

const SECTOR: &str = "conformal_sector_2d";
/// The radii and angles of the sector, a little within it.
const RADII: [f64; 2] = [0.5 + 1e-12, 1.0 - 1e-12];
const ANGLES: [f64; 2] = [0.0, std::f64::consts::FRAC_PI_2];

#[test]
fn sides_that_are_curved_are_covered_by_straight_edges() {
    let folder = Folder::new();
    let mesh = |name: &str, n: usize, without: usize| {
        let counts = [n, 2 * n];
        let all = 2 * n * n - without;
        folder.write("mesh.vtk", &ring(counts, RADII, ANGLES, all));
        state(&folder, SECTOR, "mesh.vtk", name, "--time 0.02 --quantity u");
        folder.mms(&format!("judge {SECTOR} {name} --time 0.02"))
    };
    for n in [2, 4] {
        mesh("all.vtu", n, 0).exits(1);
    }
    let run = mesh("most.vtu", 8, 1).exits(2);
    run.complains("the cells cover 0.99");
}

#[test]
fn points_fill_the_body_or_a_part_that_is_asked_for() {
    let folder = Folder::new();
    let judged = |name: &str, options: &str| {
        let files = [4, 8, 16].map(|n| format!("{name}{n}.csv")).join(" ");
        folder.mms(&format!("{WAVE} {files} --quantity u --h 1/4,1/8,1/16 {options}"))
    };
    let half = |x: f64, _: f64| x <= 0.5;
    let line = |_: f64, y: f64| y == 0.5;
    let probe = |x: f64, y: f64| (x, y) == (0.25, 0.5);
    for n in [4, 8, 16] {
        wave(&folder, &format!("half{n}"), n, half);
        wave(&folder, &format!("line{n}"), n, line);
        wave(&folder, &format!("probe{n}"), n, probe);
    }
    let says = [("half", "X = [1.0, 0.5]"), ("line", "none at X = [0.5, "), ("probe", "1 points")];
    for (name, place) in says {
        let run = judged(name, "").exits(2);
        run.prints("no evidence: observed order 2.00").prints(place).prints("`--part`");
        let run = judged(name, "--part").exits(0);
        run.prints("pass: observed order 2.00").prints("only a part of the body is judged");
    }
    // A mistake stays a mistake in a part of the body.
    let run = folder.mms(&format!("{WAVE} half4.csv half16.csv --quantity u --h 1/4,1/8"));
    run.exits(1);
}

/// A plate with as many points across as along is full.
#[test]
fn points_that_are_nearer_along_one_axis_fill_the_body() {
    let folder = Folder::new();
    let wave = include_str!("../../fields/travelling_wave_2d.toml");
    let edges = "upper = [\"length\", \"length\"]";
    assert!(wave.contains(edges));
    folder.write("thin.toml", &wave.replace(edges, "upper = [\"length\", \"length/1000\"]"));
    let of = |at: usize| (at as f64 + 0.5) / 10.0;
    let places = |across: usize| -> String {
        let rows =
            (0..10 * across).map(|at| format!("{},{}\n", of(at / across), of(at % across) / 1e3));
        "X,Y\n".to_owned() + &rows.collect::<String>()
    };
    for (across, code) in [(10, 0), (5, 2)] {
        folder.write("points.csv", &places(across));
        state(&folder, "thin.toml", "points.csv", "plate.csv", "--time 0.0158 --quantity u");
        folder.mms("judge thin.toml plate.csv").exits(code);
    }
}

#[test]
fn ghosts_do_not_count() {
    let run = judge("ghost_4.pvtu ghost_8.pvtu", "--time 0.0158 --map X=points --json").exits(0);
    let document = run.json();
    near(&of_levels(&document, "order_l2"), &[1.90], 0.005);
    let notes = document["notes"].to_string();
    assert!(notes.contains("left out: 24 ghost cells; 28 ghost points"), "{notes}");
    assert!(notes.contains("ghost_4.pvtu` of 16 cells"), "{notes}");
}

#[test]
fn a_time_is_what_its_text_says() {
    let files = "time_4.pvd time_8.pvd";
    let document = judge(files, "--map X=points --json").exits(0).json();
    near(&of_levels(&document, "order_l2"), &[1.90], 0.005);
    // A time with more digits may be the time that was printed with fewer.
    let other = judge(files, "--map X=points --time 0.0158 --json").json();
    assert_eq!(other["times"], serde_json::json!([0.0158]));
    assert!(of_levels(&other, "l2")[1] > 2.0 * of_levels(&document, "l2")[1]);
    judge(files, "--map X=points --time 0.0258").exits(2).complains("no time at which all files");
}

/// If values have no more digits than the time, the writer cut the time off.
#[test]
fn a_time_that_was_rounded_is_named() {
    let folder = Folder::new();
    folder.write("points.csv", &grid(4, |_, _| true));
    let options = "--time 0.01234567 --quantity u";
    state(&folder, "travelling_wave_2d", "points.csv", "exact.csv", options);
    let digits = |number: &str, count: usize| {
        let number: f64 = number.parse().expect("a number");
        format!("{number:.count$e}")
    };
    let exact = folder.read("exact.csv");
    let table = |time: &str| {
        let row = |line: &str| {
            let all: Vec<&str> = line.split(',').collect();
            let values = all[1..].iter().map(|it| digits(it, 5)).collect::<Vec<_>>();
            format!("{time},{}\n", values.join(","))
        };
        let rows: String = exact.lines().skip(1).map(row).collect();
        format!("time,X,Y,u_x,u_y\n{rows}")
    };
    folder.write("a.csv", &table("0.0123457"));
    let run = folder.mms(&format!("{WAVE} a.csv"));
    run.prints("(6 significant digits), and of its time t = 0.0123457; say it with `--time`");
    let run = folder.mms(&format!("{WAVE} a.csv --time 0.01234567"));
    run.prints("at t = 0.01234567").prints("(6 significant digits); it is left out");
    // If values have more digits than the time, the time is complete.
    folder.write("a.csv", &table("0.0123"));
    let run = folder.mms(&format!("{WAVE} a.csv")).exits(1);
    assert!(!run.stdout.contains("its floor"), "{run}");
    run.prints("is t = 0.0123 rounded? At t = 1.23457e-2 the error of u is ");
    run.prints("give the exact time with `--time`");
    let run = folder.mms(&format!("{WAVE} a.csv --time 0.01234567"));
    run.prints("at t = 0.01234567").prints("(6 significant digits); it is left out");
}

/// Times of three digits, whose last digit has another place value at later times.
#[test]
fn evenly_spaced_times_show_that_they_were_rounded() {
    let folder = Folder::new();
    folder.write("points.csv", &grid(4, |_, _| true));
    let mut text = String::from("time,X,Y,u_x,u_y\n");
    for k in 1..=4 {
        let time = f64::from(k) * 0.0039473;
        let options = format!("--time {time} --quantity u");
        state(&folder, "travelling_wave_2d", "points.csv", "exact.csv", &options);
        for row in folder.read("exact.csv").lines().skip(1) {
            let (_, values) = row.split_once(',').expect("columns");
            text += &format!("{time:.2e},{values}\n");
        }
    }
    folder.write("a.csv", &text);
    folder.mms(&format!("{WAVE} a.csv")).prints("and of its time t = ").prints("at its floor");
}

#[test]
fn results_of_another_value_of_a_parameter_raise_a_question() {
    let folder = Folder::new();
    for n in [4, 8, 16] {
        folder.write("points.csv", &grid(n, |_, _| true));
        let options = "--time 0.0125 --quantity u --set amplitude=0.03";
        state(&folder, "axis_aligned_2d", "points.csv", &format!("{n}.csv"), options);
    }
    let run = folder.mms("judge axis_aligned_2d 4.csv 8.csv 16.csv").exits(1);
    run.prints("did your solver use another amplitude than 0.05? With `--set amplitude=0.03` the ");
    let run = folder.mms("judge axis_aligned_2d 4.csv 8.csv 16.csv --set amplitude=0.03");
    assert!(!run.stdout.contains("did your solver use"), "{run}");
}

/// Corners, and middles of edges: no coordinate is rounded, although they have one digit.
#[test]
fn coordinates_of_a_grid_are_exact() {
    let folder = Folder::new();
    let points = "X,Y,Z\n0,0,0.5\n1,0,0.5\n0.5,0.5,0\n0.5,1,1\n0.5,0.5,0.5\n";
    folder.write("points.csv", points);
    let run = folder.mms("state axis_aligned_3d --points points.csv --time 0.01 -o exact.csv");
    let head = run.exits(0).stdout;
    let text = folder.read("exact.csv");
    let columns: Vec<&str> = text.lines().next().expect("a head").split(',').collect();
    let at = columns.iter().position(|it| it.starts_with("traction_x_max")).expect("tractions");
    let on_face = |line: &str| line.split(',').nth(at).is_some_and(|it| it != "0" && it != "0.0");
    let rows: Vec<bool> = text.lines().skip(1).map(on_face).collect();
    assert_eq!(rows, [false, true, false, false, false], "{head}\n{text}");
}

#[test]
fn nodes_are_as_far_from_each_other_as_cells_are_wide() {
    let files = "nodes_4.csv nodes_8.csv";
    let document = judge(files, "--time 0.0158 --json").exits(0).json();
    near(&of_levels(&document, "cell_size"), &[0.25, 0.125], 1e-12);
    near(&of_levels(&document, "order_l2"), &[2.04], 0.01);
    let given = judge(files, "--time 0.0158 --h 1/4,1/8 --json").exits(0).json();
    assert_eq!(given["levels"], document["levels"]);
    judge(files, "--time 0.0158 --h 1/0,1/8").exits(2).complains("expected a positive number");
    // Nodes only inside the body.
    let folder = Folder::new();
    let is_inside = |x: f64, y: f64| [x, y].iter().all(|it| (0.001..0.999).contains(it));
    for n in [8, 16] {
        wave(&folder, &n.to_string(), n, is_inside);
    }
    let document = folder.mms(&format!("{WAVE} 8.csv 16.csv --quantity u --json")).exits(0).json();
    near(&of_levels(&document, "cell_size"), &[0.125, 0.0625], 1e-12);
}

#[test]
fn the_files_of_a_list_of_states_are_told_with_their_times() {
    let file = data("start_8.pvd");
    let run = Folder::new().mms(&format!("{WAVE} {file} --explain")).exits(0);
    run.prints("start_8_0.vtu, t = 0.0\n").prints("start_8_1.vtu, t = 0.0158");
    let document = Folder::new().mms(&format!("{WAVE} {file} --explain --json")).exits(0).json();
    let paths = document["files"][0]["paths"].as_array().expect("paths");
    assert_eq!(paths.len(), 2);
    assert!(paths[1].as_str().is_some_and(|it| it.ends_with("start_8_1.vtu")), "{document:#}");
    // One file needs no list.
    let alone = Folder::new().mms(&format!("{WAVE} {} --explain", data("start_8_1.vtu"))).exits(0);
    assert!(!alone.stdout.contains("\n  file "), "{alone}");
}
