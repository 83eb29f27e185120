//! The font of figures: the widths of its texts, and the codes of its characters in a PDF file.
//!
//! Every reader of PDF has Helvetica and Symbol; in SVG files Arial, of the same widths, may replace Helvetica.

/// The widths of the characters from the blank to the tilde, in thousandths of the size of the font.
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// The width of a character that the table lacks.
const OTHER: u16 = 556;

/// The width of a text in a font of size 1.
pub fn width(text: &str) -> f64 {
    let of = |c: char| {
        let place = (c as usize).checked_sub(' ' as usize);
        place.and_then(|it| WIDTHS.get(it)).copied().unwrap_or(OTHER)
    };
    text.chars().map(|c| f64::from(of(c)) / 1000.0).sum()
}

/// A font of a PDF file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Font {
    /// Helvetica, in the encoding WinAnsi.
    Letters,
    /// Symbol, in its own encoding.
    Symbols,
}

/// The characters of Symbol that figures use, each with its code.
const SYMBOLS: [(&str, u8); 4] =
    [("αβχδεφγηι", b'a'), ("κλμνοπθρστυ", b'k'), ("ωξψζ", b'w'), ("∞", 0xa5)];

/// The characters of WinAnsi beyond Latin 1, with their codes; a minus is as long as a dash.
const PUNCTUATION: [(char, u8); 9] = [
    ('\u{2026}', 0x85),
    ('\u{2018}', 0x91),
    ('\u{2019}', 0x92),
    ('\u{201c}', 0x93),
    ('\u{201d}', 0x94),
    ('\u{2022}', 0x95),
    ('\u{2013}', 0x96),
    ('\u{2212}', 0x96),
    ('\u{2014}', 0x97),
];

/// The font that has a character, and its code there; a question mark if none has it.
pub fn code(c: char) -> (Font, u8) {
    let letter = match c {
        ' '..='~' | '\u{a0}'..='\u{ff}' => u8::try_from(u32::from(c)).ok(),
        _ => PUNCTUATION.iter().find(|(own, _)| *own == c).map(|(_, code)| *code),
    };
    let symbol = || {
        SYMBOLS.iter().find_map(|(row, first)| {
            let place = row.chars().position(|own| own == c)?;
            Some(first + u8::try_from(place).ok()?)
        })
    };
    match letter {
        Some(letter) => (Font::Letters, letter),
        None => symbol().map_or((Font::Letters, b'?'), |symbol| (Font::Symbols, symbol)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_have_their_codes_and_widths() {
        let codes = ['e', '×', '²', '−', 'μ', 'λ', 'ω', '∞', '漢'].map(code);
        let letters = |code| (Font::Letters, code);
        let symbols = |code| (Font::Symbols, code);
        assert_eq!(
            codes,
            [
                letters(b'e'),
                letters(0xd7),
                letters(0xb2),
                letters(0x96),
                symbols(b'm'),
                symbols(b'l'),
                symbols(b'w'),
                symbols(0xa5),
                letters(b'?')
            ]
        );
        assert!((width("cell size h") - 4.39).abs() < 1e-9, "{}", width("cell size h"));
    }
}
