//! Bytes of VTK in XML: raw, or in one or more segments of base64.

use std::borrow::Cow;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::super::numbers::{ByteOrder, NumberType};
use crate::Mistake;

/// Bytes that are consumed from the front.
pub enum Encoded<'a> {
    /// Raw bytes.
    Raw(&'a [u8]),
    /// Base64: the text not yet decoded, and decoded bytes not yet consumed. A padded header is followed by another segment.
    Base64(&'a [u8], Vec<u8>),
}

fn ends_early() -> Mistake {
    Mistake::new("an array ends early: the file was cut off, or its header says more than there is")
}

impl<'a> Encoded<'a> {
    /// Consumes the next bytes.
    pub fn take(&mut self, count: usize) -> Result<Cow<'a, [u8]>, Mistake> {
        match self {
            Encoded::Raw(bytes) => {
                let (taken, rest) = bytes.split_at_checked(count).ok_or_else(ends_early)?;
                *bytes = rest;
                Ok(Cow::Borrowed(taken))
            }
            Encoded::Base64(text, pending) => {
                if count > pending.len().saturating_add(text.len()) {
                    return Err(ends_early());
                }
                while pending.len() < count {
                    let quads = (count - pending.len()).div_ceil(3);
                    *text = decode(text, quads, pending)?;
                }
                let rest = pending.split_off(count);
                Ok(Cow::Owned(std::mem::replace(pending, rest)))
            }
        }
    }

    /// Consumes the next unsigned integer.
    pub fn integer(&mut self, kind: NumberType, order: ByteOrder) -> Result<usize, Mistake> {
        let values = kind.read(&self.take(kind.bytes())?, order);
        // A number that is rounded here is larger than any file.
        Ok(values[0] as usize)
    }
}

/// Decodes `quads` groups of four letters, or fewer up to the end of a segment; returns the remaining text.
fn decode<'a>(text: &'a [u8], quads: usize, bytes: &mut Vec<u8>) -> Result<&'a [u8], Mistake> {
    let end = (4 * quads).min(text.len());
    let end = match memchr::memchr(b'=', &text[..end]) {
        Some(padding) => (4 * (padding / 4 + 1)).min(text.len()),
        None => end,
    };
    if end == 0 {
        return Err(ends_early());
    }
    let decoded = STANDARD.decode_vec(&text[..end], bytes);
    decoded.map_err(|error| Mistake::new(format!("not base64: {error}")))?;
    Ok(&text[end..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_read_as_one() {
        let text = [STANDARD.encode([1, 2, 3, 4]), STANDARD.encode([5, 6, 7, 8, 9])].concat();
        for sizes in [vec![9], vec![4, 5], vec![1, 2, 3, 3]] {
            let mut encoded = Encoded::Base64(text.as_bytes(), Vec::new());
            let taken: Vec<u8> =
                sizes.iter().flat_map(|&size| encoded.take(size).unwrap().into_owned()).collect();
            assert_eq!(taken, [1, 2, 3, 4, 5, 6, 7, 8, 9]);
            assert!(encoded.take(1).is_err());
        }
    }
}
