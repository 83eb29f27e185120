//! Compiles whatever the fuzzer thinks of. It may be refused; it may not panic, hang or fill the
//! memory.
#![no_main]

#[path = "../../mms-codegen/tests/support/survive.rs"]
mod survive;

/// A twentieth of the usual: what is refused for its size is found out early, and the fuzzer tries
/// more texts.
const MAX_NODES: usize = 10_000;

libfuzzer_sys::fuzz_target!(|text: &str| {
    let options = mms_codegen::Options { max_nodes: MAX_NODES, ..Default::default() };
    survive::survive(text, &options);
});
