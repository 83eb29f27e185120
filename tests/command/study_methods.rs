//! `mms study`: the results of each method on the bar.

use mms_exact::gallery::FIELDS;
use mms_spec::PRECISIONS;
use serde_json::{Value, json};

use super::mms::{Folder, assert_close, keys};
use super::sampled::sampled;

/// The document of a study of the gallery's bar that ends with this exit code.
fn document(arguments: &str, code: i32) -> Value {
    Folder::new().mms(&format!("study bar_1d --json {arguments}")).exits(code).json()
}

/// The members of the levels under one key.
fn column(document: &Value, key: &str) -> Vec<Value> {
    let levels = document["levels"].as_array().expect("levels");
    levels.iter().map(|level| level[key].clone()).collect()
}

fn numbers(document: &Value, key: &str) -> Vec<f64> {
    column(document, key).iter().map(|value| value.as_f64().expect("a number")).collect()
}

#[test]
fn options_choose_the_method_and_the_levels() {
    let options = "--shape ugimp --integrator usl --cells 4,10 --particles-per-cell 3 \
                   --courant 0.2 --precision f32";
    let document = document(options, 1);
    let method = json!({
        "shape": "ugimp",
        "integrator": "usl",
        "formulation": "updated",
        "transfer": "flip",
        "flip_fraction": 1.0,
        "precision": "f32",
        "form": "stable",
        "particles_per_cell": 3,
        "fill": null,
        "jitter": 0.0,
        "seed": 0,
        "offset": [0.0, 0.0, 0.0],
        "periodic": [],
        "courant": 0.2,
        "time_step": null,
        "end_time": null,
        "relax": false,
    });
    assert_eq!(document["method"], method);
    assert_eq!(column(&document, "cells"), [4, 10]);
    assert_eq!(column(&document, "particles"), [12, 30]);
    // Two lengths at the wave speed c, and steps of 0.2 h/c.
    assert_eq!(column(&document, "steps"), [40, 100]);
    for (level, cells) in [4.0, 10.0].into_iter().enumerate() {
        let single = f64::from(f32::EPSILON);
        assert_close(numbers(&document, "cell_size")[level], 1.0 / cells, single);
        assert_close(numbers(&document, "time_step")[level], 0.2 / cells / 1e3_f64.sqrt(), single);
    }
}

#[test]
fn the_defaults_are_contiguous_particles_and_leapfrog() {
    let given = "--shape cpgimp --integrator leapfrog --particles-per-cell 2 --courant 0.4 \
                 --precision f64 --form stable";
    let [spelt, left_out] = [given, ""].map(|options| {
        let document = document(&format!("--cells 8,16 {options}"), 0);
        (document["method"].clone(), column(&document, "linf"))
    });
    assert_eq!(spelt, left_out);
}

#[test]
fn single_precision_computes_in_single_precision() {
    let errors = PRECISIONS
        .iter()
        .map(|precision| {
            numbers(&document(&format!("--cells 8,16 --precision {precision}"), 0), "l2")
        })
        .collect::<Vec<_>>();
    for (single, double) in errors[0].iter().zip(&errors[1]) {
        assert_close(*single, *double, 1e-3);
        assert_ne!(single, double);
    }
    assert_eq!(PRECISIONS, ["f32", "f64"]);
}

#[test]
fn integrators_without_the_half_step_are_first_order_and_fail() {
    for integrator in ["usl", "usf", "musl"] {
        let document = document(&format!("--cells 8,16,32 --integrator {integrator}"), 1);
        assert_eq!(document["verdict"], "fail", "{integrator}");
        assert_eq!(document["expected_order"], 2.0, "{integrator}");
        let order = document["observed_order"].as_f64().expect("an order");
        assert!((order - 1.0).abs() < 0.15, "{integrator}: {order}");
    }
}

