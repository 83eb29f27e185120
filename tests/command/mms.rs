//! Runs the program, and reads its output.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

use super::sampled::is_tried;

/// The text of the gallery's bar.
pub const BAR: &str = include_str!("../../fields/bar_1d.toml");

/// A folder that is removed at the end, and the working directory of the program.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Folder(tempfile::tempdir().expect("a temporary folder"))
    }

    /// A folder with a copy of the gallery's bar.
    pub fn with_bar(name: &str) -> Self {
        let folder = Folder::new();
        folder.write(name, BAR);
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file, and the folders above it.
    pub fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).expect("a folder");
        fs::write(path, text).expect("a written file");
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Runs `mms` with these arguments, separated by blanks.
    pub fn mms(&self, arguments: &str) -> Run {
        self.run(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs `mms` with these arguments.
    pub fn run(&self, arguments: &[impl AsRef<OsStr>]) -> Run {
        self.run_with(arguments, |command| command)
    }

    /// Runs `mms` with these arguments, in an environment that `change` prepares.
    pub fn run_with(
        &self,
        arguments: &[impl AsRef<OsStr>],
        change: impl FnOnce(&mut Command) -> &mut Command,
    ) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mms"));
        let command = change(command.args(arguments).current_dir(self.0.path()));
        let output = command.output().expect("the program starts");
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        let words = arguments.iter().map(|word| word.as_ref().to_string_lossy());
        let run = Run {
            command: format!("mms {}", words.collect::<Vec<_>>().join(" ")),
            code: output.status.code().expect("the program ends by itself"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        };
        self.follow(&run);
        run
    }

    /// Types the next command that a run prints, in a copy of the folder: a shell has to read it, and the program to understand
    /// it. Most of these commands are diagnoses, which take seconds, so a part of them is tried.
    fn follow(&self, run: &Run) {
        if !is_tried(&run.command, 8) {
            return;
        }
        let document: Option<Value> = serde_json::from_str(&run.stdout).ok();
        let words = document.as_ref().and_then(|it| it["next_command"].as_array());
        let of_document = words.map(|words| {
            let quoted =
                |it: &Value| format!("'{}'", it.as_str().expect("a word").replace('\'', r"'\''"));
            words.iter().map(quoted).collect::<Vec<_>>().join(" ")
        });
        let mut lines = run.stdout.lines().filter_map(|line| line.strip_prefix("next: "));
        let Some(line) = lines.next_back().map(str::to_owned).or(of_document) else { return };
        let copy = Folder::new();
        let copied = Command::new("cp").arg("-R").arg(self.path(".")).arg(copy.0.path()).status();
        assert!(copied.expect("`cp` starts").success(), "{run}");
        let next = copy.types(&line);
        assert!(matches!(next.code, 0 | 1 | 3), "{next}\nafter {run}");
    }

    /// Runs a line in a shell in which `mms` is the program.
    pub fn types(&self, line: &str) -> Run {
        let program = Path::new(env!("CARGO_BIN_EXE_mms")).parent().expect("a folder");
        let path = std::env::var_os("PATH").unwrap_or_default();
        let paths = std::iter::once(program.to_owned()).chain(std::env::split_paths(&path));
        let output = Command::new("bash")
            .args(["-c", line])
            .current_dir(self.0.path())
            .env("PATH", std::env::join_paths(paths).expect("paths"))
            .output()
            .expect("`bash` starts");
        Run {
            command: line.to_owned(),
            code: output.status.code().expect("the program ends by itself"),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

/// One run of the program.
pub struct Run {
    command: String,
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl std::fmt::Display for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Run { command, code, stdout, stderr } = self;
        write!(f, "`{command}` exits {code}; on stdout\n{stdout}\nand on stderr\n{stderr}")
    }
}

impl Run {
    /// Asserts the exit code.
    pub fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, code, "{self}");
        self
    }

    /// The JSON document on stdout.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self}"))
    }

    /// Asserts that stderr holds a text.
    pub fn complains(&self, text: &str) -> &Self {
        assert!(self.stderr.contains(text), "`{text}` is missing: {self}");
        self
    }

    /// Asserts that stdout holds a text.
    pub fn prints(&self, text: &str) -> &Self {
        assert!(self.stdout.contains(text), "`{text}` is missing: {self}");
        self
    }

    /// Asserts that nothing was printed as a result.
    pub fn prints_nothing(&self) -> &Self {
        assert_eq!(self.stdout, "", "{self}");
        self
    }
}

/// The keys of a JSON object, in their order.
pub fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

/// The numbers of a JSON array.
pub fn numbers(value: &Value) -> Vec<f64> {
    let items = value.as_array().unwrap_or_else(|| panic!("not an array: {value}"));
    items.iter().map(|item| item.as_f64().expect("a number")).collect()
}

/// Asserts that two numbers agree within a relative difference.
pub fn assert_close(found: f64, expected: f64, relative: f64) {
    let difference = (found - expected).abs();
    assert!(difference <= relative * expected.abs(), "{found:e} is not {expected:e}");
}

/// A document without the numbers of a clock, and without the command line.
pub fn timeless(document: &Value) -> Value {
    match document {
        Value::Object(map) => {
            let kept =
                map.iter().filter(|(key, _)| !matches!(key.as_str(), "seconds" | "provenance"));
            Value::Object(kept.map(|(key, value)| (key.clone(), timeless(value))).collect())
        }
        Value::Array(items) => items.iter().map(timeless).collect(),
        other => other.clone(),
    }
}
