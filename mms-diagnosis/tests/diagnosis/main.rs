//! Mistakes typed by hand, in results of a solver, in accelerations at an exact state, and in a law.

mod evidence;
mod excluded;
mod field;
mod given;
mod nodal;
mod order;
#[path = "../../../tests/support/sampled.rs"]
mod sampled;
mod statics;
mod tangent;

use field::{DENSITY, FREQUENCY, LAMBDA, MU, Square};
use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding, Limits, Ranked, Rung};
use mms_diagnosis::changed::Without;
use mms_diagnosis::closed_form::{self, ClosedForm};
use mms_diagnosis::evidence::{ComparisonFrame, DEGREE, Mesh, Snapshot};
use mms_diagnosis::exact::{Exact, Quantity};
use mms_diagnosis::hypothesis::all;
use mms_diagnosis::smooth::Smooth;
use mms_diagnosis::solver::Solver;
use mms_diagnosis::state::{self, Computed, Response};
use mms_diagnosis::table::{self, Measure, StressTable};
use mms_diagnosis::{ordinary, patterns, step};
use mms_runtime::study::{Frame as State, Observer, Solve as _, Watch};
use mms_runtime::{
    Division, Domain, Face, FormulationName, ManufacturedField, Material, Matrix, Method, Setup,
    ShapeName, Vector,
};

use sampled::sampled;

type Point = Vector<f64, 2>;
type Tensor = Matrix<f64, 2>;

/// The name of the mistake if one is named, otherwise the finding.
fn name(diagnosis: &Diagnosis) -> &'static str {
    match diagnosis.finding {
        DiagnosisFinding::Named => diagnosis.ranked[0].name,
        other => other.name(),
    }
}

/// The square with a load, and without one.
const LOADED: Square = Square { is_loaded: true };
const HELD: Square = Square { is_loaded: false };

