//! Emitters: each prints a program as text of one target language. They neither differentiate nor reorder.
//!
//! Each language has a folder here and its word in the list below. All except one are ports, and [`port`] holds their common
//! parts. The target `rust-mms-math` has its own printer. It writes the module to which `field!` expands, which uses the
//! scalars and the vectorised loops of `mms-math`, and so has the same bits. The target `rust` is a port without a dependency. An emitted Rust file has
//! the kernels without the contract, and no attribute of the whole file, so that it can be a module or be included in one.
//! Fortran also has an interface for C, which passes arrays of points on to its elemental procedures.

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
    /// Finds the target with this name or alias.
    pub fn find(name: &str) -> Option<&'static Target> {
        TARGETS.iter().find(|target| target.name == name || target.alias == Some(name))
    }
}
