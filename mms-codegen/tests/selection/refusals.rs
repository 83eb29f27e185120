//! Mistakes in a selection, and mistakes that a selection causes.

use mms_codegen::selection::Selection;
use mms_spec::quantity::Quantity;

use super::{compiled, moving, selected, selection};

fn refusal(text: &str, selection: &Selection) -> String {
    selected(text, selection).expect_err("a mistake")
}

#[test]
fn names_that_are_no_parameters_are_refused() {
    let wrong =
        selection(&[], &[("lamda", "0"), ("mu", "1"), ("mu", "2")], &["rho", "size", "size"]);
    let expected = "\
error: no parameter `lamda`
 --> set:1:1
  |
1 | lamda = 0
  | ^^^^^ not a parameter of this field
  |
  = help: did you mean `lambda`?

error: `mu` is set twice
 --> set:1:1
  |
1 | mu = 2
  | ^^ the second time
  |
  = help: name each parameter once

error: no parameter `rho`
 --> freeze:1:1
  |
1 | rho
  | ^^^ not a parameter of this field
  |
  = help: did you mean `rho0`?

error: `size` is frozen twice
 --> freeze:1:1
  |
1 | size
  | ^^^^ the second time
  |
  = help: name each parameter once
";
    assert_eq!(refusal(&moving(), &wrong), expected);
    let text = moving().replace("lambda = { value = 6e5 }\n", "").replace("\"lambda\"", "\"0\"");
    let unknown = refusal(&text, &selection(&[], &[], &["temperature"]));
    assert!(
        unknown.contains("help: the field's parameters are mu, twice, rho0, size"),
        "{unknown}"
    );
}

#[test]
fn a_field_without_parameters_says_so() {
    let parameters = moving().find("[parameters]").expect("the table");
    let end = moving().find("[displacement]").expect("the table");
    let mut text = moving();
    text.replace_range(parameters..end, "");
    let text = text
        .replace("size*", "0.1*")
        .replace("\"lambda\"", "0")
        .replace("\"twice/2\"", "1")
        .replace("\"rho0\"", "1");
    compiled(&text, &selection(&[], &[], &["*"]));
    let failure = refusal(&text, &selection(&[], &[("mu", "1")], &[]));
    assert!(failure.contains("help: the field has no parameters"), "{failure}");
}

#[test]
fn a_wrong_value_is_shown_in_its_own_text() {
    let wrong = selection(&[], &[("mu", "1/0"), ("rho0", "2*sise"), ("size", "1 +")], &[]);
    let failure = refusal(&moving(), &wrong);
    for expected in [
        "division by zero\n --> set:1:8\n  |\n1 | mu = 1/0\n  |        ^ this is exactly 0",
        // A parameter may only use the parameters above it.
        "unknown name `sise`\n --> set:1:10",
        " --> set:1:11\n  |\n1 | size = 1 +\n",
    ] {
        assert!(failure.contains(expected), "`{expected}` is missing:\n{failure}");
    }
    let later = refusal(&moving(), &selection(&[], &[("mu", "rho0")], &[]));
    assert!(later.contains("`rho0` is used before it is defined"), "{later}");
}

#[test]
fn a_value_that_leaves_a_formula_undefined_is_shown_there() {
    let failure = refusal(
        &moving().replace("cos(30*t)", "cos(t/twice)"),
        &selection(&[], &[("mu", "0")], &["mu", "twice"]),
    );
    let expected = "\
error: division by zero
  --> x.toml:14:28
   |
14 | u = [\"size*X*(1 - X)*cos(t/twice)\"]
   |                            ^^^^^ this is exactly 0
   |
   = help: frozen: `twice = 2*mu`
";
    assert_eq!(failure, expected);
    let density = refusal(&moving(), &selection(&[], &[("rho0", "-1")], &["rho0"]));
    assert!(density.contains("the density must be positive"), "{density}");
    assert!(density.contains("help: frozen: `rho0 = -1`"), "{density}");
}

#[test]
fn a_value_that_leaves_a_quantity_undefined_is_refused() {
    // u = -X moves the whole bar to one point: F = 0.
    let text = moving().replace("size*X*(1 - X)*cos(30*t)", "size*X");
    let collapse = |quantities: &[Quantity]| selection(quantities, &[("size", "-1")], &["size"]);
    let failure = refusal(&text, &collapse(&[Quantity::BodyForce, Quantity::CauchyStress]));
    assert!(failure.contains("is not defined with these values\n --> freeze:1:1"), "{failure}");
    assert!(failure.contains("choose other values, or freeze fewer parameters"), "{failure}");
    // J is defined, but not positive: an error for any selected quantity.
    let failure = refusal(&text, &collapse(&[Quantity::Displacement, Quantity::Jacobian]));
    assert!(failure.contains("J = det F is not positive"), "{failure}");
    // A modulus that makes the wave speed the root of a negative number is an error, too.
    let negative = |quantities: &[Quantity]| selection(quantities, &[("lambda", "-1e7")], &["*"]);
    for quantities in [&[][..], &[Quantity::BodyForce]] {
        let failure = refusal(&moving(), &negative(quantities));
        assert!(failure.contains("this material is unstable at F = I"), "{failure}");
        assert!(failure.contains("= help: frozen: `lambda = -1e7`"), "{failure}");
    }
}

#[test]
fn quantities_have_names_and_aliases() {
    use mms_codegen::selection::compiled_quantity;
    assert_eq!(compiled_quantity(&[], "b"), compiled_quantity(&[], "body_force"));
    let text = compiled_quantity(&[], "body_farce").expect_err("no quantity");
    assert_eq!(text, "unknown quantity `body_farce`; did you mean `body_force`?");
    let text = compiled_quantity(&[], "temperature").expect_err("no quantity");
    assert!(text.starts_with("unknown quantity `temperature`; the quantities are displacement, "));
}

#[test]
fn a_form_that_does_not_exist_is_refused() {
    use mms_spec::Form;
    for form in Form::ALL {
        assert_eq!(Form::from_name(form.name()), Ok(form));
    }
    assert_eq!(
        Form::from_name("fats"),
        Err("unknown form `fats`; did you mean `fast`?".to_string())
    );
    assert_eq!(Form::from_name(""), Err("unknown form ``; the forms are stable, fast".to_string()));
}
