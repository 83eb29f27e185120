//! Rust: the module that this project's solver uses.

use mms_codegen::rust::file;

use crate::target::{Bundle, Target};

/// Rust: the module that this project's solver uses.
pub const TARGET: Target = Target {
    name: "rust-mms-math",
    alias: None,
    doc: "Rust: the module that `field!` makes, which needs only mms-math",
    emit: |subject| Bundle { files: vec![file(subject.compiled)], verify: None },
    words: &[],
};
