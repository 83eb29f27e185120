//! The closed list of regimes: how a field is evaluated as declared, and at extremes.
//!
//! Each regime is derived from the field alone: from the units of its parameters (moduli and lengths are the parameters with
//! that unit), from their effect on u and J (`probe`: the amplitude is the first parameter with which all of u vanishes while
//! body and time window do not change, and J near 0 is found by raising it), or from a variation of the field
//! ([`mms_codegen::variation`]). A regime that does not apply to a field is left out with the reason.

use super::points::{LATE, SampleRegion, exact, size};
use super::probe::{Amplitude, Search, amplitude_for_jacobian, set};
use super::variants::Variants;
use mms_codegen::compile::Compiled;
use mms_codegen::variation::Variation;
use mms_program::precision::Precision;
use mms_spec::units::{Dimension, Unit};
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

/// A way to evaluate any field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// The name on the command line and in JSON.
    pub name: &'static str,
    /// A description of the extreme.
    pub doc: &'static str,
    kind: RegimeKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum RegimeKind {
    Declared,
    Displacement(f64),
    Jacobian(f64),
    Moduli(&'static str),
    Stress(f64),
    Length(f64),
    Shifted,
    At(SampleRegion),
    SubnormalAmplitude,
    LargestAmplitude,
}

const fn regime(name: &'static str, doc: &'static str, kind: RegimeKind) -> Regime {
    Regime { name, doc, kind }
}

/// Every regime, except for the `[[extreme]]` tables of a field.
#[rustfmt::skip]
pub const REGIMES: &[Regime] = &[
    regime("declared", "as the file says", RegimeKind::Declared),
    regime("displacement_1e-4", "displacement 1e-4 of the size", RegimeKind::Displacement(1e-4)),
    regime("displacement_1e-8", "displacement 1e-8 of the size", RegimeKind::Displacement(1e-8)),
    regime("displacement_1e-12", "displacement 1e-12 of the size", RegimeKind::Displacement(1e-12)),
    regime("displacement_1e-15", "displacement 1e-15 of the size", RegimeKind::Displacement(1e-15)),
    regime("jacobian_1e-3", "amplitude such that J falls to 1e-3", RegimeKind::Jacobian(1e-3)),
    regime("jacobian_1e-6", "amplitude such that J falls to 1e-6", RegimeKind::Jacobian(1e-6)),
    regime("jacobian_1e3", "amplitude such that J rises to 1e3", RegimeKind::Jacobian(1e3)),
    regime("lambda_mu_1e8", "lambda/mu = 1e8", RegimeKind::Moduli("1e8")),
    regime("lambda_mu_0", "lambda = 0", RegimeKind::Moduli("0")),
    regime("moduli_1e-9", "moduli of 1e-9 in their unit", RegimeKind::Stress(1e-9)),
    regime("moduli_1e9", "moduli of 1e9 in their unit", RegimeKind::Stress(1e9)),
    regime("lengths_1e-9", "lengths of 1e-9 in their unit", RegimeKind::Length(1e-9)),
    regime("lengths_1e9", "lengths of 1e9 in their unit", RegimeKind::Length(1e9)),
    regime("origin_1e6", "the body 1e6 times its size away from the origin", RegimeKind::Shifted),
    regime("time_1e6", "1e6 time windows later", RegimeKind::At(SampleRegion::Late)),
    regime("subnormal_inputs", "a coordinate or the time is subnormal", RegimeKind::At(SampleRegion::Subnormal)),
    regime("largest_inputs", "a coordinate or the time is the largest finite number", RegimeKind::At(SampleRegion::Largest)),
    regime("subnormal_amplitude", "amplitude is subnormal", RegimeKind::SubnormalAmplitude),
    regime("largest_amplitude", "amplitude is the largest finite number", RegimeKind::LargestAmplitude),
];

/// The regime of that name.
pub fn find(name: &str) -> Option<&'static Regime> {
    REGIMES.iter().find(|regime| regime.name == name)
}

/// The field and the points of an evaluation.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// The variation of the field.
    pub variation: Variation,
    /// The `[[extreme]]` table that applies, by index.
    pub extreme: Option<usize>,
    /// The place of the points.
    pub place: SampleRegion,
    /// The least J of points that count.
    pub least_jacobian: Option<f64>,
    setting: Setting,
}

#[derive(Clone, Debug)]
enum Setting {
    Values(SortedMap<usize, Rational>),
    Subnormal(usize),
    Largest(usize),
}

impl Case {
    /// The field as it is.
    fn plain() -> Self {
        Case {
            variation: Variation::Nothing,
            extreme: None,
            place: SampleRegion::Body,
            least_jacobian: None,
            setting: Setting::Values(SortedMap::new()),
        }
    }

    /// The field with the values of an `[[extreme]]` table.
    pub fn extreme(index: usize) -> Self {
        Case { extreme: Some(index), ..Case::plain() }
    }

