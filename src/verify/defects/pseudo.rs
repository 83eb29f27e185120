//! "Pseudo verification": how runs are looked at where no exact solution is known, or where its picture alone is.
//!
//! The checks are those of Wallstedt, Guilkey, slide "Pseudo Verification": plausibility, symmetry, and what goes
//! with them: the balance of energy, and a motion that settles on finer grids. They are real checks, of the runs
//! that rows judge. How far they go is what people mean by them, not what could be made of them.

use std::collections::HashMap;

use mms_runtime::Division;
use mms_runtime::study::{Frame, Observer, Watch};
use serde::{Deserialize, Serialize};

use super::super::plan::Job;
use super::super::work::{Bench, Fields, Outcome, outcome};
use crate::cli::method::Precision;
use crate::scene::{Scene, Solvable};

/// How often a run is looked at, the end included.
const LOOKS: usize = 4;

/// A check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// Beside the picture of the exact solution it looks like it: u is off by less than a tenth.
    Picture,
    /// The run ends, and nothing moves further than the body is long.
    Bounded,
    /// A motion that is its own mirror image stays it, to a millionth.
    Symmetric,
    /// The energy is that which b has put in, to a twentieth.
    Energy,
    /// Half the cell size changes the size of the motion by less than a twentieth.
    Settles,
}

impl Check {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Check::Picture, Check::Bounded, Check::Symmetric, Check::Energy, Check::Settles];

    /// The name in tables and documents.
    pub fn name(self) -> &'static str {
        match self {
            Check::Picture => "picture",
            Check::Bounded => "bounded",
            Check::Symmetric => "symmetric",
            Check::Energy => "energy",
            Check::Settles => "settles",
        }
    }

    /// Whether it objects to the levels of a row, coarse to fine; nothing, if it cannot tell.
    fn objects(self, levels: &[&Watched]) -> Option<bool> {
        let seen: Vec<&Seen> = levels.iter().filter_map(|level| level.seen.as_ref()).collect();
        let all_ended = seen.len() == levels.len();
        let above = |value: f64, most: f64| value.is_nan() || value > most;
        if self == Check::Bounded {
            let fled = |seen: &&Seen| above(seen.largest, seen.extent);
            return Some(!all_ended || seen.iter().any(fled));
        }
        let finest = seen.last().filter(|_| all_ended)?;
        match self {
            Check::Bounded => None,
            Check::Picture => Some(above(finest.misfit, 0.1)),
            Check::Symmetric => {
                let worst = seen.iter().filter_map(|seen| seen.asymmetry).reduce(f64::max)?;
                Some(above(worst, 1e-6))
            }
            Check::Energy => finest.energy.map(|energy| above(energy, 0.05)),
            Check::Settles => {
                let [.., coarse, fine] = seen[..] else { return None };
                Some(above((fine.motion / coarse.motion - 1.0).abs(), 0.05))
            }
        }
    }
}

/// Which checks object to a row, in the order of [`Check::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks(pub [Option<bool>; Check::ALL.len()]);

impl Looks {
    /// Of the levels of a row, coarse to fine.
    pub fn of(levels: &[&Watched]) -> Self {
        Looks(Check::ALL.map(|check| check.objects(levels)))
    }

    /// What these say of a defect, where `without` it they had no objection.
    pub fn beside(self, without: Self) -> Self {
        let fair = |at: usize| if without.0[at] == Some(false) { self.0[at] } else { None };
        Looks(std::array::from_fn(fair))
    }

    /// The objections of either.
    pub fn or(self, other: Self) -> Self {
        let either = |at: usize| match (self.0[at], other.0[at]) {
            (Some(one), Some(another)) => Some(one || another),
            (one, another) => one.or(another),
        };
        Looks(std::array::from_fn(either))
    }
}

/// A run, and what is to be seen of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Watched {
    /// What the row judges.
    pub outcome: Outcome,
    /// What people look at; of a run that did not end, nothing.
    pub seen: Option<Seen>,
}

impl AsRef<Outcome> for Watched {
    fn as_ref(&self) -> &Outcome {
        &self.outcome
    }
}

/// What people look at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seen {
    /// The largest component of a displacement.
    largest: f64,
    /// The longest edge of the box around the particles at rest.
    extent: f64,
    /// The root mean square of all displacements.
    motion: f64,
    /// The same of their errors, over that of the field's displacements; 0 where the field rests.
    misfit: f64,
    /// How far displacements are from their mirror images, over the field's largest, if the field has a symmetry.
    asymmetry: Option<f64>,
    /// What is left of the energy when the work of b is taken off, over the energy.
    energy: Option<f64>,
}

/// Makes runs and looks at them.
pub struct Eyes {
    /// Where fields are.
    pub fields: Fields,
}

