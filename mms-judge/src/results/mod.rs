//! Results of any solver against a field: their errors, as [`Measured`].
//!
//! `files` reads them, with `mms-results`; `times` finds the times at which meshes can be compared; `level` measures a snapshot
//! against the field's program ([`Exact`]), and finds the error floor from the rounding of the file; `snapshot_errors` computes
//! the errors. `baseline` and `repeated` compare results with results; `refit` finds a time or a parameter that fits better;
//! `excluded` finds the mistakes that a small error excludes.

mod baseline;
mod degree;
mod excluded;
mod expected;
mod explained;
mod extent;
mod files;
mod given;
mod iterative;
mod largest;
mod level;
mod refit;
mod remarks;
mod repeated;
mod snapshot_errors;
mod start;
mod times;
mod traction;
mod units;

use anyhow::{bail, ensure};
use mms_diagnosis::follow::Follow;
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

pub use baseline::{Baseline, Compared};
pub use excluded::{Exclusions, exclusions};
pub use explained::Explained;
pub use extent::{distances, motion};
pub use files::{Results, placed, room};
pub use level::{Over, Reading, Sampling, axes, own_roles, weight, without_positions};
pub use refit::Sample;
pub use repeated::{Same, same};
pub use start::Start;
pub use units::known as unit;

use self::level::{Errors, Measure, SnapshotFindings};
use self::start::Lowered;
use crate::measured::{Measured, Norm, Objection, RunSize};
use crate::table::ExpectedOrders;
use mms_exact::Exact;

/// The measured errors, with notes and warnings about them.
pub struct Measurement {
    /// The errors.
    pub measured: Measured,
    /// The sampling of each quantity.
    pub samplings: Vec<Sampling>,
    /// The times at which levels were compared.
    pub times: Vec<f64>,
    /// Iterative errors as root mean squares, for the quantities of which they are known.
    pub iterative: Vec<(&'static str, f64)>,
    /// The reason why the results are no evidence, if there is one.
    pub objection: Option<Objection>,
    /// The part of the body that results cover, if a part is enough.
    pub part: Option<String>,
    /// The place of the largest error of each quantity on the finest mesh, in words.
    pub largest: Vec<String>,
    /// Displacements of the finest mesh, for a verdict that is no pass.
    pub sample: Option<Sample>,
    /// The number of points of the mesh with the fewest points.
    pub points: usize,
    /// Notes on how errors were measured, and why.
    pub notes: Vec<String>,
    /// Warnings about possible mistakes.
    pub warnings: Vec<String>,
}

/// The largest part of the largest value that rounding may hide in a file whose values count as exact: slightly more than the
/// rounding of single precision.
const FINE: f64 = 1e-6;

/// One mesh, measured at all times.
struct MeasuredMesh {
    name: String,
    /// The errors of quantities, the largest over times.
    errors: Vec<Errors>,
    found: SnapshotFindings,
}

/// The largest ratio of sizes, of cells in a mesh or of meshes in a study, that is not reported.
const ALIKE: f64 = 1.01;

/// The options for comparing meshes.
pub struct Comparison<'a> {
    /// h, in the order of the results; empty for sizes from cells or points.
    pub sizes: &'a [f64],
    /// The wanted times; empty for all that meshes have in common.
    pub times: &'a [f64],
    /// The expected orders.
    pub orders: &'a ExpectedOrders,
    /// Whether dt of each mesh is known, so that an order in time can be expected.
    pub has_steps: bool,
    /// Results of one of the meshes with a smaller tolerance of the solver.
    pub tighter: Option<Results>,
    /// The follower, which gets a line for each mesh.
    pub follow: &'a dyn Follow,
}

