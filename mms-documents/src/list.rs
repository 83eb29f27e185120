//! The documents of `mms list`.

use serde::{Deserialize, Serialize};

use crate::value::Names;

/// The document of `mms list`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct List {
    /// The fields of the gallery.
    pub fields: Vec<ListedField>,
    /// The materials that are shipped.
    pub materials: Vec<String>,
    /// The shape functions of the solver.
    pub shapes: Vec<String>,
    /// The time integrators of the solver.
    pub integrators: Vec<String>,
    /// The formulations.
    pub formulations: Vec<String>,
    /// The transfers between particles and grid.
    pub transfers: Vec<String>,
    /// The precisions.
    pub precisions: Vec<String>,
    /// `stable` and `fast`.
    pub forms: Vec<String>,
    /// The codes whose files have a profile, for `--from`.
    pub profiles: Vec<String>,
}

/// A field of the gallery.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListedField {
    /// The name.
    pub name: String,
    /// The title of the field.
    pub title: String,
    /// The number of dimensions, 1 to 3.
    pub dimension: usize,
    /// The name of the material.
    pub material: String,
    /// The publication of the field; null if the file names none.
    pub reference: Option<String>,
    /// `box`, `annulus`, `disk`, `cylinder`, `sphere`, `polygon` or `none`.
    pub body: String,
    /// The claim on each face.
    pub boundary: Names<String>,
    /// `undeformed, at rest`, `deformed, moving` or alike; `static` if the field has no time.
    pub starts: Option<String>,
    /// The quantities that have a closed form in the file.
    pub checks: Vec<String>,
    /// The studies of the file.
    pub studies: Vec<ListedStudy>,
}

/// A study of a field file. Keys that the file leaves out are null.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListedStudy {
    /// The shape function.
    pub shape: String,
    /// The time integrator.
    pub integrator: String,
    /// The formulation: `updated` or `total`.
    pub formulation: Option<String>,
    /// The transfer between particles and grid.
    pub transfer: Option<String>,
    /// The arrangement of the particles.
    pub fill: Option<String>,
    /// The precision: `f32` or `f64`.
    pub precision: Option<String>,
    /// The form of the code: `stable` or `fast`.
    pub form: Option<String>,
    /// The cells of each level, from coarse to fine.
    pub cells: Vec<usize>,
    /// The order that the study must show.
    pub order: f64,
    /// The reason why that order is expected.
    pub reason: Option<String>,
}
