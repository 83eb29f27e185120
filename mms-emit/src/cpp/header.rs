//! The header: types, functions, and what C++ lacks.

use std::fmt::Write as _;

use super::dialect::Cpp;
use crate::c::source::{POINT, WIDE, support};
use crate::c::{broken, comment};
use crate::port::Port;
use crate::port::body::{Bodies, Body, Dialect as _, local};
use crate::port::callable::Callable;
use crate::port::faces;
use crate::port::motion;
use crate::port::support::Calls;
use crate::text::{indented, wrapped};
use mms_program::Value;

/// Functions of a point that C++ lacks: the C functions as templates in the scalar.
fn point(calls: &Calls) -> String {
    let mut text = support(POINT).needed(calls).join("\n\n").replace("REAL(", "T(");
    for name in ["rint", "fabs", "sin", "cos", "copysign", "log1p"] {
        text = text.replace(&format!("MATH({name})"), &format!("std::{name}"));
    }
    text.replace("static real", "template <class T> FIELD_FUNCTION T").replace("real ", "T ")
}

/// Twice the digits of a double: the functions of C, behind operators; empty if none of them is called.
fn wide(mut calls: Calls, has_statements: bool) -> String {
    let support = support(WIDE);
    if !has_statements && !support.defines_any(&calls) {
        return String::new();
    }
    for name in ["wide_neg", "wide_add", "wide_sub", "wide_mul", "wide_div"] {
        calls.to(name);
    }
    let functions = support.needed(&calls).join("\n\n").replace("(void)", "()");
    let functions = functions.replace("static ", "FIELD_FUNCTION ").replace("(int)(", "int(");
    include_str!("support/wide.hpp").trim_end().replace("FUNCTIONS", &functions)
}

/// The text of `FIELD.hpp`.
pub(super) fn text(port: &Port<'_>) -> String {
    let (name, upper) = (&port.name, port.name.to_ascii_uppercase());
    let bodies = port.bodies(&Cpp(port.rows()));
    let (is_wide, calls) = (bodies.are_wide(), bodies.calls());
    let point = point(&calls);
    let supports =
        [wide(calls, is_wide), point].map(|text| text.replace("FIELD_", &format!("{upper}_")));
    let mut header = port.header();
    header.push(format!(
        "Functions are templates in the scalar, declared with {upper}_FUNCTION, so that CUDA and HIP compile them for host and device. Compile with -ffp-contract=off, or with nvcc --fmad=false: what needs only parameters and the time is computed with twice the digits of a double. {name}_check.cpp checks the result."
    ));
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "#ifndef MMS_{upper}_HPP\n#define MMS_{upper}_HPP\n\n#include <cmath>\n#include <cstddef>\n\n\
         #ifndef {upper}_FUNCTION\n#if defined(__CUDACC__) || defined(__HIPCC__)\n\
         #define {upper}_FUNCTION __host__ __device__ inline\n#else\n\
         #define {upper}_FUNCTION inline\n#endif\n#endif\n\n"
    );
    if is_wide {
        text += "#ifdef __FAST_MATH__\n\
                 #error \"-ffast-math takes away the digits that double-double arithmetic gains\"\n\
                 #endif\n\n";
    }
    let _ = write!(text, "namespace {name} {{\n\n");
    if supports.iter().any(|text| !text.is_empty()) {
        text += "namespace detail {\n\n";
        for text_of in supports.iter().filter(|text| !text.is_empty()) {
            text += text_of;
            text += "\n\n";
        }
        text += "} // namespace detail\n\n";
    }
    text += &types(port);
    text += &functions(port, &bodies).replace("FIELD_", &format!("{upper}_"));
    let _ = write!(text, "}} // namespace {name}\n\n#endif\n");
    text
}

fn types(port: &Port<'_>) -> String {
    let mut text = format!(
        "/// The number of space dimensions.\nconstexpr int dimension = {};\n\n",
        port.dimension()
    );
    let claims =
        port.claims(|face, claim| format!("constexpr const char *face_{face} = \"{claim}\";"));
    if !claims.is_empty() {
        let _ = write!(text, "/// {}\n{claims}\n", faces::DOC);
    }
    let motion = port.motion(|end, numbers| {
        format!("constexpr double {end}[dimension] = {{{}}};", numbers.join(", "))
    });
    if !motion.is_empty() {
        let _ = writeln!(text, "{}{motion}", documented(motion::DOC, ""));
    }
    text += "/// The parameters.\ntemplate <class T> struct Parameters {\n";
    for (index, parameter) in &port.parameters {
        text += &documented(&port.parameter_doc(*index), "    ");
        let _ = writeln!(text, "    T {parameter};");
    }
    text += "};\n\n";
    text +=
        "/// The values that depend only on the parameters.\ntemplate <class T> struct Field {\n";
    text += &members("T", &port.kept, false);
    text += &members("detail::wide", &port.kept_wide, true);
    text += "};\n\n";
    text += "/// The values that depend only on the parameters and the time.\ntemplate <class T> struct Instant {\n";
    text += &members("T", &port.kept_at_times, false);
    text + "};\n\n"
}

fn members(kind: &str, values: &[Value], wide: bool) -> String {
    let names: Vec<String> = values.iter().map(|value| local(*value, wide)).collect();
    names.chunks(12).map(|names| format!("    {kind} {};\n", names.join(", "))).collect()
}

/// A text as a comment of documentation.
fn documented(text: &str, indent: &str) -> String {
    let lines = wrapped(&text.replace('\\', "/").replace("??", "? ?"), 94 - indent.len());
    lines.iter().map(|line| format!("{indent}/// {line}\n")).collect()
}

