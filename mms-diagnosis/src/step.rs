//! Velocities after one small step, as the mean acceleration in it.

use mms_runtime::Vector;

use crate::changed::Without;
use crate::evidence::Mesh;
use crate::exact::{Exact, Quantity, numbers, vectors};
use crate::state::{Computed, Response};

/// Computes accelerations from velocities of the finest mesh, if no wave has crossed a cell since the start.
pub fn response<const D: usize>(
    exact: &Exact<'_, D>,
    meshes: &[Mesh],
    without: Without,
) -> Option<Response> {
    let mesh = meshes.last()?;
    let [snapshot] = mesh.snapshots.as_slice() else { return None };
    let start = exact.domain.time[0];
    let step = snapshot.time - start;
    if step <= 0.0 || step * exact.wave_speed() > mesh.cell_size {
        return None;
    }
    let (_, v) = snapshot.values.iter().find(|(it, _)| *it == Quantity::Velocity)?;
    let x: Vec<Vector<f64, D>> = vectors(&snapshot.reference);
    let right = numbers(&exact.velocity(snapshot.time, &x));
    let now = numbers(&exact.acceleration(start, &x));
    // The error of the velocity arose within the step.
    let pairs = v.iter().zip(right).zip(now);
    let values = pairs.map(|((v, right), now)| now + (v - right) / step).collect();
    Some(Response {
        computed: Computed::Acceleration,
        time: start,
        reference: snapshot.reference.clone(),
        values,
        volumes: snapshot.volumes.clone(),
        degree: snapshot.degree,
        without,
        step: Some(step),
    })
}
