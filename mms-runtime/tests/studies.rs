//! The results of a study beside its orders in space: orders in time, the floor of round-off, the balances of a run, and the
//! time step that is refused.

use crate::common::{AxisAligned, Bar, method};
use mms_runtime::convergence::ExpectedOrder;
use mms_runtime::study::{Balance, Refinement, Run, Series, Snapshots, Solve, Watch, differences};
use mms_runtime::{
    Cause, Division, FormulationName, IntegratorName, ManufacturedField, Method, Setup, ShapeName,
};

const PARTS: usize = 8;

/// A run that is measured at the ends of eight parts.
fn run<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: usize,
) -> Run {
    T::run(field, method, &Division::Uniform(cells), Watch::Parts(PARTS), &mut ()).unwrap()
}

const SECOND: ExpectedOrder = ExpectedOrder::new(2.0, 0.15);

fn total(shape: ShapeName, integrator: IntegratorName) -> Method {
    Method { formulation: FormulationName::Total, ..method(shape, integrator) }
}

/// The differences between runs on 64 cells, each with half the time step of the one before.
fn in_time(method: &Method, levels: u32) -> Series {
    let halved = |level: u32| {
        let (courant, parts) = (0.4 / 2f64.powi(level as i32), PARTS << level);
        Method { setup: Setup { courant, parts, ..method.setup.clone() }, ..method.clone() }
    };
    let runs: Vec<Run> =
        (0..levels).map(|level| run::<f64, 1>(&Bar::default(), &halved(level), 64)).collect();
    differences(&runs.iter().collect::<Vec<_>>())
}

/// At a fixed grid errors hardly change with the time step, for they are errors of space; differences between runs do. Leapfrog
/// is of second order, and integrators that start half a step off are of first.
#[test]
fn differences_show_the_order_in_time() {
    let order = |integrator: IntegratorName| {
        let series = in_time(&total(ShapeName::Linear, integrator), 4);
        series.judge(SECOND).observed_order().unwrap()
    };
    let leapfrog = order(IntegratorName::Leapfrog);
    assert!((leapfrog - 2.0).abs() < 0.05, "{leapfrog}");
    for integrator in [IntegratorName::Usl, IntegratorName::Usf, IntegratorName::Musl] {
        let first = order(integrator);
        assert!((first - 1.0).abs() < 0.05, "{integrator}: {first}");
    }
    let moving = in_time(&method(ShapeName::Cpgimp, IntegratorName::Usl), 4);
    let first = moving.judge(SECOND).observed_order().unwrap();
    assert!((first - 1.0).abs() < 0.05, "{first}");
}

/// The expected failure: positions follow v_i + dt a_i, of which particles keep S a, and S+ S a differs from a by O(h^2). The
/// resulting error is K h^2 dt, which is large if particles cross cells: in time steps far below h^2 leapfrog is of first
/// order.
#[test]
fn the_map_to_the_grid_and_back_leaves_an_error_of_first_order_in_time() {
    let series = in_time(&method(ShapeName::Cpgimp, IntegratorName::Leapfrog), 7);
    let points = series.points();
    let order = |fine: usize| points[fine].orders_from(&points[fine - 1]).l2.unwrap();
    assert!(order(1) > 1.8 && order(5) < 1.0, "{points:?}");
    let share = points[5].errors.unwrap().l2 / points[0].errors.unwrap().l2;
    assert!(share < 0.1, "{share}");
}

/// Runs with other particles, or measured at other times, have no distance.
#[test]
fn only_runs_of_the_same_particles_and_times_are_compared() {
    let method = total(ShapeName::Linear, IntegratorName::Leapfrog);
    let method = Method { setup: Setup { parts: PARTS, ..method.setup }, ..method };
    let snapshots = |cells: usize| run::<f64, 1>(&Bar::default(), &method, cells).snapshots;
    let (own, other) = (snapshots(8), snapshots(16));
    assert_eq!(own.distance(&own).unwrap().linf, 0.0);
    assert_eq!(own.distance(&other), None);
    assert_eq!(Snapshots::default().distance(&own), None);
}

/// The difference of a run in single precision is within a factor of five of the prediction, from 80 steps to 5000, from
/// strains of 2 % to 40 %, in one dimension and in two.
#[test]
fn round_off_is_predicted() {
    fn check<const D: usize>(
        field: &(impl ManufacturedField<f32, D> + ManufacturedField<f64, D>),
        method: &Method,
        cells: &[usize],
    ) where
        f32: Solve<D>,
        f64: Solve<D>,
    {
        for &cells in cells {
            let single = run::<f32, D>(field, method, cells);
            let double = run::<f64, D>(field, method, cells);
            let noise = single.snapshots.distance(&double.snapshots).unwrap().l2;
            let [single, double] = [single, double].map(|run| run.details.unwrap().round_off);
            let factor = noise / single;
            assert!((0.2..5.0).contains(&factor), "{method:?} {cells}: {noise:e} {single:e}");
            let precisions = f64::from(f32::EPSILON) / f64::EPSILON;
            assert!((single / double / precisions - 1.0).abs() < 1e-3);
        }
    }
    let in_parts =
        |method: Method| Method { setup: Setup { parts: PARTS, ..method.setup.clone() }, ..method };
    let lines = [
        method(ShapeName::Cpgimp, IntegratorName::Leapfrog),
        total(ShapeName::QuadraticBspline, IntegratorName::Leapfrog),
    ];
    for amplitude in [0.2, 0.01] {
        let bar = Bar { amplitude, ..Bar::default() };
        for method in &lines {
            check::<1>(&bar, &in_parts(method.clone()), &[16, 64, 256]);
        }
    }
    let square = AxisAligned { amplitude: 0.05, lower: 0.0 };
    check::<2>(&square, &in_parts(total(ShapeName::Linear, IntegratorName::Leapfrog)), &[8, 32]);
}

