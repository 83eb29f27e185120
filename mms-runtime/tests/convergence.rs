//! Observed orders on the 1D bar, with the theory that expects them.

use crate::common::{Bar, levels, method};
use mms_runtime::convergence::{ExpectedOrder, TOLERANCE, Verdict};
use mms_runtime::study::{StudyLevel, judge, orders};
use mms_runtime::{Errors, FormulationName, IntegratorName, Method, ShapeName};

const CELLS: [usize; 5] = [8, 16, 32, 64, 128];

fn study(shape: ShapeName, integrator: IntegratorName, courant: f64) -> Vec<StudyLevel> {
    let mut method = method(shape, integrator);
    method.setup.courant = courant;
    levels::<f64, 1>(&Bar::default(), &method, &CELLS)
}

fn errors(level: &StudyLevel) -> Errors {
    level.errors.clone().unwrap_or_else(|failure| panic!("{failure}"))
}

fn finest_orders(levels: &[StudyLevel]) -> [f64; 2] {
    let [.., coarse, fine] = levels else { panic!("two levels at least") };
    let orders = orders(coarse, fine);
    [orders.l2.unwrap(), orders.linf.unwrap()]
}

fn verdict(levels: &[StudyLevel]) -> Verdict {
    let judgement = judge(levels, ExpectedOrder::new(2.0, TOLERANCE));
    println!("{}", judgement.sentences("h", &|h| format!("h {h}")).join("\n"));
    judgement.verdict()
}

/// Aligned contiguous particles are of order 2 in space, leapfrog in time.
#[test]
fn contiguous_particles_and_leapfrog_are_of_second_order() {
    let levels = study(ShapeName::Cpgimp, IntegratorName::Leapfrog, 0.4);
    let steps: Vec<usize> = levels.iter().map(|level| level.steps).collect();
    assert_eq!(steps, CELLS.map(|cells| 5 * cells)); // 2L/c over 0.4 h/c
    let orders = finest_orders(&levels);
    assert!(orders.iter().all(|&order| order >= 1.9), "{orders:?}");
    assert_eq!(verdict(&levels), Verdict::Pass);
}

/// Three digits of an independent prototype of the same method.
#[test]
fn figures_of_an_independent_prototype() {
    let levels = study(ShapeName::Cpgimp, IntegratorName::Leapfrog, 0.27);
    for (level, figure) in levels.iter().zip([1.56e-2, 4.07e-3, 1.03e-3, 2.57e-4, 6.52e-5]) {
        let linf = errors(level).linf;
        assert!((linf / figure - 1.0).abs() < 5e-3, "{linf:e}, not {figure:e}");
    }
}

/// If the first kick is not half a step, velocities are half a step early or late: an error of dt a/2.
#[test]
fn integrators_without_the_half_step_are_of_first_order() {
    for integrator in [IntegratorName::Usl, IntegratorName::Usf, IntegratorName::Musl] {
        let levels = study(ShapeName::Cpgimp, integrator, 0.27);
        let orders = finest_orders(&levels);
        assert!(orders.iter().all(|order| (0.85..1.1).contains(order)), "{integrator}: {orders:?}");
        assert_eq!(verdict(&levels), Verdict::Fail, "{integrator}");
    }
}

/// A force of the wrong time level costs an order for all shape functions and formulations.
#[test]
fn a_body_force_one_step_late_is_of_first_order() {
    for (shape, formulation) in [
        (ShapeName::Cpgimp, FormulationName::Updated),
        (ShapeName::Linear, FormulationName::Total),
        (ShapeName::QuadraticBspline, FormulationName::Total),
    ] {
        let method = Method { formulation, ..method(shape, IntegratorName::Leapfrog) };
        let level = |&cells: &usize| {
            let step = method.setup.courant / cells as f64 / 1e3_f64.sqrt();
            levels::<f64, 1>(&Bar { delay: step, ..Bar::default() }, &method, &[cells]).remove(0)
        };
        let levels: Vec<StudyLevel> = CELLS.iter().map(level).collect();
        let orders = finest_orders(&levels);
        assert!(orders.iter().all(|order| (0.85..1.15).contains(order)), "{shape}: {orders:?}");
        assert_eq!(verdict(&levels), Verdict::Fail, "{shape}");
    }
}

