//! Files that `mms emit` writes, in a program that has only them and `mms-math`: it compiles without a warning, and computes
//! the bits of the interpreter.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use mms_codegen::selection::{Freeze, Selection};
use mms_codegen::{Compiled, compile_with};
use mms_mechanics::Output;
use mms_mechanics::sample::samples;
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The code around `program.rs`, which declares no modules of its own, because they do not exist when it is formatted.
/// Nobody uses all quantities of a module.
const MAIN: &str = "#![deny(warnings, unsafe_code)]
#![allow(dead_code)]
mod bar_1d;
mod odd_names;
mod plain;
mod standing_wave_3d;
// Like in `field!`: the file names a given field T.
#[allow(non_snake_case, unused_variables)]
mod units_axisymmetric;
include!(\"program.rs\");
";

/// An axisymmetric field, which has no contract of a solver.
const SHAFT: &str = "mms-codegen/tests/data/pass/units_axisymmetric.toml";

/// A crate of `program.rs` and the emitted files.
fn scratch_crate() -> PathBuf {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emitted");
    let source = scratch.join("src");
    let _ = fs::remove_dir_all(&source);
    fs::create_dir_all(&source).expect("a folder");
    let math = root().join("mms-math");
    let manifest = format!(
        "[package]\nname = \"emitted\"\nedition = \"2024\"\n\n[dependencies]\n\
         mms-math = {{ path = {math:?} }}\n\n[workspace]\n"
    );
    fs::write(scratch.join("Cargo.toml"), manifest).expect("a written file");
    fs::write(source.join("main.rs"), MAIN).expect("a written file");
    fs::copy(root().join("tests/emitted/program.rs"), source.join("program.rs")).expect("a copy");
    emit("bar_1d", &source, &[]);
    emit("tests/programs/odd_names.toml", &source, &[]);
    emit("tests/programs/plain.toml", &source, &[]);
    emit(SHAFT, &source, &[]);
    let part = ["--quantity", "body_force,velocity", "--set", "lambda=0", "--freeze"];
    emit("examples/fields/standing_wave_3d.toml", &source, &part);
    scratch
}

fn emit(field: &str, folder: &Path, options: &[&str]) {
    let emit = Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(["emit", field, "--target", "rust-mms-math", "-o"])
        .arg(folder)
        .args(options)
        .current_dir(root())
        .output()
        .expect("the program starts");
    assert!(emit.status.success(), "{}", String::from_utf8_lossy(&emit.stderr));
}

/// The answers of the compiled program, one line each.
fn answers(scratch: &Path, questions: &str) -> Vec<Vec<u64>> {
    let mut program = Command::new(env!("CARGO"))
        .args(["run", "--offline", "--quiet", "--target-dir"])
        .arg(scratch.join("target"))
        .current_dir(scratch)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("Cargo starts");
    let mut input = program.stdin.take().expect("its input");
    input.write_all(questions.as_bytes()).expect("a program that reads");
    drop(input);
    let output = program.wait_with_output().expect("the program ends");
    assert!(output.status.success(), "the emitted files do not compile, or do not run");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let bits = |line: &str| line.split(' ').map(|word| word.parse().expect("bits")).collect();
    text.lines().map(bits).collect()
}

/// A field of the package, compiled here.
fn compiled(path: &str, selection: Selection) -> Compiled {
    let text = fs::read_to_string(root().join(path)).expect("a field file");
    let missing = |material: &str| Err(material.to_string());
    compile_with("field", path, &text, &missing, &selection.into()).expect("a right file")
}

/// Questions, and their expected answers.
#[derive(Default)]
struct Expected {
    questions: String,
    answers: Vec<Vec<u64>>,
}

impl Expected {
    fn ask(&mut self, question: &str, time: f64, at: &[f64], answer: &[f64]) {
        let numbers: Vec<String> =
            [time].iter().chain(at).map(|number| format!("{number:e}")).collect();
        self.questions += &format!("{question} {}\n", numbers.join(" "));
        self.answers.push(answer.iter().map(|value| value.to_bits()).collect());
    }

    /// Adds the interpreter's results at the points of a field.
    fn interpreted(&mut self, compiled: &Compiled, quantity: Quantity, questions: &[&str]) {
        let output = Output::Quantity(quantity);
        let parameters = compiled.parameters::<f64>(&Default::default());
        let mut interpreter = Interpreter::new(&compiled.program, &parameters);
        let plan = interpreter.plan(&[output]);
        for point in samples(&compiled.program, &parameters, 64) {
            interpreter.set_time(&point.time);
            interpreter.set_point(&plan, Point::at(&point.coordinates));
            let answer = interpreter.output(output);
            for question in questions {
                self.ask(question, point.time, &point.coordinates, &answer);
            }
        }
    }
}

#[test]
fn emitted_files_need_mms_math_alone_and_give_the_bits_of_the_interpreter() {
    let mut expected = Expected::default();
    let bar = compiled("fields/bar_1d.toml", Selection::default());
    expected.interpreted(&bar, Quantity::BodyForce, &["bar_body_force"]);
    expected.interpreted(&bar, Quantity::CauchyStress, &["bar_stress_of_kept"]);
    expected.ask("bar_upper", 0.0, &[0.0], &[1.0]);
    // P = E/2 (F - 1/F), F = 2.
    expected.ask("bar_material", 0.0, &[1.0], &[0.5e6 * (2.0 - 0.5)]);

    // Written as on the command line.
    let part = Selection {
        quantities: Some([Quantity::BodyForce, Quantity::Velocity].into()),
        set: vec![("lambda".into(), "0".into())],
        freeze: Freeze::Everything,
        ..Selection::default()
    };
    let wave = compiled("examples/fields/standing_wave_3d.toml", part);
    let both = ["wave_body_force", "wave_body_force_of_kept"];
    expected.interpreted(&wave, Quantity::BodyForce, &both);
    expected.interpreted(&wave, Quantity::Velocity, &["wave_velocity"]);

    for (path, question) in [
        ("tests/programs/odd_names.toml", "odd_displacement"),
        ("tests/programs/plain.toml", "plain_displacement"),
    ] {
        let field = compiled(path, Selection::default());
        expected.interpreted(&field, Quantity::Displacement, &[question]);
    }

    let shaft = compiled(SHAFT, Selection::default());
    let both = ["shaft_body_force", "shaft_body_force_of_kept"];
    expected.interpreted(&shaft, Quantity::BodyForce, &both);
    expected.interpreted(&shaft, Quantity::FirstPiolaKirchhoff, &["shaft_stress"]);

    let found = answers(&scratch_crate(), &expected.questions);
    assert_eq!(found.len(), expected.answers.len());
    for ((question, found), expected) in
        expected.questions.lines().zip(&found).zip(&expected.answers)
    {
        assert_eq!(found, expected, "{question}");
    }
}
