//! What modelling only what a scene requires saves: writes the page `docs/scene.md` to stdout. It
//! compiles what is emitted with the `rustc` on the PATH, and takes some minutes.
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
