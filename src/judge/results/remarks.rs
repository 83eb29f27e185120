//! What is told beside errors: how they were measured, and what may be wrong.

use std::collections::BTreeMap;

use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

use super::Level;
use super::iterative::HUNDRED;
use super::level::{Errors, Found, Sampling};
use super::times::Common;

/// The times.
pub fn compared(common: &Common) -> String {
    let times = match common.times.as_slice() {
        [only] => format!("at t = {only:?}"),
        times => format!(
            "at {} times, from {:?} to {:?}: errors are the largest over them",
            times.len(),
            times[0],
            times[times.len() - 1]
        ),
    };
    match common.left_out {
        0 => times,
        1 => format!("{times}; 1 result is left out, at a time that not all have"),
        several => format!("{times}; {several} results are left out, at times that not all have"),
    }
}

/// The norms, said once for those that are alike.
pub fn norms(quantities: &[(Quantity, Sampling)]) -> Vec<String> {
    let mut by_sampling: BTreeMap<&'static str, (Vec<&'static str>, &'static str)> =
        BTreeMap::new();
    for (quantity, sampling) in quantities {
        let entry = by_sampling.entry(sampling.name()).or_insert((Vec::new(), sampling.says()));
        entry.0.push(quantity.symbol());
    }
    by_sampling
        .into_values()
        .map(|(symbols, says)| format!("norms of {}: {says}", symbols.join(", ")))
        .collect()
}

/// What was found, and is not judged.
pub fn passed_over(found: &Found, notes: &mut Vec<String>) {
    if !found.passed_over.is_empty() {
        notes.push(format!("found and not judged: {}", found.passed_over.join(", ")));
    }
    if let Some(kind) = found.unknown {
        notes.push(format!(
            "cells of type {kind} of VTK are not known, so that norms are over points"
        ));
    }
}

/// What may be wrong with what was measured.
pub fn suspicions(levels: &[Level], is_start: bool, warnings: &mut Vec<String>) {
    let mut exact = Vec::new();
    for errors in &levels[0].errors {
        let name = errors.quantity.name();
        let of =
            |level: &Level| level.errors.iter().find(|it| it.quantity == errors.quantity).cloned();
        let all: Vec<Errors> = levels.iter().filter_map(of).collect();
        if let Some(power) =
            errors.unit.filter(|power| all.iter().all(|it| it.unit == Some(*power)))
        {
            warnings.push(format!(
                "{name} is 10^{power} times as large as the exact one: is it in another unit?"
            ));
        }
        if all.iter().all(Errors::is_exact) {
            exact.push(name);
        } else if all.iter().all(Errors::is_noise) && errors.iterative.is_none() {
            warnings.push(format!(
                "no error of {name} is more than the digits of the files make ({}): write more of them",
                errors.stored.name()
            ));
        }
    }
    if !exact.is_empty() && is_start {
        warnings.push(format!(
            "exact to round-off at the start, where nothing has been computed yet: {}. Are there results of later times?",
            exact.join(", ")
        ));
    } else if !exact.is_empty() {
        warnings.push(format!(
            "exact to round-off on every mesh: {}. Is it what the solver computed, and not the exact solution? Or does \
             the method hold this field exactly?",
            exact.join(", ")
        ));
    }
}

/// Says which levels are at their floor.
pub fn floors(quantities: &[crate::judge::Quantity], levels: &[Level], notes: &mut Vec<String>) {
    for quantity in quantities {
        let Some(norm) = quantity.norms.iter().find(|norm| norm.name == *"l2" && !norm.is_exact)
        else {
            continue;
        };
        for (at, level) in levels.iter().enumerate() {
            let floor = norm.floors[at];
            let of = level.errors.iter().find(|it| it.quantity.name() == quantity.name.raw());
            let Some(errors) = of.filter(|_| norm.errors[at].is_some_and(|it| it < floor)) else {
                continue;
            };
            let why = match errors.iterative {
                Some(iterative) if HUNDRED * iterative >= floor => {
                    "a hundred times its iterative error".into()
                }
                _ => format!("which rounding of the file makes ({})", errors.stored.name()),
            };
            notes.push(format!(
                "`{}`: the error of {} is at its floor of {floor:.1e}, {why}; it is left out of the verdict",
                shown(&level.name),
                quantity.name.shown(),
            ));
        }
    }
}