#[test]
fn shapes_that_do_not_follow_the_deformation_lose_their_order_and_fail() {
    for shape in ["linear", "ugimp"] {
        let document = document(&format!("--cells 8,16,32 --shape {shape}"), 1);
        assert_eq!(document["verdict"], "fail", "{shape}");
        let order = document["observed_order"].as_f64().expect("an order");
        assert!(order < 0.0, "{shape}: {order}");
    }
}

/// The bar is self-similar in time: the wave speed changes the time, not the motion.
#[test]
fn steps_and_errors_do_not_depend_on_the_modulus() {
    let [soft, usual, stiff] = ["1", "1e6", "1e12"]
        .map(|young| document(&format!("--cells 8,16,32 --set young={young}"), 0));
    for other in [soft, stiff] {
        assert_eq!(column(&other, "steps"), column(&usual, "steps"));
        for norm in ["l1", "l2", "linf"] {
            for (found, expected) in numbers(&other, norm).iter().zip(numbers(&usual, norm)) {
                assert_close(*found, expected, 1e-11);
            }
        }
    }
}

#[test]
fn a_file_outside_the_gallery_gives_the_same_study() {
    let folder = Folder::with_bar("copy.toml");
    for options in ["", "--precision f32 --set length=2", "--shape linear --integrator usf"] {
        let [named, copied] = ["bar_1d", "copy.toml"].map(|field| {
            let mut document =
                folder.mms(&format!("study {field} --cells 4,8 {options} --json")).json();
            for level in document["levels"].as_array_mut().expect("levels") {
                level["seconds"].take();
            }
            document
        });
        assert_eq!([&named["field"], &copied["field"]], ["bar_1d", "copy"]);
        for key in ["method", "expected_order", "verdict"] {
            assert_eq!(copied[key], named[key], "{options}: {key}");
        }
        for key in ["cells", "time_step", "steps", "particles"] {
            assert_eq!(column(&copied, key), column(&named, key), "{options}: {key}");
        }
        // Compiled forcing runs in loops over many points, and differs by some eps.
        let single = options.contains("f32");
        let eps = if single { f64::from(f32::EPSILON) } else { f64::EPSILON };
        for norm in ["l1", "l2", "linf"] {
            for (found, expected) in numbers(&copied, norm).iter().zip(numbers(&named, norm)) {
                assert_close(*found, expected, 1e4 * eps);
            }
        }
    }
}

/// Methods as a figure names them.
const WRITTEN: [&str; 4] = ["cpGIMP, leapfrog", "cpGIMP, USL", "linear, leapfrog", "linear, USL"];

