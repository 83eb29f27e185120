//! Runs on several threads, and with sorted particles: results depend on neither.

use crate::common::wave::Wave;
use crate::sampled::sampled;
use mms_runtime::study::{Frame, Observer, StudyLevel, Watch, run_level};
use mms_runtime::{
    Condition, FormulationName, IntegratorName, Method, Run, Setup, ShapeName, Solve, Transfer,
};

fn run(faces: Condition, method: &Method, threads: usize) -> Run {
    let mut method = method.clone();
    method.setup.threads = threads;
    // Particles are sorted again on the way.
    method.setup.end_time = Some(0.45);
    f64::run(&Wave::sliding(faces), &method, &40.into(), Watch::Everything, &mut ()).unwrap()
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (updated, total) = (FormulationName::Updated, FormulationName::Total);
    let (traction, prescribed) = (Condition::Traction, Condition::Prescribed);
    let methods = [
        (ShapeName::Cpgimp, updated, Transfer::FLIP, traction),
        (ShapeName::QuadraticBspline, updated, Transfer::Apic, prescribed),
        (ShapeName::Linear, total, Transfer::Xpic { order: 2 }, traction),
        (ShapeName::Cpdi, updated, Transfer::Pic, prescribed),
    ];
    for (shape, formulation, transfer, faces) in sampled(methods, 4) {
        for integrator in [IntegratorName::Leapfrog, IntegratorName::Musl] {
            let setup = Setup { transfer, ..Setup::default() };
            let method = Method { shape, formulation, integrator, setup };
            let one = run(faces, &method, 1);
            assert!(one.level.particles >= 4800, "one slab has nothing to share");
            let details = |run: Run| {
                run.details.unwrap_or_else(|| panic!("{method:?}: {:?}", run.level.errors))
            };
            let one = details(one);
            for threads in [2, 3, 7] {
                assert_eq!(one, details(run(faces, &method, threads)), "{method:?} on {threads}");
            }
        }
    }
}

/// The first and the last state.
struct Ends(Vec<Frame>);

impl Observer for Ends {
    fn step(&mut self, _: usize, _: usize) {}
    fn wants(&self, step: usize, steps: usize) -> bool {
        step == 0 || step == steps
    }
    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        self.0.push(frame.clone());
        Ok(())
    }
}

/// In every state particles are in the order of their numbers, however the solver sorts them: each has its initial X.
#[test]
fn states_have_their_particles_in_the_first_order() {
    let setup = Setup { end_time: Some(0.45), ..Setup::default() };
    let method = Method { setup, ..Method::default() };
    let mut ends = Ends(Vec::new());
    let wave = Wave::sliding(Condition::Prescribed);
    let level = run_level(&wave, &method, &40.into(), &mut ends).unwrap();
    assert!(level.errors.is_ok() && ends.0.len() == 2, "{:?}", level.errors);
    let reference = |frame: &Frame| -> Vec<f64> {
        assert_eq!(frame.position.len(), 2 * level.particles);
        frame.position.iter().zip(&frame.displacement).map(|(x, d)| x - d).collect()
    };
    let [before, after] = [reference(&ends.0[0]), reference(&ends.0[1])];
    assert!(before.iter().zip(&after).all(|(before, after)| (before - after).abs() < 1e-15));
}

/// Errors continue to fall where slabs begin.
#[test]
fn slabs_do_not_change_the_order() {
    let level = |cells: usize| -> StudyLevel {
        let setup = Setup { end_time: Some(0.15), ..Setup::default() };
        let method = Method { setup, ..Method::default() };
        let run = f64::run(
            &Wave::sliding(Condition::Prescribed),
            &method,
            &cells.into(),
            Watch::Displacement,
            &mut (),
        );
        run.unwrap().level
    };
    // 30 cells make one slab, 40 make several.
    let errors = [20, 30, 40].map(|cells| level(cells).errors.unwrap().l2);
    let orders = [
        (errors[0] / errors[1]).ln() / 1.5_f64.ln(),
        (errors[1] / errors[2]).ln() / (4.0_f64 / 3.0).ln(),
    ];
    assert!(orders.iter().all(|order| (1.85..2.15).contains(order)), "{orders:?} {errors:?}");
}
