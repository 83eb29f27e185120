//! Between Rust and C: panics stop here, and messages go into buffers of the caller.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::error::{Error, MmsCode};

/// Runs the body of a function of the interface. Whatever goes wrong becomes a code, and a message
/// in the caller's buffer, which holds the empty text if nothing did.
pub fn guarded(message: Option<&mut [u8]>, body: impl FnOnce() -> Result<(), Error>) -> MmsCode {
    // Nothing that the body may leave half done is looked at again: a field changes only as a whole.
    let outcome = catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|panic| {
        Err(Error::new(MmsCode::Defect, format!("a mistake of mms_capi: {}", what(panic.as_ref()))))
    });
    let (code, text) = match &outcome {
        Ok(()) => (MmsCode::Ok, ""),
        Err(error) => (error.code, error.message.as_str()),
    };
    if let Some(message) = message {
        write(text, message);
    }
    code
}

/// Runs the body of a function that cannot fail but for a mistake of ours.
pub fn guarded_or<T>(otherwise: T, body: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or(otherwise)
}

/// What a panic says.
fn what(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message")
}

/// Writes as much of a text as there is room for, whole characters only, and a NUL.
fn write(text: &str, buffer: &mut [u8]) {
    let Some(room) = buffer.len().checked_sub(1) else { return };
    let mut length = room.min(text.len());
    while !text.is_char_boundary(length) {
        length -= 1;
    }
    buffer[..length].copy_from_slice(&text.as_bytes()[..length]);
    buffer[length] = 0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_code_with_its_message() {
        let mut buffer = [b'?'; 64];
        let code = guarded(Some(&mut buffer), || panic!("{} of two", 1));
        assert_eq!(code, MmsCode::Defect);
        assert!(buffer.starts_with(b"a mistake of mms_capi: 1 of two\0"));
        assert_eq!(guarded_or(7, || panic!("without a message")), 7);
    }

    #[test]
    fn a_message_is_cut_between_characters() {
        for (room, expected) in
            [(1, "\0?????"), (2, "a\0????"), (3, "a\0????"), (4, "aé\0??"), (6, "aéb\0?")]
        {
            let mut buffer = *b"??????";
            write("aéb", &mut buffer[..room]);
            assert_eq!(buffer, *expected.as_bytes(), "{room}");
        }
        write("text", &mut []);
    }

    #[test]
    fn no_error_is_an_empty_message() {
        let mut buffer = *b"old";
        assert_eq!(guarded(Some(&mut buffer), || Ok(())), MmsCode::Ok);
        assert_eq!(buffer, *b"\0ld");
        assert_eq!(guarded(None, || Err(Error::new(MmsCode::NotFinite, "x"))), MmsCode::NotFinite);
    }
}
