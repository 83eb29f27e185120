//! Variables of MATLAB and Octave, of versions 4, 6 and 7 ("MAT-File Format", The MathWorks). Version 7.3 is HDF5.

use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use super::npz::{HEAD, RATIO};
use super::numbers::{ByteOrder, NumberType, by_rows, count};
use super::table::is_time;
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Stored};

/// The beginning of a file of version 6 or 7.
pub const MAGIC: &[u8] = b"MATLAB 5.0 MAT-file";

/// The bytes of a file before its first variable.
const HEADER: usize = 128;

/// The kind of an element that is a variable.
const MATRIX: u32 = 14;
/// The kind of an element that is a packed variable.
const PACKED: u32 = 15;

/// The class of structures.
const STRUCTURE: u32 = 2;
/// The classes of numbers.
const NUMBERS: std::ops::RangeInclusive<u32> = 6..=15;
/// The names of the classes from 1 on, which contain no numbers.
const CLASSES: [&str; 5] = ["cell", "struct", "object", "char", "sparse"];

/// The flag of complex numbers.
const COMPLEX: u32 = 0x800;

/// The most axes and fields of a variable.
const MOST: usize = 1000;

fn cut(name: &str) -> Mistake {
    Mistake::new(format!("the file ends within {name}: was it cut off? copy or write it again"))
}

/// Reads the wanted variables; variables in a structure are called `structure.field`.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    let header = bytes.get(..HEADER).ok_or_else(|| cut("its header"))?;
    let order = match &header[HEADER - 2..] {
        b"IM" => ByteOrder::Little,
        b"MI" => ByteOrder::Big,
        _ => return Err(Mistake::new("its header does not say which byte of a number is first")),
    };
    let mut snapshot = Snapshot::default();
    let mut rest = &bytes[HEADER..];
    while !rest.is_empty() {
        let element = Element::first(rest, order).ok_or_else(|| cut("a variable"))?;
        let (own, after) = match element.kind {
            // Packed elements follow each other without padding.
            PACKED => element.split(rest, 1),
            _ => element.split(rest, 8),
        }
        .ok_or_else(|| {
            let matrix = (element.kind == MATRIX).then(|| Matrix::of(element.data(rest), order));
            matrix.and_then(Result::ok).map_or(cut("a variable"), |it| cut(&it.called()))
        })?;
        match element.kind {
            PACKED => packed(own, order, &mut snapshot, wanted)?,
            MATRIX => {
                let matrix = Matrix::of(own, order)?;
                if matrix.is_read(&matrix.name, &mut snapshot, wanted)? {
                    matrix.take_room(0, wanted)?;
                    matrix.read(&matrix.name, &mut snapshot, wanted)?;
                }
            }
            other => {
                let what =
                    format!("an element of kind {other}; expected variables: is it damaged?");
                return Err(Mistake::new(what));
            }
        }
        rest = after;
    }
    Ok(snapshot)
}

/// Reads a packed variable. Unpacks it only if it is wanted, and only to its declared size.
fn packed(
    data: &[u8],
    order: ByteOrder,
    snapshot: &mut Snapshot,
    wanted: &Wanted<'_>,
) -> Result<(), Mistake> {
    let head = decompress_to_vec_zlib_with_limit(data, HEAD).unwrap_or_else(|error| error.output);
    let element = Element::first(&head, order).filter(|it| it.kind == MATRIX);
    let element = element
        .ok_or_else(|| Mistake::new("a packed element that is no variable: is it damaged?"))?;
    let matrix = Matrix::of(element.data(&head), order)?;
    if !matrix.is_read(&matrix.name, snapshot, wanted)? {
        return Ok(());
    }
    let length = element.start + element.length;
    if length as u64 > RATIO * data.len() as u64 {
        let what =
            format!("{} says it has {length} bytes, and is too short for these", matrix.called());
        return Err(Mistake::new(what));
    }
    matrix.take_room(element.length, wanted)?;
    let whole = decompress_to_vec_zlib_with_limit(data, length).map_err(|error| {
        Mistake::new(format!("{}: not what its header says: {error}", matrix.called()))
    })?;
    let own = whole.get(element.start..length).ok_or_else(|| cut(&matrix.called()))?;
    let matrix = Matrix::of(own, order)?;
    matrix.read(&matrix.name, snapshot, wanted)
}

/// The head of an element.
struct Element {
    kind: u32,
    /// The beginning of its data.
    start: usize,
    /// The declared number of bytes of data.
    length: usize,
}

