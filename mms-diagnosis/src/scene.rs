//! Diagnosis of a field of any dimension. Callers compile no code that depends on the dimension.

use mms_runtime::body::bounding_box;
use mms_runtime::scene::Scene;
use mms_runtime::study::Solve;
use mms_runtime::{ManufacturedField, Matrix, Method, Vector};

use crate::answer::{Diagnosis, Ranked, Rung};
use crate::closed_form::{self, ClosedForm, Values};
use crate::evidence::{ComparisonFrame, DEGREE, Mesh, Snapshot};
use crate::exact::{Exact, Parameters, Quantity, vectors};
use crate::excluded::{Excluded, Study, excluded};
use crate::follow::{Follow, Unfollowed};
use crate::hypothesis::{Hypothesis, all};
use crate::list::{Listed, listed};
use crate::material::{Material, Own};
use crate::revolved::Revolved;
use crate::run::Obstacle;
use crate::smooth::Smooth;
use crate::solver::Solver;
use crate::state::{self, Response};
use crate::table::{self, Measure, StressTable};
use crate::{like, ordinary, patterns, place, step, tangent};

/// The evidence for a diagnosis.
pub enum Evidence {
    /// Results of meshes, from coarse to fine.
    Results(Vec<Mesh>),
    /// Accelerations or residuals at an exact state, of the finest mesh.
    State {
        /// The computed values.
        response: Response,
        /// h.
        cell_size: f64,
    },
    /// Stresses of a law at given H: numbers point by point, tensors by rows.
    Law(StressData),
    /// Tangents of a law at given H.
    Tangent(TangentData),
}

impl Evidence {
    /// Describes the evidence in words.
    pub fn says(&self) -> String {
        match self {
            Evidence::Results(meshes) => {
                let names = meshes.last().and_then(|it| it.snapshots.first());
                let names = names
                    .map_or(Vec::new(), |it| it.values.iter().map(|(it, _)| it.name()).collect());
                let sizes: Vec<_> =
                    meshes.iter().map(|it| format!("{:.3e}", it.cell_size)).collect();
                format!(
                    "{} of {} mesh(es), h = {}",
                    names.join(", "),
                    meshes.len(),
                    sizes.join(", ")
                )
            }
            Evidence::State { response, .. } => {
                format!("{}, at t = {}", Rung::State(response.computed).says(), response.time)
            }
            Evidence::Law(_) => "F and stress, without a solver".into(),
            Evidence::Tangent(_) => "F and the tangent, without a solver".into(),
        }
    }
}

/// The stresses of a law, in lists of numbers.
pub struct StressData {
    /// X; empty if it is not given.
    pub reference: Vec<f64>,
    /// H.
    pub gradient: Vec<f64>,
    /// The declared measure of the stresses.
    pub measure: Measure,
    /// The stresses.
    pub stress: Vec<f64>,
    /// The uncertainty of a stress, from how it was stored.
    pub rounding: f64,
    /// The uncertainty of a component of H.
    pub rounding_of_gradient: f64,
}

/// The tangents of a law, in lists of numbers.
pub struct TangentData {
    /// X; empty if it is not given.
    pub reference: Vec<f64>,
    /// H.
    pub gradient: Vec<f64>,
    /// The tangents row by row, of the components 11, 22, 12 or 11, 22, 33, 12, 13, 23.
    pub tangent: Vec<f64>,
    /// The uncertainty of a number, from how it was stored.
    pub rounding: f64,
}

/// The most points of a mesh that are compared.
const MOST_POINTS: usize = 5000;
/// The least number of points for a diagnosis.
pub const FEWEST_POINTS: usize = 8;
/// The Courant number assumed for a solver whose time step is not known.
const COURANT: f64 = 0.4;

