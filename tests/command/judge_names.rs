//! `mms judge FIELD FILE..`: ambiguous names, and the options that choose a reading.

use super::mms::{Folder, Run};

const WAVE: &str = "travelling_wave_2d";

/// A table of exact values at nodes of the unit square, with the columns that `state` writes for some quantities.
fn on_grid(folder: &Folder, side: u32, quantities: &str) -> Vec<Vec<String>> {
    let place = |at: u32| f64::from(at) / f64::from(side);
    let count = side + 1;
    let nodes: String = (0..count * count)
        .map(|at| format!("{},{}\n", place(at % count), place(at / count)))
        .collect();
    folder.write("nodes.csv", &format!("X,Y\n{nodes}"));
    let state =
        format!("state {WAVE} --points nodes.csv --time 0.01 --quantity {quantities} -o exact.csv");
    folder.mms(&state).exits(0);
    let text = folder.read("exact.csv");
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// Exact values at 9 x 9 nodes.
fn exact(folder: &Folder, quantities: &str) -> Vec<Vec<String>> {
    on_grid(folder, 8, quantities)
}

/// A table with some of these columns under other names.
fn table(rows: &[Vec<String>], columns: &[(&str, &str)]) -> String {
    let at = |name: &str| {
        let found = rows[0].iter().position(|it| it == name);
        found.unwrap_or_else(|| panic!("no {name} in {:?}", rows[0]))
    };
    let header: Vec<&str> = columns.iter().map(|(_, new)| *new).collect();
    let line = |row: &Vec<String>| {
        let values: Vec<&str> = columns.iter().map(|(old, _)| row[at(old)].as_str()).collect();
        values.join(",") + "\n"
    };
    format!("{}\n{}", header.join(","), rows[1..].iter().map(line).collect::<String>())
}

/// The options in backquotes that a message suggests, in its order.
fn suggested(run: &Run) -> Vec<String> {
    let parts = run.stderr.split("`--").skip(1);
    parts.filter_map(|it| Some(format!("--{}", it.split_once('`')?.0))).collect()
}

/// Follows the first suggestion of each message until the file is judged; returns the options used.
fn followed(folder: &Folder, command: &str) -> String {
    let mut options = String::new();
    for _ in 0..4 {
        let run = folder.mms(&format!("{command}{options}"));
        if run.code == 0 {
            run.prints("exact to round-off");
            return options;
        }
        let run = run.exits(2);
        let next =
            suggested(&run).into_iter().next().unwrap_or_else(|| panic!("no option in {run}"));
        options += &format!(" {next}");
    }
    panic!("no verdict with {options}");
}

#[test]
fn suggestions_for_positions_and_quantities_lead_to_a_verdict() {
    let folder = Folder::new();
    let rows = exact(&folder, "u");
    for names in
        [["c1", "c2", "c3", "c4"], ["p1", "p2", "depl_1", "depl_2"], ["Px", "Py", "w0", "w1"]]
    {
        let columns = [("X", names[0]), ("Y", names[1]), ("u_x", names[2]), ("u_y", names[3])];
        folder.write("odd.csv", &table(&rows, &columns));
        let judge = format!("judge {WAVE} odd.csv --time 0.01");
        let run = folder.mms(&judge).exits(2);
        run.complains("no positions found").complains(&format!("`{}`", names[3]));
        let options = followed(&folder, &judge);
        let expected =
            format!(" --map X={},{} --map u={},{}", names[0], names[1], names[2], names[3]);
        assert_eq!(options, expected);
    }
    // The columns are among other columns.
    let columns = [("u_x", "m"), ("u_y", "n"), ("time", "time"), ("X", "q"), ("Y", "r")];
    folder.write("odd.csv", &table(&rows, &columns));
    let options = followed(&folder, &format!("judge {WAVE} odd.csv"));
    assert_eq!(options, " --map X=q,r --map u=m,n");
}

#[test]
fn s_is_asked_for_unless_the_file_or_the_user_tells() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,P,S,sigma");
    let place = [("X", "X"), ("Y", "Y"), ("u_x", "u_x"), ("u_y", "u_y")];
    let with = |more: &[(&'static str, &'static str)]| table(&rows, &[&place[..], more].concat());
    let of = |role: &'static str,
              name: &'static [&'static str; 4]|
     -> Vec<(&'static str, &'static str)> {
        let own = match role {
            "S" => ["S_xx", "S_xy", "S_yx", "S_yy"],
            "sigma" => ["sigma_xx", "sigma_xy", "sigma_yx", "sigma_yy"],
            _ => ["P_xx", "P_xy", "P_yx", "P_yy"],
        };
        own.into_iter().zip(*name).collect()
    };
    const NAMES: &[&str; 4] = &["S11", "S12", "S21", "S22"];
    let judge = format!("judge {WAVE} s.csv --time 0.01");
    for (role, option) in [("sigma", " --map sigma=S"), ("S", " --map S=S")] {
        folder.write("s.csv", &with(&of(role, NAMES)));
        let run = folder.mms(&judge).exits(2);
        run.complains("may be cauchy_stress or second_piola_kirchhoff");
        assert_eq!(suggested(&run)[..2], ["--map sigma=S".to_owned(), "--map S=S".to_owned()]);
        let right = folder.mms(&format!("{judge}{option}")).exits(0);
        right.prints("exact to round-off").prints(if role == "S" {
            "second_piola_kirchhoff"
        } else {
            "cauchy_stress"
        });
        let other = if role == "S" { " --map sigma=S" } else { " --map S=S" };
        folder.mms(&format!("{judge}{other}")).exits(1);
        folder.mms(&format!("{judge} --quantity u")).exits(0);
    }
    // Beside P, S has its meaning in textbooks.
    folder
        .write("s.csv", &with(&[of("S", NAMES), of("P", &["P11", "P12", "P21", "P22"])].concat()));
    folder.mms(&judge).exits(0).prints("second_piola_kirchhoff");
    let abaqus = "source = 'x'\norders = ['11,22,33,12']\n[quantities]\nsigma = 'S'\n";
    folder.write("own.toml", abaqus);
    folder.write("s.csv", &with(&of("sigma", NAMES)));
    folder.mms(&format!("{judge} --from own.toml")).exits(0).prints("cauchy_stress");
}

