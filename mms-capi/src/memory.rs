//! The memory of a C program: it passes addresses and counts. Each is checked as far as an address can be checked, and is used
//! only as declared: a text or an array that is read, or room that is written to. There are no references to room, since it may
//! be uninitialised.
#![allow(unsafe_code)]

use std::ffi::c_char;
use std::slice;

use crate::error::{Error, MmsCode};

/// The memory range of an argument.
#[derive(Clone, Copy, Debug)]
pub struct MemoryRange {
    what: &'static str,
    start: usize,
    bytes: usize,
}

impl MemoryRange {
    /// The range of an array or of a text.
    pub fn of<T>(what: &'static str, elements: &[T]) -> Self {
        MemoryRange { what, start: elements.as_ptr().addr(), bytes: size_of_val(elements) }
    }

    /// Refuses two ranges with a common byte.
    fn apart(self, other: MemoryRange) -> Result<(), Error> {
        let [first, second] = if self.start <= other.start { [self, other] } else { [other, self] };
        if first.bytes == 0 || second.bytes == 0 || second.start - first.start >= first.bytes {
            return Ok(());
        }
        let message =
            format!("`{}` overlaps with `{}`: expected memory of its own", self.what, other.what);
        Err(Error::new(MmsCode::InvalidArgument, message))
    }
}

/// The buffer for a message: at most `capacity` bytes, none if it is NULL.
#[derive(Clone, Copy, Debug)]
pub struct Message {
    first: *mut c_char,
    capacity: usize,
}

impl Message {
    /// # Safety
    /// NULL, or `capacity` bytes that may be written to while this lives.
    pub unsafe fn new(first: *mut c_char, capacity: usize) -> Self {
        Message { first, capacity: if first.is_null() { 0 } else { capacity } }
    }

    /// The range of the buffer. For a capacity that no buffer has, such as SIZE_MAX, only the first byte is certain.
    pub fn extent(self) -> MemoryRange {
        let bytes = if self.capacity > isize::MAX as usize { 1 } else { self.capacity };
        MemoryRange { what: "message", start: self.first.addr(), bytes }
    }

    /// Writes as much of a text as fits, whole characters only, and a NUL.
    pub fn write(self, text: &str) {
        let Some(room) = self.capacity.checked_sub(1) else { return };
        let text = cut(text, room);
        // SAFETY: `capacity` bytes exist; a text of Rust is in separate memory.
        unsafe {
            self.first.cast::<u8>().copy_from_nonoverlapping(text.as_ptr(), text.len());
            self.first.add(text.len()).write(0);
        }
    }
}

/// The longest beginning of a text of at most `most` bytes that ends between characters.
fn cut(text: &str, most: usize) -> &str {
    let ends = (0..=most.min(text.len())).rev();
    ends.into_iter().find_map(|end| text.get(..end)).unwrap_or_default()
}

/// Memory for results.
#[derive(Debug)]
pub struct Writable<T> {
    next: *mut T,
    left: usize,
}

impl<T: Copy> Writable<T> {
    /// Memory for `count` elements, separate from all other arguments of the call.
    ///
    /// # Safety
    /// NULL, or `count` elements that may be written to while this lives; they may be uninitialised.
    pub unsafe fn new(
        what: &'static str,
        first: *mut T,
        count: usize,
        others: &[MemoryRange],
    ) -> Result<Self, Error> {
        check(what, first, count)?;
        let own = MemoryRange { what, start: first.addr(), bytes: count * size_of::<T>() };
        others.iter().try_for_each(|other| own.apart(*other))?;
        Ok(Writable { next: first, left: count })
    }

    /// Writes the next elements.
    pub fn put(&mut self, elements: &[T]) {
        assert!(elements.len() <= self.left, "more results than there is room for");
        if elements.is_empty() {
            return;
        }
        // SAFETY: there is room; memory of Rust is elsewhere, for `new` refused overlaps.
        unsafe {
            self.next.copy_from_nonoverlapping(elements.as_ptr(), elements.len());
            self.next = self.next.add(elements.len());
        }
        self.left -= elements.len();
    }
}

