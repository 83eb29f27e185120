//! Arrays of NumPy in one file, as `numpy.savez` writes them.

use miniz_oxide::inflate::decompress_to_vec_with_limit;
use rawzip::{CompressionMethod, ZipArchive, crc32};

use super::npy;
use super::table::is_time;
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Time};

/// What deflate makes of a byte at most.
pub const RATIO: u64 = 1032;

/// More bytes than the header of an array that is read has.
pub const HEAD: usize = 1 << 16;

fn broken(error: rawzip::Error) -> Mistake {
    Mistake::new(format!("not a file of `numpy.savez`: {error}"))
}

/// An array in the archive.
struct Entry<'a> {
    name: &'a str,
    data: &'a [u8],
    method: CompressionMethod,
    /// Its bytes when it is unpacked.
    length: u64,
    /// Their checksum.
    crc: u32,
}

/// Reads the arrays that are wanted. The time is one of them.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    let archive = ZipArchive::from_slice(bytes).map_err(broken)?;
    let mut entries = archive.entries();
    let mut snapshot = Snapshot::default();
    let mut taken = 0;
    while let Some(entry) = entries.next_entry().map_err(broken)? {
        let path = String::from_utf8_lossy(entry.file_path().as_bytes()).into_owned();
        let name = path.strip_suffix(".npy").ok_or_else(|| {
            Mistake::new(format!(
                "`{path}`: expected arrays of NumPy, as `numpy.savez` writes them"
            ))
        })?;
        let found = archive.get_entry(entry.wayfinder()).map_err(broken)?;
        taken += found.data().len();
        if taken > bytes.len() {
            return Err(Mistake::new("two arrays have the same bytes"));
        }
        if !is_time(name) && !wanted.reads(name) {
            snapshot.unread.push(name.to_owned());
            continue;
        }
        let (method, length, crc) =
            (entry.compression_method(), entry.uncompressed_size_hint(), entry.crc32());
        match (Entry { name, data: found.data(), method, length, crc }).array(wanted)? {
            Some(array) => snapshot.take(array),
            None => snapshot.unread.push(name.to_owned()),
        }
    }
    Ok(snapshot)
}

impl Entry<'_> {
    /// The array; none if it holds words and need not hold numbers.
    fn array(&self, wanted: &Wanted<'_>) -> Result<Option<Array>, Mistake> {
        let head;
        let head = match self.method {
            CompressionMethod::STORE => self.data,
            CompressionMethod::DEFLATE => {
                head = decompress_to_vec_with_limit(self.data, HEAD)
                    .unwrap_or_else(|error| error.output);
                &head
            }
            other => return Err(self.wrong(format!("compression {other:?} is not read"))),
        };
        if npy::are_words(head) && wanted.need(self.name) != Need::Must {
            return Ok(None);
        }
        // Nothing is unpacked beyond what the header of the array declares.
        let head = npy::Head::of(head).map_err(|mistake| self.wrong(mistake.what))?;
        let declared = head.length();
        let most = RATIO * self.data.len() as u64;
        if declared != self.length || self.method == CompressionMethod::DEFLATE && declared > most {
            let found = self.length.min(most);
            return Err(self.wrong(format!("{found} bytes, and its shape needs {declared}")));
        }
        wanted.take(&format!("`{}`", self.name), head.numbers())?;
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
        npy::array(self.name, bytes).map(Some)
    }

    fn wrong(&self, what: impl std::fmt::Display) -> Mistake {
        Mistake::new(format!("`{}`: {what}", self.name))
    }
}

impl Snapshot {
    /// Takes an array of points, or the time.
    pub(super) fn take(&mut self, array: Array) {
        match array.values.as_slice() {
            [value] if is_time(&array.name) => {
                self.time = Some(Time { value: *value, rounding: array.rounding() });
            }
            _ => self.of_points.push(array),
        }
    }
}