impl Element {
    /// The head of the first element; `None` if it is cut off.
    fn first(bytes: &[u8], order: ByteOrder) -> Option<Self> {
        let word = whole(bytes, order)?;
        // A short element has its length beside its kind, and at most four bytes of data.
        if word >> 16 != 0 {
            let length = (word >> 16) as usize;
            return (length <= 4).then_some(Element { kind: word & 0xffff, start: 4, length });
        }
        let length = whole(bytes.get(4..)?, order)? as usize;
        Some(Element { kind: word, start: 8, length })
    }

    /// The data of the element, as far as they exist.
    fn data<'a>(&self, bytes: &'a [u8]) -> &'a [u8] {
        let data = bytes.get(self.start..).unwrap_or_default();
        &data[..data.len().min(self.length)]
    }

    /// The data of the element, and the bytes after it and its padding to `filled` bytes; `None` if it is cut off.
    fn split<'a>(&self, bytes: &'a [u8], filled: usize) -> Option<(&'a [u8], &'a [u8])> {
        let end = self.start.checked_add(self.length)?;
        let data = bytes.get(self.start..end)?;
        let after = if self.start == 4 { 8 } else { end.checked_next_multiple_of(filled)? };
        Some((data, bytes.get(after..).unwrap_or_default()))
    }
}

/// Reads a number of four bytes.
fn whole(bytes: &[u8], order: ByteOrder) -> Option<u32> {
    let bytes = *bytes.first_chunk::<4>()?;
    Some(match order {
        ByteOrder::Little => u32::from_le_bytes(bytes),
        ByteOrder::Big => u32::from_be_bytes(bytes),
    })
}

/// A variable.
struct Matrix<'a> {
    order: ByteOrder,
    class: u32,
    is_complex: bool,
    shape: Vec<usize>,
    name: String,
    /// The elements after the name.
    rest: &'a [u8],
}

impl<'a> Matrix<'a> {
    /// The head of a variable.
    fn of(bytes: &'a [u8], order: ByteOrder) -> Result<Self, Mistake> {
        let next = |bytes: &'a [u8]| Element::first(bytes, order)?.split(bytes, 8);
        let found = (|| {
            let (flags, rest) = next(bytes)?;
            let (axes, rest) = next(rest)?;
            let (name, rest) = next(rest)?;
            Some((whole(flags, order)?, axes, String::from_utf8_lossy(name).into_owned(), rest))
        })();
        let (flags, axes, name, rest) = found.ok_or_else(|| cut("a variable"))?;
        let axes = axes.as_chunks::<4>().0.iter().filter_map(|it| whole(it, order));
        let shape: Vec<usize> = axes.take(MOST).map(|it| it as usize).collect();
        let (class, is_complex) = (flags & 0xff, flags & COMPLEX != 0);
        Ok(Matrix { order, class, is_complex, shape, name, rest })
    }

    fn called(&self) -> String {
        if self.name.is_empty() { "a variable".into() } else { format!("`{}`", self.name) }
    }

    /// The kind of the variable's numbers, their count, and their element.
    fn numbers(&self) -> Result<(NumberType, usize, Element), String> {
        let Some(element) = Element::first(self.rest, self.order) else {
            return Err("the file ends before its numbers".into());
        };
        let kind = kind(element.kind).ok_or("its numbers are of a kind that is not known")?;
        let all = self.shape.iter().try_fold(1, |all: usize, &it| all.checked_mul(it));
        let all = all.and_then(|it| count(it, 1, kind).ok()).ok_or("no file holds as many")?;
        if all * kind.bytes() != element.length {
            let needed = all * kind.bytes();
            return Err(format!("{} bytes of numbers, and its axes need {needed}", element.length));
        }
        Ok((kind, all, element))
    }

    /// The names of the fields, if the variable is one structure, and the bytes after them.
    fn fields(&self) -> Option<(Vec<String>, &'a [u8])> {
        if self.class != STRUCTURE || self.shape.iter().any(|it| *it != 1) {
            return None;
        }
        let (width, rest) = Element::first(self.rest, self.order)?.split(self.rest, 8)?;
        let width = whole(width, self.order).filter(|it| (1..=256).contains(it))?;
        let (names, rest) = Element::first(rest, self.order)?.split(rest, 8)?;
        let name = |name: &[u8]| {
            let name = name.split(|it| *it == 0).next().unwrap_or_default();
            format!("{}.{}", self.name, String::from_utf8_lossy(name))
        };
        let names = names.chunks_exact(width as usize).take(MOST).map(name);
        Some((names.collect(), rest))
    }

