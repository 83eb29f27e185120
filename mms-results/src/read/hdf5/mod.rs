//! Files of HDF5 and netCDF, and the formats over them.

mod exodus;
mod plain;
mod vtkhdf;

use std::borrow::Cow;

use mms_hdf5::{Fault, Set, Store, Type, Value};

use super::numbers::{ByteOrder, NumberType, positions};
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Time};

/// The beginning of a MATLAB file: its user block.
const MATLAB: &[u8] = b"MATLAB 7.3";

/// The most times of a file.
const MOST_TIMES: usize = 10_000;

/// An open file, and the selection of its arrays.
pub struct File<'a> {
    store: Store,
    wanted: &'a Wanted<'a>,
}

/// Reads a file. Borrowed bytes are copied first.
pub fn parse(bytes: Cow<'_, [u8]>, wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let is_matlab = bytes.starts_with(MATLAB);
    let copied = if let Cow::Borrowed(bytes) = bytes { bytes.len() } else { 0 };
    wanted.with_reserved(copied, || {
        let file = File::open(bytes.into_owned(), wanted)?;
        if exodus::is_exodus(&file) {
            exodus::parse(&file)
        } else if vtkhdf::is_vtk(&file) {
            vtkhdf::parse(&file)
        } else {
            plain::parse(&file, is_matlab)
        }
    })
}

impl<'a> File<'a> {
    /// Opens a file.
    pub fn open(bytes: Vec<u8>, wanted: &'a Wanted<'a>) -> Result<File<'a>, Mistake> {
        let store = Store::open(bytes)
            .map_err(|what| Mistake::new(format!("not HDF5 or netCDF that can be read: {what}")))?;
        Ok(File { store, wanted })
    }

    /// The array at a path, which must exist.
    fn need(&self, path: &str) -> Result<Set, Mistake> {
        let found = self.store.set(path);
        found.ok_or_else(|| Mistake::new(format!("expected an array `{path}`, which is not there")))
    }

    /// Reads an array under another name: its first axis is the rows.
    fn array(&self, set: &Set, name: &str) -> Result<Array, Mistake> {
        self.take(set)?;
        self.made(set, name, self.store.bytes(set))
    }

    /// Reads an array if its name is wanted; otherwise returns `None`. An array without numbers, or with an unsupported
    /// compression, is left out unless it must be read.
    fn wanted(&self, set: &Set, name: &str) -> Result<Option<Array>, Mistake> {
        let need = self.wanted.need(name);
        let is_plain = need == Need::Must || need == Need::Numbers && kind(set.kind).is_some();
        if !is_plain {
            return Ok(None);
        }
        self.take(set)?;
        match self.store.bytes(set) {
            Err(fault) if fault.is_foreign && need == Need::Numbers => Ok(None),
            found => self.made(set, name, found).map(Some),
        }
    }

    /// Reserves memory for an array. If the file cannot contain the array, reserves none, and reading it fails later.
    fn take(&self, set: &Set) -> Result<(), Mistake> {
        let numbers = set.count().filter(|it| *it as u64 <= self.store.left());
        self.wanted.reserve(&format!("`{}`", set.path), numbers.unwrap_or(0))
    }

    /// Makes an array from its bytes.
    fn made(&self, set: &Set, name: &str, bytes: Result<Vec<u8>, Fault>) -> Result<Array, Mistake> {
        let wrong = |what: String| Mistake::new(format!("`{}`: {what}", set.path));
        let kind = kind(set.kind).ok_or_else(|| wrong("expected numbers".into()));
        let bytes = bytes.map_err(|fault| wrong(fault.what))?;
        let (kind, name) = (kind?, name.to_owned());
        let values = kind.read(&bytes, order(set.is_big));
        // An array without rows may declare any number of components.
        let components = if values.is_empty() { 1 } else { set.stride() };
        Ok(Array { name, components, values, stored: kind.stored(), ..Array::default() })
    }

    /// Reads the array at a path, under that name.
    pub fn at(&self, path: &str) -> Result<Array, Mistake> {
        self.array(&self.need(path)?, path)
    }

    /// The numbers of an array as positions.
    fn positions(&self, path: &str) -> Result<Vec<usize>, Mistake> {
        let wrong = |it: Mistake| Mistake::new(format!("`{path}`: {}", it.what));
        positions(self.at(path)?.values).map_err(wrong)
    }

    /// Reads the words of an array; empty if it does not exist.
    fn words(&self, path: &str) -> Result<Vec<String>, Mistake> {
        let Some(set) = self.store.set(path) else { return Ok(Vec::new()) };
        self.store.words(&set).map_err(|what| Mistake::new(format!("`{path}`: {what}")))
    }

    /// The first word of an attribute.
    fn word(&self, path: &str, name: &str) -> Option<String> {
        match self.store.attribute(path, name)? {
            Value::Words(words) => words.into_iter().next(),
            Value::Numbers(..) => None,
        }
    }

    /// The numbers of an attribute.
    fn numbers(&self, path: &str, name: &str) -> Option<Vec<f64>> {
        match self.store.attribute(path, name)? {
            Value::Words(_) => None,
            Value::Numbers(numbers, is_big, bytes) => {
                kind(numbers).map(|it| it.read(&bytes, order(is_big)))
            }
        }
    }

    /// The times of an array.
    fn times(&self, set: &Set) -> Result<Vec<Time>, Mistake> {
        let array = self.array(set, "time")?;
        if array.values.len() > MOST_TIMES {
            let what = format!("{} times; expected {MOST_TIMES} at most", array.values.len());
            return Err(Mistake::new(what));
        }
        let time = |&value: &f64| match value.is_finite() {
            true => Ok(Time { value, rounding: array.stored.rounding(value) }),
            false => Err(Mistake::new(format!("`{}`: {value} is no time", set.path))),
        };
        array.values.iter().map(time).collect()
    }

    /// Copies the data that are the same at all times to each of them.
    fn repeated(&self, whole: Snapshot, times: &[Time]) -> Result<Vec<Snapshot>, Mistake> {
        let arrays = whole.points.iter().chain(&whole.of_points).chain(&whole.of_cells);
        let numbers: usize = arrays.map(|it| it.values.len()).sum();
        let numbers = numbers + whole.cells.points.len() + 2 * whole.cells.len();
        let more = times.len().saturating_sub(1);
        self.wanted.reserve("the mesh at each time", numbers.saturating_mul(more))?;
        if times.is_empty() {
            return Ok(vec![whole]);
        }
        Ok(times.iter().map(|time| Snapshot { time: Some(*time), ..whole.clone() }).collect())
    }
}

/// The binary form of numbers of a type; `None` if it is not numeric.
fn kind(found: Type) -> Option<NumberType> {
    match found {
        Type::Float(bytes) => Some(NumberType::Float(bytes)),
        Type::Signed(bytes) => Some(NumberType::Signed(bytes)),
        Type::Unsigned(bytes) => Some(NumberType::Unsigned(bytes)),
        Type::Words | Type::Other => None,
    }
}

fn order(is_big: bool) -> ByteOrder {
    if is_big { ByteOrder::Big } else { ByteOrder::Little }
}

/// Splits an array with numbers for some times one after the other into one array per time.
fn by_time(array: &Array, components: usize, times: usize) -> impl Iterator<Item = Array> {
    let each = array.values.len() / times.max(1);
    array.values.chunks_exact(each.max(1)).map(move |values| Array {
        components,
        values: values.to_vec(),
        ..array.clone_without_values()
    })
}