#[test]
fn a_density_that_is_the_reference_one_is_asked_for() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,rho");
    let place = [("X", "X"), ("Y", "Y"), ("u_x", "u_x"), ("u_y", "u_y")];
    folder.write("now.csv", &table(&rows, &[&place[..], &[("density", "density")]].concat()));
    let judge =
        |name: &str, rest: &str| folder.mms(&format!("judge {WAVE} {name} --time 0.01 {rest}"));
    judge("now.csv", "").exits(0).prints("mass_density");
    let mut constant = rows.clone();
    let at = rows[0].iter().position(|it| it == "density").expect("a density");
    let reference = folder
        .mms(&format!("eval {WAVE} --at 0.5,0.5 --time 0.01 --quantity rho,J --json"))
        .exits(0)
        .json();
    let number = |name: &str| {
        reference["points"][0][name][0].as_f64().unwrap_or_else(|| panic!("{reference}"))
    };
    let reference = number("mass_density") * number("jacobian");
    constant[1..].iter_mut().for_each(|row| row[at] = format!("{reference:.9e}"));
    folder.write("first.csv", &table(&constant, &[&place[..], &[("density", "density")]].concat()));
    let run = judge("first.csv", "").exits(2);
    run.complains("`density` is the reference density of the field at all points");
    assert_eq!(suggested(&run), ["--map rho0=density", "--map rho=density"]);
    judge("first.csv", "--map rho0=density")
        .exits(0)
        .prints("found and not judged: reference_density");
    judge("first.csv", "--map rho=density").exits(1).prints("mass_density");
}

