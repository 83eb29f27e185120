//! The documents of `mms check`.

use serde::{Deserialize, Serialize};

use crate::show::{Moduli, TransverseModuli};
use crate::value::present;

/// The document of `mms check FILE...`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Check {
    /// The files.
    pub files: Vec<CheckedFile>,
}

/// The findings of a field file. A file with mistakes has `diagnostics` and no other key.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CheckedFile {
    /// The path of the file.
    pub file: String,
    /// The mistakes in the text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diagnostics: Option<Vec<Diagnostic>>,
    /// The parameters whose names are also names of quantities, each in a sentence; missing if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// The claims on the faces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claims: Option<Vec<Claim>>,
    /// The properties that are proved for the whole field; null if it has no body.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub certificate: Option<Option<Certificate>>,
    /// Claims that are refuted or not proved, with their places in the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub objections: Option<Vec<Diagnostic>>,
    /// The closed forms.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checks: Option<Vec<ClosedForm>>,
    /// The formulas that have no value at some points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undefined: Option<Vec<UndefinedComponent>>,
    /// P at F = I, as in `mms show`.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub rest_stress: Option<Option<Vec<f64>>>,
    /// The moduli at F = I, as in `mms show`.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub moduli_at_rest: Option<Option<Moduli>>,
    /// The moduli of a material with fibres, as in `mms show`.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub transverse_moduli_at_rest: Option<Option<TransverseModuli>>,
    /// The disturbances that can grow on the exact motion, for default parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stability: Option<Stability>,
    /// The bounds of x, as in `mms show`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extent: Option<Vec<[f64; 2]>>,
    /// The shortest wavelength of u, as in `mms show`.
    #[cfg_attr(feature = "schema", schemars(extend("x-or-null" = true)))]
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub shortest_wavelength: Option<Option<f64>>,
    /// The parts that stopped early because their budget was spent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget_spent: Option<Vec<String>>,
    /// True if simplification ended within its budget.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub simplified: Option<bool>,
    /// The words of the command to type next, `mms` first, if something is refuted or not proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next_command: Option<Vec<String>>,
}

/// A message at its place in a file. A file that cannot be read has no place.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Diagnostic {
    /// The path of the file.
    pub path: String,
    /// The line, from 1 on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// The column, from 1 on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// The message.
    pub message: String,
    /// The note at the place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Lines of advice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub help: Option<Vec<String>>,
}

/// The claim of a face, and its proof.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Claim {
    /// The name of the face.
    pub face: String,
    /// The claim on the face.
    pub claim: String,
    /// `proved`, `enclosed`, `refuted` or `unproved`.
    pub status: String,
    /// The bounds of a value that is `enclosed` or `unproved`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
    /// The point X of a counterexample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Vec<f64>>,
    /// The time of a counterexample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The value of a counterexample, which is not 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
}

/// The proved bounds. A bound that is not known is null.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Certificate {
    /// The bounds of J, if J is proved to be positive.
    pub jacobian: Option<[f64; 2]>,
    /// True if the density is proved positive, and the moduli at F = I positive definite, over all ranges.
    pub solid: bool,
    /// True if no function ends or jumps inside the domain.
    pub analytic: bool,
    /// True if every quantity is finite in `f64`.
    pub finite: bool,
    /// True if every quantity is finite in `f32`.
    pub finite_f32: bool,
    /// The digits after the point that remain of angles in `f64`; null if there is no angle or no proof.
    pub angle_digits: Option<usize>,
    /// The digits after the point that remain of angles in `f32`; null if there is no angle or no proof.
    pub angle_digits_f32: Option<usize>,
    /// An upper bound of the principal stretches.
    pub principal_stretch: Option<f64>,
    /// An upper bound of the strain rate.
    pub strain_rate: Option<f64>,
    /// An upper bound of the wave speed in the deformed body.
    pub wave_speed: Option<f64>,
    /// An upper bound of the wave speed in the reference configuration.
    pub reference_wave_speed: Option<f64>,
    /// A stable time step over the cell size.
    pub time_step_per_cell_size: Option<f64>,
    /// True if every acoustic tensor is proved to be positive definite.
    pub strongly_elliptic: bool,
    /// A place at which an acoustic tensor is proved not to be positive definite, with the direction N.
    pub ellipticity_lost: Option<PlaceInTheMotion>,
    /// The number of boxes that the proof used.
    pub boxes: usize,
}

