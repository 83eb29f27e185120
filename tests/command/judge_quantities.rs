//! `mms judge FIELD FILE..`: quantities besides u, how they are judged, and results that have no order.

use serde_json::Value;

use super::mms::{Folder, assert_close, numbers};

/// A grid of n x n points of the unit square with its corners, as a table.
fn grid(n: usize) -> String {
    let of = |at: usize| at as f64 / (n - 1) as f64;
    let rows = (0..n * n).map(|at| format!("{},{}\n", of(at % n), of(at / n)));
    "X,Y\n".to_owned() + &rows.collect::<String>()
}

/// The exact state of a field at the points of such a grid.
fn state(folder: &Folder, field: &str, n: usize, options: &str) -> String {
    folder.write("grid.csv", &grid(n));
    let state = format!("state {field} --points grid.csv --time 0.02 -o state.csv {options}");
    folder.mms(&state).exits(0);
    folder.read("state.csv")
}

/// A table whose numbers are replaced by `change`, which gets the name of the column and the number.
fn changed(table: &str, change: impl Fn(&str, f64) -> f64) -> String {
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    let names: Vec<&str> = header.split(',').collect();
    let row = |line: &str| {
        let numbers = line.split(',').zip(&names);
        let numbers = numbers.map(|(it, name)| change(name, it.parse().expect("a number")));
        numbers.map(|it| format!("{it:?}")).collect::<Vec<_>>().join(",")
    };
    let rows: Vec<String> = lines.map(row).collect();
    format!("{header}\n{}\n", rows.join("\n"))
}

fn quantity<'a>(document: &'a Value, name: &str) -> &'a Value {
    let all = document["quantities"].as_array().expect("quantities");
    all.iter().find(|it| it["name"] == name).unwrap_or_else(|| panic!("no {name}"))
}

/// The largest error on the only level.
fn largest(document: &Value, name: &str) -> f64 {
    let norms = quantity(document, name)["norms"].as_array().expect("norms");
    let norm = norms.iter().find(|it| it["norm"] == "linf").expect("linf");
    norm["levels"][0]["error"].as_f64().expect("an error")
}

#[test]
fn the_exact_solution_is_told_and_nothing_speaks_against_it() {
    let folder = Folder::new();
    state(&folder, "sheared_block_2d", 5, "");
    let run = folder.mms("judge sheared_block_2d state.csv --output judged").exits(0);
    run.prints("exact to round-off: 8 of 8 quantities pass");
    run.complains("warning: exact to round-off on every mesh: displacement, velocity");
    let document = folder.mms("judge sheared_block_2d state.csv --json").exits(0).json();
    assert_eq!(document["verdict"], "exact to round-off");
    assert_eq!(quantity(&document, "velocity")["verdict"], "exact to round-off");
    // Errors that are round-off may change.
    let baseline = "judge sheared_block_2d state.csv --baseline judged/convergence.json";
    folder.mms(baseline).exits(0).prints("pass");
    // One quantity above round-off decides.
    let table = folder.read("state.csv");
    folder
        .write("wrong.csv", &changed(&table, |name, it| if name == "v_x" { it + 1.0 } else { it }));
    let document = folder.mms("judge sheared_block_2d wrong.csv --json").exits(1).json();
    assert_eq!(document["verdict"], "not asymptotic");
    assert_eq!(document["quantity"], "velocity");
}

/// Three digits of u hide all errors of the solver.
#[test]
fn too_few_digits_are_no_exact_solution() {
    let folder = Folder::new();
    let table = state(&folder, "sheared_block_2d", 5, "--quantity u");
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    let short = |line: &str| -> String {
        let all: Vec<_> = line.split(',').collect();
        let number = |it: &&str| format!("{:.3}", it.parse::<f64>().expect("a number"));
        [&all[..3].join(","), &all[3..].iter().map(number).collect::<Vec<_>>().join(",")]
            .map(String::as_str)
            .join(",")
    };
    let rows: Vec<String> = lines.map(short).collect();
    folder.write("short.csv", &format!("{header}\n{}\n", rows.join("\n")));
    let run = folder.mms("judge sheared_block_2d short.csv").exits(1);
    run.prints("not asymptotic").complains("(3 digits after the point): write more of them");
}