#[test]
fn arrays_of_other_shapes_are_left_out_unless_they_are_asked_for() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,v,sigma");
    let columns = [
        ("X", "X"),
        ("Y", "Y"),
        ("u_x", "u_x"),
        ("u_y", "u_y"),
        ("v_x", "velocity"),
        ("X", "F_xx"),
        ("Y", "F_xy"),
        ("sigma_xx", "id"),
    ];
    folder.write("odd.csv", &table(&rows, &columns));
    let judge = format!("judge {WAVE} odd.csv --time 0.01");
    let run = folder.mms(&judge).exits(0);
    run.prints("velocity (one number, and no velocity)");
    run.prints("F (2 components, and deformation_gradient has 4)");
    folder
        .mms(&format!("{judge} --quantity u,v"))
        .exits(2)
        .complains("`velocity`, read as velocity, has 1 component(s)");
    let run = folder.mms(&format!("{judge} --explain")).exits(0);
    run.prints("left out")
        .prints("id (not a quantity)")
        .prints("`u_x`, `u_y` of points")
        .prints("X as given");
    let document = folder.mms(&format!("{judge} --explain --json")).exits(0).json();
    assert_eq!(document["files"][0]["file"], "odd.csv");
}

#[test]
fn a_profile_decides_what_the_numbers_leave_open() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,x");
    let columns = [("x", "px"), ("y", "py"), ("u_x", "ux"), ("u_y", "uy")];
    folder.write("moved.csv", &table(&rows, &columns));
    let judge = |rest: &str| folder.mms(&format!("judge {WAVE} moved.csv --time 0.01 {rest}"));
    let profile = |points: &str| {
        format!("source = 'a test'\npoints = '{points}'\n[quantities]\nx = 'p'\nu = 'u'\n")
    };
    folder.write("own.toml", &profile("x"));
    judge("--from own.toml").exits(0).prints("exact to round-off");
    judge("--from nobody").exits(2).complains("no profile of that name");
    folder.write("own.toml", "source = 'a test'\n[quantities]\nw = 'p'\n");
    judge("--from own.toml").exits(2).complains("own.toml:3:1").complains("a quantity: X, x");
}

/// Nodal errors of order 3 on linear cells, as from a quadratic solution whose file has its nodes as corners.
#[test]
fn a_quadratic_solution_on_linear_cells_is_asked_for() {
    let folder = Folder::new();
    let write = |name: &str, side: u32, power: i32| {
        let rows = on_grid(&folder, side, "u");
        let number = |text: &String| text.parse::<f64>().expect("a number");
        let size = 1.0 / f64::from(side);
        let line = |row: &Vec<String>| {
            let [x, y, u, v] = [1, 2, 3, 4].map(|at| number(&row[at]));
            let error = 0.1 * size.powi(power) * (2.0 * x + y).sin();
            format!("{x:?} {y:?} {:?} {:?}\n", u + error, v - error)
        };
        let rows: String = rows[1..].iter().map(line).collect();
        let zone = format!("ZONE I={0}, J={0}, SOLUTIONTIME=0.01", side + 1);
        folder.write(name, &format!("VARIABLES = X, Y, u_x, u_y\n{zone}\n{rows}"));
    };
    let sides = [4, 8, 16];
    sides.iter().for_each(|side| write(&format!("p2_{side}.dat"), *side, 3));
    sides.iter().for_each(|side| write(&format!("p1_{side}.dat"), *side, 2));
    let judge = |degree: u32, rest: &str| {
        let files = sides.map(|side| format!("p{degree}_{side}.dat")).join(" ");
        folder.mms(&format!("judge {WAVE} {files} {rest}"))
    };
    for rest in ["", "--expected-order 3"] {
        let run = judge(2, rest).exits(2);
        run.complains("at points, and 1.98 over its linear cells");
        assert_eq!(suggested(&run), ["--over points", "--expected-order 3", "--over cells"]);
    }
    judge(2, "--over points --expected-order 3").exits(0).prints("pass: observed order 2.97");
    judge(2, "--over cells").exits(0).prints("pass: observed order 1.98");
    judge(2, "--over cells --expected-order 3").exits(1);
    // Linear solutions have one reading.
    judge(1, "").exits(0).prints("pass: observed order 1.9");
    judge(1, "--expected-order 3").exits(1);
    judge(1, "--over lines").exits(2).complains("expected points or cells");
}

