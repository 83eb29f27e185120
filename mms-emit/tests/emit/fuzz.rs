//! Random fields, in C and in Python: more of them than six with `PROPTEST_CASES`.

use mms_analysis::accuracy::{Request, measure};
use mms_codegen::compile::{Failure, compile_unproved};
use mms_codegen::{Compiled, Options};
use mms_emit::{Subject, Target};
use mms_program::precision::Precision;
use mms_spec::Form;
use proptest::prelude::*;
use proptest::test_runner::Config;

use super::build::{can_build, prove, quick};

/// A quarter of the accepted error, in eps.
const LOST: f64 = 16.0;

/// A formula in X, t and two parameters, with a value everywhere.
fn formula() -> impl Strategy<Value = String> {
    let number = (1..50_u32, 1..9_u32).prop_map(|(above, below)| format!("{above}/{below}"));
    let leaf = prop_oneof![
        3 => prop::sample::select(vec!["X", "t", "a", "b", "pi"]).prop_map(String::from),
        1 => number,
    ];
    leaf.prop_recursive(5, 40, 2, |inner| {
        let two = (inner.clone(), inner.clone());
        let pair = prop::sample::select(vec![
            "({})+({})",
            "({})-({})",
            "({})*({})",
            "({})/(2+({})^2)",
            "atan2({},3+({})^2)",
            "(1+({})^2)^sin({})",
            "hypot({},1+({})^2)",
        ]);
        let single = prop::sample::select(vec![
            "sin({})",
            "cos(pi*({}))",
            "tanh(sin({}))",
            "atan({})",
            "exp(sin({}))",
            "sinh(cos({}))",
            "sqrt(1+({})^2)",
            "ln(1+({})^2)",
            "cbrt(2+sin({}))",
            "acos(sin({})/2)",
            "-({})^3",
        ]);
        prop_oneof![
            (pair, two).prop_map(|(form, (a, b))| form.replacen("{}", &a, 1).replacen("{}", &b, 1)),
            (single, inner).prop_map(|(form, a)| form.replace("{}", &a)),
        ]
    })
}

fn field(formula: &str, options: &Options) -> Result<Compiled, Failure> {
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[parameters]\na = {{ value = 0.3 }}\nb = {{ value = 1.7 }}\n\
         [displacement]\nu = [\"X*sin({formula})/1000\"]\n[material]\nmodel = \"neo_hookean\"\nlambda = 1\n\
         mu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n"
    );
    compile_unproved("field", "x.toml", &text, &|path| Err(path.into()), options)
}

/// The largest error of any quantity, in eps of its largest value; infinite if one could not be measured.
fn error(formula: &str) -> f64 {
    let request = Request {
        precisions: vec![Precision::F64],
        forms: vec![Form::Stable],
        regimes: Some(vec!["declared".into()]),
        points: 64,
        ..Request::default()
    };
    let measured = measure(&|options| field(formula, options), &request, |_| ());
    let measured = measured.expect("it has compiled before");
    let rows = measured.rows.into_iter().map(|row| row.errors.max_scaled_eps);
    if measured.left_out.is_empty() { rows.fold(0.0, f64::max) } else { f64::INFINITY }
}

#[test]
fn random_fields_prove_themselves() {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|it| it.parse().ok()).unwrap_or(6);
    let targets: Vec<&Target> = ["c", "python"]
        .iter()
        .filter_map(|name| Target::find(name))
        .filter(|target| can_build(target))
        .collect();
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    proptest!(config, |(formula in formula())| {
        let field = field(&formula, &Options::default());
        // A field that turns the body inside out is refused.
        prop_assume!(field.is_ok());
        // Other languages round at other places: formulas that lose digits by themselves may lose more of them there.
        prop_assume!(error(&formula) < LOST);
        let field = field.expect("it compiles");
        let subject = Subject::new(&field);
        for target in &targets {
            prove(target, &subject, "fuzz", quick);
        }
    });
}
