//! The language of formulas: the meaning of each construct, to the last digit.

use mms_codegen::compile::{Failure, compile_unproved, constant};
use mms_codegen::{Compiled, Options};
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;

use crate::sampled::all_is_tried;

/// A field of one component with these parameters.
fn field(parameters: &str, lets: &str, u: &str) -> String {
    format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[parameters]\n{parameters}\n[let]\n{lets}\n\
         [displacement]\nu = [\"{u}\"]\n[material]\nmodel = \"neo_hookean\"\nlambda = 1\n\
         mu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\n\
         time = [0, 1]\n"
    )
}

/// Compiles a text, whether or not J > 0: these tests are about formulas.
fn compiled(text: &str) -> Result<Compiled, Failure> {
    let load = |_: &str| Err("no files here".to_string());
    compile_unproved("x", "x.toml", text, &load, &Options::default())
}

/// u at X = 0.3 and t = 0.7, or the first message.
fn value(parameters: &str, lets: &str, u: &str) -> Result<f64, String> {
    let text = field(parameters, lets, u);
    let compiled = compiled(&text).map_err(|failure| failure.diagnostics[0].message.clone())?;
    let output = Output::Quantity(Quantity::Displacement);
    let parameters = compiled.parameters::<f64>(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    interpreter.set_time(&0.7);
    let plan = interpreter.plan(&[output]);
    interpreter.set_point(&plan, Point::at(&[0.3]));
    Ok(interpreter.output(output)[0])
}

fn exact(text: &str) -> Result<Rational, String> {
    constant(text).map_err(|failure| failure.diagnostics[0].message.clone())
}

#[test]
fn numbers_are_exact() {
    let ratio = |numerator: i32, denominator: u32| {
        Ok(Rational::from_parts(numerator.into(), denominator.into()))
    };
    for (text, value) in [
        ("0.1", ratio(1, 10)),
        ("0.1 + 0.2 - 0.3", ratio(0, 1)),
        ("1e-400*1e400", ratio(1, 1)),
        (".5e1", ratio(5, 1)),
        ("1/3 + 1/6", ratio(1, 2)),
        ("-2^2", ratio(-4, 1)),
        ("(-2)^2", ratio(4, 1)),
        ("2^-2", ratio(1, 4)),
        ("2^-1^2", ratio(1, 2)),
        ("2^3^2", ratio(512, 1)),
        ("-2^-2", ratio(-1, 4)),
        ("2*-3", ratio(-6, 1)),
        ("6/2*3", ratio(9, 1)),
        ("7 - 2 - 1", ratio(4, 1)),
        ("4^(1/2)", ratio(2, 1)),
        ("8^(-2/3)", ratio(1, 4)),
        ("(4/9)^1.5", ratio(8, 27)),
        ("sqrt(0.25)", ratio(1, 2)),
        ("exp(0)*cosh(0)", ratio(1, 1)),
        ("0^2", ratio(0, 1)),
        ("5^0", ratio(1, 1)),
    ] {
        assert_eq!(exact(text), value, "{text}");
    }
    assert!(exact("1e-400").expect("a number") > Rational::ZERO);
}

#[test]
fn every_function_is_the_one_of_its_name() {
    let (x, t) = (0.3_f64, 0.7_f64);
    for (text, expected) in [
        ("sqrt(X)", x.sqrt()),
        ("exp(-X)", (-x).exp()),
        ("ln(X)", x.ln()),
        ("sin(X)", x.sin()),
        ("cos(X)", x.cos()),
        ("tan(X)", x.tan()),
        ("sinh(X)", x.sinh()),
        ("cosh(X)", x.cosh()),
        ("tanh(X)", x.tanh()),
        ("asin(X)", x.asin()),
        ("acos(X)", x.acos()),
        ("atan(X)", x.atan()),
        ("atan2(X, -t)", x.atan2(-t)),
        ("hypot(X, t)", x.hypot(t)),
        ("cbrt(-X)", (-x).cbrt()),
        ("pi*X", core::f64::consts::PI * x),
        ("X^(1/3)", x.powf(1.0 / 3.0)),
        ("X^0.1", x.powf(0.1)),
        ("X^-1.5", x.powf(-1.5)),
        ("-X^2", -(x * x)),
        ("2^-X", 2.0_f64.powf(-x)),
        ("2^X^2", 2.0_f64.powf(x * x)),
        ("exp(X)^t", (x * t).exp()),
        ("(1 + X^2)^t", (1.0 + x * x).powf(t)),
        ("(t^2 + X^4 + 1/2)^X", (t * t + x.powi(4) + 0.5).powf(x)),
        ("cosh(X)^(X*t)", x.cosh().powf(x * t)),
        ("(1 + sqrt(X))^t", (1.0 + x.sqrt()).powf(t)),
    ] {
        let found = value("", "", text).unwrap_or_else(|message| panic!("{text}: {message}"));
        assert!((found - expected).abs() <= 1e-15 * expected.abs().max(1.0), "{text}: {found}");
    }
}

#[test]
fn a_variable_exponent_needs_a_base_that_is_not_seen_to_be_negative() {
    let positive = "a = { value = 2 }\nb = { value = \"3*a^2\" }";
    for base in ["a", "b", "a*b", "a/b", "(a + X^2)", "sqrt(a)", "exp(X)", "pi", "(X^2 + t^2 + a)"]
    {
        assert!(value(positive, "", &format!("{base}^(X*t)")).is_ok(), "{base}");
    }
    // A certificate proves whether these are positive over a body.
    for (base, at) in [("X", 0.3_f64), ("(1 + X)", 1.3), ("(X^2)", 0.09), ("(1 - X^2)", 0.91)] {
        let found = value("", "", &format!("{base}^t")).unwrap();
        assert!((found - at.powf(0.7)).abs() < 1e-15, "{base}");
    }
    let refused = Err("a variable exponent needs a positive base".to_string());
    for base in ["(-1)", "0", "(2 - 3)"] {
        assert_eq!(value("", "", &format!("{base}^t")), refused, "{base}");
    }
}

#[test]
fn definitions_and_parameters_are_read_in_order() {
    let found =
        value("a = { value = 2 }\nb = { value = \"a^2 + 1\" }", "c = \"a*X\"\nd = \"c*b\"", "d");
    assert_eq!(found, Ok(2.0 * 0.3 * 5.0));
    let later = |name: &str| Err(format!("`{name}` is used before it is defined"));
    assert_eq!(value("b = { value = \"a\" }\na = { value = 2 }", "", "X"), later("a"));
    assert_eq!(value("", "c = \"d\"\nd = \"X\"", "c"), later("d"));
    assert_eq!(value("", "c = \"c*X\"", "c"), Err("`c` is defined by itself".into()));
    // Names are case-sensitive.
    let found = value("a = { value = 2 }\nA = { value = 3 }", "", "a*X + A*t");
    assert_eq!(found, Ok(2.0 * 0.3 + 3.0 * 0.7));
}

#[test]
fn what_the_language_lacks_is_refused_and_not_guessed() {
    for text in
        ["1/0", "0^-1", "(-8)^(1/3)", "sqrt(-1)", "ln(0)", "asin(2)", "2^(1/2)", "pi", "+1", ""]
    {
        assert!(exact(text).is_err(), "{text}");
    }
}

/// Powers and nests that are far too large to be written out return a result, after a counted amount of work: the nodes of the
/// graph, or a message.
#[test]
fn what_is_huge_takes_little_work() {
    let few = |u: &str| {
        let text = field("", "", u);
        match compiled(&text) {
            Ok(compiled) => {
                assert!(compiled.graph.size() < 3_000, "{u}: {}", compiled.graph.size());
                assert!(compiled.program.instrs.len() < 2_000, "{u}");
                Ok(())
            }
            Err(failure) => Err(failure.diagnostics[0].message.clone()),
        }
    };
    assert_eq!(few("X^1000000"), Ok(()));
    assert_eq!(few("X^(1/1000000)"), Ok(()));
    assert_eq!(few("(X + 1)^1000000"), Ok(()));
    assert_eq!(few("(X + 1e-400)^1000000"), Ok(()));
    assert_eq!(few("1e-400*X + 1e400*1e-399*X"), Ok(()));
    let long = Err("the power of a number is too long".to_string());
    assert_eq!(few("X*2^1000000"), long);
    assert_eq!(few("X*1.0000001^1000000"), long);
    assert_eq!(few("X*(1/3)^-1000000"), long);
    for (text, wrong) in [
        (format!("{}X{}", "(".repeat(100_000), ")".repeat(100_000)), "nested more than"),
        (format!("{}X", "-".repeat(100_000)), "nested more than"),
        (format!("{}X{}", "sin(".repeat(100_000), ")".repeat(100_000)), "nested more than"),
        (format!("{}X", "X^".repeat(100_000)), "nested more than"),
        (format!("{}X", "(X + 1)^2^".repeat(50_000)), "nested more than"),
        (format!("X{}", "^1".repeat(100_000)), "nested more than"),
        (format!("X{}", "*X".repeat(100_000)), "terms"),
    ] {
        let message = few(&text).expect_err("too deep");
        assert!(message.contains(wrong), "{}...: {message}", &text[..20]);
    }
    assert_eq!(few(&format!("X{}", "*X".repeat(40_000))), Ok(()));
}

/// A chain of definitions as long as a file can contain, or a tenth of it.
#[test]
fn a_long_chain_of_definitions_is_answered() {
    let chain = |count: usize, step: &str| {
        let lets: String = (1..count)
            .map(|k| format!("a{k} = \"{}\"\n", step.replace('_', &(k - 1).to_string())))
            .collect();
        compiled(&field("", &format!("a0 = \"X\"\n{lets}"), &format!("a{}", count - 1)))
    };
    let part = if all_is_tried() { 1 } else { 10 };
    let same = chain(30_000 / part, "a_").expect("one name after another");
    assert!(same.graph.size() < 1_000, "{}", same.graph.size());
    let sum = chain(20_000 / part, "a_ + X").expect("one term after another");
    assert!(sum.graph.size() < 100_000, "{}", sum.graph.size());
    let deep = chain(20_000 / part, "sin(a_)").expect_err("derivatives of thousands of factors");
    assert!(deep.diagnostics[0].message.contains("too large"), "{deep}");
    let long = chain(100_000, "a_ + X").expect_err("2 MB");
    assert!(long.diagnostics[0].message.contains("are read"), "{long}");
}
