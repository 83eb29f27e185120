//! Fields without time, in every command that accepts them.

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
fn a_relaxed_study_has_the_order_of_its_method() {
    let folder = folder();
    let command = "study static.toml --relax --formulation total --shape linear --cells 4,8,16,32";
    let run = folder.mms(command).exits(0);
    run.prints("residual").prints("pass: observed order 1.99").prints("order of P");
    let text = &run.stdout;
    assert!(!text.contains("order of v"), "{text}");
    let study = folder.mms(&format!("{command} --json")).exits(0).json();
    assert_eq!(study["refinement"], "space");
    assert_eq!(study["method"]["relax"], true);
    for level in study["levels"].as_array().expect("levels") {
        let residual = level["residual_ratio"].as_f64().expect("a residual");
        assert!(residual > 0.0 && residual <= 1e-9, "{level}");
        // Its error is less than the error of the grid.
        let of = |key: &str| level[key].as_f64().expect("a number");
        assert!(of("round_off") < 1e-4 * of("l2"), "{level}");
    }
    // With hat functions, P is of first order, and u of second.
    let fine = &study["quantities"]["first_piola_kirchhoff"][3]["order_l2"];
    assert!((fine.as_f64().expect("an order") - 1.0).abs() < 0.1, "{fine}");
    let excluded = folder.mms(&format!("{command} --excluded --verbose")).exits(0);
    excluded.prints("mistakes, by their error relative to the finest error").prints("excluded: ");
    // A saved study, and a study of several methods.
    folder.write("s.toml", "field = \"static.toml\"\nrelax = true\ncells = [4, 8]\n");
    folder.mms("study --study s.toml --shape cpgimp,cpdi").complains("relaxed");
}

#[test]
fn a_relaxed_run_says_how_near_it_came() {
    let folder = folder();
    let command = "run static.toml --relax --cells 8 --vtk states";
    folder.mms(command).exits(0).prints("in equilibrium: ").prints("below 1.0e-9");
    let list = folder.read("states/static.pvd");
    assert_eq!(list.matches("<DataSet").count(), 2, "the start and the end: {list}");
    let run = folder.mms("run static.toml --relax --cells 8 --json").exits(0).json();
    assert!(run["residual_ratio"].as_f64().is_some_and(|it| it <= 1e-9), "{run}");
    let errors = &run["errors"]["displacement"];
    assert_eq!(errors["over_time"], errors["at_end"]);
    // Twice the density gives twice the mass, and the same equilibrium.
    let dense = STATIC.replace("a     =", "rho0 = { value = 4, unit = \"kg/m^3\" }\na     =");
    folder.write("dense.toml", &dense.replace("nu = \"nu\"", "nu = \"nu\"\ndensity = \"rho0\""));
    let dense = folder.mms("run dense.toml --relax --cells 8 --json").exits(0).json();
    let of = |run: &serde_json::Value| run["errors"]["displacement"]["at_end"]["l2"].as_f64();
    let (one, other) = (of(&run).expect("an error"), of(&dense).expect("an error"));
    assert!((one / other - 1.0).abs() < 1e-6, "{one} {other}");
    assert_eq!(run["steps"], dense["steps"]);
}

#[test]
fn what_an_equilibrium_has_not_is_refused_with_relax() {
    let folder = folder();
    for (command, said) in [
        ("run bar_1d --relax", "`bar_1d` moves, and is in equilibrium only by chance"),
        ("run static.toml --relax --time 1", "cannot be used with"),
        ("run static.toml --relax --history h.csv", "`--history`: the steps of a relaxation"),
        ("run static.toml --relax --checkpoint c", "`--checkpoint`: the steps of a relaxation"),
        ("study static.toml --relax --refine time", "`--refine time`: an equilibrium has no time"),
        ("study static.toml --relax --fit", "`--fit`: an equilibrium has no time"),
        ("study static.toml --relax --periods 1", "`--periods`: an equilibrium has no time"),
        ("run static.toml --relax --integrator usf", "use `leapfrog`"),
    ] {
        folder.mms(command).exits(2).complains(said);
    }
}

