//! The header: types and declarations.

use super::{broken, comment, documented};
use crate::port::Port;
use crate::port::body::local;
use crate::port::callable::Callable;
use crate::port::faces;
use crate::port::motion;

/// The text of `FIELD.h`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let upper = name.to_ascii_uppercase();
    let mut header = port.header();
    header.push(format!(
        "Numbers are of double precision; define {upper}_FLOAT everywhere for single precision. Compile with -ffp-contract=off: what needs only parameters and the time is computed with twice the digits of a double. {name}_check.c checks the result."
    ));
    let mut text = comment(&header, "");
    text += &format!(
        "#ifndef MMS_{upper}_H\n#define MMS_{upper}_H\n\n#include <stddef.h>\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
         #ifdef {upper}_FLOAT\ntypedef float {name}_real;\n#else\ntypedef double {name}_real;\n#endif\n\n\
         enum {{ {name}_dimension = {} }};\n\n",
        port.dimension()
    );
    let claims = port.claims(|face, claim| {
        format!("#define {upper}_FACE_{} \"{claim}\"", face.to_ascii_uppercase())
    });
    if !claims.is_empty() {
        text += &format!("/** {} */\n{claims}\n", faces::DOC);
    }
    let motion = port.motion(|end, numbers| {
        format!("#define {upper}_{} {{{}}}", end.to_ascii_uppercase(), numbers.join(", "))
    });
    if !motion.is_empty() {
        let doc = format!("{} Initialisers of arrays of a number for each axis.", motion::DOC);
        text += &format!("{}{motion}\n", documented(&[doc], ""));
    }
    text += &types(port);
    text += &functions(port);
    text += "#ifdef __cplusplus\n}\n#endif\n\n#endif\n";
    text
}

fn types(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut text = String::new();
    if !port.kept_wide.is_empty() {
        text += &format!(
            "/** A number of twice the digits of a double. */\n\
             typedef struct {{ double high, low; }} {name}_wide;\n\n"
        );
    }
    text += "/** The parameters. */\ntypedef struct {\n";
    for (index, parameter) in &port.parameters {
        text += &documented(&[port.parameter_doc(*index)], "    ");
        text += &format!("    {name}_real {parameter};\n");
    }
    text += &closed(&format!("{name}_parameters"), port.parameters.is_empty());
    text += "/** The values that depend only on the parameters. */\ntypedef struct {\n";
    text += &members(&format!("{name}_real"), port.kept.iter().map(|it| local(*it, false)));
    text += &members(&format!("{name}_wide"), port.kept_wide.iter().map(|it| local(*it, true)));
    let is_empty = port.kept.is_empty() && port.kept_wide.is_empty();
    text += &closed(&format!("{name}_field"), is_empty);
    text +=
        "/** The values that depend only on the parameters and the time. */\ntypedef struct {\n";
    text +=
        &members(&format!("{name}_real"), port.kept_at_times.iter().map(|it| local(*it, false)));
    text + &closed(&format!("{name}_instant"), port.kept_at_times.is_empty())
}

/// The end of a type: C has no struct without members.
fn closed(name: &str, is_empty: bool) -> String {
    format!("{}}} {name};\n\n", if is_empty { "    char none;\n" } else { "" })
}

fn members(kind: &str, names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    names.chunks(12).map(|names| format!("    {kind} {};\n", names.join(", "))).collect()
}

fn functions(port: &Port<'_>) -> String {
    let name = &port.name;
    let at_time = [format!("const {name}_field *field"), format!("{name}_real t")];
    let mut text = format!(
        "/** The parameters of the field file, or those that were set in their place. */\n\
         {name}_parameters {name}_default_parameters(void);\n\n\
         /** Computes once what only the parameters determine. */\n\
         {name}_field {name}_prepare(const {name}_parameters *parameters);\n\n\
         /** Computes once what the parameters and the time determine. */\n\
         {};\n\n",
        broken(&format!("{name}_instant {name}_at_time"), &at_time, "")
    );
    if port.callables.iter().any(Callable::is_of_points) {
        text += &comment(
            &["Vectors are arrays of a component per axis, tensors have their rows one after another. The functions whose names end in _batch are of n points: of an array for each coordinate and each component. No array may overlap another.".into()],
            "",
        );
        text += "\n";
    }
    for callable in &port.callables {
        text += &documented(&[callable.documentation()], "");
        text += &format!("{};\n", head(port, callable));
        if callable.is_of_points() {
            text += &format!("{};\n", batch_head(port, callable, ""));
        }
        text += "\n";
    }
    text
}

/// The first argument of a function: the field at a time, or the prepared field if the function does not depend on time.
pub(super) fn subject(port: &Port<'_>, callable: &Callable) -> String {
    let name = &port.name;
    match callable.time {
        true => format!("const {name}_instant *now"),
        false => format!("const {name}_field *field"),
    }
}

/// The head of a function of one point.
pub(super) fn head(port: &Port<'_>, callable: &Callable) -> String {
    let name = &port.name;
    let mut arguments = vec![subject(port, callable)];
    for (array, count) in callable.arrays() {
        arguments.push(format!("const {name}_real {array}[{count}]"));
    }
    let start = match callable.is_scalar() {
        true => format!("{name}_real {name}_{}", callable.name),
        false => {
            arguments.push(format!("{name}_real out[{}]", callable.components.len()));
            format!("void {name}_{}", callable.name)
        }
    };
    broken(&start, &arguments, "")
}

/// The head of a function of many points; `restrict` is the qualifier of its arrays, or empty.
pub(super) fn batch_head(port: &Port<'_>, callable: &Callable, restrict: &str) -> String {
    let name = &port.name;
    let mut arguments = vec![subject(port, callable), "size_t n".into()];
    let inputs = callable.input_names();
    arguments.extend(inputs.iter().map(|it| format!("const {name}_real *{restrict}{it}")));
    let results = callable.components.iter();
    arguments.extend(results.map(|it| format!("{name}_real *{restrict}{it}")));
    broken(&format!("void {name}_{}_batch", callable.name), &arguments, "")
}
