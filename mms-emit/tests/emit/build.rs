//! Writes bundles, builds them as their line says, and runs them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{LazyLock, Mutex, PoisonError};

use mms_emit::{Bundle, Subject, TARGETS, Target};

use super::sampled::{all_is_tried, is_tried};

/// The targets that come with a check program.
pub fn ports() -> impl Iterator<Item = &'static Target> {
    TARGETS.iter().filter(|target| target.name != "rust-mms-math")
}

/// Whether all compilers must be there.
pub fn all_are_required() -> bool {
    std::env::var("MMS_REQUIRE_COMPILERS").is_ok_and(|value| value == "1")
}

/// Whether a command succeeds. Prints the name of a command that fails, or fails the test if all are required.
pub fn is_installed(command: &str) -> bool {
    let found = is_installed_optionally(command);
    assert!(found || !all_are_required(), "`{command}` fails, and MMS_REQUIRE_COMPILERS is 1");
    found
}

/// Whether a command succeeds, which is tried once. Prints the name of a command that fails.
pub fn is_installed_optionally(command: &str) -> bool {
    static KNOWN: LazyLock<Mutex<BTreeMap<String, bool>>> = LazyLock::new(Mutex::default);
    let runs = || {
        let line = format!("{command} >/dev/null 2>&1");
        let status = Command::new("sh").args(["-c", &line]).status();
        let runs = status.is_ok_and(|status| status.success());
        if !runs {
            println!("SKIPPED: {command}");
        }
        runs
    };
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    *known.entry(command.into()).or_insert_with(runs)
}

/// Whether what a target's line needs is installed.
pub fn can_build(target: &Target) -> bool {
    match target.name {
        // Debian has no package of it.
        "julia" if !is_installed_optionally("julia --version") => false,
        "octave" => is_installed("octave-cli --version"),
        "rust" => is_installed("rustc --version"),
        "numpy" | "sympy" | "ufl" => {
            is_installed(&format!("{} -c 'import {}'", python(), target.name))
        }
        "python" | "moose" | "karamelo" => is_installed(&format!("{} --version", python())),
        name => {
            let compiler = match name {
                "c" => "cc",
                "cpp" => "c++",
                "fortran" => "gfortran",
                name => name,
            };
            is_installed(&format!("{compiler} --version"))
        }
    }
}

/// Whether a target can be proved, or at least be read.
pub fn can_prove(target: &Target) -> bool {
    can_build(target) || can_read(target)
}

/// Whether there is a parser of a language whose compiler Debian does not have.
fn can_read(target: &Target) -> bool {
    let import = || format!("{} -c 'import tree_sitter, tree_sitter_julia'", python());
    target.name == "julia" && is_installed(&import())
}

/// Refuses files that are not Julia.
const READER: &str = r#"
import sys

import tree_sitter
import tree_sitter_julia

parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_julia.language()))
for path in sys.argv[1:]:
    with open(path, "rb") as file:
        text = file.read()
    nodes = [parser.parse(text).root_node]
    while nodes:
        node = nodes.pop()
        if node.type == "ERROR" or node.is_missing:
            line, part = node.start_point[0] + 1, text[node.start_byte : node.end_byte][:80]
            sys.exit(f"{path}:{line}: {part!r}")
        nodes.extend(node.children if node.has_error else [])
"#;

/// The targets in which a test tries case `case` of `cases`: a quarter of the targets, with one case each. All targets have all cases
/// if everything is tried.
pub fn in_turn(test: &str, case: usize, cases: usize) -> impl Iterator<Item = &'static Target> {
    let is_chosen = move |(place, target): &(usize, &Target)| {
        all_is_tried() || place % cases == case && is_tried(&format!("{test} {}", target.name), 4)
    };
    let targets = ports().enumerate().filter(is_chosen);
    targets.map(|(_, target)| target).filter(|target| can_prove(target))
}

/// The Python that has what the tests need.
fn python() -> String {
    std::env::var("MMS_PYTHON").unwrap_or("python3".into())
}

/// An empty folder for a test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emit").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Writes a bundle.
pub fn write(bundle: &Bundle, folder: &Path) {
    for file in &bundle.files {
        fs::write(folder.join(&file.name), &file.text).expect("a written file");
    }
}

/// Runs a line of the shell in a folder.
pub fn shell(line: &str, folder: &Path) -> Output {
    let line = line.replace("python3", &python());
    Command::new("sh").args(["-c", &line]).current_dir(folder).output().expect("a shell")
}

/// Emits a field, and asserts that its check program passes; `change` may change its build line. Returns the worst error in
/// eps, or 0 if there is only a parser of the language, which must accept the program.
pub fn prove(
    target: &Target,
    subject: &Subject<'_>,
    folder: &str,
    change: impl Fn(String) -> String,
) -> f64 {
    let folder = scratch(&format!("{folder}/{}", target.name));
    let bundle = (target.emit)(subject);
    write(&bundle, &folder);
    let is_read = !can_build(target);
    let line = match is_read {
        true => "python3 -W error read.py *.jl".into(),
        false => change(bundle.verify.expect("a check program")),
    };
    if is_read {
        fs::write(folder.join("read.py"), READER).expect("a written file");
    }
    let run = shell(&line, &folder);
    let [out, err] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(run.status.success(), "{}: {line}\n{out}{err}", folder.display());
    assert_eq!(err, "", "{}: {line}", folder.display());
    if is_read {
        return 0.0;
    }
    let (_, rest) = out.split_once("worst error ").expect("a worst error");
    rest.split(' ').next().and_then(|word| word.parse().ok()).expect("a number")
}

/// The command without optimisation: the warnings are the same, and numbers differ by round-off only.
pub fn quick(line: String) -> String {
    line.replace("-O2", "-O0").replace(" -O ", " ")
}

/// The command without optimisation, unless everything is tried.
pub fn mostly_quick(line: String) -> String {
    if all_is_tried() { line } else { quick(line) }
}

/// Calls a function for every item, on two threads.
pub fn in_pairs<T: Sync>(items: &[T], each: impl Fn(&T) + Sync) {
    let next = std::sync::atomic::AtomicUsize::new(0);
    let work = || {
        while let Some(item) = items.get(next.fetch_add(1, std::sync::atomic::Ordering::Relaxed)) {
            each(item);
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        work();
    });
}
