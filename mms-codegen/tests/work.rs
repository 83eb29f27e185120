//! A check ends soon for any text: it counts steps, and names the parts that it left out. It also stops on request. If formulas
//! are too large to be derived, the message names the one that makes them so.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use cpu_time::ThreadTime;
use mms_codegen::certify::certificate::{Certificate, certify};
use mms_codegen::certify::closed_form::{ClosedFormVerdict, Comparison, compare};
use mms_codegen::certify::finite::Finite;
use mms_codegen::certify::rest;
use mms_codegen::certify::rest::Rest;
use mms_codegen::certify::sign::Sign;
use mms_codegen::certify::undefined::gaps;
use mms_codegen::certify::{claims, computed};
use mms_codegen::compile::{Failure, compile_unproved};
use mms_codegen::culprit::culprit;
use mms_codegen::{Compiled, Options};
use mms_spec::read_field;
use mms_spec::source::Sources;
use mms_symbolic::work::Stop;

use crate::sampled::{all_is_tried, sampled};

/// The limit of a check that has hung: a check ends within ten seconds of processor time.
const ENDLESS: Duration = Duration::from_secs(120);

fn faults() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/faults")
}

fn fault(name: &str) -> String {
    fs::read_to_string(faults().join(name)).expect("a case")
}

fn compiled(text: &str, options: &Options) -> Result<Compiled, Failure> {
    let load = |name: &str| fs::read_to_string(faults().join(name)).map_err(|it| it.to_string());
    compile_unproved("x", "x.toml", text, &load, options)
}

/// Runs everything that `mms check` does with a field.
fn check(text: &str) -> Result<(Compiled, Vec<Comparison>, Certificate), Failure> {
    let begun = ThreadTime::now();
    let compiled = compiled(text, &Options::default());
    let checked = compiled.map(|compiled| {
        let comparisons = compare(&compiled);
        gaps(&compiled);
        rest::stress(&compiled);
        let certificate = certify(&compiled);
        certificate.objections(&compiled);
        (compiled, comparisons, certificate)
    });
    let taken = begun.elapsed();
    assert!(taken < ENDLESS, "{taken:?}");
    checked
}

/// A field of the displacement u in one dimension, with more parameters, definitions and tables.
fn field(u: &str, parameters: &str, definitions: &str, tables: &str) -> String {
    let text = fault("u_sinh.toml");
    let text = text.replace("a*sinh(1000*X)", u);
    let text = text.replace("\n[let]\n", &format!("\n{parameters}\n[let]\n{definitions}\n"));
    text + tables
}

fn nested(function: &str, depth: usize, of: &str) -> String {
    format!("{}{of}{}", format!("{function}(").repeat(depth), ")".repeat(depth))
}

fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(|index| line(index) + "\n").collect()
}

#[test]
fn the_cases_end_and_say_what_they_left() {
    let names = ["u_sinh.toml", "deep_sin_100.toml", "let_double.toml", "time_03.toml"];
    for name in sampled(names, 4) {
        let (compiled, _, certificate) = check(&fault(name)).expect("a field");
        let is_whole = compiled.simplified && certificate.spent.is_empty();
        let is_proved = certificate.objections(&compiled).is_empty();
        assert!(!is_whole || is_proved, "{name}: {:?}", certificate.spent);
        assert!(name != "u_sinh.toml" || !certificate.spent.is_empty());
    }
}

/// A function in arbitrary precision is charged its full cost: a few hundred cells spend the budget, where ten thousand took 18
/// s. Once the budget is spent, no place is reported as a failure.
#[test]
fn functions_of_tiny_numbers_end() {
    let text = fault("slow_atan2.toml");
    let logarithm = text.replace("atan2(1e-200*(X+1),1e-200)", "ln(1e-300*(X+1))");
    let checked = [&text, &text, &logarithm].map(|it| check(it).expect("a field"));
    // Equal texts spend equal budgets.
    let [(one, _, first), (other, _, second), _] = &checked;
    assert_eq!(one.program, other.program);
    assert_eq!((first.boxes, &first.spent), (second.boxes, &second.spent));
    for ((_, _, certificate), is_proved) in checked.iter().zip([true, true, false]) {
        assert_eq!(certificate.spent, ["what is computed"]);
        let [double, single] = &certificate.computed;
        assert_eq!(double.verdict == computed::ComputedVerdict::Proved, is_proved, "{double:?}");
        assert!(matches!(single.verdict, computed::ComputedVerdict::Unproved(..)), "{single:?}");
        assert!(double.cells + single.cells < 2000, "{} {}", double.cells, single.cells);
    }
}

