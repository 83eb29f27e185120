//! The state of a solver, from which a resumed run computes the same bits as an uninterrupted run.
//!
//! It contains the data that change and do not follow from the scene: the particles' state in the order in which they are added
//! to the nodes (sums depend on it), the ends of slabs, the step, and the lag of velocities. Data that follow from the scene
//! alone, or from the state at the beginning of every step, are recomputed.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::Solver;
use super::clock::Seconds;
use super::slabs::Cut;
use crate::failure::Refusal;
use crate::real::{Matrix, Real, Vector};

/// The data that change in a run: a solver of the same scene resumes from them, to the bit.
#[derive(Serialize, Deserialize)]
#[serde(bound = "T: Real")]
pub struct State<'a, T: Real, const D: usize> {
    /// The number of completed steps.
    step: usize,
    /// The number of time steps by which velocities are behind.
    lag: f64,
    /// The particles' numbers, in their order.
    id: Cow<'a, [u32]>,
    displacement: Vec<Vector<T, D>>,
    velocity: Vec<Vector<T, D>>,
    displacement_gradient: Vec<Matrix<T, D>>,
    /// The hoop strains; empty unless the body is a body of revolution.
    hoop_strain: Cow<'a, [T]>,
    /// C, with APIC only.
    affine: Vec<Matrix<T, D>>,
    /// The cuts between slabs.
    cuts: Cow<'a, [Cut]>,
    seconds: Seconds,
}

impl<T: Real, const D: usize, F: ?Sized> Solver<'_, T, D, F> {
    /// The state after the last step.
    pub fn state(&self) -> State<'_, T, D> {
        let particles = &self.particles;
        State {
            step: self.clock.step,
            lag: self.clock.lag,
            id: Cow::from(&*particles.id),
            displacement: particles.displacement.iter().collect(),
            velocity: particles.velocity.iter().collect(),
            displacement_gradient: particles.displacement_gradient.iter().collect(),
            hoop_strain: Cow::from(&*particles.hoop_strain),
            affine: particles.affine.iter().collect(),
            cuts: Cow::from(self.slabs.cuts()),
            seconds: self.seconds,
        }
    }

    /// Resumes from a state of the same scene.
    ///
    /// # Errors
    /// The state is of another scene.
    pub fn restore(&mut self, state: State<'_, T, D>) -> Result<(), Refusal> {
        let fits = |fits: bool, what: &str| match fits {
            true => Ok(()),
            false => Err(Refusal::NoState { reason: format!("it has other {what}") }),
        };
        let count = self.particles.len();
        fits(state.step <= self.clock.steps, "steps")?;
        let lengths =
            [state.displacement.len(), state.velocity.len(), state.displacement_gradient.len()];
        let orders = !self.slabs.order.is_fixed() || state.id.is_sorted();
        fits(lengths == [count; 3] && is_order(&state.id, count) && orders, "particles")?;
        fits(state.hoop_strain.len() == self.particles.hoop_strain.len(), "axes")?;
        fits(state.affine.len() == self.particles.affine.len(), "transfers")?;
        fits(self.slabs.accept(&state.cuts, count), "slabs")?;
        let mut order: Vec<u32> =
            state.id.iter().map(|&id| self.slabs.order.place_of(id as usize) as u32).collect();
        self.domains.reorder(&mut order);
        self.particles.reorder(&mut order);
        self.slabs.order.place_ids(&self.particles.id);
        self.particles.displacement = state.displacement.into_iter().collect();
        self.particles.velocity = state.velocity.into_iter().collect();
        self.particles.displacement_gradient = state.displacement_gradient.into_iter().collect();
        self.particles.hoop_strain = state.hoop_strain.into_owned().into();
        self.particles.affine = state.affine.into_iter().collect();
        (self.clock.step, self.clock.lag) = (state.step, state.lag);
        self.seconds = state.seconds;
        Ok(())
    }
}

/// Whether `ids` has every number below `count` once.
fn is_order(ids: &[u32], count: usize) -> bool {
    let mut seen = vec![false; count];
    let fresh =
        |&id: &u32| seen.get_mut(id as usize).is_some_and(|seen| !std::mem::replace(seen, true));
    ids.len() == count && ids.iter().all(fresh)
}

#[cfg(test)]
mod tests {
    use super::is_order;

    #[test]
    fn an_order_has_every_number_once() {
        assert!(is_order(&[2, 0, 1], 3));
        for ids in [&[0, 1][..], &[0, 1, 1], &[0, 1, 3], &[0, 1, 2, 3]] {
            assert!(!is_order(ids, 3), "{ids:?}");
        }
    }
}
