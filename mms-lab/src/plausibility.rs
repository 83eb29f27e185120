//! "Pseudo verification": checks of runs for which no exact solution is known, or only its picture.
//!
//! The checks are from Wallstedt, Guilkey, slide "Pseudo Verification": plausibility, symmetry, and related ones. They check
//! the same runs that rows judge. Their thresholds are common practice, not the sharpest ones possible. An objection to a
//! defect counts only if the check has no objection without the defect:
//!
//! | check | objects if |
//! |---|---|
//! | `picture` | on the finest grid u is off by a tenth, in root mean square over four times |
//! | `bounded` | a run stops, or a displacement exceeds the length of the body |
//! | `symmetric` | a motion that is its own image in a middle plane is off it by a millionth |
//! | `energy` | kinetic and strain energy differ from the work of b by a twentieth; on the coarsest grid |
//! | `settles` | the two finest grids differ by a twentieth in the size of the motion |

use std::collections::HashMap;

use mms_runtime::study::Frame;
use serde::{Deserialize, Serialize};

/// A check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// The picture looks like the picture of the exact solution: u is off by less than 1/10.
    Picture,
    /// The run ends, and no displacement exceeds the length of the body.
    Bounded,
    /// A motion that is its own mirror image stays so, to 1e-6.
    Symmetric,
    /// The energy equals the work of b, to 1/20, on the coarsest grid.
    Energy,
    /// Half the cell size changes the size of the motion by less than 1/20.
    Settles,
}

impl Check {
    /// All checks.
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

    /// Whether the check objects to the levels of a row, coarse to fine; `None`, if it cannot decide.
    fn objects(self, levels: &[Option<&Observed>]) -> Option<bool> {
        let seen: Vec<&Observed> = levels.iter().copied().flatten().collect();
        let all_ended = seen.len() == levels.len();
        let above = |value: f64, most: f64| value.is_nan() || value > most;
        if self == Check::Bounded {
            let fled = |seen: &&Observed| above(seen.largest, seen.extent);
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
            Check::Energy => seen[0].energy.map(|energy| above(energy, 0.05)),
            Check::Settles => {
                let [.., coarse, fine] = seen[..] else { return None };
                Some(above((fine.motion / coarse.motion - 1.0).abs(), 0.05))
            }
        }
    }
}

/// The objections of the checks to a row, in the order of [`Check::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Objections(pub [Option<bool>; Check::ALL.len()]);

impl Objections {
    /// The objections to the levels of a row, coarse to fine; a level that did not end shows nothing.
    pub fn of(levels: &[Option<&Observed>]) -> Self {
        Objections(Check::ALL.map(|check| check.objects(levels)))
    }

    /// The objections to a defect, of the checks that had no objection `without` it.
    pub fn not_in(self, without: Self) -> Self {
        let fair = |at: usize| if without.0[at] == Some(false) { self.0[at] } else { None };
        Objections(std::array::from_fn(fair))
    }

    /// The objections of either row: a check objects if it objects to one of them.
    pub fn or(self, other: Self) -> Self {
        let either = |at: usize| match (self.0[at], other.0[at]) {
            (Some(one), Some(another)) => Some(one || another),
            (one, another) => one.or(another),
        };
        Objections(std::array::from_fn(either))
    }
}

/// The data that people look at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Observed {
    /// The largest component of a displacement.
    largest: f64,
    /// The longest edge of the box around the particles at rest.
    extent: f64,
    /// The root mean square of all displacements.
    motion: f64,
    /// The root mean square of the errors of all displacements, divided by the root mean square of the field's displacements; 0
    /// where the field rests.
    misfit: f64,
    /// The largest difference of displacements from their mirror images, divided by the field's largest displacement, if the
    /// field has a symmetry.
    asymmetry: Option<f64>,
    /// The energy minus the work of b, divided by the energy.
    energy: Option<f64>,
}

