//! Tables and sentences that reports share.

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};

/// A table without lines.
pub fn plain<const N: usize>(header: [&str; N]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header(header);
    table
}

/// A table with all columns aligned to the right.
pub fn to_the_right(mut table: Table) -> Table {
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// How many of all verdicts are not as expected; `expected` is how to say that, as in "as theory expects".
pub fn tally(unexpected: usize, all: usize, expected: &str) -> String {
    match (unexpected, all) {
        (0, 1) => format!("the verdict is {expected}"),
        (_, 1) => format!("the verdict is not {expected}"),
        (0, all) => format!("all {all} verdicts are {expected}"),
        (1, all) => format!("1 of {all} verdicts is not {expected}"),
        (several, all) => format!("{several} of {all} verdicts are not {expected}"),
    }
}
