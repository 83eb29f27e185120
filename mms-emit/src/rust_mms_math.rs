//! Rust, as a module that the solver goes with.

use mms_codegen::rust::file;

use crate::target::{Bundle, Target};

/// Rust, as a module that the solver goes with.
pub const TARGET: Target = Target {
    name: "rust-mms-math",
    alias: None,
    doc: "Rust: the module that `field!` makes, which needs mms-math alone; without --target too",
    emit: |subject| Bundle { files: vec![file(subject.compiled)], verify: None },
    words: &[],
};
