//! A cache of results of runs, kept in a folder as they finish.
//!
//! A result depends on its key: the identity of this program (version, length and build time), the field's text, method,
//! precision and form, cells, parameters and motion, the deliberate mistake if there is one, and the quantity whose errors are
//! measured. `mms-harness/src/plan.rs` documents the keys of campaigns. There is one file per result, named by a digest of the
//! key, with the key and a checksum in it. A file appears whole or not at all, and is trusted only if its checksum, its key and
//! its name agree. Opening a store checks every file in it. A file that is cut off, changed, of another format, or not the one
//! that its name says is renamed to `.aside1` and so on, reported, and neither read again nor deleted. Processes may share a
//! folder: each locks a file beside a result while it computes this result. A lock ends with its process, however it ends.
//! Other processes compute the remaining results, and then wait for the lock. The next process that opens the store removes the
//! lock files that ended processes left.

use std::fs::{self, File};
use std::io;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::Context as _;
use mms_spec::foreign;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;

use crate::read::{self, FileKind, Unread};
use crate::write::write_own;
use crate::write::{leads_to, remove_stale};

/// The value of the first key of every file.
pub const FORMAT: &str = "mms result 1";

/// A folder of results.
pub struct Store {
    folder: PathBuf,
}

/// The stored state of a result.
#[derive(Debug, PartialEq)]
pub enum Entry<T> {
    /// There is no file.
    Missing,
    /// The saved result.
    Stored(T),
    /// A file that is not trusted was set aside, with a message.
    SetAside(String),
}

/// The right to compute a result, until it is dropped.
pub struct ResultLock {
    /// The lock of this process.
    _lock: File,
    path: PathBuf,
}

impl Drop for ResultLock {
    /// Removes the lock file. A process that waits for its lock then makes a new one, and finds the result in the store.
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// The content of a file: `checksum` is the digest of the texts of `key` and `result`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Envelope {
    format: String,
    checksum: String,
    key: Box<RawValue>,
    result: Box<RawValue>,
}

impl Store {
    /// Opens the store in a folder, which is made if there is none; returns also messages about the files that were set aside.
    ///
    /// # Errors
    /// A folder that cannot be made or read, a file that cannot be renamed.
    pub fn open(folder: &Path) -> anyhow::Result<(Self, Vec<String>)> {
        let shown = foreign::path(folder);
        fs::create_dir_all(folder).with_context(|| format!("cannot make the folder `{shown}`"))?;
        let store = Store { folder: folder.to_owned() };
        let mut set_aside = Vec::new();
        let entries = fs::read_dir(folder).with_context(|| format!("cannot read `{shown}`"))?;
        for entry in entries {
            let path = entry.with_context(|| format!("cannot read `{shown}`"))?.path();
            let ends = |with: &str| path.extension().is_some_and(|extension| extension == with);
            if ends("lock") {
                // A killed process left this file. If it cannot be removed, it does no harm.
                let _ = remove_stale(&path);
            }
            if !ends("json") || path.is_dir() {
                continue;
            }
            // Reports the files renamed so far even if the next file cannot be read.
            let found = store
                .read::<Value>(&path, None)
                .map_err(|error| set_aside.iter().cloned().fold(error, anyhow::Error::context))?;
            if let Entry::SetAside(what) = found {
                set_aside.push(what);
            }
        }
        set_aside.sort();
        Ok((store, set_aside))
    }

    /// Loads the stored result of a key.
    ///
    /// # Errors
    /// A file that cannot be read or renamed.
    pub fn load<T: DeserializeOwned>(&self, key: &impl Serialize) -> anyhow::Result<Entry<T>> {
        let key = serde_json::to_string(key)?;
        self.read(&self.path(&key, "json"), Some(&key))
    }

    /// Sets the result of a key aside, and returns a message with the reason.
    ///
    /// # Errors
    /// A file that cannot be renamed.
    pub fn distrust(&self, key: &impl Serialize, reason: &str) -> anyhow::Result<String> {
        set_aside(&self.path(&serde_json::to_string(key)?, "json"), reason)
    }

