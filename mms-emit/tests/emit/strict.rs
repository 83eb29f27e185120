//! Stricter than the line of a bundle: other compilers, more warnings, single precision.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use mms_codegen::{Compiled, Options, compile_with};
use mms_emit::port::callable::callables;
use mms_emit::{Subject, Target};
use mms_spec::Form;

use super::build::{is_installed, mostly_quick, prove, scratch, shell};
use super::sampled::{all_is_tried, sampled};

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
    let precisions = ["", "-DGENERALIZED_VORTEX_FLOAT"];
    for (at, compiler) in ["gcc", "clang"].into_iter().enumerate() {
        if !is_installed(&format!("{compiler} --version")) {
            continue;
        }
        // One precision of each compiler, unless everything is tried.
        let is_meant = |it: &(usize, &str)| it.0 == at || all_is_tried();
        for (_, precision) in precisions.into_iter().enumerate().filter(is_meant) {
            let line = |line: String| {
                let line =
                    line.replacen("cc ", &format!("{compiler} {MORE_WARNINGS} {precision} "), 1);
                // GCC reports some warnings only with optimisation; Clang reports all without it.
                if compiler == "clang" { mostly_quick(line) } else { line }
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
fn c_takes_numbers_that_are_none_in_single_precision() {
    if !is_installed("cc --version") {
        return;
    }
    let text = "[field]\ntitle = \"x\"\ndimension = 1\n[parameters]\na = { value = 1e-300 }\n\
        [displacement]\nu = [\"X*t*(a + 1/3 + 1e-200)\"]\n[material]\nmodel = \"neo_hookean\"\n\
        lambda = 1\nmu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n";
    let field = compile_with("tiny", "x.toml", text, &|path| Err(path.into()), &Options::default())
        .unwrap_or_else(|failure| panic!("{failure}"));
    prove(target("c"), &Subject::new(&field), "strict/tiny", |line| {
        line.replacen("cc ", &format!("cc {MORE_WARNINGS} -DTINY_FLOAT "), 1)
    });
}

#[test]
fn cpp_has_no_warning_in_two_compilers() {
    let field = field("conformal_sector_2d", &Options::default());
    for compiler in ["g++", "clang++"] {
        if is_installed(&format!("{compiler} --version")) {
            prove(target("cpp"), &Subject::new(&field), &format!("strict/{compiler}"), |line| {
                let line = line.replacen("c++ ", &format!("{compiler} {MORE_CPP_WARNINGS} "), 1);
                if compiler == "clang++" { mostly_quick(line) } else { line }
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
        format!("sed -i.bak 's/wp = real64/wp = kind(1.0)/' bar_1d.f90 && {}", mostly_quick(line))
    });
}

#[test]
fn numpy_proves_itself_in_single_precision() {
    let python = std::env::var("MMS_PYTHON").unwrap_or("python3".into());
    if !is_installed(&format!("{python} -c 'import numpy'")) {
        return;
    }
    for name in ["generalized_vortex", "self_weight_column", "plane_strain_gent"] {
        let field = field(name, &Options::default());
        let folder = format!("strict/float32/{name}");
        prove(target("numpy"), &Subject::new(&field), &folder, |line| line + " float32");
    }
}

/// Multiplications fused with sums, which some compilers do by default.
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
    options.selection.quantities = Some([mms_spec::quantity::Quantity::BodyForce].into());
    options.selection.twin = mms_spec::twin::Twin::Standard;
    prove(target("c"), &Subject::new(&field("twisted_column", &options)), "strict/part", |line| {
        line
    });
}

/// Reads the blocks of a file, parameters and points; prints values, of formulas as they are parsed and as
/// they are optimised.
const PARSER: &str = r#"
#include <cstdio>
#include <fparser.hh>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

struct Formula {
    FunctionParser plain, optimised;
    std::vector<std::string> symbols;
};

std::map<std::string, Formula> formulas;
std::map<std::string, double> known;
double place[4];

double value(const std::string &name, bool optimised)
{
    const auto found = known.find(name);
    if (found != known.end()) {
        return found->second;
    }
    Formula &formula = formulas.at(name);
    std::vector<double> values;
    for (const std::string &symbol : formula.symbols) {
        values.push_back(value(symbol, optimised));
    }
    values.insert(values.end(), place, place + 4);
    return known[name] = (optimised ? formula.optimised : formula.plain).Eval(values.data());
}

int main()
{
    std::string line, name, names;
    std::map<std::string, double> parameters;
    while (std::getline(std::cin, line)) {
        std::istringstream words(line.substr(1));
        if (line[0] == 'N') {
            words >> name >> names;
        } else if (line[0] == 'F') {
            Formula &formula = formulas[name];
            for (FunctionParser *parser : {&formula.plain, &formula.optimised}) {
                if (parser->Parse(line.substr(1), names) >= 0) {
                    std::printf("%s: %s\n", name.c_str(), parser->ErrorMsg());
                    return 1;
                }
            }
            formula.optimised.Optimize();
        } else if (line[0] == 'S') {
            for (std::string symbol; words >> symbol;) {
                formulas[name].symbols.push_back(symbol);
            }
        } else if (line[0] == 'P') {
            parameters.clear();
            for (double number; words >> name >> number;) {
                parameters[name] = number;
            }
        } else {
            words >> name >> place[0] >> place[1] >> place[2] >> place[3];
            known = parameters;
            const double plain = value(name, false);
            known = parameters;
            std::printf("%.17g %.17g\n", plain, value(name, true));
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
    let build = shell("g++ -O0 parser.cc -lfparser -o parser", &folder);
    assert!(build.status.success(), "{}", String::from_utf8_lossy(&build.stderr));
    // Logarithms near 1, powers and half turns.
    for name in sampled(["plane_strain_gent", "conformal_sector_2d"], 2) {
        let field = field(name, &Options::default());
        let subject = Subject::new(&field);
        let text = (target("moose").emit)(&subject).files.swap_remove(0).text;
        let vectors = subject.vectors();
        let mut questions = blocks(&text);
        let mut expected = Vec::new();
        for (place, callable) in callables(&field).iter().enumerate() {
            if !callable.is_of_places() || !callable.is_of_points() {
                continue;
            }
            for (sample, values) in vectors.samples.iter().zip(&vectors.expected[place]) {
                questions += "P";
                let names = field.field.parameters.iter().map(|it| &it.name.value);
                for (parameter, value) in names.zip(&vectors.sets[sample.set]) {
                    questions += &format!(" ${{{name}_{parameter}}} {value:e}");
                }
                questions += "\n";
                let axis = |axis: usize| sample.coordinates.get(axis).unwrap_or(&0.0);
                let [x, y, z] = [0, 1, 2].map(axis);
                let suffixes = callable.suffixes();
                for (suffix, value) in suffixes.iter().zip(values) {
                    let function = format!("{name}_{}{suffix}", callable.name);
                    questions += &format!("E {function} {x:e} {y:e} {z:e} {:e}\n", sample.time);
                    expected.push(((place, sample.set), *value));
                }
            }
        }
        fs::write(folder.join("questions"), questions).expect("a written file");
        let run = shell("./parser < questions", &folder);
        let answers = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success(), "{name}: {answers}");
        let mut errors = BTreeMap::new();
        assert_eq!(answers.lines().count(), expected.len());
        for (answer, (function, expected)) in answers.lines().zip(expected) {
            let [error, magnitude] = errors.entry(function).or_insert([0.0_f64; 2]);
            for found in answer.split(' ') {
                let found: f64 = found.parse().expect("a number");
                *error = error.max((found - expected).abs());
            }
            *magnitude = magnitude.max(expected.abs());
        }
        for ((place, set), [error, magnitude]) in errors {
            // The promised accuracy of the formulas; in one precision these fields keep it.
            let eps = error / magnitude.max(f64::MIN_POSITIVE) / f64::EPSILON;
            let function = &callables(&field)[place].name;
            assert!(eps <= 64.0, "{name} {function} of set {set}: {eps} eps");
        }
    }
}

/// The blocks of a file as `PARSER` reads them.
fn blocks(text: &str) -> String {
    let mut lines = String::new();
    for block in text.split("\n  [").skip(1).filter(|block| !block.starts_with(']')) {
        let (name, body) = block.split_once("]\n").expect("a name");
        let value = |key: &str| -> Vec<&str> {
            let found = body.split_once(&format!("{key} = '"));
            let value = found.map_or("", |(_, rest)| rest.split('\'').next().unwrap_or(rest));
            value.split_whitespace().collect()
        };
        let mut names = value("symbol_names");
        names.extend(["x", "y", "z", "t"]);
        let (formula, symbols) = (value("expression").join(" "), value("symbol_values").join(" "));
        lines += &format!("N {name} {}\nF{formula}\nS {symbols}\n", names.join(","));
    }
    lines
}
