//! Axisymmetric fields, through every command: those that take them, and those that refuse them.

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

/// On the axis H has two equal stretches around it, and vectors their component along it alone.
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
fn what_works_in_cartesian_coordinates_refuses_an_axisymmetric_field_and_the_solver_a_swirl() {
    let folder = folder();
    folder.write("table.csv", "h,error\n0.1,0.1\n0.05,0.025\n");
    for arguments in
        ["run shaft.toml", "study shaft.toml", "tradeoff shaft.toml", "extremes shaft.toml"]
    {
        let says = "`shaft` has a swirl, and the solver of this project moves rings along R and Z";
        folder.mms(arguments).exits(2).complains(says);
    }
    for arguments in [
        "state axisymmetric_rod --time 0.01 --cells 4 --output state.csv",
        "judge axisymmetric_rod table.csv",
        "diagnose axisymmetric_rod table.csv",
    ] {
        let says =
            "`axisymmetric_rod` is axisymmetric, and this command works in Cartesian coordinates";
        folder.mms(arguments).exits(2).complains(says);
    }
}

/// States of a run have all nine components of tensors, the one around the axis last; weights of rings are for boxes.
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

/// A static body of revolution comes to its equilibrium, of second order.
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

/// A disk that turns about its axis: no point of it moves outward, whatever its components in the fixed basis do.
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
