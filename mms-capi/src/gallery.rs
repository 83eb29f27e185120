//! The texts of the fields that ship: the folder `fields/` is the list.

use std::ffi::CStr;

use mms_spec::suggest::advice;

use crate::error::{Error, MmsCode};
use crate::field::Field;
use crate::stop::Stop;

/// Names, texts, and the texts of the fields' own materials, in the order of the names.
pub const FIELDS: &[(&CStr, &str, Option<&str>)] =
    include!(concat!(env!("OUT_DIR"), "/gallery.rs"));

/// The field of that name.
pub fn field(name: &str) -> Result<Field, Error> {
    let names = || FIELDS.iter().filter_map(|(name, ..)| name.to_str().ok());
    let Some((_, text, material)) = FIELDS.iter().find(|(known, ..)| known.to_str() == Ok(name))
    else {
        let advice = advice(name, names(), |all| format!("it holds {all}"));
        let message = format!("no field `{name}` in the gallery; {advice}");
        return Err(Error::new(MmsCode::UnknownName, message));
    };
    Field::compile(name, text, *material, &Stop::default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_keyboard_is_named() {
        let error = field("bar1d").expect_err("no such field");
        assert_eq!(error.code, MmsCode::UnknownName);
        assert_eq!(error.message, "no field `bar1d` in the gallery; did you mean `bar_1d`?");
    }
}