/// Diagnoses evidence of a field.
///
/// # Errors
/// Evidence with which that is not possible; a follower that ends the diagnosis.
pub fn diagnose(
    scene: &Scene<f64>,
    evidence: &Evidence,
    solver: &Solver,
    material: &Material<'_>,
    follow: &dyn Follow,
) -> Result<Diagnosis, Obstacle> {
    match scene {
        Scene::Line(field) => {
            let own = Own::new(material, |it| match it {
                Scene::Line(field) => Some(field),
                _ => None,
            });
            of(field.as_ref(), &own, evidence, solver, follow)
        }
        Scene::Plane(field) => {
            let own = Own::new(material, |it| match it {
                Scene::Plane(field) => Some(field),
                _ => None,
            });
            of(field.as_ref(), &own, evidence, solver, follow)
        }
        Scene::Space(field) => {
            let own = Own::new(material, |it| match it {
                Scene::Space(field) => Some(field),
                _ => None,
            });
            of(field.as_ref(), &own, evidence, solver, follow)
        }
    }
}

/// The orders with which the errors of a right method fall on a field, for the quantities of results of meshes.
///
/// # Errors
/// Runs that stop, that would take too long, or whose error does not fall.
pub fn orders_of(
    scene: &Scene<f64>,
    meshes: &[Mesh],
    method: &Method,
) -> Result<Vec<(Quantity, f64)>, Obstacle> {
    match scene {
        Scene::Line(field) => orders(field.as_ref(), meshes, method),
        Scene::Plane(field) => orders(field.as_ref(), meshes, method),
        Scene::Space(field) => orders(field.as_ref(), meshes, method),
    }
}

fn orders<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    meshes: &[Mesh],
    method: &Method,
) -> Result<Vec<(Quantity, f64)>, Obstacle>
where
    f64: Solve<D>,
{
    let meshes = thinned::<D>(meshes);
    let Some(mesh) = meshes.last() else { return Ok(Vec::new()) };
    with_exact(field, None, (mesh.cell_size, None), &Unfollowed, |exact| {
        like::orders_of(exact, &frame(exact, &meshes)?, mesh, method)
    })
}

/// Lists the mistakes that results exclude, if their errors are no larger than a method's error.
///
/// # Errors
/// Runs of our own that would take too long, or that stop; a follower that ends the work.
pub fn excludes(
    scene: &Scene<f64>,
    study: &Study,
    follow: &dyn Follow,
) -> Result<Vec<Excluded>, Obstacle> {
    match scene {
        Scene::Line(field) => excludes_of(field.as_ref(), study, follow),
        Scene::Plane(field) => excludes_of(field.as_ref(), study, follow),
        Scene::Space(field) => excludes_of(field.as_ref(), study, follow),
    }
}

/// The mistake that gives a closed form from paper; `None` if no hypothesis gives it.
pub fn closed_form(scene: &Scene<f64>, of: ClosedForm, values: &Values<'_>) -> Option<Ranked> {
    match scene {
        Scene::Line(field) => closed_form_of(field.as_ref(), of, values),
        Scene::Plane(field) => closed_form_of(field.as_ref(), of, values),
        Scene::Space(field) => closed_form_of(field.as_ref(), of, values),
    }
}

/// Whether nothing moves in a field.
pub fn is_at_rest(scene: &Scene<f64>) -> bool {
    match scene {
        Scene::Line(field) => Exact::new(field.as_ref(), 1.0, 1.0).is_at_rest(),
        Scene::Plane(field) => Exact::new(field.as_ref(), 1.0, 1.0).is_at_rest(),
        Scene::Space(field) => Exact::new(field.as_ref(), 1.0, 1.0).is_at_rest(),
    }
}

/// All hypotheses about a field.
pub fn hypotheses(scene: &Scene<f64>) -> Vec<Listed> {
    match scene {
        Scene::Line(field) => {
            with_exact(field.as_ref(), None, (1.0, Some(1.0)), &Unfollowed, |it| listed(it))
        }
        Scene::Plane(field) => {
            with_exact(field.as_ref(), None, (1.0, Some(1.0)), &Unfollowed, |it| listed(it))
        }
        Scene::Space(field) => {
            with_exact(field.as_ref(), None, (1.0, Some(1.0)), &Unfollowed, |it| listed(it))
        }
    }
}

