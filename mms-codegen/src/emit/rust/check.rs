//! The program that checks the module: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use super::comment;
use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::vectors::Vectors;
use crate::emit::text::listed;
use crate::quantity::Shape;

/// The text of `FIELD_check.rs`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let (name, dimension) = (&port.name, port.dimension());
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.rs: runs every function at the points below, prints its worst error, and fails where that is not accepted. {} Numbers are the bits of an `f64`.",
        vectors.meaning()
    ));
    let mut text = comment(&header, "//");
    let _ = write!(
        text,
        "\n#[path = \"{name}.rs\"]\nmod {name};\n\nuse {name}::Real;\n\n\
         const SETS: usize = {};\n\n\
         /// Parameters: the defaults, others, and extremes.\nconst PARAMETERS: [[u64; {}]; SETS] = [\n",
        vectors.sets.len(),
        port.parameters.len()
    );
    vectors.sets.iter().for_each(|set| text += &row(set));
    let _ = write!(
        text,
        "];\n\n/// A point: of which set of parameters, t, X, N and H.\nstruct Sample {{\n    set: usize,\n    \
         t: [u64; 1],\n    X: [u64; {dimension}],\n    N: [u64; {dimension}],\n    H: [u64; {}],\n}}\n\n",
        dimension * dimension
    );
    text = text.replacen("struct Sample", "#[allow(dead_code, non_snake_case)]\nstruct Sample", 1);
    let _ = writeln!(text, "const SAMPLES: [Sample; {}] = [", vectors.samples.len());
    for sample in &vectors.samples {
        let list = |values: &[f64]| row(values).trim().trim_end_matches(',').to_string();
        let _ = writeln!(
            text,
            "    Sample {{\n        set: {},\n        t: {},\n        X: {},\n        N: {},\n        H: {},\n    }},",
            sample.set,
            list(&[sample.time]),
            list(&sample.coordinates),
            list(&sample.normal),
            list(&sample.gradient)
        );
    }
    text += "];\n\n";
    for (callable, expected) in port.callables.iter().zip(&vectors.expected) {
        let (upper, count) = (callable.name.to_ascii_uppercase(), callable.components.len());
        let _ = writeln!(text, "const {upper}: [[u64; {count}]; {}] = [", expected.len());
        expected.iter().for_each(|values| text += &row(values));
        text += "];\n\n";
    }
    text += &include_str!("support/check.rs").replace("field_ ", &format!("{name} "));
    text += "\nfn check<T: Real>(mut errors: Check) -> usize {\n";
    text += &body(port, vectors);
    text += "    errors.conclude()\n}\n\nfn main() {\n    \
             let double = Check::new(\"double precision\", f64::EPSILON, f64::MIN_POSITIVE);\n    \
             let mut failures = check::<f64>(double);\n";
    text += match vectors.accepted_in_single {
        Some(_) => {
            "    let (eps, least) = (f64::from(f32::EPSILON), f64::from(f32::MIN_POSITIVE));\n    \
            failures += check::<f32>(Check::new(\"single precision\", eps, least));\n"
        }
        None => {
            "    failures += 0; // The range of single precision is too small for this field.\n"
        }
    };
    text + "    std::process::exit(i32::from(failures > 0));\n}\n"
}

/// A row of numbers.
fn row(values: &[f64]) -> String {
    let bits: Vec<String> = values.iter().map(|value| format!("{:#x}", value.to_bits())).collect();
    format!("    [{}],\n", listed(&bits, 92).join("\n     "))
}