#[test]
fn deep_and_wide_formulas_end() {
    for function in sampled(["sinh", "atan", "sin"], 3) {
        let _ = check(&field(&format!("a*{}", nested(function, 300, "X/2")), "", "", ""));
    }
    let count = if all_is_tried() { 8000 } else { 2000 };
    let terms: Vec<_> = (1..count).map(|k| format!("sin({k}*X + t)/{k}")).collect();
    let factors: Vec<_> = (1..200).map(|k| format!("(1 + sin({k}*X)/{})", 9 * k)).collect();
    for wide in sampled([format!("({})", terms.join(" + ")), factors.join("*")], 2) {
        let _ = check(&field(&format!("a*{wide}"), "", "", ""));
    }
}

#[test]
fn powers_and_long_numbers_end() {
    let power = "a*(1 + X/1000)^(123456789/1000000)".to_string();
    let powers: Vec<_> = (1..150).map(|k| format!("(X + {k}/7)^{k}")).collect();
    let powers = format!("1e-300*({})", powers.join(" + "));
    let thirds: Vec<_> = (1..3000).map(|k| format!("X/{}", 10_u64.pow(17) + k * k)).collect();
    let thirds = format!("a*({})", thirds.join(" + "));
    for u in sampled([power, powers, thirds], 2) {
        let _ = check(&field(&u, "", "", ""));
    }
}

#[test]
fn definitions_that_double_end() {
    let doubled =
        lines(30, |k| format!("x{} = \"x{k} + sin(x{k})*x{k}\"", k + 1)).replace("x0 ", "X ");
    let doubled = doubled.replace("x0)", "X)").replace("x0\"", "X\"");
    let _ = check(&field("a*x30", "", &doubled, ""));
}

#[test]
fn many_ranges_and_closed_forms_end() {
    let ranges = lines(1000, |k| format!("p{k} = {{ value = 0.5, range = [0.1, 0.9] }}"));
    let terms: Vec<_> = (0..1000).map(|k| format!("p{k}*X/1e5")).collect();
    let (_, _, certificate) = check(&field(&terms.join(" + "), &ranges, "", "")).expect("a field");
    assert!(!certificate.spent.is_empty());
    let count = if all_is_tried() { 3000 } else { 1000 };
    let checks =
        lines(count, |k| format!("[[check]]\nquantity = \"u\"\nequals = [\"a*sin({k}*X)\"]"));
    let (_, comparisons, _) = check(&field("a*sin(X)", "", "", &checks)).expect("a field");
    let looked_at =
        |it: &Comparison| it.points > 0 || matches!(it.verdict, ClosedFormVerdict::Unmeasured);
    assert!(comparisons.iter().all(looked_at));
}

#[test]
fn many_extremes_end() {
    let extremes = lines(5000, |k| format!("[[extreme]]\nname = \"e{k}\"\nset = {{ a = {k} }}"));
    let _ = check(&field("a*X", "", "", &extremes));
}

/// One value of u in 77 digits would exceed a budget: nothing is compared, and nothing passes.
#[test]
fn a_closed_form_that_takes_too_long_is_not_compared() {
    let terms: Vec<_> = (1..8000).map(|k| format!("sinh(X*{k}/8000)")).collect();
    let form = format!("[[check]]\nquantity = \"u\"\nequals = [\"{}\"]\n", terms.join(" + "));
    let checked = check(&field("a*X", "", "", &form.repeat(2)));
    let (_, comparisons, _) = checked.unwrap_or_else(|failure| panic!("{failure}"));
    assert!(
        matches!(comparisons[0].verdict, ClosedFormVerdict::Unmeasured),
        "{:?}",
        comparisons[0].verdict
    );
    assert_eq!(comparisons[0].points, 0);
}

#[test]
fn who_is_asked_to_stop_says_so() {
    let stop = Stop::default();
    stop.ask();
    let options = Options { stop, ..Options::default() };
    let failure = compiled(&fault("u_sinh.toml"), &options).expect_err("it was stopped");
    assert_eq!(failure.diagnostics.len(), 1);
    assert!(failure.to_string().contains("stopped before its end"), "{failure}");
}

