//! What the command says of runs and studies: tables, JSON documents, CSV files and pictures.

pub mod accuracy;
pub(crate) mod extremes;
mod front;
pub(crate) mod method;
mod picture;
pub mod run;
mod study;
pub(crate) mod tradeoff;

pub use study::{Refused, Study};

use std::io::Write as _;
use std::path::Path;

/// Never leaves half a file under its final name.
pub(crate) fn write_whole(path: &Path, content: &str) -> anyhow::Result<()> {
    let mut file = builder().tempfile_in(path.parent().unwrap_or(Path::new(".")))?;
    file.write_all(content.as_bytes())?;
    file.persist(path)?;
    Ok(())
}

/// A temporary file is private by default; these are results, as open as any other file.
fn builder() -> tempfile::Builder<'static, 'static> {
    #[cfg_attr(not(unix), allow(unused_mut))]
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

/// Seconds for a person.
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-4 => format!("{:.0} us", s * 1e6),
        s if s < 1.0 => format!("{:.1} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}

/// Bytes for a person.
pub(crate) fn bytes(count: f64) -> String {
    let (unit, size) = match count {
        c if c < 1e6 => ("kB", 1e3),
        c if c < 1e9 => ("MB", 1e6),
        _ => ("GB", 1e9),
    };
    format!("{:.1} {unit}", count / size)
}
