//! Every file in `data/fail` is wrong, and says in its first line how: the messages for `NAME.toml` must be exactly
//! `NAME.expected`. The folder is its own list.
//!
//! After a deliberate change, `MMS_BLESS=1 cargo test -p mms-codegen --test suite diagnostics` writes the `.expected` files
//! anew; read the difference before you commit it.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use mms_codegen::certify::certificate::certify;
use mms_codegen::compile::{Failure, constant};
use mms_codegen::selection::{Freeze, Selection};
use mms_codegen::{Options, compile, compile_with};
use mms_spec::diagnostic::{Diagnostic, render};
use mms_spec::read_material;
use mms_spec::source::Sources;
use mms_spec::syntax::parse;
use mms_spec::twin::Twin;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/fail")
}

fn cases() -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).expect("tests/data/fail");
    let paths = entries.map(|entry| entry.expect("an entry of tests/data/fail").path());
    let mut cases: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    cases.sort();
    cases
}

/// The mistakes in a text. Files named `material_*` are material files on their own; fields name the files of
/// `data/fail/materials`.
fn mistakes(name: &str, text: &str) -> (Sources, Vec<Diagnostic>) {
    let path = format!("{name}.toml");
    if name.starts_with("material_") {
        let mut sources = Sources::default();
        let id = sources.add(path, text);
        let mut diagnostics = Vec::new();
        if let Some(spec) = read_material(&sources, id, name, &mut diagnostics) {
            spec.formulas().for_each(|formula| drop(parse(formula, &mut diagnostics)));
        }
        return (sources, diagnostics);
    }
    let load = |material: &str| {
        let missing = |_| "no such file".to_string();
        fs::read_to_string(folder().join(material)).map_err(missing)
    };
    match compile(name, &path, text, &load) {
        // `mms check` finds the mistakes that a compilation does not look for.
        Ok(compiled) => (compiled.sources.clone(), certify(&compiled).objections(&compiled)),
        Err(failure) => (failure.sources, failure.diagnostics),
    }
}

/// The messages that a user sees for a text.
fn rendered(name: &str, text: &str) -> String {
    let (sources, diagnostics) = mistakes(name, text);
    render(&sources, &diagnostics)
}

/// The lines of a source file where a message is made, without tests.
fn sites_in(path: &Path) -> Vec<usize> {
    let text = fs::read_to_string(path).expect("a source file");
    let tests = text.find("#[cfg(test)]\nmod tests").unwrap_or(text.len());
    let makes =
        |line: &str| line.contains("Diagnostic::error(") && !line.trim_start().starts_with("//");
    let lines = text[..tests].lines().enumerate();
    lines.filter(|(_, line)| makes(line)).map(|(index, _)| index + 1).collect()
}

fn source_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            source_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// A place in the sources as `mms-spec/src/file.rs:line`.
fn place(path: &str, line: usize) -> String {
    let path = path.replace('\\', "/");
    let start = path.rfind("mms-").unwrap_or(0);
    format!("{}:{line}", &path[start..])
}

/// A field that is right.
const FIELD: &str = "[field]\ntitle = \"x\"\ndimension = 1\n[parameters]\na = { value = 1 }\n\
                     [displacement]\nu = [\"(a - 1)*X\"]\n[material]\nmodel = \"neo_hookean\"\n\
                     lambda = 1\nmu = 1\ndensity = 1\n[domain]\nshape = \"box\"\n\
                     lower = [0]\nupper = [1]\ntime = [0, 1]\n";

/// The mistakes of `--set`, `--freeze`, `--rigid` and `--window`: a name that is unknown, a name that is set twice, a stretch
/// of 0 (J is a divisor), a second rigid motion, a window or a standard motion of a static field, and a standard motion without
/// a body.
fn wrong_selections() -> Vec<Failure> {
    let set = |value: &str| vec![("a".to_string(), value.to_string())];
    let freeze = |names: &[&str]| Freeze::Only(names.iter().map(|name| name.to_string()).collect());
    let selections = [
        Selection { freeze: freeze(&["b"]), ..Selection::default() },
        Selection { freeze: freeze(&["a", "a"]), ..Selection::default() },
        Selection { set: set("0"), freeze: freeze(&["a"]), ..Selection::default() },
    ];
    let load = |_: &str| Err("no files here".to_string());
    let compile = |text: &str, selection: Selection| {
        compile_with("x", "x.toml", text, &load, &selection.into()).expect_err("a mistake")
    };
    let mut failures: Vec<_> =
        selections.into_iter().map(|selection| compile(FIELD, selection)).collect();
    let moving = format!("{FIELD}[rigid]\ntranslation = [\"t\"]\n");
    let twin = Selection { twin: Twin::Standard, ..Selection::default() };
    failures.push(compile(&moving, twin.clone()));
    let at_rest = FIELD.replace("time = [0, 1]\n", "");
    let window = Some(["0".to_string(), "1".to_string()]);
    failures.push(compile(&at_rest, Selection { window, ..Selection::default() }));
    failures.push(compile(&at_rest, twin.clone()));
    let nowhere = FIELD.replace("shape = \"box\"\nlower = [0]\nupper = [1]", "shape = \"none\"");
    failures.push(compile(&nowhere, twin));
    failures
}

