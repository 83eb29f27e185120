//! Properties that every time integrator has, with every shape function, in one to three dimensions.

mod common;

use common::{Affine, Bar, levels, method};
use mms_runtime::integrator::{Integrator, IntegratorVisitor};
use mms_runtime::shape::{Cpgimp, Shape};
use mms_runtime::study::observed_order;
use mms_runtime::{
    Condition, Face, IntegratorName, ManufacturedField, Real, Resolution, ShapeName, Solver,
};

const RESOLUTION: Resolution = Resolution { cells: 8, particles_per_cell: 2, courant: 0.4 };

fn free_flight<T: Real, const D: usize>(cells: usize) {
    let field = Affine::flight([0.7, -0.4, 0.3]);
    for &shape in ShapeName::ALL {
        for &integrator in IntegratorName::ALL {
            let level = &levels::<T, D>(&field, &method(shape, integrator), &[cells])[0];
            let linf = level.errors.as_ref().unwrap().linf;
            let round_off = 20.0 * level.steps as f64 * T::default_epsilon().to_f64();
            assert!(linf < round_off, "{shape} {integrator}: {linf:e}");
        }
    }
}

#[test]
fn free_flight_is_exact() {
    free_flight::<f64, 1>(8);
    free_flight::<f32, 1>(8);
    free_flight::<f64, 2>(4);
    free_flight::<f32, 2>(4);
    free_flight::<f64, 3>(2);
    free_flight::<f32, 3>(2);
}

/// Without walls d/dt sum m v = sum m b: internal forces add up to nothing. Any first step may be a half.
struct MomentumBalance;

impl IntegratorVisitor for MomentumBalance {
    type Output = ();

    fn visit<I: Integrator>(self) {
        let faces = vec![(Face::Min(0), Condition::Free), (Face::Max(0), Condition::Free)];
        let bar = Bar { faces, ..Bar::default() };
        let field: &dyn ManufacturedField<f64, 1> = &bar;
        let mut solver = Solver::<f64, 1, _, Cpgimp>::new(field, &RESOLUTION).unwrap();
        solver.step::<I>().unwrap();
        for _ in 0..5 {
            let before = momentum(&solver);
            solver.step::<I>().unwrap();
            let particles = solver.particles();
            let force: f64 =
                particles.mass.iter().zip(&particles.body_force).map(|(m, b)| m * b[0]).sum();
            let change = momentum(&solver) - before;
            let impulse = solver.time_step() * force;
            assert!((change / impulse - 1.0).abs() < 1e-11, "{change:e}, not {impulse:e}");
        }
    }
}

fn momentum<F: ManufacturedField<f64, 1> + ?Sized, S: Shape>(
    solver: &Solver<'_, f64, 1, F, S>,
) -> f64 {
    let particles = solver.particles();
    particles.mass.iter().zip(&particles.velocity).map(|(m, v)| m * v[0]).sum()
}

#[test]
fn momentum_balances() {
    IntegratorName::ALL.iter().for_each(|integrator| integrator.visit(MomentumBalance));
}

/// Rigid motion with v, a != 0 at the start, at fixed cells: only the integrator's error is left, and it
/// shrinks at its formal order.
#[test]
fn temporal_order_is_the_formal_order() {
    struct FormalOrder;
    impl IntegratorVisitor for FormalOrder {
        type Output = i32;
        fn visit<I: Integrator>(self) -> i32 {
            I::FORMAL_ORDER
        }
    }
    let faces = vec![(Face::Min(0), Condition::Free), (Face::Max(0), Condition::Free)];
    let bar = Bar { amplitude: 0.0, slide: 0.3, faces, ..Bar::default() };
    for &integrator in IntegratorName::ALL {
        let error = |courant: f64| {
            let mut method = method(ShapeName::Cpgimp, integrator);
            method.courant = courant;
            let level = &levels::<f64, 1>(&bar, &method, &[8])[0];
            level.errors.as_ref().unwrap().l2
        };
        let order = observed_order([error(0.1), error(0.05)], [0.1, 0.05]).unwrap();
        let formal_order = f64::from(integrator.visit(FormalOrder));
        assert!((order - formal_order).abs() < 0.05, "{integrator}: {order}");
    }
}

/// A uniformly stretched body at rest stays at rest: contiguous domains leave no internal force inside.
fn patch<T: Real, const D: usize>(stretch: f64) {
    let field = Affine::patch(stretch);
    for &integrator in IntegratorName::ALL {
        let level = &levels::<T, D>(&field, &method(ShapeName::Cpgimp, integrator), &[4])[0];
        let linf = level.errors.as_ref().unwrap().linf;
        let round_off = 1e3 * T::default_epsilon().to_f64();
        assert!(linf < round_off, "{integrator}, D = {D}: {linf:e}");
    }
}

#[test]
fn uniform_stretch_is_in_equilibrium() {
    for stretch in [-0.2, 0.13, 0.6] {
        patch::<f64, 1>(stretch);
        patch::<f32, 1>(stretch);
        patch::<f64, 2>(stretch);
        patch::<f64, 3>(stretch);
    }
}

/// The expected failure: domains that do not follow the stretch, or are points, leave a force.
#[test]
fn uniform_stretch_is_not_in_equilibrium_without_contiguous_domains() {
    let field = Affine::patch(0.13);
    for shape in [ShapeName::Linear, ShapeName::Ugimp] {
        let level = &levels::<f64, 1>(&field, &method(shape, IntegratorName::Leapfrog), &[8])[0];
        let large = level.errors.as_ref().map_or(true, |errors| errors.linf > 1e-4);
        assert!(large, "{shape}: {:?}", level.errors);
    }
}

/// F(t) = F0 + H1 t with L and F that do not commute and are not symmetric: a transposed L, or F L for L F,
/// gives a wrong H by 10 % and more. Without stress, so that the motion is that of free particles.
struct ShearedFlow;

impl IntegratorVisitor for ShearedFlow {
    type Output = ();

    fn visit<I: Integrator>(self) {
        let h0 = [[0.1, 0.3, 0.0], [0.0, -0.1, 0.0], [0.0, 0.1, 0.0]];
        let h1 = [[0.0, 0.1, 0.0], [0.2, 0.0, 0.1], [0.0, 0.0, 0.1]];
        let affine = Affine { h0, h1, mu: 0.0, ..Affine::patch(0.0) };
        let field: &dyn ManufacturedField<f64, 3> = &affine;
        let resolution = Resolution { cells: 4, ..RESOLUTION };
        let mut solver = Solver::<f64, 3, _, Cpgimp>::new(field, &resolution).unwrap();
        solver.run::<I>(&mut |_, _| {}).unwrap();
        let exact = affine.gradient::<f64, 3>(solver.time());
        for h in &solver.particles().displacement_gradient {
            assert!((h - exact).amax() < 0.02, "{h}, not {exact}");
        }
    }
}

#[test]
fn deformation_follows_a_sheared_flow() {
    IntegratorName::ALL.iter().for_each(|integrator| integrator.visit(ShearedFlow));
}

/// A run is a pure function of its input.
#[test]
fn runs_repeat_bit_for_bit() {
    let study = || {
        let method = method(ShapeName::Cpgimp, IntegratorName::Leapfrog);
        levels::<f64, 1>(&Bar::default(), &method, &[16])[0].errors.clone()
    };
    assert_eq!(study(), study());
}
