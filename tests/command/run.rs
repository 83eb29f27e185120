//! `mms run`: its document, its options, and how it ends.

use serde_json::Value;

use super::mms::{Folder, keys};

/// The document of a run that succeeds.
fn document(arguments: &str) -> Value {
    Folder::new().mms(&format!("run {arguments} --json")).exits(0).json()
}

/// A norm over time.
fn error(document: &Value, quantity: &str) -> f64 {
    document["errors"][quantity]["over_time"]["linf"].as_f64().expect("an error")
}

#[test]
fn the_document_has_the_promised_keys_in_their_order() {
    let document = document("bar_1d --cells 16");
    let own = [
        "field",
        "method",
        "cells",
        "cell_size",
        "time_step",
        "steps",
        "particles",
        "errors",
        "diagnostics",
        "ns_per_particle_step",
        "seconds",
        "residual_ratio",
        "failure",
        "provenance",
    ];
    assert_eq!(keys(&document), own);
    let quantities = ["displacement", "velocity", "deformation_gradient", "first_piola_kirchhoff"];
    assert_eq!(keys(&document["errors"]), quantities);
    for quantity in quantities {
        for when in ["over_time", "at_end"] {
            assert_eq!(keys(&document["errors"][quantity][when]), ["l1", "l2", "linf"]);
        }
        let at_end = document["errors"][quantity]["at_end"]["linf"].as_f64().expect("an error");
        assert!(at_end > 0.0 && at_end <= error(&document, quantity), "{quantity}");
    }
    assert_eq!(keys(&document["seconds"]), ["forcing", "transfer", "grid", "stress"]);
    let state = ["mass", "momentum", "kinetic_energy", "jacobian", "balance"];
    assert_eq!(keys(&document["diagnostics"]), state);
    let balance = [
        "time",
        "kinetic_energy",
        "strain_energy",
        "body_work",
        "energy_residual",
        "surface_force",
    ];
    assert_eq!(keys(&document["diagnostics"]["balance"]), balance);
    assert!((document["diagnostics"]["mass"].as_f64().expect("a mass") - 1e3).abs() < 1e-9);
    assert_eq!([&document["particles"], &document["steps"]], [32, 80]);
}

/// A run has the same errors as this level of a study.
#[test]
fn a_run_is_a_level_of_a_study() {
    let options = "bar_1d --shape quadratic_bspline --formulation total --courant 0.2";
    let run = document(&format!("{options} --cells 32"));
    let study = Folder::new().mms(&format!("study {options} --cells 16,32 --json")).exits(0).json();
    let level = &study["levels"][1];
    for norm in ["l1", "l2", "linf"] {
        assert_eq!(run["errors"]["displacement"]["over_time"][norm], level[norm], "{norm}");
    }
    assert_eq!(run["method"], study["method"]);
}

/// Every compatible combination of shape function, formulation and transfer follows the bar.
#[test]
fn methods_that_go_together_follow_the_bar() {
    let methods = [
        "--shape cpdi",
        "--formulation total --shape linear",
        "--formulation total --shape ugimp --fill cartesian",
        "--formulation total --shape cubic_bspline",
        "--transfer apic",
        "--transfer xpic2 --precision f32",
        "--transfer flip --flip-fraction 0.99 --time-step 1e-4",
        "--particles-per-cell 3 --time 0.01",
    ];
    for method in methods {
        let document = document(&format!("bar_1d --cells 32 {method}"));
        let error = error(&document, "displacement");
        assert!(error < 5e-3, "{method}: {error}");
    }
}

#[test]
fn cells_and_particles_are_counted_along_each_axis() {
    let document = document("axis_aligned_2d --cells 8x4 --particles-per-cell 2x3 --time 0.02");
    assert_eq!(document["cells"], "8x4");
    assert_eq!(document["method"]["particles_per_cell"], "2x3");
    assert_eq!(document["particles"], 8 * 2 * 4 * 3);
}

#[test]
fn jitter_follows_from_its_seed() {
    let error = |seed: u32| {
        error(&document(&format!("bar_1d --cells 16 --jitter 0.2 --seed {seed}")), "displacement")
    };
    assert_eq!(error(1), error(1));
    assert_ne!(error(1), error(2));
}

