//! Any field, any quantity, in batches, for programs that are not written in Rust: `mms_capi.h` and the library
//! behind it.
//!
//! The interface is documented in the header, `include/mms_capi.h`, which a test keeps in step with `src/abi.rs`.
//! In short: a *handle* is made of a name of the gallery or of the text of a field file; parameters are set and
//! read by name; every quantity is evaluated at any number of points. Each function says by a code how it went,
//! and writes what is wrong into a buffer of the caller. There is no state but that of a handle, any function may
//! be called on any thread, and no panic leaves the library.
//!
//! Values are those of the interpreter, bit for bit those of `mms eval`, for a program that is there already
//! cannot be given code.
//!
//! | file | does |
//! |---|---|
//! | `field` | all that the library does, in safe Rust |
//! | `settings` | holds a field's parameters, which change as a whole while other threads evaluate |
//! | `memory` | alone touches the memory of the caller: it looks at addresses before they become slices and texts, and writes results through pointers, never through references |
//! | `abi` | has the functions, which `mms_capi.h` is made of |
//! | `border` | turns panics and errors into codes and messages, and compiles on a thread of its own, for the stack of the caller may be small |
//!
//! `interleavings/`, a package of its own, tries all orders of threads. `fields` is a link to the gallery, so that
//! the crate can be packaged.

mod abi;
mod border;
mod error;
mod evaluator;
mod field;
mod gallery;
mod memory;
mod settings;
mod stop;

/// The locks. `interleavings/` has others in their place.
mod locks {
    pub use std::sync::{Arc, Mutex, RwLock};
}
