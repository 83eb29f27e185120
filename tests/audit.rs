//! The scripts that `mms show --script sympy` writes: run by Python, they agree with the field that they were written for, and
//! detect a single wrong digit.
//!
//! Python is `python3`, or the path in `MMS_PYTHON`. Without SymPy these tests are skipped with a message;
//! `MMS_REQUIRE_SYMPY=1` forbids that.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rayon::prelude::*;

use crate::sampled::sampled;

fn python() -> Command {
    Command::new(std::env::var_os("MMS_PYTHON").unwrap_or_else(|| "python3".into()))
}

/// Whether the scripts can be run. A skip is written past the test runner, which would hide it.
fn can_run(test: &str) -> bool {
    let found = python().args(["-c", "import sympy"]).output();
    let why = match found {
        Ok(output) if output.status.success() => return true,
        Ok(output) => {
            let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
            stderr.lines().last().unwrap_or_default().to_string()
        }
        Err(error) => error.to_string(),
    };
    let is_required = std::env::var_os("MMS_REQUIRE_SYMPY").is_some_and(|value| value == "1");
    assert!(!is_required, "MMS_REQUIRE_SYMPY is set, but Python has no SymPy: {why}");
    let _ = writeln!(std::io::stderr(), "skipped: {test} needs Python with SymPy: {why}");
    false
}

fn script(field: &str) -> String {
    let show = Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(["show", field, "--script", "sympy"])
        .output()
        .expect("the program starts");
    assert!(show.status.success(), "{field}: {}", String::from_utf8_lossy(&show.stderr));
    String::from_utf8(show.stdout).expect("UTF-8")
}

fn run(script: &str) -> Output {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("audit.py");
    fs::write(&path, script).expect("a written file");
    python().arg(path).output().expect("Python starts")
}

/// Texts of every kind: with a rotation, in three dimensions, graded, with a rigid motion, axisymmetric, and with names that Python
/// reserves.
fn files() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pass = root.join("mms-codegen/tests/data/pass");
    let files =
        ["rotating_2d", "sines_3d", "graded_2d", "twin_2d", "twin_3d", "units_axisymmetric"]
            .map(|name| pass.join(format!("{name}.toml")));
    let odd = root.join("tests/programs/odd_names.toml");
    let own = root.join("tests/programs/own.toml");
    let paths = files.into_iter().chain([odd, own]);
    paths.map(|path: PathBuf| path.to_string_lossy().into_owned()).collect()
}

#[test]
fn the_script_of_every_field_agrees() {
    if !can_run("the_script_of_every_field_agrees") {
        return;
    }
    let names = mms_exact::gallery::FIELDS.iter().map(|entry| entry.name.to_string());
    let fields = sampled(files().into_iter().chain(names), 18);
    fields.par_iter().for_each(|field| {
        let output = run(&script(field));
        let (printed, complaint) =
            (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "{field}:\n{printed}\n{complaint}");
        for quantity in mms_spec::quantity::Quantity::ALL {
            assert!(printed.contains(quantity.name()), "{field}: {}", quantity.name());
        }
    });
}

/// The script with one value made larger by a part in 1e10.
fn mutated(script: &str, quantity: &str) -> String {
    let key = format!("\"{quantity}\": [");
    let values = script.find("POINTS = [").expect("the values");
    let start = values + script[values..].find(&key).expect("a value") + key.len();
    let length = script[start..].find([',', ']']).expect("an end");
    let value: f64 = script[start..start + length].parse().expect("a number");
    let wrong = value * (1.0 + 1e-10);
    assert_ne!(wrong, value, "{quantity} is 0");
    format!("{}{wrong:?}{}", &script[..start], &script[start + length..])
}

#[test]
fn a_wrong_digit_is_found_in_every_quantity() {
    if !can_run("a_wrong_digit_is_found_in_every_quantity") {
        return;
    }
    let script = script("bar_1d");
    sampled(mms_spec::quantity::Quantity::ALL, 8).par_iter().for_each(|quantity| {
        let output = run(&mutated(&script, quantity.name()));
        let printed = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{}:\n{printed}", quantity.name());
        let row = printed.lines().find(|line| line.starts_with(quantity.name()));
        assert!(row.is_some_and(|row| row.ends_with("DIFFERS")), "{printed}");
    });
}

#[test]
fn a_wrong_formula_is_found() {
    if !can_run("a_wrong_formula_is_found") {
        return;
    }
    // The sign on the slides.
    let script = script("bar_1d");
    let wrong = script.replace("a[i] - div_p[i] / density", "a[i] + div_p[i] / density");
    assert_ne!(wrong, script);
    assert_eq!(run(&wrong).status.code(), Some(1));
}
