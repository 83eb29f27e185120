//! The text of a new field file.

use mms_analysis::visibility::{Term, Visibility};
use mms_codegen::certify::closed_form::{ClosedFormVerdict, Comparison, compare};
use mms_codegen::compile::Failure;
use mms_codegen::materials::MATERIALS;
use mms_codegen::{Compiled, compile};
use mms_exact::gallery;
use mms_exact::template::{Body, NEO_HOOKEAN, TAKEN, Template, material};
use mms_spec::source::Sources;
use mms_spec::{Face, MaterialSpec, format, read_material};

use crate::sampled::sampled;

/// One text in `SHARE` is compiled.
const SHARE: usize = 12;

/// The bodies that `mms new` supports.
const BODIES: [(Body, usize); 4] =
    [(Body::Box, 1), (Body::Box, 2), (Body::Box, 3), (Body::Annulus, 2)];

/// A material with parameters whose names the template needs itself.
const GREEDY: &str = r#"
[material]
title         = "greedy"
strain_energy = "(A + k + length + w_X)*(J - 1)^2 + period*(I1 - 3)"

[parameters]
A      = { unit = "Pa", doc = "a \"quoted\" word" }
k      = {}
length = { unit = "Pa" }
period = { unit = "Pa" }
w_X    = { unit = "Pa" }
"#;

fn greedy() -> MaterialSpec {
    let mut sources = Sources::default();
    let source = sources.add("greedy.toml", GREEDY);
    read_material(&sources, source, "./greedy.toml", &mut Vec::new()).expect("a material")
}

/// Every shipped material, and one that is not shipped.
fn materials() -> Vec<MaterialSpec> {
    let mut materials = gallery::materials();
    assert_eq!(materials.len(), MATERIALS.len());
    materials.push(greedy());
    materials
}

fn text(body: Body, dimension: usize, material: &MaterialSpec) -> String {
    started(body, dimension, material, false)
}

fn started(body: Body, dimension: usize, material: &MaterialSpec, is_undeformed: bool) -> String {
    let (name, path, schema) = ("fresh", "fresh.toml", None);
    Template { name, path, dimension, body, material, is_undeformed, schema }.text()
}

/// Every text that the template writes.
fn texts() -> Vec<String> {
    let materials = materials();
    let all = BODIES.iter().flat_map(|(body, dimension)| {
        let of = |material| [false, true].map(|start| started(*body, *dimension, material, start));
        materials.iter().flat_map(of)
    });
    all.collect()
}

fn compiled(text: &str) -> Result<Compiled, Failure> {
    compile("fresh", "fresh.toml", text, &|_| Ok(GREEDY.into()))
}

