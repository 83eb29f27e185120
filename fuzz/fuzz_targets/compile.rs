//! Compiles whatever the fuzzer thinks of. It may be refused; it may not panic, hang or fill the
//! memory.
#![no_main]

#[path = "../../mms-codegen/tests/support/survive.rs"]
mod survive;

/// A twentieth of the usual: what is refused for its size is found out early, and the fuzzer tries
/// more texts.
const LIMITS: mms_codegen::Limits = mms_codegen::Limits { max_nodes: 10_000 };

libfuzzer_sys::fuzz_target!(|text: &str| survive::survive(text, &LIMITS));
