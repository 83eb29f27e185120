//! Emitters: a program as text of one target language each. They print; they neither
//! differentiate nor reorder.

pub mod rust;

use crate::compile::Compiled;

/// A file that a target made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its name, without a folder.
    pub name: String,
    /// All of it.
    pub text: String,
}

/// A language that code is emitted in.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The word of the command line.
    pub name: &'static str,
    /// What comes out, in one line.
    pub doc: &'static str,
    /// Emits what a field was compiled for.
    pub emit: fn(&Compiled) -> File,
}

/// Every target, one line each.
pub const TARGETS: &[Target] =
    &[Target { name: "rust", doc: "a module that needs mms-math alone", emit: rust::file }];

impl Target {
    /// The target of that name.
    pub fn find(name: &str) -> Option<&'static Target> {
        TARGETS.iter().find(|target| target.name == name)
    }
}
