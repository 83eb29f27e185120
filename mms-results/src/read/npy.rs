//! An array of NumPy: "NEP 1, a simple file format for NumPy arrays".

use super::numbers::{Kind, Order, count};
use crate::{Array, Mistake, Snapshot};

/// How a file begins.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// What the header says.
struct Header {
    kind: Kind,
    order: Order,
    is_fortran: bool,
    shape: Vec<usize>,
}

/// Reads a file of one array, which is called `array`.
pub fn parse(bytes: &[u8]) -> Result<Snapshot, Mistake> {
    let array = array("array", bytes)?;
    Ok(Snapshot { of_points: vec![array], ..Snapshot::default() })
}

/// Reads an array. Its first axis are the points; one number is one point.
pub fn array(name: &str, bytes: &[u8]) -> Result<Array, Mistake> {
    let wrong =
        |mistake: Mistake| Mistake { what: format!("`{name}`: {}", mistake.what), ..mistake };
    let (text, data) =
        split(bytes).ok_or_else(|| wrong(Mistake::new("the file ends within its header")))?;
    let header = header(text).map_err(wrong)?;
    let rows = header.shape.first().copied().unwrap_or(1);
    let components =
        header.shape.iter().skip(1).try_fold(1, |all: usize, &axis| all.checked_mul(axis));
    let components =
        components.ok_or_else(|| wrong(Mistake::new("no array is as large as it says")))?;
    let numbers = count(rows, components, header.kind).map_err(wrong)?;
    if data.len() != numbers * header.kind.bytes() {
        let what = format!(
            "{} bytes of numbers, and its shape needs {}",
            data.len(),
            numbers * header.kind.bytes()
        );
        return Err(wrong(Mistake::new(what)));
    }
    let mut values = header.kind.read(data, header.order);
    if header.is_fortran {
        values = by_rows(&values, &header.shape);
    }
    let stored = header.kind.stored();
    Ok(Array { name: name.to_owned(), components: components.max(1), values, stored })
}

/// Whether an array holds words, as bytes or in Unicode.
pub fn are_words(bytes: &[u8]) -> bool {
    let described = split(bytes).and_then(|(text, _)| behind(text, "descr").ok());
    described.is_some_and(|it| it.starts_with("'|S") || it.starts_with("'<U"))
}

/// The header and the numbers.
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

/// What stands behind a key.
fn behind<'a>(text: &'a str, key: &str) -> Result<&'a str, Mistake> {
    let found = text.split_once(&format!("'{key}':"));
    found
        .map(|it| it.1.trim_start())
        .ok_or_else(|| Mistake::new(format!("its header has no `{key}`")))
}

fn header(text: &str) -> Result<Header, Mistake> {
    let described = behind(text, "descr")?;
    let name = described.strip_prefix('\'').and_then(|it| it.split_once('\'')).map(|it| it.0);
    let name = name.ok_or_else(|| {
        Mistake::new(
            "a structured array is not read; save its fields as arrays, with `numpy.savez`",
        )
    })?;
    let (order, kind) = match name.split_at_checked(1) {
        Some((">", kind)) => (Order::Big, kind),
        Some(("<" | "|" | "=", kind)) => (Order::Little, kind),
        _ => (Order::Little, name),
    };
    let kind = Kind::of_numpy(kind).ok_or_else(|| {
        Mistake::new(format!(
            "numbers of type `{name}` are not read; expected floating-point numbers or integers"
        ))
    })?;
    let shape = behind(text, "shape")?;
    let shape = shape.strip_prefix('(').and_then(|it| it.split_once(')')).map(|it| it.0);
    let axis = |text: &str| {
        let wrong = || Mistake::new(format!("its shape has `{text}`, which is no length"));
        text.trim().parse::<usize>().map_err(|_| wrong())
    };
    let shape = shape.ok_or_else(|| Mistake::new("its header has no shape in parentheses"))?;
    let shape = shape.split(',').filter(|it| !it.trim().is_empty()).map(axis);
    Ok(Header {
        kind,
        order,
        is_fortran: behind(text, "fortran_order")?.starts_with("True"),
        shape: shape.collect::<Result<_, _>>()?,
    })
}

/// Numbers whose first axis runs fastest, as numbers whose last axis does.
fn by_rows(values: &[f64], shape: &[usize]) -> Vec<f64> {
    let place = |mut index: usize| {
        let mut place = 0;
        let mut stride = values.len();
        for &axis in shape.iter().rev() {
            stride /= axis;
            place += stride * (index % axis);
            index /= axis;
        }
        place
    };
    (0..values.len()).map(|index| values[place(index)]).collect()
}
