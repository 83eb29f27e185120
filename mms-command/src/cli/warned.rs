//! The warnings of `mms check` about the motion of a field, for studies and judgements that do not pass.

use mms_codegen::selection::{Freeze, Selection};
use mms_exact::{Input, settings};
use mms_mechanics::amplitude::Amplitude;
use mms_options::field::Variant;
use mms_stability::judge;
use mms_stability::warnings::warnings;

/// The first warning about a motion, and the remedy.
pub struct Warned {
    /// The warning in a sentence, with the remedy, and the number of further warnings.
    pub says: String,
    /// The setting `NAME=VALUE` that halves the amplitude, if the field has an amplitude and its range allows the value.
    pub half: Option<String>,
}

/// The first warning about the motion of a field with these settings; `None` if there is none.
///
/// # Errors
/// Settings that the field does not have.
pub fn warned(input: &Input, set: &[String], variant: &Variant) -> anyhow::Result<Option<Warned>> {
    let values = settings(set)?;
    let compiled = match values.is_empty() {
        true => input.compiled.clone(),
        false => {
            let freeze = Freeze::Only(values.iter().map(|(name, _)| name.clone()).collect());
            let selection = Selection { set: values, freeze, ..Selection::default() };
            let Ok(compiled) = input.varied(&variant.options(selection)) else { return Ok(None) };
            compiled.into()
        }
    };
    let mut all = warnings(&compiled, &judge(&compiled), None).into_iter();
    let Some(first) = all.next() else { return Ok(None) };
    let more = match all.count() {
        0 => String::new(),
        count => format!(" ({count} more)"),
    };
    let half = half_of_the_amplitude(input, set)?;
    let remedy = half.as_ref().map(|half| format!("; `--set {half}` makes the motion smaller"));
    let says = format!("`mms check` warns: {}{more}{}", first.message, remedy.unwrap_or_default());
    Ok(Some(Warned { says, half }))
}

/// Half of the parameter with which the motion vanishes, if its range allows that.
fn half_of_the_amplitude(input: &Input, set: &[String]) -> anyhow::Result<Option<String>> {
    let compiled = &input.compiled;
    let Some(amplitude) = Amplitude::find(&compiled.graph, &compiled.model) else {
        return Ok(None);
    };
    let index = amplitude.index();
    let values = compiled.parameters::<f64>(&input.settings(set)?);
    let half = format!("{}={}", compiled.model.parameters[index].name, values[index] / 2.0);
    let is_allowed = input.validate_settings(std::slice::from_ref(&half)).is_ok();
    Ok(is_allowed.then_some(half))
}