/// Calls a function with a field and the data of a solver with this h. The default time step has the Courant number
/// [`COURANT`].
fn with_exact<const D: usize, R>(
    field: &dyn ManufacturedField<f64, D>,
    parameters: Option<&dyn Parameters<D>>,
    (cell_size, time_step): (f64, Option<f64>),
    follow: &dyn Follow,
    then: impl FnOnce(&mut Exact<'_, D>) -> R,
) -> R {
    let ordinary = || COURANT * cell_size / Exact::new(field, 1.0, 1.0).wave_speed();
    let time_step = time_step.unwrap_or_else(ordinary);
    let revolved = Revolved(field);
    let is_axisymmetric = field.axisymmetric().is_some();
    let space = is_axisymmetric.then(|| Exact::in_space(&revolved, cell_size, time_step));
    let mut exact = Exact::new(field, cell_size, time_step);
    (exact.space, exact.parameters, exact.follow) = (space.as_ref(), parameters, follow);
    then(&mut exact)
}

fn closed_form_of<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    of: ClosedForm,
    values: &Values<'_>,
) -> Option<Ranked> {
    with_exact(field, None, (1.0, None), &Unfollowed, |exact| {
        closed_form::diagnose(exact, of, values, all(exact))
    })
}

fn excludes_of<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    study: &Study,
    follow: &dyn Follow,
) -> Result<Vec<Excluded>, Obstacle>
where
    f64: Solve<D>,
{
    with_exact(field, None, (study.cell_size, study.time_step), follow, |exact| {
        excluded(exact, study, &all(exact))
    })
}

fn of<const D: usize>(
    field: &dyn ManufacturedField<f64, D>,
    parameters: &Own<'_, D>,
    evidence: &Evidence,
    solver: &Solver,
    follow: &dyn Follow,
) -> Result<Diagnosis, Obstacle>
where
    f64: Solve<D>,
{
    let (cell_size, time_step) = match evidence {
        Evidence::Results(meshes) => {
            meshes.last().map_or((1.0, None), |mesh| (mesh.cell_size, mesh.time_step))
        }
        Evidence::State { cell_size, .. } => (*cell_size, None),
        Evidence::Law(_) | Evidence::Tangent(_) => (1.0, None),
    };
    let diagnosed = with_exact(field, Some(parameters), (cell_size, time_step), follow, |exact| {
        let hypotheses = all(exact);
        let unseen = match evidence {
            _ if exact.space.is_none() => None,
            Evidence::Results(_) => None,
            Evidence::State { .. } => Some("accelerations and residuals"),
            Evidence::Law(_) | Evidence::Tangent(_) => Some("tables of a law"),
        };
        if let Some(what) = unseen {
            return Err(Obstacle::Axisymmetric(what));
        }
        match evidence {
            Evidence::Results(meshes) => {
                let step = step::response(exact, meshes, solver.without);
                match step.filter(|_| exact.space.is_none()) {
                    Some(step) => Ok(state::diagnose(exact, &step, &hypotheses)?),
                    None => of_results(exact, meshes, &hypotheses, solver),
                }
            }
            Evidence::State { response, .. } => {
                let response = Response { without: solver.without, ..response.clone() };
                Ok(state::diagnose(exact, &response, &hypotheses)?)
            }
            Evidence::Law(law) => of_law(exact, law, hypotheses),
            Evidence::Tangent(law) => of_tangent(exact, law, hypotheses),
        }
    });
    if follow.is_stopped() { Err(Obstacle::Stopped) } else { diagnosed }
}