#[test]
fn what_makes_no_sense_is_refused_with_the_reason() {
    let cases = [
        ("bar_1d --formulation total", "the nearest is `ugimp`"),
        ("bar_1d --transfer pic --flip-fraction 0.5", "the transfer is pic"),
        ("bar_1d --flip-fraction 2", "from 0 to 1"),
        ("bar_1d --jitter -1", "expected a number from 0 to 1"),
        ("bar_1d --cells -8", "invalid value '-8' for '--cells"),
        ("bar_1d --offset -0.5", "expected a number from 0 to 1"),
        ("bar_1d --time nan", "expected a finite number"),
        ("bar_1d --set amplitude=0.6", "the field turns matter inside out"),
        ("bar_1d --set amplitude=0.6", "`--set amplitude=0.6`: not what the field file allows"),
        ("bar_1d --offset 0.1,0.2", "2 numbers for 1 dimension"),
        ("bar_1d --periodic y", "has no such axis"),
        ("bar_1d --cells 8x8", "`--cells 8x8`: 2 numbers for 1 dimension"),
        ("axis_aligned_2d --cells 8x8x8", "one for all, as in `--cells 8`"),
        ("bar_1d --particles-per-cell 3x2", "one for all, as in `--particles-per-cell 3`"),
        ("bar_1d --time 0", "`--time 0`: `bar_1d` begins at 0; expected a later time"),
        ("bar_1d --time -1", "as in `--time 6.325e-2`"),
        ("bar_1d --cells 0", "expected a number from 1"),
        ("bar_1d --cells 4x", "expected a number from 1"),
        ("bar_1d --transfer xpic9", "unknown transfer"),
        ("bar_1d --time-step 0.1 --courant 0.2", "cannot be used with"),
        ("bar_1d --courant 0", "expected a positive number"),
    ];
    for (arguments, reason) in cases {
        Folder::new().mms(&format!("run {arguments}")).exits(2).complains(reason);
    }
}

#[test]
fn a_scene_that_cannot_be_started_is_refused_with_the_reason() {
    let cases = [
        ("bar_1d --periodic x", "displacement differs between its two faces"),
        ("bar_1d --offset 0.5", "lies between grid nodes"),
        ("conformal_sector_2d --fill cartesian", "fill the body with"),
        ("bar_1d --time 1e308", "over 1e308 steps"),
        ("bar_1d --courant 1e-12", "use a larger Courant number or time step, or an earlier end"),
    ];
    for (arguments, reason) in cases {
        Folder::new().mms(&format!("run {arguments}")).exits(3).complains(reason).prints_nothing();
    }
}

#[test]
fn a_run_that_is_not_started_has_a_document_too() {
    let folder = Folder::new();
    let run = folder.mms("run bar_1d --cells 1000000000 --json --output out").exits(3);
    let document = run.json();
    assert_eq!(keys(&document), keys(&self::document("bar_1d --cells 8")));
    assert!(document["steps"].is_null() && document["cells"] == 1_000_000_000, "{document:#}");
    let failure = document["failure"].as_str().expect("a reason");
    assert!(failure.starts_with("not started: ") && failure.contains("use fewer cells"));
    // On a page it is a failed run.
    folder.write("printed/run.json", &run.stdout);
    folder.mms("report printed").exits(1);
    assert!(folder.read("printed/report.html").contains("not started"));
    assert!(!folder.path("out/run.json").exists(), "nothing is written about a run that never ran");
}

/// The proved bounds of a field limit the time step: compiled or not, for the parameters that are set, and in the frame of
/// the grid.
#[test]
fn a_time_step_above_the_stable_one_stops_the_run_unless_it_is_allowed() {
    let folder = Folder::with_bar("bar.toml");
    // The number of steps is whole: the Courant number of 64 cells is within 1 % of the requested one.
    // Waves are fastest where F = 1.4 in space, and where F = 0.6 in the reference configuration.
    let fastest = |f: f64, push: f64| ((1.0 + f.powi(-2)) / 2.0).sqrt() * push;
    let [updated, total] = [1.0 / fastest(1.4, 1.4), 1.0 / fastest(0.6, 1.0)];
    for (method, stable) in [("", updated), ("--formulation total --shape linear", total)] {
        for field in ["bar_1d", "bar.toml", "bar_1d --set young=1e9", "bar_1d --rigid"] {
            let [below, above] = [0.97, 1.01].map(|part| {
                format!("run {field} --cells 64 {method} --courant {:.4}", part * stable)
            });
            let run = folder.mms(&above).exits(3);
            for part in ["step 0", "particle", "X = [", "stable one", "--allow-unstable"] {
                run.complains(part);
            }
            let allowed = folder.mms(&format!("{above} --allow-unstable --time 0.001"));
            assert!(!allowed.stderr.contains("stable one"), "{allowed}");
            let run = folder.mms(&below);
            assert!(!run.stderr.contains("stable one"), "{run}");
        }
    }
    // The Courant number in a refusal is accepted when given.
    let failure = folder.mms("run bar_1d --courant 2 --json").exits(3).json();
    let failure = failure["failure"].as_str().expect("a reason");
    let number = failure.split("a Courant number of ").nth(1).expect("a number");
    let number = number.split(';').next().expect("a number");
    folder.mms(&format!("run bar_1d --cells 8 --courant {number}")).exits(0);
}