/// The least values of samples of the motion. Moduli are relative to mu at rest at the same X, or to lambda if mu
/// is 0; moduli of a material with fibres are relative to the mean of its shear moduli over all directions.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Stability {
    /// The least eigenvalue of the acoustic tensor, over body, time window and directions; null if no state is finite.
    pub least_acoustic_eigenvalue: Option<f64>,
    /// The place of that eigenvalue, with the direction N.
    pub softest_wave: Option<PlaceInTheMotion>,
    /// The faces that are loaded, free or on rollers, in two and three dimensions.
    pub faces: Vec<Surface>,
    /// The corners where such faces meet, except corners of two rollers.
    pub corners: Vec<Corner>,
    /// The factor by which a disturbance grows over the time window; 1 if none grows.
    pub growth: Option<f64>,
    /// The mode with the least eigenvalue.
    pub slowest_mode: Option<Mode>,
    /// With `--solve`: `comes`, `goes_elsewhere`, `diverges`, `leaves`, `not_static` or `unknown`.
    pub solve: Option<String>,
    /// The disturbances that grow.
    pub warnings: Vec<String>,
}

/// A point, a time and a direction.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlaceInTheMotion {
    /// The point X.
    pub at: Vec<f64>,
    /// The time t.
    pub time: f64,
    /// A unit vector.
    pub direction: Vec<f64>,
}

/// The stability of a face.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Surface {
    /// The name of the face.
    pub face: String,
    /// The least eigenvalue of the surface impedance under dead loads; along the face for a roller.
    pub least_impedance: f64,
    /// The least eigenvalue under a pressure that follows the face; null for other loads.
    pub least_impedance_follower: Option<f64>,
    /// The point X.
    pub at: Vec<f64>,
    /// The time t.
    pub time: f64,
    /// The direction in which the wave runs.
    pub direction: Vec<f64>,
}

/// The stability of a corner or an edge of the body.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Corner {
    /// The faces that meet at the corner.
    pub faces: Vec<String>,
    /// An upper bound of the least second variation over the integral of the squared gradient, for displacements
    /// near the corner, in the softest state of the sample.
    pub coercivity: f64,
    /// The point X.
    pub at: Vec<f64>,
    /// The time t.
    pub time: f64,
}

/// The least eigenvalue of the body on a mesh.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Mode {
    /// The squared frequency, 1/s^2; negative if the mode grows.
    pub omega_squared: f64,
    /// The time t.
    pub time: f64,
    /// The elements of the mesh along each axis.
    pub elements: Vec<usize>,
    /// The number of times that were sampled.
    pub times: usize,
}

/// A closed form of the file, compared with the derivation.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosedForm {
    /// The name of the quantity.
    pub quantity: String,
    /// The source that the file names; null if it names none.
    pub source: Option<String>,
    /// The number of points at which both were compared.
    pub points: usize,
    /// The result of the comparison.
    pub status: String,
    /// The number of points at which one of the two has no value.
    pub undefined_points: usize,
    /// The first difference that is too large.
    pub difference: Option<Difference>,
    /// If the closed form is of b or a stress and differs: the mistake that gives it.
    pub acts_as: Option<Mistaken>,
}

/// The mistake that a wrong closed form contains.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Mistaken {
    /// The name of the mistake, as `mms diagnose --list` prints it.
    pub hypothesis: String,
    /// The mistake in a sentence.
    pub says: String,
    /// The size of the mistake; null if it is a vector.
    pub factor: Option<f64>,
    /// Mistakes that give the same formula in this field.
    pub equivalent: Vec<String>,
}

/// The first value that differs.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Difference {
    /// The point X.
    pub at: Vec<f64>,
    /// The time t.
    pub time: f64,
    /// The component, from 0 on.
    pub component: usize,
    /// The derived value; null if there is none.
    pub derived: Option<f64>,
    /// The value of the closed form; null if there is none.
    pub expected: Option<f64>,
}

/// A formula that has no value at some points.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UndefinedComponent {
    /// The component of u, from 1 on; null for a definition.
    pub component: Option<usize>,
    /// The line of the function that has no value.
    pub line: usize,
    /// The column of that function.
    pub column: usize,
    /// The number of points without a value.
    pub points: usize,
    /// The first of these points.
    pub at: Vec<f64>,
    /// The time t.
    pub time: f64,
}
