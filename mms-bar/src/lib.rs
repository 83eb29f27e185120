//! The field `bar_1d`, compiled by `field!`. It has its own crate, so that other fields and pages of the command do not
//! recompile it.

use mms_runtime::scene::Code;

mms_macros::field!("fields/bar_1d.toml");

/// The compiled field of that name; `None` unless it is the bar.
pub fn find(name: &str) -> Option<Code> {
    Some(mms_runtime::code!(bar_1d)).filter(|code| code.name == name)
}
