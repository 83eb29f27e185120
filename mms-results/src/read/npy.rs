//! An array of NumPy: "NEP 1, a simple file format for NumPy arrays".

use super::numbers::{ByteOrder, NumberType, by_rows, count};
use crate::wanted::Wanted;
use crate::{Array, Mistake, Snapshot};

/// The beginning of a file.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// The header of an array.
pub struct Head {
    /// The bytes of the header, including those before it.
    bytes: usize,
    kind: NumberType,
    order: ByteOrder,
    is_fortran: bool,
    shape: Vec<usize>,
    /// The number of numbers.
    numbers: usize,
}

impl Head {
    /// Reads the header at the front of bytes.
    pub fn of(bytes: &[u8]) -> Result<Self, Mistake> {
        let (text, data) =
            split(bytes).ok_or_else(|| Mistake::new("the file ends within its header"))?;
        let (kind, order, is_fortran, shape) = header(text)?;
        let rows = shape.first().copied().unwrap_or(1);
        let axes = shape.iter().skip(1).try_fold(1, |all: usize, &axis| all.checked_mul(axis));
        let axes = axes.ok_or_else(|| Mistake::new("no array is as large as it says"))?;
        let numbers = count(rows, axes, kind)?;
        Ok(Head { bytes: bytes.len() - data.len(), kind, order, is_fortran, shape, numbers })
    }

    /// The number of bytes of the array, with its header.
    pub fn length(&self) -> u64 {
        self.bytes as u64 + (self.numbers * self.kind.bytes()) as u64
    }

    /// The length of each axis.
    pub fn into_shape(self) -> Vec<usize> {
        self.shape
    }

    /// The number of numbers.
    pub fn numbers(&self) -> usize {
        self.numbers
    }
}

/// Reads a file of one array, which is called `array`.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    let numbers = Head::of(bytes).map_or(0, |head| head.numbers());
    wanted.reserve("`array`", numbers.min(bytes.len()))?;
    let array = array("array", bytes)?;
    let names = wanted.columns();
    if names.is_empty() {
        return Ok(Snapshot { of_points: vec![array], ..Snapshot::default() });
    }
    if names.len() != array.components {
        let (given, found) = (names.len(), array.components);
        return Err(Mistake::new(format!("`--columns`: {given} names for {found} columns")));
    }
    let column = |(at, name): (usize, &String)| Array {
        name: name.clone(),
        values: array.values.iter().skip(at).step_by(names.len()).copied().collect(),
        stored: array.stored,
        ..Array::default()
    };
    Ok(Snapshot {
        of_points: names.iter().enumerate().map(column).collect(),
        ..Snapshot::default()
    })
}

/// Reads an array. Its first axis is the points; one number is one point.
pub fn array(name: &str, bytes: &[u8]) -> Result<Array, Mistake> {
    let wrong =
        |mistake: Mistake| Mistake { what: format!("`{name}`: {}", mistake.what), ..mistake };
    let head = Head::of(bytes).map_err(wrong)?;
    let (data, needed) = (&bytes[head.bytes..], head.numbers * head.kind.bytes());
    if data.len() != needed {
        let what = format!("{} bytes of numbers, and its shape needs {needed}", data.len());
        return Err(wrong(Mistake::new(what)));
    }
    let mut values = head.kind.read(data, head.order);
    if head.is_fortran {
        values = by_rows(&values, &head.shape);
    }
    let components = head.shape.iter().skip(1).product::<usize>().max(1);
    Ok(Array {
        name: name.to_owned(),
        components,
        values,
        stored: head.kind.stored(),
        ..Array::default()
    })
}

/// Whether an array contains unsupported data: words, objects, structures, complex numbers.
pub fn has_no_numbers(bytes: &[u8]) -> bool {
    let described = split(bytes).and_then(|(text, _)| behind(text, "descr").ok());
    described.is_some_and(|it| numbers(it).is_err())
}

/// Splits a file into header and numbers.
fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (version, rest) = rest.split_at_checked(2)?;
    let (length, rest) = match version[0] {
        1 => {
            let (length, rest) = rest.split_first_chunk::<2>()?;
            (usize::from(u16::from_le_bytes(*length)), rest)
        }
        _ => {
            let (length, rest) = rest.split_first_chunk::<4>()?;
            (u32::from_le_bytes(*length) as usize, rest)
        }
    };
    let (header, data) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, data))
}

/// The text after a key.
fn behind<'a>(text: &'a str, key: &str) -> Result<&'a str, Mistake> {
    let found = text.split_once(&format!("'{key}':"));
    found
        .map(|it| it.1.trim_start())
        .ok_or_else(|| Mistake::new(format!("its header has no `{key}`")))
}

/// The type and the byte order of numbers, from their description.
fn numbers(described: &str) -> Result<(NumberType, ByteOrder), Mistake> {
    let name = described.strip_prefix('\'').and_then(|it| it.split_once('\'')).map(|it| it.0);
    let name = name.ok_or_else(|| {
        Mistake::new(
            "a structured array is not read; save its fields as arrays, with `numpy.savez`",
        )
    })?;
    let (order, kind) = match name.split_at_checked(1) {
        Some((">", kind)) => (ByteOrder::Big, kind),
        Some(("<" | "|" | "=", kind)) => (ByteOrder::Little, kind),
        _ => (ByteOrder::Little, name),
    };
    let advice = match kind.as_bytes() {
        [b'c', ..] => "; of complex numbers save the real part",
        [b'f', ..] => "; `longdouble` differs between machines, save `astype(float)`",
        [b'O', ..] => "; of objects save an array of numbers each",
        _ => "",
    };
    let kind = NumberType::of_numpy(kind).ok_or_else(|| {
        Mistake::new(format!(
            "numbers of type `{name}` are not read; expected floating-point numbers or integers{advice}"
        ))
    })?;
    Ok((kind, order))
}

/// The type of numbers, their byte order, whether the first axis runs fastest, and the shape.
fn header(text: &str) -> Result<(NumberType, ByteOrder, bool, Vec<usize>), Mistake> {
    let (kind, order) = numbers(behind(text, "descr")?)?;
    let shape = behind(text, "shape")?;
    let shape = shape.strip_prefix('(').and_then(|it| it.split_once(')')).map(|it| it.0);
    let axis = |text: &str| {
        let wrong = || Mistake::new(format!("its shape has `{text}`, which is no length"));
        text.trim().parse::<usize>().map_err(|_| wrong())
    };
    let shape = shape.ok_or_else(|| Mistake::new("its header has no shape in parentheses"))?;
    let shape = shape.split(',').filter(|it| !it.trim().is_empty()).map(axis);
    let is_fortran = behind(text, "fortran_order")?.starts_with("True");
    Ok((kind, order, is_fortran, shape.collect::<Result<_, _>>()?))
}
