//! The machine code of emitted code.

use mms_files::read::{self, FileKind};
use mms_program::precision::Precision;

use super::Workbench;
use super::module::{Call, Module, ModuleForm, scalar};

/// An object file with every function called from parameters, time and position to every quantity of a module: `prepare`,
/// `at_time`, the functions that keep points if points are kept, a function for each quantity, and every function that the
/// compiler adds for these and does not find in `mms-math`.
pub fn object(
    bench: &Workbench,
    module: &Module<'_>,
    precision: Precision,
    way: ModuleForm,
) -> anyhow::Result<Vec<u8>> {
    module.write(bench)?;
    let mut source = format!(
        "#![allow(warnings)]
mod {name};
use {name}::*;
use mms_math::Double;

type Number = {number};
type One = [Number; {dimension}];
type Many<'a> = [&'a [Number]; {dimension}];

#[unsafe(no_mangle)]
pub fn to_field(parameters: [Number; NAMES.len()]) -> Field<Number> {{
    prepare(&Parameters::from_array(parameters))
}}

#[unsafe(no_mangle)]
pub fn to_time(field: &Field<Number>, t: Number) -> AtTime<'_, Number> {{
    field.at_time(t)
}}
",
        name = module.name,
        number = scalar(precision),
        dimension = module.dimension(),
    );
    source += match way {
        ModuleForm::Single | ModuleForm::Batch => "",
        ModuleForm::SingleKept => {
            "
#[unsafe(no_mangle)]
pub fn to_kept(field: &Field<Number>, point: One) -> Point<Number> {
    field.at_point(point)
}
"
        }
        ModuleForm::BatchKept => {
            "
#[unsafe(no_mangle)]
pub fn to_kept(field: &Field<Number>, points: Many) -> Points<Number> {
    field.at_points(points)
}
"
        }
    };
    source.extend(Call::all(module, precision, way).map(|call| entry(&call)));
    bench.write("code.rs", &source)?;
    // In one piece, so that there is one file.
    let options = ["--crate-type", "lib", "--emit", "obj", "-C", "codegen-units=1"];
    Ok(read::bytes(&bench.compile("code.rs", "code.o", &options)?, FileKind::Object)?)
}

/// A function that can be called from elsewhere, so that it is compiled.
fn entry(call: &Call<'_>) -> String {
    let (position, normal) = match call.way {
        ModuleForm::Single => ("One", "One"),
        ModuleForm::SingleKept => ("&Point<Number>", "One"),
        ModuleForm::Batch => ("Many", "Many"),
        ModuleForm::BatchKept => ("&Points<Number>", "Many"),
    };
    let mut arguments = vec![("position", position.to_string())];
    if call.takes_normals() {
        arguments.push(("normal", normal.to_string()));
    }
    if call.way.is_batch() {
        arguments.push(("out", format!("[&mut [Number]; {}]", call.components())));
    }
    let typed: Vec<_> = arguments.iter().map(|(name, kind)| format!("{name}: {kind}")).collect();
    let names: Vec<_> = arguments.iter().map(|(name, _)| *name).collect();
    let (function, typed, names) = (call.function(), typed.join(", "), names.join(", "));
    format!(
        "
#[unsafe(no_mangle)]
pub fn to_{function}(now: &AtTime<'_, Number>, {typed}) -> impl Sized {{
    now.{function}({names})
}}
"
    )
}
