//! The state that a run starts from.

use crate::failure::{at_most, positive};
use crate::particle::Particles;
use crate::tensor::{components, is_finite, matrix_is_finite};
use crate::{ManufacturedField, Real, Refusal, Vector};

/// More steps than this are refused.
const STEP_LIMIT: f64 = u32::MAX as f64;

/// At how many times, at most, the field's motion is sampled to find the extent of the grid.
const MOTION_SAMPLES: usize = 64;

/// Times are computed from the step number, never accumulated.
pub(super) struct Clock {
    pub start: f64,
    pub time_step: f64,
    pub steps: usize,
    pub step: usize,
}

impl Clock {
    pub fn new(
        window: [f64; 2],
        courant: f64,
        cell_size: f64,
        speed: f64,
    ) -> Result<Self, Refusal> {
        let duration = positive("the length of the time window", window[1] - window[0])?;
        let target = positive("the time step", courant * cell_size / speed)?;
        // Round-off must not add a step to a duration of a whole number of steps.
        let steps = (duration / target * (1.0 - 1e-6)).ceil().max(1.0);
        at_most("steps", steps, STEP_LIMIT)?;
        Ok(Self { start: window[0], time_step: duration / steps, steps: steps as usize, step: 0 })
    }

    pub fn time_of(&self, step: usize) -> f64 {
        self.start + step as f64 * self.time_step
    }
}

/// c0, the largest over the particles.
pub(super) fn largest_wave_speed<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    particles: &Particles<T, D>,
) -> Result<f64, Refusal> {
    let mut speed = vec![T::zero(); particles.len()];
    field.wave_speed(&particles.reference_position, &mut speed);
    let mut largest = 0.0;
    for speed in speed {
        largest = positive("the wave speed", speed.to_f64())?.max(largest);
    }
    Ok(largest)
}

/// The smallest and the largest coordinates that the field moves a particle to.
pub(super) fn extent_of_motion<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    particles: &mut Particles<T, D>,
    clock: &Clock,
) -> Result<[[f64; D]; 2], Refusal> {
    let mut extent = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    let samples = clock.steps.min(MOTION_SAMPLES);
    for sample in 0..=samples {
        let fraction = sample as f64 / samples as f64;
        let time = T::of(clock.start + fraction * clock.time_step * clock.steps as f64);
        let reference = &particles.reference_position;
        field.displacement(time, reference, &mut particles.displacement);
        finite_vectors("displacement", time, reference, &particles.displacement)?;
        for p in 0..particles.len() {
            let position = particles.position(p);
            for a in 0..D {
                extent[0][a] = extent[0][a].min(position[a].to_f64());
                extent[1][a] = extent[1][a].max(position[a].to_f64());
            }
        }
    }
    Ok(extent)
}

/// Mass, displacement, velocity, H and stress at the time `start`.
pub(super) fn initialise<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    particles: &mut Particles<T, D>,
    start: T,
) -> Result<(), Refusal> {
    let reference = &particles.reference_position;
    field.density(reference, &mut particles.mass);
    for (mass, &volume) in particles.mass.iter_mut().zip(&particles.reference_volume) {
        positive("the density", mass.to_f64())?;
        *mass *= volume;
        positive("the mass of a particle", mass.to_f64())?;
    }
    field.displacement(start, reference, &mut particles.displacement);
    field.velocity(start, reference, &mut particles.velocity);
    finite_vectors("velocity", start, reference, &particles.velocity)?;
    field.displacement_gradient(start, reference, &mut particles.displacement_gradient);
    let mut gradients = particles.displacement_gradient.iter();
    let odd = gradients.position(|h| !matrix_is_finite(h));
    refuse_at("displacement gradient", start, reference, odd)?;
    field.kirchhoff_stress(
        reference,
        &particles.displacement_gradient,
        &mut particles.kirchhoff_stress,
    );
    Ok(())
}

fn finite_vectors<T: Real, const D: usize>(
    quantity: &'static str,
    time: T,
    reference: &[Vector<T, D>],
    values: &[Vector<T, D>],
) -> Result<(), Refusal> {
    refuse_at(quantity, time, reference, values.iter().position(|value| !is_finite(value)))
}

fn refuse_at<T: Real, const D: usize>(
    quantity: &'static str,
    time: T,
    reference: &[Vector<T, D>],
    odd: Option<usize>,
) -> Result<(), Refusal> {
    odd.map_or(Ok(()), |p| {
        Err(Refusal::FieldNotFinite {
            quantity,
            time: time.to_f64(),
            reference_position: components(&reference[p]),
        })
    })
}
