//! Derivations on paper, in plain Rust: a second opinion on every generated quantity that shares
//! nothing with the compiler of field files. One file per field.

mod bar_1d;
