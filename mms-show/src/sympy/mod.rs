//! A script for an auditor: Python that derives every quantity once more, with SymPy, from the formulas of the
//! field and its material as they were typed, and compares the values.
//!
//! It is made from the trees of the typed formulas. It shares only the parser with the compiler: no graph, no derivative, no
//! material law. Its fixed parts are Python files beside the code.

mod own;
mod python;

use mms_codegen::compile::Compiled;
use mms_mechanics::Output;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::sample::{Sample, samples};
use mms_program::interpret::{Interpreter, Point};
use mms_spec::foreign::{Foreign, blanked};
use mms_spec::own::Part;
use mms_spec::syntax;
use mms_spec::{FieldSpec, Formula, RigidSpec, Rotation, Space};
use mms_symbolic::sorted::SortedSet;
use python::{Renamed, python};

/// The number of points at which the values are compared.
pub const POINTS: usize = 3;

/// The number of points tried to find [`POINTS`] where everything is defined.
const TRIED: usize = 64;

/// A field without a value at points where it should be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Undefined;

/// The script of a field: prints a table of the largest differences, and exits with 1 if one of them
/// is too large. It needs Python 3.10 and SymPy. An error where there are not enough points at which
/// all quantities are finite numbers.
pub fn script(compiled: &Compiled) -> Result<String, Undefined> {
    let values = values(compiled)?;
    let mut text = head(compiled);
    text.push_str(include_str!("head.py"));
    text.push_str("\n\n");
    text.push_str(&field(compiled));
    text.push_str("\n\n");
    text.push_str(&strain_energy(compiled));
    text.push_str("\n\n");
    let space = compiled.field.space;
    if compiled.field.rigid.is_some() {
        text.push_str(include_str!("rigid.py"));
        text.push_str("\n\n");
    }
    let is_small = if compiled.model.kind == InvariantKind::SmallStrain { "True" } else { "False" };
    text.push_str(&format!("SMALL_STRAIN = {is_small}\n"));
    let fluxes = compiled.model.own.keys().filter(|own| own.part == Part::NormalFlux);
    let fluxes: Vec<_> = fluxes.map(|own| format!("\"{}\"", own.name)).collect();
    text.push_str(&format!("NORMAL_FLUXES = [{}]\n\n\n", fluxes.join(", ")));
    text.push_str(include_str!("derive.py"));
    text.push_str("\n\n");
    if space.is_axisymmetric() {
        text.push_str(&format!("VECTOR = {}\n\n\n", space.vector()));
        text.push_str(include_str!("section.py"));
        text.push_str("\n\n");
    }
    text.push_str(&values);
    text.push_str("\n\n");
    text.push_str(include_str!("compare.py"));
    Ok(text)
}

fn head(compiled: &Compiled) -> String {
    let field = &compiled.field;
    let mut lines = vec![
        "#!/usr/bin/env python3".to_string(),
        format!(
            "# Audit of the field {}: {}",
            field.name.in_a_comment(),
            field.title.in_a_comment()
        ),
    ];
    lines.extend(field.reference.iter().map(|reference| format!("# {}", reference.in_a_comment())));
    lines.push(format!("# Written by {}", compiled.provenance()));
    lines.push("#\n".into());
    lines.join("\n")
}

fn translated(formula: &Formula, names: &Renamed) -> String {
    // The field compiled: its formulas have been parsed before.
    let ast = syntax::parse(formula, &mut Vec::new());
    ast.map(|ast| python(&ast, names)).unwrap_or_default()
}

/// The formulas of the field file.
fn field(compiled: &Compiled) -> String {
    let field = &compiled.field;
    let parameters = field.parameters.iter().map(|parameter| parameter.name.value.as_str());
    let lets = field.lets.iter().map(|definition| definition.name.value.as_str());
    let givens = field.givens.iter().map(|given| given.name.value.as_str());
    let of_material = compiled.material.givens.iter().map(|given| given.name.value.as_str());
    let used = own::used(compiled);
    let all = parameters.chain(lets).chain(givens).chain(of_material);
    let all: SortedSet<&str> = all.chain(used.iter().map(String::as_str)).collect();
    let names = Renamed::new(all.into_iter());
    let axes = axes(field);
    let name = if field.space.is_axisymmetric() { "meridian" } else { "field" };
    let mut lines = vec![format!("def {name}({axes}, t):")];
    lines.push(
        "    \"\"\"The field file: u, rho0, the arguments of the material, the fibres, quantities of its own.\"\"\""
            .into(),
    );
    for parameter in &field.parameters {
        let (name, value) =
            (names.name(&parameter.name.value), translated(&parameter.value, &names));
        let unit = parameter.unit.as_ref().map(|unit| format!("[{}]", unit.value));
        let doc = parameter.doc.iter().map(Foreign::in_a_comment);
        let note = blanked(&doc.chain(unit).collect::<Vec<_>>().join(" "));
        let note = if note.is_empty() { note } else { format!("  # {note}") };
        lines.push(format!("    {name} = {value}{note}"));
    }
    for definition in &field.lets {
        let value = translated(&definition.value, &names);
        lines.push(format!("    {} = {value}", names.name(&definition.name.value)));
    }
    let own = field.givens.iter().map(|given| (&given.name.value, &given.value));
    let of_material = field.material.givens.iter().map(|(name, value)| (&name.value, value));
    for (name, value) in own.chain(of_material) {
        lines.push(format!("    {} = {}", names.name(name), translated(value, &names)));
    }
    lines.push("    u = [".into());
    lines.extend(field.displacement.iter().map(|u| format!("        {},", translated(u, &names))));
    if field.space == (Space::Axisymmetric { swirl: false }) {
        lines.push("        Integer(0),".into());
    }
    lines.push("    ]".into());
    if let Some(rigid) = &field.rigid {
        lines.push(format!("    u = {}", moved(rigid, field.space, &axes, &names)));
    }
    lines.extend(own::definitions(compiled, &names));
    lines.extend(own::quantities(compiled, &names));
    lines.push("    return (".into());
    lines.push("        u,".into());
    let density = field.material.density.as_ref();
    let density = density.map_or("Integer(1)".into(), |it| translated(it, &names));
    lines.push(format!("        {density},"));
    lines.push("        {".into());
    let inner = material_names(compiled);
    lines.extend(field.material.arguments.iter().map(|(name, value)| {
        format!("            \"{}\": {},", inner.name(&name.value), translated(value, &names))
    }));
    lines.extend(field.material.givens.iter().map(|(name, _)| {
        format!("            \"{}\": {},", inner.name(&name.value), names.name(&name.value))
    }));
    lines.push("        },".into());
    // A material without fibres ignores their direction.
    let fibre = match &field.material.fibre {
        Some(fibre) => fibre.iter().map(|component| translated(component, &names)).collect(),
        None => vec!["Integer(0)".to_string(); 3],
    };
    lines.push(format!("        [{}],", fibre.join(", ")));
    lines.push("        own,".into());
    lines.push("    )\n".into());
    lines.join("\n")
}

