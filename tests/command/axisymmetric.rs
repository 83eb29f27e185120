//! Axisymmetric fields in every command: commands that accept them, and commands that refuse them.

use super::mms::{Folder, numbers};

const SHAFT: &str = include_str!("../../mms-codegen/tests/data/pass/units_axisymmetric.toml");

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("shaft.toml", SHAFT);
    folder
}

#[test]
fn a_shaft_is_checked_with_its_axis() {
    let folder = folder();
    let checked = folder.mms("check shaft.toml").exits(0);
    for line in [
        "claim  r_min is axis (R = 0, with u_R = 0 and no swirl): proved",
        "extent 0 <= r <= ",
        "faces  NOT LOOKED AT: waves on faces and corners, and long waves, of an axisymmetric body",
        "check  displacement_gradient agrees to 1e-20 at 128 points",
    ] {
        checked.prints(line);
    }
    assert!(!checked.stdout.contains("UNDEFINED"), "{checked}");
}

/// On the axis, H has two equal stretches around it, and vectors have only their component along it.
#[test]
fn values_on_the_axis_are_those_of_a_round_body() {
    let folder = folder();
    let run = folder.mms("eval shaft.toml --at 0,0.5 --time 0.004 --quantity F,b,u --json");
    let document = run.json();
    let point = &document["points"][0];
    let of = |name: &str| numbers(&point[name]);
    let (stretch, force, moved) =
        (of("deformation_gradient"), of("body_force"), of("displacement"));
    assert_eq!((stretch.len(), force.len(), moved.len()), (9, 3, 3));
    assert_eq!(stretch[0], stretch[8]);
    assert_eq!(stretch[2], -stretch[6]);
    assert_eq!([force[0], force[2], moved[0], moved[2]], [0.0; 4]);
    assert!(force[1] != 0.0);
}

#[test]
fn the_solver_refuses_a_swirl() {
    let folder = folder();
    for arguments in
        ["run shaft.toml", "study shaft.toml", "tradeoff shaft.toml", "extremes shaft.toml"]
    {
        let says = "`shaft` has a swirl, and the built-in solver moves rings only along R and Z";
        folder.mms(arguments).exits(2).complains(says);
    }
}

/// A disk at rest whose points move outward by R^3/100.
const CUBIC: &str = r#"[field]
title = "A disk whose points move outward by R^3/100"
dimension = 2
coordinates = "axisymmetric"
[displacement]
u = ["R^3/100", "0"]
[material]
model = "neo_hookean"
young = "1"
nu = "0.3"
density = "1"
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
"#;

