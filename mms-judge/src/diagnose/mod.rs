//! Turns the results of a solver into evidence for a diagnosis: results, accelerations at an exact state, or a table of a law.

mod beside;
mod judged;
mod nodes;
mod parameters;

use anyhow::{Context as _, bail, ensure};
use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding};
use mms_diagnosis::changed::Without;
use mms_diagnosis::evidence::{Mesh as Level, Snapshot as Instant};
use mms_diagnosis::exact::Quantity;
use mms_diagnosis::follow::Follow;
use mms_diagnosis::material::Material;
use mms_diagnosis::scene::{self, Evidence, StressData, TangentData};
use mms_diagnosis::solver::Solver;
use mms_diagnosis::state::{Computed, Response};
use mms_diagnosis::table::Measure;
use mms_results::mesh::Mesh;
use mms_results::names::{Form, Meaning, Names, Profile, Role, Values, recognise, wanted};
use mms_results::{Files, Snapshot, Stored};
use mms_runtime::scene::Scene;
use mms_spec::quantity;

pub use self::judged::falls;

use self::nodes::{Nodes, volumes};
use self::parameters::Factors;
use crate::results::{Results, Sample, motion, placed, room};
use mms_exact::Exact;

/// The options for reading results.
pub struct Reading<'a> {
    /// The names of arrays.
    pub names: &'a Names,
    /// Times for results without one.
    pub times: &'a [f64],
    /// A time for results without one, of a field in which nothing moves.
    pub rest: Option<f64>,
    /// h of each FILE, in their order.
    pub sizes: &'a [f64],
    /// The time step of all FILEs, or of each FILE in their order.
    pub time_steps: &'a [f64],
    /// The quantity of a law alone; `None` for results.
    pub law: Option<Alone>,
    /// The sign of residuals: r = sign (rho0 a - Div P - rho0 b).
    pub residual_sign: f64,
    /// Whether residuals are integrated with the shape functions of nodes.
    pub is_nodal: bool,
    /// Right runs of the same solver on the same meshes, in the order of the files; empty to compare with the exact solution.
    pub right: &'a [Results],
    /// The quantities of results to compare; empty for all.
    pub wanted: &'a [quantity::Quantity],
    /// The files that results are read from.
    pub files: &'a dyn Files,
}

/// The names in `--quantity` of the quantities that diagnosis compares.
const OF_RESULTS: [(Quantity, &[quantity::Quantity]); 3] = [
    (Quantity::Displacement, &[quantity::Quantity::Displacement]),
    (Quantity::Velocity, &[quantity::Quantity::Velocity]),
    (
        Quantity::DisplacementGradient,
        &[quantity::Quantity::DisplacementGradient, quantity::Quantity::DeformationGradient],
    ),
];

impl Reading<'_> {
    /// Whether a quantity of results is to be compared.
    fn wants(&self, quantity: Quantity) -> bool {
        let names = OF_RESULTS.iter().find(|(it, _)| *it == quantity);
        self.wanted.is_empty()
            || names.is_some_and(|(_, names)| names.iter().any(|it| self.wanted.contains(it)))
    }

    /// The quantities of which one is needed, in words.
    fn expected(&self) -> String {
        match self.wanted {
            [] => "u, v, F, accelerations or residuals".into(),
            wanted => {
                let names: Vec<_> = wanted.iter().map(|it| it.symbol()).collect();
                format!(
                    "{}, as `--quantity` says (diagnosis looks at u, v and F)",
                    names.join(", ")
                )
            }
        }
    }
}

/// A quantity of a law that is diagnosed without a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alone {
    /// P, S, sigma or tau.
    Stress,
    /// DDSDDE.
    Tangent,
}

/// Reads a named file, as far as diagnosis uses it, with `memory` MB of memory or all that is free.
///
/// # Errors
/// The errors of [`Results::find`].
pub fn find(
    given: &str,
    names: &Names,
    memory: Option<u64>,
    files: &dyn Files,
) -> anyhow::Result<Results> {
    let (room, advice) = room(memory, files);
    Results::find(given, &wanted(names, &|_| true).within(room, advice), files)
}

