//! Writes the page `docs/operation-counts.md` to stdout: the operations and the code of a field, for all quantities and for some.
//!
//! ```console
//! $ cargo run --example operation_counts > docs/operation-counts.md
//! ```

mod table;

fn main() {
    print!("{}", table::page());
}
