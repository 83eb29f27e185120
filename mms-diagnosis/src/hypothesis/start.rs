//! Mistakes in the initial state.

use mms_runtime::{Matrix, Vector};

use super::{Change, Hypothesis, MotionPart};
use crate::exact::Exact;

pub(super) fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    let mut offset = Hypothesis::amount(
        "start_half_step",
        "the initial velocity belongs to a later time; the size is the delay",
        vec![exact.time_step / 2.0],
        Change::Start(|at, initial| {
            if let MotionPart::Velocity(v) = initial {
                v.copy_from_slice(&at.exact.velocity(at.time + at.size[0], at.reference));
            }
        }),
    );
    offset.below = Some("initial_acceleration_missing");
    let offset = offset.within([-2.0 * exact.time_step, 2.0 * exact.time_step]).of_mesh();
    vec![
        Hypothesis::fixed(
            "start_at_rest",
            "the initial velocity is 0",
            Change::Start(|_, initial| {
                if let MotionPart::Velocity(v) = initial {
                    v.fill(Vector::zeros());
                }
            }),
        ),
        Hypothesis::fixed(
            "start_undeformed",
            "F is I at the start",
            Change::Start(|_, initial| {
                if let MotionPart::Gradient(h) = initial {
                    h.fill(Matrix::zeros());
                }
            }),
        ),
        Hypothesis {
            which: Some("u".into()),
            ..Hypothesis::fixed(
                "start_undeformed",
                "u is 0 and F is I at the start",
                Change::Start(|_, initial| match initial {
                    MotionPart::Displacement(u) => u.fill(Vector::zeros()),
                    MotionPart::Gradient(h) => h.fill(Matrix::zeros()),
                    MotionPart::Velocity(_) | MotionPart::Acceleration(_) => {}
                }),
            )
        },
        offset,
    ]
}
