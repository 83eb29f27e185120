//! The proofs in the report of `mms check`.

use mms_codegen::Compiled;
use mms_codegen::bounds::witness::Witness;
use mms_codegen::certify::certificate::Certificate;
use mms_codegen::certify::claims;
use mms_codegen::certify::computed::{ComputedProof, ComputedVerdict, ENOUGH_DIGITS};
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::certify::finite::Finite;
use mms_codegen::certify::rates::Rates;
use mms_codegen::certify::sign::Sign;
use mms_codegen::certify::softening::Softening;
use mms_codegen::certify::solid::Part;
use mms_documents::check::{self as documents, PlaceInTheMotion};
use mms_spec::BoundarySpec;

/// A line for each property to prove.
pub fn text(compiled: &Compiled, certificate: &Certificate) -> Vec<String> {
    let [double, single] = &certificate.computed;
    let mut lines = vec![
        match &certificate.jacobian {
            Sign::Positive([lower, upper]) => {
                let (lower, upper) = (down(*lower), up(*upper));
                let over = match compiled.model.domain.is_static {
                    true => "body and ranges",
                    false => "body, time window and ranges",
                };
                format!("  proof  J > 0: {lower} <= J <= {upper} over {over}")
            }
            Sign::Refuted(_, value) => format!("  proof  J > 0 is REFUTED: it is {value:e}"),
            Sign::Unproved(..) => "  proof  J > 0 is UNPROVED".into(),
        },
        match &certificate.finite {
            Finite::Proved => finite("  proof  every quantity is finite everywhere", double),
            Finite::Undefined(quantity, _) => {
                format!("  proof  {} is NOT FINITE everywhere", quantity.name())
            }
            Finite::Unproved(quantity, _) => {
                format!("  proof  {} is UNPROVED to be finite everywhere", quantity.name())
            }
        },
    ];
    lines.extend(solid(certificate));
    lines.push(match certificate.branch_violations.as_slice() {
        [] => "  proof  u and its terms stay within one analytic branch".into(),
        exits if exits.iter().any(|exit| exit.is_certain) => {
            "  proof  u and its terms LEAVE their analytic branch".into()
        }
        _ => "  proof  u and its terms are UNPROVED to stay within one analytic branch".into(),
    });
    if single.verdict != ComputedVerdict::NotApplicable {
        lines.push(finite("  proof  in f32 every quantity is finite, too", single));
    }
    let is_static = compiled.model.domain.is_static;
    lines.extend(certificate.rates.iter().flat_map(|it| rates(it, is_static)));
    lines.extend(angles(compiled, double));
    for (claim, finding) in &certificate.claims {
        let (face, word) = (claim.face.value.name(), claim.claim.value);
        let found = match finding {
            claims::ClaimVerdict::Proved => "proved".to_string(),
            claims::ClaimVerdict::Enclosed([lower, upper]) => {
                format!("enclosed [{lower:e}, {upper:e}], not proved")
            }
            claims::ClaimVerdict::Refuted(_, value) => format!("REFUTED: {value:e} instead of 0"),
            claims::ClaimVerdict::Unproved([lower, upper]) => {
                format!("UNPROVED: enclosed [{lower:e}, {upper:e}]")
            }
        };
        lines.push(format!("  claim  {face} is {} ({}): {found}", word.name(), word.meaning()));
    }
    if !certificate.spent.is_empty() {
        lines.push(format!(
            "  budget SPENT before the end of: {}. Unproved properties may hold, bounds may be less sharp: write u \
             shorter, shrink the body or the time window, or fix parameters that have a range (--set)",
            certificate.spent.join(", ")
        ));
    }
    lines
}

/// The sentence about the density and the moduli, if they vary.
fn solid(certificate: &Certificate) -> Option<String> {
    let wrong = certificate.solid.iter().find(|(_, sign)| !matches!(sign, Sign::Positive(_)));
    let names = |wanted: fn(Part) -> bool| certificate.solid.iter().any(|(part, _)| wanted(*part));
    Some(match wrong {
        Some((part, Sign::Refuted(_, value))) => {
            format!("  proof  {} > 0 is REFUTED: it is {value:e}", part.name())
        }
        Some((part, _)) => format!("  proof  {} > 0 is UNPROVED", part.name()),
        None => match (names(|it| it == Part::Density), names(|it| it != Part::Density)) {
            (true, true) => {
                "  proof  the density is positive, and the moduli at F = I are positive definite"
                    .into()
            }
            (true, false) => "  proof  the density is positive".into(),
            (false, true) => {
                "  proof  the moduli at F = I are positive definite over the ranges".into()
            }
            (false, false) => return None,
        },
    })
}

/// The line about finite values in a precision.
fn finite(proved: &str, computed: &ComputedProof) -> String {
    match &computed.verdict {
        ComputedVerdict::Proved | ComputedVerdict::NotApplicable => proved.into(),
        ComputedVerdict::Fails(quantity, ..) => {
            format!("{proved}: {} is NOT, as computed", quantity.name())
        }
        ComputedVerdict::Unproved(quantity, _) => {
            format!("{proved}: {} is UNPROVED to be, as computed", quantity.name())
        }
    }
}

