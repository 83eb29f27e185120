//! Stricter than the line of a bundle: other compilers, more warnings, single precision.

use std::fs;
use std::path::Path;

use mms_codegen::emit::{Subject, Target};
use mms_codegen::selection::Form;
use mms_codegen::{Compiled, Options, compile_with};

use super::build::{is_installed, prove};

fn field(name: &str, options: &Options) -> Compiled {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    let text = fs::read_to_string(folder.join(format!("{name}.toml"))).expect("a field file");
    compile_with(name, name, &text, &|path| Err(path.into()), options)
        .unwrap_or_else(|failure| panic!("{failure}"))
}

fn target(name: &str) -> &'static Target {
    Target::find(name).expect("a target of that name")
}

const MORE_WARNINGS: &str = "-Wpedantic -Wconversion -Wshadow -Wcast-qual -Wundef -Wwrite-strings \
    -Wstrict-prototypes -Wmissing-prototypes -Wdouble-promotion -Wformat=2 -Wold-style-definition";

#[test]
fn c_has_no_warning_in_two_compilers_and_two_precisions() {
    let field = field("generalized_vortex", &Options::default());
    for compiler in ["gcc", "clang"] {
        if !is_installed(&format!("{compiler} --version")) {
            continue;
        }
        for precision in ["", "-DGENERALIZED_VORTEX_FLOAT"] {
            let line = |line: String| {
                line.replacen("cc ", &format!("{compiler} {MORE_WARNINGS} {precision} "), 1)
            };
            let error = prove(
                target("c"),
                &Subject::new(&field),
                &format!("strict/{compiler}{precision}"),
                line,
            );
            println!("{compiler} {precision}: {error} eps");
        }
    }
}

#[test]
fn cpp_has_no_warning_in_two_compilers() {
    let field = field("conformal_sector_2d", &Options::default());
    for compiler in ["g++", "clang++"] {
        if is_installed(&format!("{compiler} --version")) {
            prove(target("cpp"), &Subject::new(&field), &format!("strict/{compiler}"), |line| {
                line.replacen("c++ ", &format!("{compiler} {MORE_CPP_WARNINGS} "), 1)
            });
        }
    }
}

const MORE_CPP_WARNINGS: &str = "-Wpedantic -Wconversion -Wshadow -Wcast-qual -Wold-style-cast \
    -Wdouble-promotion -Wextra-semi -Wnon-virtual-dtor -Wformat=2";

#[test]
fn fortran_proves_itself_in_single_precision() {
    if !is_installed("gfortran --version") {
        return;
    }
    let field = field("bar_1d", &Options::default());
    prove(target("fortran"), &Subject::new(&field), "strict/single", |line| {
        format!("sed -i.bak 's/wp = real64/wp = kind(1.0)/' bar_1d.f90 && {line}")
    });
}

/// Where multiplications are fused with sums, as some compilers do unless they are told not to.
#[test]
fn c_keeps_its_digits_where_operations_are_fused() {
    if !is_installed("cc --version") {
        return;
    }
    let field = field("generalized_vortex", &Options::default());
    prove(target("c"), &Subject::new(&field), "strict/fused", |line| {
        line.replace("-ffp-contract=off", "-ffp-contract=fast -march=native")
    });
}

#[test]
fn other_forms_and_frozen_parameters_prove_themselves() {
    if !is_installed("cc --version") {
        return;
    }
    let mut options = Options { form: Form::Fast, ..Options::default() };
    prove(target("c"), &Subject::new(&field("bar_1d", &options)), "strict/fast", |line| line);
    options = Options::default();
    options.selection.freeze = mms_codegen::selection::Freeze::Everything;
    prove(target("c"), &Subject::new(&field("bar_1d", &options)), "strict/frozen", |line| line);
    options.selection.quantities = Some([mms_codegen::quantity::Quantity::BodyForce].into());
    options.selection.twin = mms_codegen::twin::Twin::Standard;
    prove(target("c"), &Subject::new(&field("twisted_column", &options)), "strict/part", |line| {
        line
    });
}
