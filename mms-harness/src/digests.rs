//! Digests of files, each computed once unless the file changes.

use std::collections::BTreeMap;
use std::fs::Metadata;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use mms_files::read;
use mms_files::store::Digest;

/// The most bytes of a file with a digest: 1 GiB takes some seconds.
pub const MOST: u64 = 1 << 30;

/// The content of a file, for comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Content {
    /// The digest of its bytes.
    Digest(String),
    /// The length and time of change, for a file that cannot be read or is too long.
    Dated(String),
}

impl Content {
    /// The text for keys.
    pub fn text(&self) -> &str {
        match self {
            Content::Digest(text) | Content::Dated(text) => text,
        }
    }
}

/// Attributes of a file that change whenever its content does.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Stamp {
    length: u64,
    modified: Option<SystemTime>,
    /// The inode and the time of its last change, which no program can set.
    inode: (u64, u64, i64, i64),
}

impl Stamp {
    fn of(found: &Metadata) -> Self {
        #[cfg(unix)]
        let inode = {
            use std::os::unix::fs::MetadataExt as _;
            (found.dev(), found.ino(), found.ctime(), found.ctime_nsec())
        };
        #[cfg(not(unix))]
        let inode = (0, 0, 0, 0);
        Stamp { length: found.len(), modified: found.modified().ok(), inode }
    }
}

/// The known digests.
#[derive(Default)]
pub struct Digests(Mutex<BTreeMap<PathBuf, (Stamp, Content)>>);

impl Digests {
    /// The content of a plain file; `None` if there is no such file.
    pub fn of(&self, path: &Path) -> Option<Content> {
        let found = path.metadata().ok().filter(Metadata::is_file)?;
        let stamp = Stamp::of(&found);
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((then, content)) = known().get(path)
            && *then == stamp
        {
            return Some(content.clone());
        }
        let dated = || Content::Dated(format!("{} bytes, {:?}", stamp.length, stamp.modified));
        let content = digest(path, found.len()).map_or_else(dated, Content::Digest);
        known().insert(path.to_owned(), (stamp, content.clone()));
        Some(content)
    }
}

/// The digest of a file of this length. An empty file is not read, because reading one in `/proc` may wait for ever.
fn digest(path: &Path, length: u64) -> Option<String> {
    let mut digest = Digest::default();
    if length > MOST {
        return None;
    }
    if length > 0 {
        let mut file = read::open(path).ok()?.take(MOST);
        let mut buffer = vec![0; 1 << 16];
        loop {
            match file.read(&mut buffer).ok()? {
                0 => break,
                count => digest.add(&buffer[..count]),
            }
        }
    }
    Some(digest.text())
}
