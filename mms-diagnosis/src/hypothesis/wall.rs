//! Mistakes in motions prescribed on faces.

use mms_runtime::{Condition, Vector};

use super::{Change, Given, Hypothesis, MotionPart};
use crate::body::faces;
use crate::exact::Exact;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let is_prescribed = |face| exact.domain.condition(face) == Condition::Prescribed;
    if !faces(&exact.domain.body).into_iter().any(is_prescribed) {
        return Vec::new();
    }
    let fixed = |name, says, change| Hypothesis::fixed(name, says, Change::Wall(change));
    let late = Hypothesis::amount(
        "wall_late",
        "prescribed faces move as at an earlier time; the size is the delay",
        vec![exact.time_step],
        Change::Wall(|at, motion| follow(at, motion, at.time - at.size[0])),
    );
    let late_acceleration = Hypothesis::amount(
        "wall_late",
        "the acceleration of prescribed faces belongs to an earlier time; the size is the delay",
        vec![exact.time_step],
        Change::Wall(accelerated_late),
    );
    let mut offset = Hypothesis::amount(
        "start_half_step",
        "the initial velocity belongs to a later time, also on prescribed faces, which their acceleration moves; the size \
         is the delay",
        vec![exact.time_step / 2.0],
        Change::Wall(started_late),
    );
    offset.below = Some("initial_acceleration_missing");
    vec![
        late.of_steps(exact),
        late_acceleration.of_steps(exact).of("acceleration"),
        offset.of_steps(exact).of("walls"),
        fixed(
            "wall_acceleration_missing",
            "prescribed faces keep the velocity that they have at the start",
            unaccelerated,
        ),
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
            which: Some("walls".into()),
            ..fixed(
                "start_at_rest",
                "the initial velocity is 0, also on prescribed faces, which their acceleration moves",
                from_rest,
            )
        },
    ]
}

/// Sets the motion of another time; the start stays right.
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

/// The motion that results if an acceleration of an earlier time acts from the start.
fn accelerated_late<const D: usize>(at: &Given<'_, D>, motion: MotionPart<'_, D>) {
    let (start, late) = (at.exact.domain.time[0], at.size[0]);
    let [own, early] = [start, start - late].map(|time| moves(at, time));
    let jump = minus(&own.1, &early.1);
    let there = minus(&own.0, &early.0);
    let passed = at.time - start;
    if passed <= 0.0 {
        return;
    }
    match motion {
        MotionPart::Displacement(u) => {
            u.copy_from_slice(&at.exact.displacement(at.time - late, at.reference));
            u.iter_mut().zip(there).zip(jump).for_each(|((u, there), v)| *u += there + v * passed);
        }
        MotionPart::Velocity(v) => {
            v.copy_from_slice(&at.exact.velocity(at.time - late, at.reference));
            v.iter_mut().zip(jump).for_each(|(v, jump)| *v += jump);
        }
        MotionPart::Acceleration(a) => {
            a.copy_from_slice(&at.exact.acceleration(at.time - late, at.reference));
        }
        MotionPart::Gradient(_) => {}
    }
}

/// The motion with the constant velocity of the start.
fn unaccelerated<const D: usize>(at: &Given<'_, D>, motion: MotionPart<'_, D>) {
    let start = at.exact.domain.time[0];
    let (first, velocity) = moves(at, start);
    let passed = at.time - start;
    match motion {
        MotionPart::Displacement(u) => {
            let own = first.iter().zip(&velocity).map(|(u, v)| u + v * passed);
            u.iter_mut().zip(own).for_each(|(u, own)| *u = own);
        }
        MotionPart::Velocity(v) => v.copy_from_slice(&velocity),
        MotionPart::Acceleration(a) if passed > 0.0 => a.fill(Vector::zeros()),
        MotionPart::Acceleration(_) | MotionPart::Gradient(_) => {}
    }
}

/// The motion with an initial velocity of a later time.
fn started_late<const D: usize>(at: &Given<'_, D>, motion: MotionPart<'_, D>) {
    let start = at.exact.domain.time[0];
    let later = at.exact.velocity(start + at.size[0], at.reference);
    let added = minus(&later, &at.exact.velocity(start, at.reference));
    add_velocity(at, motion, &added);
}

/// The motion less the motion of the constant initial velocity.
fn from_rest<const D: usize>(at: &Given<'_, D>, motion: MotionPart<'_, D>) {
    let first = at.exact.velocity(at.exact.domain.time[0], at.reference);
    add_velocity(at, motion, &first.iter().map(|v| -v).collect::<Vec<_>>());
}

/// Adds the motion of a constant velocity from the start.
fn add_velocity<const D: usize>(
    at: &Given<'_, D>,
    motion: MotionPart<'_, D>,
    added: &[Vector<f64, D>],
) {
    let passed = at.time - at.exact.domain.time[0];
    match motion {
        MotionPart::Displacement(u) => {
            u.iter_mut().zip(added).for_each(|(u, added)| *u += added * passed);
        }
        MotionPart::Velocity(v) => v.iter_mut().zip(added).for_each(|(v, added)| *v += added),
        MotionPart::Acceleration(_) | MotionPart::Gradient(_) => {}
    }
}

/// u and v at a time.
fn moves<const D: usize>(
    at: &Given<'_, D>,
    time: f64,
) -> (Vec<Vector<f64, D>>, Vec<Vector<f64, D>>) {
    (at.exact.displacement(time, at.reference), at.exact.velocity(time, at.reference))
}

fn minus<const D: usize>(a: &[Vector<f64, D>], b: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