fn exact(field: &'static Square, cells: f64) -> Exact<'static, 2> {
    Exact::new(field, 1.0 / cells, 0.4 / cells / ((LAMBDA + 2.0 * MU) / DENSITY).sqrt())
}

/// Points in the middle of cells, none on the loaded face.
fn points(count: usize) -> Vec<Point> {
    let middle = |k: usize| (k as f64 + 0.5) / count as f64;
    (0..count * count).map(|k| Point::new(middle(k % count), middle(k / count))).collect()
}

#[test]
fn the_law_and_its_moduli_are_recognised() {
    let exact = exact(&LOADED, 20.0);
    assert_eq!(exact.law.map(|law| law.name), Some("neo_hookean"));
    let [lambda, mu] = exact.uniform_moduli().unwrap();
    assert!((lambda / LAMBDA - 1.0).abs() < 1e-9 && (mu / MU - 1.0).abs() < 1e-9);
}

/// Diagnoses a law that gives these stresses as P.
fn of_law(stress: impl Fn(&Tensor) -> Tensor) -> Diagnosis {
    let exact = exact(&LOADED, 20.0);
    let gradient: Vec<Tensor> = points(5).iter().map(|x| field::gradient(0.0, x) * 3.0).collect();
    let stress: Vec<Tensor> = gradient.iter().map(stress).collect();
    let reference = points(5);
    let table = StressTable {
        reference,
        gradient,
        measure: Measure::FirstPiola,
        stress,
        rounding: 0.0,
        rounding_of_gradient: 0.0,
    };
    table::diagnose(&exact, &table, all(&exact)).unwrap()
}

#[test]
fn a_law_is_named_to_round_off() {
    let f = |h: &Tensor| h + Tensor::identity();
    let right = |h: &Tensor| field::first(h, [LAMBDA, MU]);
    let ln = std::f64::consts::LN_10;
    assert_eq!(name(&of_law(right)), "nothing");
    assert_eq!(name(&of_law(|h| right(h).transpose())), "stress_transposed");
    assert_eq!(name(&of_law(|h| f(h).try_inverse().unwrap() * right(h))), "stress_second_piola");
    assert_eq!(name(&of_law(|h| right(h) * f(h).transpose())), "stress_kirchhoff");
    assert_eq!(name(&of_law(|h| right(h) / f(h).determinant())), "stress_volume");
    assert_eq!(name(&of_law(|h| field::first(h, [MU, LAMBDA]))), "moduli_swapped");
    assert_eq!(name(&of_law(|h| field::first(h, [0.0, MU]))), "lambda_missing");
    assert_eq!(name(&of_law(|h| field::first(h, [LAMBDA + 2.0 / 3.0 * MU, MU]))), "lambda_bulk");
    let nu = LAMBDA / (2.0 * (LAMBDA + MU));
    let young = 2.0 * MU * (1.0 + nu);
    let without = young * nu / (1.0 - 2.0 * nu);
    assert_eq!(name(&of_law(|h| field::first(h, [without, MU]))), "lambda_conversion");
    let without = young / ((1.0 + nu) * (1.0 - 2.0 * nu));
    assert_eq!(name(&of_law(|h| field::first(h, [without, MU]))), "lambda_conversion");
    assert_eq!(name(&of_law(|h| field::first(h, [LAMBDA, young / 2.0]))), "mu_conversion");
    assert_eq!(name(&of_law(|h| right(h) * 1e-6)), "units");
    let logarithm = of_law(|h| field::first(h, [LAMBDA / ln, MU]));
    assert_eq!(name(&logarithm), "lambda_factor");
    assert!((logarithm.ranked[0].factor[0] * ln - 1.0).abs() < 1e-6);
    // mu (F - F^-T) + lambda (J - 1) J F^-T.
    let quadratic = of_law(|h| {
        let j = f(h).determinant();
        field::first(h, [0.0, MU])
            + f(h).try_inverse().unwrap().transpose() * (LAMBDA * (j - 1.0) * j)
    });
    assert_eq!(name(&quadratic), "material");
    assert_eq!(quadratic.ranked[0].which.as_deref(), Some("neo_hookean_quadratic"));
    // An addition that no hypothesis covers.
    assert_eq!(name(&of_law(|h| right(h) + h * h * 100.0)), "unexplained");
}

/// Diagnoses a closed form of b with these values.
fn of_form(force: impl Fn(f64, &Point) -> Point) -> Option<&'static str> {
    let exact = exact(&LOADED, 20.0);
    let values = |time: f64, x: &[f64]| {
        let points = x.chunks(2).map(Point::from_column_slice);
        points.flat_map(|x| force(time, &x).as_slice().to_vec()).collect()
    };
    let found = closed_form::diagnose(&exact, ClosedForm::BodyForce, &values, all(&exact));
    found.map(|it| it.name)
}

