//! The fibres of a material that is a function of I4, by name.

use super::motion::{Formulas, Quantities};
use super::name::Name;
use super::reading::Reading;
use mms_codegen::compile::Compiled;
use mms_mechanics::tensor::dot;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Expr;

/// A direction in the reference body, and its image.
pub(super) struct Fibres {
    /// a0, along the dimensions that the field has.
    pub direction: Vec<Expr>,
    /// F a0, along the same.
    pub present: Vec<Expr>,
    /// I4 = F a0 . F a0, in space.
    pub stretch: Expr,
}

impl Fibres {
    /// The fibres of a field; `None` if its material has none.
    pub fn read(
        reading: &mut Reading,
        compiled: &Compiled,
        formulas: &Formulas,
        quantities: &Quantities,
    ) -> Option<Self> {
        let derived = compiled.model.fibre.as_ref()?;
        let typed = compiled.field.material.fibre.as_ref()?;
        let dimension = quantities.dimension;
        let all: Vec<Expr> = typed
            .iter()
            .zip(derived)
            .enumerate()
            .map(|(axis, (formula, derived))| {
                let value = formulas.read(reading, formula, *derived);
                let name = Name::indexed("fibre", (axis + 1).to_string());
                reading.named(name, value, "derived")
            })
            .collect();
        let (direction, missing) = all.split_at(dimension);
        let deformation = quantities.tensor(reading, Quantity::DeformationGradient);
        let present = deformation.apply(&mut reading.graph, direction);
        let present: Vec<Expr> = present
            .into_iter()
            .enumerate()
            .map(|(axis, value)| {
                let name = Name::indexed("f", (axis + 1).to_string());
                reading.named(name, value, "derived")
            })
            .collect();
        // Along a dimension that the field lacks, a fibre does not change.
        let squares = present.iter().chain(missing).map(|component| (*component, *component));
        let stretch = dot(&mut reading.graph, squares);
        let stretch = reading.named(Name::plain("I4"), stretch, "derived");
        Some(Fibres { direction: direction.to_vec(), present, stretch })
    }
}
