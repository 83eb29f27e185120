//! What can go wrong, as a C program sees it.

use std::fmt::Display;

/// How a call went.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MmsCode {
    /// It did what it is for.
    Ok = 0,
    /// A pointer that is NULL or not aligned, a count that no array has, too little room, results that overlap with
    /// something, a text that is not UTF-8, a time or a point that is not finite, a normal that is missing or not a
    /// unit vector.
    InvalidArgument = 1,
    /// No field, parameter, quantity, face or bound has that name.
    UnknownName = 2,
    /// The text of a field or of its material has mistakes; the message shows each at its line and
    /// column.
    InvalidField = 3,
    /// A value that the field does not allow: outside its range, or one that leaves no body, no time
    /// window or no positive density.
    InvalidParameter = 4,
    /// A value that is not defined at a point, or is beyond the range of a double.
    NotFinite = 5,
    /// A mistake of this library.
    Defect = 6,
    /// The system gives no thread. Making a field takes one, with a stack of 2 MiB.
    NoThread = 7,
    /// Somebody requested to stop, and nothing was made.
    Stopped = 8,
}

/// Why a call did not do what it is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind.
    pub code: MmsCode,
    /// What is wrong, and what to do.
    pub message: String,
}

impl Error {
    /// An error of a kind.
    pub fn new(code: MmsCode, message: impl Display) -> Self {
        Error { code, message: message.to_string() }
    }
}
