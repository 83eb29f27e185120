//! From what a user names to snapshots: a file, a list, a folder, a pattern.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use mms_files::machine::memory;
use mms_files::read::{self, Kind, cannot_read};
use mms_results::own::{self, LeftOut};
use mms_results::wanted::Wanted;
use mms_results::{Mistake, Snapshot};
use mms_spec::foreign;

/// The ends of files that list pieces of one mesh; the pieces are no meshes of their own.
const PIECES: &[&str] = &["vtm", "vtpc", "pvtu", "pvtp", "pvti", "pvtr", "pvts"];

/// The ends of files of results, in groups: a folder with files of one group is not searched for the next.
const ENDS: [&[&str]; 2] = [
    &["vtu", "vtp", "vti", "vtr", "vts", "vtk", "npz", "npy", "csv", "tsv"],
    &["xdmf", "vtkhdf", "e", "exo", "h5", "hdf5", "nc", "mat", "frd", "msh", "dat", "tec", "dump"],
];

/// The results of one mesh, at one time or more.
#[derive(Debug)]
pub struct Results {
    /// What the user named.
    pub name: String,
    /// The snapshots, in the order of their times.
    pub snapshots: Vec<Snapshot>,
}

impl Results {
    /// The files that are named.
    ///
    /// # Errors
    /// There are none.
    pub fn paths(given: &str) -> anyhow::Result<Vec<PathBuf>> {
        let found = paths(given)?;
        match found.iter().find(|path| !path.is_file()) {
            Some(path) => bail!("`{}`: no such file", foreign::path(path)),
            None => Ok(found),
        }
    }

    /// Reads what is wanted of what was named.
    ///
    /// # Errors
    /// Nothing there, or what is wrong with a file, and where; more than there is memory for.
    pub fn find(given: &str, wanted: &Wanted<'_>) -> anyhow::Result<Results> {
        let mut snapshots = Vec::new();
        for path in paths(given)? {
            let open = |path: &Path, room: u64| {
                read::bytes_within(path, Kind::Results, room)
                    .map_err(|error| format!("cannot read it: {error}"))
            };
            snapshots.extend(mms_results::read(&path, &open, wanted).map_err(placed)?);
        }
        snapshots.sort_by(|a, b| moment(a).total_cmp(&moment(b)));
        Ok(Results { name: given.to_owned(), snapshots })
    }

    /// Keeps the last result alone, without its time: the results before it are steps on the way to a static field.
    pub fn keep_last(&mut self) {
        self.snapshots.drain(..self.snapshots.len().saturating_sub(1));
        self.snapshots.iter_mut().for_each(|it| it.time = None);
    }

    /// Leaves out ghosts, and cells that stand there twice; returns how many there are in the first snapshot.
    ///
    /// # Errors
    /// A cell that stands there twice, with other values.
    pub fn keep_own(&mut self) -> anyhow::Result<LeftOut> {
        let mut all = Vec::new();
        for snapshot in &mut self.snapshots {
            all.push(own::keep(snapshot).map_err(placed)?);
        }
        Ok(all.first().copied().unwrap_or_default())
    }
}

/// The memory that reading may take: so many MB, or what is free; and what to do where that is too little.
pub fn room(most: Option<u64>) -> (u64, &'static str) {
    let bytes = most.map_or_else(memory, |most| most.saturating_mul(1_000_000));
    (bytes, "read fewer quantities with `--quantity`, or allow more with `--max-memory MB`")
}

fn moment(snapshot: &Snapshot) -> f64 {
    snapshot.time.map_or(f64::NEG_INFINITY, |time| time.value)
}

/// A mistake as the command says it.
pub fn placed(mistake: Mistake) -> anyhow::Error {
    anyhow!("{mistake}")
}

/// The files that are named, in the order of their names.
fn paths(given: &str) -> anyhow::Result<Vec<PathBuf>> {
    let path = Path::new(given);
    if path.is_dir() {
        return folder(path);
    }
    if path.exists() || !given.contains(['*', '?', '[']) {
        return Ok(vec![path.to_owned()]);
    }
    let found = glob::glob(given).with_context(|| format!("`{given}`: not a pattern"))?;
    let found: Vec<_> = found.filter_map(Result::ok).filter(|path| path.is_file()).collect();
    if found.is_empty() {
        bail!("`{given}`: no file fits the pattern");
    }
    Ok(found)
}

/// The list of states of a folder, or its files of results.
fn folder(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let entries = path.read_dir().with_context(|| cannot_read(path))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|it| it.ok().map(|it| it.path())).collect();
    files.sort();
    let ending = |end: &str| -> Vec<PathBuf> {
        let fits =
            |file: &&PathBuf| file.extension().is_some_and(|it| it.eq_ignore_ascii_case(end));
        files.iter().filter(fits).cloned().collect()
    };
    let of = |ends: &[&str]| -> Vec<PathBuf> { ends.iter().flat_map(|it| ending(it)).collect() };
    let lists = of(&["pvd", "series"]);
    if lists.len() > 1 {
        bail!(
            "`{}`: it holds {} lists of states (.pvd, .series); name one of them",
            foreign::path(path),
            lists.len()
        );
    }
    let groups = [lists, of(PIECES)].into_iter().chain(ENDS.map(of));
    groups.into_iter().find(|it| !it.is_empty()).ok_or_else(|| {
        let known = ENDS.concat().iter().map(|it| format!(".{it}")).collect::<Vec<_>>().join(", ");
        anyhow!("`{}`: it holds no results: expected {known}", foreign::path(path))
    })
}