/// T is P N: for a face by its name, for normals beside it, or at points of a single face.
#[test]
fn tractions_are_judged_on_their_faces() {
    let folder = Folder::new();
    let table = state(&folder, "sheared_block_2d", 5, "--quantity traction");
    let judge = |table: &str| {
        folder.write("t.csv", table);
        folder.mms("judge sheared_block_2d t.csv --quantity traction --json").json()
    };
    let off = |name: &str, it: f64| if name == "traction_x_max_y" { it + 10.0 } else { it };
    let document = judge(&changed(&table, off));
    assert_eq!(document["samplings"]["traction"], "points of faces");
    assert_close(largest(&document, "traction"), 10.0, 1e-9);
    let norms = &quantity(&document, "traction")["norms"];
    // Five points of twenty, since each corner occurs twice.
    assert_close(norms[0]["levels"][0]["error"].as_f64().expect("l1"), 2.5, 1e-9);

    // A single face, by its normals, and 0 where there is none.
    let header = table.lines().next().expect("a header");
    let at = |name: &str| header.split(',').position(|it| it == name).expect("a column");
    let [x, y] = ["traction_y_max_x", "traction_y_max_y"].map(at);
    let by_normals = |normal: &dyn Fn(&[f64]) -> String| {
        let rows = table.lines().skip(1).map(|line| {
            let all: Vec<f64> = line.split(',').map(|it| it.parse().expect("a number")).collect();
            format!(
                "{:?},{:?},{:?},{:?},{:?}{}\n",
                all[0],
                all[1],
                all[2],
                all[x],
                all[y] + 5.0,
                normal(&all)
            )
        });
        rows.collect::<String>()
    };
    let rows = by_normals(&|all| if all[2] == 1.0 { ",0,1".into() } else { ",0,0".into() });
    let document = judge(&format!("time,X,Y,traction_x,traction_y,N_x,N_y\n{rows}"));
    assert_close(largest(&document, "traction"), 5.0, 1e-9);
    assert_close(
        quantity(&document, "traction")["norms"][0]["levels"][0]["error"].as_f64().expect("l1"),
        5.0,
        1e-9,
    );
    let long = by_normals(&|_| ",0,2".into());
    folder.write("t.csv", &format!("time,X,Y,traction_x,traction_y,N_x,N_y\n{long}"));
    let judge_t = "judge sheared_block_2d t.csv --quantity traction";
    folder.mms(judge_t).exits(2).complains("t.csv:2: the normal has a length of 2");
    // Corners belong to two faces: values there are not judged.
    let alone = table.lines().skip(1).map(|line| {
        let all: Vec<f64> = line.split(',').map(|it| it.parse().expect("a number")).collect();
        let is_corner = [all[1], all[2]].iter().all(|it| [0.0, 1.0].contains(it));
        let names = ["x_min", "x_max", "y_min", "y_max"];
        let sum = |axis: &str| -> f64 {
            names.iter().map(|face| all[at(&format!("traction_{face}_{axis}"))]).sum()
        };
        let off = if is_corner { 1e9 } else { 0.0 };
        format!("{:?},{:?},{:?},{:?},{:?}\n", all[0], all[1], all[2], sum("x") + off, sum("y"))
    });
    let table = alone.collect::<String>();
    let document = judge(&format!("time,X,Y,traction_x,traction_y\n{table}"));
    assert_eq!(document["verdict"], "exact to round-off");
    folder.write("t.csv", "time,X,Y,traction_inner_x,traction_inner_y\n0.02,0,0,1,1\n");
    folder.mms(judge_t).exits(2).complains("`traction_inner`: no point lies on such a face");
}