#[test]
fn the_displacement_is_shown_as_one_of_places_alone() {
    let folder = folder();
    folder.mms("show static.toml --quantity u").exits(0).prints("displacement  u = u(X)  (");
    folder.mms("show bar_1d --quantity u").exits(0).prints("displacement  u = u(X, t)  (");
    folder.mms("emit static.toml --target c -o c").exits(0);
    assert!(folder.read("c/static_.h").contains("Displacement u(X)."));
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
    // b is defined only with a density.
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
    // The file has no time.
    let bare: String = text
        .lines()
        .map(|line| line.split_once(',').expect("a time").1.to_owned() + "\n")
        .collect();
    folder.write("bare.csv", &bare);
    judged("bare.csv").prints("exact to round-off");
    folder.mms("diagnose static.toml bare.csv").exits(0).prints("nothing");
}

/// A bar whose displacement grows with its load.
const LOADED: &str = r#"[field]
title     = "Loaded bar"
dimension = 1
[parameters]
load  = { value = 1, unit = "1" }
young = { value = 1e6, unit = "Pa" }
side  = { value = 1, unit = "m" }
[displacement]
u = ["load*X*(2*side - X)/(10*side)"]
[material]
model  = "neo_hookean"
lambda = 0
mu     = "young/2"
[domain]
shape = "box"
lower = [0]
upper = ["side"]
[boundary]
x_min = "fixed"
x_max = "free"
"#;

/// Writes u with an error of second order; of first order at the full load.
#[cfg(unix)]
const SOLVER: &str = r#"
awk -v n="$2" -v load="$3" 'BEGIN {
    print "X,u"
    p = load < 1 ? 2 : 1
    for (i = 0; i < n; i++) { X = (i + 0.5) / n; printf "%.17g,%.17g\n", X, load * X * (2 - X) / 10 + load / n ^ p }
}' > "$1/u.csv"
"#;

#[cfg(unix)]
fn loaded(words: &str, study: &str) -> Folder {
    let folder = Folder::new();
    folder.write("loaded.toml", LOADED);
    folder.write("solver.sh", SOLVER);
    folder.write(
        "c.toml",
        &format!(
            "[solver]\nrun = \"sh solver.sh {{output}} {{cells}} {words}\"\noutput = \"{{output}}/*.csv\"\n\
             [[study]]\nfield = \"loaded.toml\"\ncells = [8, 16, 32]\n{study}"
        ),
    );
    folder
}

#[cfg(unix)]
#[test]
fn a_campaign_steps_a_load_and_judges_each_step() {
    let folder = loaded("{set.load}", "set = { load = [0.25, \"1/2\", 1] }\n");
    let listed = folder.mms("campaign c.toml --dry-run").exits(0);
    listed.prints("loaded@load=0.25/1: to do; 8 cells, h 1.250e-1\n");
    listed.prints("/output 8 0.5").prints("loaded@load=1/3");
    let run = folder.mms("campaign c.toml --json --output out").exits(1);
    let document = run.json();
    let studies = document["studies"].as_array().expect("studies");
    let steps = [
        ("loaded@load=0.25", "load=0.25", "pass"),
        ("loaded@load=1_2", "load=1/2", "pass"),
        ("loaded@load=1", "load=1", "fail"),
    ];
    assert_eq!(studies.len(), steps.len());
    for (study, (name, set, verdict)) in studies.iter().zip(steps) {
        assert_eq!(study["name"], name);
        assert_eq!((&study["study"], &study["set"][0]), (&"loaded".into(), &set.into()));
        assert_eq!(study["verdict"], verdict);
        assert_eq!(
            (&study["runs"][0]["time_step"], &study["runs"][2]["level"]),
            (&serde_json::Value::Null, &3.into())
        );
        // load/n^2, or at the full load 1/n.
        let load = [0.25, 0.5, 1.0][steps.iter().position(|it| it.0 == name).expect("a step")];
        let error = if load < 1.0 { load / 64.0 } else { 1.0 / 8.0 };
        let found = study["judgement"]["levels"][0]["l2"].as_f64().expect("an error");
        assert!((found / error - 1.0).abs() < 1e-9, "{found} {error}");
    }
    // A pass excludes mistakes by their effect at equilibrium: at no load does this bar balance b with the other sign.
    let shown = |study: usize, name: &str| {
        let all = studies[study]["judgement"]["excluded"].as_array();
        all.and_then(|all| all.iter().find(|it| it["hypothesis"] == name)).cloned()
    };
    let sign = shown(0, "force_sign").expect("a mistake");
    assert!(sign["times"].as_f64().is_some_and(|times| times > 10.0), "{sign}");
    assert_eq!(shown(2, "force_sign"), None, "no pass excludes nothing");
    assert!(document["excluded"].as_array().is_some_and(|all| all.len() > 10), "{document}");
    let again = folder.mms("campaign c.toml --only loaded@load=0.25").exits(0);
    again.prints("1 of 1 studies pass").prints("study loaded@load=0.25");
    let all = folder.mms("campaign c.toml --only loaded/2 --dry-run").exits(0);
    all.prints("loaded@load=0.25/2: done").prints("loaded@load=1/2: done");
    folder.mms("campaign c.toml --only loaded@load=2").exits(2).complains("no such study or level");
    folder.mms("report out").exits(1).prints("1 of 3 verdicts is not as expected");
    let page = folder.read("out/report.html");
    assert!(
        page.contains("loaded@load=0.25") && page.contains("loaded@load=1_2"),
        "names of steps"
    );
}

