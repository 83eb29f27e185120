//! Fields without time, through every command that takes them.

use super::mms::{Folder, Run, numbers};

/// A square in equilibrium, without a density.
const STATIC: &str = r#"[field]
title     = "Static square"
dimension = 2
[parameters]
young = { value = 1e6, unit = "Pa" }
nu    = { value = 0.3, unit = "1" }
length = { value = 1, unit = "m" }
a     = { value = 0.02, unit = "m" }
[displacement]
u = ["a*sin(pi*X/length)*sin(pi*Y/length)", "a*sin(pi*X/length)*sin(pi*Y/length)"]
[material]
model = "neo_hookean"
young = "young"
nu = "nu"
[domain]
shape = "box"
lower = [0, 0]
upper = ["length", "length"]
[boundary]
x_min = "fixed"
x_max = "fixed"
y_min = "fixed"
y_max = "fixed"
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("static.toml", STATIC);
    folder
}

/// P of the neo-Hookean law, by its formula P = mu (F - F^-T) + lambda ln(J) F^-T, at X.
fn stress([x, y]: [f64; 2]) -> [[f64; 2]; 2] {
    use std::f64::consts::PI;
    let (young, nu, a) = (1e6, 0.3, 0.02);
    let (mu, lambda) = (young / 2.6, young * nu / (1.3 * 0.4));
    let slope =
        [a * PI * (PI * x).cos() * (PI * y).sin(), a * PI * (PI * x).sin() * (PI * y).cos()];
    let f = [[1.0 + slope[0], slope[1]], [slope[0], 1.0 + slope[1]]];
    let jacobian: f64 = f[0][0] * f[1][1] - f[0][1] * f[1][0];
    let inverse_transposed =
        [[f[1][1], -f[1][0]], [-f[0][1], f[0][0]]].map(|row| row.map(|it| it / jacobian));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let inverse = inverse_transposed[i][j];
            mu * (f[i][j] - inverse) + lambda * jacobian.ln() * inverse
        })
    })
}

#[test]
fn the_force_is_less_the_divergence_of_the_stress() {
    let folder = folder();
    let run = folder.mms("eval static.toml --at 0.3,0.2 --quantity P,body_force_density,v --json");
    let point = &run.exits(0).json()["points"][0];
    let of = |name: &str| numbers(&point[name]);
    let at = [0.3, 0.2];
    for (computed, own) in of("first_piola_kirchhoff").iter().zip(stress(at).concat()) {
        assert!((computed - own).abs() < 1e-8 * own.abs(), "{computed} {own}");
    }
    let step = 1e-4;
    let moved = |axis: usize, by: f64| {
        let mut place = at;
        place[axis] += by;
        stress(place)
    };
    for (row, computed) in of("body_force_density").into_iter().enumerate() {
        let slope = |axis: usize| {
            (moved(axis, step)[row][axis] - moved(axis, -step)[row][axis]) / (2.0 * step)
        };
        let own = -(slope(0) + slope(1));
        assert!((computed - own).abs() < 1e-6 * own.abs(), "{computed} {own}");
    }
    assert_eq!(of("velocity"), [0.0, 0.0]);
}

#[test]
fn what_needs_a_density_or_a_time_is_refused_by_name() {
    let folder = folder();
    let refused = |command: &str, said: &str| {
        folder.mms(command).exits(2).complains(said);
    };
    for name in ["b", "body_force", "mass_density", "rho"] {
        let command = format!("eval static.toml --at 0.3,0.2 --quantity {name}");
        refused(&command, "gives no density");
        refused(&command, "body_force_density is the force per reference volume");
    }
    refused("emit static.toml --target c --quantity b -o c", "gives no density");
    refused("show static.toml --quantity b", "gives no density");
    refused("state static.toml --cells 4 --quantity b -o s.csv", "gives no density");
    for command in ["run static.toml", "study static.toml", "extremes static.toml"] {
        refused(command, "`static` is static: the explicit solver");
    }
    refused("check static.toml --window 0,1", "a static field has no time window");
    refused("check static.toml --rigid", "a static field has no standard twin");
    folder.write("t.toml", &STATIC.replacen("\"a*sin", "\"a*t*sin", 1));
    refused("check t.toml", "the field is static: give `time` under [domain] if it moves");
    folder.write("moving.toml", &STATIC.replace("[0, 0]", "[0, 0]\ntime = [0, 1]"));
    refused("check moving.toml", "missing key `density`");
    refused("eval bar_1d --at 0.3", "`bar_1d` moves: give the time with `--time T`");
    refused("state bar_1d --cells 4 -o s.csv", "`bar_1d` moves: give the times");
}

