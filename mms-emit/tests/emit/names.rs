//! Names of users: none ends the text around it, and none is lost.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use mms_codegen::{Compiled, Options, compile_with};
use mms_emit::{Subject, TARGETS};
use mms_spec::language::FUNCTIONS;
use mms_spec::names::COORDINATES;
use mms_spec::quantity::Quantity;

use super::build::{can_prove, in_turn, ports, prove, quick};
use super::sampled::sampled;

const ODD_NAMES: &str = "../tests/programs/odd_names.toml";

fn odd_names() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(ODD_NAMES)).expect("a field file")
}

/// Two quantities are enough: names are the same in all functions.
fn compiled(stem: &str, text: &str) -> Compiled {
    let mut options = Options::default();
    options.selection.quantities = Some([Quantity::Displacement, Quantity::Velocity].into());
    compile_with(stem, "x.toml", text, &|path| Err(path.into()), &options)
        .unwrap_or_else(|failure| panic!("{failure}"))
}

#[test]
fn parameters_may_have_any_name_in_every_language() {
    let field = compiled("odd_names", &odd_names());
    let subject = Subject::new(&field);
    for target in sampled(ports().filter(|target| can_prove(target)), 2) {
        prove(target, &subject, "odd_names", quick);
    }
}

/// Parameters named like words of many languages.
#[test]
fn words_of_any_language_are_names() {
    const WORDS: &str = "end double gamma y0 j1 I NULL NAN lambda def class None True and elif yield \
        subroutine module function real integer use contains elemental pure result wp intent \
        M_PI linux unix errno namespace template typename operator std constexpr __LINE__ __cplusplus \
        _Bool _ __ __init__ self np sp numpy math float int len field_ q12 w12 now out parameters \
        field t0 at_time prepare body_force_batch sqrt_ Sqrt SQRT LAMBDA Lambda End END bAR_ \
        A_2 a A a_2 wide wide_add real32 real64 isnan signbit T auto register inline";
    let long = "x".repeat(100);
    let longer = format!("{}y", "x".repeat(99));
    let kept = TARGETS.iter().flat_map(|target| target.words).copied().chain([WORDS]);
    let kept = kept.flat_map(str::split_whitespace);
    // The field language reserves some names for itself.
    let is_free = |word: &&str| {
        !FUNCTIONS.contains(word) && !COORDINATES.iter().any(|(name, _)| name == word)
    };
    let names: BTreeSet<&str> =
        kept.filter(is_free).chain([long.as_str(), longer.as_str()]).collect();
    let parameters: String = (names.iter().enumerate())
        .map(|(index, name)| format!("{name} = {{ value = {} }}\n", index + 1))
        .collect();
    let terms: Vec<String> = (names.iter().enumerate())
        .map(|(index, name)| format!("{name}/{}", 2 * index + 1))
        .collect();
    let text = format!(
        "[field]\ntitle = \"Words\"\ndimension = 1\n[parameters]\n{parameters}\
         [displacement]\nu = [\"X*({})/10000*cos(t)\"]\n[material]\nmodel = \"neo_hookean\"\n\
         lambda = 1\nmu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\n\
         time = [0, 1]\n",
        terms.join(" + ")
    );
    let field = compiled("words", &text);
    let subject = Subject::new(&field);
    for target in sampled(ports().filter(|target| can_prove(target)), 3) {
        prove(target, &subject, "words", quick);
    }
}

/// The needed support functions are found from the calls of a field, not from the words of its text.
#[test]
fn a_parameter_called_like_a_support_function_brings_none_of_it() {
    const CALLED: &str = "wide_of ln_1p_rest sin_pi wide settled parameters_ math";
    let parameters: Vec<String> = (CALLED.split(' ').enumerate())
        .map(|(index, name)| format!("{name} = {{ value = {} }}\n", index + 1))
        .collect();
    let text = format!(
        "[field]\ntitle = \"math.pi, wide_of(1)\"\ndimension = 1\n[parameters]\n{}\
         [displacement]\nu = [\"X^2/100\"]\n[material]\nmodel = \"neo_hookean\"\n\
         lambda = 1\nmu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\n\
         time = [0, 1]\n",
        parameters.concat()
    );
    let field = compiled("called", &text);
    let subject = Subject::new(&field);
    let emitted = |name: &str| {
        let target = TARGETS.iter().find(|it| it.name == name).expect("a target");
        (target.emit)(&subject).files.remove(0).text
    };
    for (target, definition) in [("cpp", "struct wide"), ("fortran", "type :: wide")] {
        let text = emitted(target);
        assert!(text.contains("wide_of"), "{target}: the parameter\n{text}");
        assert!(!text.contains(definition), "{target}\n{text}");
    }
    assert!(!emitted("ufl").contains("import math\n"), "the title is no use of the module");
}

fn plain() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/programs/plain.toml");
    fs::read_to_string(path).expect("a field file")
}

#[test]
fn a_field_may_have_any_stem_and_title_in_every_language() {
    let bar = plain();
    let title = bar.lines().find(|line| line.starts_with("title")).expect("a title");
    let evil = r#"title = "a */ int evil; /* ??/ \\\n\"\"\" \u2028 ''' -- !end \\""#;
    let text = bar.replace(title, evil);
    let long = "abcdefghij".repeat(7);
    let stems = ["2d", "double", "math", "std", "body_force", &long];
    for (index, stem) in stems.into_iter().enumerate() {
        let field = compiled(stem, &text);
        let subject = Subject::new(&field);
        for target in in_turn("stems", index, stems.len()) {
            prove(target, &subject, &format!("stems/{stem}"), quick);
        }
    }
}

#[test]
fn a_field_may_be_called_like_a_function_of_its_own() {
    for (stem, target) in [("material_strain_energy", "fortran"), ("wave_speed_c", "fortran")] {
        let field =
            compile_with(stem, "x.toml", &plain(), &|path| Err(path.into()), &Options::default())
                .unwrap_or_else(|failure| panic!("{failure}"));
        let target = TARGETS.iter().find(|it| it.name == target).expect("a target");
        if can_prove(target) {
            prove(target, &Subject::new(&field), &format!("functions/{stem}"), quick);
        }
    }
}

/// Names of check programs do not collide with names of fields.
#[test]
fn a_field_may_be_called_like_what_its_check_program_names() {
    let stems =
        ["check", "points", "sets", "worst", "failures", "found", "field", "row", "run", "f"];
    for (index, stem) in stems.into_iter().enumerate() {
        let field = compiled(stem, &plain());
        let subject = Subject::new(&field);
        for target in in_turn("check programs", index, stems.len()) {
            prove(target, &subject, &format!("checked/{stem}"), quick);
        }
    }
}