#[cfg(unix)]
#[test]
fn what_a_static_campaign_has_not_is_refused_at_its_place() {
    let refused = |words: &str, study: &str, said: &str| {
        let folder = loaded(words, study);
        folder.mms("campaign c.toml --dry-run").exits(2).complains("c.toml:5:9").complains(said);
    };
    refused("{time_step}", "", "`{time_step}`: `loaded` is static, and has no time");
    refused("{set.load} {end}", "", "`{end}`: `loaded` is static");
    refused("{set.load}", "end = 1\n", "`end`: `loaded` is static");
    refused("{set.load}", "time_steps = [1, 2, 3]\n", "`time_steps`: `loaded` is static");
    refused("{set.lode}", "", "`{set.lode}`: `loaded` has no such parameter; it has load");
    let folder = loaded("{set.load}", "set = { load = [1, 2], young = [1e6] }\n");
    folder
        .mms("campaign c.toml")
        .exits(2)
        .complains("c.toml:7:32")
        .complains("`young` has 1 values");
}

/// Parts of a cell at a curved face hold few particles, which a load tears off.
#[test]
fn a_particle_that_is_lost_in_relaxation_says_what_to_do() {
    let folder = Folder::new();
    let text = STATIC
        .replace("value = 0.02", "value = 0.3")
        .replace(
            "a*sin(pi*X/length)*sin(pi*Y/length)\", \"a*sin(pi*X/length)*sin(pi*Y/length)",
            "a*X/length*(1 + (X^2 + Y^2)/length^2)\", \"a*Y/length*(1 + (X^2 + Y^2)/length^2)",
        )
        .replace(
            "shape = \"box\"\nlower = [0, 0]\nupper = [\"length\", \"length\"]",
            "shape = \"disk\"\nouter = \"length\"",
        );
    let faces = text.find("x_min").expect("faces");
    folder.write("disk.toml", &format!("{}outer = \"traction\"\n", &text[..faces]));
    let run = folder.mms("study disk.toml --relax --cells 4").exits(1);
    run.prints(
        "claim `prescribed` on that face, or try `--formulation total --shape quadratic_bspline",
    )
    .prints("next: mms study disk.toml --relax --cells 4 --formulation=total");
    folder
        .mms("run disk.toml --relax --cells 4 --shape cpdi")
        .exits(3)
        .complains("on the way to equilibrium");
}

#[test]
fn a_polygon_is_told_why_it_is_not_solved() {
    let folder = Folder::new();
    let text = STATIC.replace(
        "shape = \"box\"\nlower = [0, 0]\nupper = [\"length\", \"length\"]",
        "shape = \"polygon\"\nvertices = [[0, 0], [\"length\", 0], [0, \"length\"]]",
    );
    let faces = text.find("x_min").expect("faces");
    folder.write("wedge.toml", &format!("{}edge_1 = \"prescribed\"\n", &text[..faces]));
    let run = folder.mms("check wedge.toml --solve");
    run.prints("NOT SOLVED: this body is a polygon");
}
