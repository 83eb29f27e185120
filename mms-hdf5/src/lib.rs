//! Arrays, words and attributes of HDF5 and netCDF files, over bytes.
//!
//! A [`Store`] is one file in either format: HDF5, which netCDF-4 uses as well, or the classic format of netCDF. A [`Set`] is
//! one array in it, with its shape and the [`Type`] of its numbers; its bytes are returned as stored, big-endian or
//! little-endian. This crate opens no file, starts no thread, and does not interpret arrays.

mod classic;
mod lzf;
mod tree;

use std::cell::Cell;

use classic::Classic;
use tree::Tree;

/// The first bytes of a file in the classic format of netCDF.
const CLASSIC: &[u8] = b"CDF";

/// The largest number of bytes that deflate makes from one byte.
const RATIO: u64 = 1032;

/// The number of decoded bytes that every file may contain in addition to `RATIO` times its length.
const LEAST: u64 = 1 << 20;

/// The largest number of words that are read of one array.
const MOST_WORDS: usize = 100_000;

/// The type of an array's elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// Floating-point numbers of 4 or 8 bytes.
    Float(usize),
    /// Integers with a sign, of 1, 2, 4 or 8 bytes.
    Signed(usize),
    /// Integers without a sign.
    Unsigned(usize),
    /// Words.
    Words,
    /// Other types: records, references, numbers of other sizes.
    Other,
}

impl Type {
    /// The number of bytes of a number; `None` for other types.
    pub fn bytes(self) -> Option<usize> {
        match self {
            Type::Float(bytes) | Type::Signed(bytes) | Type::Unsigned(bytes) => Some(bytes),
            Type::Words | Type::Other => None,
        }
    }
}

/// An array of a file.
pub struct Set {
    /// The path, from the root on, without a leading slash.
    pub path: String,
    /// The axes, the slowest first; empty for a single number.
    pub shape: Vec<usize>,
    /// The type of the elements.
    pub kind: Type,
    /// Whether the most significant byte of a number is first.
    pub is_big: bool,
    place: Storage,
}

/// The storage of an array.
enum Storage {
    /// A data set of HDF5. The flag is true if it is compressed, so that its decoded bytes may be more than the file has.
    Tree(Box<hdf5_reader::Dataset>, bool),
    Classic(usize),
    /// Listed by its group, but cannot be opened.
    Nowhere,
}

impl Set {
    /// The number of elements at one index of the first axis.
    pub fn stride(&self) -> usize {
        self.shape.iter().skip(1).fold(1, |all: usize, &axis| all.saturating_mul(axis))
    }

    /// The number of elements; `None` if no file can contain as many.
    pub fn count(&self) -> Option<usize> {
        self.shape.iter().try_fold(1, |all: usize, &axis| all.checked_mul(axis))
    }
}

/// A fault of an array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The fault, and advice.
    pub what: String,
    /// Whether the array may be sound: its compression is not supported, or it was never written.
    pub is_foreign: bool,
}

impl Fault {
    fn of(what: impl Into<String>) -> Fault {
        Fault { what: what.into(), is_foreign: false }
    }
}

impl From<String> for Fault {
    fn from(what: String) -> Fault {
        Fault::of(what)
    }
}

/// The value of an attribute.
pub enum Value {
    /// Words.
    Words(Vec<String>),
    /// The bytes of numbers, and whether the most significant byte of each is first.
    Numbers(Type, bool, Vec<u8>),
}

enum Source {
    Tree(Tree),
    Classic(Classic),
}

/// A file.
pub struct Store {
    source: Source,
    /// The number of bytes of the file.
    length: u64,
    /// The number of bytes that may still be decoded. A valid file cannot exceed the initial number.
    left: Cell<u64>,
}

impl Store {
    /// Opens a file.
    ///
    /// # Errors
    /// The bytes are damaged, or neither HDF5 nor netCDF.
    pub fn open(bytes: Vec<u8>) -> Result<Store, String> {
        let length = bytes.len() as u64;
        let left = length.saturating_mul(RATIO).saturating_add(LEAST);
        let source = match bytes.starts_with(CLASSIC) {
            true => Source::Classic(Classic::open(bytes)?),
            false => Source::Tree(Tree::open(bytes, left)?),
        };
        Ok(Store { source, length, left: Cell::new(left) })
    }

    /// Whether the file is HDF5.
    pub fn is_tree(&self) -> bool {
        matches!(self.source, Source::Tree(_))
    }