fn of_results<const D: usize>(
    exact: &Exact<'_, D>,
    meshes: &[Mesh],
    hypotheses: &[Hypothesis<D>],
    solver: &Solver,
) -> Result<Diagnosis, Obstacle>
where
    f64: Solve<D>,
{
    let snapshots: Vec<&Snapshot> =
        meshes.last().map_or(Vec::new(), |it| it.snapshots.iter().collect());
    if let Some(found) = patterns::zero(exact, &snapshots) {
        return Ok(found);
    }
    let thinned = thinned::<D>(meshes);
    let frame = frame(exact, &thinned)?;
    let found = ordinary::diagnose(exact, &frame, &thinned, hypotheses, solver)?;
    let smooth = found.place.as_ref().map_or(1.0, |it| it.smooth);
    let found = Diagnosis { place: place::of(exact, meshes, smooth), ..found };
    Ok(patterns::or_permutation(exact, &snapshots, found))
}

/// The points of meshes that are compared.
fn thinned<const D: usize>(meshes: &[Mesh]) -> Vec<Mesh> {
    meshes.iter().map(|it| it.thinned::<D>(MOST_POINTS)).collect()
}

/// The quantities, times and functions in which meshes are compared.
fn frame<const D: usize>(
    exact: &Exact<'_, D>,
    meshes: &[Mesh],
) -> Result<ComparisonFrame<D>, Obstacle> {
    let points = meshes.iter().flat_map(|mesh| &mesh.snapshots).map(|it| it.reference.len() / D);
    let points = points.min().unwrap_or(0);
    if points < FEWEST_POINTS {
        return Err(Obstacle::TooFewPoints { found: points, least: FEWEST_POINTS });
    }
    let smooth = Smooth::new(&exact.domain.body, points, DEGREE)?;
    let snapshots: Vec<&Snapshot> =
        meshes.last().map_or(Vec::new(), |it| it.snapshots.iter().collect());
    let frame = ComparisonFrame::new(exact, &snapshots, smooth);
    if frame.times.is_empty() {
        return Err(Obstacle::AtStart);
    }
    Ok(frame)
}

/// X of `count` points of a law: the middle of the body if none are given.
fn places<const D: usize>(
    exact: &Exact<'_, D>,
    reference: &[f64],
    count: usize,
) -> Result<Vec<Vector<f64, D>>, Obstacle> {
    if !reference.is_empty() {
        return Ok(vectors(reference));
    }
    let [lower, upper] = bounding_box(&exact.domain.body)?;
    Ok(vec![(lower + upper) / 2.0; count])
}

fn tensors<const D: usize>(numbers: &[f64]) -> Vec<Matrix<f64, D>> {
    numbers.chunks_exact(D * D).map(Matrix::from_row_slice).collect()
}

fn of_law<const D: usize>(
    exact: &Exact<'_, D>,
    law: &StressData,
    hypotheses: Vec<Hypothesis<D>>,
) -> Result<Diagnosis, Obstacle> {
    let (gradient, stress) = (tensors(&law.gradient), tensors(&law.stress));
    let reference = places(exact, &law.reference, gradient.len())?;
    let table = StressTable {
        reference,
        gradient,
        measure: law.measure,
        stress,
        rounding: law.rounding,
        rounding_of_gradient: law.rounding_of_gradient,
    };
    table::diagnose(exact, &table, hypotheses).ok_or(Obstacle::SingularDeformation)
}

fn of_tangent<const D: usize>(
    exact: &Exact<'_, D>,
    law: &TangentData,
    hypotheses: Vec<Hypothesis<D>>,
) -> Result<Diagnosis, Obstacle> {
    let gradient = tensors(&law.gradient);
    let reference = places(exact, &law.reference, gradient.len())?;
    let (tangent, rounding) = (law.tangent.clone(), law.rounding);
    let table = tangent::TangentTable { reference, gradient, tangent, rounding };
    tangent::diagnose(exact, &table, hypotheses).ok_or(Obstacle::SingularDeformation)
}
