//! The errors of the interface.

use std::fmt::Display;

/// The result of a call.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MmsCode {
    /// The call succeeded.
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
    /// A value that the field does not allow: outside its range, or one for which there is no body, no time window or no
    /// positive density.
    InvalidParameter = 4,
    /// A value that is not defined at a point, or is beyond the range of a double.
    NotFinite = 5,
    /// A defect of this library.
    Defect = 6,
    /// The system provides no thread. Making a field needs one, with a stack of 2 MiB.
    NoThread = 7,
    /// A stop was requested, and nothing was made.
    Stopped = 8,
}

/// The reason why a call failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind.
    pub code: MmsCode,
    /// The mistake, and advice.
    pub message: String,
}

impl Error {
    /// An error of a kind.
    pub fn new(code: MmsCode, message: impl Display) -> Self {
        Error { code, message: message.to_string() }
    }
}