/// A study of several methods equals the studies of each method alone.
#[test]
fn several_methods_are_studied_one_after_the_other() {
    let folder = Folder::new();
    let cells = "--cells 8,16";
    let several = format!("study bar_1d --shape cpgimp,linear --integrator leapfrog,usl {cells}");
    let run = folder.mms(&format!("{several} --json --output several")).exits(1);
    let document = run.json();
    assert_eq!(keys(&document), ["field", "refinement", "studies", "passed", "provenance"]);
    assert_eq!(document["provenance"]["kind"], "study");
    let studies = document["studies"].as_array().expect("studies");
    let names = ["cpgimp leapfrog", "cpgimp usl", "linear leapfrog", "linear usl"];
    assert_eq!(studies.iter().map(|study| &study["name"]).collect::<Vec<_>>(), names);
    let without_times = |mut study: Value| {
        study["levels"].as_array_mut().expect("levels").iter_mut().for_each(|level| {
            level["seconds"].take();
        });
        for key in ["name", "next_command", "provenance"] {
            study.as_object_mut().expect("an object").remove(key);
        }
        study
    };
    let passed = studies.iter().filter(|study| study["verdict"] == "pass").count();
    assert_eq!(document["passed"], passed);
    for (study, name) in studies.iter().zip(names) {
        let (shape, integrator) = name.split_once(' ').expect("two words");
        let alone =
            format!("study bar_1d --shape {shape} --integrator {integrator} {cells} --json");
        assert_eq!(
            without_times(study.clone()),
            without_times(folder.mms(&alone).json()),
            "{name}"
        );
    }
    let table = folder.mms(&several).exits(1);
    table.prints("8 cells").prints(&format!("{passed} of 4 methods pass"));
    let [svg, csv] = ["svg", "csv"].map(|it| folder.read(&format!("several/convergence.{it}")));
    for (name, written) in names.into_iter().zip(WRITTEN) {
        assert!(svg.contains(written), "{name}");
        table.prints(&format!("{name}: "));
    }
    assert!(csv.starts_with("method,cells,"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 4 * 2);
    assert_eq!(csv.lines().filter(|line| line.starts_with("linear usl,")).count(), 2);
}

#[test]
fn several_methods_stand_in_a_study_file_too() {
    let folder = Folder::new();
    let scene = "field = \"bar_1d\"\ncells = [8, 16]\nformulation = \"total\"\n\
                 shape = [\"linear\", \"quadratic_bspline\"]\nrefine = \"space\"\n";
    folder.write("scene.toml", scene);
    folder
        .mms("study --study scene.toml")
        .prints("quadratic_bspline: ")
        .prints("of 2 methods pass");
    let time = "study bar_1d --refine time --cells 16 --levels 3 --integrator leapfrog,musl --json";
    let document = folder.mms(&format!("{time} --formulation total --shape linear")).json();
    for study in document["studies"].as_array().expect("studies") {
        assert_eq!(study["differences"].as_array().map(Vec::len), Some(2), "{document:#}");
    }
}

#[test]
fn lists_of_methods_that_make_no_sense_exit_2() {
    for (arguments, message) in [
        ("--shape linear,linear", "`--shape`: a word is given twice"),
        ("--shape linear,cpgmp", "known are: linear, ugimp, cpgimp"),
        (
            "--formulation total --shape cpgimp,cpdi",
            "in the total formulation no particle's domain moves",
        ),
        ("--form fast,stable,fast", "`--form`: a word is given twice"),
        ("--form stable,quick", "the forms are stable, fast"),
        ("--precision f32,f64 --expected-constant 1", "each method has a constant of its own"),
    ] {
        let run = Folder::new().mms(&format!("study bar_1d --cells 4,8 {arguments}")).exits(2);
        run.complains(message).prints_nothing();
    }
}

/// A combination of two lists that is not allowed is omitted, and the others are studied.
#[test]
fn a_pair_that_makes_no_sense_is_left_out_of_a_list() {
    let lists = "study bar_1d --cells 8,16 --formulation total,updated --shape linear,cpgimp";
    let run = Folder::new().mms(lists).exits(1);
    run.complains("left out: total cpgimp leapfrog: shape function `cpgimp` follows");
    run.prints("total linear").prints("updated linear").prints("updated cpgimp");
    run.prints("2 of 3 methods pass");
}

/// The default method depends on the body; if one option is given, the field still decides the other.
#[test]
fn the_method_fits_the_body_unless_it_is_given() {
    for (study, formulation, shape) in [
        ("bar_1d", "updated", "cpgimp"),
        ("bar_1d --formulation total", "total", "linear"),
        ("uniform_stretch", "total", "linear"),
        ("axis_aligned_2d", "total", "linear"),
        ("axis_aligned_2d --formulation updated", "updated", "cpgimp"),
        ("axis_aligned_2d --shape cpdi", "updated", "cpdi"),
        ("axis_aligned_2d --shape linear", "total", "linear"),
        ("expanding_ring --shape linear", "updated", "linear"),
        ("expanding_ring", "updated", "cpdi"),
        ("expanding_ring --formulation total", "total", "quadratic_bspline"),
        ("conformal_sector_2d", "updated", "cpdi"),
    ] {
        let command = format!("study {study} --cells 4 --json");
        let method = &Folder::new().mms(&command).json()["method"];
        assert_eq!([&method["formulation"], &method["shape"]], [formulation, shape], "{study}");
    }
}

/// One field of the gallery in `SHARE` is studied.
const SHARE: usize = 12;

#[test]
fn fields_pass_without_options_or_a_page_says_why_not() {
    const PAGE: &str = include_str!("../../docs/orders.md");
    let (_, table) = PAGE.split_once("| field | why it does not pass |").expect("the table");
    let failing: Vec<&str> = table
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| ")?.split_once(' ')?.0))
        .collect();
    for field in &failing {
        assert!(FIELDS.iter().any(|it| it.name == *field), "{field}");
    }
    for entry in sampled(FIELDS, SHARE) {
        let study = |options: &str| Folder::new().mms(&format!("study {}{options}", entry.name));
        let run = study("");
        let run = if run.stderr.contains("is static") { study(" --relax") } else { run };
        assert_eq!(run.code != 0, failing.contains(&entry.name), "{run}");
    }
}

/// A verdict other than pass comes with its likely causes, and with the option that avoids the first of them.
#[test]
fn a_study_that_fails_says_why_and_what_to_type() {
    let folder = Folder::new();
    for (study, cause, next) in [
        (
            "study bar_1d --cells 8,16,32 --integrator usl",
            "`usl` is of order 1 in time: `--integrator leapfrog` is of order 2",
            "mms study bar_1d --cells 8,16,32 --integrator=leapfrog",
        ),
        (
            "study bar_1d --cells 8,16,32 --transfer=pic",
            "particles lose part of their velocity to the grid in each step",
            "mms study bar_1d --cells 8,16,32 --transfer=flip",
        ),
        (
            "study bar_1d --cells 8,16,32 --shape linear",
            "particles cross cells, where `linear` loses its order; `--formulation total --shape linear` avoids it",
            "mms study bar_1d --cells 8,16,32 --formulation=total --shape=linear",
        ),
        (
            "study sheared_block_2d --cells 4,8,16",
            "`mms check` warns: a disturbance of the corner of x_max and y_max grows",
            "mms study sheared_block_2d --cells 4,8,16 --set=amplitude=0.1",
        ),
        (
            "study bar_1d --cells 8,16 --courant 3",
            "the time step is above the stable one: `--courant 0.",
            "mms study bar_1d --cells 8,16 --courant=0.",
        ),
    ] {
        let run = folder.mms(study).exits(1);
        run.prints(&format!("likely cause: {cause}")).prints(&format!("\nnext: {next}"));
        let document = folder.mms(&format!("{study} --json")).exits(1).json();
        assert!(
            document["causes"][0].as_str().is_some_and(|it| it.starts_with(cause)),
            "{document:#}"
        );
        assert_eq!(document["next_command"][1], "study");
    }
    // Finer meshes stop sooner: smaller steps do not help.
    let run = folder.mms("study uniform_stretch --shape cpgimp").exits(1);
    run.prints("finer meshes stop sooner, at t = ")
        .prints("smaller steps and more cells do not help");
    assert!(!run.stderr.contains("try a smaller Courant number"), "{run}");
    // Errors that grow are named.
    let run = folder.mms("study bar_1d --cells 8,16,32 --shape ugimp").exits(1);
    run.prints("the error of P grows on finer meshes (l2: ");
}

#[test]
fn after_several_methods_the_next_command_names_one_that_passes() {
    let folder = Folder::new();
    let next = |options: &str| {
        let run = folder.mms(&format!("study bar_1d --cells 8,16,32 {options}")).exits(1);
        let line = run.stdout.lines().find_map(|it| it.strip_prefix("next: "));
        line.unwrap_or_else(|| panic!("no command: {run}")).to_owned()
    };
    assert_eq!(
        next("--formulation updated,total --shape linear"),
        "mms study bar_1d --cells 8,16,32 --formulation=total --shape=linear --integrator=leapfrog --transfer=flip --excluded"
    );
    // Nothing passes: what has failed is not named.
    let failed = next("--formulation updated --shape linear,ugimp --integrator usl,leapfrog");
    assert!(failed.contains("--formulation=total --shape=linear"), "{failed}");
    let twice = next("--formulation updated,total --shape linear --integrator usl,usf");
    assert!(!twice.contains("=usl") && !twice.contains("=usf"), "{twice}");
}
