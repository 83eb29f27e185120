//! Reads words, numbers and arrays of a file of legacy VTK from a position on.

use super::super::numbers::{ByteOrder, NumberType, count, positions};
use super::super::text::{Style, number};
use crate::wanted::Wanted;
use crate::{Array, Mistake, Stored};

/// A position in a file.
pub struct Cursor<'a> {
    pub bytes: &'a [u8],
    pub at: usize,
    pub is_binary: bool,
    pub wanted: &'a Wanted<'a>,
}

impl<'a> Cursor<'a> {
    /// A mistake at this position; in a binary file without a line number.
    pub fn mistake(&self, what: impl Into<String>) -> Mistake {
        let before = &self.bytes[..self.at.min(self.bytes.len())];
        match self.is_binary {
            true => Mistake::new(what),
            false => {
                Mistake::at(1 + memchr::memchr_iter(b'\n', before.trim_ascii_end()).count(), what)
            }
        }
    }

    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Consumes the rest of the line.
    pub fn line(&mut self) -> &'a [u8] {
        let rest = self.rest();
        let end = memchr::memchr(b'\n', rest);
        self.at += end.map_or(rest.len(), |end| end + 1);
        &rest[..end.unwrap_or(rest.len())]
    }

    /// Consumes the next word.
    pub fn word(&mut self) -> Option<&'a str> {
        let rest = self.rest();
        let start = rest.iter().position(|it| !it.is_ascii_whitespace())?;
        let length = rest[start..].iter().position(u8::is_ascii_whitespace);
        let end = length.map_or(rest.len(), |length| start + length);
        self.at += end;
        Some(std::str::from_utf8(&rest[start..end]).unwrap_or("\u{fffd}"))
    }

    pub fn needed(&mut self, what: &str) -> Result<&'a str, Mistake> {
        self.word().ok_or_else(|| Mistake::new(format!("expected {what}, and the file ends")))
    }

    pub fn words<const N: usize>(&mut self) -> Result<[&'a str; N], Mistake> {
        let mut words = [""; N];
        words.iter_mut().try_for_each(|it| {
            *it = self.needed("a number")?;
            Ok(())
        })?;
        Ok(words)
    }

    pub fn integer(&mut self) -> Result<usize, Mistake> {
        let word = self.needed("a number")?;
        word.parse().map_err(|_| Mistake::new(format!("expected a whole number, found `{word}`")))
    }

    pub fn kind(&mut self) -> Result<NumberType, Mistake> {
        let word = self.needed("a type")?;
        let kind = NumberType::of_legacy(&word.to_ascii_lowercase());
        kind.ok_or_else(|| Mistake::new(format!("expected a type such as double, found `{word}`")))
    }

    /// Consumes an array of numbers.
    pub fn array(
        &mut self,
        name: &str,
        rows: usize,
        components: usize,
        kind: NumberType,
    ) -> Result<Array, Mistake> {
        let numbers = count(rows, components.max(1), kind)?;
        // A number has at least one byte, and a separator.
        self.wanted.reserve(&format!("`{name}`"), numbers.min(self.rest().len()))?;
        let (values, stored) = match self.is_binary {
            true => (self.binary(numbers, kind)?, kind.stored()),
            false => self.ascii(numbers, kind)?,
        };
        Ok(Array {
            name: name.to_owned(),
            components: components.max(1),
            values,
            stored,
            ..Array::default()
        })
    }

    pub fn binary(&mut self, numbers: usize, kind: NumberType) -> Result<Vec<f64>, Mistake> {
        Ok(kind.read(self.bytes_of(numbers, kind)?, ByteOrder::Big))
    }

    pub fn bytes_of(&mut self, numbers: usize, kind: NumberType) -> Result<&'a [u8], Mistake> {
        self.line();
        let bytes = self.rest().get(..numbers * kind.bytes());
        let bytes =
            bytes.ok_or_else(|| Mistake::new("the file ends within an array: it was cut off"))?;
        self.at += bytes.len();
        Ok(bytes)
    }

    /// Skips an array that is not read.
    pub fn pass(
        &mut self,
        rows: usize,
        components: usize,
        kind: NumberType,
    ) -> Result<(), Mistake> {
        let numbers = count(rows, components.max(1), kind)?;
        match self.is_binary {
            true => self.bytes_of(numbers, kind).map(drop),
            false => (0..numbers).try_for_each(|_| self.needed("a number").map(drop)),
        }
    }

    pub fn ascii(
        &mut self,
        numbers: usize,
        kind: NumberType,
    ) -> Result<(Vec<f64>, Stored), Mistake> {
        let mut style = Style::default();
        let mut values = Vec::new();
        for _ in 0..numbers {
            let word = self.needed("a number")?;
            let value = number(word);
            style.see(word);
            values.push(
                value.ok_or_else(|| Mistake::new(format!("expected a number, found `{word}`")))?,
            );
        }
        Ok((values, if kind.stored() == Stored::Whole { Stored::Whole } else { style.stored() }))
    }

    /// Skips words or bits, if the array has this type: eight bits in a byte, one word on each line, or each word after its
    /// length, whose first two bits give the number of bytes of that length.
    pub fn passes_words(&mut self, words: usize) -> Result<bool, Mistake> {
        let before = self.at;
        match self.word() {
            Some("string") => {}
            Some("bit") if self.is_binary => {
                return self.bytes_of(words.div_ceil(8), NumberType::Unsigned(1)).map(|_| true);
            }
            Some("bit") => return self.pass(words, 1, NumberType::Unsigned(1)).map(|()| true),
            _ => {
                self.at = before;
                return Ok(false);
            }
        }
        self.line();
        for _ in 0..words {
            let Some(&first) = self.rest().first() else {
                return Err(Mistake::new("the file ends within an array: it was cut off"));
            };
            if !self.is_binary {
                self.line();
                continue;
            }
            let bytes = 1 << (3 - (first >> 6));
            let head = self.rest().iter().take(bytes).enumerate();
            let value =
                |(at, &byte): (usize, &u8)| usize::from(if at == 0 { byte & 63 } else { byte });
            let length = head.map(value).fold(0, |all: usize, byte| all.wrapping_mul(256) + byte);
            self.at = self.bytes.len().min(self.at.saturating_add(bytes).saturating_add(length));
        }
        Ok(true)
    }

    pub fn positions(&mut self, numbers: usize, kind: NumberType) -> Result<Vec<usize>, Mistake> {
        positions(self.array("", numbers, 1, kind)?.values)
    }

    /// Reads the ends and points of cells: since version 5.1 two arrays, before with the number of points before each cell.
    pub fn lists(&mut self) -> Result<(Vec<usize>, Vec<usize>), Mistake> {
        let (first, second) = (self.integer()?, self.integer()?);
        let before = self.at;
        if self.word() == Some("OFFSETS") {
            let kind = self.kind()?;
            let offsets = self.positions(first, kind)?;
            self.needed("CONNECTIVITY")?;
            let kind = self.kind()?;
            return Ok((offsets.into_iter().skip(1).collect(), self.positions(second, kind)?));
        }
        self.at = before;
        counted(first, &self.positions(second, NumberType::Signed(4))?)
    }
}

/// A name with its separators decoded from `%20` and similar codes.
pub fn decoded(name: &str) -> String {
    let bytes = name.as_bytes();
    let mut all = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let code = bytes.get(at + 1..at + 3).and_then(|it| std::str::from_utf8(it).ok());
        let code = code.and_then(|it| u8::from_str_radix(it, 16).ok());
        match code.filter(|_| bytes[at] == b'%') {
            Some(byte) => {
                all.push(byte);
                at += 3;
            }
            None => {
                all.push(bytes[at]);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&all).into_owned()
}

/// Reads cells with the number of points before each.
fn counted(cells: usize, all: &[usize]) -> Result<(Vec<usize>, Vec<usize>), Mistake> {
    let (mut ends, mut points, mut rest) = (Vec::new(), Vec::new(), all);
    while let Some((&count, tail)) = rest.split_first() {
        let cell = tail.get(..count);
        let cell =
            cell.ok_or_else(|| Mistake::new("the last cell has fewer points than it says"))?;
        points.extend(cell);
        ends.push(points.len());
        rest = &tail[count..];
    }
    match ends.len() == cells {
        true => Ok((ends, points)),
        false => Err(Mistake::new(format!("{} cells, and expected {cells}", ends.len()))),
    }
}