    /// Whether the variable, or a field of it, is read; if not, its name is kept.
    ///
    /// # Errors
    /// A variable that must contain numbers, and does not.
    fn is_read(
        &self,
        name: &str,
        snapshot: &mut Snapshot,
        wanted: &Wanted<'_>,
    ) -> Result<bool, Mistake> {
        if let Some((fields, _)) = self.fields() {
            let is_read = fields.iter().any(|field| wanted.reads(field));
            if !is_read {
                snapshot.unread.extend(fields);
            }
            return Ok(is_read);
        }
        let what = match self.class {
            _ if !is_time(name) && !wanted.reads(name) => None,
            class if !NUMBERS.contains(&class) => {
                let class = class.checked_sub(1).and_then(|it| CLASSES.get(it as usize));
                Some(format!("of class {}", class.unwrap_or(&"that is not known")))
            }
            _ if self.is_complex => Some("of complex numbers".into()),
            _ if self.shape.contains(&0) => Some("empty".into()),
            _ => return Ok(true),
        };
        snapshot.unread.push(name.to_owned());
        match what {
            Some(what) if wanted.need(name) == Need::Must => Err(Mistake::new(format!(
                "`{name}`: the variable is {what}; expected an array of real numbers"
            ))),
            _ => Ok(false),
        }
    }

    /// Reserves memory for the data that are read, and for `bytes` unpacked bytes.
    fn take_room(&self, bytes: usize, wanted: &Wanted<'_>) -> Result<(), Mistake> {
        if self.class == STRUCTURE {
            return wanted.reserve(&self.called(), bytes / 8);
        }
        let numbers = self.numbers().map_err(|what| self.wrong(&self.name, what))?;
        let start = numbers.2.start + numbers.2.length + 8;
        let behind = bytes.saturating_sub(start);
        if behind > HEAD {
            return Err(self.wrong(&self.name, format!("{behind} bytes behind its numbers")));
        }
        wanted.reserve(&self.called(), numbers.1)
    }

    /// Reads the numbers of the variable, or of its fields.
    fn read(
        &self,
        name: &str,
        snapshot: &mut Snapshot,
        wanted: &Wanted<'_>,
    ) -> Result<(), Mistake> {
        let Some((fields, mut rest)) = self.fields() else {
            let array = self.array(name)?;
            snapshot.take(array);
            return Ok(());
        };
        for field in fields {
            let (own, after) = Element::first(rest, self.order)
                .filter(|it| it.kind == MATRIX)
                .and_then(|it| it.split(rest, 8))
                .ok_or_else(|| cut(&format!("`{field}`")))?;
            rest = after;
            // An empty field has no head.
            if own.is_empty() {
                snapshot.unread.push(field);
                continue;
            }
            let matrix = Matrix::of(own, self.order)?;
            if matrix.class == STRUCTURE {
                snapshot.unread.push(field);
            } else if matrix.is_read(&field, snapshot, wanted)? {
                matrix.take_room(0, wanted)?;
                matrix.read(&field, snapshot, wanted)?;
            }
        }
        Ok(())
    }

    fn array(&self, name: &str) -> Result<Array, Mistake> {
        let (kind, _, element) = self.numbers().map_err(|what| self.wrong(name, what))?;
        let (data, _) = element.split(self.rest, 8).ok_or_else(|| cut(&format!("`{name}`")))?;
        let values = kind.read(data, self.order);
        // Whole numbers are stored in few bytes in any class.
        let stored = match self.class {
            6 => Stored::Double,
            7 => Stored::Single,
            _ => Stored::Whole,
        };
        Ok(of_columns(name, values, &self.shape, stored))
    }

    fn wrong(&self, name: &str, what: String) -> Mistake {
        Mistake::new(format!("`{name}`: {what}"))
    }
}

/// Makes an array of points from numbers column by column. One row of numbers is stored as a vector, and so becomes a list.
fn of_columns(name: &str, values: Vec<f64>, shape: &[usize], stored: Stored) -> Array {
    let is_list = shape.iter().filter(|it| **it != 1).count() <= 1;
    let components = if is_list { 1 } else { shape.iter().skip(1).product::<usize>().max(1) };
    let values = if components == 1 { values } else { by_rows(&values, shape) };
    Array { name: name.to_owned(), components, values, stored, ..Array::default() }
}

