//! Files of HDF5, by the crate `hdf5-reader`: its use, and the limits.

use std::collections::BTreeSet;

use hdf5_reader::error::Error;
use hdf5_reader::messages::HdfMessage;
use hdf5_reader::{
    ByteOrder, Dataset, Datatype, FilterRegistry, Hdf5File, OpenOptions, RawAttribute, StringSize,
};

use crate::{Fault, MOST_WORDS, Set, Storage, Type, Value, letters, lzf, word};

/// The largest number of groups and arrays that are listed.
const MOST_OBJECTS: usize = 20_000;

/// The largest depth of groups in each other.
const DEEPEST: usize = 32;

/// The longest header of a group or an array, in bytes.
const LONGEST_HEADER: usize = 1 << 20;

/// The largest number of bytes of words of variable length in one array or attribute.
const MOST_LETTERS: usize = 1 << 22;

/// The name that netCDF-4 gives to arrays that only represent its dimensions.
const DIMENSION: &str = "This is a netCDF dimension but not a netCDF variable";

/// Reads the bytes that a reference points to.
type Follow<'a> = &'a dyn Fn(&[u8]) -> Result<Vec<u8>, String>;

/// A file of HDF5.
pub struct Tree(Hdf5File);

fn said(error: impl std::fmt::Display) -> String {
    error.to_string()
}

impl Tree {
    /// Opens a file whose chunks have at most `most` bytes.
    pub fn open(bytes: Vec<u8>, most: u64) -> Result<Tree, String> {
        let mut filters = FilterRegistry::new();
        let unpack = |packed: &[u8], most: usize| {
            let wrong = || Error::InvalidData("not LZF".into());
            lzf::unpack(packed, most).ok_or_else(wrong)
        };
        filters.register(
            lzf::NUMBER,
            Box::new(move |filter, packed, _| {
                unpack(packed, filter.client_data.get(2).map_or(0, |it| *it as usize))
            }),
        );
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        let options = OpenOptions {
            // Each chunk is read once.
            chunk_cache_bytes: 0,
            max_chunk_bytes: most,
            max_read_bytes: most,
            max_object_header_bytes: LONGEST_HEADER,
            filter_registry: Some(filters),
            ..OpenOptions::default()
        };
        Hdf5File::from_vec_with_options(bytes, options).map(Tree).map_err(said)
    }

    /// All arrays, in the order in which groups list them.
    pub fn sets(&self) -> Result<Vec<Set>, String> {
        let (mut sets, mut seen) = (Vec::new(), BTreeSet::new());
        let mut groups = vec![(String::new(), self.0.root_group().map_err(said)?, 0)];
        while let Some((path, group, depth)) = groups.pop() {
            // A group may contain itself.
            if !seen.insert(group.address()) {
                continue;
            }
            let (inner, names) = group.member_names().map_err(said)?;
            if depth >= DEEPEST || seen.len() + sets.len() + names.len() > MOST_OBJECTS {
                return Err(format!(
                    "more than {MOST_OBJECTS} groups and arrays, or groups in more than {DEEPEST} others"
                ));
            }
            let named = |name: &str| match path.as_str() {
                "" => name.to_owned(),
                path => format!("{path}/{name}"),
            };
            for name in names {
                let found = group.dataset(&name).ok();
                if !found.as_ref().is_some_and(is_dimension) {
                    sets.push(self.set_of(named(&name), found));
                }
            }
            for name in inner.into_iter().rev() {
                if let Ok(inner) = group.group(&name) {
                    groups.push((named(&name), inner, depth + 1));
                }
            }
        }
        Ok(sets)
    }

    pub fn set(&self, path: &str) -> Option<Set> {
        self.0.dataset(path).ok().map(|found| self.set_of(path.to_owned(), Some(found)))
    }

    fn set_of(&self, path: String, found: Option<Dataset>) -> Set {
        let nowhere = |path| Set {
            path,
            shape: Vec::new(),
            kind: Type::Other,
            is_big: false,
            place: Storage::Nowhere,
        };
        let Some(found) = found else { return nowhere(path) };
        // Arrays may be the elements of an array.
        let (inner, dims) = match found.dtype() {
            Datatype::Array { base, dims } => (&**base, &dims[..]),
            other => (other, &[][..]),
        };
        let (kind, is_big) = kind(inner);
        let axes = found.shape().iter().chain(dims);
        let shape = axes.map(|it| usize::try_from(*it)).collect::<Result<Vec<_>, _>>();
        let Ok(shape) = shape else { return nowhere(path) };
        // An array that is declared as empty has no axes either.
        let shape = if matches!(found.num_elements(), Ok(0)) { vec![0] } else { shape };
        let header = self.0.get_or_parse_header(found.address());
        let is_filter = |it: &HdfMessage| matches!(it, HdfMessage::FilterPipeline(_));
        let is_packed = header.is_ok_and(|it| it.messages.iter().any(is_filter));
        Set { path, shape, kind, is_big, place: Storage::Tree(Box::new(found), is_packed) }
    }

