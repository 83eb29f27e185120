//! The shipped fields, compiled: one module for each file of the folder `fields/`, which is the list.

use mms_runtime::scene::Code;

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));

/// The compiled field of that name.
pub fn find(name: &str) -> Option<&'static Code> {
    FIELDS.iter().find(|code| code.name == name)
}
