//! Runs that stop and resume from a checkpoint: they end with the same bits as uninterrupted runs.

use std::io::Read;

use crate::common::wave::Wave;
use mms_runtime::study::{Checkpoint, Details, Observer, Record, Watch};
use mms_runtime::{
    Cause, Condition, FormulationName, IntegratorName, Method, Refusal, Run, Setup, ShapeName,
    Solve, Transfer,
};

/// Resumes from a checkpoint, writes another, stops there, and records every step.
#[derive(Default)]
struct RestartObserver {
    from: Option<Vec<u8>>,
    stop: Option<usize>,
    kept: Vec<u8>,
    records: Vec<Record>,
}

impl Observer for RestartObserver {
    fn step(&mut self, _: usize, _: usize) {}

    fn records(&self) -> bool {
        true
    }

    fn record(&mut self, record: &Record) {
        self.records.push(record.clone());
    }

    fn resume(&mut self) -> Option<Box<dyn Read + '_>> {
        self.from.as_deref().map(|from| Box::new(from) as Box<dyn Read>)
    }

    fn keeps(&self, step: usize, _: usize) -> bool {
        self.stop == Some(step)
    }

    fn keep(&mut self, checkpoint: &dyn Checkpoint) -> Result<(), String> {
        assert_eq!(self.stop, Some(checkpoint.step()));
        checkpoint.write(&mut self.kept).map_err(|error| error.to_string())?;
        Err("as requested".into())
    }
}

fn method(shape: ShapeName, formulation: FormulationName, transfer: Transfer) -> Method {
    // So many steps that particles are sorted again before and after a stop.
    let setup = Setup { transfer, end_time: Some(0.45), ..Setup::default() };
    Method { shape, formulation, setup, ..Method::default() }
}

fn run(faces: Condition, method: &Method, keeper: &mut RestartObserver) -> Result<Run, Refusal> {
    f64::run(&Wave::sliding(faces), method, &40.into(), Watch::Everything, keeper)
}

fn details(run: Run) -> Details {
    run.details.unwrap_or_else(|| panic!("{:?}", run.level.errors))
}

/// Tests two stops, each on another number of threads.
fn interrupted(faces: Condition, method: &Method) {
    let mut straight = RestartObserver::default();
    let whole = run(faces, method, &mut straight).unwrap();
    let steps = whole.level.steps;
    assert!(whole.level.particles >= 4800, "in one slab nothing is sorted");
    assert!(steps >= 40, "particles are looked at every 16 steps");
    assert_eq!(straight.records.len(), steps);

    let (mut from, mut records) = (None, Vec::new());
    for (threads, stop) in [(2, Some(1)), (1, Some(steps / 2)), (3, Some(steps)), (1, None)] {
        let mut keeper = RestartObserver { from, stop, ..RestartObserver::default() };
        let method = Method { setup: Setup { threads, ..method.setup.clone() }, ..method.clone() };
        let run = run(faces, &method, &mut keeper).unwrap();
        records.append(&mut keeper.records);
        match stop {
            Some(stop) => {
                let failure = run.level.errors.unwrap_err();
                assert_eq!(failure.cause, Cause::Stopped { reason: "as requested".into() });
                assert_eq!(failure.step, stop);
            }
            None => assert_eq!(details(run), details(whole.clone()), "{method:?}"),
        }
        from = Some(keeper.kept);
    }
    assert_eq!(records, straight.records, "{method:?}");
}

#[test]
fn an_interrupted_run_ends_with_the_same_bits() {
    let (updated, total) = (FormulationName::Updated, FormulationName::Total);
    let (traction, prescribed) = (Condition::Traction, Condition::Prescribed);
    for (shape, formulation, transfer, faces, integrator) in [
        (ShapeName::Cpgimp, updated, Transfer::FLIP, traction, IntegratorName::Leapfrog),
        (ShapeName::QuadraticBspline, updated, Transfer::Apic, prescribed, IntegratorName::Usl),
        (ShapeName::Linear, total, Transfer::Xpic { order: 2 }, traction, IntegratorName::Musl),
        (ShapeName::Cpdi, updated, Transfer::Pic, prescribed, IntegratorName::Usf),
    ] {
        let method = Method { integrator, ..method(shape, formulation, transfer) };
        interrupted(faces, &method);
    }
}

/// A checkpoint of the middle of a run.
fn checkpoint(method: &Method) -> Vec<u8> {
    let mut keeper = RestartObserver { stop: Some(3), ..RestartObserver::default() };
    let run = run(Condition::Prescribed, method, &mut keeper).unwrap();
    assert!(!keeper.kept.is_empty(), "{:?}", run.level.errors);
    keeper.kept
}

fn refused(from: Vec<u8>, method: &Method) -> String {
    let mut keeper = RestartObserver { from: Some(from), ..RestartObserver::default() };
    match run(Condition::Prescribed, method, &mut keeper) {
        Err(Refusal::NoState { reason }) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_checkpoint_of_this_scene_is_refused() {
    let own = method(ShapeName::Ugimp, FormulationName::Updated, Transfer::FLIP);
    let whole = checkpoint(&own);
    for part in 0..32 {
        let cut = whole[..whole.len() * part / 32].to_vec();
        assert!(refused(cut, &own).starts_with("no checkpoint"), "{part}/32 of it");
    }
    let mut fewer = own.clone();
    fewer.setup.particles_per_cell = 3.into();
    assert_eq!(refused(checkpoint(&fewer), &own), "it has other particles");
    let mut shorter = own.clone();
    shorter.setup.end_time = Some(1e-3);
    assert_eq!(refused(whole, &shorter), "it has other steps");
    let affine = method(ShapeName::Ugimp, FormulationName::Updated, Transfer::Apic);
    assert_eq!(refused(checkpoint(&affine), &own), "it has other transfers");
}

/// With stencils without a bound, particles stay in their first order.
#[test]
fn an_order_that_particles_cannot_be_in_is_refused() {
    let fixed = method(ShapeName::Cpdi, FormulationName::Updated, Transfer::FLIP);
    let mut forged = checkpoint(&fixed);
    let numbers: Vec<u8> = (0..100).collect();
    let at = forged.windows(100).position(|part| part == numbers).expect("numbers in order");
    forged.swap(at, at + 1);
    assert_eq!(refused(forged, &fixed), "it has other particles");
}