#[test]
fn a_closed_form_of_b_is_named() {
    let a = field::acceleration;
    let b = field::body_force;
    let with = |time: f64, x: &Point, moduli: [f64; 2]| {
        a(time, x) - field::divergence(time, x, |h| field::first(h, moduli)) / DENSITY
    };
    assert_eq!(of_form(b), None);
    assert_eq!(of_form(|t, x| a(t, x) * 2.0 - b(t, x)), Some("force_sign"));
    assert_eq!(of_form(|t, x| b(t, x) - a(t, x)), Some("inertia_missing"));
    assert_eq!(of_form(|t, x| -b(t, x)), Some("force_reversed"));
    assert_eq!(of_form(|t, x| with(t, x, [MU, LAMBDA])), Some("moduli_swapped"));
    assert_eq!(of_form(|t, x| with(t, x, [LAMBDA + 2.0 / 3.0 * MU, MU])), Some("lambda_bulk"));
    let transposed = |h: &Tensor| field::first(h, [LAMBDA, MU]).transpose();
    let wrong = |t: f64, x: &Point| a(t, x) - field::divergence(t, x, transposed) / DENSITY;
    assert_eq!(of_form(wrong), Some("stress_transposed"));
    let v = field::velocity;
    let local = |t: f64, x: &Point| a(t, x).abs().component_mul(&v(t, x).map(f64::signum)) * 0.1;
    assert_eq!(of_form(|t, x| b(t, x) - local(t, x)), Some("damping_local"));
    let coriolis = |t: f64, x: &Point| Point::new(v(t, x)[1], -v(t, x)[0]) * (2.0 * 3.0);
    assert_eq!(of_form(|t, x| b(t, x) + coriolis(t, x)), Some("coriolis"));
    let centrifugal = |t: f64, x: &Point| (x + field::displacement(t, x)) * 9.0;
    assert_eq!(of_form(|t, x| b(t, x) + centrifugal(t, x)), Some("centrifugal"));
    let with = |t: f64, x: &Point, stress: fn(f64, &Tensor) -> Tensor| {
        b(t, x) - field::divergence(t, x, |h| stress(t, h)) / DENSITY
    };
    assert_eq!(of_form(|t, x| with(t, x, viscous)), Some("viscosity"));
    assert_eq!(of_form(|t, x| with(t, x, shocked)), Some("artificial_viscosity"));
    // An addition that no hypothesis covers.
    assert_eq!(of_form(|t, x| b(t, x) + Point::new(x[0] * x[1], t)), None);
}

/// Diagnoses these accelerations at the exact state.
fn of_accelerations(acceleration: impl Fn(&Point) -> Point) -> Diagnosis {
    let exact = exact(&HELD, 24.0);
    let (time, points) = (0.013, points(24));
    let values = points.iter().flat_map(|x| acceleration(x).as_slice().to_vec()).collect();
    let reference = points.iter().flat_map(|x| x.as_slice().to_vec()).collect();
    let computed = Computed::Acceleration;
    let without = Without::default();
    let response = Response {
        computed,
        time,
        reference,
        values,
        volumes: None,
        degree: None,
        without,
        step: None,
    };
    state::diagnose(&exact, &response, &all(&exact)).unwrap()
}

#[test]
fn accelerations_at_an_exact_state_name_a_term() {
    let time = 0.013;
    let a = |x: &Point| field::acceleration(time, x);
    let b = |x: &Point| field::body_force(time, x);
    assert_eq!(name(&of_accelerations(a)), "nothing");
    assert_eq!(name(&of_accelerations(|x| a(x) - b(x))), "force_missing");
    assert_eq!(name(&of_accelerations(|x| a(x) + b(x))), "force_twice");
    // With b per mass and no load, b = a + Div P/rho0 is the stress times 3 on any field.
    let sign = of_accelerations(|x| a(x) * 3.0 - b(x) * 2.0);
    let names = [&[name(&sign).to_owned()], sign.ranked[0].equivalent_always.as_slice()].concat();
    assert!(
        ["force_sign", "moduli_factor", "density_factor"]
            .iter()
            .all(|it| names.iter().any(|n| n == it)),
        "{names:?}"
    );
    assert_eq!(name(&of_accelerations(|x| a(x) - Point::new(0.0, 9.81 * 20.0))), "constant_force");
    let half = of_accelerations(|x| a(x) / 0.5);
    assert_eq!(name(&half), "mass_factor");
    assert!((half.ranked[0].factor[0] / 0.5 - 1.0).abs() < 1e-2);
    let transposed = |x: &Point| {
        b(x) + field::divergence(time, x, |h| field::first(h, [LAMBDA, MU]).transpose()) / DENSITY
    };
    assert_eq!(name(&of_accelerations(transposed)), "stress_transposed");
    let swapped =
        |x: &Point| b(x) + field::divergence(time, x, |h| field::first(h, [MU, LAMBDA])) / DENSITY;
    assert_eq!(name(&of_accelerations(swapped)), "moduli_swapped");
    let v = |x: &Point| field::velocity(time, x);
    // All points of this field turn back at the same time: at one state a part of |a| is a part of v.
    let local = |x: &Point| a(x) - a(x).abs().component_mul(&v(x).map(f64::signum)) * 0.2;
    let local = of_accelerations(local);
    let names = [&[name(&local).to_owned()], local.ranked[0].equivalent_here.as_slice()].concat();
    for expected in ["damping", "damping_local"] {
        assert!(names.iter().any(|it| it == expected), "{names:?}");
    }
    let viscous = |x: &Point| a(x) + field::divergence(time, x, |h| viscous(time, h)) / DENSITY;
    let viscous = of_accelerations(viscous);
    assert_eq!(name(&viscous), "viscosity");
    assert!((viscous.ranked[0].factor[0] / ETA - 1.0).abs() < 0.01, "{viscous:?}");
    // Scatter from point to point is no mistake of a term.
    let noise = |x: &Point| a(x) + Point::new((1e4 * x[0] * x[1]).sin(), (9e3 * x[0]).cos()) * 5.0;
    assert_ne!(of_accelerations(noise).finding, DiagnosisFinding::Named);
}

