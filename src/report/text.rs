//! Words, tables and files that reports share.

use std::path::Path;

use anyhow::Context as _;
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};
use mms_files::write::write_own;
use mms_spec::foreign;

/// Writes texts to files of one stem in a folder, which is made if there is none, by their extensions; returns
/// their paths.
pub(crate) fn write_files<const N: usize>(
    folder: &Path,
    stem: &str,
    files: [(&str, String); N],
) -> anyhow::Result<Vec<String>> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder `{}`", foreign::path(folder)))?;
    let write = |(extension, content): (&str, String)| {
        let path = folder.join(stem).with_extension(extension);
        let shown = foreign::path(&path);
        write_own(&path, &content).with_context(|| format!("cannot write `{shown}`"))?;
        Ok(shown)
    };
    files.into_iter().map(write).collect()
}

/// A document as the content of a file.
pub(crate) fn pretty(document: &impl serde::Serialize) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// A table without lines.
pub(crate) fn plain<const N: usize>(header: [&str; N]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header(header);
    table
}

/// A table with all columns aligned to the right.
pub(crate) fn to_the_right(mut table: Table) -> Table {
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// How many of all verdicts are not as expected; `expected` is how to say that, as in "as theory expects".
pub(crate) fn tally(unexpected: usize, all: usize, expected: &str) -> String {
    match (unexpected, all) {
        (0, 1) => format!("the verdict is {expected}"),
        (_, 1) => format!("the verdict is not {expected}"),
        (0, all) => format!("all {all} verdicts are {expected}"),
        (1, all) => format!("1 of {all} verdicts is not {expected}"),
        (several, all) => format!("{several} of {all} verdicts are not {expected}"),
    }
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