/// The text with all its examples in use.
fn uncommented(text: &str) -> String {
    let is_example = |line: &&str| {
        line.strip_prefix('#').is_some_and(|rest| !rest.is_empty() && !rest.starts_with([' ', ':']))
    };
    let lines = text.lines().map(|line| if is_example(&line) { &line[1..] } else { line });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_text_compiles_and_its_closed_forms_hold() {
    for text in sampled(texts(), SHARE) {
        let compiled = compiled(&text).unwrap_or_else(|failure| panic!("{failure}"));
        let comparisons = compare(&compiled);
        let expected = if compiled.material.name == NEO_HOOKEAN { 2 } else { 1 };
        assert_eq!(comparisons.len(), expected, "{text}");
        for comparison in comparisons {
            assert!(
                matches!(comparison.verdict, ClosedFormVerdict::Agrees),
                "{comparison:?}\n{text}"
            );
        }
    }
}

#[test]
fn every_example_works_when_it_is_uncommented() {
    for text in sampled(texts(), SHARE) {
        let whole = uncommented(&text);
        assert_ne!(whole, text);
        let compiled = compiled(&whole).unwrap_or_else(|failure| panic!("{failure}"));
        let field = &compiled.field;
        assert!(field.reference.is_some() && field.extremes.len() == 1, "{whole}");
        for study in &field.studies {
            assert!(study.precision.is_some() && study.form.is_some(), "{whole}");
        }
        let agrees =
            |comparison: &Comparison| matches!(comparison.verdict, ClosedFormVerdict::Agrees);
        assert!(compare(&compiled).iter().all(agrees));
    }
}

#[test]
fn no_text_has_a_gap_a_long_line_or_a_word_that_was_not_filled_in() {
    for text in texts() {
        assert!(!text.contains('@') && !text.contains("| "), "{text}");
        assert!(!text.contains("\n\n\n") && !text.starts_with('\n') && text.ends_with('\n'));
        for line in text.lines() {
            assert!(line.len() <= 100 && line.is_ascii(), "{line}");
        }
    }
}

#[test]
fn the_names_that_the_template_defines_are_known_to_it() {
    let mut defined = Vec::new();
    for (body, dimension) in BODIES {
        let compiled = compiled(&text(body, dimension, &greedy())).expect("a right text");
        let field = compiled.field;
        defined.extend(field.parameters.into_iter().map(|parameter| parameter.name.value));
        let lets = field.checks.into_iter().flat_map(|check| check.lets).chain(field.lets);
        defined.extend(lets.map(|definition| definition.name.value));
    }
    defined.retain(|name| !name.starts_with("material_"));
    defined.sort();
    defined.dedup();
    let mut taken = TAKEN.to_vec();
    taken.sort_unstable();
    assert_eq!(defined, taken);
}

/// Every key of the format and every claim must be explained, or nobody finds it.
#[test]
fn the_texts_name_every_key_and_every_claim() {
    let all = texts().concat();
    let words: Vec<_> = all
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .filter(|it| !it.is_empty())
        .collect();
    let tables = [
        format::FIELD_FILE,
        format::FIELD,
        format::PARAMETER,
        format::GIVEN,
        format::BALANCE,
        format::DISPLACEMENT,
        format::MATERIAL,
        format::DOMAIN,
        format::CHECK,
        format::STUDY,
        format::EXTREME,
        format::RIGID,
    ];
    for word in tables.into_iter().flat_map(format::names).chain(format::claims(Face::RadialMin)) {
        assert!(words.contains(&word), "{word}");
    }
}

#[test]
fn the_schema_is_in_the_first_line_where_there_is_one() {
    let material = material(NEO_HOOKEAN).expect("a shipped material");
    let template = Template {
        name: "fresh",
        path: "fields/fresh.toml",
        dimension: 1,
        body: Body::Box,
        material: &material,
        is_undeformed: false,
        schema: Some("../docs/field.schema.json"),
    };
    let text = template.text();
    assert!(text.starts_with("#:schema ../docs/field.schema.json\n"), "{text}");
    assert!(text.contains("#     mms check fields/fresh.toml\n"), "{text}");
}

#[test]
fn an_unknown_material_gets_the_nearest_one() {
    let complaint = |name: &str| material(name).expect_err(name).to_string();
    assert!(complaint("neohookean").contains("did you mean `neo_hookean`?"));
    assert!(
        complaint("mud").contains("there are ") && complaint("mud").contains(", neo_hookean, ")
    );
}

/// u and v are 0 at the first time, and a is not.
#[test]
fn undeformed_bodies_start_at_rest_and_accelerate() {
    for (body, dimension) in BODIES {
        let material = &gallery::materials()[0];
        let text = started(body, dimension, material, true);
        let compiled = compiled(&text).unwrap_or_else(|failure| panic!("{failure}"));
        let seen = Visibility::of(&compiled).expect("few terms");
        assert!(seen.lacks(&Term::InitialDisplacement) && seen.lacks(&Term::InitialVelocity));
        assert!(!seen.lacks(&Term::InitialAcceleration) && !seen.lacks(&Term::FinalDisplacement));
    }
}
