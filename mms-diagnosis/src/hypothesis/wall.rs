//! Mistakes in motions that are prescribed on faces.

use mms_runtime::{Condition, Vector};

use super::{Change, Given, Hypothesis, MotionPart, faces};
use crate::exact::Exact;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let is_prescribed = |face| exact.domain.condition(face) == Condition::Prescribed;
    if !faces(&exact.domain.body).into_iter().any(is_prescribed) {
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
        late.of_steps(exact),
        fixed("wall_at_rest", "prescribed faces stay where they are at the start", |at, motion| {
            let start = at.exact.domain.time[0];
            match motion {
                MotionPart::Velocity(rate) | MotionPart::Acceleration(rate) if at.time > start => {
                    rate.fill(Vector::zeros());
                }
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
fn follow<const D: usize>(at: &Given<'_, D>, motion: MotionPart<'_, D>, time: f64) {
    if at.time <= at.exact.domain.time[0] {
        return;
    }
    match motion {
        MotionPart::Displacement(u) => {
            u.copy_from_slice(&at.exact.displacement(time, at.reference))
        }
        MotionPart::Velocity(v) => v.copy_from_slice(&at.exact.velocity(time, at.reference)),
        MotionPart::Acceleration(a) => {
            a.copy_from_slice(&at.exact.acceleration(time, at.reference));
        }
        MotionPart::Gradient(_) => {}
    }
}

/// The motion less that of the velocity at the start.
fn from_rest<const D: usize>(at: &Given<'_, D>, motion: MotionPart<'_, D>) {
    let start = at.exact.domain.time[0];
    let first = at.exact.velocity(start, at.reference);
    match motion {
        MotionPart::Displacement(u) => {
            u.iter_mut().zip(first).for_each(|(u, v)| *u -= v * (at.time - start));
        }
        MotionPart::Velocity(v) => v.iter_mut().zip(first).for_each(|(v, first)| *v -= first),
        MotionPart::Acceleration(_) | MotionPart::Gradient(_) => {}
    }
}