/// The object of a handle, if the address can be one. Creates no message, as signal handlers require.
///
/// # Safety
/// NULL, or a `T` that lives for `'a`.
pub unsafe fn reference<'a, T>(place: *const T) -> Option<&'a T> {
    // SAFETY: not NULL and aligned; the caller vouches for the rest.
    (!place.is_null() && place.is_aligned()).then(|| unsafe { &*place })
}

/// The object of a handle, or an error if the address cannot be one.
///
/// # Safety
/// NULL, or a `T` that lives for `'a`.
pub unsafe fn handle<'a, T>(what: &str, place: *const T) -> Result<&'a T, Error> {
    check(what, place, 1)?;
    // SAFETY: not NULL and aligned; the caller vouches for the rest.
    Ok(unsafe { &*place })
}

/// The elements of an array.
///
/// # Safety
/// NULL, or `count` elements that nothing changes during `'a`.
pub unsafe fn array<'a, T>(what: &str, first: *const T, count: usize) -> Result<&'a [T], Error> {
    check(what, first, count)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not NULL, aligned, and not longer than an array can be; the caller vouches for the rest.
    Ok(unsafe { slice::from_raw_parts(first, count) })
}

/// A text of at most `most` bytes before its NUL. No byte beyond that is read, nor one after the NUL.
///
/// # Safety
/// NULL, or bytes that nothing changes during `'a`, with a NUL among them or more than `most` of them.
pub unsafe fn text<'a>(
    what: &str,
    first: *const c_char,
    most: usize,
    too_long: MmsCode,
) -> Result<&'a str, Error> {
    check(what, first, 1)?;
    let first = first.cast::<u8>();
    // SAFETY: each byte up to the NUL, or to the first one beyond the limit, exists.
    let Some(length) = (0..=most).find(|index| unsafe { first.add(*index).read() } == 0) else {
        let message = format!("`{what}` has more than {most} bytes, or no NUL at its end");
        return Err(Error::new(too_long, message));
    };
    // SAFETY: they have just been read.
    let bytes = unsafe { slice::from_raw_parts(first, length) };
    str::from_utf8(bytes).map_err(|error| {
        Error::new(MmsCode::InvalidArgument, format!("`{what}` is not UTF-8: {error}"))
    })
}

/// Refuses an address or a count that no array has: NULL, not aligned, or longer than memory.
fn check<T>(what: &str, first: *const T, count: usize) -> Result<(), Error> {
    let wrong = |message| Err(Error::new(MmsCode::InvalidArgument, message));
    if count == 0 {
        return Ok(());
    }
    if first.is_null() {
        return wrong(format!("`{what}` is NULL"));
    }
    if !first.is_aligned() {
        let expected = align_of::<T>();
        return wrong(format!("`{what}` is not aligned: expected a multiple of {expected} bytes"));
    }
    let bytes = count.checked_mul(size_of::<T>()).filter(|bytes| *bytes <= isize::MAX as usize);
    match bytes.and_then(|bytes| first.addr().checked_add(bytes)) {
        Some(_) => Ok(()),
        None => wrong(format!("`count` is so large that `{what}` would not fit into memory")),
    }
}

#[cfg(test)]
pub mod tests {
    use std::mem::MaybeUninit;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::ptr::null;

    use super::*;

    /// A buffer as an argument of the library.
    pub fn message(buffer: &mut [u8]) -> Message {
        // SAFETY: the buffer outlives the call.
        unsafe { Message::new(buffer.as_mut_ptr().cast(), buffer.len()) }
    }

