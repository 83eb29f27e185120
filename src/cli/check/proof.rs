//! What `mms check` says of proofs.

use mms_codegen::certify::certificate::Certificate;
use mms_codegen::certify::claims::Finding;
use mms_codegen::certify::finite::Finite;
use mms_codegen::certify::jacobian::Jacobian;
use mms_codegen::certify::rates::Rates;
use mms_codegen::spec::BoundarySpec;
use serde_json::{Value, json};

/// One line for each thing that was to be proved.
pub fn text(certificate: &Certificate) -> Vec<String> {
    let mut lines = vec![
        match &certificate.jacobian {
            Jacobian::Positive([lower, upper]) => {
                let (lower, upper) = (down(*lower), up(*upper));
                format!("  proof  J > 0: {lower} <= J <= {upper} over body, time window and ranges")
            }
            Jacobian::Inverted(_, value) => format!("  proof  J > 0 is REFUTED: it is {value:e}"),
            Jacobian::Unproved(..) => "  proof  J > 0 is UNPROVED".into(),
        },
        match &certificate.finite {
            Finite::Proved => "  proof  every quantity is finite everywhere".into(),
            Finite::Undefined(quantity, _) => {
                format!("  proof  {} is NOT FINITE everywhere", quantity.name())
            }
            Finite::Unproved(quantity, _) => {
                format!("  proof  {} is UNPROVED to be finite everywhere", quantity.name())
            }
        },
    ];
    lines.extend(certificate.rates.iter().flat_map(rates));
    for (claim, finding) in &certificate.claims {
        let (face, word) = (claim.face.value.name(), claim.claim.value);
        let found = match finding {
            Finding::Proved => "proved".to_string(),
            Finding::Enclosed([lower, upper]) => {
                format!("enclosed [{lower:e}, {upper:e}], not proved")
            }
            Finding::Refuted(_, value) => format!("REFUTED: {value:e} instead of 0"),
            Finding::Unproved([lower, upper]) => {
                format!("UNPROVED: enclosed [{lower:e}, {upper:e}]")
            }
        };
        lines.push(format!("  claim  {face} is {} ({}): {found}", word.name(), word.meaning()));
    }
    if !certificate.spent.is_empty() {
        lines.push(format!(
            "  budget SPENT before the end of: {}. What is not proved there may hold, bounds may be less sharp: write u \
             shorter, shrink the body or the time window, or fix parameters that have a range (--set)",
            certificate.spent.join(", ")
        ));
    }
    lines
}

fn rates(rates: &Rates) -> [String; 2] {
    let bound = |what: &str, value: f64| match value.is_finite() {
        true => format!("{what} <= {}", up(value)),
        false => format!("{what} without a bound in double precision"),
    };
    let stretch = bound("principal stretch", rates.principal_stretch);
    let rate = bound("strain rate", rates.strain_rate);
    let waves = bound("waves", rates.wave_speed);
    let step = 1.0 / rates.time_step_per_cell_size();
    let step = match step.is_finite() {
        true => format!("a stable time step is <= cell size / {}", up(step)),
        false => "no time step is known to be stable".into(),
    };
    [format!("  bound  {stretch}, {rate}, {waves}"), format!("  bound  {step}")]
}

/// Four digits of a number, rounded up.
fn up(value: f64) -> String {
    rounded(value, 1.0)
}

/// Four digits of a number, rounded down.
fn down(value: f64) -> String {
    rounded(value, -1.0)
}

fn rounded(value: f64, direction: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let short = |value: f64| -> f64 { format!("{value:.3e}").parse().unwrap_or(value) };
    let mut rounded = short(value);
    // The last digits of a double are no reason for another digit: JSON has them.
    if (value - rounded) * direction > 1e-12 * value.abs() {
        let unit = 10f64.powi(value.abs().log10().floor() as i32 - 3);
        rounded = short(rounded + direction * unit);
    }
    let plain = (1e-4..1e7).contains(&rounded.abs());
    if plain { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A claim, and what is known of it.
pub fn claim((claim, finding): &(BoundarySpec, Finding)) -> Value {
    let mut document = json!({
        "face": claim.face.value.name(),
        "claim": claim.claim.value.name(),
        "status": finding.status(),
    });
    match finding {
        Finding::Proved => {}
        Finding::Enclosed(interval) | Finding::Unproved(interval) => {
            document["interval"] = json!(interval);
        }
        Finding::Refuted(witness, value) => {
            document["at"] = json!(witness.coordinates);
            document["time"] = json!(witness.time);
            document["value"] = json!(value);
        }
    }
    document
}

/// What is proved of the field as a whole. What is not known is null.
pub fn document(certificate: &Certificate) -> Value {
    let jacobian = match certificate.jacobian {
        Jacobian::Positive(bounds) => Some(bounds),
        Jacobian::Inverted(..) | Jacobian::Unproved(..) => None,
    };
    let rates = certificate.rates;
    json!({
        "jacobian": jacobian,
        "finite": certificate.finite == Finite::Proved,
        "principal_stretch": rates.map(|it| it.principal_stretch),
        "strain_rate": rates.map(|it| it.strain_rate),
        "wave_speed": rates.map(|it| it.wave_speed),
        "reference_wave_speed": rates.map(|it| it.reference_wave_speed),
        "time_step_per_cell_size": rates.map(|it| it.time_step_per_cell_size()),
        "boxes": certificate.boxes,
    })
}
