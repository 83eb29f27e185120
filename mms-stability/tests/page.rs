//! The page of the stability of the gallery is what its command writes.

#[path = "../examples/gallery/table.rs"]
mod table;

#[test]
fn the_page_is_what_its_command_writes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/stability.md");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        committed == table::page(),
        "docs/stability.md is out of date; after a look at the difference, commit what this writes:\n    \
         cargo run -p mms-stability --example gallery > docs/stability.md"
    );
}
