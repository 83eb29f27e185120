//! Writes `docs/stability.md`, what is known of the stability of each field of the gallery, to stdout:
//! `cargo run -p mms-stability --example gallery > docs/stability.md`; a minute.

mod table;

fn main() {
    print!("{}", table::page());
}
