//! The filter LZF, which h5py registers as number 32000: runs of letters, and copies of what came before.

/// The number of the filter.
pub const NUMBER: u16 = 32_000;

/// Unpacks bytes into at most `most`.
pub fn unpack(packed: &[u8], most: usize) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(most.min(packed.len().saturating_mul(4)));
    let mut rest = packed.iter().copied();
    while let Some(control) = rest.next() {
        let control = usize::from(control);
        if control < 32 {
            for _ in 0..=control {
                bytes.push(rest.next()?);
            }
        } else {
            let mut length = control >> 5;
            if length == 7 {
                length += usize::from(rest.next()?);
            }
            let back = ((control & 31) << 8) + usize::from(rest.next()?) + 1;
            let start = bytes.len().checked_sub(back)?;
            for at in start..start + length + 2 {
                bytes.push(bytes[at]);
            }
        }
        if bytes.len() > most {
            return None;
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_and_copies_are_unpacked() {
        // Two letters, four copies of the pair, and five bytes of one letter.
        let packed = [1, b'a', b'b', (6 << 5), 1, 0, b'c', (2 << 5), 0];
        assert_eq!(unpack(&packed, 100).as_deref(), Some(&b"ababababab\x63\x63\x63\x63\x63"[..]));
        assert_eq!(unpack(&packed, 14), None);
        for cut in [1, 2, 4, 8] {
            assert_eq!(unpack(&packed[..cut], 100), None, "{cut}");
        }
        assert_eq!(unpack(&[32, 9], 100), None);
    }
}