/// The nine components follow the law in three dimensions, checked through von Mises stress and S = F^-1 P.
#[test]
fn all_nine_components_are_those_of_plane_strain() {
    let folder = Folder::new();
    let eval = "eval plane_strain_gent --at 0.3,0.4 --time 0 --all-components --json";
    let document =
        folder.mms(&format!("{eval} --quantity sigma,P,S,F,E,J,von_mises,p")).exits(0).json();
    let of = |name: &str| numbers(&document["points"][0][name]);
    let (sigma, first, second) =
        (of("cauchy_stress"), of("first_piola_kirchhoff"), of("second_piola_kirchhoff"));
    let f = of("deformation_gradient");
    assert_eq!((f.len(), f[8], f[2], f[6]), (9, 1.0, 0.0, 0.0));
    assert_eq!(of("green_lagrange")[8], 0.0);
    assert_close(first[8], of("jacobian")[0] * sigma[8], 1e-12);
    assert_close(second[8], first[8], 1e-12);
    assert_close(-(sigma[0] + sigma[4] + sigma[8]) / 3.0, of("pressure")[0], 1e-12);
    let mean = -of("pressure")[0];
    let deviator: f64 =
        (0..9).map(|at| (sigma[at] - if at % 4 == 0 { mean } else { 0.0 }).powi(2)).sum();
    assert_close((1.5 * deviator).sqrt(), of("von_mises")[0], 1e-10);
    // In a bar both are the same.
    let bar =
        folder.mms("eval bar_1d --at 0.3 --time 0 --all-components --quantity sigma,p --json");
    let point = bar.json()["points"][0].clone();
    let sigma = numbers(&point["cauchy_stress"]);
    assert_eq!(sigma[4], sigma[8]);
    assert_close(sigma[0] + 2.0 * sigma[8], -3.0 * numbers(&point["pressure"])[0], 1e-12);

    // A state has nine components, which are judged on request.
    for file in ["state.csv", "state.npz", "state.vtu"] {
        folder.write("grid.csv", &grid(4));
        let state = format!(
            "state sheared_block_2d --points grid.csv --time 0.02 -o {file} --quantity u,sigma --all-components"
        );
        folder.mms(&state).exits(0);
        folder.mms(&format!("judge sheared_block_2d {file} --all-components")).exits(0);
    }
    let off = |name: &str, it: f64| if name == "sigma_zz" { it + 100.0 } else { it };
    folder.write("off.csv", &changed(&folder.read("state.csv"), off));
    let judge = "judge sheared_block_2d off.csv --quantity sigma";
    folder.mms(judge).exits(0);
    let document = folder.mms(&format!("{judge} --all-components --json")).exits(1).json();
    assert_close(largest(&document, "cauchy_stress"), 100.0, 1e-9);
    // Four components do not count as nine.
    state(&folder, "sheared_block_2d", 4, "--quantity u,sigma");
    let four = folder.mms("judge sheared_block_2d state.csv --all-components");
    four.exits(2).complains("has 4 component(s), and of 3 dimension(s) 9 are expected");
}

/// Points in another order; points between two ranks occur twice.
#[test]
fn results_in_another_order_are_the_same() {
    let folder = Folder::new();
    folder.write("a.csv", "X,Y,u_x,u_y\n0,0,1,2\n1,0,3,4\n0,1,5,6\n");
    folder.write("b.csv", "X,Y,u_x,u_y\n0,1,5,6.5\n0,0,1,2\n1,0,3,4\n0,1,5,6\n");
    let run = folder.mms("judge --same a.csv b.csv").exits(0);
    run.prints("points are paired by X");
    let document = folder.mms("judge --same a.csv b.csv --json").exits(0).json();
    assert_eq!(document["paired"], "by X");
    let of = |name: &str| {
        let all = document["differences"].as_array().expect("differences");
        let found = all.iter().find(|it| it["array"] == name).expect("an array").clone();
        (found["largest"].as_f64().expect("a number"), found["where"].clone())
    };
    assert_eq!(of("u_x").0, 0.0);
    assert_eq!(of("u_y"), (0.5, "a.csv:4".into()));
    folder.write("c.csv", "X,Y,u_x,u_y\n0,1,5,6\n1,0,3,4\n0,0.5,1,2\n");
    folder
        .mms("judge --same a.csv c.csv")
        .exits(2)
        .complains("a.csv:2: this point has no partner in c.csv by its X");
    let ids = "id,X,Y,u_x,u_y\n7,0,0,1,2\n9,1,0,3,4\n8,0,1,5,6\n";
    folder.write("d.csv", ids);
    folder.write("e.csv", "id,X,Y,u_x,u_y\n8,0,1,5,6\n9,1,0,3,4\n7,0,0,1,2\n");
    folder.mms("judge --same d.csv e.csv").exits(0).prints("by the number in `id`");
}

