//! Files of results that a user names, on a disk or elsewhere.

use std::error::Error;
use std::path::{Path, PathBuf};

/// Finds and reads files of results, on a disk or elsewhere.
pub trait Files: Sync {
    /// The files of a name, in the order of their names: a file, the files of a folder, or those that fit a pattern.
    ///
    /// # Errors
    /// A name of no file; a folder with several lists of states.
    fn paths(&self, given: &str) -> Result<Vec<PathBuf>, Box<dyn Error + Send + Sync>>;

    /// The bytes of a file.
    ///
    /// # Errors
    /// A file that cannot be read, or has more than `room` bytes.
    fn bytes(&self, path: &Path, room: u64) -> Result<Vec<u8>, String>;

    /// The bytes of memory available for reading.
    fn memory(&self) -> u64;
}
