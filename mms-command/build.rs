//! Writes the solver of `mms demo` with its mistake.

#[path = "src/cli/demo/mistake.rs"]
mod mistake;

use std::path::PathBuf;
use std::{env, fs, io};

const SOLVER: &str = "src/cli/demo/solver.rs";

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    for path in ["build.rs", SOLVER, "src/cli/demo/mistake.rs"] {
        println!("cargo::rerun-if-changed={path}");
    }
    let solver = fs::read_to_string(root.join(SOLVER))?;
    assert_eq!(solver.matches(mistake::RIGHT).count(), 1, "{} in {SOLVER}", mistake::RIGHT);
    fs::write(out.join("broken_solver.rs"), solver.replace(mistake::RIGHT, mistake::WRONG))
}
