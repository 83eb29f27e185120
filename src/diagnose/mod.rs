//! From the results of a solver to what diagnosis looks at: results, accelerations at an exact state, or a table of a law.

mod evidence;

use mms_diagnosis::answer::Diagnosis;
use mms_diagnosis::changed::Without;
use mms_diagnosis::evidence::{DEGREE, Frame, Mesh, Snapshot};
use mms_diagnosis::exact::{Exact, vectors};
use mms_diagnosis::hypothesis::{Hypothesis, all};
use mms_diagnosis::list::{Listed, listed};
use mms_diagnosis::smooth::Smooth;
use mms_diagnosis::state::{self, Computed};
use mms_diagnosis::table::{self, Measure, Table};
use mms_diagnosis::{ordinary, patterns, step};
use mms_runtime::body::bounding_box;
use mms_runtime::scene::Scene;
use mms_runtime::study::Solve;
use mms_runtime::{ManufacturedField, Method};

pub use evidence::{Reading, read};

/// What there is to look at.
pub enum Evidence {
    /// Results of meshes, from coarse to fine.
    Results(Vec<Mesh>),
    /// Accelerations or residuals at an exact state, of the finest mesh.
    State(StateOf),
    /// Stresses beside H: numbers of points, tensors by rows.
    Law(LawOf),
}

impl Evidence {
    /// What it is, in words.
    pub fn says(&self) -> String {
        match self {
            Evidence::Results(meshes) => {
                let names = meshes.last().and_then(|it| it.snapshots.first());
                let names = names
                    .map_or(Vec::new(), |it| it.values.iter().map(|(it, _)| it.name()).collect());
                format!("{} of {} mesh(es)", names.join(", "), meshes.len())
            }
            Evidence::State(StateOf { computed: Computed::Acceleration, time, .. }) => {
                format!("accelerations at the exact state of t = {time}")
            }
            Evidence::State(StateOf { time, .. }) => {
                format!("residuals at the exact state of t = {time}")
            }
            Evidence::Law(_) => "F and stress, without a solver".into(),
        }
    }
}

/// Accelerations or residuals.
pub struct StateOf {
    /// Which of them.
    pub computed: Computed,
    /// The time.
    pub time: f64,
    /// X.
    pub reference: Vec<f64>,
    /// The values.
    pub values: Vec<f64>,
    /// The volumes of points.
    pub volumes: Option<Vec<f64>>,
    /// h.
    pub cell_size: f64,
}

/// The stresses of a law.
pub struct LawOf {
    /// X; none where it is not given.
    pub reference: Vec<f64>,
    /// H.
    pub gradient: Vec<f64>,
    /// What the stresses are said to be.
    pub measure: Measure,
    /// The stresses.
    pub stress: Vec<f64>,
    /// How far a number may be off, for how it was stored.
    pub rounding: f64,
}

/// What is known of the solver.
#[derive(Clone, Debug, Default)]
pub struct Solver {
    /// Its time step, if it is known.
    pub time_step: Option<f64>,
    /// What was left out.
    pub without: Without,
    /// A method of this project's own solver that it may be like.
    pub like: Option<Method>,
}

/// Fewer points say too little.
const FEWEST_POINTS: usize = 8;
/// The Courant number of a solver whose time step is not known.
const COURANT: f64 = 0.4;

/// Diagnoses evidence of a field.
///
/// # Errors
/// Evidence with which that is not possible.
pub fn diagnose(
    scene: &Scene<f64>,
    evidence: &Evidence,
    solver: &Solver,
) -> anyhow::Result<Diagnosis> {
    match scene {
        Scene::Line(field) => of(field.as_ref(), evidence, solver),
        Scene::Plane(field) => of(field.as_ref(), evidence, solver),
        Scene::Space(field) => of(field.as_ref(), evidence, solver),
    }
}