const ETA: f64 = 1.5;

/// grad v, for a field whose H is proportional to cos(FREQUENCY t).
fn velocity_gradient(time: f64, h: &Tensor) -> Tensor {
    let rate = h * (-FREQUENCY * (FREQUENCY * time).tan());
    rate * (h + Tensor::identity()).try_inverse().unwrap()
}

/// 2 eta D F^-T.
fn viscous(time: f64, h: &Tensor) -> Tensor {
    let rate = velocity_gradient(time, h);
    (rate + rate.transpose()) * ETA * (h + Tensor::identity()).try_inverse().unwrap().transpose()
}

/// -q J F^-T with q = 3 rho h c0 |div v| where the body is compressed, for 12 cells; for 24 cells the factor is 6.
fn shocked(time: f64, h: &Tensor) -> Tensor {
    let speed = ((LAMBDA + 2.0 * MU) / DENSITY).sqrt();
    let change = velocity_gradient(time, h).trace().min(0.0);
    let back = (h + Tensor::identity()).try_inverse().unwrap().transpose();
    back * (3.0 * DENSITY / 12.0 * speed * change)
}

/// Diagnoses these velocities after one step.
fn of_step(velocity: impl Fn(&Point) -> Point) -> Diagnosis {
    let exact = exact(&HELD, 24.0);
    let points = points(24);
    let values = points.iter().flat_map(|x| velocity(x).as_slice().to_vec()).collect();
    let reference = points.iter().flat_map(|x| x.as_slice().to_vec()).collect();
    let snapshot = Snapshot {
        time: STEP,
        reference,
        values: vec![(Quantity::Velocity, values)],
        ..Snapshot::default()
    };
    let mesh = Mesh { cell_size: 1.0 / 24.0, time_step: None, snapshots: vec![snapshot] };
    let response = step::response(&exact, &[mesh], Without::default()).unwrap();
    state::diagnose(&exact, &response, &all(&exact)).unwrap()
}

/// The step after which velocities are looked at.
const STEP: f64 = 5e-4;

#[test]
fn velocities_after_one_step_name_a_term() {
    let v = |x: &Point| field::velocity(0.0, x);
    let a = |x: &Point| field::acceleration(0.0, x);
    let b = |x: &Point| field::body_force(0.0, x);
    let right = of_step(|x| v(x) + a(x) * STEP);
    assert_eq!((name(&right), right.rung), ("nothing", Rung::Step));
    assert_eq!(name(&of_step(|x| v(x) + (a(x) - b(x)) * STEP)), "force_missing");
    assert_eq!(name(&of_step(|x| v(x) + (a(x) * 3.0 - b(x) * 2.0) * STEP)), "force_sign");
    assert_eq!(name(&of_step(|x| v(x) + a(x) * (STEP / 2.0))), "initial_acceleration_missing");
}

