//! Writes the page `docs/scene.md` to stdout: the cost of a field, and of the parts that a scene requires. Compiles the emitted
//! code with the `rustc` on the PATH, and takes some minutes.
//!
//! ```console
//! $ cargo run --release --example scene > docs/scene.md
//! ```

mod cost;
mod page;
mod table;

fn main() -> anyhow::Result<()> {
    print!("{}", page::page(|title| eprintln!("{title}"))?);
    Ok(())
}