    pub fn has_group(&self, path: &str) -> bool {
        self.0.group(path).is_ok()
    }

    pub fn attribute(&self, path: &str, name: &str) -> Option<Value> {
        let all = match self.0.group(path) {
            Ok(group) => group.raw_attributes(),
            Err(_) => self.0.dataset(path).ok()?.raw_attributes(),
        };
        let found = all.ok()?.into_iter().find(|it| it.name() == name)?;
        let message = found.message();
        match kind(&message.datatype) {
            (Type::Words, _) => {
                let group = self.0.root_group().ok()?;
                let follow = |it: &[u8]| group.resolve_vlen_reference_bytes(it, 1).map_err(said);
                let size = 8 + usize::from(group.offset_size());
                let words = words(&message.raw_data, &message.datatype, size, None, &follow);
                words.ok().map(Value::Words)
            }
            (Type::Other, _) => None,
            (kind, is_big) => Some(Value::Numbers(kind, is_big, message.raw_data.clone())),
        }
    }

    pub fn words(&self, found: &Dataset, last: Option<usize>) -> Result<Vec<String>, String> {
        let follow = |it: &[u8]| found.resolve_vlen_reference_bytes(it, 1).map_err(said);
        let bytes = bytes(found).map_err(|it| it.what)?;
        words(&bytes, found.dtype(), found.vlen_reference_size(), last, &follow)
    }
}

/// The bytes of an array.
pub fn bytes(found: &Dataset) -> Result<Vec<u8>, Fault> {
    found.read_raw_bytes().map_err(|error| {
        let mut cause = &error;
        while let Error::Context { source, .. } = cause {
            cause = source;
        }
        let is_foreign = matches!(cause, Error::UnsupportedFilter(_));
        let what = match is_foreign {
            true => format!(
                "compressed in a way that is not read ({cause}): write it with gzip, or without"
            ),
            false => error.to_string(),
        };
        Fault { what, is_foreign }
    })
}

/// Words of fixed length, or words behind references of `size` bytes.
fn words(
    bytes: &[u8],
    kind: &Datatype,
    size: usize,
    last: Option<usize>,
    follow: Follow<'_>,
) -> Result<Vec<String>, String> {
    if let Datatype::String { size: StringSize::Fixed(length), .. } = kind {
        let length = match (*length as usize, last) {
            (1, Some(letters)) => letters,
            (length, _) => length,
        };
        return Ok(letters(bytes, length));
    }
    let (mut all, mut letters) = (Vec::new(), 0);
    for reference in bytes.chunks_exact(size).take(MOST_WORDS) {
        let found = follow(reference)?;
        letters += found.len();
        if letters > MOST_LETTERS {
            return Err("more letters than are read".into());
        }
        all.push(word(&found));
    }
    Ok(all)
}

/// The type of numbers, and whether the most significant byte is first.
fn kind(found: &Datatype) -> (Type, bool) {
    let is_big = |order: &ByteOrder| *order == ByteOrder::BigEndian;
    match found {
        Datatype::FloatingPoint { size: size @ (4 | 8), byte_order } => {
            (Type::Float(usize::from(*size)), is_big(byte_order))
        }
        Datatype::FixedPoint { size: size @ (1 | 2 | 4 | 8), signed, byte_order } => {
            let size = usize::from(*size);
            let kind = if *signed { Type::Signed(size) } else { Type::Unsigned(size) };
            (kind, is_big(byte_order))
        }
        // Booleans of h5py.
        Datatype::Enum { base, .. } if matches!(**base, Datatype::FixedPoint { .. }) => kind(base),
        Datatype::String { .. } => (Type::Words, false),
        Datatype::VarLen { base, .. } if base.is_vlen_string_base() => (Type::Words, false),
        _ => (Type::Other, false),
    }
}

/// Whether an array only represents a dimension of netCDF.
fn is_dimension(found: &Dataset) -> bool {
    let named = |it: &RawAttribute| {
        it.name() == "NAME" && it.message().raw_data.starts_with(DIMENSION.as_bytes())
    };
    found.raw_attributes().is_ok_and(|all| all.iter().any(named))
}
