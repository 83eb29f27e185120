//! Properties that every time integrator has, with every shape function and transfer, in both formulations
//! and in one to three dimensions.

use crate::common::{Affine, Bar, levels, method, methods, wave::Wave};
use mms_runtime::convergence::observed_order;
use mms_runtime::integrator::{Integrator, IntegratorVisitor};
use mms_runtime::{
    AnySolver, Condition, Division, Face, FormulationName, IntegratorName, ManufacturedField,
    Method, Setup, ShapeName, Solve, Transfer,
};

const EIGHT: Division = Division::Uniform(8);

/// Every transfer: the named ones, and FLIP with the fraction 0.5.
fn transfers() -> Vec<Transfer> {
    let named = Transfer::NAMES.iter().map(|name| name.parse().unwrap());
    named.chain([Transfer::Flip { fraction: 0.5 }]).collect()
}

/// All transfers reproduce a uniform velocity up to round-off.
fn free_flight<T: Solve<D>, const D: usize>(cells: usize, methods: &[Method]) {
    let field = Affine::flight([0.7, -0.4, 0.3]);
    for method in methods {
        let level = &levels::<T, D>(&field, method, &[cells])[0];
        let linf = level.errors.as_ref().unwrap().linf;
        let round_off = 20.0 * level.steps as f64 * T::default_epsilon().to_f64();
        assert!(linf < round_off, "{method:?}: {linf:e}");
    }
}

/// These methods with every transfer.
fn with_transfers(methods: &[Method]) -> Vec<Method> {
    let with = |method: &Method, transfer: Transfer| Method {
        setup: Setup { transfer, ..method.setup.clone() },
        ..method.clone()
    };
    let of = |method| transfers().into_iter().map(move |transfer| with(method, transfer));
    methods.iter().flat_map(of).collect()
}

#[test]
fn free_flight_is_exact() {
    let all = with_transfers(&methods());
    free_flight::<f64, 1>(8, &all);
    free_flight::<f64, 2>(2, &all);
    free_flight::<f32, 1>(8, &methods());
    free_flight::<f32, 2>(3, &methods());
}

/// A step of FLIP with a fraction is the weighted mean of a step of FLIP and one of PIC.
#[test]
fn flip_with_a_fraction_lies_between_flip_and_pic() {
    let wave = Wave::stretched_bar();
    let velocities = |transfer: Transfer| -> Vec<f64> {
        let setup = Setup { transfer, ..Setup::default() };
        let method = Method { setup, ..Method::default() };
        let mut solver = <f64 as Solve<1>>::solver(&wave, &method, &EIGHT).unwrap();
        solver.step().unwrap();
        solver.present().particles.velocity.iter().map(|v| v[0]).collect()
    };
    let mixed = Transfer::Flip { fraction: 0.75 };
    let [flip, pic, mixed] = [Transfer::FLIP, Transfer::Pic, mixed].map(velocities);
    for ((flip, pic), mixed) in flip.iter().zip(&pic).zip(&mixed) {
        assert!((flip - pic).abs() > 1e-6, "{flip} {pic}");
        assert!((mixed - (0.75 * flip + 0.25 * pic)).abs() < 1e-15, "{flip} {pic} {mixed}");
    }
}

/// Tests every transfer, with each shape function in each formulation, and one integrator.
#[test]
fn free_flight_is_exact_in_three_dimensions() {
    let mut leapfrog = methods();
    leapfrog.retain(|method| method.integrator == IntegratorName::Leapfrog);
    free_flight::<f64, 3>(2, &with_transfers(&leapfrog));
    free_flight::<f32, 3>(2, &leapfrog);
}