impl Observed {
    /// The data of some states of a run, and of its energy residual.
    pub fn of(frames: &[Frame], energy: Option<f64>) -> Self {
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
        let size = all(field).fold(0.0, |most, u| f64::max(most, u.abs()));
        let error = mean_square(|frame| frame.displacement_error.clone());
        Observed {
            largest: all(displacement).fold(0.0, |most, x| f64::max(most, x.abs())),
            extent,
            motion: mean_square(displacement),
            misfit: if exact > 0.0 { error / exact } else { 0.0 },
            asymmetry: frames.iter().filter_map(|it| asymmetry(it, size)).reduce(f64::max),
            energy,
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

/// The largest difference of displacements from their images in the middle planes of the body, divided by the size of the
/// field's displacements; `None`, if the field or the particles are not their own images.
fn asymmetry(frame: &Frame, size: f64) -> Option<f64> {
    let (dimension, bounds) = (frame.dimension, bounds(frame));
    let (reference, exact) = (reference(frame), field(frame));
    let length =
        bounds.iter().fold(0.0, |most, [least, greatest]| f64::max(most, greatest - least));
    if size == 0.0 || length == 0.0 {
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
        (of_field < 1e-9 * size).then_some(of_run / size)
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
            hoop_stretch: Vec::new(),
            hoop_stress: Vec::new(),
        }
    }

    #[test]
    fn a_motion_that_is_its_image_is_held_to_it() {
        let symmetric = [-0.2, -0.1, 0.1, 0.2];
        assert!(asymmetry(&frame(symmetric, 0.0), 0.2).unwrap() < 1e-12);
        let off = asymmetry(&frame(symmetric, 0.01), 0.2).unwrap();
        assert!((off - 0.1).abs() < 1e-12, "2 x 0.01 over 0.2: {off}");
        assert_eq!(asymmetry(&frame([0.1; 4], 0.01), 0.1), None, "a translation has no image");
        assert_eq!(asymmetry(&frame([0.0; 4], 0.01), 0.0), None, "rest has no size");
    }

    #[test]
    fn numbers_of_a_run_are_those_on_paper() {
        let seen = Observed::of(&[frame([-0.2, -0.1, 0.1, 0.2], 0.1)], None);
        assert!((seen.largest - 0.2).abs() < 1e-12 && (seen.extent - 0.75).abs() < 1e-12);
        assert!((seen.motion - f64::sqrt((0.04 + 0.04 + 0.04) / 4.0)).abs() < 1e-12);
        assert!((seen.misfit - f64::sqrt(0.02 / 0.1)).abs() < 1e-12);
    }

    #[test]
    fn checks_object_to_what_they_look_at() {
        let fine = Observed {
            largest: 0.1,
            extent: 1.0,
            motion: 0.05,
            misfit: 0.01,
            asymmetry: Some(1e-9),
            energy: Some(0.01),
        };
        let looks = |last: Option<Observed>| Objections::of(&[Some(&fine), last.as_ref()]).0;
        let none = Some(false);
        assert_eq!(looks(Some(fine.clone())), [none; 5]);
        let objected = |at: usize, seen: Observed| {
            let found = looks(Some(seen));
            let wanted = std::array::from_fn(|k| if k == at { Some(true) } else { none });
            assert_eq!(found, wanted, "{at}");
        };
        objected(0, Observed { misfit: 0.2, ..fine.clone() });
        objected(1, Observed { largest: f64::NAN, ..fine.clone() });
        objected(2, Observed { asymmetry: Some(1e-3), ..fine.clone() });
        objected(4, Observed { motion: 0.06, ..fine.clone() });
        let weighed = Observed { energy: Some(0.1), ..fine.clone() };
        assert_eq!(Objections::of(&[Some(&weighed), Some(&fine)]).0[3], Some(true));
        assert_eq!(looks(None), [None, Some(true), None, None, None]);
        let stopped = Objections::of(&[None, None]);
        assert_eq!(stopped.0, [None, Some(true), None, None, None]);
        // An objection without the defect is no evidence.
        let unfair = Objections([Some(true); 5]).not_in(stopped);
        assert_eq!(unfair, Objections([None; 5]));
        assert_eq!(unfair.or(stopped), stopped);
        assert_eq!(Objections([Some(false); 5]).or(stopped).0[1], Some(true));
        assert_eq!(Check::ALL.map(Check::name)[1], "bounded");
    }
}
