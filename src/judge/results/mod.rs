//! Results of any solver against a field: their errors, as [`Measured`].
//!
//! [`files`] reads them, with `mms-results`; [`times`] finds those at which meshes can be compared; [`level`] measures a
//! snapshot against the field's program ([`Exact`]), and finds the floor that the rounding of the file makes;
//! [`baseline`] and [`same`] compare results with results.

mod baseline;
mod files;
mod level;
mod same;
mod times;

use std::collections::BTreeMap;

use anyhow::{bail, ensure};
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

pub use baseline::{Baseline, Compared};
pub use files::{Results, placed};
pub use level::{Reading, Sampling, weight};
pub use same::{Difference, same};

use self::level::{Errors, Found, Measure};
use super::table::Orders;
use super::{Measured, Norm, Run};
use crate::session::exact::Exact;

/// What was measured, and what is to be said of it.
pub struct Measurement {
    /// The errors.
    pub measured: Measured,
    /// Over what each quantity was measured.
    pub samplings: Vec<Sampling>,
    /// The times at which levels were compared.
    pub times: Vec<f64>,
    /// What was done, and why.
    pub notes: Vec<String>,
    /// What may be wrong.
    pub warnings: Vec<String>,
}

/// One mesh, measured at all times.
struct Level {
    name: String,
    /// Of quantities, the largest errors over times.
    errors: Vec<Errors>,
    found: Found,
}

/// By how much cells of one mesh, or meshes of one study, may differ before it is said.
const ALIKE: f64 = 1.01;

/// Measures results of meshes. `sizes` are h, in the order of the results; without them they are those of cells, or
/// those that counts of points say.
///
/// # Errors
/// Results that are none of the field, and where.
pub fn measure(
    mut all: Vec<Results>,
    reading: &Reading<'_>,
    exact: &mut Exact,
    sizes: &[f64],
    wanted_times: &[f64],
    orders: &Orders,
) -> anyhow::Result<Measurement> {
    let common = times::common(&mut all, wanted_times, exact.window)?;
    let mut levels = Vec::new();
    for (results, snapshots) in all.iter().zip(&common.snapshots) {
        levels.push(level(results, snapshots, reading, exact)?);
    }
    let quantities = quantities(&levels)?;
    let mut notes = vec![compared(&common)];
    let mut warnings = Vec::new();
    let sizes = lengths(&levels, sizes, exact, &mut notes, &mut warnings)?;
    notes.push(format!("X: {}", levels[0].found.how));
    let samplings: Vec<Sampling> = quantities.iter().map(|(_, sampling)| *sampling).collect();
    hold_evidence(&levels[0], &samplings)?;
    hold_orders(&quantities, orders)?;
    notes.extend(norms(&quantities));
    passed_over(&levels[0].found, &mut notes);
    suspicions(&levels, &mut warnings);
    let runs = sizes.iter().map(|&cell_size| Run { cell_size, time_step: None }).collect();
    let measured: Vec<_> =
        quantities.iter().map(|(it, _)| quantity(*it, &levels, orders)).collect();
    floors(&measured, &levels, &mut notes);
    let measured = Measured { runs, quantities: measured };
    Ok(Measurement { measured, samplings, times: common.times, notes, warnings })
}

fn level(
    results: &Results,
    snapshots: &[usize],
    reading: &Reading<'_>,
    exact: &mut Exact,
) -> anyhow::Result<Level> {
    let what = |errors: &Errors| (errors.quantity, errors.sampling);
    let mut level: Option<Level> = None;
    for snapshot in snapshots.iter().map(|&at| &results.snapshots[at]) {
        let Some(time) = snapshot.time else { continue };
        let found = reading.measure(snapshot, time.value, time.rounding, exact)?;
        match &mut level {
            None => {
                level =
                    Some(Level { name: results.name.clone(), errors: found.errors.clone(), found })
            }
            Some(level) => {
                ensure!(
                    level.errors.iter().map(what).eq(found.errors.iter().map(what)),
                    "{}: it has other quantities than the result before it, or cells where that has none",
                    snapshot.path
                );
                level.errors.iter_mut().zip(found.errors).for_each(|(most, one)| most.raise(one));
            }
        }
    }
    match level {
        Some(level) if !level.errors.is_empty() => Ok(level),
        Some(_) => bail!(
            "`{}`: no quantity that can be judged; it needs u, or x and X, or another one; name them with `--map u=..`",
            results.name
        ),
        None => bail!("`{}`: no results", results.name),
    }
}

impl Errors {
    /// Keeps the larger of each norm.
    fn raise(&mut self, other: Errors) {
        self.unit = self.unit.filter(|unit| other.unit == Some(*unit));
        for ((_, most), (_, one)) in self.norms.iter_mut().zip(other.norms) {
            *most = Measure { error: most.error.max(one.error), floor: most.floor.max(one.floor) };
        }
    }
}

/// The quantities that all levels have, each with its sampling.
fn quantities(levels: &[Level]) -> anyhow::Result<Vec<(Quantity, Sampling)>> {
    let mut all = Vec::new();
    for errors in &levels[0].errors {
        for level in levels {
            match level.errors.iter().find(|it| it.quantity == errors.quantity) {
                Some(it) if it.sampling == errors.sampling => {}
                Some(_) => bail!(
                    "`{}`: {} is over {} there, and over {} in `{}`",
                    shown(&level.name),
                    errors.quantity.name(),
                    level.errors[0].sampling.name(),
                    errors.sampling.name(),
                    shown(&levels[0].name)
                ),
                None => bail!(
                    "`{}`: no {}, which `{}` has; leave it out with `--quantity`",
                    shown(&level.name),
                    errors.quantity.name(),
                    shown(&levels[0].name)
                ),
            }
        }
        all.push((errors.quantity, errors.sampling));
    }
    Ok(all)
}