#[test]
fn results_after_many_steps_are_none_of_one() {
    let exact = exact(&HELD, 24.0);
    let at = |time: f64| Snapshot {
        time,
        reference: vec![0.5, 0.5],
        values: vec![(Quantity::Velocity, vec![0.0, 0.0])],
        ..Snapshot::default()
    };
    let of = |snapshots| Mesh { cell_size: 1.0 / 24.0, time_step: None, snapshots };
    let response = |mesh| step::response(&exact, &[mesh], Without::default());
    assert!(response(of(vec![at(STEP)])).is_some());
    assert!(response(of(vec![at(0.01)])).is_none());
    assert!(response(of(vec![at(STEP), at(2.0 * STEP)])).is_none());
}

/// The square with mistakes, for the solver.
struct Mistaken {
    moduli: [f64; 2],
    force: fn(f64, &Point) -> Point,
    /// The delay of the motion of walls.
    delay: f64,
    /// The factor of tractions.
    load: f64,
}

impl Mistaken {
    /// The time to which walls have moved; the start is right.
    fn late(&self, time: f64) -> f64 {
        if time > 0.0 { time - self.delay } else { time }
    }
}

impl Material<f64, 2> for Mistaken {
    fn density(&self, x: &[Point], density: &mut [f64]) {
        LOADED.density(x, density);
    }

    fn wave_speed(&self, x: &[Point], speed: &mut [f64]) {
        LOADED.wave_speed(x, speed);
    }

    fn kirchhoff_stress(&self, _: f64, _: &[Point], h: &[Tensor], stress: &mut [Tensor]) {
        for (h, stress) in h.iter().zip(stress) {
            *stress = field::first(h, self.moduli) * (h + Tensor::identity()).transpose();
        }
    }
}

impl ManufacturedField<f64, 2> for Mistaken {
    fn domain(&self) -> Domain<f64, 2> {
        LOADED.domain()
    }

    fn displacement(&self, time: f64, x: &[Point], out: &mut [Point]) {
        LOADED.displacement(time, x, out);
    }

    fn velocity(&self, time: f64, x: &[Point], out: &mut [Point]) {
        LOADED.velocity(self.late(time), x, out);
    }

    fn acceleration(&self, time: f64, x: &[Point], out: &mut [Point]) {
        LOADED.acceleration(self.late(time), x, out);
    }

    fn body_force(&self, time: f64, x: &[Point], out: &mut [Point]) {
        x.iter().zip(out).for_each(|(x, out)| *out = (self.force)(time, x));
    }

    fn displacement_gradient(&self, time: f64, x: &[Point], out: &mut [Tensor]) {
        LOADED.displacement_gradient(time, x, out);
    }

    fn surface_stress(&self, time: f64, x: &[Point], h: &[Tensor], stress: &mut [Tensor]) {
        LOADED.surface_stress(time, x, h, stress);
        stress.iter_mut().for_each(|stress| *stress *= self.load);
    }
}

/// The last state of a run.
#[derive(Default)]
struct Last(Option<State>);

impl Observer for Last {
    fn step(&mut self, _: usize, _: usize) {}

    fn wants(&self, step: usize, steps: usize) -> bool {
        step == steps
    }

    fn see(&mut self, state: &State) -> Result<(), String> {
        self.0 = Some(state.clone());
        Ok(())
    }
}

/// The last state of a run with cubic splines, which no method of the diagnosis uses.
fn solved(mistaken: &Mistaken) -> State {
    let setup = Setup { end_time: Some(0.03), ..Setup::default() };
    let (shape, formulation) = (ShapeName::CubicBspline, FormulationName::Total);
    let method = Method { shape, formulation, setup, ..Method::default() };
    let cells = Division::Uniform(12);
    let mut last = Last::default();
    let field: &dyn ManufacturedField<f64, 2> = mistaken;
    let run = f64::run(field, &method, &cells, Watch::Displacement, &mut last).unwrap();
    assert!(run.level.errors.is_ok());
    last.0.unwrap()
}

