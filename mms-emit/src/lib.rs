//! Emitters: a program as text of one target language each. They print; they neither
//! differentiate nor reorder.
//!
//! A language is a folder here and its word in the list below. What languages have in common is in
//! [`port`]; the Rust module, which is also what `field!` expands to, has a printer of its own.

pub mod port;
mod target;
mod text;

pub use mms_codegen::rust::File;
pub use target::{Bundle, Subject, Target};

macro_rules! targets {
    ($($name:ident)*) => {
        $(pub mod $name;)*

        /// Every target.
        pub const TARGETS: &[Target] = &[$($name::TARGET),*];
    };
}

targets! { rust rust_mms_math c cpp fortran python numpy sympy ufl octave julia moose karamelo }

impl Target {
    /// The target of that name, or of its other one.
    pub fn find(name: &str) -> Option<&'static Target> {
        TARGETS.iter().find(|target| target.name == name || target.alias == Some(name))
    }
}