fn functions(port: &Port<'_>, bodies: &Bodies) -> String {
    let mut text = defaults(port, &bodies.defaults) + "\n";
    text += &(prepare(port, &bodies.prepare) + "\n" + &at_time(port, &bodies.at_time) + "\n");
    for (callable, body) in port.with_bodies(bodies) {
        text += &function(port, callable, body);
        text += "\n";
        if callable.is_of_points() {
            text += &batch(callable);
            text += "\n";
        }
    }
    text
}

/// A function with its documentation.
fn definition(doc: &str, result: &str, name: &str, arguments: &[String], body: &str) -> String {
    let head = broken(&format!("{result} {name}"), arguments, "");
    format!("{}template <class T> FIELD_FUNCTION\n{head}\n{{\n{body}}}\n", documented(doc, ""))
}

/// The statements of a body, which find what C++ lacks.
fn statements(body: &Body) -> String {
    let calls_support = [WIDE, POINT].iter().any(|text| support(text).defines_any(&body.calls));
    let using = match body.is_wide || calls_support {
        true => "    using namespace detail;\n",
        false => "",
    };
    using.to_string() + &indented(&body.statements, 4)
}

fn defaults(port: &Port<'_>, body: &Body) -> String {
    let mut text = statements(body) + "    Parameters<T> parameters{};\n";
    for (member, value) in port.parameters.values().zip(&body.results) {
        let _ = writeln!(text, "    parameters.{member} = {value};");
    }
    text += "    return parameters;\n";
    let doc = "The parameters of the field file, or those that were set in their place.";
    definition(doc, "Parameters<T>", "default_parameters", &[], &text)
}

fn prepare(port: &Port<'_>, body: &Body) -> String {
    let mut text = statements(body) + "    Field<T> field{};\n";
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "    field.{} = {result};", local(*value, false));
    }
    for value in &port.kept_wide {
        let wide = local(*value, true);
        let _ = writeln!(text, "    field.{wide} = {wide};");
    }
    text += "    return field;\n";
    let argument = named("const Parameters<T> &", "parameters", body.reads_parameters());
    let doc = "Computes once what only the parameters determine.";
    definition(doc, "Field<T>", "prepare", &[argument], &text)
}

fn at_time(port: &Port<'_>, body: &Body) -> String {
    let mut text = statements(body) + "    Instant<T> now{};\n";
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "    now.{} = {result};", local(*value, false));
    }
    text += "    return now;\n";
    let arguments = [
        named("const Field<T> &", "field", body.reads_kept),
        named("T ", "t", !body.inputs.is_empty()),
    ];
    let doc = "Computes once what the parameters and the time determine.";
    definition(doc, "Instant<T>", "at_time", &arguments, &text)
}

/// An argument; one that is not read has no name.
fn named(kind: &str, name: &str, is_read: bool) -> String {
    if is_read { format!("{kind}{name}") } else { kind.trim_end().into() }
}

fn subject(callable: &Callable, is_read: bool) -> String {
    match callable.time {
        true => named("const Instant<T> &", "now", is_read),
        false => named("const Field<T> &", "field", is_read),
    }
}

/// A function of one point, or of none.
fn function(port: &Port<'_>, callable: &Callable, body: &Body) -> String {
    let dialect = Cpp(port.rows());
    let mut arguments = vec![subject(callable, body.reads_kept)];
    let mut doc = callable.documentation();
    for (array, count) in callable.arrays() {
        let reads = body
            .inputs
            .iter()
            .any(|symbol| dialect.input(*symbol, &port.input(*symbol)).starts_with(array));
        arguments.push(named("const T *", array, reads));
        let _ = write!(doc, " {array}: {count}.");
    }
    let mut text = statements(body);
    let result = if callable.is_scalar() {
        let _ = writeln!(text, "    return {};", body.results[0]);
        "T"
    } else {
        arguments.push("T *out".into());
        let _ = write!(doc, " out: {}.", body.results.len());
        for (index, value) in body.results.iter().enumerate() {
            let _ = writeln!(text, "    out[{index}] = {value};");
        }
        "void"
    };
    definition(&doc, result, &callable.name, &arguments, &text)
}

/// A function of many points: an array for each coordinate and each component.
fn batch(callable: &Callable) -> String {
    let inputs = callable.input_names();
    let mut arguments = vec![subject(callable, true), "std::size_t n".into()];
    arguments.extend(inputs.iter().map(|name| format!("const T *{name}")));
    arguments.extend(callable.components.iter().map(|name| format!("T *{name}")));
    let mut text = "    for (std::size_t i = 0; i < n; i++) {\n".to_string();
    let mut call = vec![if callable.time { "now" } else { "field" }.to_string()];
    let mut left = inputs.iter();
    for (array, count) in callable.arrays() {
        let array = match array {
            "N" => "normal",
            "H" => "gradient",
            _ => "point",
        };
        let items: Vec<_> = left.by_ref().take(count).map(|name| format!("{name}[i]")).collect();
        let _ = writeln!(text, "        const T {array}[] = {{{}}};", items.join(", "));
        call.push(array.into());
    }
    if callable.is_scalar() {
        let _ = writeln!(
            text,
            "        {}[i] = {}({});",
            callable.components[0],
            callable.name,
            call.join(", ")
        );
    } else {
        call.push("out".into());
        let _ = writeln!(text, "        T out[{}];", callable.components.len());
        let _ = writeln!(text, "        {}({});", callable.name, call.join(", "));
        for (index, component) in callable.components.iter().enumerate() {
            let _ = writeln!(text, "        {component}[i] = out[{index}];");
        }
    }
    text += "    }\n";
    let doc = "The same at n points: an array for each coordinate and each component.";
    definition(doc, "void", &format!("{}_batch", callable.name), &arguments, &text)
}
