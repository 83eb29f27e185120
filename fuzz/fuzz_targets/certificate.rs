//! Makes a field of bytes, and looks for points where its certificate says one thing and the program another.
#![no_main]

#[path = "../../mms-codegen/tests/support/hunt.rs"]
mod hunt;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    hunt::hunt(&hunt::field(data), data);
});