/// A quad mesh of n x n cells with u = exact + error at its nodes, and P of its cells with errors of order h: of theory 1.
fn mesh(folder: &Folder, n: usize, power: i32) -> String {
    let side = n + 1;
    folder.write("nodes.csv", &grid(side));
    let middles = (0..n * n).map(|at| {
        format!("{},{}\n", ((at % n) as f64 + 0.5) / n as f64, ((at / n) as f64 + 0.5) / n as f64)
    });
    folder.write("middles.csv", &("X,Y\n".to_owned() + &middles.collect::<String>()));
    let values = |points: &str, quantity: &str| -> Vec<Vec<f64>> {
        let eval = format!(
            "eval axis_aligned_2d --points {points} --time 0.02 --quantity {quantity} --json"
        );
        let document = folder.mms(&eval).exits(0).json();
        let name = if quantity == "u" { "displacement" } else { "first_piola_kirchhoff" };
        let points = document["points"].as_array().expect("points");
        points.iter().map(|it| numbers(&it[name])).collect()
    };
    let h = 1.0 / n as f64;
    let mut text = format!(
        "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n",
        side * side
    );
    for at in 0..side * side {
        text += &format!("{} {} 0\n", (at % side) as f64 * h, (at / side) as f64 * h);
    }
    text += &format!("CELLS {} {}\n", n * n, 5 * n * n);
    for cell in 0..n * n {
        let first = cell % n + side * (cell / n);
        text += &format!("4 {} {} {} {}\n", first, first + 1, first + side + 1, first + side);
    }
    text += &format!("CELL_TYPES {}\n{}", n * n, "9\n".repeat(n * n));
    text += &format!("POINT_DATA {}\nVECTORS u double\n", side * side);
    for u in values("nodes.csv", "u") {
        text += &format!("{:?} {:?} 0\n", u[0], u[1]);
    }
    text += &format!("CELL_DATA {}\nTENSORS P double\n", n * n);
    for p in values("middles.csv", "P") {
        let off = 1e4 * h.powi(power);
        text += &format!("{:?} {:?} 0\n{:?} {:?} 0\n0 0 0\n", p[0] + off, p[1], p[2], p[3]);
    }
    text
}

/// Stresses have one order less in theory, and as much as u at some points; such results are labelled.
#[test]
fn stresses_of_cells_have_an_order_of_their_own() {
    let folder = Folder::new();
    let judge = |power: i32, options: &str| {
        for n in [4, 8, 16] {
            folder.write(&format!("{n}.vtk"), &mesh(&folder, n, power));
        }
        let files = "4.vtk 8.vtk 16.vtk --time 0.02 --map X=points";
        folder.mms(&format!("judge axis_aligned_2d {files} --json {options}")).json()
    };
    let seen = |document: &Value| {
        let found = quantity(document, "first_piola_kirchhoff");
        let l2 = &found["norms"][1];
        let order = l2["expected_order"].as_f64().expect("an order");
        let highest = l2["highest_order"].as_f64().unwrap_or(order);
        (found["verdict"].clone(), [order, highest], found["superconvergent"].clone())
    };
    let first = judge(1, "");
    assert_eq!(seen(&first), ("pass".into(), [1.0, 2.0], false.into()));
    assert_eq!(quantity(&first, "displacement")["norms"][1]["expected_order"], 2.0);
    let second = judge(2, "");
    assert_eq!(seen(&second), ("pass".into(), [1.0, 2.0], true.into()));
    let says = &quantity(&second, "first_piola_kirchhoff")["says"];
    assert!(says.to_string().contains("superconvergence: these"), "{says}");
    // A given expected order is enforced.
    assert_eq!(seen(&judge(1, "--expected-order P=2")), ("fail".into(), [2.0, 2.0], false.into()));
    let by_norm = judge(1, "--expected-order P:linf=2,u:H1=1");
    let norms = &quantity(&by_norm, "first_piola_kirchhoff")["norms"];
    assert_eq!(
        (&norms[1]["expected_order"], &norms[2]["expected_order"]),
        (&1.0.into(), &2.0.into())
    );
    folder
        .mms("judge axis_aligned_2d 4.vtk --time 0.02 --map X=points --expected-order P:l7=2")
        .exits(2)
        .complains("`--expected-order P:l7=..`: it is not judged");
}

