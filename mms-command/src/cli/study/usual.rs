//! The formulation and the shape function of a study whose options leave them open: those that keep their order on the body of
//! the field, as docs/orders.md shows.

use mms_options::method::MethodOptions;
use mms_runtime::{FormulationName, ShapeName};
use mms_spec::{BodySpec, FieldSpec};

use super::super::methods::Given;

/// The formulation and the shape function for a field: on a box of two or three dimensions particles stay in their cells of the
/// reference body; for a bar or a round body, the file's first `[[study]]` decides, if it has one.
fn usual(field: &FieldSpec) -> (FormulationName, ShapeName) {
    let is_box = is_box(field);
    let named = field.studies.first().filter(|_| !is_box || field.dimension == 1);
    let named = named.and_then(|it| {
        let formulation = it.formulation.as_deref().unwrap_or("updated");
        Some((formulation.parse().ok()?, it.shape.parse().ok()?))
    });
    named.unwrap_or(match is_box {
        true => (FormulationName::Total, ShapeName::Linear),
        false => (FormulationName::Updated, ShapeName::Cpdi),
    })
}

/// The formulation for a shape function: the usual one of the body, unless the domains of the shape function follow the motion.
fn formulation_for(shape: ShapeName, field: &FieldSpec) -> FormulationName {
    match shape {
        ShapeName::Cpgimp | ShapeName::Cpdi => FormulationName::Updated,
        _ => usual(field).0,
    }
}

/// Whether the body is a box.
pub fn is_box(field: &FieldSpec) -> bool {
    matches!(field.domain.body, BodySpec::Box { .. })
}

/// Options with the formulation and the shape function that were not given.
pub fn filled(options: &MethodOptions, given: Given, field: &FieldSpec) -> MethodOptions {
    let (formulation, shape) = match (given.formulation, given.shape) {
        (true, true) => return options.clone(),
        (false, true) => (formulation_for(options.shape, field), options.shape),
        (false, false) => usual(field),
        (true, false) if usual(field).0 == options.formulation => usual(field),
        (true, false) => {
            let shape = match (options.formulation, is_box(field)) {
                (FormulationName::Total, true) => ShapeName::Linear,
                (FormulationName::Total, false) => ShapeName::QuadraticBspline,
                (FormulationName::Updated, true) => ShapeName::Cpgimp,
                (FormulationName::Updated, false) => ShapeName::Cpdi,
            };
            (options.formulation, shape)
        }
    };
    let mut filled = options.clone();
    (filled.formulation, filled.shape) = (formulation, shape);
    filled
}
