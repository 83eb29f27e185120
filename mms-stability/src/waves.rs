//! Short waves within the body: strong ellipticity, sampled.

use nalgebra::SVector;

use crate::chart::components;
use crate::least::least;
use crate::subject::{State, Subject};

/// The number of places along each axis that are tested first, by dimension.
const PLACES: [usize; 3] = [9, 6, 3];
/// The number of times that are tested first.
const TIMES: usize = 7;
/// The number of directions along each angle that are tested first.
const ANGLES: usize = 7;

/// The least sampled eigenvalue of the acoustic tensor over body, window and directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    /// The eigenvalue over the modulus at rest.
    pub least: f64,
    /// X.
    pub at: Vec<f64>,
    /// t.
    pub time: f64,
    /// N.
    pub direction: Vec<f64>,
}

/// A cache of the last state and its place: directions are tried one after another at one state.
pub(crate) struct Recent<const D: usize> {
    fractions: Vec<f64>,
    state: Option<State<D>>,
}

impl<const D: usize> Recent<D> {
    pub(crate) fn new() -> Self {
        Recent { fractions: Vec::new(), state: None }
    }

    /// The state at fractions of the body and of the window.
    pub(crate) fn state(
        &mut self,
        subject: &mut Subject<'_, D>,
        place: &[f64; D],
        time: f64,
    ) -> Option<&State<D>> {
        let fractions = [&place[..], &[time]].concat();
        if self.fractions != fractions {
            self.state = subject.state(&subject.chart.place(place), subject.time(time));
            self.fractions = fractions;
        }
        self.state.as_ref()
    }
}

/// Searches for the least eigenvalue of the acoustic tensor. `None` if no state has a finite one.
pub fn waves<const D: usize>(subject: &mut Subject<'_, D>) -> Option<Waves> {
    let times = if subject.is_static { 2 } else { TIMES };
    let counts = [&[PLACES[D - 1]; D][..], &[times], &vec![ANGLES; D - 1]].concat();
    let mut recent = Recent::new();
    let found = least(&counts, |fractions| {
        let place = std::array::from_fn(|axis| fractions[axis]);
        let state = recent.state(subject, &place, fractions[D])?;
        Some(state.elasticity.least_acoustic(&direction(&fractions[D + 1..])) / state.modulus)
    })?;
    let place: [f64; D] = std::array::from_fn(|axis| found.at[axis]);
    Some(Waves {
        least: found.value,
        at: components(&subject.chart.place(&place)),
        time: subject.time(found.at[D]),
        direction: components(&direction::<D>(&found.at[D + 1..])),
    })
}

/// A unit vector: half a turn of the first angle, and half a turn of the second, reach all directions up to the sign.
fn direction<const D: usize>(angles: &[f64]) -> SVector<f64, D> {
    let [turn, rise] = [0, 1].map(|at| std::f64::consts::PI * angles.get(at).unwrap_or(&0.0));
    let flat = if D == 3 { rise.cos() } else { 1.0 };
    SVector::from_fn(|axis, _| [turn.cos() * flat, turn.sin() * flat, rise.sin()][axis])
}
