//! The complete stability results of a field.

use mms_codegen::compile::Compiled;
use mms_spec::Space;

use crate::corners::{Corner, corners};
use crate::faces::{Surface, surfaces};
use crate::growth::{Growth, growth};
use crate::resting::Material;
use crate::subject::{Formulas, Subject};
use crate::wavelength::shortest_wavelength;
use crate::waves::{Waves, waves};

/// The stability of a field, at the defaults of its parameters.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The material at F = I; `None` if it is not finite, and for axisymmetric fields.
    pub material: Option<Material>,
    /// Short waves in the body; `None` if no state is finite.
    pub waves: Option<Waves>,
    /// Short waves on every face that is loaded, free or on rollers.
    pub surfaces: Vec<Surface>,
    /// The corners of these faces.
    pub corners: Vec<Corner>,
    /// Long waves; `None` if no displacement is free.
    pub growth: Option<Growth>,
    /// Whether faces, corners and long waves were evaluated: not for polygons, and not without a body.
    pub has_mesh: bool,
    /// Whether the field is axisymmetric: then nothing is evaluated.
    pub is_axisymmetric: bool,
    /// Whether the budget ended early: disturbances that were not evaluated may grow.
    pub is_spent: bool,
    /// Whether u does not depend on t.
    pub is_static: bool,
    /// The shortest wavelength of u; `None` if u is linear along all axes.
    pub shortest_wavelength: Option<f64>,
}

/// Searches for disturbances that grow.
pub fn judge(compiled: &Compiled) -> Stability {
    let formulas = Formulas::new(compiled);
    match compiled.field.space {
        Space::Axisymmetric { .. } => unseen(compiled),
        Space::Cartesian(1) => judged::<1>(compiled, &formulas),
        Space::Cartesian(2) => judged::<2>(compiled, &formulas),
        Space::Cartesian(_) => judged::<3>(compiled, &formulas),
    }
}

/// The result for an axisymmetric field, whose disturbances are not computed.
fn unseen(compiled: &Compiled) -> Stability {
    Stability {
        material: None,
        waves: None,
        surfaces: Vec::new(),
        corners: Vec::new(),
        growth: None,
        has_mesh: false,
        is_axisymmetric: true,
        is_spent: false,
        is_static: compiled.model.domain.is_static,
        shortest_wavelength: shortest_wavelength(compiled),
    }
}

fn judged<const D: usize>(compiled: &Compiled, formulas: &Formulas) -> Stability {
    let mut subject = Subject::<D>::new(compiled, formulas);
    let is_block = subject.chart.is_block();
    let has_body = !compiled.field.domain.body.is_nothing();
    Stability {
        material: Material::of_subject(&mut subject),
        waves: has_body.then(|| waves(&mut subject)).flatten(),
        surfaces: if is_block { surfaces(compiled, &mut subject) } else { Vec::new() },
        corners: if is_block { corners(compiled, &mut subject) } else { Vec::new() },
        growth: is_block.then(|| growth(compiled, &mut subject)).flatten(),
        has_mesh: is_block,
        is_axisymmetric: false,
        is_spent: formulas.is_spent(),
        is_static: subject.is_static,
        shortest_wavelength: shortest_wavelength(compiled),
    }
}