/// After a stop all budgets are empty from the start, and so is the budget of a part after a spent one.
#[test]
fn a_proof_that_is_stopped_proves_nothing_and_refutes_nothing() {
    let fields = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    for name in ["bar_1d", "conformal_sector_2d", "graded_bar", "twisted_column"] {
        let text = fs::read_to_string(fields.join(name).with_extension("toml")).expect("a field");
        let stop = Stop::default();
        let options = Options { stop: stop.clone(), ..Options::default() };
        let compiled = compiled(&text, &options).expect("a field");
        stop.ask();
        let certificate = certify(&compiled);
        assert!(matches!(certificate.jacobian, Sign::Unproved(..)), "{name}");
        assert!(matches!(certificate.finite, Finite::Unproved(..)), "{name}");
        assert!(!certificate.branch_violations.is_empty(), "{name}");
        assert!(certificate.branch_violations.iter().all(|exit| !exit.is_certain), "{name}");
        assert_eq!(
            certificate.computed[0].verdict,
            computed::ComputedVerdict::NotApplicable,
            "{name}"
        );
        for (claim, finding) in &certificate.claims {
            let is_open = matches!(finding, claims::ClaimVerdict::Unproved(_));
            assert!(is_open, "{name}: {claim:?} {finding:?}");
        }
        assert!(rest::stress(&compiled).stress().is_none(), "{name}");
    }
}

#[test]
fn a_stress_at_rest_is_found_with_its_components() {
    let compiled = compiled(&fault("stressed_field.toml"), &Options::default()).expect("a field");
    let found = rest::stress(&compiled);
    let Rest::Stressed(stress, _) = &found else { panic!("{found:?}") };
    // W = mu/2 (I1 - 3) + lambda/2 (ln J)^2 has P = mu I at F = I.
    assert_eq!(stress, &[3e5, 0.0, 0.0, 3e5]);
    let warning = found.warning(&compiled).expect("a warning");
    assert!(warning.is_warning && warning.message.contains("stress at rest"));
}

/// The text that is blamed in a field of these definitions, and the definition that contains it.
fn found(lets: &str, u: &str) -> Option<(String, String)> {
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n[let]\n{lets}\n[displacement]\nu = [\"{u}\"]\n"
    );
    let mut sources = Sources::default();
    let id = sources.add("x.toml", text);
    let field = read_field(&sources, id, "x", &mut Vec::new()).expect("a field");
    let culprit = culprit(&field)?;
    Some((sources.slice(culprit.span).to_string(), culprit.definition))
}

fn waves(count: usize) -> String {
    let waves: Vec<_> = (1..=count).map(|k| format!("sin({k}*X*t)")).collect();
    waves.join("*")
}

#[test]
fn the_definition_with_most_of_the_nodes_is_found() {
    let product = waves(30);
    let lets = format!("a = \"X^2\"\nb = \"1 + cos(t)*({product})\"\nc = \"b + a\"");
    let (text, definition) = found(&lets, "c*X").expect("a culprit");
    assert_eq!(definition, "`b`");
    assert!(text.starts_with("sin(1*X*t)") && text.ends_with("sin(30*X*t)"), "{text}");
}

#[test]
fn the_sub_expression_is_found_in_a_component() {
    let product = waves(40);
    let (text, definition) =
        found("a = \"t\"", &format!("X*(t + exp({product}))")).expect("a culprit");
    assert_eq!(definition, "component 1 of u");
    assert!(text.contains(&product) && !text.starts_with("X*"), "{text}");
}

#[test]
fn many_small_definitions_are_not_to_blame_for_what_uses_them() {
    let lets: String = (0..60).map(|k| format!("a{k} = \"sin({k}*X + t)\"\n")).collect();
    let product: Vec<_> = (0..60).map(|k| format!("a{k}")).collect();
    let (text, definition) = found(&lets, &product.join("*")).expect("a culprit");
    assert_eq!((text, definition), (product.join("*"), "component 1 of u".into()));
}

#[test]
fn a_long_chain_of_definitions_takes_few_trials() {
    let lets: String = (1..2_000).map(|k| format!("a{k} = \"a{}*X + t\"\n", k - 1)).collect();
    assert!(found(&format!("a0 = \"X\"\n{lets}"), "a1999").is_some());
}
