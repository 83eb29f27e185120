//! A run to the equilibrium of a field that does not move, by dynamic relaxation; see [`Ramp`](crate::solver::Ramp) for the
//! method.

use super::run::Ended;
use super::run_record::{RunRecord, Stopwatch};
use super::{Observer, Watch};
use crate::failure::{Cause, Failure};
use crate::real::Real;
use crate::solver::{AnySolver, Residual};

/// The largest number of steps of a run, in multiples of the steps of its ramp.
const MOST: usize = 1000;

/// The number of steps between evaluations of the residual.
const BETWEEN: usize = 32;

/// Advances a solver along its ramp, and on until the body is in equilibrium. Errors are measured at the end.
pub(super) fn relax<T: Real, const D: usize>(
    solver: &mut dyn AnySolver<'_, T, D>,
    watch: Watch,
    stopwatch: Stopwatch,
    observer: &mut dyn Observer,
) -> Result<Ended, Failure> {
    relaxed(solver, watch, stopwatch, observer).map_err(|failure| match failure.cause {
        Cause::Lost { position } => {
            Failure { cause: Cause::LostInRelaxation { position }, ..failure }
        }
        _ => failure,
    })
}

fn relaxed<T: Real, const D: usize>(
    solver: &mut dyn AnySolver<'_, T, D>,
    watch: Watch,
    stopwatch: Stopwatch,
    observer: &mut dyn Observer,
) -> Result<Ended, Failure> {
    let ramp = solver.steps();
    let most = ramp.saturating_mul(MOST);
    let mut run_record =
        RunRecord::begin(watch, &solver.present(), most, None, stopwatch, observer)?;
    let mut energy = 0.0;
    advance(solver, ramp, &mut energy, &mut run_record)?;
    // All faces have arrived.
    solver.halt();
    let mut residual = solver.out_of_balance()?;
    while !residual.is_small() {
        if solver.present().step >= most {
            let Residual { relative: residual, tolerance } = residual;
            return Err(solver.present().failed(Cause::NotRelaxed { residual, tolerance }));
        }
        advance(solver, BETWEEN, &mut energy, &mut run_record)?;
        residual = solver.out_of_balance()?;
    }
    solver.halt();
    let (details, snapshots) = run_record.finish(&solver.present(), residual)?;
    Ok((details, solver.seconds(), snapshots))
}

/// Advances by this number of steps, and halts the body whenever its kinetic energy falls below its value of the step before.
fn advance<T: Real, const D: usize>(
    solver: &mut dyn AnySolver<'_, T, D>,
    steps: usize,
    energy: &mut f64,
    run_record: &mut RunRecord<'_, T, D>,
) -> Result<(), Failure> {
    for _ in 0..steps {
        solver.step()?;
        run_record.pass(&solver.present());
        run_record.keep(&solver.present(), &|| solver.state())?;
        let now = solver.kinetic_energy();
        *energy = if now < *energy { 0.0 } else { now };
        if *energy == 0.0 {
            solver.halt();
        }
    }
    Ok(())
}