fn body(port: &Port<'_>, vectors: &Vectors) -> String {
    let name = &port.name;
    let mut text = String::new();
    if !port.parameters.is_empty() {
        let _ = writeln!(text, "    let defaults = {name}::Parameters::<T>::default();");
    }
    for (parameter, value) in port.parameters.values().zip(&vectors.defaults) {
        let _ = writeln!(
            text,
            "    errors.compare(0, &[{:#x}], &[defaults.{parameter}]);\n    \
             errors.settle(\"default of {parameter}\", 1.0);",
            value.to_bits()
        );
    }
    let (first, names): (_, Vec<&str>) =
        ("        let mut parameters = ", port.parameters.values().map(String::as_str).collect());
    let mutable = if names.is_empty() { first.replace("mut ", "") } else { first.into() };
    let values = if names.is_empty() { "_" } else { "values" };
    let _ = writeln!(
        text,
        "    let fields = PARAMETERS.map(|{values}| {{\n{mutable}{name}::Parameters::<T>::default();"
    );
    if !names.is_empty() {
        let targets: Vec<String> = names.iter().map(|name| format!("parameters.{name}")).collect();
        let _ = writeln!(
            text,
            "        [\n            {},\n        ] = of(values);",
            listed(&targets, 84).join("\n            ")
        );
    }
    let _ = writeln!(text, "        {name}::prepare(&parameters)\n    }});");
    let single = vectors.accepted_in_single.as_ref().unwrap_or(&vectors.accepted);
    for (place, callable) in port.callables.iter().enumerate() {
        if !vectors.expected[place].is_empty() {
            text += &check(port, callable, vectors.accepted[place].max(single[place]));
        }
    }
    text
}

fn check(port: &Port<'_>, callable: &Callable, accepted: u32) -> String {
    let dimension = port.dimension();
    let (function, upper) = (&callable.name, callable.name.to_ascii_uppercase());
    if !callable.is_of_points() {
        let found = if callable.is_scalar() { "&[found]" } else { "&found" };
        return format!(
            "    for (set, expected) in {upper}.iter().enumerate() {{\n        \
             let found = fields[set].{function}();\n        errors.compare(set, expected, {found});\n    }}\n    \
             errors.settle(\"{function}\", {accepted}.0);\n"
        );
    }
    let owner = match callable.time {
        true => "fields[sample.set].at_time(of(sample.t)[0])",
        false => "fields[sample.set]",
    };
    let argument = |array: &str| match array {
        "H" => rows("of(sample.H)", dimension),
        array => format!("of(sample.{array})"),
    };
    let arguments: Vec<String> =
        callable.arrays().iter().map(|(array, _)| argument(array)).collect();
    let found = match callable.shape {
        Some(Shape::Scalar) => "&[found]",
        Some(Shape::Tensor) => "found.as_flattened()",
        _ => "&found",
    };
    // Through the function of many points: the first point, whatever it gives, and this one.
    let columns: String = callable
        .arrays()
        .iter()
        .map(|(array, _)| {
            format!(
                "            columns(SAMPLES[0].{array}, sample.{array}).each_ref().map(|it| &it[..]),\n"
            )
        })
        .collect();
    let count = callable.components.len();
    format!(
        "    for (sample, expected) in SAMPLES.iter().zip(&{upper}) {{\n        \
         let subject = {owner};\n        \
         let found = subject.{function}({});\n        \
         errors.compare(sample.set, expected, {found});\n        \
         let mut both = [of::<T, 2>([0; 2]); {count}];\n        \
         subject.{function}_batch(\n{columns}            \
         both.each_mut().map(|it| &mut it[..]),\n        );\n        \
         errors.compare(sample.set, expected, &both.map(|it| it[1]));\n    }}\n    \
         errors.settle(\"{function}\", {accepted}.0);\n",
        arguments.join(", ")
    )
}

/// A list of D x D numbers as rows.
fn rows(list: &str, dimension: usize) -> String {
    let items: Vec<String> = (0..dimension)
        .map(|row| {
            let row: Vec<String> =
                (0..dimension).map(|column| format!("h[{}]", row * dimension + column)).collect();
            format!("[{}]", row.join(", "))
        })
        .collect();
    format!("{{\n            let h = {list};\n            [{}]\n        }}", items.join(", "))
}
