//! Writes `docs/stability.md`, the stability of each field of the gallery, to stdout: `cargo run -p mms-stability --example
//! gallery > docs/stability.md`; takes a minute.

mod table;

fn main() {
    print!("{}", table::page());
}
