//! The field `bar_1d`, compiled by `field!`. The field has its own crate, so that a change of other fields or of the
//! command does not recompile it.

use mms_runtime::scene::Code;

mms_macros::field!("fields/bar_1d.toml");

/// The compiled field of that name; `None` unless it is the bar.
pub fn find(name: &str) -> Option<Code> {
    Some(mms_runtime::code!(bar_1d)).filter(|code| code.name == name)
}
