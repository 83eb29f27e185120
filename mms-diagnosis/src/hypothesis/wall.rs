//! Mistakes in motions that are prescribed on faces.

use mms_runtime::{Condition, Vector};

use super::{Change, Given, Hypothesis, Motion};
use crate::exact::Exact;

/// By how many steps walls may be late: more is another mistake.
const STEPS: f64 = 8.0;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let is_prescribed = |(_, it): &(_, Condition)| *it == Condition::Prescribed;
    if !exact.domain.faces.iter().any(is_prescribed) {
        return Vec::new();
    }
    let fixed = |name, says, change| Hypothesis::fixed(name, says, Change::Wall(change));
    let late = Hypothesis::amount(
        "wall_late",
        "prescribed faces move as of an earlier time; the size is by how much",
        vec![exact.time_step],
        Change::Wall(|at, motion| follow(at, motion, at.time - at.size[0])),
    );
    vec![
        late.within([-STEPS * exact.time_step, STEPS * exact.time_step]).of_mesh(),
        fixed("wall_at_rest", "prescribed faces stay where they are at the start", |at, motion| {
            let start = at.exact.domain.time[0];
            match motion {
                Motion::Velocity(v) if at.time > start => v.fill(Vector::zeros()),
                motion => follow(at, motion, start),
            }
        }),
        Hypothesis {
            which: Some("walls"),
            ..fixed(
                "start_at_rest",
                "the initial velocity is 0, and that of prescribed faces, which their acceleration moves",
                from_rest,
            )
        },
    ]
}

/// The motion of another time; the start is as it is.
fn follow<const D: usize>(at: &Given<'_, D>, motion: Motion<'_, D>, time: f64) {
    if at.time <= at.exact.domain.time[0] {
        return;
    }
    match motion {
        Motion::Displacement(u) => u.copy_from_slice(&at.exact.displacement(time, at.reference)),
        Motion::Velocity(v) => v.copy_from_slice(&at.exact.velocity(time, at.reference)),
        Motion::Gradient(_) => {}
    }
}

/// The motion less that of the velocity at the start.
fn from_rest<const D: usize>(at: &Given<'_, D>, motion: Motion<'_, D>) {
    let start = at.exact.domain.time[0];
    let first = at.exact.velocity(start, at.reference);
    match motion {
        Motion::Displacement(u) => {
            u.iter_mut().zip(first).for_each(|(u, v)| *u -= v * (at.time - start));
        }
        Motion::Velocity(v) => v.iter_mut().zip(first).for_each(|(v, first)| *v -= first),
        Motion::Gradient(_) => {}
    }
}
