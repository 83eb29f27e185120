//! Compiles any text as a field. The compiler may refuse it, but must not panic, hang or fill the memory.
#![no_main]

#[path = "../../mms-codegen/tests/support/survive.rs"]
mod survive;

/// The limit of nodes, 5 % of the default: large texts are refused early, so that the fuzzer tries more texts.
const MAX_NODES: usize = 10_000;

libfuzzer_sys::fuzz_target!(|text: &str| {
    let options = mms_codegen::Options { max_nodes: MAX_NODES, ..Default::default() };
    survive::survive(text, &options);
});