/// The document names the work that drove the bar: b does all of it.
#[test]
fn the_balance_of_energy_closes() {
    let document = document("bar_1d --cells 64 --time 0.045");
    let balance = &document["diagnostics"]["balance"];
    let number = |key: &str| balance[key].as_f64().expect("a number");
    assert!(number("body_work").abs() > 1e3, "{balance}");
    assert!((number("energy_residual") / number("body_work")).abs() < 0.02, "{balance}");
    assert!(number("strain_energy") > 0.0 && number("time") < 0.045, "{balance}");
}

/// On rollers, which do no work, the energy changes only by the work of b and of the given temperature. The residual is the
/// error of the method, of second order.
#[test]
fn the_balance_of_energy_closes_where_a_temperature_is_given() {
    let [coarse, fine] = [32, 64].map(|cells| {
        let document = document(&format!("heated_square_2d --cells {cells} --time 0.012"));
        let balance = &document["diagnostics"]["balance"];
        let number = |key: &str| balance[key].as_f64().expect("a number");
        assert!(number("given_work").abs() > 50.0, "{balance}");
        number("energy_residual").abs()
    });
    assert!(fine < 1.0 && coarse / fine > 3.0, "{coarse} {fine}");
}

/// Quantities measured before a stop are still printed.
#[test]
fn a_run_that_stops_says_where_and_why() {
    let folder = Folder::new();
    let run = folder.mms("run bar_1d --courant 5 --allow-unstable --json").exits(3);
    for part in ["stopped in step", "particle", "X = [", "try a smaller Courant number"] {
        run.complains(part);
    }
    let document = run.json();
    assert!(document["errors"].is_null() && document["steps"].is_u64(), "{document:#}");
    assert!(document["failure"].as_str().is_some_and(|text| text.contains("stopped in step")));
}

/// The ends of a period are not faces: a grid that is moved by a fraction of a cell computes the same wave.
#[test]
fn a_periodic_axis_has_no_walls() {
    let walls = document("periodic_bar --cells 64");
    let periodic = document("periodic_bar --cells 64 --periodic x --offset 0.3");
    let [walls, periodic] = [walls, periodic].map(|document| error(&document, "displacement"));
    assert!(periodic < 1.5 * walls && walls < 1.5 * periodic, "{walls}, {periodic}");
}

#[test]
fn the_text_has_a_line_for_every_quantity() {
    let folder = Folder::new();
    let run = folder.mms("run axis_aligned_2d --cells 8").exits(0);
    for part in [" u ", " v ", " F ", " P ", "ns per particle and step: forcing"] {
        run.prints(part);
    }
}

#[test]
fn what_cannot_be_written_is_said_before_the_run() {
    let folder = Folder::new();
    folder.write("file", "");
    for command in ["run bar_1d --cells 8", "extremes bar_1d", "accuracy bar_1d"] {
        let run = folder.mms(&format!("{command} --output file/below")).exits(2);
        run.prints_nothing().complains("cannot make the folder `file/below`");
        assert!(!run.stderr.contains("steps"), "{run}");
    }
    for checkpoint in ["one", "./one", "below/../one"] {
        folder.write("below/other", "");
        let run =
            folder.mms(&format!("run bar_1d --history one --checkpoint {checkpoint}")).exits(2);
        run.prints_nothing().complains("name the same file, `one`");
    }
    let run = folder.mms("verify --row time/usl --output file").exits(2);
    run.prints_nothing().complains("`--output file`: not a folder");
    assert!(!folder.path("target").exists(), "nothing is stored of what did not begin");
}

/// In units where single precision has no number for the acceleration, the run does not start.
#[test]
fn numbers_that_a_precision_does_not_have_are_named() {
    let folder = Folder::new();
    let set = "--set young=1e14 --set rho0=1e2 --set length=1e-19 --set amplitude=2e-33";
    let run = folder.mms(&format!("run bar_1d --cells 8 --precision f32 {set}")).exits(2);
    run.complains("acceleration is finite everywhere, but not as f32 computes it");
    run.complains("run it with `--precision f64`");
    assert!(!run.stderr.contains("unstable"), "{run}");
}