/// Linear weights suffer from cell crossing, fixed domains from gaps and overlaps.
#[test]
fn linear_and_fixed_domains_fail() {
    for shape in [ShapeName::Linear, ShapeName::Ugimp] {
        let levels = study(shape, IntegratorName::Leapfrog, 0.4);
        assert_eq!(verdict(&levels), Verdict::Fail, "{shape}");
    }
}

/// The body force as printed on the slides, - (E/rho0) (1 + F^-2) A/L^2, drives another motion.
#[test]
fn the_printed_sign_of_the_body_force_fails() {
    let bar = Bar { sign: -1.0, ..Bar::default() };
    let levels = levels::<f64, 1>(&bar, &Method::default(), &CELLS[..4]);
    assert_eq!(verdict(&levels), Verdict::Fail);
    let converges =
        |level: &StudyLevel| level.errors.as_ref().is_ok_and(|errors| errors.linf < 0.1);
    assert!(!levels.iter().any(converges), "{levels:?}");
}

/// Young's modulus only scales the time.
#[test]
fn stiffness_changes_neither_steps_nor_errors() {
    let study = |young: f64| {
        let bar = Bar { young, ..Bar::default() };
        levels::<f64, 1>(&bar, &Method::default(), &[16, 64])
    };
    let reference = study(1e6);
    for young in [1.0, 1e12] {
        for (level, same) in study(young).iter().zip(&reference) {
            assert_eq!(level.steps, same.steps);
            let (a, b) = (errors(level), errors(same));
            for (a, b) in [(a.l1, b.l1), (a.l2, b.l2), (a.linf, b.linf)] {
                assert!((a / b - 1.0).abs() < 1e-10, "young {young:e}: {a:e} and {b:e}");
            }
        }
    }
}

/// Single precision follows double precision down to its round-off, and does not rise again.
#[test]
fn single_precision_reaches_its_floor() {
    let double = levels::<f64, 1>(&Bar::default(), &Method::default(), &CELLS);
    let single = levels::<f32, 1>(&Bar::default(), &Method::default(), &CELLS);
    for (single, double) in single.iter().zip(&double) {
        assert_eq!(single.steps, double.steps);
        let (single, double) = (errors(single), errors(double));
        println!("{single:?} {double:?}");
        let floor = 40.0 * f64::from(f32::EPSILON);
        assert!((single.linf - double.linf).abs() < floor, "{single:?} {double:?}");
    }
}

/// Rigid motion and deformation with faces that follow the field, through the grid.
#[test]
fn a_sliding_bar_with_prescribed_faces_is_of_second_order() {
    use mms_runtime::{Condition, Face};
    for faces in [vec![], vec![(Face::Max(0), Condition::Free)]] {
        let bar = Bar { slide: 0.3, faces, ..Bar::default() };
        let levels = levels::<f64, 1>(&bar, &Method::default(), &CELLS);
        println!("{:?}", levels.iter().map(|level| errors(level).linf).collect::<Vec<_>>());
        // On coarser levels orders still increase, from 1.9.
        assert_eq!(verdict(&levels[2..]), Verdict::Pass, "{:?}", finest_orders(&levels));
    }
}

/// A wall at rest and the field's own motion there give the same run, as long as nothing passes the wall.
#[test]
fn a_prescribed_face_at_rest_is_a_fixed_one() {
    use mms_runtime::{Condition, Face};
    let fixed = Bar::default();
    let prescribed = Bar { faces: vec![(Face::Max(0), Condition::Free)], ..Bar::default() };
    let study = |bar: &Bar| levels::<f64, 1>(bar, &Method::default(), &[16, 32]);
    for (a, b) in study(&fixed).iter().zip(&study(&prescribed)) {
        assert!((errors(a).linf / errors(b).linf - 1.0).abs() < 1e-9);
    }
}
