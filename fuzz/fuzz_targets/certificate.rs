//! Makes a field from bytes, and searches for points at which the program contradicts its certificate.
#![no_main]

#[path = "../../mms-codegen/tests/support/hunt.rs"]
mod hunt;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    hunt::hunt(&hunt::field(data), data);
});