/// Diagnoses the displacement of a run with mistakes.
fn of_solver(mistaken: &Mistaken) -> Diagnosis {
    let state = solved(mistaken);
    let pairs = state.position.iter().zip(&state.displacement);
    let reference: Vec<f64> = pairs.map(|(x, u)| x - u).collect();
    let values = vec![(Quantity::Displacement, state.displacement.clone())];
    let snapshots = vec![Snapshot { time: state.time, reference, values, ..Snapshot::default() }];
    said(&[Mesh { cell_size: 1.0 / 12.0, time_step: None, snapshots }])
}

#[test]
fn a_mistake_in_a_solver_is_named() {
    let right = Mistaken { moduli: [LAMBDA, MU], force: field::body_force, delay: 0.0, load: 1.0 };
    let found = of_solver(&right);
    assert_eq!(name(&found), "nothing");
    let swapped = Mistaken { moduli: [MU, LAMBDA], ..right };
    let late = Mistaken { force: |time, x| field::body_force(time - 6e-3, x), ..right };
    let sign = Mistaken {
        force: |time, x| field::acceleration(time, x) * 2.0 - field::body_force(time, x),
        ..right
    };
    let mistakes = [("moduli_swapped", swapped), ("force_late", late), ("force_sign", sign)];
    for (expected, mistaken) in sampled(mistakes, 2) {
        let found = of_solver(&mistaken);
        assert_eq!(name(&found), expected);
        let factor = found.ranked[0].factor[0];
        assert!(expected != "force_late" || (factor / 6e-3 - 1.0).abs() < 0.05, "{factor}");
    }
    // With twice the mass and right forces, all accelerations are half as large.
    let heavy = Mistaken {
        moduli: [LAMBDA / 2.0, MU / 2.0],
        force: |time, x| field::body_force(time, x) / 2.0,
        load: 0.5,
        ..right
    };
    // One mesh is too coarse for a name.
    let best = &of_solver(&heavy).ranked[0];
    assert_eq!(best.name, "mass_factor");
    assert!((best.factor[0] / 2.0 - 1.0).abs() < 0.02 && best.is_plausible, "{best:?}");
}

/// A mass that is 10 % too large acts like some missing inertia: the same error, at an impossible size.
#[test]
fn what_acts_as_the_first_does_not_hold_its_name_back() {
    let all = of_accelerations(|x| field::acceleration(0.013, x) / 1.1).ranked;
    let limits = Limits { excess: [0.0; 2], left: [0.35, 0.15], nearer: [1.3, 0.95] };
    let found = |acts_as_first: bool| {
        let first = Ranked { explained: 0.979, is_plausible: true, ..all[0].clone() };
        let other =
            Ranked { explained: 0.981, is_plausible: false, acts_as_first, ..first.clone() };
        limits.finding(&[first, other], 10.0)
    };
    assert_eq!(
        (found(false), found(true)),
        (DiagnosisFinding::Unexplained, DiagnosisFinding::Named)
    );
    let other = |name: &str| all.iter().find(|it| it.name == name).expect("a hypothesis");
    let [same, another] = ["inertia_missing", "constant_force"].map(other);
    assert_eq!(all[0].name, "mass_factor");
    assert!(same.acts_as_first && !same.is_plausible && !another.acts_as_first);
}

/// Walls that start late make a front, in which methods have errors of their own: too large for a name on one mesh.
#[test]
fn walls_that_are_late_explain_most() {
    let late = Mistaken { moduli: [LAMBDA, MU], force: field::body_force, delay: 4e-3, load: 1.0 };
    let best = &of_solver(&late).ranked[0];
    assert_eq!(best.name, "wall_late");
    assert!(best.explained > 0.95 && best.is_plausible, "{best:?}");
    assert!((best.factor[0] / 4e-3 - 1.0).abs() < 0.05, "{best:?}");
}