    /// Stores the result of a key.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save<T: Serialize>(&self, key: &impl Serialize, result: &T) -> anyhow::Result<()> {
        let [key, result] = [serde_json::to_string(key)?, serde_json::to_string(result)?];
        let path = self.path(&key, "json");
        let checksum = digest([&key, &result]);
        let [key, result] = [RawValue::from_string(key)?, RawValue::from_string(result)?];
        let envelope = Envelope { format: FORMAT.to_owned(), checksum, key, result };
        write_own(&path, &(serde_json::to_string(&envelope)? + "\n"))
            .with_context(|| format!("cannot write `{}`", foreign::path(&path)))
    }

    /// Claims the result of a key; `None` if another process has claimed it. If `wait`, waits until that process has ended or
    /// dropped its claim.
    ///
    /// # Errors
    /// A file that cannot be made or locked.
    pub fn claim(&self, key: &impl Serialize, wait: bool) -> anyhow::Result<Option<ResultLock>> {
        let path = self.path(&serde_json::to_string(key)?, "lock");
        let lock = lock(&path, wait);
        let lock = lock.with_context(|| format!("cannot lock `{}`", foreign::path(&path)))?;
        Ok(lock.map(|lock| ResultLock { _lock: lock, path }))
    }

    fn path(&self, key: &str, extension: &str) -> PathBuf {
        self.folder.join(digest([key])).with_extension(extension)
    }

    /// Reads a file, and checks it against a key if one is given.
    fn read<T: DeserializeOwned>(
        &self,
        path: &Path,
        key: Option<&str>,
    ) -> anyhow::Result<Entry<T>> {
        let found = match read::bytes(path, FileKind::Stored) {
            // Another process that shares the folder may have set the file aside since.
            Err(error) if error.is_missing() => return Ok(Entry::Missing),
            Err(error @ Unread::Failed(_)) => {
                return Err(error).with_context(|| read::cannot_read(path));
            }
            Err(error) => Err(error.to_string()),
            Ok(bytes) => self.check(path, &bytes, key),
        };
        Ok(match found {
            Ok(result) => Entry::Stored(result),
            Err(reason) => Entry::SetAside(set_aside(path, &reason)?),
        })
    }

    /// The result in a file; otherwise the reason why it is not trusted.
    fn check<T: DeserializeOwned>(
        &self,
        path: &Path,
        bytes: &[u8],
        key: Option<&str>,
    ) -> Result<T, String> {
        let envelope: Envelope = serde_json::from_slice(bytes)
            .map_err(|error| format!("not a whole result: {error}"))?;
        if envelope.format != FORMAT {
            return Err(format!("its format is `{}`, not `{FORMAT}`", envelope.format));
        }
        if envelope.checksum != digest([envelope.key.get(), envelope.result.get()]) {
            return Err("its checksum does not fit its content".into());
        }
        let other = key.is_some_and(|key| key != envelope.key.get());
        if other || path != self.path(envelope.key.get(), "json") {
            return Err("it is the result of something else".into());
        }
        serde_json::from_str(envelope.result.get()).map_err(|error| format!("no result: {error}"))
    }
}

/// Makes and locks a file; `None` if another process has locked it and `wait` is false.
fn lock(path: &Path, wait: bool) -> io::Result<Option<File>> {
    loop {
        if fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
            return Err(io::Error::other("it is no plain file: remove it"));
        }
        let lock = File::options().create(true).append(true).open(path)?;
        match if wait { lock.lock() } else { lock.try_lock().map_err(io::Error::from) } {
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => return Ok(None),
            locked => locked?,
        }
        // The process that had locked the file may have removed it, and a third process may have made another one.
        if leads_to(path, &lock) {
            return Ok(Some(lock));
        }
    }
}

/// Renames a file to the first free name after its own, and returns a message.
fn set_aside(path: &Path, reason: &str) -> anyhow::Result<String> {
    let name = path.file_name().unwrap_or_default();
    let mut aside = path.to_owned();
    for number in 1.. {
        let mut name = name.to_owned();
        name.push(format!(".aside{number}"));
        aside.set_file_name(name);
        if fs::symlink_metadata(&aside).is_err() {
            break;
        }
    }
    let (shown, reason) = (foreign::path(path), foreign::shown(reason));
    match fs::rename(path, &aside) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            return Err(error).with_context(|| format!("cannot rename `{shown}`: {reason}"));
        }
        _ => {}
    }
    Ok(format!("`{shown}` is not trusted: {reason}; it is now `{}`", foreign::path(&aside)))
}

