//! Arrays of NumPy in one file, as `numpy.savez` writes them.

use std::borrow::Cow;

use miniz_oxide::inflate::decompress_to_vec_with_limit;
use rawzip::{CompressionMethod, ZipArchive, crc32};

use super::npy;
use super::series::{Shaped, are_times, by_time};
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Time};

/// The largest ratio of unpacked to packed bytes in deflate.
pub const RATIO: u64 = 1032;

/// More bytes than the header of any supported array.
pub const HEAD: usize = 1 << 16;

fn broken(error: rawzip::Error) -> Mistake {
    Mistake::new(format!("not a file of `numpy.savez`: {error}"))
}

/// An array in the archive.
struct Entry<'a> {
    name: &'a str,
    data: &'a [u8],
    method: CompressionMethod,
    /// The number of unpacked bytes.
    length: u64,
    /// The checksum of the unpacked bytes.
    crc: u32,
}

/// Reads the wanted arrays. One of them may be the time, or the times along the first axis of others.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let archive = ZipArchive::from_slice(bytes).map_err(broken)?;
    let mut entries = archive.entries();
    let (mut snapshot, mut arrays, mut times) = (Snapshot::default(), Vec::new(), Vec::new());
    // The shapes of arrays with known names: other arrays may not belong to points.
    let (mut known, mut taken, mut has_arrays) = (Vec::new(), 0, false);
    while let Some(entry) = entries.next_entry().map_err(broken)? {
        let path = String::from_utf8_lossy(entry.file_path().as_bytes()).into_owned();
        let Some(name) = path.strip_suffix(".npy") else {
            snapshot.unread.push(path);
            continue;
        };
        has_arrays = true;
        let found = archive.get_entry(entry.wayfinder()).map_err(broken)?;
        taken += found.data().len();
        if taken > bytes.len() {
            return Err(Mistake::new("two arrays have the same bytes"));
        }
        let is_time = are_times(name);
        let (method, length, crc) =
            (entry.compression_method(), entry.uncompressed_size_hint(), entry.crc32());
        let entry = Entry { name, data: found.data(), method, length, crc };
        let array = match wanted.need(name) {
            Need::Numbers | Need::Must => entry.array(wanted)?,
            _ if is_time => entry.array(wanted)?,
            Need::Sound => {
                known.extend(entry.shape());
                None
            }
            Need::No => None,
        };
        match array {
            Some(array) if is_time => times.push(array),
            Some(array) if wanted.need(name) == Need::Must => {
                known.push(array.shape.clone());
                arrays.push(array);
            }
            Some(array) if !array.shape.is_empty() => arrays.push(array),
            _ => snapshot.unread.push(name.to_owned()),
        }
    }
    if !has_arrays {
        let found =
            snapshot.unread.first().map_or(String::new(), |it| format!(" (`{it}` is none)"));
        let what = format!("expected arrays of NumPy, as `numpy.savez` writes them{found}");
        return Err(Mistake::new(what));
    }
    by_time(times, arrays, &known, snapshot, wanted)
}

impl Entry<'_> {
    /// The first bytes, unpacked.
    fn head(&self) -> Result<Cow<'_, [u8]>, Mistake> {
        match self.method {
            CompressionMethod::STORE => Ok(self.data.into()),
            CompressionMethod::DEFLATE => {
                let head = decompress_to_vec_with_limit(self.data, HEAD);
                Ok(head.unwrap_or_else(|error| error.output).into())
            }
            other => Err(self.wrong(format!("compression {other:?} is not read"))),
        }
    }

    /// The length of each axis, if it is an array of numbers.
    fn shape(&self) -> Option<Vec<usize>> {
        Some(npy::Head::of(&self.head().ok()?).ok()?.into_shape())
    }

    /// The array; `None` if it contains no supported numbers, and need not.
    fn array(&self, wanted: &Wanted<'_>) -> Result<Option<Shaped>, Mistake> {
        let head = self.head()?;
        if npy::has_no_numbers(&head) && wanted.need(self.name) != Need::Must {
            return Ok(None);
        }
        // Nothing is unpacked beyond the declared size of the array.
        let head = npy::Head::of(&head).map_err(|mistake| self.wrong(mistake.what))?;
        let declared = head.length();
        let most = RATIO * self.data.len() as u64;
        if declared != self.length || self.method == CompressionMethod::DEFLATE && declared > most {
            let found = self.length.min(most);
            return Err(self.wrong(format!("{found} bytes, and its shape needs {declared}")));
        }
        wanted.reserve(&format!("`{}`", self.name), head.numbers())?;
        let unpacked;
        let bytes = match self.method {
            CompressionMethod::STORE => self.data,
            _ => {
                unpacked = decompress_to_vec_with_limit(self.data, declared as usize)
                    .map_err(|error| self.wrong(format!("not what its header says: {error}")))?;
                &unpacked
            }
        };
        if crc32(bytes) != self.crc {
            let what =
                "its checksum (CRC-32) is another: the file is damaged, write or copy it again";
            return Err(self.wrong(what));
        }
        let array = npy::array(self.name, bytes)?;
        Ok(Some(Shaped { array, shape: head.into_shape() }))
    }

    fn wrong(&self, what: impl std::fmt::Display) -> Mistake {
        Mistake::new(format!("`{}`: {what}", self.name))
    }
}

impl Snapshot {
    /// Adds an array of points, or the time.
    pub(super) fn take(&mut self, array: Array) {
        match array.values.as_slice() {
            [value] if are_times(&array.name) && value.is_finite() => {
                self.time = Some(Time { value: *value, rounding: array.rounding() });
            }
            _ => self.of_points.push(array),
        }
    }
}
