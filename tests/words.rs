//! The compiler of field files does not depend on the solver, so it keeps its own lists of the words that a field file may use.
//! These tests compare them with the lists of the solver.

use mms_codegen::compile;
use mms_codegen::compile::Failure;
use mms_runtime::{IntegratorName, ShapeName};
use mms_spec::language::FUNCTIONS;
use mms_spec::names::MAX_NAME;
use mms_spec::{INTEGRATORS, SHAPES};

/// The words with a meaning in a target language or in generated code: one line per target. A field may use every one of
/// these as a name.
const TARGETS: &[(&str, &[&str])] =
    &[("Rust", &[RUST_KEYWORDS, RUST_PRELUDE, RUST_TYPES, RUST_GENERATED])];

/// The Rust Reference, section 2.1: strict, reserved and weak keywords.
const RUST_KEYWORDS: &str = "\
    as break const continue crate dyn else enum extern false fn for if impl in let loop match \
    mod move mut pub ref return self Self static struct super trait true type unsafe use where \
    while async await abstract become box do final macro override priv typeof unsized virtual \
    yield try gen macro_rules union raw safe auto default";
/// The names in scope without an import, and the crates' names.
const RUST_PRELUDE: &str = "\
    Option Some None Ok Err Result Vec Box String ToString Iterator IntoIterator FromIterator \
    Extend Into From TryFrom TryInto Clone Copy Send Sync Sized Unpin Drop drop Fn FnMut \
    FnOnce Eq PartialEq Ord PartialOrd Default AsRef AsMut ToOwned DoubleEndedIterator \
    ExactSizeIterator Debug Hash vec panic assert println format matches todo unreachable core \
    std alloc mms mms_runtime mms_math mms_macros";
/// The primitive types.
const RUST_TYPES: &str = "\
    bool char str i8 i16 i32 i64 i128 isize u8 u16 u32 u64 u128 usize f32 f64";
/// Items, arguments and values of generated modules.
const RUST_GENERATED: &str = "\
    Parameters AtTime Field prepare at_time prepared boxed from_array NAMES NAME DIMENSION \
    OWN_MATERIAL Scalar Real ManufacturedField Material Vector Matrix D T X0 X1 H11 H12 N1 N2 \
    v0 v1 v2 v12 v123 x x0 x1 time point points normal gradient reference out parameters \
    body_force displacement velocity jacobian density new field of to_array";

/// A field of one component.
const ONE_FORMULA: &str = r#"
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
"#;

/// The mistakes of a field whose displacement is a formula.
fn mistakes(formula: &str) -> Result<(), Failure> {
    let text = ONE_FORMULA.replace("{formula}", formula);
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
    let arguments = |count: usize| vec!["1/4 + X/4 + t/8"; count].join(", ");
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

/// The field of `tests/programs/odd_names.rs`, where each of its names is compiled and evaluated.
const ODD_NAMES: &str = include_str!("programs/odd_names.toml");

#[test]
fn every_word_of_every_target_is_a_name_in_the_field_that_is_compiled() {
    let compiled = compile("odd_names", "odd_names.toml", ODD_NAMES, &|path| Err(path.into()))
        .unwrap_or_else(|failure| panic!("{failure}"));
    let names: Vec<_> =
        compiled.model.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    for (target, words) in TARGETS {
        for word in words.iter().flat_map(|words| words.split_whitespace()) {
            assert!(names.contains(&word), "{target}: odd_names.toml lacks `{word}`");
        }
    }
    assert!(names.iter().any(|name| name.len() == MAX_NAME));
    let lower = |name: &&str| name.eq_ignore_ascii_case("case_only");
    assert_eq!(names.iter().filter(|name| lower(name)).count(), 3, "names that differ by case");
}

#[test]
fn what_is_no_identifier_or_has_a_meaning_is_refused_wherever_a_name_stands() {
    let too_long = "a".repeat(MAX_NAME + 1);
    let strange = [
        ("a\"); evil(", "is not a name"),
        ("a\n}", "is not a name"),
        ("r#fn", "is not a name"),
        ("", "is not a name"),
        ("a b", "is not a name"),
        ("a-b", "is not a name"),
        ("2a", "is not a name"),
        ("a;", "is not a name"),
        ("{a}", "is not a name"),
        // Letters that look like ASCII: a Greek chi, full-width fn, a Cyrillic a, combining marks.
        ("\u{3a7}", "is not a name"),
        ("\u{ff46}\u{ff4e}", "is not a name"),
        ("\u{430}", "is not a name"),
        ("e\u{301}", "is not a name"),
        (&too_long, "has 101 characters"),
        ("X", "is reserved"),
        ("t", "is reserved"),
        ("pi", "is reserved"),
        ("sin", "is reserved"),
    ];
    for (name, complaint) in strange {
        let escaped: String =
            name.chars().map(|letter| format!("\\U{:08x}", letter as u32)).collect();
        for (before, after) in [
            ("[parameters]\n", " = { value = 1 }\n"),
            ("[let]\n", " = 1\n"),
            ("[[check]]\nquantity = \"displacement\"\nequals = [\"X\"]\nlet = { ", " = 1 }\n"),
        ] {
            let text =
                format!("{before}\"{escaped}\"{after}{ONE_FORMULA}").replace("{formula}", "X");
            let failure = compile("x", "x.toml", &text, &|path| Err(path.into()))
                .map(drop)
                .expect_err("a strange name");
            let found = &failure.diagnostics[0];
            assert!(found.message.contains(complaint), "{before}{name}: {failure}");
            let place = failure.sources.slice(found.span);
            assert_eq!(place, format!("\"{escaped}\""), "{failure}");
        }
    }
}