/// Refuses to judge a mesh by points or by middles of cells alone: orders there may be higher than elsewhere.
fn hold_evidence(level: &Level, samplings: &[Sampling]) -> anyhow::Result<()> {
    ensure!(
        level.found.sizes.is_none() || samplings.contains(&Sampling::Cells),
        "`{}`: only values at {} would be judged, where they may be more accurate than elsewhere (superconvergence); \
         judge a quantity of the points over the cells as well, such as u",
        shown(&level.name),
        samplings[0].name()
    );
    Ok(())
}

/// Refuses orders of what is not judged.
fn hold_orders(quantities: &[(Quantity, Sampling)], orders: &Orders) -> anyhow::Result<()> {
    let norms = ["l1", "l2", "linf", "h1"];
    let is_known = |name: &str| {
        let is_named = |(it, _): &(Quantity, Sampling)| it.name() == name || it.symbol() == name;
        norms.contains(&name) || quantities.iter().any(is_named)
    };
    if let Some((name, _)) = orders.named.iter().find(|(name, _)| !is_known(name)) {
        let known: Vec<_> = quantities.iter().map(|(it, _)| it.symbol()).chain(norms).collect();
        bail!(
            "`--expected-order {}=..`: it is not judged; known are {}",
            shown(name),
            known.join(", ")
        );
    }
    Ok(())
}

fn compared(common: &times::Common) -> String {
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

/// h of each level, from the user, from cells or from counts.
fn lengths(
    levels: &[Level],
    given: &[f64],
    exact: &Exact,
    notes: &mut Vec<String>,
    warnings: &mut Vec<String>,
) -> anyhow::Result<Vec<f64>> {
    if !given.is_empty() {
        ensure!(
            given.len() == levels.len(),
            "`--h`: {} values for {} files",
            given.len(),
            levels.len()
        );
        return Ok(given.to_vec());
    }
    let of_cells: Option<Vec<[f64; 2]>> = levels.iter().map(|level| level.found.sizes).collect();
    if let Some(sizes) = of_cells {
        notes.push("h: the longest edge of a cell, in X".into());
        let ratios: Vec<f64> = sizes.iter().map(|[least, most]| most / least).collect();
        if ratios.iter().any(|it| it / ratios[0] > ALIKE || ratios[0] / it > ALIKE) {
            let ratios: Vec<_> = ratios.iter().map(|it| format!("{it:.2}")).collect();
            warnings.push(format!(
                "h_max/h_min varies from mesh to mesh ({}): orders are those of meshes that are refined evenly",
                ratios.join(", ")
            ));
        }
        return Ok(sizes.into_iter().map(|[_, most]| most).collect());
    }
    notes.push(
        "h: (measure of the body / points)^(1/D), for there are no cells; give others with `--h`"
            .into(),
    );
    Ok(levels.iter().map(|level| exact.spacing(level.found.points)).collect())
}

/// The norms, said once for those that are alike.
fn norms(quantities: &[(Quantity, Sampling)]) -> Vec<String> {
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

fn passed_over(found: &Found, notes: &mut Vec<String>) {
    if !found.passed_over.is_empty() {
        notes.push(format!("found and not judged: {}", found.passed_over.join(", ")));
    }
    if let Some(kind) = found.unknown {
        notes.push(format!(
            "cells of type {kind} of VTK are not known, so that norms are over points"
        ));
    }
}

fn suspicions(levels: &[Level], warnings: &mut Vec<String>) {
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
        let is_noise =
            |it: &Errors| it.norms.iter().all(|(_, measure)| measure.error <= measure.floor);
        if all.iter().all(is_noise) {
            warnings.push(format!(
                "{name} is exact to round-off on every mesh: there is no order to observe. Is it what the solver \
                 computed, and not the exact solution? Or does the method hold this field exactly?"
            ));
        }
    }
}

/// What is judged of a quantity.
fn quantity(of: Quantity, levels: &[Level], orders: &Orders) -> super::Quantity {
    let errors: Vec<&Errors> = levels
        .iter()
        .filter_map(|level| level.errors.iter().find(|it| it.quantity == of))
        .collect();
    let norm = |at: usize| {
        let name = errors[0].norms[at].0;
        let measures: Vec<Measure> = errors.iter().map(|it| it.norms[at].1).collect();
        Norm {
            name: name.into(),
            expected: orders.of(of.name(), of.symbol(), name),
            errors: measures.iter().map(|it| Some(it.error)).collect(),
            floors: measures.iter().map(|it| it.floor).collect(),
        }
    };
    super::Quantity {
        name: of.name().into(),
        norms: (0..errors[0].norms.len()).map(norm).collect(),
    }
}

/// Says which levels are at the floor that rounding makes.
fn floors(quantities: &[super::Quantity], levels: &[Level], notes: &mut Vec<String>) {
    for quantity in quantities {
        let Some(norm) = quantity.norms.iter().find(|norm| norm.name == *"l2") else { continue };
        let at_floor = |(at, _): &(usize, &Level)| {
            norm.errors[*at].is_some_and(|error| error < norm.floors[*at])
        };
        for (at, level) in levels.iter().enumerate().filter(at_floor) {
            let stored = level.errors.iter().find(|it| it.quantity.name() == quantity.name.raw());
            let stored = stored.map_or(String::new(), |it| format!(" ({})", it.stored.name()));
            notes.push(format!(
                "`{}`: the error of {} is at its floor of {:.1e}, which rounding of the file makes{stored}; it is left \
                 out of the verdict",
                shown(&level.name),
                quantity.name.shown(),
                norm.floors[at]
            ));
        }
    }
}