impl Bench for Eyes {
    type Result = Watched;

    fn run(
        &self,
        job: &Job,
        step: &mut (dyn FnMut(usize, usize) + Send),
    ) -> anyhow::Result<Watched> {
        let input = self.fields.input(job)?;
        let set = &job.study.set;
        Ok(match job.study.method.precision {
            Precision::F32 => look(job, &input.scene(set, |entry| entry.single)?, step),
            Precision::F64 => look(job, &input.scene(set, |entry| entry.double)?, step),
        })
    }
}

fn look<T: Solvable>(
    job: &Job,
    scene: &Scene<T>,
    step: &mut (dyn FnMut(usize, usize) + Send),
) -> Watched {
    let mut album = Album { step, frames: Vec::new() };
    let cells: &Division = &job.study.cells[0];
    let run = match scene.run(&job.method, cells, Watch::Everything, &mut album) {
        Ok(run) => run,
        Err(refusal) => {
            let outcome = Outcome::Refused { reason: refusal.to_string() };
            return Watched { outcome, seen: None };
        }
    };
    let outcome = outcome(&run.level, run.details.as_ref(), &job.quantity);
    let balance = run.details.and_then(|details| details.diagnostics.balance);
    let energy = balance.and_then(|balance| {
        let energy = balance.kinetic_energy + balance.strain_energy?;
        let put_in = balance.body_work.abs().max(energy);
        Some(balance.energy_residual?.abs() / put_in)
    });
    let seen = outcome.norms().map(|_| Seen { energy, ..Seen::of(&album.frames) });
    Watched { outcome, seen }
}

/// Some states of a run.
struct Album<'a> {
    step: &'a mut (dyn FnMut(usize, usize) + Send),
    frames: Vec<Frame>,
}

impl Observer for Album<'_> {
    fn step(&mut self, step: usize, steps: usize) {
        (self.step)(step, steps);
    }

    fn wants(&self, step: usize, steps: usize) -> bool {
        step == steps || step > 0 && step % steps.div_ceil(LOOKS) == 0
    }

    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        self.frames.push(frame.clone());
        Ok(())
    }
}

impl Seen {
    fn of(frames: &[Frame]) -> Self {
        let all = |of: fn(&Frame) -> Vec<f64>| frames.iter().flat_map(of);
        let mean_square = |of: fn(&Frame) -> Vec<f64>| {
            let (sum, count) = all(of).fold((0.0, 0), |(sum, n), x| (sum + x * x, n + 1));
            f64::sqrt(sum / f64::from(count.max(1)))
        };
        let displacement = |frame: &Frame| frame.displacement.clone();
        let extent = frames.first().map_or(0.0, |frame| {
            let boxes = bounds(frame);
            boxes.iter().fold(0.0, |most, [least, greatest]| f64::max(most, greatest - least))
        });
        let exact = mean_square(field);
        let error = mean_square(|frame| frame.displacement_error.clone());
        Seen {
            largest: all(displacement).fold(0.0, |most, x| f64::max(most, x.abs())),
            extent,
            motion: mean_square(displacement),
            misfit: if exact > 0.0 { error / exact } else { 0.0 },
            asymmetry: frames.iter().filter_map(asymmetry).reduce(f64::max),
            energy: None,
        }
    }
}

/// u of the field.
fn field(frame: &Frame) -> Vec<f64> {
    let pairs = frame.displacement.iter().zip(&frame.displacement_error);
    pairs.map(|(d, error)| d - error).collect()
}

/// X.
fn reference(frame: &Frame) -> Vec<f64> {
    frame.position.iter().zip(&frame.displacement).map(|(x, d)| x - d).collect()
}

/// The least and the greatest X along each axis.
fn bounds(frame: &Frame) -> Vec<[f64; 2]> {
    let reference = reference(frame);
    let along = |a: usize| reference.iter().skip(a).step_by(frame.dimension);
    let both = |a: usize| {
        along(a).fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], &x| {
            [least.min(x), greatest.max(x)]
        })
    };
    (0..frame.dimension).map(both).collect()
}

