//! The library in use: installed, found by pkg-config and by CMake, and called from C, C++, Fortran and Python. All programs
//! print the same, which is the result of the compiler of fields. Other programs misuse it, with all accesses to memory
//! checked.

mod checked;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use mms_codegen::compile;
use mms_codegen::compile::constant;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;

/// The folder where the library is installed, and then moved to. Its name has a space, as folders of users may.
static PREFIX: LazyLock<PathBuf> = LazyLock::new(|| {
    let scratch = scratch();
    let _ = fs::remove_dir_all(scratch);
    let [first, prefix] = [scratch.join("p"), scratch.join("moved here")];
    fs::create_dir_all(scratch).expect("a folder");
    run(&format!("{} {} dev", quoted(&root().join("install")), quoted(&first)), scratch);
    fs::rename(first, &prefix).expect("what is installed may be moved");
    prefix
});

/// The folder where the programs are built.
fn scratch() -> &'static Path {
    Path::new(concat!(env!("CARGO_TARGET_TMPDIR"), "/capi"))
}

#[test]
fn every_language_finds_the_library_and_gets_the_same_numbers() {
    let scratch = scratch();
    let expected = expected();
    let [prefix, examples] = [quoted(&PREFIX), quoted(&root().join("examples"))];
    let path = format!("PKG_CONFIG_PATH={prefix}/lib/pkgconfig");
    let linked = format!("$({path} pkg-config --cflags --libs mms_capi) -Wl,-rpath,{prefix}/lib");
    let strict = "-Wall -Wextra -pedantic -Werror";
    for (tools, line) in [
        (
            &["cc", "pkg-config"][..],
            format!("eval \"cc -std=c99 {strict} {examples}/forcing.c {linked} -o c\" && ./c"),
        ),
        (
            &["c++", "pkg-config"],
            format!(
                "eval \"c++ -std=c++17 -x c++ {strict} {examples}/forcing.c {linked} -o cpp\" && ./cpp"
            ),
        ),
        (
            &["gfortran", "pkg-config"],
            format!(
                "eval \"gfortran -std=f2008 {strict} {prefix}/include/mms_capi.f90 {examples}/forcing.f90 {linked} -o fortran\" && ./fortran"
            ),
        ),
        (
            &["cmake", "cc"],
            format!(
                "cmake -B build -S {examples} -DCMAKE_PREFIX_PATH={prefix} >log && cmake --build build >log && build/forcing"
            ),
        ),
        (&["cmake", "cc"], "build/forcing_static".into()),
        (
            &["python3"],
            format!("{} {examples}/forcing.py {prefix}/lib/libmms_capi.*[oy]*", python()),
        ),
    ] {
        if tools.iter().all(|tool| is_installed(tool)) {
            assert_eq!(run(&line, scratch), expected, "{line}");
        }
    }
}

#[test]
fn the_files_beside_the_header_are_in_step_with_it() {
    let read = |file: &str| fs::read_to_string(root().join(file)).expect("a file");
    let version = env!("CARGO_PKG_VERSION");
    assert!(read("mms_capi.pc").contains(&format!("\nVersion: {version}\n")));
    let cmake = read("cmake/mms_capi-config-version.cmake");
    assert!(cmake.contains(&format!("set(PACKAGE_VERSION \"{version}\")")));
    let header = read("include/mms_capi.h");
    let module = read("include/mms_capi.f90");
    let functions: Vec<_> = header
        .lines()
        .filter(|line| line.contains(" mms_") || line.contains("*mms_"))
        .filter_map(|line| line.split_once('(').filter(|_| !line.starts_with(' ')))
        .filter_map(|(before, _)| before.rsplit([' ', '*']).next())
        .collect();
    assert!(functions.len() >= 20, "{functions:?}");
    for name in functions {
        let declared = |kind: &str| module.contains(&format!("        {kind} {name}("));
        assert!(declared("function") || declared("subroutine"), "mms_capi.f90 lacks {name}");
    }
    for line in header.lines().filter(|line| line.starts_with("  MMS_CODE_")) {
        let constant = line.trim().trim_end_matches(',').to_lowercase();
        assert!(module.contains(&format!(":: {constant}\n")), "mms_capi.f90 lacks {constant}");
    }
}

/// The expected output of the programs.
fn expected() -> String {
    let text = fs::read_to_string(root().join("fields/bar_1d.toml")).expect("a field");
    let bar = compile("bar_1d", "bar_1d.toml", &text, &|_| Err("none".into())).expect("a field");
    let amplitude = bar.model.parameters.iter().position(|it| it.name == "amplitude");
    let set = [(amplitude.expect("a parameter"), constant("0.1").expect("a number"))].into();
    let parameters = bar.parameters::<f64>(&set);
    let mut interpreter = Interpreter::new(&bar.program, &parameters);
    interpreter.set_time(&0.013);
    let output = Output::Quantity(Quantity::BodyForce);
    let plan = interpreter.plan(&[output]);
    let mut text = String::from("bar_1d: Body force on a 1D bar\n");
    for x in [0.0, 0.25, 0.5, 0.75, 1.0] {
        interpreter.set_point(&plan, Point::at(&[x]));
        text += &format!("{x:8.4} {:14.6}\n", interpreter.output(output)[0]);
    }
    text + "2: no parameter `amplitud`; did you mean `amplitude`?\n"
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The Python of the tests.
fn python() -> String {
    std::env::var("MMS_PYTHON").unwrap_or("python3".into())
}

/// A path as one word of the shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display())
}

/// The output of a shell command, which has to succeed.
fn run(line: &str, folder: &Path) -> String {
    let run = Command::new("sh").args(["-c", line]).current_dir(folder).output().expect("a shell");
    let [out, err] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(run.status.success(), "{line}\n{out}{err}");
    out.into_owned()
}

/// Whether a tool is installed. A missing tool is printed, or fails the test if all are required.
fn is_installed(tool: &str) -> bool {
    let tool = if tool == "python3" { python() } else { tool.into() };
    let version = Command::new(&tool).arg("--version").output();
    let found = version.is_ok_and(|run| run.status.success());
    if !found {
        println!("SKIPPED: {tool}");
        let required = std::env::var("MMS_REQUIRE_COMPILERS").is_ok_and(|value| value == "1");
        assert!(!required, "`{tool}` fails, and MMS_REQUIRE_COMPILERS is 1");
    }
    found
}
