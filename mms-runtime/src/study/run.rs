//! One run of a method on a field, and its results.

use super::range::explained;
use super::relax::relax;
use super::run_record::{RunRecord, Saved, SavedRecord, Stopwatch};
use super::{Balance, Deviations, Errors, Observer, Snapshots, StudyLevel};
use crate::failure::{Failure, Refusal};
use crate::field::ManufacturedField;
use crate::method::{Division, Method};
use crate::particle::Particles;
use crate::real::{Real, Vector};
use crate::solver::{AnySolver, Ramp, Residual, Seconds, of_method};

/// The errors that are measured in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watch {
    /// The errors of the displacement.
    Displacement,
    /// The errors of displacement, velocity, F and P; more work than a step in some scenes.
    Everything,
    /// All errors, and the displacements at the ends of this number of equal parts of the time window; the number of steps has
    /// to be a multiple of it, see [`Setup::parts`](crate::Setup::parts).
    Parts(usize),
}

/// A run, and its results if it reached its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The run as one level of a study.
    pub level: StudyLevel,
    /// The measurements; `None` if the run stopped.
    pub details: Option<Details>,
    /// The times of the parts of all steps.
    pub seconds: Seconds,
    /// The displacements at the times of [`Watch::Parts`]; empty if the run stopped.
    pub snapshots: Snapshots,
}

/// The measurements of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Details {
    /// The largest of each error norm over all steps, the initial state included.
    pub largest: Deviations,
    /// The errors at the end.
    pub last: Deviations,
    /// The predicted part of round-off in the l2 error of the displacement. If the run computes an equilibrium, its residual is
    /// included.
    pub round_off: f64,
    /// The residual at the end of a run that computes an equilibrium.
    pub residual: Option<Residual>,
    /// The state at the end.
    pub diagnostics: Diagnostics,
}

/// The results of a run that ended.
pub(super) type Ended = (Details, Seconds, Snapshots);

/// Sums over the particles at the end of a run, in double precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics {
    /// sum m.
    pub mass: f64,
    /// sum m v, `D` components.
    pub momentum: Vec<f64>,
    /// sum m v.v/2.
    pub kinetic_energy: f64,
    /// The least and the greatest J.
    pub jacobian: [f64; 2],
    /// The balance of the body, with [`Watch::Everything`] and [`Watch::Parts`] only.
    pub balance: Option<Balance>,
}

impl Diagnostics {
    pub(super) fn of<T: Real, const D: usize>(
        particles: &Particles<T, D>,
        balance: Option<Balance>,
    ) -> Self {
        let (mut momentum, mut kinetic_energy) = (Vector::<f64, D>::zeros(), 0.0);
        for (m, v) in particles.mass.iter().zip(particles.velocity.iter()) {
            let (m, v) = (m.to_f64(), v.map(Real::to_f64));
            momentum += v * m;
            kinetic_energy += m * v.norm_squared() / 2.0;
        }
        let all = (0..particles.len()).map(|p| particles.jacobian(p).to_f64());
        Self {
            mass: particles.mass.iter().map(|m| m.to_f64()).sum(),
            momentum: momentum.as_slice().to_vec(),
            kinetic_energy,
            jacobian: all.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], j| {
                [least.min(j), most.max(j)]
            }),
            balance,
        }
    }
}

/// A precision in which solvers exist in `D` dimensions. They are compiled in this crate, once: callers of this trait compile
/// none.
pub trait Solve<const D: usize>: Real {
    /// The solver of a method, with the body divided into `cells`, whose steps the caller makes one by one: on the threads of
    /// the pool that the caller is in. The method's number of threads is ignored.
    ///
    /// # Errors
    /// The scene cannot be started.
    fn solver<'f>(
        field: &'f dyn ManufacturedField<Self, D>,
        method: &Method,
        cells: &Division,
    ) -> Result<Box<dyn AnySolver<'f, Self, D> + 'f>, Refusal>;

    /// Runs a method through the time window, with the body divided into `cells`.
    ///
    /// A run that stops returns its [`Failure`] in the level's errors.
    ///
    /// # Errors
    /// The scene cannot be started.
    fn run(
        field: &dyn ManufacturedField<Self, D>,
        method: &Method,
        cells: &Division,
        watch: Watch,
        observer: &mut dyn Observer,
    ) -> Result<Run, Refusal>;
}