/// The remaining digits of an angle that is a sum of places and times.
fn angles(compiled: &Compiled, computed: &ComputedProof) -> Option<String> {
    let (digits, witness) = computed.angles.as_ref()?;
    let count = digits.floor().max(0.0);
    Some(match *digits < ENOUGH_DIGITS {
        false => format!("  bound  angles are right to {count} digits after the point"),
        true => {
            let names: Vec<String> =
                compiled.model.parameters.iter().map(|it| it.name.clone()).collect();
            let place = witness.describe(compiled.field.space.axes(), &names);
            format!(
                "  bound  angles keep FEWER THAN SIX digits after the point: {count} near {place}"
            )
        }
    })
}

/// The bounds of rates; for a static field only the stretch.
fn rates(rates: &Rates, is_static: bool) -> Vec<String> {
    let bound = |what: &str, value: f64| match value.is_finite() {
        true => format!("{what} <= {}", up(value)),
        false => format!("{what} without a bound in double precision"),
    };
    let stretch = bound("principal stretch", rates.principal_stretch);
    if is_static {
        return vec![format!("  bound  {stretch}")];
    }
    let rate = bound("strain rate", rates.strain_rate);
    let waves = bound("waves", rates.wave_speed);
    let step = 1.0 / rates.time_step_per_cell_size();
    let step = match step.is_finite() {
        true => format!("a stable time step is <= cell size / {}", up(step)),
        false => "no time step is known to be stable".into(),
    };
    vec![format!("  bound  {stretch}, {rate}, {waves}"), format!("  bound  {step}")]
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
    // Rounding in the last digits of a double must not raise a digit; JSON has them all.
    if (value - rounded) * direction > 1e-12 * value.abs() {
        let unit = 10f64.powi(value.abs().log10().floor() as i32 - 3);
        rounded = short(rounded + direction * unit);
    }
    let plain = (1e-4..1e7).contains(&rounded.abs());
    if plain { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A claim with its finding.
pub fn claim((claim, finding): &(BoundarySpec, claims::ClaimVerdict)) -> documents::Claim {
    let (interval, witness) = match finding {
        claims::ClaimVerdict::Proved => (None, None),
        claims::ClaimVerdict::Enclosed(interval) | claims::ClaimVerdict::Unproved(interval) => {
            (Some(*interval), None)
        }
        claims::ClaimVerdict::Refuted(witness, value) => (None, Some((witness, *value))),
    };
    documents::Claim {
        face: claim.face.value.name().to_string(),
        claim: claim.claim.value.name().to_owned(),
        status: finding.status().to_owned(),
        interval,
        at: witness.map(|(witness, _)| witness.coordinates.clone()),
        time: witness.map(|(witness, _)| witness.time),
        value: witness.map(|(_, value)| value),
    }
}

/// The proved bounds of the field as a whole. A bound that is not known is null.
pub fn document(certificate: &Certificate) -> documents::Certificate {
    let jacobian = match certificate.jacobian {
        Sign::Positive(bounds) => Some(bounds),
        Sign::Refuted(..) | Sign::Unproved(..) => None,
    };
    let rates = certificate.rates;
    let [angle_digits, angle_digits_f32] = certificate.computed.each_ref().map(|computed| {
        computed.angles.as_ref().map(|(digits, _)| digits.floor().max(0.0) as usize)
    });
    documents::Certificate {
        jacobian,
        solid: certificate.solid.iter().all(|(_, sign)| matches!(sign, Sign::Positive(_))),
        analytic: certificate.branch_violations.is_empty(),
        finite: certificate.computed[0].verdict == ComputedVerdict::Proved,
        finite_f32: certificate.computed[1].verdict == ComputedVerdict::Proved,
        angle_digits,
        angle_digits_f32,
        principal_stretch: rates.map(|it| it.principal_stretch),
        strain_rate: rates.map(|it| it.strain_rate),
        wave_speed: rates.map(|it| it.wave_speed),
        reference_wave_speed: rates.map(|it| it.reference_wave_speed),
        time_step_per_cell_size: rates.map(|it| it.time_step_per_cell_size()),
        strongly_elliptic: matches!(certificate.ellipticity, Ellipticity::Strong(_)),
        ellipticity_lost: lost(&certificate.ellipticity),
        boxes: certificate.boxes,
    }
}

/// The place where a wave is proved to grow.
fn lost(ellipticity: &Ellipticity) -> Option<PlaceInTheMotion> {
    let Ellipticity::Lost(Softening { witness, direction, .. }) = ellipticity else { return None };
    let Witness { coordinates, time, .. } = witness;
    Some(PlaceInTheMotion { at: coordinates.clone(), time: *time, direction: direction.to_vec() })
}