/// Diagnoses results of meshes.
fn said(meshes: &[Mesh]) -> Diagnosis {
    let exact = exact(&LOADED, 12.0);
    let snapshots: Vec<&Snapshot> = meshes[0].snapshots.iter().collect();
    if let Some(found) = patterns::zero(&exact, &snapshots) {
        return found;
    }
    let frame = ComparisonFrame::new(
        &exact,
        &snapshots,
        Smooth::new(&exact.domain.body, 576, DEGREE).unwrap(),
    );
    let found =
        ordinary::diagnose(&exact, &frame, meshes, &all(&exact), &Solver::default()).unwrap();
    patterns::or_permutation(&exact, &snapshots, found)
}

/// u as a function of t and X.
type Motion = fn(f64, &Point) -> Point;

/// Diagnoses results with this displacement.
fn of_results(displacement: impl Fn(f64, &Point) -> Point) -> Diagnosis {
    let points = points(24);
    let snapshot = |time: f64| {
        let u = points.iter().flat_map(|x| displacement(time, x).as_slice().to_vec()).collect();
        let reference = points.iter().flat_map(|x| x.as_slice().to_vec()).collect();
        Snapshot {
            time,
            reference,
            values: vec![(Quantity::Displacement, u)],
            ..Snapshot::default()
        }
    };
    said(&[Mesh {
        cell_size: 1.0 / 12.0,
        time_step: None,
        snapshots: vec![snapshot(0.015), snapshot(0.03)],
    }])
}

#[test]
fn what_is_written_wrongly_is_named() {
    let u = field::displacement;
    assert_eq!(name(&of_results(u)), "nothing");
    let mistakes: [(&str, Motion); 4] = [
        ("components_swapped", |t, x| {
            let u = field::displacement(t, x);
            Point::new(u[1], u[0])
        }),
        ("units", |t, x| field::displacement(t, x) * 1000.0),
        ("output_zero", |_, _| Point::zeros()),
        ("points_permuted", |t, x| field::displacement(t, &Point::new(x[1], x[0]))),
    ];
    for (expected, displacement) in sampled(mistakes, 2) {
        assert_eq!(name(&of_results(displacement)), expected);
    }
    let offset = of_results(|t, x| u(t, &(x + Point::new(1.0 / 24.0, 1.0 / 24.0))));
    assert_eq!(name(&offset), "points_offset");
    assert!((offset.ranked[0].factor[0] * 24.0 - 1.0).abs() < 0.1, "{:?}", offset.ranked[0].factor);
    // An error beside a face, and one beside a plane that is no face.
    let bump = |from: f64| {
        move |x: &Point| Point::new(0.02 * (-((x[0] - from) * 30.0).powi(2)).exp(), 0.0)
    };
    let beside = of_results(|t, x| u(t, x) + bump(1.0)(x)).place.unwrap();
    assert_eq!((beside.face, beside.plane), (Some(Face::Max(0)), None));
    let across = of_results(|t, x| u(t, x) + bump(0.4)(x)).place.unwrap();
    let (axis, at) = across.plane.unwrap();
    assert!(across.face.is_none() && axis == 0 && (at - 0.4).abs() < 0.01, "{across:?}");
}

#[test]
fn velocities_of_half_a_step_earlier_are_no_mistake() {
    let (points, before) = (points(24), exact(&LOADED, 12.0).time_step / 2.0);
    let numbers = |of: &dyn Fn(&Point) -> Point| -> Vec<f64> {
        points.iter().flat_map(|x| of(x).as_slice().to_vec()).collect()
    };
    let snapshot = |time: f64| Snapshot {
        time,
        reference: numbers(&|x| *x),
        values: vec![
            (Quantity::Displacement, numbers(&|x| field::displacement(time, x))),
            (Quantity::Velocity, numbers(&|x| field::velocity(time - before, x))),
        ],
        ..Snapshot::default()
    };
    let snapshots = vec![snapshot(0.015), snapshot(0.03)];
    let found = said(&[Mesh { cell_size: 1.0 / 12.0, time_step: None, snapshots }]);
    // Half a step of velocity is an error of some percent.
    assert!(found.error > 0.01, "{}", found.error);
    assert_eq!(name(&found), "nothing");
}
