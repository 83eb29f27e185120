//! Replaces the reader of HDF5 and netCDF if the feature `hdf5` is off, and explains how to enable it.

use std::borrow::Cow;
use std::marker::PhantomData;

use crate::wanted::Wanted;
use crate::{Array, Mistake, Snapshot};

/// Explains what is needed to read such a file.
pub fn parse(bytes: Cow<'_, [u8]>, _: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    Err(refused(&bytes))
}

fn refused(bytes: &[u8]) -> Mistake {
    let (name, other) = match bytes {
        [b'C', b'D', b'F', ..] => (
            "NetCDF, as of Exodus,",
            "`meshio convert results.e results.vtu` of Python's meshio[all] makes VTK of the first time of Exodus, and \
             `numpy.savez` writes what `netCDF4.Dataset` reads",
        ),
        [b'M', b'A', b'T', ..] => {
            ("MATLAB 7.3, which is HDF5,", "in Python, `numpy.savez` writes what `h5py.File` reads")
        }
        _ => ("HDF5", "in Python, `numpy.savez` writes what `h5py.File` reads"),
    };
    Mistake::new(format!(
        "{name} is read with the feature `hdf5`: `cargo install --path . --features hdf5`; or convert it: {other}"
    ))
}

/// A file that is not opened.
pub struct File<'a>(PhantomData<&'a ()>);

impl<'a> File<'a> {
    /// Explains what is needed to read such a file.
    pub fn open(bytes: Vec<u8>, _: &'a Wanted<'a>) -> Result<File<'a>, Mistake> {
        drop(bytes);
        Err(Mistake::new(
            "numbers of XDMF in HDF5 are read with the feature `hdf5`: `cargo install --path . --features hdf5`; or \
             convert it: `meshio.xdmf.TimeSeriesReader` of Python's meshio[all] reads its steps, and `meshio.write` writes VTK",
        ))
    }

    /// Finds no array.
    pub fn at(&self, path: &str) -> Result<Array, Mistake> {
        Err(Mistake::new(format!("`{path}` is not read")))
    }
}