macro_rules! solve {
    ($($float:ident $dimension:literal),*) => {
        $(impl Solve<$dimension> for $float {
            fn solver<'f>(
                field: &'f dyn ManufacturedField<Self, $dimension>,
                method: &Method,
                cells: &Division,
            ) -> Result<Box<dyn AnySolver<'f, Self, $dimension> + 'f>, Refusal> {
                of_method(field, method, cells)
            }

            fn run(
                field: &dyn ManufacturedField<Self, $dimension>,
                method: &Method,
                cells: &Division,
                watch: Watch,
                observer: &mut dyn Observer,
            ) -> Result<Run, Refusal> {
                run(field, method, cells, watch, observer)
            }
        })*
    };
}

solve!(f32 1, f32 2, f32 3, f64 1, f64 2, f64 3);

/// See [`Solve::run`].
fn run<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: &Division,
    watch: Watch,
    observer: &mut dyn Observer,
) -> Result<Run, Refusal> {
    let mut stopwatch = Stopwatch::default();
    let relaxes = method.setup.relax;
    let ramp = relaxes.then(|| Ramp::new(field)).transpose()?;
    let field = ramp.as_ref().map_or(field, |ramp| ramp as &dyn ManufacturedField<T, D>);
    let mut solver = T::solver(field, method, cells)?;
    let saved = observer.resume().map(Saved::<T, D>::read).transpose()?;
    let saved = match saved {
        None => None,
        Some(_) if relaxes => {
            return Err(Refusal::NoState { reason: "a relaxation begins at its beginning".into() });
        }
        Some(Saved { state, run_record }) => {
            solver.restore(state)?;
            stopwatch.before = run_record.elapsed;
            Some(run_record)
        }
    };
    let level = StudyLevel {
        cells: *cells,
        cell_size: solver.grid().lattice.cell_size.max().to_f64(),
        time_step: solver.present().time_step,
        steps: solver.steps(),
        particles: solver.present().particles.len(),
        errors: Ok(Errors::default()),
        seconds: 0.0,
    };
    let (details, seconds, snapshots) = Default::default();
    let mut run = Run { level, details, seconds, snapshots };
    let fastest_wave = method.setup.fastest_wave;
    let go = || {
        fastest_wave.map_or(Ok(()), |fastest| solver.check_time_step(fastest))?;
        solver.check()?;
        match relaxes {
            true => relax(&mut *solver, watch, stopwatch, observer),
            false => take_steps(&mut *solver, watch, saved, stopwatch, observer),
        }
    };
    let result = match method.setup.threads {
        1 => go(),
        threads => pool(threads)?.install(go),
    };
    run.level.seconds = stopwatch.seconds();
    if relaxes {
        run.level.steps = solver.present().step;
    }
    run.level.errors = match result {
        Ok((details, seconds, snapshots)) => {
            let errors = details.largest.displacement;
            (run.details, run.seconds, run.snapshots) = (Some(details), seconds, snapshots);
            Ok(errors)
        }
        Err(failure) => Err(explained(&solver.present(), run.level.cell_size, failure)),
    };
    Ok(run)
}

/// A thread pool for the passes over particles.
fn pool(threads: usize) -> Result<rayon::ThreadPool, Refusal> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| Refusal::NoThreads { threads, reason: error.to_string() })
}

/// Makes the remaining steps of a solver.
fn take_steps<T: Real, const D: usize>(
    solver: &mut dyn AnySolver<'_, T, D>,
    watch: Watch,
    saved: Option<SavedRecord<'_>>,
    stopwatch: Stopwatch,
    observer: &mut dyn Observer,
) -> Result<Ended, Failure> {
    let (steps, behind) = (solver.steps(), solver.lag() > 0.0);
    let mut run_record =
        RunRecord::begin(watch, &solver.present(), steps, saved, stopwatch, observer)?;
    while solver.present().step < steps {
        run_record.before_step(&solver.present(), behind);
        solver.step()?;
        run_record.after_step(&solver.present(), behind)?;
        run_record.keep(&solver.present(), &|| solver.state())?;
    }
    let (details, snapshots) = run_record.close(&solver.present());
    Ok((details, solver.seconds(), snapshots))
}