/// Measures the errors of results on meshes.
///
/// # Errors
/// Results that do not belong to the field, and where.
pub fn measure(
    mut all: Vec<Results>,
    reading: &Reading<'_>,
    exact: &mut Exact,
    comparison: Comparison<'_>,
) -> anyhow::Result<Measurement> {
    let Comparison { sizes, times, orders, has_steps, tighter, follow } = comparison;
    let meshes = all.len();
    all.extend(tighter);
    let own = all.iter_mut().map(Results::keep_own).collect::<anyhow::Result<Vec<_>>>()?;
    let common = times::common(&mut all, times, exact)?;
    let (all, tighter) = all.split_at(meshes);
    let mut levels = Vec::new();
    for (at, (results, snapshots)) in all.iter().zip(&common.snapshots).enumerate() {
        follow.say(&format!("error of mesh {} of {meshes}", at + 1));
        levels.push(level(results, snapshots, reading, exact)?);
    }
    let mut quantities = quantities(&levels)?;
    let mut notes = vec![remarks::compared(&common), remarks::meshes(&levels)];
    if let [tighter] = tighter {
        let (snapshots, own) = common.snapshots.split_at(meshes);
        let given = ((all, snapshots), (tighter, own[0].as_slice()));
        notes.push(iterative::raise(&mut levels, given.0, given.1, reading, exact)?);
    }
    let mut warnings = Vec::new();
    let sizes = lengths(&levels, sizes, &mut notes, &mut warnings)?;
    notes.push(format!("X: {}", levels[0].found.how));
    validate_evidence(&levels[0], &quantities, reading.over)?;
    let degree = levels.iter().filter_map(|it| it.found.degree).min();
    notes.extend(remarks::order(degree, orders));
    let orders = &expected::named(orders).of_degree(degree);
    expected::validate_orders(&quantities, orders, has_steps)?;
    if reading.over.is_none() {
        degree::validate_linear(&levels, &sizes, orders)?;
    }
    let lowered = Lowered::new(orders, (&levels, &sizes), exact)?;
    notes.extend(quantities.iter().filter_map(|(it, _)| lowered.note(*it, orders)));
    let all = quantities.clone();
    quantities.retain(|(it, _)| !lowered.is_blind_to(*it, orders));
    let is_blind = quantities.is_empty();
    if is_blind {
        quantities = all;
    }
    notes.extend(remarks::norms(&quantities));
    notes.extend(remarks::rings(exact));
    notes.push(remarks::left_out(&common, &levels, &own));
    let is_input = levels.iter().flat_map(|it| &it.errors).all(|it| it.is_input);
    remarks::suspicions(&levels, is_input, &mut warnings);
    let runs = sizes.iter().map(|&cell_size| RunSize { cell_size, time_step: None }).collect();
    let measured: Vec<_> =
        quantities.iter().map(|it| quantity(*it, &levels, (orders, &lowered))).collect();
    let part = levels.iter().find_map(|level| {
        level.found.covered.part.as_ref().map(|part| format!("`{}`: {part}", shown(&level.name)))
    });
    let objection = match &part {
        _ if is_input => Some(given::objection()),
        _ if is_blind => Some(start::objection()),
        Some(part) if !reading.is_part => Some(extent::objection(part)),
        _ => None,
    };
    let part = part.filter(|_| reading.is_part);
    remarks::floors(&measured, &levels, &mut notes);
    let measured = Measured { runs, quantities: measured };
    let iterative = levels[0]
        .errors
        .iter()
        .filter_map(|it| Some((it.quantity.name(), it.iterative?)))
        .collect();
    let points = levels.iter().map(|level| level.found.covered.points).min().unwrap_or_default();
    let names: Vec<_> = quantities.iter().map(|(it, _)| *it).collect();
    let finest = levels.iter().zip(&sizes).min_by(|a, b| a.1.total_cmp(b.1));
    Ok(Measurement {
        measured,
        sample: finest.and_then(|(it, _)| it.found.sample.clone()),
        largest: largest::places(&names, (&levels, &sizes), exact),
        points,
        samplings: quantities.iter().map(|(_, sampling)| *sampling).collect(),
        times: common.times,
        iterative,
        objection,
        part,
        notes,
        warnings,
    })
}

fn level(
    results: &Results,
    snapshots: &[usize],
    reading: &Reading<'_>,
    exact: &mut Exact,
) -> anyhow::Result<MeasuredMesh> {
    let what = |errors: &Errors| (errors.quantity, errors.sampling);
    let mut level: Option<MeasuredMesh> = None;
    for snapshot in snapshots.iter().map(|&at| &results.snapshots[at]) {
        let Some(time) = snapshot.time else { continue };
        let found = reading.measure(snapshot, time.value, time.rounding, exact)?;
        match &mut level {
            None => {
                level = Some(MeasuredMesh {
                    name: results.name.clone(),
                    errors: found.errors.clone(),
                    found,
                })
            }
            Some(level) => {
                ensure!(
                    level.errors.iter().map(what).eq(found.errors.iter().map(what)),
                    "{}: its quantities differ from the result before it, or only one of the two has cells",
                    snapshot.path
                );
                level.errors.iter_mut().zip(found.errors).for_each(|(most, one)| most.raise(one));
                let part = &mut level.found.covered.part;
                *part = part.take().or(found.covered.part);
                level.found.sample = found.sample.or(level.found.sample.take());
            }
        }
    }
    match level {
        Some(level) => Ok(level),
        None => bail!("`{}`: no results", results.name),
    }
}

impl Errors {
    /// Whether no error exceeds the rounding of the file.
    fn is_noise(&self) -> bool {
        self.norms.iter().all(|(_, measure)| measure.error <= measure.rounding_error)
    }