/// Removes ghosts and duplicate cells; for a field without time, also all snapshots but the last.
///
/// # Errors
/// A duplicate cell with different values.
pub fn keep_own(all: &mut [Results], is_static: bool) -> anyhow::Result<()> {
    all.iter_mut().try_for_each(|it| {
        if is_static {
            it.keep_last();
        }
        it.keep_own().map(drop)
    })
}

/// Diagnoses evidence about a field in a scene, and asks about a parameter of the field if results with an error fit another value of it much better.
///
/// # Errors
/// The obstacles of a diagnosis; a quantity that is too large to derive.
pub fn diagnosis_of(
    exact: &Exact,
    scene: &Scene<f64>,
    evidence: &Evidence,
    solver: &Solver,
    follow: &dyn Follow,
) -> anyhow::Result<(Diagnosis, Option<String>)> {
    let factors = Factors::new(exact);
    let times = |parameter, factor| factors.times(parameter, factor);
    let material = Material { names: factors.names(), times: &times };
    let diagnosis = scene::diagnose(scene, evidence, solver, &material, follow)?;
    let question = question(diagnosis.finding, evidence, exact)?;
    Ok((diagnosis, question))
}

/// Reads files, from coarse to fine, as evidence.
///
/// # Errors
/// A file that cannot be read, and where; results that are no evidence.
pub fn read(all: &[Results], reading: &Reading<'_>, exact: &mut Exact) -> anyhow::Result<Evidence> {
    if let Some(alone) = reading.law {
        let snapshot = all.iter().flat_map(|it| &it.snapshots).next();
        let snapshot =
            snapshot.context("expected a table of F and the stress or tangent of a law")?;
        return law(snapshot, alone, reading, exact);
    }
    if let Some(state) = state(all, reading, exact)? {
        return Ok(state);
    }
    ensure!(!reading.is_nodal, "no residuals at nodes: name their columns with `--map r=..`");
    let right = reading.right.len();
    ensure!(
        right == 0 || right == all.len(),
        "`--reference`: {right} for {} files; expected a right run of each mesh, in the order of the files",
        all.len()
    );
    let count = reading.time_steps.len();
    ensure!(
        count < 2 || count == all.len(),
        "`--time-step`: {count} values for {} files; expected one for all, or one for each",
        all.len()
    );
    let mut levels = Vec::new();
    for (at, results) in all.iter().enumerate() {
        let of_own =
            if count == 1 { reading.time_steps.first() } else { reading.time_steps.get(at) };
        let mut found = level(results, reading, reading.sizes.get(at).copied(), exact)?;
        if let Some(right) = reading.right.get(at) {
            let of_right = level(right, reading, None, exact)?;
            beside::compare(&mut found, &of_right, [&results.name, &right.name], exact)?;
        }
        levels.push(Level { time_step: of_own.copied(), ..found });
    }
    levels.sort_by(|a, b| b.cell_size.total_cmp(&a.cell_size));
    Ok(Evidence::Results(levels))
}

/// The question about a parameter; `None` for evidence other than displacements.
fn question(
    found: DiagnosisFinding,
    evidence: &Evidence,
    exact: &Exact,
) -> anyhow::Result<Option<String>> {
    let Evidence::Results(meshes) = evidence else { return Ok(None) };
    if found == DiagnosisFinding::Nothing {
        return Ok(None);
    }
    let Some(last) = meshes.last().and_then(|it| it.snapshots.last()) else { return Ok(None) };
    let u = last.values.iter().find(|(quantity, _)| *quantity == Quantity::Displacement);
    let sample = u.map(|(_, u)| Sample::of_points(last.time, &last.reference, u, exact));
    sample.map_or(Ok(None), |it| it.question(exact))
}

/// The names under which results contain the gradient of u: H, F, or both.
///
/// # Errors
/// The errors of [`read`].
pub fn gradients(
    all: &[Results],
    reading: &Reading<'_>,
    exact: &Exact,
) -> anyhow::Result<Vec<quantity::Quantity>> {
    let Some(snapshot) = all.iter().flat_map(|it| &it.snapshots).next() else {
        return Ok(Vec::new());
    };
    let found = meanings(snapshot, reading, exact)?;
    let named = [
        (Role::DisplacementGradient, quantity::Quantity::DisplacementGradient),
        (Role::DeformationGradient, quantity::Quantity::DeformationGradient),
    ];
    let is_there = |role: Role| found.iter().any(|it| it.role == role);
    Ok(named.into_iter().filter(|(role, _)| is_there(*role)).map(|(_, it)| it).collect())
}

