//! Runs on several threads, and with particles that are sorted: nothing depends on either.

mod common;

use common::wave::Wave;
use mms_runtime::study::{Level, Watch};
use mms_runtime::{
    Condition, FormulationName, IntegratorName, Method, Run, Setup, ShapeName, Solve, Transfer,
};

fn run(faces: Condition, method: &Method, threads: usize) -> Run {
    let mut method = method.clone();
    method.setup.threads = threads;
    method.setup.end_time = Some(0.15);
    f64::run(&Wave::sliding(faces), &method, &40.into(), Watch::Everything, &mut ()).unwrap()
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (updated, total) = (FormulationName::Updated, FormulationName::Total);
    let (traction, prescribed) = (Condition::Traction, Condition::Prescribed);
    for (shape, formulation, transfer, faces) in [
        (ShapeName::Cpgimp, updated, Transfer::FLIP, traction),
        (ShapeName::QuadraticBspline, updated, Transfer::Apic, prescribed),
        (ShapeName::Linear, total, Transfer::Xpic { order: 2 }, traction),
        (ShapeName::Cpdi, updated, Transfer::Pic, prescribed),
    ] {
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

/// Errors go on falling where slabs begin.
#[test]
fn slabs_do_not_change_the_order() {
    let level = |cells: usize| -> Level {
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
