//! The reference page and the stored schemas are made of the types.

use std::path::Path;

use mms_documents::schema::{schemas, tables};

/// The line of the page that its tables follow.
const MARK: &str = "<!-- The tables below are made of the types in mms-documents. -->\n";

/// Compares a file with its new text. If `MMS_WRITE_PAGES=1`, writes the file instead.
fn hold(name: &str, text: impl FnOnce(&str) -> String) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name);
    let old = std::fs::read_to_string(&path).unwrap_or_default();
    let new = text(&old);
    if std::env::var_os("MMS_WRITE_PAGES").is_some() {
        std::fs::write(&path, new).expect("a written file");
    } else {
        assert!(
            old == new,
            "{name} is not what the types say; write it with\n    \
             MMS_WRITE_PAGES=1 cargo test -p mms-documents --features schema"
        );
    }
}

#[test]
fn the_page_has_the_tables_of_the_types() {
    hold("docs/reference/json.md", |old| {
        let (head, _) = old.split_once(MARK).expect("a page with its mark");
        format!("{head}{MARK}{}", tables(&schemas()))
    });
}

#[test]
fn the_stored_schemas_are_those_of_the_types() {
    hold("docs/documents.schema.json", |_| {
        serde_json::to_string_pretty(&schemas()).expect("JSON") + "\n"
    });
}
