//! The field in space whose section is an axisymmetric field, as the text of a file: X = (R cos theta, R sin theta, Z), and u
//! turns with theta.

use crate::boundary::{Claim, Face};
use crate::domain::{BodySpec, is_zero};
use crate::field::FieldSpec;
use crate::foreign::Foreign;
use crate::formula::Formula;

/// The text of the field in space whose section is an axisymmetric field. The body is the part of the body of revolution away
/// from the axis, where R has no derivative. `model` is the material: a name that ships, or the path of a file from the folder
/// of the text.
///
/// # Errors
/// The first property of the field that a file in space cannot have: given fields, further balances, a rigid motion, or
/// Cartesian coordinates.
pub fn in_space(field: &FieldSpec, model: &str) -> Result<String, &'static str> {
    let refused = [
        (!field.space.is_axisymmetric(), "it is not axisymmetric"),
        (!field.givens.is_empty() || !field.material.givens.is_empty(), "it has given fields"),
        (!field.balances.is_empty(), "it has further balances"),
        (field.rigid.is_some(), "it has a rigid motion"),
    ];
    if let Some((_, why)) = refused.into_iter().find(|(is_there, _)| *is_there) {
        return Err(why);
    }
    let (axial, turning) = (quoted(&field.displacement[1].text), field.displacement.get(2));
    let [along_x, along_y] = turned(&field.displacement[0], turning);
    let mut text = format!("[field]\ntitle = {}\ndimension = 3\n", word(&field.title));
    text +=
        &field.reference.iter().map(|it| format!("reference = {}\n", word(it))).collect::<String>();
    text += &parameters(field);
    text += "\n[let]\nR = \"sqrt(X^2 + Y^2)\"\n";
    for definition in &field.lets {
        text += &format!("{} = {}\n", definition.name.value, quoted(&definition.value.text));
    }
    text += &format!("\n[displacement]\nu = [{along_x}, {along_y}, {axial}]\n");
    text += &material(field, model);
    text += &body(field);
    Ok(text)
}

/// The components along X and Y of a vector with these along R and theta.
fn turned(radial: &Formula, around: Option<&Formula>) -> [String; 2] {
    let radial = radial.text.trim();
    let around = around.map(|it| it.text.trim()).filter(|it| *it != "0");
    let with =
        |radial: String, around: Option<String>| quoted(&(radial + &around.unwrap_or_default()));
    [
        with(format!("({radial})*X/R"), around.map(|it| format!(" - ({it})*Y/R"))),
        with(format!("({radial})*Y/R"), around.map(|it| format!(" + ({it})*X/R"))),
    ]
}

fn parameters(field: &FieldSpec) -> String {
    if field.parameters.is_empty() {
        return String::new();
    }
    let line = |it: &crate::symbols::ParameterSpec| {
        let mut parts = vec![format!("value = {}", quoted(&it.value.text))];
        parts.extend(it.unit.iter().map(|unit| format!("unit = {}", quoted(&unit.value))));
        parts.extend(it.symbol.iter().map(|symbol| format!("symbol = {}", quoted(&symbol.value))));
        parts.extend(it.doc.iter().map(|doc| format!("doc = {}", word(doc))));
        parts.extend(it.range.iter().map(|[least, most]| {
            format!("range = [{}, {}]", quoted(&least.text), quoted(&most.text))
        }));
        format!("{} = {{ {} }}\n", it.name.value, parts.join(", "))
    };
    format!("\n[parameters]\n{}", field.parameters.iter().map(line).collect::<String>())
}

fn material(field: &FieldSpec, model: &str) -> String {
    let used = &field.material;
    let mut text = format!("\n[material]\nmodel = {}\n", quoted(model));
    for (name, value) in &used.arguments {
        text += &format!("{} = {}\n", name.value, quoted(&value.text));
    }
    if let Some(density) = &used.density {
        text += &format!("density = {}\n", quoted(&density.text));
    }
    if let Some([radial, axial, around]) = used.fibre.as_deref() {
        let [x, y] = turned(radial, Some(around));
        text += &format!("fibre = [{x}, {y}, {}]\n", quoted(&axial.text));
    }
    text
}

fn body(field: &FieldSpec) -> String {
    let mut text = "\n[domain]\n".to_owned();
    match &field.domain.body {
        BodySpec::Box { lower, upper } => {
            let outer = upper[0].text.trim();
            let inner = match is_zero(&lower[0]) {
                true => format!("({outer})/8"),
                false => lower[0].text.clone(),
            };
            text += &format!(
                "shape = \"cylinder\"\ninner = {}\nouter = {}\nz = [{}, {}]\n",
                quoted(&inner),
                quoted(outer),
                quoted(&lower[1].text),
                quoted(&upper[1].text)
            );
        }
        _ => text += "shape = \"none\"\n",
    }
    if let Some([first, last]) = &field.domain.time {
        text += &format!("time = [{}, {}]\n", quoted(&first.text), quoted(&last.text));
    }
    let claims: Vec<String> = field.boundary.iter().map(claim).collect();
    if !claims.is_empty() {
        text += &format!("\n[boundary]\n{}", claims.concat());
    }
    text
}

/// The claim about the face of the body in space. If the section ends at the axis, the body in space has a face there, on which
/// u is prescribed.
fn claim(it: &crate::boundary::BoundarySpec) -> String {
    let (face, is_round) = match it.face.value {
        Face::RadialMin => ("inner", true),
        Face::RadialMax => ("outer", true),
        Face::AxialMin => ("z_min", false),
        _ => ("z_max", false),
    };
    let claim = match it.claim.value {
        Claim::Axis => Claim::Prescribed,
        // Rollers are for planes.
        Claim::Roller if is_round => Claim::Prescribed,
        other => other,
    };
    format!("{face} = \"{}\"\n", claim.name())
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.trim().to_owned()).to_string()
}

fn word(text: &Foreign) -> String {
    quoted(text.raw())
}
