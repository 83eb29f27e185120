//! The errors by which results and studies exclude mistakes.

use mms_diagnosis::exact::Quantity;
use mms_diagnosis::excluded::{Excluded, Study};
use mms_diagnosis::follow::Follow;
use mms_diagnosis::scene::excludes;
use mms_exact::Exact;
use mms_runtime::scene::Scene;

use super::Measured;

/// The mistakes that results exclude, or the reason why that is not known.
pub struct Exclusions {
    /// The errors that exclude them, in words.
    pub of: String,
    /// Each hypothesis, and whether it is excluded.
    pub all: Result<Vec<Excluded>, String>,
}

/// The quantities by which mistakes are excluded.
const QUANTITIES: [(&str, Quantity); 3] = [
    ("displacement", Quantity::Displacement),
    ("velocity", Quantity::Velocity),
    ("deformation_gradient", Quantity::DisplacementGradient),
];

/// The time at which a static field is evaluated; any other is the same.
const AT_REST: f64 = 1.0;

impl Exclusions {
    /// Finds what the finest root mean square errors of u, v or F at some times exclude; `error` returns the error of a
    /// quantity by name. `None` if there is no error. `times` is `None` for a static field.
    pub fn new(
        scene: &Scene<f64>,
        error: impl Fn(&str) -> Option<f64>,
        (cell_size, time_step): (f64, Option<f64>),
        times: Option<Vec<f64>>,
        follow: &dyn Follow,
    ) -> Option<Exclusions> {
        let is_static = times.is_none();
        let moving = QUANTITIES.iter().filter(|(_, it)| !is_static || *it != Quantity::Velocity);
        let errors = moving.filter_map(|(name, it)| Some((*name, *it, error(name)?)));
        let (names, errors): (Vec<_>, Vec<_>) =
            errors.map(|(name, it, e)| (format!("{e:.1e} of {name}"), (it, e))).unzip();
        if errors.is_empty() {
            return None;
        }
        let times = times.unwrap_or_else(|| vec![AT_REST]);
        let study = Study { cell_size, time_step, times, errors, is_static };
        let all = excludes(scene, &study, follow).map_err(|obstacle| obstacle.to_string());
        Some(Exclusions { of: names.join(", "), all })
    }
}

/// Finds the mistakes that results with these errors at some times exclude; `time_step` belongs to the finest. `None` without
/// errors of the motion or, for a static field, of its equilibrium, and for a field with a swirl, which the solver cannot run.
///
/// # Errors
/// The field cannot be run.
pub fn exclusions(
    exact: &Exact,
    measured: &Measured,
    times: Vec<f64>,
    time_step: Option<f64>,
    follow: &dyn Follow,
) -> anyhow::Result<Option<Exclusions>> {
    if exact.has_swirl() {
        return Ok(None);
    }
    let times = (!exact.input().is_static()).then_some(times);
    let finest = measured.runs.iter().map(|run| run.cell_size).fold(f64::INFINITY, f64::min);
    let error = |name: &str| error(measured, name, finest);
    Ok(Exclusions::new(&exact.scene()?, error, (finest, time_step), times, follow))
}

/// The root mean square error of a quantity on the finest mesh, or its floor if that is larger; the largest of replicates.
fn error(measured: &Measured, name: &str, finest: f64) -> Option<f64> {
    let quantity = measured.quantities.iter().find(|it| it.name == *name)?;
    let norm = quantity.norms.iter().find(|it| it.name == *"l2")?;
    let runs = measured.runs.iter().zip(&norm.errors).zip(&norm.floors);
    let finest = runs.filter(|((run, _), _)| run.cell_size == finest);
    finest.filter_map(|((_, error), floor)| Some(error.as_ref()?.max(*floor))).reduce(f64::max)
}