#[test]
fn units_in_a_header_are_checked_against_those_of_the_field() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,sigma");
    let with = |place: &str, u: &str, stress: &str| {
        let [x, y] = ["X", "Y"].map(|it| format!("{it} [{place}]"));
        let [a, b] = ["u_x", "u_y"].map(|it| format!("{it} ({u})"));
        let sigma = ["xx", "xy", "yx", "yy"].map(|it| format!("sigma_{it} [{stress}]"));
        let old = ["X", "Y", "u_x", "u_y", "sigma_xx", "sigma_xy", "sigma_yx", "sigma_yy"];
        let new = [&[x, y, a, b][..], &sigma].concat();
        let columns: Vec<_> = old.into_iter().zip(new.iter().map(String::as_str)).collect();
        folder.write("units.csv", &table(&rows, &columns));
        folder.mms(&format!("judge {WAVE} units.csv --time 0.01"))
    };
    with("m", "m", "Pa").exits(0).prints("exact to round-off");
    with("m", "m", "N/m2").exits(0);
    with("m", "mm", "Pa")
        .exits(2)
        .complains("`u_x` is in mm")
        .complains("values are not converted");
    with("m", "m", "MPa").exits(2).complains("`sigma_xx` is in MPa");
    with("m", "m", "m").exits(2).complains("the unit of `sigma_xx` is m").complains("Pa");
    // Words in brackets are not units.
    with("m", "m", "Average").exits(0);
}

#[test]
fn components_behind_a_mapped_or_profiled_name_are_its_entries() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,P");
    let named: Vec<String> =
        ["xx", "xy", "yx", "yy"].iter().map(|it| format!("pk1_stress_{it}")).collect();
    let place = [("X", "X"), ("Y", "Y"), ("u_x", "disp_x"), ("u_y", "disp_y")];
    let stress = ["P_xx", "P_xy", "P_yx", "P_yy"];
    let stress: Vec<_> = stress.into_iter().zip(named.iter().map(String::as_str)).collect();
    folder.write("p.csv", &table(&rows, &[&place[..], &stress].concat()));
    let judge = format!("judge {WAVE} p.csv --time 0.01");
    let left_out = folder.mms(&format!("{judge} --explain")).exits(0);
    left_out.prints("pk1_stress_xx (not a quantity)");
    for option in ["--from moose", "--map P=pk1_stress"] {
        folder.mms(&format!("{judge} {option}")).exits(0).prints("first_piola_kirchhoff");
    }
}

/// The cells of a grid of squares in the legacy format, followed by arrays of points.
fn vtk(points: &[[f64; 2]], cells: &[&[usize]], kinds: &[u8], data: &str) -> String {
    let place = |[x, y]: &[f64; 2]| format!("{x:?} {y:?} 0\n");
    let cell = |points: &&[usize]| {
        let names: Vec<String> = points.iter().map(usize::to_string).collect();
        format!("{} {}\n", points.len(), names.join(" "))
    };
    let size: usize = cells.iter().map(|it| it.len() + 1).sum();
    format!(
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n{}CELLS {} {size}\n{}CELL_TYPES \
         {}\n{}{data}",
        points.len(),
        points.iter().map(place).collect::<String>(),
        cells.len(),
        cells.iter().map(cell).collect::<String>(),
        kinds.len(),
        kinds.iter().map(|it| format!("{it}\n")).collect::<String>()
    )
}