/// A mesh of n lines of three nodes, with the exact u at its nodes: the only error is interpolation.
fn quadratic_lines(folder: &Folder, n: usize) -> String {
    let places = (0..=2 * n).map(|at| at as f64 / (2 * n) as f64);
    let rows: String = places.clone().map(|x| format!("{x}\n")).collect();
    folder.write("nodes.csv", &format!("X\n{rows}"));
    let eval = "eval axis_aligned_1d --points nodes.csv --time 0.01 --quantity u --json";
    let document = folder.mms(eval).exits(0).json();
    let points: String = places.map(|x| format!("{x} 0 0\n")).collect();
    let cells = (0..n).map(|at| format!("3 {} {} {}\n", 2 * at, 2 * at + 2, 2 * at + 1));
    let u = document["points"].as_array().expect("points").iter();
    let u = u.map(|it| format!("{:?}\n", numbers(&it["displacement"])[0]));
    format!(
        "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n{points}CELLS {n} \
         {}\n{}CELL_TYPES {n}\n{}POINT_DATA {}\nSCALARS u double 1\nLOOKUP_TABLE default\n{}",
        2 * n + 1,
        4 * n,
        cells.collect::<String>(),
        "21\n".repeat(n),
        2 * n + 1,
        u.collect::<String>()
    )
}

/// u of elements of degree 2 is of third order, and its gradient of second.
#[test]
fn elements_of_degree_2_have_an_order_more() {
    let folder = Folder::new();
    for n in [8, 16, 32, 64] {
        folder.write(&format!("{n}.vtk"), &quadratic_lines(&folder, n));
    }
    let judge = "judge axis_aligned_1d 8.vtk 16.vtk 32.vtk 64.vtk --time 0.01 --map X=points";
    let run = folder.mms(judge).exits(0);
    run.prints("expected order: 3, one more than the degree of the cells");
    run.prints("pass: observed order 3.0").prints("expected 3");
    folder.mms(&format!("{judge} --expected-order 2")).exits(1).prints("expected 2");
    // An order of u applies to its values, not to its gradient.
    folder.mms(&format!("{judge} --expected-order u=3")).exits(0).prints("expected 3");
    folder.mms(&format!("{judge} --expected-order u=3,u:H1=3")).exits(1).prints("(h1;");
}

/// A table of the bar with errors of second order, and of a solver's tolerance that is the same on all meshes.
fn iterated(folder: &Folder, name: &str, n: usize, tolerance: f64) {
    folder.write(
        "points.csv",
        &("X\n".to_owned()
            + &(0..n).map(|at| format!("{}\n", (at as f64 + 0.5) / n as f64)).collect::<String>()),
    );
    folder.mms("state bar_1d --points points.csv --time 0.02 --quantity u -o u.csv").exits(0);
    let error = 1e-2 / (n * n) as f64 + tolerance;
    folder.write(
        name,
        &changed(&folder.read("u.csv"), |name, it| if name == "u" { it + error } else { it }),
    );
}

/// The iterative error is the difference of two runs; 100 times this error is a floor.
#[test]
fn iterative_errors_are_found_from_two_runs() {
    let folder = Folder::new();
    for n in [8, 16, 32, 64] {
        iterated(&folder, &format!("{n}.csv"), n, 1e-7);
    }
    iterated(&folder, "tight.csv", 8, 1e-12);
    let judge = "judge bar_1d 8.csv 16.csv 32.csv 64.csv --quantity u";
    let run = folder.mms(&format!("{judge} --tighter tight.csv")).exits(0);
    run.prints("iterative errors, from `tight.csv`, root mean squares: u 1.0e-7");
    // Of 1.56e-4, 3.9e-5, 9.8e-6 and 2.4e-6 the last two are less than 100 times larger.
    run.prints("`32.csv`: the error of displacement is at its floor of 1.0e-5, a hundred times its iterative error");
    run.prints("(l2; 2 levels, h 1.250e-1 to h 6.250e-2)");
    folder
        .mms(judge)
        .exits(0)
        .prints("(l2; 4 levels")
        .prints("a plateau, 3.9 % of the finest error");
    iterated(&folder, "other.csv", 9, 1e-12);
    folder
        .mms(&format!("{judge} --tighter other.csv"))
        .exits(2)
        .complains("9 points, which no FILE has");
}