/// The quantities that diagnosis looks for; except for a law alone, only arrays of the right shape.
///
/// # Errors
/// A name that may mean two quantities.
fn meanings(
    snapshot: &Snapshot,
    reading: &Reading<'_>,
    exact: &Exact,
) -> anyhow::Result<Vec<Meaning>> {
    let mut found = recognised(snapshot, reading)?;
    if reading.law.is_none() {
        found.retain(|meaning| unlike(meaning, snapshot, exact).is_none());
    }
    Ok(found)
}

/// The reason why an array has another shape than the quantity of its name; `None` if it has that shape.
fn unlike(meaning: &Meaning, snapshot: &Snapshot, exact: &Exact) -> Option<String> {
    let is_tensor = matches!(meaning.role.form(), Form::Tensor | Form::Symmetric);
    let rows = if is_tensor { exact.space().rows() } else { exact.dimension };
    meaning.mismatch(snapshot, rows, None)
}

/// The quantities that diagnosis looks for, with arrays of any shape.
///
/// # Errors
/// A name that may mean two quantities.
fn recognised(snapshot: &Snapshot, reading: &Reading<'_>) -> anyhow::Result<Vec<Meaning>> {
    if reading.law.is_none() {
        return recognise(snapshot, reading.names, &|role| !is_stress(role)).map_err(placed);
    }
    // Tables of a law use the symbols of this project; in results of other codes S may be another stress.
    let profile = reading.names.profile.clone().or_else(|| Some(Profile::symbols()));
    recognise(snapshot, &Names { profile, ..reading.names.clone() }, &|_| true).map_err(placed)
}

/// The arrays of known names in the first result that are left out because of their shape.
///
/// # Errors
/// A name that may mean two quantities.
pub fn left_out(
    all: &[Results],
    reading: &Reading<'_>,
    exact: &Exact,
) -> anyhow::Result<Vec<String>> {
    let first = all.first().and_then(|it| it.snapshots.first());
    let Some(snapshot) = first.filter(|_| reading.law.is_none()) else { return Ok(Vec::new()) };
    let found = recognised(snapshot, reading)?;
    Ok(found.iter().filter_map(|it| unlike(it, snapshot, exact)).collect())
}

/// Whether the quantity is a stress, which diagnosis does not use in results.
fn is_stress(role: Role) -> bool {
    MEASURES.iter().any(|(it, _)| *it == role)
}

fn values<'a>(
    meanings: &[Meaning],
    role: Role,
    snapshot: &'a Snapshot,
    dimension: usize,
) -> anyhow::Result<Option<Values<'a>>> {
    let meaning = meanings.iter().find(|it| it.role == role);
    let values = meaning.map(|it| it.values(snapshot, dimension)).transpose().map_err(placed)?;
    Ok(values.filter(|it| !it.is_of_cells))
}

/// H, from H or F; for an axisymmetric field its part in the meridian.
fn gradient<'a>(
    meanings: &[Meaning],
    snapshot: &'a Snapshot,
    exact: &Exact,
) -> anyhow::Result<Option<Values<'a>>> {
    let (rows, dimension) = (exact.space().rows(), exact.dimension);
    let whole = whole_gradient(meanings, snapshot, rows)?;
    let is_around = |at: usize| at % rows >= dimension || at / rows % rows >= dimension;
    Ok(whole.map(|it| match rows == dimension {
        true => it,
        false => {
            let kept = it.numbers.iter().enumerate().filter(|(at, _)| !is_around(*at));
            let numbers = kept.map(|(_, number)| *number).collect();
            Values { numbers, components: dimension * dimension, ..it }
        }
    }))
}

fn whole_gradient<'a>(
    meanings: &[Meaning],
    snapshot: &'a Snapshot,
    dimension: usize,
) -> anyhow::Result<Option<Values<'a>>> {
    if let Some(h) = values(meanings, Role::DisplacementGradient, snapshot, dimension)? {
        return Ok(Some(h));
    }
    let mut f = values(meanings, Role::DeformationGradient, snapshot, dimension)?;
    let numbers = f.as_mut().map_or(&mut [][..], |it| it.numbers.to_mut());
    for point in numbers.chunks_mut(dimension * dimension) {
        (0..dimension).for_each(|axis| point[axis * (dimension + 1)] -= 1.0);
    }
    Ok(f)
}