/// d/dt sum m v = sum m b + sum P N A0, tractions at both ends: internal forces add up to 0. The first step may be a half. In
/// the updated formulation a node that the face beyond a point has reached may have no weight from that point yet, so points
/// have no tractions here.
fn balance(method: Method, faces: Condition) {
    let wave = Wave::stretched_bar().with_all_faces(faces);
    let field: &dyn ManufacturedField<f64, 1> = &wave;
    let mut solver = <f64 as Solve<1>>::solver(field, &method, &EIGHT).unwrap();
    solver.step().unwrap();
    for _ in 0..5 {
        let (before, time) = (momentum(&*solver), solver.present().time);
        solver.step().unwrap();
        let particles = solver.present().particles;
        let mut force = vec![mms_runtime::Vector::zeros(); particles.len()];
        let time_of_force = solver.present().time_of_force;
        field.body_force(time_of_force, &particles.reference_position, &mut force);
        let body: f64 = particles.mass.iter().zip(&force).map(|(m, b)| m * b[0]).sum();
        let stress = |x: f64| {
            let h = wave.gradient(time, &mms_runtime::Vector::<f64, 1>::new(x));
            wave.first_piola_kirchhoff(&h)[0]
        };
        let pull = if faces == Condition::Traction { stress(1.0) - stress(0.0) } else { 0.0 };
        let time_step = solver.present().time_step;
        let impulse = time_step * (body + pull);
        let change = momentum(&*solver) - before;
        let size = time_step * (body.abs() + pull.abs());
        assert!(faces == Condition::Free || pull.abs() > 1e-3, "a test without tractions");
        assert!((change - impulse).abs() < 1e-11 * size, "{method:?}: {change:e}, {impulse:e}");
    }
}

fn momentum(solver: &dyn AnySolver<f64, 1>) -> f64 {
    let particles = solver.present().particles;
    particles.mass.iter().zip(particles.velocity.iter()).map(|(m, v)| m * v[0]).sum()
}

#[test]
fn momentum_balances() {
    let (traction, xpic) = (Condition::Traction, Transfer::Xpic { order: 2 });
    for integrator in IntegratorName::ALL {
        for formulation in FormulationName::ALL {
            let moves = *formulation == FormulationName::Updated;
            let points = if moves { Condition::Free } else { traction };
            let mut scenes = vec![
                (ShapeName::Linear, Transfer::FLIP, points),
                (ShapeName::QuadraticBspline, xpic, points),
                (ShapeName::CubicBspline, Transfer::Pic, points),
                (ShapeName::QuadraticBspline, Transfer::Apic, points),
            ];
            if moves {
                scenes.push((ShapeName::Cpgimp, Transfer::FLIP, traction));
                scenes.push((ShapeName::Cpdi, Transfer::Apic, traction));
            }
            for (shape, transfer, faces) in scenes {
                let (formulation, setup) = (*formulation, Setup { transfer, ..Setup::default() });
                let method = Method { shape, integrator: *integrator, formulation, setup };
                balance(method, faces);
            }
        }
    }
}

/// Rigid motion with v, a != 0 at the start, at fixed cells: the only error is the integrator's, and it shrinks at its formal
/// order.
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
    for mut method in methods() {
        let mut error = |courant: f64| {
            method.setup.courant = courant;
            let level = &levels::<f64, 1>(&bar, &method, &[8])[0];
            level.errors.as_ref().unwrap().l2
        };
        let order = observed_order([error(0.1), error(0.05)], [0.1, 0.05]).unwrap();
        let formal_order = f64::from(method.integrator.visit(FormalOrder));
        assert!((order - formal_order).abs() < 0.05, "{method:?}: {order}");
    }
}

/// Whether a method has no internal force in a uniform stress: contiguous domains have none, nor have points in the reference
/// configuration, unless the slopes of their splines are more than linear in a cell.
fn is_contiguous(method: &Method) -> bool {
    match method.shape {
        ShapeName::Cpgimp | ShapeName::Cpdi => true,
        ShapeName::CubicBspline => false,
        _ => method.formulation == FormulationName::Total,
    }
}