#[test]
fn all_that_is_offered_leaves_out_what_needs_a_density() {
    let folder = folder();
    let point = folder.mms("eval static.toml --at 0.3,0.2 --json").exits(0).json();
    let names: Vec<&String> = point["points"][0].as_object().expect("a point").keys().collect();
    assert!(names.iter().any(|it| *it == "body_force_density"), "{names:?}");
    assert!(names.iter().all(|it| *it != "body_force" && *it != "mass_density"), "{names:?}");
    folder.mms("emit static.toml --target c -o c").exits(0);
    let header = folder.read("c/static_.h");
    assert!(header.contains("static__body_force_density("), "{header}");
    for name in ["static__body_force(", "static__mass_density(", "_time_window(", "_density0"] {
        assert!(!header.contains(name), "{name}: {header}");
    }
    // A density alone gives b.
    let dense = STATIC.replace("a     =", "rho0 = { value = 1000, unit = \"kg/m^3\" }\na     =");
    folder.write("dense.toml", &dense.replace("nu = \"nu\"", "nu = \"nu\"\ndensity = \"rho0\""));
    let run = folder.mms("eval dense.toml --at 0.3,0.2 --quantity b,body_force_density --json");
    let point = &run.exits(0).json()["points"][0];
    let [b, density] = ["body_force", "body_force_density"].map(|it| numbers(&point[it])[0]);
    assert!((1000.0 * b / density - 1.0).abs() < 1e-14, "{point}");
    folder.mms("check static.toml").exits(0).prints("the equilibrium is stable");
}

#[test]
fn results_are_judged_without_a_time_and_by_their_last_step() {
    let folder = folder();
    let exact = "state static.toml --cells 4 --quantity u,P -o exact.csv";
    folder.mms(exact).exits(0).prints("static: no time");
    let judged = |name: &str| -> Run { folder.mms(&format!("judge static.toml {name}")).exits(0) };
    judged("exact.csv").prints("static: the last result of each file").prints("exact to round-off");
    // A load step before the last one, and times that count steps.
    let text = folder.read("exact.csv");
    let (header, rows) = text.split_once('\n').expect("rows");
    let at_time = |time: &str, is_half: bool| -> String {
        let line = |line: &str| {
            let mut values: Vec<String> = line.split(',').map(str::to_owned).collect();
            values[0] = time.into();
            for value in values[3..].iter_mut().filter(|_| is_half) {
                *value = "0.0".into();
            }
            values.join(",") + "\n"
        };
        rows.lines().map(line).collect()
    };
    folder.write("steps.csv", &format!("{header}\n{}{}", at_time("1", true), at_time("2", false)));
    judged("steps.csv").prints("exact to round-off").prints("left out: 1 result before the last");
    folder.mms("diagnose static.toml steps.csv").exits(0).prints("nothing");
    // Without a time in the file.
    let bare: String = text
        .lines()
        .map(|line| line.split_once(',').expect("a time").1.to_owned() + "\n")
        .collect();
    folder.write("bare.csv", &bare);
    judged("bare.csv").prints("exact to round-off");
    folder.mms("diagnose static.toml bare.csv").exits(0).prints("nothing");
}