    #[test]
    fn a_message_is_cut_between_characters() {
        for (room, expected) in [
            (0, "??????"),
            (1, "\0?????"),
            (2, "a\0????"),
            (3, "a\0????"),
            (4, "aé\0??"),
            (6, "aéb\0?"),
        ] {
            let mut buffer = *b"??????";
            message(&mut buffer[..room]).write("aéb");
            assert_eq!(buffer, *expected.as_bytes(), "{room}");
        }
        // A character of four bytes.
        for room in 1..5 {
            let mut buffer = *b"?????";
            message(&mut buffer[..room]).write("\u{1f600}");
            assert_eq!(buffer, *b"\0????", "{room}");
        }
    }

    #[test]
    fn neighbours_are_apart_and_a_byte_in_common_is_not() {
        let at = |what, start, bytes| MemoryRange { what, start, bytes };
        let own = at("values", 16, 8);
        for (start, bytes) in [(8, 8), (24, 8), (0, 1), (16, 0), (20, 0)] {
            assert_eq!(own.apart(at("points", start, bytes)), Ok(()), "{start} {bytes}");
        }
        for (start, bytes) in [(8, 9), (23, 8), (16, 8), (0, 64), (20, 1), (0, usize::MAX)] {
            let error = own.apart(at("points", start, bytes)).expect_err("a byte in common");
            assert!(error.message.starts_with("`values` overlaps with `points`"), "{error:?}");
        }
    }

    #[test]
    fn what_no_array_can_be_is_refused_before_it_is_one() {
        let numbers = [1.0_f64, 2.0];
        let first = numbers.as_ptr();
        let said =
            |first: *const f64, count| check("points", first, count).map_err(|it| it.message);
        assert_eq!(said(first, 2), Ok(()));
        assert_eq!(said(null(), 0), Ok(()));
        assert_eq!(said(null(), 1), Err("`points` is NULL".into()));
        let wrong = said(first.wrapping_byte_add(4), 1).expect_err("between two numbers");
        assert!(wrong.contains("a multiple of 8 bytes"), "{wrong}");
        let most = isize::MAX as usize / size_of::<f64>();
        for count in [most + 1, usize::MAX / 8, usize::MAX / 8 + 1, usize::MAX] {
            assert!(
                said(first, count).is_err_and(|message| message.contains("`count`")),
                "{count}"
            );
        }
        assert!(said(first.with_addr(usize::MAX - 7), 2).is_err(), "beyond the last address");
    }

    #[test]
    fn no_byte_behind_a_text_is_read() {
        let read = |bytes: &[u8], most| {
            // SAFETY: there are as many bytes as are read, which the first tests and Miri check.
            unsafe { text("name", bytes.as_ptr().cast(), most, MmsCode::UnknownName) }
                .map(String::from)
        };
        assert_eq!(read(b"bar\0", 3), Ok("bar".into()));
        assert_eq!(read(b"\0", 0), Ok(String::new()));
        let long = read(&[b'a'; 9], 8).expect_err("too long");
        assert_eq!(long.code, MmsCode::UnknownName);
        assert!(long.message.contains("more than 8 bytes"), "{long:?}");
        let wrong = read(b"ab\xc3\0", 8).expect_err("half a character");
        assert_eq!(wrong.code, MmsCode::InvalidArgument);
        assert!(wrong.message.starts_with("`name` is not UTF-8"), "{wrong:?}");
    }

    #[test]
    fn room_is_written_in_turn_and_no_further() {
        let mut values = [MaybeUninit::<f64>::uninit(); 3];
        // SAFETY: there are three.
        let room = unsafe { Writable::new("values", values.as_mut_ptr().cast::<f64>(), 3, &[]) };
        let mut room = room.expect("room");
        room.put(&[1.0]);
        room.put(&[]);
        room.put(&[2.0, 3.0]);
        assert!(catch_unwind(AssertUnwindSafe(|| room.put(&[4.0]))).is_err());
        // SAFETY: all three have been written.
        assert_eq!(values.map(|value| unsafe { value.assume_init() }), [1.0, 2.0, 3.0]);
    }
}