    /// The parameters that are set, by index.
    pub fn values(&self, precision: Precision) -> SortedMap<usize, Rational> {
        match &self.setting {
            Setting::Values(values) => values.clone(),
            Setting::Subnormal(parameter) => set(*parameter, 1000.0 * precision.smallest()),
            Setting::Largest(parameter) => set(*parameter, precision.largest()),
        }
    }
}

impl Regime {
    /// Derives the regime for a field; the error is the reason why it does not apply.
    pub(super) fn case(&self, subject: &Variants, search: Search) -> Result<Case, String> {
        let plain = Case::plain();
        Ok(match self.kind {
            RegimeKind::Declared => plain,
            RegimeKind::At(place) => Case { place, ..plain },
            RegimeKind::Moduli(ratio) => {
                let variation = Variation::Moduli(ratio.into());
                variation.fits(&subject.plain().field)?;
                Case { variation, ..plain }
            }
            RegimeKind::Stress(target) => {
                let values = scaled(subject.plain(), &Dimension::stress(), "stress", target)?;
                Case { setting: Setting::Values(values), ..plain }
            }
            RegimeKind::Length(target) => {
                let values = scaled(subject.plain(), &Dimension::length(), "length", target)?;
                Case { setting: Setting::Values(values), ..plain }
            }
            RegimeKind::Shifted => {
                let field = subject.plain();
                let shift = LATE * size(field, &field.parameters::<f64>(&SortedMap::new()));
                let setting = Setting::Values(set(field.model.parameters.len(), shift));
                Case {
                    variation: Variation::Shifted,
                    place: SampleRegion::Shifted,
                    setting,
                    ..plain
                }
            }
            RegimeKind::Displacement(part) => {
                let field = subject.plain();
                let displacement = part * size(field, &field.parameters::<f64>(&SortedMap::new()));
                with_amplitude(subject, |_, amplitude| {
                    let value = amplitude.for_displacement(displacement);
                    Ok(Setting::Values(set(amplitude.parameter, value)))
                })?
            }
            RegimeKind::Jacobian(target) => {
                let case = with_amplitude(subject, |field, amplitude| {
                    let value = amplitude_for_jacobian(field, amplitude, target, search)?;
                    Ok(Setting::Values(set(amplitude.parameter, value)))
                })?;
                // If a large amplitude turns the body inside out, u is not a motion.
                Case { least_jacobian: (target > 1.0).then_some(0.5), ..case }
            }
            RegimeKind::SubnormalAmplitude => {
                with_amplitude(subject, |_, it| Ok(Setting::Subnormal(it.parameter)))?
            }
            RegimeKind::LargestAmplitude => {
                with_amplitude(subject, |_, it| Ok(Setting::Largest(it.parameter)))?
            }
        })
    }
}

/// A setting of the field's own amplitude, or of the factor of a variation.
fn with_amplitude(
    subject: &Variants,
    setting: impl Fn(&Compiled, &Amplitude) -> Result<Setting, String>,
) -> Result<Case, String> {
    let plain = Case::plain();
    if let Some(own) = Amplitude::find(subject.plain()) {
        return Ok(Case { setting: setting(subject.plain(), &own)?, ..plain });
    }
    let scaled = subject.variant(&Variation::Scaled)?;
    let amplitude = Amplitude::of(&scaled, subject.plain().model.parameters.len())
        .ok_or("the displacement is 0, and has no amplitude")?;
    Ok(Case { variation: Variation::Scaled, setting: setting(&scaled, &amplitude)?, ..plain })
}

/// Scales all parameters of a dimension by one factor, the largest of them to `target`.
fn scaled(
    field: &Compiled,
    dimension: &Dimension,
    what: &str,
    target: f64,
) -> Result<SortedMap<usize, Rational>, String> {
    let defaults = field.parameters::<f64>(&SortedMap::new());
    let measures = |index: &usize| {
        let parameter = &field.model.parameters[*index];
        let unit = parameter.unit.as_deref().and_then(Unit::known);
        unit.is_some_and(|unit| unit.dimension == *dimension)
            && !field.field.parameters[*index].frozen
    };
    let of_dimension: Vec<usize> = (0..defaults.len()).filter(measures).collect();
    let largest = of_dimension.iter().map(|index| defaults[*index].abs()).fold(0.0, f64::max);
    if largest == 0.0 || !largest.is_finite() {
        return Err(format!("no parameter has the unit of a {what} and a value other than 0"));
    }
    let factor = target / largest;
    Ok(of_dimension
        .into_iter()
        .filter_map(|index| Some((index, exact(defaults[index] * factor)?)))
        .collect())
}

#[cfg(test)]
mod tests {
    /// A field file is refused if it names an extreme like one of these.
    #[test]
    fn field_files_keep_their_names() {
        let names: Vec<_> = super::REGIMES.iter().map(|regime| regime.name).collect();
        assert_eq!(names, mms_spec::REGIMES);
    }
}
