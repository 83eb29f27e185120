//! The formats of files, which are recognised by their content. Each reader names the description of its format.

mod dump;
mod frd;
mod gmsh;
mod gmsh_mesh;
mod gmsh_order;
#[cfg(feature = "hdf5")]
mod hdf5;
#[cfg(not(feature = "hdf5"))]
#[path = "without_hdf5.rs"]
mod hdf5;
mod mat;
mod npy;
mod npz;
mod numbers;
mod series;
mod table;
mod tags;
mod tecplot;
mod text;
mod vtk;
mod xdmf;
mod xml;

pub use table::is_time;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::wanted::Wanted;
use crate::{Mistake, Snapshot, Time};

/// The function that opens files, and the selection of their arrays.
type Opened<'a> = (Open<'a>, &'a Wanted<'a>);

/// The contents of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Contents {
    /// Results, at one time or more.
    Snapshots(Vec<Snapshot>),
    /// The files of the pieces of one mesh at one time.
    Pieces(Vec<String>),
    /// The files of blocks of one mesh at one time, which may have different arrays.
    Blocks(Vec<String>),
    /// The files of one mesh at times; several files at one time are pieces.
    Times(Vec<(Time, String)>),
}

/// The most files in a list.
const MOST_FILES: usize = 50_000;

/// The beginnings of formats that are not supported, and advice.
const FOREIGN: &[(&[u8], &str)] = &[
    (b"\x1f\x8b", "a file in gzip is not read; unpack it"),
    (
        b"$NOD",
        "version 1 of Gmsh's format is not read; write 4.1, as with `Mesh.MshFileVersion = 4.1`",
    ),
    (b"*HEADING", "an input file of Abaqus has no results; write these as a table or as VTK"),
    (b"*Heading", "an input file of Abaqus has no results; write these as a table or as VTK"),
    (b"OFF\n", "a mesh in OFF has no results; write a table or VTK"),
    (b"ply\n", "a mesh in PLY has no results; write a table or VTK"),
    (b"MeshVersionFormatted", "a mesh of Medit has no results; write a table or VTK"),
    (b"ADIOS-BP", "ADIOS2 is not read; write XDMF, as with `dolfinx.io.XDMFFile`, or VTK"),
];

/// The beginning of an HDF5 file, possibly after a user block.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// The lengths of user blocks that are searched.
const USER_BLOCKS: [usize; 6] = [0, 512, 1024, 2048, 4096, 8192];

/// Whether bytes are HDF5, or netCDF in its classic format.
fn is_store(bytes: &[u8]) -> bool {
    let is_behind = |at: &usize| bytes.get(*at..).is_some_and(|it| it.starts_with(HDF5));
    bytes.starts_with(b"CDF") || USER_BLOCKS.iter().any(is_behind)
}

/// Opens a file that another one names.
type Beside<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, Mistake>;

/// Reads the wanted data from bytes of any supported format.
///
/// # Errors
/// Damaged bytes, or a format that is not read.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Contents, Mistake> {
    let alone = |file: &str| {
        Err(Mistake::new(format!(
            "its numbers are in the file `{file}`, which is not given with it"
        )))
    };
    parse_beside(Cow::Borrowed(bytes), wanted, &alone)
}

/// The bytes of a file with an unknown format.
struct Source<'a> {
    /// All bytes.
    bytes: &'a [u8],
    /// The bytes after a byte order mark and blanks.
    start: &'a [u8],
    wanted: &'a Wanted<'a>,
    beside: Beside<'a>,
}