/// The columns of stress and their measures.
const MEASURES: [(Role, Measure); 4] = [
    (Role::FirstPiolaKirchhoff, Measure::FirstPiola),
    (Role::SecondPiolaKirchhoff, Measure::SecondPiola),
    (Role::KirchhoffStress, Measure::Kirchhoff),
    (Role::CauchyStress, Measure::Cauchy),
];

fn law(
    snapshot: &Snapshot,
    alone: Alone,
    reading: &Reading<'_>,
    exact: &Exact,
) -> anyhow::Result<Evidence> {
    let (dimension, meanings) = (exact.dimension, meanings(snapshot, reading, exact)?);
    let h = gradient(&meanings, snapshot, exact)?;
    let h =
        h.with_context(|| format!("{}: no F: name its columns with `--map F=..`", snapshot.path))?;
    let reference = values(&meanings, Role::Reference, snapshot, dimension)?;
    let reference = reference.map_or(Vec::new(), |it| it.numbers.into_owned());
    let rows = h.numbers.len() / (dimension * dimension);
    if alone == Alone::Tangent {
        let found = values(&meanings, Role::Tangent, snapshot, dimension)?;
        let found = found.with_context(|| {
            format!(
                "{}: no tangent: name its columns row by row with `--map DDSDDE=..`",
                snapshot.path
            )
        })?;
        ensure!(
            found.numbers.len() == rows * found.components,
            "{}: F and the tangent of different rows",
            snapshot.path
        );
        return Ok(Evidence::Tangent(TangentData {
            reference,
            gradient: h.numbers.into_owned(),
            rounding: found.rounding,
            tangent: found.numbers.into_owned(),
        }));
    }
    let mut found = Vec::new();
    for (role, measure) in MEASURES {
        found.extend(values(&meanings, role, snapshot, dimension)?.map(|it| (measure, it)));
    }
    let (measure, stress) = match found.len() {
        0 => bail!(
            "{}: no stress: name its columns with `--map P=..`, S, sigma or tau",
            snapshot.path
        ),
        1 => found.remove(0),
        _ => bail!("{}: several measures of stress: keep only one in the file", snapshot.path),
    };
    ensure!(
        stress.numbers.len() == h.numbers.len(),
        "{}: F and stress of different rows",
        snapshot.path
    );
    Ok(Evidence::Law(StressData {
        reference,
        rounding_of_gradient: if h.stored == Stored::Double { 0.0 } else { h.rounding },
        gradient: h.numbers.into_owned(),
        measure,
        rounding: stress.rounding,
        stress: stress.numbers.into_owned(),
    }))
}

/// Reads residuals; or accelerations, if the motion of the points is exact or absent: otherwise accelerations count as results.
fn state(
    all: &[Results],
    reading: &Reading<'_>,
    exact: &mut Exact,
) -> anyhow::Result<Option<Evidence>> {
    let Some(results) = all.last() else { return Ok(None) };
    let Some(snapshot) = results.snapshots.first() else { return Ok(None) };
    let (dimension, meanings) = (exact.dimension, meanings(snapshot, reading, exact)?);
    let residual = if reading.is_nodal { Computed::NodalResidual } else { Computed::Residual };
    let kinds = [(Role::Residual, residual), (Role::Acceleration, Computed::Acceleration)];
    let asked = if reading.is_nodal { &kinds[..1] } else { &kinds[..] };
    for &(role, computed) in asked {
        let Some(mut found) = values(&meanings, role, snapshot, dimension)? else { continue };
        if role == Role::Residual {
            found.numbers.to_mut().iter_mut().for_each(|it| *it *= reading.residual_sign);
        }
        let time = time(snapshot, reading, 0)?;
        let motion = motion(snapshot, &meanings, time, (exact, false))?;
        let rounding = motion.reference.rounding;
        let reference = motion.reference.numbers.into_owned();
        let u = motion.displacement.map(|it| it.numbers);
        let right = exact.values(quantity::Quantity::Displacement, time, &reference)?;
        let is_at_exact = u.is_none_or(|u| is_near(&u, &right));
        if computed == Computed::Acceleration && !is_at_exact {
            return Ok(None);
        }
        let is_meridian = exact.space().is_axisymmetric();
        let mesh = Mesh { cells: &snapshot.cells, points: &reference, dimension, is_meridian };
        let volumes = match computed {
            Computed::NodalResidual => None,
            _ => {
                let column = values(&meanings, Role::Volume, snapshot, 1)?;
                Some(volumes(column, &mesh, (time, rounding, &snapshot.path), exact)?)
            }
        };
        let cell_size = size(reading.sizes.last().copied(), &mesh, exact);
        let degree = mesh.degree();
        let nodes = Nodes { reference, values: found.numbers.into_owned(), volumes };
        let Nodes { reference, values, volumes } = nodes.merged(exact, &snapshot.path)?;
        let response = Response {
            computed,
            time,
            reference,
            values,
            volumes,
            degree,
            without: Without::default(),
            step: None,
        };
        return Ok(Some(Evidence::State { response, cell_size }));
    }
    Ok(None)
}