/// A uniformly stretched body at rest remains at rest.
fn patch<T: Solve<D>, const D: usize>(stretch: f64) {
    let field = Affine::patch(stretch);
    for method in methods().into_iter().filter(is_contiguous) {
        let level = &levels::<T, D>(&field, &method, &[4])[0];
        let linf = level.errors.as_ref().unwrap().linf;
        let round_off = 1e3 * T::default_epsilon().to_f64();
        assert!(linf < round_off, "{method:?}, D = {D}: {linf:e}");
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

/// The expected failure: points, and domains that do not follow the stretch, have a force.
#[test]
fn uniform_stretch_is_not_in_equilibrium_without_contiguous_domains() {
    let field = Affine::patch(0.13);
    for shape in [ShapeName::Linear, ShapeName::Ugimp] {
        let level = &levels::<f64, 1>(&field, &method(shape, IntegratorName::Leapfrog), &[8])[0];
        let large = level.errors.as_ref().map_or(true, |errors| errors.linf > 1e-4);
        assert!(large, "{shape}: {:?}", level.errors);
    }
}

/// F(t) = F0 + H1 t with L and F that do not commute and are not symmetric: a transposed L, or F L for L F, gives an H that is
/// wrong by 10 % and more. Without stress, so that particles move freely.
fn sheared_flow(method: &Method) {
    let h0 = [[0.1, 0.3, 0.0], [0.0, -0.1, 0.0], [0.0, 0.1, 0.0]];
    let h1 = [[0.0, 0.1, 0.0], [0.2, 0.0, 0.1], [0.0, 0.0, 0.1]];
    let affine = Affine { h0, h1, mu: 0.0, ..Affine::patch(0.0) };
    let mut solver = <f64 as Solve<3>>::solver(&affine, method, &Division::Uniform(4)).unwrap();
    for _ in 0..solver.steps() {
        solver.step().unwrap();
    }
    let exact = affine.gradient::<f64, 3>(solver.present().time);
    for h in solver.present().particles.displacement_gradient.iter() {
        assert!((h - exact).amax() < 0.02, "{method:?}: {h}, not {exact}");
    }
}

#[test]
fn deformation_follows_a_sheared_flow() {
    for integrator in IntegratorName::ALL {
        for (shape, formulation) in [
            (ShapeName::Cpgimp, FormulationName::Updated),
            (ShapeName::Cpdi, FormulationName::Updated),
            (ShapeName::Linear, FormulationName::Total),
        ] {
            let setup = Setup::default();
            sheared_flow(&Method { shape, integrator: *integrator, formulation, setup });
        }
    }
}

/// A run is a pure function of its input.
#[test]
fn runs_repeat_bit_for_bit() {
    for mut method in methods() {
        method.setup.jitter = 0.3;
        let study = || levels::<f64, 1>(&Bar::default(), &method, &[16])[0].errors.clone();
        assert_eq!(study(), study());
    }
}

/// A reflected scene runs as the reflection of its run: no direction is preferred.
fn reflections<const D: usize>(wave: &Wave<D>, cells: usize, transfers: &[Transfer])
where
    f64: Solve<D>,
{
    for mut method in methods() {
        method.setup.end_time = Some(0.2); // before linear weights become unstable
        for &transfer in transfers {
            method.setup.transfer = transfer;
            let [one, other] = [wave, &wave.reflected()]
                .map(|wave| levels::<f64, D>(wave, &method, &[cells])[0].errors.clone().unwrap());
            for (a, b) in [(one.l1, other.l1), (one.l2, other.l2), (one.linf, other.linf)] {
                assert!((a - b).abs() < 1e-12, "{cells} cells, {method:?}: {a:e} {b:e}");
            }
        }
    }
}

#[test]
fn reflections_run_alike() {
    let transfers = [Transfer::FLIP, Transfer::Apic, Transfer::Xpic { order: 3 }];
    reflections(&Wave::stretched_bar().with_all_faces(Condition::Traction), 8, &transfers);
    reflections(&Wave::stretched_bar(), 8, &transfers);
    reflections(&Wave::on_box([1.0, 0.75]), 4, &transfers[..1]);
}

/// Reflections also run alike where the corners of cells are not exact in binary: weights of round-off must not matter.
#[test]
fn reflections_run_alike_off_binary_fractions() {
    let transfers = [Transfer::FLIP];
    reflections(&Wave::stretched_bar(), 10, &transfers);
    reflections(&Wave::stretched_bar().with_all_faces(Condition::Traction), 10, &transfers);
}