    /// Whether no error exceeds the rounding, and the file has enough digits to show it.
    fn is_exact(&self) -> bool {
        let is_fine = |(_, measure): &(_, Measure)| measure.rounding_error <= FINE * self.largest;
        self.is_noise() && self.norms.iter().filter(|(name, _)| *name != "h1").all(is_fine)
    }

    /// Keeps the larger error in each norm.
    fn raise(&mut self, other: Errors) {
        self.largest = self.largest.max(other.largest);
        self.at_points = self.at_points.zip(other.at_points).map(|(a, b)| a.max(b));
        self.unit = self.unit.filter(|unit| other.unit == Some(*unit));
        self.is_input &= other.is_input;
        if other.of_time[0] > self.of_time[0] {
            self.of_time = other.of_time;
        }
        for ((name, most), (_, one)) in self.norms.iter_mut().zip(other.norms) {
            if *name == "linf" && one.error > most.error {
                self.largest_at.clone_from(&other.largest_at);
            }
            *most = Measure {
                error: most.error.max(one.error),
                rounding_error: most.rounding_error.max(one.rounding_error),
            };
        }
    }
}

/// The quantities that all levels have, each with its sampling.
fn quantities(levels: &[MeasuredMesh]) -> anyhow::Result<Vec<(Quantity, Sampling)>> {
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

/// Refuses to judge a mesh by points or by middles of cells alone, because orders there may be higher than elsewhere. Polygons
/// are exempt, since their functions are not known.
fn validate_evidence(
    level: &MeasuredMesh,
    quantities: &[(Quantity, Sampling)],
    over: Option<Over>,
) -> anyhow::Result<()> {
    let is_over_cells = quantities.iter().any(|(_, it)| *it == Sampling::Cells);
    ensure!(
        level.found.sizes.is_none()
            || level.found.unknown.is_some()
            || is_over_cells
            || over == Some(Over::Points),
        "`{}`: only values at {} would be judged, where they may be more accurate than elsewhere (superconvergence); \
         judge a quantity of the points over the cells as well, such as u",
        shown(&level.name),
        quantities[0].1.name()
    );
    Ok(())
}

/// h of each level, from the user, from cells or from points.
fn lengths(
    levels: &[MeasuredMesh],
    given: &[f64],
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
    let covered = || levels.iter().map(|level| &level.found.covered);
    let of_cells: Option<Vec<[f64; 2]>> = levels.iter().map(|level| level.found.sizes).collect();
    let says = match &of_cells {
        Some(_) => "(measure of the cells / their number)^(1/D)",
        None if covered().all(|it| it.is_even) => {
            "the distance of neighbouring points, since there are no cells"
        }
        None => {
            "(measure of the body / points)^(1/D), for there are no cells; a point on a face counts half"
        }
    };
    notes.push(format!("h: {says}; give others with `--h`"));
    if let Some(sizes) = of_cells {
        let ratios: Vec<f64> = sizes.iter().map(|[least, most]| most / least).collect();
        if ratios.iter().any(|it| it / ratios[0] > ALIKE || ratios[0] / it > ALIKE) {
            let ratios: Vec<_> = ratios.iter().map(|it| format!("{it:.2}")).collect();
            warnings.push(format!(
                "h_max/h_min varies from mesh to mesh ({}): orders assume meshes that are refined evenly",
                ratios.join(", ")
            ));
        }
    }
    Ok(covered().map(|it| it.size).collect())
}

/// The errors of a quantity in the form for a judgement.
fn quantity(
    (of, sampling): (Quantity, Sampling),
    levels: &[MeasuredMesh],
    (orders, lowered): (&ExpectedOrders, &Lowered),
) -> crate::measured::Quantity {
    let errors: Vec<&Errors> = levels
        .iter()
        .filter_map(|level| level.errors.iter().find(|it| it.quantity == of))
        .collect();
    let norm = |at: usize| {
        let name = errors[0].norms[at].0;
        let measures: Vec<Measure> = errors.iter().map(|it| it.norms[at].1).collect();
        Norm {
            name: name.into(),
            expected: expected::expected((orders, lowered), (of, sampling), name),
            errors: measures.iter().map(|it| Some(it.error)).collect(),
            floors: measures.iter().map(|it| it.rounding_error).collect(),
            rounding: 0.0,
            is_exact: errors.iter().all(|it| it.is_exact()),
        }
    };
    // A start excites waves of bounded energy, which bounds means of errors, but no maximum.
    let is_judged = |at: &usize| lowered.of(of).is_none() || errors[0].norms[*at].0 != "linf";
    crate::measured::Quantity {
        name: of.name().into(),
        norms: (0..errors[0].norms.len()).filter(is_judged).map(norm).collect(),
    }
}