/// The largest relative distance from an exact state: rounding of a file, but no error of a method.
const EXACT: f64 = 1e-6;

fn is_near(a: &[f64], b: &[f64]) -> bool {
    let largest =
        |it: &mut dyn Iterator<Item = f64>| it.fold(0.0, |most: f64, it| most.max(it.abs()));
    let apart = largest(&mut a.iter().zip(b).map(|(a, b)| a - b));
    apart <= EXACT * largest(&mut b.iter().copied())
}

fn time(snapshot: &Snapshot, reading: &Reading<'_>, at: usize) -> anyhow::Result<f64> {
    let given = reading.times.get(at).copied().or(reading.rest);
    let time = snapshot.time.map(|it| it.value).or(given);
    time.with_context(|| format!("{}: it has no time; give it with `--time`", snapshot.path))
}

/// h: the given one, from cells, or estimated from the number of points.
fn size(given: Option<f64>, mesh: &Mesh<'_>, exact: &Exact) -> f64 {
    let points = mesh.points.len() / exact.dimension;
    given.or(mesh.sizes().map(|[_, longest]| longest)).unwrap_or_else(|| exact.spacing(points))
}

fn level(
    results: &Results,
    reading: &Reading<'_>,
    given: Option<f64>,
    exact: &mut Exact,
) -> anyhow::Result<Level> {
    let mut level = Level::default();
    for (at, snapshot) in results.snapshots.iter().enumerate() {
        let (dimension, meanings) = (exact.dimension, meanings(snapshot, reading, exact)?);
        let time = time(snapshot, reading, at)?;
        let motion = motion(snapshot, &meanings, time, (exact, false))?;
        let rounding = motion.reference.rounding;
        let reference = motion.reference.numbers.into_owned();
        let is_meridian = exact.space().is_axisymmetric();
        let mesh = Mesh { cells: &snapshot.cells, points: &reference, dimension, is_meridian };
        level.cell_size = size(given, &mesh, exact);
        let u = motion.displacement.map(|it| (Quantity::Displacement, it.numbers.into_owned()));
        let v = values(&meanings, Role::Velocity, snapshot, dimension)?
            .map(|it| (Quantity::Velocity, it.numbers.into_owned()));
        let h = gradient(&meanings, snapshot, exact)?
            .map(|it| (Quantity::DisplacementGradient, it.numbers.into_owned()));
        let mut values: Vec<_> = [u, v, h].into_iter().flatten().collect();
        values.retain(|(it, _)| reading.wants(*it));
        ensure!(
            !values.is_empty(),
            "{}: nothing to diagnose; expected {}; name them with `--map u=..`",
            snapshot.path,
            reading.expected()
        );
        let column = self::values(&meanings, Role::Volume, snapshot, 1)?;
        let volumes = volumes(column, &mesh, (time, rounding, &snapshot.path), exact).ok();
        let degree = mesh.degree();
        level.snapshots.push(Instant { time, reference, values, volumes, degree });
    }
    ensure!(!level.snapshots.is_empty(), "`{}`: no results", results.name);
    Ok(level)
}