/// The names of the coordinates, as arguments.
fn axes(field: &FieldSpec) -> String {
    field.space.axes()[..field.dimension].join(", ")
}

/// The displacement u after a rigid motion.
fn moved(rigid: &RigidSpec, space: Space, axes: &str, names: &Renamed) -> String {
    let list = |formulas: &[Formula]| {
        let entries: Vec<_> = formulas.iter().map(|formula| translated(formula, names)).collect();
        format!("[{}]", entries.join(", "))
    };
    if space.is_axisymmetric() {
        let along = rigid.translation.iter().flatten().nth(1);
        let along = along.map_or("0".into(), |formula| translated(formula, names));
        return format!("[u[0], u[1] + {along}, u[2]]");
    }
    let mut arguments = vec![format!("[{axes}]"), "u".into()];
    if let Some(angle) = rigid.angle() {
        arguments.push(format!("angle={}", translated(angle, names)));
    }
    if let Some(Rotation::Space { axis, .. }) = &rigid.rotation {
        arguments.push(format!("axis={}", list(axis)));
    }
    if let Some(translation) = &rigid.translation {
        arguments.push(format!("translation={}", list(translation)));
    }
    format!("moved({})", arguments.join(", "))
}

fn material_names(compiled: &Compiled) -> Renamed {
    let material = &compiled.material;
    let lets = material.lets.iter().map(|definition| definition.name.value.as_str());
    Renamed::new(material.names().chain(lets))
}

/// The formulas of the material file.
fn strain_energy(compiled: &Compiled) -> String {
    let material = &compiled.material;
    let names = material_names(compiled);
    let parameters: String =
        material.names().map(|name| format!(", {}", names.name(name))).collect();
    let invariants = "I1, I2, I3, J, I4, eps_trace, eps_squared";
    let mut lines = vec![format!("def strain_energy({invariants}{parameters}):")];
    lines.push(format!(
        "    # {}: {}",
        material.name.in_a_comment(),
        material.title.in_a_comment()
    ));
    for definition in &material.lets {
        let value = translated(&definition.value, &names);
        lines.push(format!("    {} = {value}", names.name(&definition.name.value)));
    }
    lines.push(format!("    return {}\n", translated(&material.strain_energy, &names)));
    lines.join("\n")
}

/// A unit vector without equal components.
fn normal(dimension: usize) -> &'static [f64] {
    match dimension {
        1 => &[1.0],
        2 => &[0.6, 0.8],
        _ => &[0.48, 0.6, 0.64],
    }
}

/// The values that the program has at some points, in double precision.
fn values(compiled: &Compiled) -> Result<String, Undefined> {
    let parameters = compiled.parameters::<f64>(&Default::default());
    let outputs: Vec<_> = compiled.quantities().map(Output::Quantity).collect();
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&outputs);
    let normal = normal(compiled.field.dimension);
    let mut points = Vec::new();
    let tried = samples(&compiled.program, &parameters, TRIED);
    // The first points of the sequence lie on lines of symmetry.
    for Sample { coordinates, time } in tried.iter().skip(POINTS) {
        interpreter.set_time(time);
        interpreter.set_point(&plan, Point { coordinates, normal, gradient: &[] });
        let values: Vec<Vec<f64>> =
            outputs.iter().map(|output| interpreter.output(*output)).collect();
        if values.iter().flatten().all(|value| value.is_finite()) && points.len() < POINTS {
            points.push(point(compiled, coordinates, *time, &values));
        }
    }
    if points.len() < POINTS {
        return Err(Undefined);
    }
    Ok(format!(
        "# The values of mms, computed in double precision, at points of the domain.\n\
         NORMAL = {normal:?}\nPOINTS = [\n{}]\n",
        points.concat()
    ))
}

fn point(compiled: &Compiled, coordinates: &[f64], time: f64, values: &[Vec<f64>]) -> String {
    let values = compiled.quantities().zip(values).map(|(quantity, components)| {
        format!("            \"{}\": {components:?},\n", quantity.name())
    });
    let values: String = values.collect();
    format!(
        "    {{\n        \"X\": {coordinates:?},\n        \"t\": {time:?},\n        \"values\": {{\n{values}        }},\n    }},\n"
    )
}
