//! The documents of `mms show`.

use serde::{Deserialize, Serialize};

use crate::value::Names;

/// The document of `mms show FIELD`. Formulas are in the language of field files.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Show {
    /// The name of the field.
    pub field: String,
    /// The title of the field.
    pub title: String,
    /// The number of dimensions, 1 to 3.
    pub dimension: usize,
    /// The publication of the field.
    pub reference: Option<String>,
    /// The name of the material.
    pub material: String,
    /// The strain energy W.
    pub strain_energy: String,
    /// The formulas of the material's parameters.
    pub material_parameters: Names<String>,
    /// P at F = I in Pa; if P is 0 in the dimensions of the field, P in three dimensions. Null if it is 0 or not known.
    pub rest_stress: Option<Vec<f64>>,
    /// The moduli at F = I in the middle of the body; null if the material is not isotropic there.
    pub moduli_at_rest: Option<Moduli>,
    /// The moduli at F = I of a material with fibres; null for others.
    pub transverse_moduli_at_rest: Option<TransverseModuli>,
    /// The bounds of x along each axis, over body, time window and ranges of parameters.
    pub extent: Vec<[f64; 2]>,
    /// The shortest wavelength of u in a sample; null if u is linear along each axis, or if the search takes too long.
    pub shortest_wavelength: Option<f64>,
    /// The density rho0; null if the field has none.
    pub density: Option<String>,
    /// The definitions of the file.
    pub definitions: Names<String>,
    /// The claim on each face.
    pub boundary: Names<String>,
    /// The requested quantities.
    pub quantities: Names<ShownQuantity>,
    /// The operations of all these quantities.
    pub operations: OperationCounts,
    /// The terms that the field shows; null if only some quantities were requested.
    pub visibility: Option<Visibility>,
}

/// The moduli of an isotropic material.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Moduli {
    /// Lame's first modulus.
    pub lambda: f64,
    /// The shear modulus.
    pub mu: f64,
    /// Young's modulus.
    pub young: f64,
    /// Poisson's ratio.
    pub nu: f64,
}

/// The moduli of a material with fibres. Of two numbers, the first is along the fibres and the second across them.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TransverseModuli {
    /// The direction of the fibres.
    pub axis: Vec<f64>,
    /// Young's moduli.
    pub young: Vec<f64>,
    /// Poisson's ratios under a pull.
    pub nu: Vec<f64>,
    /// The shear moduli: in planes with the fibres, and in the plane across them.
    pub shear: Vec<f64>,
}

/// The formula of a quantity.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ShownQuantity {
    /// The symbol of each component.
    pub symbols: Vec<String>,
    /// The definitions that the formulas use, each made of earlier ones.
    pub r#where: Names<String>,
    /// The formula of each component.
    pub formula: Vec<String>,
    /// The number of operations: `total`, and at each stage.
    pub operations: Names<usize>,
}

/// The operations of all quantities together.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OperationCounts {
    /// The number of operations before simplification.
    pub before: usize,
    /// The number of operations after simplification.
    pub after: usize,
    /// The number of operations at each stage.
    pub by_stage: Names<usize>,
    /// The number of operations of each kind.
    pub by_kind: Names<usize>,
}

/// The terms of the equations that the field shows.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Visibility {
    /// The terms that the field shows.
    pub present: Vec<String>,
    /// The terms that the field does not show.
    pub absent: Vec<AbsentTerm>,
    /// Terms that are undecided because they have no value.
    pub undecided: Vec<String>,
    /// The number of points at which the terms that are not zero as formulas were evaluated.
    pub points: usize,
    /// The shape functions that represent u exactly: `linear`, `multilinear` or `quadratic`; null if none does.
    pub span: Option<String>,
    /// True if an integrator of constant acceleration is exact.
    pub exact_in_time: bool,
    /// True if H is symmetric.
    pub symmetric_gradient: bool,
}

/// A term that the field does not show.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AbsentTerm {
    /// The name of the term.
    pub term: String,
    /// `zero` if the formula is zero, or `negligible` at all points.
    pub how: String,
    /// The part of a solver that stays untested.
    pub means: String,
}
