//! The page of the stability of the gallery equals the output of its command.

#[path = "../examples/gallery/table.rs"]
mod table;

use std::path::{Path, PathBuf};

use crate::sampled::sampled;

#[test]
fn the_page_has_the_rows_that_its_command_writes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/stability.md");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    let mut rows = committed.lines().skip_while(|line| !line.starts_with("|---")).skip(1);
    let files = table::files();
    let of_field = |row: Option<&str>, path: &Path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        row.is_some_and(|row| row.starts_with(&format!("| {stem} |")))
    };
    let is_listed = files.iter().all(|path| of_field(rows.next(), path)) && rows.next().is_none();
    let is_right = |path: &PathBuf| committed.contains(&table::row(path));
    // The column can move at the lower and the upper end of two axes, and at the corners between them.
    let column = files.iter().filter(|path| path.ends_with("twisted_column.toml"));
    let mut tried = sampled(&files, 12).into_iter().chain(column);
    assert!(
        is_listed && tried.all(is_right),
        "docs/stability.md is out of date; after a look at the difference, commit what this writes:\n    \
         cargo run -p mms-stability --example gallery > docs/stability.md"
    );
}
