//! Numbers in bytes.

use crate::{Mistake, Stored};

/// The order of the bytes in a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteOrder {
    /// The least significant byte first.
    Little,
    /// The most significant byte first.
    Big,
}

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// A floating-point number of this many bytes: 2, 4 or 8.
    Float(usize),
    /// An integer with a sign, of this many bytes: 1, 2, 4 or 8.
    Signed(usize),
    /// An integer without a sign, of this many bytes.
    Unsigned(usize),
}

impl NumberType {
    /// Parses a name of VTK in XML: `Float64`, `Int32`, `UInt8`.
    pub fn of_xml(name: &str) -> Option<NumberType> {
        let at = name.find(|it: char| it.is_ascii_digit())?;
        let bytes = match &name[at..] {
            "8" => 1,
            "16" => 2,
            "32" => 4,
            "64" => 8,
            _ => return None,
        };
        match (&name[..at], bytes) {
            ("Float", 4 | 8) => Some(NumberType::Float(bytes)),
            ("Int", _) => Some(NumberType::Signed(bytes)),
            ("UInt", _) => Some(NumberType::Unsigned(bytes)),
            _ => None,
        }
    }

    /// Parses a name of legacy VTK.
    pub fn of_legacy(name: &str) -> Option<NumberType> {
        Some(match name {
            "float" => NumberType::Float(4),
            "double" => NumberType::Float(8),
            "char" | "signed_char" => NumberType::Signed(1),
            "unsigned_char" => NumberType::Unsigned(1),
            "short" => NumberType::Signed(2),
            "unsigned_short" => NumberType::Unsigned(2),
            "int" => NumberType::Signed(4),
            "unsigned_int" => NumberType::Unsigned(4),
            "long" | "vtkidtype" | "vtktypeint64" => NumberType::Signed(8),
            "unsigned_long" | "vtktypeuint64" => NumberType::Unsigned(8),
            _ => return None,
        })
    }

    /// Parses a name of NumPy: `f8`, `i4`, `u1`.
    pub fn of_numpy(name: &str) -> Option<NumberType> {
        let (letter, bytes) = name.split_at_checked(1)?;
        let bytes = bytes.parse().ok()?;
        match (letter, bytes) {
            ("f", 2 | 4 | 8) => Some(NumberType::Float(bytes)),
            ("i", 1 | 2 | 4 | 8) => Some(NumberType::Signed(bytes)),
            ("u", 1 | 2 | 4 | 8) | ("b", 1) => Some(NumberType::Unsigned(bytes)),
            _ => None,
        }
    }

    /// The number of bytes.
    pub fn bytes(self) -> usize {
        let (NumberType::Float(bytes) | NumberType::Signed(bytes) | NumberType::Unsigned(bytes)) =
            self;
        bytes
    }

    /// The precision of the numbers.
    pub fn stored(self) -> Stored {
        match self {
            // A number of 11 bits has a smaller rounding than one of three digits.
            NumberType::Float(2) => Stored::Digits(3),
            NumberType::Float(4) => Stored::Single,
            NumberType::Float(_) => Stored::Double,
            NumberType::Signed(_) | NumberType::Unsigned(_) => Stored::Whole,
        }
    }

    /// Reads all numbers in bytes.
    pub fn read(self, bytes: &[u8], order: ByteOrder) -> Vec<f64> {
        match self {
            NumberType::Float(2) => each(bytes, order, |it| of_half(u16::from_le_bytes(it))),
            NumberType::Float(4) => each(bytes, order, |it| f64::from(f32::from_le_bytes(it))),
            NumberType::Float(_) => each(bytes, order, f64::from_le_bytes),
            NumberType::Signed(1) => each(bytes, order, |it| f64::from(i8::from_le_bytes(it))),
            NumberType::Signed(2) => each(bytes, order, |it| f64::from(i16::from_le_bytes(it))),
            NumberType::Signed(4) => each(bytes, order, |it| f64::from(i32::from_le_bytes(it))),
            NumberType::Signed(_) => each(bytes, order, |it| i64::from_le_bytes(it) as f64),
            NumberType::Unsigned(1) => each(bytes, order, |it| f64::from(u8::from_le_bytes(it))),
            NumberType::Unsigned(2) => each(bytes, order, |it| f64::from(u16::from_le_bytes(it))),
            NumberType::Unsigned(4) => each(bytes, order, |it| f64::from(u32::from_le_bytes(it))),
            NumberType::Unsigned(_) => each(bytes, order, |it| u64::from_le_bytes(it) as f64),
        }
    }
}

/// A half-precision number from its bits: a sign, five of the exponent, ten of the fraction.
fn of_half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f64::from(bits & 0x3ff));
    let size = match exponent {
        0 => fraction * 2f64.powi(-24),
        0x1f if fraction == 0.0 => f64::INFINITY,
        0x1f => f64::NAN,
        _ => (1024.0 + fraction) * 2f64.powi(exponent - 25),
    };
    if bits >> 15 == 0 { size } else { -size }
}

fn each<const N: usize>(bytes: &[u8], order: ByteOrder, read: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    let in_order = |bytes: &[u8; N]| {
        let mut bytes = *bytes;
        if order == ByteOrder::Big {
            bytes.reverse();
        }
        read(bytes)
    };
    bytes.as_chunks().0.iter().map(in_order).collect()
}

/// The number of numbers in rows; refuses a size in bytes that overflows.
pub fn count(rows: usize, components: usize, kind: NumberType) -> Result<usize, Mistake> {
    let numbers = rows.checked_mul(components).filter(|it| it.checked_mul(kind.bytes()).is_some());
    numbers.ok_or_else(|| {
        Mistake::new(format!("{rows} times {components} numbers: no file holds as many"))
    })
}

/// The number of rows that are written at a time.
const BLOCK: usize = 1024;

/// Reorders numbers whose first axis runs fastest, so that the last axis does.
pub fn by_rows(values: &[f64], shape: &[usize]) -> Vec<f64> {
    let (rows, axes) = shape.split_first().map_or((1, &[][..]), |(rows, axes)| (*rows, axes));
    // Without rows, a file may declare any number of components.
    if values.is_empty() {
        return Vec::new();
    }
    let components: usize = axes.iter().product();
    // The component of a column.
    let place = |mut column: usize| {
        let (mut place, mut stride) = (0, components);
        for &axis in axes {
            stride /= axis;
            place += stride * (column % axis);
            column /= axis;
        }
        place
    };
    let places: Vec<usize> = (0..components).map(place).collect();
    let mut numbers = vec![0.0; values.len()];
    // Rows are written block by block, so that they stay in the cache.
    for (block, to) in numbers.chunks_mut(BLOCK * components).enumerate() {
        for (column, place) in values.chunks_exact(rows).zip(&places) {
            let from = &column[block * BLOCK..];
            let to = to.chunks_exact_mut(components);
            to.zip(from).for_each(|(to, number)| to[*place] = *number);
        }
    }
    numbers
}

/// Converts numbers to positions.
pub fn positions(values: Vec<f64>) -> Result<Vec<usize>, Mistake> {
    // Beyond this, a double may differ from the stored integer.
    const MOST: f64 = (1_u64 << 53) as f64;
    let position = |value: f64| match (0.0..MOST).contains(&value) && value.fract() == 0.0 {
        true => Ok(value as usize),
        false => Err(Mistake::new(format!("expected the number of a point, found {value}"))),
    };
    values.into_iter().map(position).collect()
}