/// The head of a variable of version 4: five numbers before its name.
struct Old {
    order: ByteOrder,
    kind: NumberType,
    /// Whether it contains numbers, and all of them.
    is_full: bool,
    is_complex: bool,
    shape: [usize; 2],
    name: usize,
}

impl Old {
    const BYTES: usize = 20;

    /// The most letters of a name.
    const LETTERS: u32 = 256;

    /// The head of a variable; `None` if these bytes are no head.
    fn first(bytes: &[u8]) -> Option<Self> {
        let order = if whole(bytes, ByteOrder::Little)? < 1000 {
            ByteOrder::Little
        } else {
            ByteOrder::Big
        };
        let mut words =
            bytes.get(..Old::BYTES)?.as_chunks::<4>().0.iter().map(|it| whole(it, order));
        let [kind, rows, columns, imaginary, name] =
            std::array::from_fn(|_| words.next().flatten());
        let kind = kind?.checked_sub(if order == ByteOrder::Big { 1000 } else { 0 })?;
        let (form, kind) = (kind % 10, kind / 10);
        let kind = match kind {
            0 => NumberType::Float(8),
            1 => NumberType::Float(4),
            2 => NumberType::Signed(4),
            3 => NumberType::Signed(2),
            4 => NumberType::Unsigned(2),
            5 => NumberType::Unsigned(1),
            _ => return None,
        };
        let name = name.filter(|it| (2..Old::LETTERS).contains(it))? as usize;
        let (is_complex, is_full) = (imaginary? == 1, form == 0);
        let is_known = imaginary? < 2 && form < 3;
        let shape = [rows? as usize, columns? as usize];
        is_known.then_some(Old { order, kind, is_full, is_complex, shape, name })
    }

    /// The name after the head; `None` if it is no terminated text.
    fn name(&self, bytes: &[u8]) -> Option<String> {
        let name = bytes.get(Old::BYTES..Old::BYTES + self.name)?.strip_suffix(&[0])?;
        let is_name = name.iter().all(|it| it.is_ascii_alphanumeric() || *it == b'_');
        is_name.then(|| String::from_utf8_lossy(name).into_owned())
    }
}

/// Whether bytes begin like a file of version 4, which has no mark.
pub fn is_version_4(bytes: &[u8]) -> bool {
    Old::first(bytes).is_some_and(|it| it.name(bytes).is_some())
}

/// Reads the wanted variables of version 4.
pub fn parse_version_4(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    let (mut snapshot, mut rest) = (Snapshot::default(), bytes);
    while !rest.is_empty() {
        let head = Old::first(rest).and_then(|head| Some((head.name(rest)?, head)));
        let (name, head) = head.ok_or_else(|| cut("the head of a variable"))?;
        let wrong = |what: String| Mistake::new(format!("`{name}`: {what}"));
        let numbers = count(head.shape[0], head.shape[1], head.kind)?;
        let parts = 1 + usize::from(head.is_complex);
        let length = (numbers * head.kind.bytes()).saturating_mul(parts);
        let data = rest.get(Old::BYTES + head.name..).unwrap_or_default();
        let (data, after) =
            data.split_at_checked(length).ok_or_else(|| cut(&format!("`{name}`")))?;
        rest = after;
        let is_needed = is_time(&name) || wanted.reads(&name);
        if is_needed && head.is_full && !head.is_complex && numbers > 0 {
            wanted.reserve(&format!("`{name}`"), numbers)?;
            let values = head.kind.read(data, head.order);
            snapshot.take(of_columns(&name, values, &head.shape, head.kind.stored()));
        } else if wanted.need(&name) == Need::Must {
            return Err(wrong("expected an array of real numbers, which is not empty".into()));
        } else {
            snapshot.unread.push(name);
        }
    }
    Ok(snapshot)
}

/// A kind of numbers by the number of its element.
fn kind(number: u32) -> Option<NumberType> {
    Some(match number {
        1 => NumberType::Signed(1),
        2 => NumberType::Unsigned(1),
        3 => NumberType::Signed(2),
        4 => NumberType::Unsigned(2),
        5 => NumberType::Signed(4),
        6 => NumberType::Unsigned(4),
        7 => NumberType::Float(4),
        9 => NumberType::Float(8),
        12 => NumberType::Signed(8),
        13 => NumberType::Unsigned(8),
        _ => return None,
    })
}
