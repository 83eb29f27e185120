//! From names of files to snapshots.

use std::path::Path;

use anyhow::{Error, anyhow};
use mms_results::own::{self, LeftOut};
use mms_results::wanted::Wanted;
use mms_results::{Files, Mistake, Snapshot};

/// The results of one mesh, at one time or more.
#[derive(Debug)]
pub struct Results {
    /// The name that the user gave.
    pub name: String,
    /// The snapshots, in the order of their times.
    pub snapshots: Vec<Snapshot>,
}

impl Results {
    /// Reads the wanted content of the files of a name.
    ///
    /// # Errors
    /// No file of this name; a file that cannot be read, and where; more content than memory.
    pub fn find(given: &str, wanted: &Wanted<'_>, files: &dyn Files) -> anyhow::Result<Results> {
        let mut snapshots = Vec::new();
        let open = |path: &Path, room: u64| files.bytes(path, room);
        for path in files.paths(given).map_err(Error::from_boxed)? {
            snapshots.extend(mms_results::read(&path, &open, wanted).map_err(placed)?);
        }
        snapshots.sort_by(|a, b| moment(a).total_cmp(&moment(b)));
        Ok(Results { name: given.to_owned(), snapshots })
    }

    /// Keeps only the last result, without its time: earlier results are iterations towards a static field.
    pub fn keep_last(&mut self) {
        self.snapshots.drain(..self.snapshots.len().saturating_sub(1));
        self.snapshots.iter_mut().for_each(|it| it.time = None);
    }

    /// Removes ghosts and duplicate cells; returns how many there are in the first snapshot.
    ///
    /// # Errors
    /// A duplicate cell with different values.
    pub fn keep_own(&mut self) -> anyhow::Result<LeftOut> {
        let mut all = Vec::new();
        for snapshot in &mut self.snapshots {
            all.push(own::keep(snapshot).map_err(placed)?);
        }
        Ok(all.first().copied().unwrap_or_default())
    }
}

/// The bytes of memory for reading, `most` in MB or all that is free; and advice if that is too little.
pub fn room(most: Option<u64>, files: &dyn Files) -> (u64, &'static str) {
    let bytes = most.map_or_else(|| files.memory(), |most| most.saturating_mul(1_000_000));
    (bytes, "read fewer quantities with `--quantity`, or allow more with `--max-memory MB`")
}

fn moment(snapshot: &Snapshot) -> f64 {
    snapshot.time.map_or(f64::NEG_INFINITY, |time| time.value)
}

/// The error of a mistake in results.
pub fn placed(mistake: Mistake) -> anyhow::Error {
    anyhow!("{mistake}")
}
