//! The compiler of field files knows no solver, so it keeps its own lists of the words that a field
//! file may use. These tests hold them together with the lists of what there is.

use mms_codegen::compile::{Failure, compile};
use mms_codegen::spec::names::FUNCTIONS;
use mms_codegen::spec::{INTEGRATORS, SHAPES};
use mms_runtime::{IntegratorName, ShapeName};

/// The mistakes of a field whose displacement is a formula.
fn mistakes(formula: &str) -> Result<(), Failure> {
    let text = format!(
        r#"
        [field]
        title = "one formula"
        dimension = 1
        [displacement]
        u = ["{formula}"]
        [material]
        model = "neo_hookean"
        lambda = "1"
        mu = "1"
        density = "1"
        [domain]
        shape = "box"
        lower = ["0"]
        upper = ["1"]
        time = ["0", "1"]
        "#
    );
    compile("formula", "formula.toml", &text, &|path| Err(path.into())).map(drop)
}

#[test]
fn a_study_may_name_every_shape_function_of_the_solver() {
    for name in ShapeName::NAMES {
        assert!(SHAPES.contains(name), "{name}");
    }
}

#[test]
fn a_study_may_name_every_time_integrator_of_the_solver_and_no_other() {
    let sorted = |names: &[&'static str]| {
        let mut names = names.to_vec();
        names.sort_unstable();
        names
    };
    assert_eq!(sorted(INTEGRATORS), sorted(IntegratorName::NAMES));
}

#[test]
fn every_function_compiles_with_its_own_number_of_arguments_only() {
    let arguments = |count: usize| vec!["X/4 + t/8"; count].join(", ");
    for name in FUNCTIONS {
        let compiles =
            |count: &usize| mistakes(&format!("{name}({}) + 1", arguments(*count))).is_ok();
        let counts: Vec<_> = (0..4).filter(compiles).collect();
        assert_eq!(counts.len(), 1, "{name} takes {counts:?} arguments");
        let other = mistakes(&format!("{name}({})", arguments(3))).expect_err("too many");
        let expected = format!("`{name}` takes {} argument", counts[0]);
        assert!(other.to_string().contains(&expected), "{other}");
    }
}

#[test]
fn the_functions_that_a_message_offers_are_those_that_are_reserved() {
    let message = mistakes("zzzzzz(X)").expect_err("no function").to_string();
    let offered = message.split_once("the functions are ").expect("a list of functions").1;
    let offered: Vec<_> = offered.trim().split(", ").collect();
    assert_eq!(offered, FUNCTIONS);
}
