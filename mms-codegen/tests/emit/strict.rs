//! Stricter than the line of a bundle: other compilers, more warnings, single precision.

use std::fs;
use std::path::Path;

use mms_codegen::emit::port::callable::callables;
use mms_codegen::emit::{Subject, Target};
use mms_codegen::selection::Form;
use mms_codegen::{Compiled, Options, compile_with};

use super::build::{is_installed, prove, scratch, shell};

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

/// Reads a formula, its names and then points, and prints its value at each, as parsed and optimised.
const PARSER: &str = r#"
#include <cstdio>
#include <fparser.hh>
#include <iostream>
#include <sstream>
#include <string>

int main()
{
    FunctionParser plain, optimised;
    std::string line, formula;
    while (std::getline(std::cin, line)) {
        const std::string rest = line.substr(1);
        if (line[0] == 'F') {
            formula = rest;
        } else if (line[0] == 'V') {
            if (plain.Parse(formula, rest) >= 0 || optimised.Parse(formula, rest) >= 0) {
                std::printf("%s\n", plain.ErrorMsg());
                return 1;
            }
            optimised.Optimize();
        } else {
            std::istringstream words(rest);
            double values[64];
            for (double *value = values; words >> *value;) {
                value++;
            }
            std::printf("%.17g %.17g\n", plain.Eval(values), optimised.Eval(values));
        }
    }
}
"#;

/// MOOSE reads formulas with this parser, and lets it rearrange them.
#[test]
fn moose_formulas_keep_their_digits_in_the_parser_of_moose() {
    if !is_installed("echo '#include <fparser.hh>' | g++ -x c++ -fsyntax-only -") {
        return;
    }
    let folder = scratch("strict/fparser");
    fs::write(folder.join("parser.cc"), PARSER).expect("a written file");
    let build = shell("g++ -O1 parser.cc -lfparser -o parser", &folder);
    assert!(build.status.success(), "{}", String::from_utf8_lossy(&build.stderr));
    // Logarithms near 1, powers, half turns and functions of angles.
    for name in
        ["plane_strain_gent", "conformal_sector_2d", "cyclic_shear_3d", "generalized_vortex"]
    {
        let field = field(name, &Options::default());
        let subject = Subject::new(&field);
        let text = (target("moose").emit)(&subject).files.swap_remove(0).text;
        let vectors = subject.vectors();
        for (place, callable) in callables(&field).iter().enumerate() {
            if !callable.is_of_places() || !callable.is_of_points() {
                continue;
            }
            let suffixes = callable.suffixes(field.field.dimension);
            let mut errors = vec![[0.0_f64; 2]; vectors.sets.len()];
            for (component, suffix) in suffixes.iter().enumerate() {
                let (formula, symbols) =
                    formula(&text, &format!("{name}_{}{suffix}", callable.name));
                let mut questions = format!("F{formula}\nV{}\n", names(&symbols));
                for sample in &vectors.samples {
                    let set = &vectors.sets[sample.set];
                    let mut values: Vec<f64> =
                        symbols.iter().map(|symbol| set[position(&field, symbol)]).collect();
                    values.extend((0..3).map(|axis| sample.coordinates.get(axis).unwrap_or(&0.0)));
                    values.push(sample.time);
                    let values: Vec<String> =
                        values.iter().map(|value| format!("{value:e}")).collect();
                    questions += &format!("E{}\n", values.join(" "));
                }
                fs::write(folder.join("questions"), questions).expect("a written file");
                let run = shell("./parser < questions", &folder);
                let answers = String::from_utf8_lossy(&run.stdout);
                assert!(run.status.success(), "{name} {}: {answers}", callable.name);
                let rows = answers.lines().zip(&vectors.samples).zip(&vectors.expected[place]);
                for ((answer, sample), expected) in rows {
                    let [error, magnitude] = &mut errors[sample.set];
                    for found in answer.split(' ') {
                        let found: f64 = found.parse().expect("a number");
                        *error = error.max((found - expected[component]).abs());
                    }
                    *magnitude = magnitude.max(expected[component].abs());
                }
            }
            for [error, magnitude] in errors {
                // What the formulas promise; in one precision those of the gallery keep it.
                let eps = error / magnitude.max(f64::MIN_POSITIVE) / f64::EPSILON;
                assert!(eps <= 64.0, "{name} {}: {eps} eps", callable.name);
            }
        }
    }
}

/// The formula of a block on one line, and the names of its parameters.
fn formula(text: &str, block: &str) -> (String, Vec<String>) {
    let (_, rest) = text.split_once(&format!("[{block}]\n")).expect("a block");
    let (body, _) = rest.split_once("\n  []").expect("its end");
    let value = |key: &str| {
        let (_, rest) = body.split_once(&format!("{key} = '"))?;
        Some(rest.split('\'').next().unwrap_or(rest).split_whitespace().collect::<Vec<_>>())
    };
    let symbols = value("symbol_names").unwrap_or_default();
    let symbols = symbols.iter().map(|it| it.trim_start_matches("p_").to_string()).collect();
    (value("expression").expect("a formula").join(" "), symbols)
}

fn names(symbols: &[String]) -> String {
    let symbols = symbols.iter().map(|symbol| format!("p_{symbol}"));
    symbols.chain(["x,y,z,t".into()]).collect::<Vec<_>>().join(",")
}

fn position(field: &Compiled, parameter: &str) -> usize {
    let mut names = field.field.parameters.iter().map(|it| it.name.value.as_str());
    names.position(|name| name == parameter).expect("a parameter")
}
