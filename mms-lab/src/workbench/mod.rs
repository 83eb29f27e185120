//! Compiles emitted code and runs it, to measure its cost on this machine.
//!
//! The workbench is a temporary folder with `mms-math`, whose sources are embedded, compiled by the user's `rustc`; all
//! contenders take turns. Nothing else is needed, and nothing is downloaded. Without a `rustc`, times are null, and a message
//! on stderr says why. The workbench also compiles the functions called for a quantity to an object file of its own, whose
//! instructions `examples/scene/` counts.

mod code;
mod module;
mod timing;

use std::ffi::OsStr;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, bail};
use mms_spec::foreign;
use tempfile::TempDir;

pub use code::object;
pub use module::{Module, ModuleForm};
pub use timing::{Time, time};

/// The sources of `mms-math`: paths below `src/`, and texts.
const MATH: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/math.rs"));

/// The user's compiler, on the PATH.
const RUSTC: &str = "rustc";

/// A folder with a compiled `mms-math`.
pub struct Workbench {
    folder: TempDir,
    compiler: String,
}

impl Workbench {
    /// Compiles `mms-math`; an error says why there is no workbench here.
    pub fn open() -> anyhow::Result<Self> {
        if MATH.is_empty() {
            bail!("this program was built without the sources of mms-math");
        }
        let version = Command::new(RUSTC).arg("--version").output();
        let Some(version) = version.ok().filter(|output| output.status.success()) else {
            bail!("no `rustc` on the PATH to compile emitted code with");
        };
        // Behind its name and number are a hash and a date.
        let version = String::from_utf8_lossy(&version.stdout);
        let compiler = version.split_whitespace().take(2).collect::<Vec<_>>().join(" ");
        let bench = Workbench { folder: tempfile::tempdir()?, compiler };
        for (path, text) in MATH {
            bench.write(&format!("mms_math/{path}"), text)?;
        }
        let std = ["--cfg", "feature=\"std\"", "--crate-type", "rlib"];
        bench.compile("mms_math/lib.rs", "libmms_math.rlib", &std)?;
        Ok(bench)
    }

    /// The name of the compiler and its version.
    pub fn compiler(&self) -> &str {
        &self.compiler
    }

    /// Writes a source file, and the folders above it.
    fn write(&self, name: &str, text: &str) -> anyhow::Result<()> {
        let path = self.folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        #[expect(
            clippy::disallowed_methods,
            reason = "the folder is new, and goes with the program"
        )]
        let written = fs::write(&path, text);
        written.with_context(|| format!("cannot write `{}`", foreign::path(&path)))
    }

    /// Compiles a crate of this folder in release mode.
    fn compile(&self, source: &str, output: &str, options: &[&str]) -> anyhow::Result<PathBuf> {
        let output = self.folder.path().join(output);
        let mut command = Command::new(RUSTC);
        command
            .current_dir(self.folder.path())
            .args(["--edition", "2024", "--cap-lints", "allow", "-C", "opt-level=3"])
            .args(options)
            .arg("-o")
            .arg(&output)
            .arg(source);
        if source != "mms_math/lib.rs" {
            command.args(["--extern", "mms_math=libmms_math.rlib"]);
        }
        let result = command.output().context("cannot start `rustc`")?;
        if !result.status.success() {
            let text = String::from_utf8_lossy(&result.stderr);
            let lines: Vec<&str> = text.lines().take(20).collect();
            bail!("`rustc` refuses the emitted code:\n{}", lines.join("\n"));
        }
        Ok(output)
    }

    /// Compiles a program, runs it on `input`, and returns its output.
    fn run(&self, source: &str, input: &str) -> anyhow::Result<String> {
        let program = self.compile(source, "program", &["--crate-name", "program"])?;
        self.output_of(program.as_os_str(), input)
    }

    fn output_of(&self, program: &OsStr, input: &str) -> anyhow::Result<String> {
        let mut child = Command::new(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .context("cannot start the compiled program")?;
        // It reads everything before it writes.
        child.stdin.take().context("no pipe")?.write_all(input.as_bytes())?;
        let output = child.wait_with_output()?;
        if !output.status.success() {
            bail!("the compiled program stopped: {}", output.status);
        }
        Ok(String::from_utf8(output.stdout)?)
    }
}