/// All hypotheses about a field.
pub fn hypotheses(scene: &Scene<f64>) -> Vec<Listed> {
    match scene {
        Scene::Line(field) => listed(&Exact::new(field.as_ref(), 1.0, 1.0)),
        Scene::Plane(field) => listed(&Exact::new(field.as_ref(), 1.0, 1.0)),
        Scene::Space(field) => listed(&Exact::new(field.as_ref(), 1.0, 1.0)),
    }
}

fn of<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    evidence: &Evidence,
    solver: &Solver,
) -> anyhow::Result<Diagnosis>
where
    f64: Solve<D>,
{
    let cell_size = match evidence {
        Evidence::Results(meshes) => meshes.last().map_or(1.0, |mesh| mesh.cell_size),
        Evidence::State(state) => state.cell_size,
        Evidence::Law(_) => 1.0,
    };
    let speed = Exact::new(field, 1.0, 1.0).wave_speed();
    let time_step = solver.time_step.unwrap_or(COURANT * cell_size / speed);
    let exact = Exact::new(field, cell_size, time_step);
    let hypotheses = all(&exact);
    match evidence {
        Evidence::Results(meshes) => {
            if let Some(step) = step::response(&exact, meshes, solver.without) {
                return Ok(state::diagnose(&exact, &step, &hypotheses)?);
            }
            of_results(&exact, meshes, &hypotheses, solver.like.as_ref())
        }
        Evidence::State(state) => {
            let response = state::Response {
                computed: state.computed,
                time: state.time,
                reference: state.reference.clone(),
                values: state.values.clone(),
                volumes: state.volumes.clone(),
                without: solver.without,
                step: None,
            };
            Ok(state::diagnose(&exact, &response, &hypotheses)?)
        }
        Evidence::Law(law) => of_law(&exact, law, hypotheses),
    }
}

fn of_results<const D: usize>(
    exact: &Exact<'_, D>,
    meshes: &[Mesh],
    hypotheses: &[Hypothesis<D>],
    like: Option<&Method>,
) -> anyhow::Result<Diagnosis>
where
    f64: Solve<D>,
{
    let snapshots: Vec<&Snapshot> =
        meshes.last().map_or(Vec::new(), |it| it.snapshots.iter().collect());
    if let Some(found) = patterns::diagnose(exact, &snapshots) {
        return Ok(found);
    }
    let points = meshes.iter().flat_map(|mesh| &mesh.snapshots).map(|it| it.reference.len() / D);
    let points = points.min().unwrap_or(0);
    anyhow::ensure!(
        points >= FEWEST_POINTS,
        "{points} points are too few to tell one mistake from another; expected {FEWEST_POINTS} at least, over all of the body"
    );
    let smooth = Smooth::new(&exact.domain.body, points, DEGREE)?;
    let frame = Frame::new(exact, &snapshots, smooth);
    anyhow::ensure!(
        !frame.times.is_empty(),
        "all results are at the start of the time window, where the state is given: expected results at a later time"
    );
    Ok(ordinary::diagnose(exact, &frame, meshes, hypotheses, like)?)
}

fn of_law<const D: usize>(
    exact: &Exact<'_, D>,
    law: &LawOf,
    hypotheses: Vec<Hypothesis<D>>,
) -> anyhow::Result<Diagnosis> {
    let tensors = |numbers: &[f64]| {
        let each = numbers.chunks_exact(D * D);
        each.map(mms_runtime::Matrix::<f64, D>::from_row_slice).collect::<Vec<_>>()
    };
    let gradient = tensors(&law.gradient);
    let reference = if law.reference.is_empty() {
        let [lower, upper] = bounding_box(&exact.domain.body)?;
        vec![(lower + upper) / 2.0; gradient.len()]
    } else {
        vectors(&law.reference)
    };
    let stress = tensors(&law.stress);
    let table = Table { reference, gradient, measure: law.measure, stress, rounding: law.rounding };
    table::diagnose(exact, &table, hypotheses).ok_or_else(|| {
        anyhow::anyhow!("the exact stress is not finite at a row: is det F <= 0 there?")
    })
}
