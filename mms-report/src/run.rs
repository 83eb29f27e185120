//! A run as a text and as a JSON document.

use mms_documents::provenance::Provenance;
use mms_documents::run as documents;
use mms_files::words::duration;
use mms_options::method::Arithmetic;
use mms_runtime::solver::Residual;
use mms_runtime::study::{Balance, Details, Deviations};
use mms_runtime::{Division, Errors, Method};
use mms_spec::foreign::Foreign;

use super::{UnstartedLevel, method};
use crate::table::TextTable;

/// A run.
pub struct Run {
    /// The field's name.
    pub field: Foreign,
    /// The field's title.
    pub title: Foreign,
    /// The method.
    pub method: Method,
    /// The arithmetic.
    pub arithmetic: Arithmetic,
    /// The run, or the reason why it was not started.
    pub run: Result<mms_runtime::Run, UnstartedLevel>,
    /// The provenance.
    pub provenance: Provenance,
}

/// The errors of each quantity: symbol, key and value.
pub fn quantities(deviations: &Deviations) -> [(&'static str, &'static str, Errors); 4] {
    [
        ("u", "displacement", deviations.displacement),
        ("v", "velocity", deviations.velocity),
        ("F", "deformation_gradient", deviations.deformation_gradient),
        ("P", "first_piola_kirchhoff", deviations.first_piola_kirchhoff),
    ]
}

/// Nanoseconds of all particles and steps; 0 of a run without steps.
fn ns_per_particle_step(run: &mms_runtime::Run) -> f64 {
    let work = (run.level.particles * run.level.steps).max(1) as f64;
    let seconds = run.seconds;
    (seconds.forcing + seconds.transfer + seconds.grid + seconds.stress) * 1e9 / work
}

impl Run {
    /// The reason why the run did not reach its end, if it did not.
    fn failure(&self) -> Option<String> {
        match &self.run {
            Ok(run) => run.level.errors.as_ref().err().map(ToString::to_string),
            Err(refused) => Some(refused.to_string()),
        }
    }

    fn cells(&self) -> &Division {
        match &self.run {
            Ok(run) => &run.level.cells,
            Err(refused) => &refused.cells,
        }
    }

    /// The JSON document. Keys of a run that was not started are null.
    pub fn document(&self) -> documents::Run {
        let run = self.run.as_ref().ok();
        let level = run.map(|run| &run.level);
        let details = run.and_then(|run| run.details.as_ref());
        let ended = run.filter(|_| details.is_some());
        documents::Run {
            field: self.field.raw().to_owned(),
            method: method::document(&self.method, self.arithmetic),
            cells: method::division(self.cells()),
            cell_size: level.map(|level| level.cell_size),
            time_step: level.map(|level| level.time_step),
            steps: level.map(|level| level.steps),
            particles: level.map(|level| level.particles),
            errors: details.map(errors),
            diagnostics: details.map(diagnostics),
            ns_per_particle_step: ended.map(ns_per_particle_step),
            seconds: ended.map(parts),
            residual_ratio: details.and_then(|details| Some(details.residual?.relative)),
            failure: self.failure(),
            provenance: self.provenance.clone(),
        }
    }

    /// The text for a terminal, for a run that was started.
    pub fn text(&self, run: &mms_runtime::Run) -> String {
        let level = &run.level;
        let head = format!(
            "{}: {}\n{}\n\n{} cells, {} particles, {} steps of {:.3e}",
            self.field.shown(),
            self.title.shown(),
            method::line(&self.method, self.arithmetic),
            level.cells,
            level.particles,
            level.steps,
            level.time_step
        );
        let Some(details) = &run.details else {
            return format!("{head}\nstopped after {}", duration(level.seconds));
        };
        let state = &details.diagnostics;
        let head = head + &details.residual.map_or_else(String::new, balanced);
        format!(
            "{head}\n\n{}\n\nat the end: J from {:.4} to {:.4}, kinetic energy {:.4e}, mass {:.4e}\n{}",
            table(details),
            state.jacobian[0],
            state.jacobian[1],
            state.kinetic_energy,
            state.mass,
            times(run)
        )
    }
}

/// The residual of the equilibrium that a run has reached.
fn balanced(Residual { relative, tolerance }: Residual) -> String {
    format!(
        "\nin equilibrium: {relative:.1e} of the forces are out of balance, below {tolerance:.1e}"
    )
}

/// The line about the time of each part of a step.
fn times(run: &mms_runtime::Run) -> String {
    let seconds = run.seconds;
    let parts = [
        ("forcing", seconds.forcing),
        ("transfer", seconds.transfer),
        ("grid", seconds.grid),
        ("stress", seconds.stress),
    ];
    let whole: f64 = parts.iter().map(|(_, seconds)| seconds).sum();
    let share = |(name, seconds): (&str, f64)| format!("{name} {:.0} %", 100.0 * seconds / whole);
    format!(
        "{} in all, {:.0} ns per particle and step: {}",
        duration(run.level.seconds),
        ns_per_particle_step(run),
        parts.map(share).join(", ")
    )
}

fn table(details: &Details) -> TextTable {
    let header = ["error of", "l1", "l2", "linf", "at the end: l1", "l2", "linf"];
    let mut table = TextTable::new("errors over time and at the end", header).right_from(1);
    let rows = quantities(&details.largest).into_iter().zip(quantities(&details.last));
    // A body in equilibrium is at rest.
    let moves = details.residual.is_none();
    for ((symbol, _, largest), (_, _, last)) in rows {
        if symbol == "v" && !moves {
            continue;
        }
        let norms = [largest, last].map(|errors| [errors.l1, errors.l2, errors.linf]);
        let numbers = norms.concat().into_iter().map(|error| format!("{error:.2e}"));
        table.add_row(std::iter::once(symbol.to_owned()).chain(numbers));
    }
    table
}

/// The global sums at the end.
fn diagnostics(details: &Details) -> documents::Diagnostics {
    let state = &details.diagnostics;
    documents::Diagnostics {
        mass: state.mass,
        momentum: state.momentum.clone(),
        kinetic_energy: state.kinetic_energy,
        jacobian: state.jacobian,
        balance: state.balance.as_ref().map(balance),
    }
}

/// The balance of energy.
fn balance(balance: &Balance) -> documents::Balance {
    documents::Balance {
        time: balance.time,
        kinetic_energy: balance.kinetic_energy,
        strain_energy: balance.strain_energy,
        body_work: balance.body_work,
        energy_residual: balance.energy_residual,
        surface_force: balance.surface_force.clone(),
        given_work: balance.given_work,
    }
}

/// The seconds of the parts of a step.
fn parts(run: &mms_runtime::Run) -> documents::PartsOfTime {
    let seconds = run.seconds;
    documents::PartsOfTime {
        forcing: seconds.forcing,
        transfer: seconds.transfer,
        grid: seconds.grid,
        stress: seconds.stress,
    }
}

/// The errors of each quantity: the largest over time, and the errors at the end.
fn errors(details: &Details) -> documents::RunErrors {
    let norms = |Errors { l1, l2, linf }| documents::Norms { l1, l2, linf };
    let (largest, last) = (&details.largest, &details.last);
    let of = |of: fn(&Deviations) -> Errors| documents::OverTime {
        over_time: norms(of(largest)),
        at_end: norms(of(last)),
    };
    documents::RunErrors {
        displacement: of(|it| it.displacement),
        velocity: of(|it| it.velocity),
        deformation_gradient: of(|it| it.deformation_gradient),
        first_piola_kirchhoff: of(|it| it.first_piola_kirchhoff),
    }
}
