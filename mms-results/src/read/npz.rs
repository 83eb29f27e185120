//! Arrays of NumPy in one file, as `numpy.savez` writes them.

use rawzip::{CompressionMethod, ZipArchive};

use super::npy;
use super::table::is_time;
use crate::{Array, Mistake, Snapshot, Time};

/// What deflate makes of a byte at most.
const RATIO: u64 = 1032;

fn broken(error: rawzip::Error) -> Mistake {
    Mistake::new(format!("not a file of `numpy.savez`: {error}"))
}

/// Reads all arrays of a file; those of words are left out.
pub fn parse(bytes: &[u8]) -> Result<Snapshot, Mistake> {
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
        let read = |bytes: &[u8]| match npy::are_words(bytes) {
            true => Ok(None),
            false => npy::array(name, bytes).map(Some),
        };
        let array = match entry.compression_method() {
            CompressionMethod::STORE => read(found.data()),
            CompressionMethod::DEFLATE => {
                read(&inflate(name, found.data(), entry.uncompressed_size_hint())?)
            }
            other => Err(Mistake::new(format!("`{name}`: compression {other:?} is not read"))),
        }?;
        array.into_iter().for_each(|array| snapshot.take(array));
    }
    Ok(snapshot)
}

fn inflate(name: &str, data: &[u8], length: u64) -> Result<Vec<u8>, Mistake> {
    let most = length.min(RATIO * data.len() as u64) as usize;
    let bytes = miniz_oxide::inflate::decompress_to_vec_with_limit(data, most);
    bytes.map_err(|error| Mistake::new(format!("`{name}`: not what its header says: {error}")))
}

impl Snapshot {
    /// Takes an array of points, or the time.
    fn take(&mut self, array: Array) {
        match array.values.as_slice() {
            [value] if is_time(&array.name) => {
                self.time = Some(Time { value: *value, rounding: array.rounding() });
            }
            _ => self.of_points.push(array),
        }
    }
}