/// A format.
struct Format {
    /// The common name.
    name: &'static str,
    /// Whether bytes are of this format.
    is: fn(&Source<'_>) -> bool,
    /// The reader of the format.
    read: fn(&Source<'_>) -> Result<Contents, Mistake>,
}

/// The formats, in the order in which they are tried.
const FORMATS: &[Format] = &[
    Format {
        name: "an array of NumPy",
        is: |it| it.bytes.starts_with(npy::MAGIC),
        read: |it| npy::parse(it.bytes, it.wanted).map(one),
    },
    Format {
        name: "an archive of NumPy",
        is: |it| it.bytes.starts_with(b"PK"),
        read: |it| npz::parse(it.bytes, it.wanted).map(Contents::Snapshots),
    },
    Format {
        name: "MATLAB",
        is: |it| it.bytes.starts_with(mat::MAGIC),
        read: |it| mat::parse(it.bytes, it.wanted).map(one),
    },
    Format {
        name: "MATLAB, version 4",
        is: |it| mat::is_version_4(it.bytes),
        read: |it| mat::parse_version_4(it.bytes, it.wanted).map(one),
    },
    Format {
        name: "legacy VTK",
        is: |it| it.start.starts_with(b"# vtk DataFile"),
        read: |it| vtk::legacy::parse(it.bytes, it.wanted).map(one),
    },
    Format {
        name: "XDMF",
        is: |it| it.start.starts_with(b"<") && xml::is_xdmf(it.start),
        read: |it| xml::parse(it.bytes, it.wanted, it.beside),
    },
    Format {
        name: "VTK in XML",
        is: |it| it.start.starts_with(b"<"),
        read: |it| xml::parse(it.bytes, it.wanted, it.beside),
    },
    Format {
        name: "a series of ParaView",
        is: |it| vtk::lists::is_series(it.start),
        read: |it| vtk::lists::series(it.bytes, it.wanted),
    },
    Format {
        name: "Tecplot",
        is: |it| tecplot::is_tecplot(it.start),
        read: |it| tecplot::parse(it.bytes, it.wanted).map(Contents::Snapshots),
    },
    Format {
        name: "a dump of LAMMPS or Karamelo",
        is: |it| it.start.starts_with(dump::MARK),
        read: |it| dump::parse(it.bytes, it.wanted).map(Contents::Snapshots),
    },
    Format {
        name: "Gmsh",
        is: |it| it.start.starts_with(gmsh::MARK),
        read: |it| gmsh::parse(it.bytes, it.wanted).map(Contents::Snapshots),
    },
    Format {
        name: "CalculiX",
        is: |it| frd::is_frd(it.bytes),
        read: |it| frd::parse(it.bytes, it.wanted).map(Contents::Snapshots),
    },
];

/// The format of a text in no other format.
const TABLE: Format = Format {
    name: "a table",
    is: |_| true,
    read: |it| table::parse(it.bytes, it.wanted).map(Contents::Snapshots),
};

/// HDF5 and netCDF take ownership of the bytes, because these may be many.
const STORE: &str = "HDF5 or netCDF";

fn one(snapshot: Snapshot) -> Contents {
    Contents::Snapshots(vec![snapshot])
}

/// Reads the wanted data from bytes, and from the files beside them that they name.
fn parse_beside(
    bytes: Cow<'_, [u8]>,
    wanted: &Wanted<'_>,
    beside: Beside<'_>,
) -> Result<Contents, Mistake> {
    let named = |name: &'static str, mut found: Contents| {
        if let Contents::Snapshots(all) = &mut found {
            all.iter_mut().for_each(|it| it.format = name);
        }
        found
    };
    if is_store(&bytes) {
        return Ok(named(STORE, Contents::Snapshots(hdf5::parse(bytes, wanted)?)));
    }
    let bytes = &*bytes;
    if let Some((_, what)) = FOREIGN.iter().find(|(start, _)| bytes.starts_with(start)) {
        return Err(Mistake::new(*what));
    }
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if start.is_empty() {
        return Err(Mistake::new("the file is empty"));
    }
    let source = Source { bytes, start, wanted, beside };
    let format = FORMATS.iter().find(|it| (it.is)(&source)).unwrap_or(&TABLE);
    Ok(named(format.name, (format.read)(&source)?))
}

/// Opens a file of at most this many bytes, or returns the reason why it cannot.
pub type Open<'a> = &'a dyn Fn(&Path, u64) -> Result<Vec<u8>, String>;

/// Reads the wanted data from a file, and from the files that it lists.
///
/// # Errors
/// A mistake with its file and line.
pub fn read(path: &Path, open: Open<'_>, wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let open = (open, wanted);
    let name = path.to_string_lossy();
    let beside = |file: &str| path.with_file_name(file);
    let found = match contents(path, open)? {
        Contents::Snapshots(snapshots) => Ok(snapshots),
        Contents::Times(files) => times(&files, &beside, open),
        list => joined(list, &beside, open).map(|one| vec![one]),
    };
    let mut found = found.map_err(|mistake| mistake.of(&name))?;
    for snapshot in found.iter_mut().filter(|it| it.path.is_empty()) {
        snapshot.path = name.clone().into_owned();
    }
    Ok(found)
}

fn contents(path: &Path, open: Opened<'_>) -> Result<Contents, Mistake> {
    let name = path.to_string_lossy();
    let (open, wanted) = open;
    let bytes = open(path, wanted.room()).map_err(|what| Mistake::new(what).of(&name))?;
    let beside = |file: &str| {
        if Path::new(file).is_absolute() {
            let what =
                format!("the file `{file}`: expected a path from the folder of this file on");
            return Err(Mistake::new(what));
        }
        let path = path.with_file_name(file);
        open(&path, wanted.room()).map_err(|what| Mistake::new(what).of(&path.to_string_lossy()))
    };
    let found =
        wanted.with_reserved(bytes.len(), || parse_beside(Cow::Owned(bytes), wanted, &beside));
    found.map_err(|mistake| mistake.of(&name))
}

/// Reads the one mesh of a file in a list: lists of lists end with the pieces of a time.
fn listed(path: &Path, open: Opened<'_>) -> Result<Snapshot, Mistake> {
    let list = contents(path, open)?;
    let name = path.to_string_lossy();
    let found = joined(list, &|file| path.with_file_name(file), open);
    let found = found.map_err(|mistake| mistake.of(&name))?;
    Ok(Snapshot { path: name.into_owned(), ..found })
}

/// Joins one mesh at one time from a file and the files in its list: times list blocks, and blocks list pieces.
fn joined(
    found: Contents,
    beside: &dyn Fn(&str) -> PathBuf,
    open: Opened<'_>,
) -> Result<Snapshot, Mistake> {
    let several = || Mistake::new("expected one mesh at one time, as it is in a list");
    match found {
        Contents::Snapshots(mut all) => {
            let time = |it: &Snapshot| it.time.map(|time| time.value);
            match all.windows(2).all(|pair| time(&pair[0]) == time(&pair[1])) {
                true if all.len() == 1 => Ok(all.remove(0)),
                true => Snapshot::join(all),
                false => Err(several()),
            }
        }
        Contents::Pieces(files) => {
            let piece = |file: &String| match contents(&beside(file), open)? {
                found @ Contents::Snapshots(_) => joined(found, beside, open),
                _ => Err(Mistake::new(format!("the piece `{file}` is itself a list of files"))),
            };
            Snapshot::join(files.iter().map(piece).collect::<Result<_, _>>()?)
        }
        Contents::Blocks(files) => {
            let block = |file: &String| {
                let path = beside(file);
                match contents(&path, open)? {
                    Contents::Blocks(_) => {
                        Err(Mistake::new(format!("the block `{file}` is itself a list of blocks")))
                    }
                    found => joined(found, &|file| path.with_file_name(file), open)
                        .map_err(|mistake| mistake.of(&path.to_string_lossy())),
                }
            };
            Snapshot::join_blocks(files.iter().map(block).collect::<Result<_, _>>()?)
        }
        Contents::Times(_) => Err(several()),
    }
}

fn times(
    files: &[(Time, String)],
    beside: &dyn Fn(&str) -> PathBuf,
    open: Opened<'_>,
) -> Result<Vec<Snapshot>, Mistake> {
    let mut found: Vec<Vec<Snapshot>> = Vec::new();
    for (time, file) in files {
        let snapshot = Snapshot { time: Some(*time), ..listed(&beside(file), open)? };
        let is_same = |it: &&mut Vec<Snapshot>| it[0].time.map(|it| it.value) == Some(time.value);
        match found.last_mut().filter(is_same) {
            Some(parts) => parts.push(snapshot),
            None => found.push(vec![snapshot]),
        }
    }
    let whole = |mut parts: Vec<Snapshot>| match parts.len() {
        1 => Ok(parts.remove(0)),
        _ => {
            let (path, time) = (parts[0].path.clone(), parts[0].time);
            let whole = Snapshot::join_blocks(parts).map_err(|mistake| mistake.of(&path))?;
            Ok(Snapshot { path, time, ..whole })
        }
    };
    found.into_iter().map(whole).collect()
}
