//! Notes beside errors: how they were measured, and what may be wrong.

use std::collections::BTreeMap;

use mms_exact::Exact;
use mms_results::own::LeftOut;
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

use super::MeasuredMesh;
use super::iterative::HUNDRED;
use super::level::{Errors, Sampling};
use super::times::Common;
use crate::table::ExpectedOrders;

/// The compared times.
pub fn compared(common: &Common) -> String {
    match common.times.as_slice() {
        _ if common.is_static => "static: the last result of each file".into(),
        [only] => format!("at t = {only:?}"),
        times => format!(
            "at {} times, from {:?} to {:?}: errors are the largest over them",
            times.len(),
            times[0],
            times[times.len() - 1]
        ),
    }
}

/// The compared meshes.
pub fn meshes(levels: &[MeasuredMesh]) -> String {
    let of = |level: &MeasuredMesh| {
        let (name, covered) = (shown(&level.name), &level.found.covered);
        match covered.cells {
            0 => format!("`{name}` of {} points", covered.points),
            cells => format!("`{name}` of {cells} cells"),
        }
    };
    format!("meshes: {}", levels.iter().map(of).collect::<Vec<_>>().join(", "))
}

/// The norms, once for all quantities with the same sampling.
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

/// A sentence about means of an axisymmetric field.
pub fn rings(exact: &Exact) -> Option<String> {
    exact.space().is_axisymmetric().then(|| {
        "means are over the body of revolution: a point, or the middle of a cell, counts by its radius R unless `--weight` \
         names another weight, and quadrature over cells has the weight R"
            .into()
    })
}

/// The expected order for elements of degree 2 and more, unless the user gave one.
pub fn order(degree: Option<u32>, orders: &ExpectedOrders) -> Option<String> {
    let degree = degree.filter(|degree| *degree > 1 && !orders.is_given)?;
    Some(format!(
        "expected order: {}, one more than the degree of the cells; if the time step falls with h, it may be 2, which \
         `--expected-order 2` says",
        degree + 1
    ))
}

/// A sentence about all content that was left out, and why.
pub fn left_out(common: &Common, levels: &[MeasuredMesh], own: &[LeftOut]) -> String {
    let mut all = Vec::new();
    let mut count = |count: usize, one: &str, several: &str| match count {
        0 => {}
        1 => all.push(format!("1 {one}")),
        _ => all.push(format!("{count} {several}")),
    };
    let sum = |of: fn(&LeftOut) -> usize| own.iter().map(of).sum();
    match common.is_static {
        true => count(common.left_out, "result before the last", "results before the last"),
        false => count(
            common.left_out,
            "result, at a time that other files lack",
            "results, at times that other files lack",
        ),
    }
    count(sum(|it| it.ghost_cells), "ghost cell", "ghost cells");
    count(sum(|it| it.ghost_points), "ghost point", "ghost points");
    count(sum(|it| it.doubled), "duplicate cell", "duplicate cells");
    count(sum(|it| it.unused), "point of no cell", "points of no cell");
    let found = &levels[0].found;
    if !found.passed_over.is_empty() {
        all.push(format!("found and not judged: {}", found.passed_over.join(", ")));
    }
    if let Some(kind) = found.unknown {
        all.push(format!(
            "functions of cells of type {kind} of VTK, which are not known: norms are over points"
        ));
    }
    format!("left out: {}", if all.is_empty() { "nothing".into() } else { all.join("; ") })
}

/// Warnings about the measured errors.
pub fn suspicions(levels: &[MeasuredMesh], is_input: bool, warnings: &mut Vec<String>) {
    let mut exact = Vec::new();
    for errors in &levels[0].errors {
        let name = errors.quantity.name();
        let of = |level: &MeasuredMesh| {
            level.errors.iter().find(|it| it.quantity == errors.quantity).cloned()
        };
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
                "no error of {name} exceeds the rounding of the digits in the files ({}): write more of them",
                errors.stored.name()
            ));
        }
    }
    if is_input {
        let names: Vec<_> = levels[0].errors.iter().map(|it| it.quantity.name()).collect();
        warnings.push(format!(
            "the solver was given all values that were compared: {}",
            names.join(", ")
        ));
    } else if !exact.is_empty() {
        warnings.push(format!(
            "exact to round-off on every mesh: {}. Are these results of the solver, and not the exact solution? Or does the \
             method represent this field exactly?",
            exact.join(", ")
        ));
    }
}

/// The least part of a floor at which the digits of the time are mentioned.
const A_PART: f64 = 0.01;

/// Notes the levels whose errors are at their floor.
pub fn floors(
    quantities: &[crate::measured::Quantity],
    levels: &[MeasuredMesh],
    notes: &mut Vec<String>,
) {
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
                _ => {
                    let [of_time, time] = errors.of_time;
                    let time = (of_time > A_PART * floor)
                        .then(|| format!(", and of its time t = {time:?}; say it with `--time`"));
                    let stored = errors.stored.name();
                    format!(
                        "which rounding of the file makes ({stored}){}",
                        time.unwrap_or_default()
                    )
                }
            };
            notes.push(format!(
                "`{}`: the error of {} is at its floor of {floor:.1e}, {why}; it is left out of the verdict",
                shown(&level.name),
                quantity.name.shown(),
            ));
        }
    }
}
