//! A user's own material, in a file next to the field's.

use super::mms::{BAR, Folder, assert_close, numbers};

const NEO_HOOKEAN: &str = include_str!("../../mms-codegen/materials/neo_hookean.toml");

/// An energy W whose stress in uniaxial strain is P = kappa (F - 1).
const STIFFNESS: &str = r#"
[material]
title         = "linear in the Jacobian"
strain_energy = "kappa/2*(J - 1)^2"

[parameters]
kappa = { unit = "Pa", doc = "modulus" }
"#;

/// The bar with `./mine.toml`, in a folder below the working directory.
fn bar_of(material: Option<&str>, arguments: &str) -> Folder {
    let folder = Folder::new();
    let shipped = "lambda  = \"0\"\nmu      = \"young/2\"";
    assert!(BAR.contains(shipped), "the bar's material has changed");
    let text = BAR.replace("\"neo_hookean\"", "\"./mine.toml\"").replace(shipped, arguments);
    folder.write("own/bar.toml", &text);
    if let Some(material) = material {
        folder.write("own/mine.toml", material);
    }
    folder
}

#[test]
fn the_same_energy_in_a_file_gives_the_same_numbers_and_errors() {
    let folder = bar_of(Some(NEO_HOOKEAN), "lambda  = \"0\"\nmu      = \"young/2\"");
    folder.mms("check own/bar.toml").exits(0).prints("body_force");
    let evaluate = |field: &str| {
        folder.mms(&format!("eval {field} --at 0.3 --time 0.01 --json")).exits(0).json()
    };
    assert_eq!(evaluate("own/bar.toml")["points"], evaluate("bar_1d")["points"]);
    let errors = |field: &str| {
        let document = folder.mms(&format!("study {field} --cells 8,16 --json")).exits(0).json();
        [0, 1].map(|level| document["levels"][level]["l2"].as_f64().expect("an error"))
    };
    // Compiled forcing runs in loops over many points, and differs from the interpreter's by some eps.
    for (own, shipped) in errors("own/bar.toml").into_iter().zip(errors("bar_1d")) {
        assert_close(own, shipped, 1e4 * f64::EPSILON);
    }
}

#[test]
fn another_energy_gives_its_own_stress() {
    // The bar's closed form of b belongs to the neo-Hookean stress.
    let folder = bar_of(Some(STIFFNESS), "kappa = \"young\"");
    folder.mms("check own/bar.toml").exits(1).prints("body_force");
    let point = "eval own/bar.toml --at 0 --time 0 --quantity P,W --json";
    let document = folder.mms(point).exits(0).json();
    let point = &document["points"][0];
    assert_close(numbers(&point["first_piola_kirchhoff"])[0], 4e5, 1e-14);
    assert_close(numbers(&point["strain_energy"])[0], 8e4, 1e-14);
    let study = folder.mms("study own/bar.toml --cells 8,16 --json").exits(0).json();
    assert_eq!(study["verdict"], "pass");
}

#[test]
fn a_missing_file_is_reported_where_it_is_named() {
    let folder = bar_of(None, "lambda  = \"0\"\nmu      = \"young/2\"");
    for command in ["check", "show", "study"] {
        let run = folder.mms(&format!("{command} own/bar.toml")).exits(2);
        run.complains("own/bar.toml:20:11").complains("cannot read the material file");
        run.complains("the path is relative to the field file");
    }
}

/// A run refuses to overwrite its input, given by any path.
#[test]
fn what_a_run_reads_is_not_replaced() {
    let folder = bar_of(Some(NEO_HOOKEAN), "lambda  = \"0\"\nmu      = \"young/2\"");
    let field = folder.read("own/bar.toml");
    for path in ["own/bar.toml", "own/../own/bar.toml", "own/mine.toml", "./own/mine.toml"] {
        for option in ["--history", "--checkpoint"] {
            let run = folder.mms(&format!("run own/bar.toml --cells 8 {option} {path}")).exits(2);
            run.complains(&format!("`{option} {path}`: that file is read")).prints_nothing();
        }
    }
    assert_eq!([folder.read("own/bar.toml"), folder.read("own/mine.toml")], [&field, NEO_HOOKEAN]);
    folder.mms("run own/bar.toml --cells 8 --history own/bar.csv").exits(0);
}

#[test]
fn a_mistake_in_the_material_is_reported_in_its_own_file() {
    let folder = bar_of(Some(&STIFFNESS.replace("kappa/2", "kapa/2")), "kappa = \"young\"");
    let run = folder.mms("check own/bar.toml").exits(2);
    run.complains("mine.toml:4:18").complains("did you mean `kappa`?");
}

#[test]
fn a_parameter_of_the_material_that_the_field_leaves_out_is_reported() {
    let folder = bar_of(Some(STIFFNESS), "");
    let run = folder.mms("check own/bar.toml").exits(2);
    run.complains("kappa").complains("own/bar.toml:");
}
