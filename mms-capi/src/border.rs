//! The border between Rust and C: stops panics, writes messages into buffers of the caller, and limits the use of the caller's
//! stack.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::thread;

use crate::error::{Error, MmsCode};
use crate::memory::Message;

/// The stack for a compilation. The deepest nesting that TOML's parser accepts needs 0.4 MiB of it.
const STACK: usize = 2 << 20;

/// Runs the body of a function of the interface. Any failure becomes a code, and a message in the caller's buffer; the message
/// is empty on success. It is written last, so that the buffer may overlap with an argument.
pub fn guarded(message: Message, body: impl FnOnce(Message) -> Result<(), Error>) -> MmsCode {
    let (code, text) = match attempt(|| body(message)) {
        Ok(()) => (MmsCode::Ok, String::new()),
        Err(error) => (error.code, error.message),
    };
    message.write(&text);
    code
}

/// Runs a body, and converts a panic to an error.
pub fn attempt<T>(body: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    // Half-made changes of the body are never used: a field changes only as a whole.
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|panic| {
        Err(Error::new(MmsCode::Defect, format!("a mistake of mms_capi: {}", what(panic.as_ref()))))
    })
}

/// Runs the body of a function that fails only by a defect of this library.
pub fn guarded_or<T>(otherwise: T, body: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or(otherwise)
}

/// Runs a body that may need more stack than a thread of the caller has, on a separate thread.
pub fn on_own_stack<T: Send>(body: impl FnOnce() -> Result<T, Error> + Send) -> Result<T, Error> {
    let builder = thread::Builder::new().name("mms_capi".into()).stack_size(STACK);
    thread::scope(|scope| match builder.spawn_scoped(scope, body) {
        Ok(thread) => thread.join().unwrap_or_else(|panic| resume_unwind(panic)),
        Err(error) => {
            let message = format!("no thread to make the field on: {error}");
            Err(Error::new(MmsCode::NoThread, message))
        }
    })
}

/// The text of a panic.
fn what(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::tests::message;

    #[test]
    fn a_panic_is_a_code_with_its_message() {
        let mut buffer = [b'?'; 64];
        let code = guarded(message(&mut buffer), |_| panic!("{} of two", 1));
        assert_eq!(code, MmsCode::Defect);
        assert!(buffer.starts_with(b"a mistake of mms_capi: 1 of two\0"));
        assert_eq!(guarded_or(7, || panic!("without a message")), 7);
    }

    #[test]
    fn a_panic_on_a_thread_of_its_own_is_no_other() {
        let mut buffer = [b'?'; 64];
        let code = guarded(message(&mut buffer), |_| on_own_stack(|| panic!("far away")));
        assert_eq!(code, MmsCode::Defect);
        assert!(buffer.starts_with(b"a mistake of mms_capi: far away\0"));
    }

    #[test]
    fn no_error_is_an_empty_message() {
        let mut buffer = *b"old";
        assert_eq!(guarded(message(&mut buffer), |_| Ok(())), MmsCode::Ok);
        assert_eq!(buffer, *b"\0ld");
        let fails = |_| Err(Error::new(MmsCode::NotFinite, "x"));
        assert_eq!(guarded(message(&mut []), fails), MmsCode::NotFinite);
    }
}