/// How far displacements are from their images in the middle planes of the body, over the field's largest; nothing,
/// if neither the field nor the particles are their own images.
fn asymmetry(frame: &Frame) -> Option<f64> {
    let (dimension, bounds) = (frame.dimension, bounds(frame));
    let (reference, exact) = (reference(frame), field(frame));
    let largest = exact.iter().fold(0.0, |most, u| f64::max(most, u.abs()));
    let length =
        bounds.iter().fold(0.0, |most, [least, greatest]| f64::max(most, greatest - least));
    if largest == 0.0 || length == 0.0 {
        return None;
    }
    let place = |point: &[f64]| -> Vec<i64> {
        point.iter().map(|x| (x / length * 1e6).round() as i64).collect()
    };
    let particles: HashMap<Vec<i64>, usize> =
        reference.chunks(dimension).enumerate().map(|(p, point)| (place(point), p)).collect();
    let of_axis = |axis: usize| -> Option<f64> {
        let middle: f64 = bounds[axis].iter().sum();
        let (mut of_field, mut of_run) = (0.0, 0.0);
        for (p, point) in reference.chunks(dimension).enumerate() {
            let mut image = point.to_vec();
            image[axis] = middle - image[axis];
            let twin = *particles.get(&place(&image))?;
            for a in 0..dimension {
                let sign = if a == axis { -1.0 } else { 1.0 };
                let apart =
                    |u: &[f64]| (u[p * dimension + a] - sign * u[twin * dimension + a]).abs();
                of_field = f64::max(of_field, apart(&exact));
                of_run = f64::max(of_run, apart(&frame.displacement));
            }
        }
        (of_field < 1e-9 * largest).then_some(of_run / largest)
    };
    (0..dimension).filter_map(of_axis).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four particles on a line, the inner two of which are `off` by as much to the right.
    fn frame(displacement: [f64; 4], off: f64) -> Frame {
        let reference = [0.125, 0.375, 0.625, 0.875];
        let displacement_error = vec![0.0, off, off, 0.0];
        let displacement: Vec<f64> =
            displacement.iter().zip(&displacement_error).map(|(u, e)| u + e).collect();
        Frame {
            step: 1,
            time: 0.0,
            dimension: 1,
            position: reference.iter().zip(&displacement).map(|(x, d)| x + d).collect(),
            displacement,
            displacement_error,
            velocity: vec![0.0; 4],
            deformation_gradient: vec![1.0; 4],
            cauchy_stress: vec![0.0; 4],
        }
    }

    fn watched(seen: Option<Seen>) -> Watched {
        Watched { outcome: Outcome::Refused { reason: String::new() }, seen }
    }

    #[test]
    fn a_motion_that_is_its_image_is_held_to_it() {
        let symmetric = [-0.2, -0.1, 0.1, 0.2];
        assert!(asymmetry(&frame(symmetric, 0.0)).unwrap() < 1e-12);
        let off = asymmetry(&frame(symmetric, 0.01)).unwrap();
        assert!((off - 0.1).abs() < 1e-12, "2 x 0.01 over 0.2: {off}");
        assert_eq!(asymmetry(&frame([0.1; 4], 0.01)), None, "a translation has no image");
        assert_eq!(asymmetry(&frame([0.0; 4], 0.01)), None, "rest has no size");
    }

    #[test]
    fn numbers_of_a_run_are_those_on_paper() {
        let seen = Seen::of(&[frame([-0.2, -0.1, 0.1, 0.2], 0.1)]);
        assert!((seen.largest - 0.2).abs() < 1e-12 && (seen.extent - 0.75).abs() < 1e-12);
        assert!((seen.motion - f64::sqrt((0.04 + 0.04 + 0.04) / 4.0)).abs() < 1e-12);
        assert!((seen.misfit - f64::sqrt(0.02 / 0.1)).abs() < 1e-12);
    }

    #[test]
    fn checks_object_to_what_they_look_at() {
        let fine = Seen {
            largest: 0.1,
            extent: 1.0,
            motion: 0.05,
            misfit: 0.01,
            asymmetry: Some(1e-9),
            energy: Some(0.01),
        };
        let levels = |last: Option<Seen>| [watched(Some(fine.clone())), watched(last)];
        let looks = |last: Option<Seen>| {
            let levels = levels(last);
            Looks::of(&[&levels[0], &levels[1]]).0
        };
        let none = Some(false);
        assert_eq!(looks(Some(fine.clone())), [none; 5]);
        let objected = |at: usize, seen: Seen| {
            let found = looks(Some(seen));
            let wanted = std::array::from_fn(|k| if k == at { Some(true) } else { none });
            assert_eq!(found, wanted, "{at}");
        };
        objected(0, Seen { misfit: 0.2, ..fine.clone() });
        objected(1, Seen { largest: f64::NAN, ..fine.clone() });
        objected(2, Seen { asymmetry: Some(1e-3), ..fine.clone() });
        objected(3, Seen { energy: Some(0.1), ..fine.clone() });
        objected(4, Seen { motion: 0.06, ..fine.clone() });
        assert_eq!(looks(None), [None, Some(true), None, None, None]);
        let nothing = [watched(None), watched(None)];
        let stopped = Looks::of(&[&nothing[0], &nothing[1]]);
        assert_eq!(stopped.0, [None, Some(true), None, None, None]);
        // What objects without the defect says nothing of it.
        let unfair = Looks([Some(true); 5]).beside(stopped);
        assert_eq!(unfair, Looks([None; 5]));
    }
}
