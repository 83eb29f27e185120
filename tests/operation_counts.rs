//! The page of operation counts equals the output of its command.

#[path = "../examples/operation_counts/table.rs"]
mod table;

#[test]
fn the_page_is_what_its_command_writes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/operation-counts.md");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        committed == table::page(),
        "docs/operation-counts.md is out of date; after a look at the difference, commit what this writes:\n    \
         cargo run --example operation_counts > docs/operation-counts.md"
    );
}
