//! The errors of every field of the gallery, in every regime: writes the page `docs/accuracy.md` to
//! stdout. An argument is the number of points and times, 1000 by default.
//!
//! ```console
//! $ cargo run --release --example accuracy > docs/accuracy.md
//! ```

mod sample;
mod table;

fn main() {
    let points = match std::env::args().nth(1).map(|text| text.parse()) {
        None => 1000,
        Some(Ok(points)) if points > 0 => points,
        Some(_) => {
            eprintln!("error: expected the number of points, such as 1000");
            std::process::exit(2);
        }
    };
    print!("{}", table::page(points, |field| eprintln!("{field}")));
}
