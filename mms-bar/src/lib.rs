//! The field of the main job, compiled by `field!`. It has a crate of its own, for another field or another page of
//! the command is no reason to compile it again.

use mms_runtime::scene::Code;

mms_macros::field!("fields/bar_1d.toml");

/// The compiled field of that name, if it is the bar.
pub fn find(name: &str) -> Option<Code> {
    Some(mms_runtime::code!(bar_1d)).filter(|code| code.name == name)
}