/// Orders below the floor are not judged.
#[test]
fn a_study_in_single_precision_stops_at_its_floor() {
    let method = total(ShapeName::Linear, IntegratorName::Leapfrog);
    let runs = [128, 256, 512, 1024].map(|cells| {
        let cells = Division::Uniform(cells);
        f32::run(&Bar::default(), &method, &cells, Watch::Displacement, &mut ()).unwrap()
    });
    let points = runs.each_ref().map(|run| Refinement::Both.displacement(run));
    let noise = points.map(|point| point.is_noise());
    assert_eq!(noise, [false, false, false, true], "{points:?}");
    let judged = Series::new(points).judge(SECOND).observed_order().unwrap();
    assert!((judged - 2.0).abs() < 0.06, "{judged}");
}

/// The balance of the bar.
fn balance(method: &Method, cells: usize, end: f64) -> Balance {
    let setup = Setup { end_time: Some(end), ..method.setup.clone() };
    let run = run::<f64, 1>(&Bar::default(), &Method { setup, ..method.clone() }, cells);
    run.details.unwrap().diagnostics.balance.unwrap()
}

/// The wall and the free end of the bar do no work: its energy changes by the work of b, and by the loss of the method, which
/// vanishes as h^2, or as h if velocities are half a step off.
#[test]
fn the_work_of_the_body_force_is_the_change_of_energy() {
    let end = 0.7 * 2.0 / 1e3_f64.sqrt();
    for (method, least) in [
        (method(ShapeName::Cpgimp, IntegratorName::Leapfrog), 1.8),
        (method(ShapeName::Cpdi, IntegratorName::Leapfrog), 1.8),
        (total(ShapeName::Linear, IntegratorName::Leapfrog), 1.8),
        (total(ShapeName::QuadraticBspline, IntegratorName::Leapfrog), 1.8),
        (total(ShapeName::Linear, IntegratorName::Usl), 0.8),
    ] {
        let residual = |cells| {
            let balance = balance(&method, cells, end);
            let residual = balance.energy_residual.unwrap();
            assert!(balance.body_work.abs() > 1e3, "a test without work: {balance:?}");
            (residual / balance.body_work).abs()
        };
        let (coarse, fine) = (residual(32), residual(64));
        let order = (coarse / fine).log2();
        assert!(fine < 0.03 && order > least, "{method:?}: {coarse:e} {fine:e}");
    }
}

/// The force of the wall is -P at X = 0, and no other face constrains the bar.
#[test]
fn the_wall_holds_the_bar_by_its_stress() {
    let bar = Bar::default();
    for method in [
        method(ShapeName::Cpgimp, IntegratorName::Leapfrog),
        total(ShapeName::Linear, IntegratorName::Leapfrog),
        total(ShapeName::Linear, IntegratorName::Usl),
    ] {
        // The forces belong to the beginning of the last step.
        let error = |cells: usize| {
            let end = 1.7 / 1e3_f64.sqrt();
            let balance = balance(&method, cells, end);
            let lag = method.setup.courant / cells as f64 / 1e3_f64.sqrt();
            let time = if balance.time < end { balance.time } else { end - lag };
            let amplitude = bar.amplitude * (1e3_f64.sqrt() * std::f64::consts::PI * time).cos();
            let f = 1.0 + 2.0 * amplitude;
            let stress = bar.young / 2.0 * (f - 1.0 / f);
            (balance.surface_force[0] / -stress - 1.0).abs()
        };
        assert!(error(64) < 0.02, "{method:?}: {}", error(64));
    }
}

/// A material without W has no balance of energy, but all other results.
#[test]
fn without_a_strain_energy_there_is_no_residual() {
    let cube = AxisAligned { amplitude: 0.05, lower: 0.0 };
    let run = run::<f64, 2>(&cube, &method(ShapeName::Cpgimp, IntegratorName::Leapfrog), 8);
    let balance = run.details.unwrap().diagnostics.balance.unwrap();
    assert_eq!((balance.strain_energy, balance.energy_residual), (None, None));
    assert!(balance.body_work != 0.0 && balance.surface_force.len() == 2);
}

/// A wave may cross a cell in the time step: nothing runs, and the message advises a stable step.
#[test]
fn a_time_step_above_the_stable_one_stops_the_run() {
    let bar = Bar::default();
    let sound = 1e3_f64.sqrt();
    let stopped = |courant: f64, fastest_wave: Option<f64>| {
        let setup = Setup { courant, fastest_wave, ..Setup::default() };
        let method = Method { setup, ..Method::default() };
        run::<f64, 1>(&bar, &method, 8).level.errors.err()
    };
    let failure = stopped(0.55, Some(2.0 * sound)).unwrap();
    assert_eq!((failure.step, failure.time, failure.particle), (0, 0.0, Some(0)));
    let Cause::UnstableStep { time_step, stable, courant } = failure.cause else {
        panic!("{failure}")
    };
    assert!(stable < time_step && time_step <= 0.55 / 8.0 / sound, "{failure}");
    assert!((courant - 0.5).abs() < 1e-12 && (stable * 8.0 * sound - 0.5).abs() < 1e-12);
    for part in ["stable one", "Courant number of 0.5;", "--allow-unstable"] {
        assert!(failure.to_string().contains(part), "{failure}");
    }
    assert_eq!(stopped(0.5, Some(2.0 * sound)), None);
    assert_eq!(stopped(0.55, None), None);
    assert!(stopped(0.5, Some(f64::INFINITY)).is_some());
}