/// Computes jobs on several threads, and returns their results in the order of the jobs. First calls `one` for each job without
/// waiting; `None` means that another process has claimed the job. Then calls `one` again for these jobs, waiting.
///
/// # Errors
/// The first error of `one`.
pub fn side_by_side<J: Sync, R: Send>(
    jobs: &[J],
    threads: NonZero<usize>,
    one: impl Fn(&J, bool) -> anyhow::Result<Option<R>> + Sync,
) -> anyhow::Result<Vec<R>> {
    let mut results: Vec<Option<R>> = jobs.iter().map(|_| None).collect();
    for wait in [false, true] {
        let left: Vec<usize> = (0..jobs.len()).filter(|&at| results[at].is_none()).collect();
        let next = AtomicUsize::new(0);
        let worker = || {
            let mut done = Vec::new();
            while let Some(&at) = left.get(next.fetch_add(1, Ordering::Relaxed)) {
                done.push((at, one(&jobs[at], wait)?));
            }
            anyhow::Ok(done)
        };
        let all = std::thread::scope(|scope| {
            let count = threads.get().min(left.len());
            let workers: Vec<_> = (0..count).map(|_| scope.spawn(worker)).collect();
            workers.into_iter().map(|worker| worker.join()).collect::<Vec<_>>()
        });
        for done in all {
            let done = done.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
            done.into_iter().for_each(|(at, result)| results[at] = result);
        }
    }
    // With waiting, every job has a result.
    Ok(results.into_iter().flatten().collect())
}

/// The digest of texts one after the other: 128 bits, in hexadecimal.
pub fn digest<const N: usize>(texts: [impl AsRef<[u8]>; N]) -> String {
    let mut digest = Digest::default();
    for text in texts {
        digest.add(text.as_ref());
        digest.add(&[0xff]);
    }
    digest.text()
}

/// A digest of 128 bits of the added pieces.
///
/// Fowler, Noll, Vo, Eastlake, "The FNV non-cryptographic hash algorithm", FNV-1a. It finds accidents, not attacks.
pub struct Digest(u128);