#[test]
fn points_that_fill_the_body_in_one_reading_are_not_asked_about() {
    let folder = Folder::new();
    // A bar that is drawn out: read as x, its points are inside the body too, and do not reach its end.
    let points: Vec<[f64; 2]> = (0..9).map(|at| [f64::from(at) / 8.0, 0.0]).collect();
    let cells: Vec<[usize; 2]> = (0..8).map(|at| [at, at + 1]).collect();
    let cells: Vec<&[usize]> = cells.iter().map(|it| &it[..]).collect();
    let u: String = points.iter().map(|[x, _]| format!("{:?}\n", 0.1 * x)).collect();
    let data = format!("POINT_DATA 9\nSCALARS u double 1\nLOOKUP_TABLE default\n{u}");
    folder.write("bar.vtk", &vtk(&points, &cells, &[3; 8], &data));
    let judge = "judge bar_1d bar.vtk --time 0.01 --explain";
    let how = "points taken as X, since they would not fill the body if they were x";
    folder.mms(judge).exits(0).prints(how);
    folder
        .mms(&format!("{judge} --part"))
        .exits(2)
        .complains("`--map X=points` or `--map x=points`");
}

#[test]
fn what_is_no_part_of_the_body_stops_nothing() {
    let folder = Folder::new();
    let rows = on_grid(&folder, 2, "u");
    let number = |text: &String| text.parse::<f64>().expect("a number");
    let mut points: Vec<[f64; 2]> =
        rows[1..].iter().map(|row| [number(&row[1]), number(&row[2])]).collect();
    // A point without a cell, far away, and a line on the boundary without a stress.
    points.push([5.0, 5.0]);
    let cells: [&[usize]; 5] =
        [&[0, 1, 4, 3], &[1, 2, 5, 4], &[3, 4, 7, 6], &[4, 5, 8, 7], &[0, 1]];
    let u: String =
        rows[1..].iter().map(|row| format!("{} {} 0\n", row[3], row[4])).collect::<String>()
            + "0 0 0\n";
    let of_cells = "CELL_DATA 5\nSCALARS J double 1\nLOOKUP_TABLE default\n1\n1\n1\n1\nnan\n";
    let data = format!("{of_cells}POINT_DATA 10\nVECTORS u double\n{u}");
    let text = vtk(&points, &cells, &[9, 9, 9, 9, 3], &data);
    folder.write("arc.vtk", &text);
    let run = folder.mms(&format!("judge {WAVE} arc.vtk --time 0.01"));
    run.prints("1 point of no cell").prints("norms of J");
    folder.write("arc.vtk", &text.replace("1\n1\nnan\n", "1\nnan\n1\n"));
    let run = folder.mms(&format!("judge {WAVE} arc.vtk --time 0.01")).exits(2);
    run.complains("cell 3: J is NaN; expected a finite number");
}

#[test]
fn a_temperature_is_no_time_and_an_open_order_is_explained() {
    let folder = Folder::new();
    let rows = exact(&folder, "u,sigma");
    let columns = [("X", "X"), ("Y", "Y"), ("u_x", "u_x"), ("u_y", "u_y"), ("X", "T")];
    let text = table(&rows, &columns);
    folder.write("hot.csv", &format!("# time = 0.01\n{text}"));
    folder.mms(&format!("judge {WAVE} hot.csv")).exits(0).prints("at t = 0.01");
    let place = [("X", "X"), ("Y", "Y"), ("u_x", "u_x"), ("u_y", "u_y")];
    let voigt = [
        ("sigma_xx", "sigma:0"),
        ("sigma_yy", "sigma:1"),
        ("sigma_xx", "sigma:2"),
        ("sigma_xy", "sigma:3"),
    ];
    folder.write("open.csv", &table(&rows, &[&place[..], &voigt].concat()));
    let run = folder.mms(&format!("judge {WAVE} open.csv --time 0.01 --explain")).exits(0);
    run.prints("OPEN").prints("4 columns: in which order?");
}
