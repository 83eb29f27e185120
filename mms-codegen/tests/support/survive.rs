//! The check that any text must pass: shared by the tests and by the fuzzer.

use mms_codegen::{Options, compile_with};
use mms_spec::diagnostic::render;
use mms_spec::source::Sources;
use mms_spec::syntax::parse;
use mms_spec::{read_field, read_material};

/// Reads a text as a field and as a material, parses every formula, and renders the mistakes.
pub fn survive(text: &str, options: &Options) {
    let mut sources = Sources::default();
    let id = sources.add("x.toml", text);
    let mut diagnostics = Vec::new();
    if let Some(spec) = read_field(&sources, id, "x", &mut diagnostics) {
        assert_eq!(spec.displacement.len(), spec.space.vector());
        spec.formulas().for_each(|formula| drop(parse(formula, &mut diagnostics)));
    }
    if let Some(spec) = read_material(&sources, id, "x", &mut diagnostics) {
        spec.formulas().for_each(|formula| drop(parse(formula, &mut diagnostics)));
    }
    for diagnostic in &diagnostics {
        let span = diagnostic.span;
        assert!(text.get(span.start..span.end).is_some(), "{diagnostic:?} is no place in {text:?}");
    }
    render(&sources, &diagnostics);
    let load = |_: &str| Err("no files here".to_string());
    if let Err(failure) = compile_with("x", "x.toml", text, &load, options) {
        assert!(!failure.to_string().is_empty(), "{text:?} fails without a word");
    }
}
