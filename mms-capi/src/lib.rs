//! Any field, any quantity, in batches, for programs that are not written in Rust: `mms_capi.h` and its library.
//!
//! The interface is documented in the header, `include/mms_capi.h`, which a test compares with `src/abi.rs`. In short: a
//! *handle* is made from a name of the gallery or from the text of a field file; parameters are set and read by name; every
//! quantity is evaluated at any number of points. Each function returns a code, and writes a message about a failure into a
//! buffer of the caller. The only state is in handles, any function may be called on any thread, and no panic leaves the
//! library.
//!
//! Values are interpreted, with the same bits as from `mms eval`, since a running program cannot load generated code.
//!
//! | file | contents |
//! |---|---|
//! | `field` | the complete library, in safe Rust |
//! | `settings` | a field's parameters, which change as a whole while other threads evaluate |
//! | `evaluator` | quantities at many points, in blocks |
//! | `gallery` | the texts of the shipped fields |
//! | `stop` | ends long calls on request |
//! | `error` | the codes and messages |
//! | `memory` | the only code that accesses the memory of the caller: it checks addresses before they become slices and texts, and writes results through pointers, never through references |
//! | `abi` | the functions, from which `mms_capi.h` is generated |
//! | `border` | converts panics and errors to codes and messages, and compiles on a separate thread, since the stack of the caller may be small |
//!
//! `interleavings/`, a separate package, tries all orders of threads. `fields` is a link to the gallery, so that the crate can
//! be packaged.

mod abi;
mod border;
mod error;
mod evaluator;
mod field;
mod gallery;
mod memory;
mod settings;
mod stop;

/// The locks. `interleavings/` replaces them.
mod locks {
    pub use std::sync::{Arc, Mutex, RwLock};
}