/// Right triangles with legs 1/n, whose points have the exact displacement.
fn triangles(n: usize) -> String {
    let h = 1.0 / n as f64;
    let all = || (0..=n).flat_map(|j| (0..=n).map(move |i| (i as f64 * h, j as f64 * h)));
    let points: String = all().map(|(r, z)| format!("{r} {z} 0\n")).collect();
    let moved: String = all().map(|(r, _)| format!("{} 0 0\n", r.powi(3) / 100.0)).collect();
    let cell = |(i, j): (usize, usize)| {
        let a = j * (n + 1) + i;
        let (b, c, d) = (a + 1, a + n + 1, a + n + 2);
        format!("3 {a} {b} {d}\n3 {a} {d} {c}\n")
    };
    let cells: String = (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(cell).collect();
    let (count, size) = (2 * n * n, (n + 1) * (n + 1));
    format!(
        "# vtk DataFile Version 3.0\nP1\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {size} double\n{points}CELLS {count} {}\n\
         {cells}CELL_TYPES {count}\n{}POINT_DATA {size}\nVECTORS displacement double\n{moved}",
        4 * count,
        "5\n".repeat(count)
    )
}

/// l1, l2 and h1 of the error of linear interpolation of R^3/100 between multiples of 1/n, as means with these weights: by
/// the midpoint rule along R.
fn of_interpolation(n: usize, weight: fn(f64) -> f64) -> [f64; 3] {
    const PARTS: usize = 4000;
    let (h, mut sums) = (1.0 / n as f64, [0.0; 4]);
    for (cell, part) in (0..n).flat_map(|cell| (0..PARTS).map(move |part| (cell, part))) {
        let a = cell as f64 * h;
        let r = a + h * (part as f64 + 0.5) / PARTS as f64;
        // (a + h)^3 - a^3 over h.
        let slope = 3.0 * a * a + 3.0 * a * h + h * h;
        let error = (a.powi(3) + slope * (r - a) - r.powi(3)) / 100.0;
        let slope_error = (slope - 3.0 * r * r) / 100.0;
        let gradient = slope_error.powi(2) + (error / r).powi(2);
        let all = [1.0, error.abs(), error.powi(2), gradient];
        sums.iter_mut().zip(all).for_each(|(sum, it)| *sum += weight(r) * it);
    }
    [sums[1] / sums[0], (sums[2] / sums[0]).sqrt(), (sums[3] / sums[0]).sqrt()]
}

/// Norms over triangles and points are norms over the rings that they represent, and the gradient has its hoop part.
#[test]
fn errors_of_rings_weigh_by_their_radius() {
    let folder = Folder::new();
    folder.write("cubic.toml", CUBIC);
    let meshes = [4, 8, 16];
    meshes.iter().for_each(|n| folder.write(&format!("m{n}.vtk"), &triangles(*n)));
    let judged = folder.mms("judge cubic.toml m4.vtk m8.vtk m16.vtk --map X=points --json");
    let document = judged.exits(0).json();
    let norms = document["quantities"][0]["norms"].as_array().expect("norms");
    let error = |name: &str, level: usize| {
        let norm = norms.iter().find(|it| it["norm"] == *name).expect("the norm");
        norm["levels"][level]["error"].as_f64().expect("an error")
    };
    for (level, n) in meshes.into_iter().enumerate() {
        let found = ["l1", "l2", "h1"].map(|name| error(name, level));
        let flat = of_interpolation(n, |_| 1.0);
        for ((found, right), flat) in found.into_iter().zip(of_interpolation(n, |r| r)).zip(flat) {
            // The error of the midpoint rule is 1e-7; without the weight, a fifth would be missing.
            assert!((found / right - 1.0).abs() < 1e-6, "{n}: {found} is not {right}");
            assert!((found / flat - 1.0).abs() > 0.1, "{n}: {found} is {flat}");
        }
    }
    // Errors of `factor` R, over points: the mean is factor sum R^2/sum R.
    let points = |factor: f64, n: usize| -> String {
        let all = (0..n * n).map(|at| [at % n, at / n].map(|it| (it as f64 + 0.5) / n as f64));
        let line = |[r, z]: [f64; 2]| format!("{r},{z},{},0\n", r.powi(3) / 100.0 + factor * r);
        std::iter::once("R,Z,u_r,u_z\n".to_owned()).chain(all.map(line)).collect()
    };
    folder.write("p8.csv", &points(0.04, 8));
    folder.write("p16.csv", &points(0.01, 16));
    let document = folder.mms("judge cubic.toml p8.csv p16.csv --json").json();
    let mean = document["levels"][0]["l1"].as_f64().expect("an error");
    let radii = || (0..8).map(|it| (f64::from(it) + 0.5) / 8.0);
    let right = 0.04 * radii().map(|r| r * r).sum::<f64>() / radii().sum::<f64>();
    assert!((mean / right - 1.0).abs() < 1e-12, "{mean} is not {right}");
}

/// Volumes and masses of states are per radian. `judge` reads states back, with and without a swirl, in each format.
#[test]
fn states_of_rings_are_judged_as_exact() {
    let folder = folder();
    folder.write(
        "points.csv",
        "R,Z\n0.0000000,0.2000000\n0.5000000,0.1000000\n0.8000000,0.0000000\n1.0000000,0.3000000\n",
    );
    for file in ["shaft.csv", "shaft.vtu", "shaft.npz"] {
        let state = format!("state shaft.toml --points points.csv --time 0.004 --output {file}");
        folder.mms(&state).exits(0).prints("volumes and masses: of rings, per radian");
        let judged = folder.mms(&format!("judge shaft.toml {file} --part"));
        judged.complains(
            "exact to round-off on every mesh: displacement, velocity, deformation_gradient",
        );
        judged.complains("traction. Are these results");
    }
    let header = folder.read("shaft.csv").lines().next().map(str::to_owned).unwrap_or_default();
    for names in ["R,Z,", "u_r,u_z,u_t", "F_tr,F_tz,F_tt", "traction_r_max_r,traction_r_max_z"] {
        assert!(header.contains(names), "{header}");
    }
    let says = "`--at-present`: points of the body move along the hoop";
    let present = "state shaft.toml --points points.csv --time 0.004 --at-present --output x.csv";
    folder.mms(present).exits(2).complains(says);

    let state = "state axisymmetric_tube --time 0.01 --cells 4 --output tube.npz";
    folder.mms(state).exits(0);
    folder.mms("state axisymmetric_tube --time 0.01 --cells 4 --output tube.csv --json").exits(0);
    let table = folder.read("tube.csv");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().expect("a header");
    let at = |name: &str| names.iter().position(|it| *it == name).expect("the column");
    let (volume, mass) = (at("reference_volume"), at("mass"));
    let sum = |of: usize| {
        let numbers = table.lines().skip(1).filter_map(|line| line.split(',').nth(of));
        numbers.filter_map(|it| it.parse::<f64>().ok()).sum::<f64>()
    };
    // (2^2 - 1^2)/2 for length 1, and 1000 times as much.
    assert!((sum(volume) - 1.5).abs() < 1e-12 && (sum(mass) - 1500.0).abs() < 1e-9);
    // A file may omit the shears along a hoop if nothing moves along it.
    let left: String = table
        .lines()
        .map(|line| {
            let kept = line.split(',').zip(&names).filter(|(_, name)| {
                let shear = ["_rt", "_zt", "_tr", "_tz"].iter().any(|it| name.ends_with(it));
                !shear
            });
            kept.map(|(it, _)| it).collect::<Vec<_>>().join(",") + "\n"
        })
        .collect();
    folder.write("short.csv", &left);
    let judged = folder.mms("judge axisymmetric_tube short.csv");
    judged.complains("deformation_gradient, first_piola_kirchhoff, cauchy_stress");
}

/// States of a run have all nine components of tensors, the hoop component last; weights of rings are for boxes.
#[test]
fn the_solver_runs_a_body_of_revolution() {
    let folder = Folder::new();
    let run = folder.mms("run axisymmetric_rod --cells 8 --frames 1 --vtk states --json").exits(0);
    let errors = run.json();
    assert!(errors["runs"].is_array() || errors.is_object(), "{errors}");
    let state = std::fs::read_to_string(folder.path("states/axisymmetric_rod_0001.vtu"));
    let state = state.expect("a state");
    for name in ["deformation_gradient", "cauchy_stress"] {
        let column = format!("Name=\"{name}\" NumberOfComponents=\"9\"");
        assert!(state.contains(&column), "no {column}");
    }
    for (arguments, says) in [
        ("--shape cpdi", "the corners of `cpdi` have no weights of rings: use `cpgimp`"),
        ("--periodic x", "it cannot repeat itself along R: leave out that axis"),
    ] {
        let run = format!("run axisymmetric_rod --cells 8 {arguments}");
        folder.mms(&run).exits(3).complains(says);
    }
}

/// A static body of revolution reaches its equilibrium with second order.
#[test]
fn a_static_body_of_revolution_relaxes() {
    let folder = Folder::new();
    folder.write(
        "static.toml",
        r#"[field]
title = "A rod at rest"
dimension = 2
coordinates = "axisymmetric"
[displacement]
u = ["0.02*R*(1 - R^2)*sin(pi*Z)", "0.02*(1 - R^2)*sin(pi*Z)"]
[material]
model = "neo_hookean"
young = "1"
nu = "0.3"
density = "1"
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
[boundary]
r_min = "axis"
r_max = "fixed"
z_min = "fixed"
z_max = "fixed"
"#,
    );
    let study = "study static.toml --relax --formulation total --shape linear --cells 4,8,16";
    folder.mms(study).exits(0).prints("pass: observed order 2.");
}

/// A disk that turns about its axis: no point moves outward, although its components in the fixed basis change.
#[test]
fn the_extent_of_a_body_that_turns_is_its_distance_from_the_axis() {
    let folder = Folder::new();
    folder.write(
        "turning.toml",
        r#"[field]
title = "A disk that turns about its axis"
dimension = 2
coordinates = "axisymmetric"
[displacement]
u = ["R*(cos(t) - 1)", "0"]
swirl = "R*sin(t)"
[material]
model = "neo_hookean"
lambda = "1"
mu = "1"
density = "1"
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
time = [2, 3.1]
"#,
    );
    let document = folder.mms("check turning.toml --json").exits(0).json();
    let extent = document["files"][0]["extent"].as_array().expect("an extent");
    let [r, z] = extent.as_slice() else { panic!("{extent:?}") };
    let ([least, most], height) = (<[f64; 2]>::try_from(numbers(r)).expect("two"), numbers(z));
    assert!((-1e-12..=0.0).contains(&least) && (1.0..1.02).contains(&most), "{least} {most}");
    assert_eq!(height, [0.0, 1.0]);
}

/// `mms new --from-axisymmetric` writes the field in space: F, P and b of both agree if the meridian is turned.
#[test]
fn a_field_in_space_is_written_of_its_section() {
    let folder = folder();
    folder.mms("new rod_3d --from-axisymmetric axisymmetric_rod").exits(0).prints("rod_3d.toml");
    folder
        .mms("check rod_3d.toml")
        .exits(0)
        .prints("claim  outer is fixed (u = 0): proved")
        .prints("claim  inner is prescribed");
    let (angle, radius, axial) = (0.7_f64, 0.6, 0.3);
    let values = |field: &str, at: String| {
        let run = format!("eval {field} --at {at} --time 0.004 --quantity F,P,b --json");
        let document = folder.mms(&run).exits(0).json();
        let of = |name: &str| numbers(&document["points"][0][name]);
        ["deformation_gradient", "first_piola_kirchhoff", "body_force"].map(of)
    };
    let (sine, cosine) = angle.sin_cos();
    let flat = values("axisymmetric_rod", format!("{radius},{axial}"));
    let space = values("rod_3d.toml", format!("{},{},{axial}", radius * cosine, radius * sine));
    // The rows of R, Z and theta in space.
    let basis = [[cosine, sine, 0.0], [0.0, 0.0, 1.0], [-sine, cosine, 0.0]];
    let near = |a: f64, b: f64, scale: f64| assert!((a - b).abs() <= 1e-11 * scale, "{a} {b}");
    for (flat, space) in flat.iter().zip(&space).take(2) {
        let scale = flat.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let terms = (0..9).map(|at| basis[i][at / 3] * space[at] * basis[j][at % 3]);
            near(terms.sum(), flat[3 * i + j], scale);
        }
    }
    for (row, flat) in basis.iter().zip(&flat[2]) {
        near(row.iter().zip(&space[2]).map(|(a, b)| a * b).sum(), *flat, 100.0);
    }
    for (field, says) in
        [("bar_1d", "it is not axisymmetric"), ("shaft.toml", "it has given fields")]
    {
        let new = format!("new other --from-axisymmetric {field}");
        folder.mms(&new).exits(2).complains(says);
    }
    folder.mms("new other --from-axisymmetric axisymmetric_rod --dimension 2").exits(2);
    // A material file stays where it is.
    folder.write("rubber.toml", include_str!("../../mms-codegen/materials/neo_hookean.toml"));
    let rod = include_str!("../../fields/axisymmetric_rod.toml");
    let own = rod.replace("\"neo_hookean\"", "\"./rubber.toml\"");
    assert_ne!(rod, own);
    folder.write("own.toml", &own);
    for (new, written) in [("new own_3d", "own_3d.toml"), ("new own_3d -o far", "far/own_3d.toml")]
    {
        folder.mms(&format!("{new} --from-axisymmetric own.toml")).exits(0);
        folder.mms(&format!("check {written}")).exits(0);
    }
    folder.mms("new other").exits(2).complains("--dimension");
}