    /// All arrays, also those in groups.
    ///
    /// # Errors
    /// Groups are damaged, deeper than the limit, or too many.
    pub fn sets(&self) -> Result<Vec<Set>, String> {
        match &self.source {
            Source::Tree(tree) => tree.sets(),
            Source::Classic(classic) => Ok(classic.sets()),
        }
    }

    /// The array at this path, if there is one that can be opened.
    pub fn set(&self, path: &str) -> Option<Set> {
        let path = path.trim_matches('/');
        match &self.source {
            Source::Tree(tree) => tree.set(path),
            Source::Classic(classic) => classic.set(path),
        }
    }

    /// Whether there is a group of this path.
    pub fn has_group(&self, path: &str) -> bool {
        match &self.source {
            Source::Tree(tree) => tree.has_group(path.trim_matches('/')),
            Source::Classic(_) => path.trim_matches('/').is_empty(),
        }
    }

    /// The value of an attribute of a group or an array; the root has an empty path.
    pub fn attribute(&self, path: &str, name: &str) -> Option<Value> {
        let path = path.trim_matches('/');
        match &self.source {
            Source::Tree(tree) => tree.attribute(path, name),
            Source::Classic(classic) => classic.attribute(path, name),
        }
    }

    /// The bytes of an array of numbers.
    ///
    /// # Errors
    /// The data are damaged, or beyond the budget.
    pub fn bytes(&self, set: &Set) -> Result<Vec<u8>, Fault> {
        let size = match set.kind {
            Type::Words => return Err(Fault::of("expected numbers, found words")),
            kind => kind.bytes(),
        };
        let size = size.ok_or_else(|| Fault::of("expected floating-point numbers or integers"))?;
        let needed = set.count().and_then(|it| it.checked_mul(size));
        let needed = needed.ok_or_else(|| Fault::of("no file holds as many numbers"))?;
        if matches!(set.place, Storage::Tree(_, false)) && needed as u64 > self.length + LEAST {
            // The file probably stores no element of such an array, so that each is the fill value: it is refused as unread.
            let what = format!("{needed} bytes, and the file has {}", self.length);
            return Err(Fault { what, is_foreign: true });
        }
        self.spend(needed)?;
        let bytes = match (&self.source, &set.place) {
            (Source::Tree(_), Storage::Tree(found, _)) => tree::bytes(found)?,
            (Source::Classic(classic), Storage::Classic(at)) => classic.bytes(*at, needed)?,
            _ => return Err(Fault::of("it cannot be opened")),
        };
        match bytes.len() == needed {
            true => Ok(bytes),
            false => Err(Fault::of(format!(
                "{} bytes of numbers, and its shape needs {needed}",
                bytes.len()
            ))),
        }
    }

    /// The words of an array. Single letters along the last axis are one word.
    ///
    /// # Errors
    /// The data are damaged, or beyond the budget.
    pub fn words(&self, set: &Set) -> Result<Vec<String>, String> {
        let most = set.count().filter(|it| *it <= MOST_WORDS.saturating_mul(64));
        let most = most.ok_or("more words than are read")?;
        match (set.kind, &self.source, &set.place) {
            (Type::Words, Source::Tree(tree), Storage::Tree(found, _)) => {
                self.spend(found.raw_byte_len().map_err(|it| it.to_string())?)?;
                tree.words(found, set.shape.last().copied())
            }
            (Type::Words, Source::Classic(classic), Storage::Classic(at)) => {
                self.spend(most)?;
                let length = set.shape.last().copied().unwrap_or(1);
                Ok(letters(&classic.bytes(*at, most)?, length))
            }
            _ => Err("expected words".into()),
        }
    }

    /// The number of bytes that may still be decoded.
    pub fn left(&self) -> u64 {
        self.left.get()
    }

    /// Subtracts decoded bytes from the budget.
    fn spend(&self, bytes: usize) -> Result<(), String> {
        let left = self.left.get().checked_sub(bytes as u64);
        self.left.set(left.ok_or_else(|| format!("{bytes} bytes: the file cannot hold as many"))?);
        Ok(())
    }
}

/// Splits bytes into words of `length` bytes each, without padding.
fn letters(bytes: &[u8], length: usize) -> Vec<String> {
    bytes.chunks(length.max(1)).take(MOST_WORDS).map(word).collect()
}

/// A word, without padding.
fn word(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|it| *it == 0).unwrap_or(bytes.len());
    String::from_utf8_lossy(&bytes[..end]).trim_end().to_owned()
}