/// The standard motion is made from the body and the window of the file: it adds as many lines as the file has for them, and no
/// message about what the file lacks.
#[test]
fn the_standard_motion_is_of_any_text() {
    let load = |_: &str| Err("no files here".to_string());
    let twin = Selection { twin: Twin::Standard, ..Selection::default() };
    let compile = |text: &str| compile_with("x", "x.toml", text, &load, &twin.clone().into());
    let lines = FIELD.replace("time = [0, 1]", "time = [0, \"\"\"2*\na\"\"\"]");
    compile(&lines).unwrap_or_else(|failure| panic!("{failure}"));
    let (start, _) = FIELD.split_once("[domain]").expect("a body");
    let failure = compile(start).expect_err("no body");
    let places: Vec<_> = failure.diagnostics.iter().map(|found| found.span.source).collect();
    assert_eq!(places.len(), 1, "{failure}");
}

/// The failure of a correct field within so many nodes, if it fails.
fn bounded(max_nodes: usize) -> Option<Failure> {
    let options = Options { max_nodes, ..Options::default() };
    let load = |_: &str| Err("no files here".to_string());
    compile_with("x", "x.toml", FIELD, &load, &options).err()
}

/// A parameter that takes too long to evaluate in 77 digits.
fn endless() -> Option<Failure> {
    let terms: Vec<_> = (1..20_000).map(|k| format!("sin({k})")).collect();
    let text = FIELD.replace("value = 1", &format!("value = \"{}\"", terms.join("+")));
    let load = |_: &str| Err("no files here".to_string());
    compile_with("x", "x.toml", &text, &load, &Options::default()).err()
}

fn stopped() -> Option<Failure> {
    let options = Options::default();
    options.stop.ask();
    let load = |_: &str| Err("no files here".to_string());
    compile_with("x", "x.toml", FIELD, &load, &options).err()
}

#[test]
fn every_message_of_the_compiler_has_a_wrong_file() {
    let mut provoked = BTreeSet::new();
    for path in cases() {
        let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("a readable file");
        let (_, diagnostics) = mistakes(&name, &text);
        provoked.extend(
            diagnostics.iter().map(|found| place(found.site.file(), found.site.line() as usize)),
        );
    }
    // A file for this mistake would be too long to read.
    let (_, diagnostics) = mistakes("long", &"#".repeat(2_000_000));
    assert_eq!(diagnostics.len(), 1);
    provoked.extend(
        diagnostics.iter().map(|found| place(found.site.file(), found.site.line() as usize)),
    );
    // A value of the command line has no file either.
    let failure = constant("2^(1/2)").expect_err("irrational");
    provoked.extend(failure.diagnostics.iter().map(|found| {
        assert_eq!(found.message, "the value is not a rational number");
        place(found.site.file(), found.site.line() as usize)
    }));
    // Selections, limits and stopped work have no file either.
    let others = bounded(1).into_iter().chain(endless()).chain(stopped());
    for failure in wrong_selections().into_iter().chain(others) {
        provoked.extend(
            failure
                .diagnostics
                .iter()
                .map(|found| place(found.site.file(), found.site.line() as usize)),
        );
    }
    let mut files = Vec::new();
    for name in ["mms-spec", "mms-mechanics", "mms-codegen"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name).join("src");
        source_files(&folder, &mut files);
    }
    let made: BTreeSet<_> = files
        .iter()
        .filter(|path| !path.ends_with("syntax/tests.rs"))
        .flat_map(|path| {
            let shown = path.display().to_string();
            sites_in(path).into_iter().map(move |line| place(&shown, line))
        })
        .collect();
    assert!(made.len() > 50, "{made:?}");
    let silent: Vec<_> = made.difference(&provoked).collect();
    assert!(silent.is_empty(), "no file in tests/data/fail has the messages made at {silent:#?}");
}

#[test]
fn each_wrong_file_gets_its_message() {
    let bless = std::env::var_os("MMS_BLESS").is_some();
    let mut failures = Vec::new();
    for path in cases() {
        let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("a readable file");
        let found = rendered(&name, &text);
        let expected_path = path.with_extension("expected");
        if bless {
            fs::write(&expected_path, &found).expect("a writable file");
        }
        let expected = fs::read_to_string(&expected_path).unwrap_or_default();
        if found.is_empty() {
            failures.push(format!("{name}.toml: nothing was found wrong with it"));
        } else if found != expected {
            failures.push(format!("{name}.toml: expected\n{expected}\nbut found\n{found}"));
        }
    }
    assert!(
        failures.is_empty(),
        "{} of tests/data/fail differ; if that is right, run with MMS_BLESS=1\n\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// The message is right for every step and every size at which the graph becomes full.
#[test]
fn a_graph_that_is_too_small_is_always_said_to_be() {
    for limit in (1..40).chain((40..4000).step_by(61)) {
        let Some(failure) = bounded(limit) else { continue };
        let said = failure.diagnostics.iter().any(|found| found.message.contains("too large"));
        assert!(said, "{limit} nodes: {failure}");
        assert!(
            failure.to_string().contains(&format!("the bound is {limit} of both")),
            "{failure}"
        );
    }
    assert!(bounded(1).is_some() && bounded(200_000).is_none());
}

#[test]
fn no_expectation_is_orphaned() {
    for entry in fs::read_dir(folder()).expect("tests/data/fail") {
        let path = entry.expect("an entry of tests/data/fail").path();
        if path.is_dir() {
            continue;
        }
        let input = path.with_extension("toml");
        assert!(input.exists(), "{} has no .toml beside it", path.display());
    }
}

#[test]
fn every_message_has_its_own_place() {
    for path in cases() {
        let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("a readable file");
        let found = rendered(&name, &text);
        let messages = found.lines().filter(|line| line.starts_with("error:")).count();
        let places = found.lines().filter(|line| line.trim_start().starts_with("--> ")).count();
        assert_eq!(messages, places, "{found}");
    }
}