impl Default for Digest {
    fn default() -> Self {
        Digest(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Digest {
    /// Adds a piece.
    pub fn add(&mut self, bytes: &[u8]) {
        const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
        let step = |hash: u128, byte: &u8| (hash ^ u128::from(*byte)).wrapping_mul(PRIME);
        self.0 = bytes.iter().fold(self.0, step);
    }

    /// The digest, in hexadecimal.
    pub fn text(&self) -> String {
        format!("{:032x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A store with the results of two keys, in a folder of its own.
    fn store() -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().unwrap();
        let (store, set_aside) = Store::open(folder.path()).unwrap();
        assert!(set_aside.is_empty());
        store.save(&"one", &[0.1, 1.0 / 3.0]).unwrap();
        store.save(&"two", &[2.0]).unwrap();
        (folder, store)
    }

    fn file(store: &Store, key: &str) -> PathBuf {
        store.path(&serde_json::to_string(key).unwrap(), "json")
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_was_saved_is_there_to_the_bit() {
        let (folder, store) = store();
        assert_eq!(store.load(&"one").unwrap(), Entry::Stored(vec![0.1, 1.0 / 3.0]));
        assert_eq!(store.load::<Vec<f64>>(&"three").unwrap(), Entry::Missing);
        let (again, set_aside) = Store::open(folder.path()).unwrap();
        assert!(set_aside.is_empty());
        assert_eq!(again.load(&"two").unwrap(), Entry::Stored(vec![2.0]));
    }

    /// Applies each damage, and tests it once when opening the folder and once when loading the result.
    #[test]
    fn no_damaged_file_is_trusted_and_none_is_deleted() {
        let whole = |store: &Store| fs::read(file(store, "one")).unwrap();
        /// Makes a damaged file from the files of both results.
        type Damage = fn(&[u8], &[u8]) -> Vec<u8>;
        let damages: [(&str, Damage); 7] = [
            ("not a whole result", |one, _| one[..one.len() / 2].to_vec()),
            ("not a whole result", |_, _| Vec::new()),
            ("not a whole result", |_, _| vec![0xff, 0x00, 0x80]),
            ("not a whole result", |_, _| b"{\"speed\": 3}".to_vec()),
            ("its checksum does not fit", |one, _| {
                String::from_utf8_lossy(one).replace("0.1", "0.2").into_bytes()
            }),
            ("its format is", |one, _| {
                String::from_utf8_lossy(one).replace(FORMAT, "mms result 0").into_bytes()
            }),
            ("the result of something else", |_, two| two.to_vec()),
        ];
        for (complaint, damage) in damages {
            for reopen in [false, true] {
                let (folder, store) = store();
                let damaged = damage(&whole(&store), &fs::read(file(&store, "two")).unwrap());
                fs::write(file(&store, "one"), &damaged).unwrap();
                let said = match reopen {
                    true => Store::open(folder.path()).unwrap().1.join("\n"),
                    false => match store.load::<Vec<f64>>(&"one").unwrap() {
                        Entry::SetAside(said) => said,
                        other => panic!("{complaint}: {other:?}"),
                    },
                };
                let path = file(&store, "one").display().to_string();
                assert!(said.contains(complaint) && said.contains(&path), "{said}");
                assert_eq!(store.load::<Vec<f64>>(&"one").unwrap(), Entry::Missing);
                let aside = fs::read(format!("{path}.aside1")).unwrap();
                assert_eq!(aside, damaged, "kept as it was");
                assert_eq!(store.load(&"two").unwrap(), Entry::Stored(vec![2.0]));
            }
        }
    }

    #[test]
    fn files_set_aside_do_not_replace_each_other() {
        let (folder, store) = store();
        for content in ["first", "second", "third"] {
            fs::write(file(&store, "one"), content).unwrap();
            assert!(matches!(store.load::<Vec<f64>>(&"one").unwrap(), Entry::SetAside(_)));
        }
        let aside = names(folder.path()).into_iter().filter(|name| name.contains("aside"));
        let contents = aside.map(|name| fs::read_to_string(folder.path().join(name)).unwrap());
        assert_eq!(contents.collect::<Vec<_>>(), ["first", "second", "third"]);
    }

    /// Other files in the folder are not touched.
    #[test]
    fn what_does_not_look_like_a_result_is_left_alone() {
        let (folder, _) = store();
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        fs::write(folder.path().join("notes.json"), "{}").unwrap();
        fs::create_dir(folder.path().join("old.json")).unwrap();
        let (_, set_aside) = Store::open(folder.path()).unwrap();
        assert_eq!(set_aside.len(), 1, "{set_aside:?}");
        assert!(set_aside[0].contains("notes.json"));
        let names = names(folder.path());
        for name in ["notes.txt", "notes.json.aside1", "old.json"] {
            assert!(names.contains(&name.into()), "{name}");
        }
    }

    #[test]
    fn a_claim_is_one_process_alone_until_it_is_dropped() {
        let (folder, store) = store();
        let claim = store.claim(&"three", false).unwrap().expect("nobody has it");
        assert!(store.claim(&"three", false).unwrap().is_none());
        assert!(store.claim(&"four", false).unwrap().is_some());
        drop(claim);
        assert!(store.claim(&"three", true).unwrap().is_some());
        assert!(names(folder.path()).iter().all(|name| name.ends_with(".json")));
    }

    #[test]
    fn locks_that_nobody_holds_are_removed_and_others_stay() {
        let (folder, store) = store();
        let claim = store.claim(&"three", false).unwrap().expect("nobody has it");
        fs::write(folder.path().join("killed.lock"), "").unwrap();
        let locks = || names(folder.path()).into_iter().filter(|name| name.ends_with(".lock"));
        assert_eq!(locks().count(), 2);
        Store::open(folder.path()).unwrap();
        assert_eq!(locks().count(), 1);
        assert!(store.claim(&"three", false).unwrap().is_none());
        drop(claim);
        assert_eq!(locks().count(), 0);
    }

    /// One process at a time has a claim that is dropped again and again.
    #[test]
    fn a_lock_of_a_removed_file_is_no_claim() {
        let (_folder, store) = store();
        let holders = AtomicUsize::new(0);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        let claim = store.claim(&"three", true).unwrap().expect("it waits");
                        assert_eq!(holders.fetch_add(1, Ordering::SeqCst), 0);
                        std::thread::yield_now();
                        holders.fetch_sub(1, Ordering::SeqCst);
                        drop(claim);
                    }
                });
            }
        });
    }

    /// The test vectors of the algorithm's authors, apart from the byte that ends a text here.
    #[test]
    fn the_digest_is_that_of_its_authors() {
        assert_eq!(digest::<0>([] as [&str; 0]), "6c62272e07bb014262b821756295c58d");
        assert_eq!(digest(["ab", "c"]).len(), 32);
        assert_ne!(digest(["ab", "c"]), digest(["a", "bc"]));
    }
}
