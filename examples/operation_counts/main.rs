//! How much code a field takes, and how little where less is asked for: writes the page
//! `docs/operation-counts.md` to stdout.
//!
//! ```console
//! $ cargo run --example operation_counts > docs/operation-counts.md
//! ```

mod table;

fn main() {
    print!("{}", table::page());
}
