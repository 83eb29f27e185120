//! The user's meshes that are compared, and our own runs on grids of about their size.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use mms_runtime::Method;
use mms_runtime::study::Solve;

use crate::changed::Without;
use crate::evidence::{ComparisonFrame, ErrorCoefficients, Mesh, Sight};
use crate::exact::Exact;
use crate::follow::Follow;
use crate::hypothesis::{Change, Hypothesis};
use crate::run::{Obstacle, Responses, SolverRuns, written};
use crate::smooth::{less, size};
use crate::statics::{Equilibrium, Statics};

/// The least ratio of cell sizes of two meshes that count as refined.
const REFINED: f64 = 1.2;
/// The most steps times particles of one run: some seconds.
pub const MOST_WORK: f64 = 3e6;
/// The weight of the part of an error that falls with h^2, where two meshes separate it from the rest.
const FALLING: f64 = 0.25;

/// One of the user's meshes.
pub struct MeshLevel<'a, const D: usize> {
    /// The results.
    pub mesh: &'a Mesh,
    /// The fit of errors at their points.
    sight: Sight<'a, D>,
    /// The errors of the results.
    pub seen: ErrorCoefficients,
    /// The solvers whose errors are compared with the mesh's errors.
    pub solvers: Box<dyn Responses<'a, D> + 'a>,
    /// The errors of right methods; `None` for a method that stops.
    right: Vec<Option<Vec<f64>>>,
}

/// The errors that right methods make.
fn of_methods<const D: usize>(
    sight: &Sight<'_, D>,
    solvers: &dyn Responses<'_, D>,
    follow: &dyn Follow,
) -> Result<Vec<Option<Vec<f64>>>, Obstacle> {
    let right = |method| Some(sight.see(&solvers.right(method)?)?.coefficients);
    let says = format!("right method on cells of {:.3e}", solvers.cell_size());
    on_all_processors(solvers.methods(), (&says, follow), right)
}

impl<'a, const D: usize> MeshLevel<'a, D> {
    fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a ComparisonFrame<D>,
        mesh: &'a Mesh,
        solvers: Box<dyn Responses<'a, D> + 'a>,
    ) -> Result<Self, Obstacle> {
        let sight = frame.sight(mesh).ok_or(Obstacle::NotFinite)?;
        let seen = sight.errors_of(exact).ok_or(Obstacle::NotFinite)?;
        let right = of_methods(&sight, &*solvers, exact.follow)?;
        Ok(MeshLevel { mesh, sight, seen, solvers, right })
    }

    /// The errors that a right method makes on the mesh.
    pub fn right(&self, method: usize) -> Option<Vec<f64>> {
        let ratio = (self.mesh.cell_size / self.solvers.cell_size()).powi(2);
        self.right[method].as_ref().map(|it| it.iter().map(|it| it * ratio).collect())
    }
}

/// The finest mesh, and the next coarser one if there is one.
pub struct Levels<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a ComparisonFrame<D>,
    /// The finest mesh.
    pub fine: MeshLevel<'a, D>,
    coarse: Option<MeshLevel<'a, D>>,
    /// The orders with which the errors of right methods fall on this field; `None` for a method that stops.
    orders: Vec<Option<f64>>,
}

impl<'a, const D: usize> Levels<'a, D> {
    /// Compares results of meshes, from coarse to fine, and optionally a method that the solver may use.
    ///
    /// # Errors
    /// Values that are not finite; runs that would take too long; a body at rest that can move rigidly.
    pub fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a ComparisonFrame<D>,
        meshes: &'a [Mesh],
        like: Option<&Method>,
    ) -> Result<Self, Obstacle>
    where
        f64: Solve<D>,
    {
        let mesh = meshes.last().ok_or(Obstacle::NotFinite)?;
        if exact.space.is_some() && exact.is_at_rest() {
            return Err(Obstacle::Axisymmetric("results at rest"));
        }
        let equilibrium = if exact.is_at_rest() {
            Some(Arc::new(Equilibrium::new(exact, frame)?.ok_or(Obstacle::NotHeld)?))
        } else {
            None
        };
        let level = |mesh: &'a Mesh| {
            let solvers: Box<dyn Responses<'a, D> + 'a> = match &equilibrium {
                Some(equilibrium) => Box::new(Statics::new(equilibrium.clone(), frame, mesh)),
                None => Box::new(SolverRuns::new(
                    exact,
                    frame,
                    mesh,
                    Without::default(),
                    like,
                    MOST_WORK,
                )?),
            };
            MeshLevel::new(exact, frame, mesh, solvers)
        };
        let is_coarser = |it: &&Mesh| it.cell_size > REFINED * mesh.cell_size;
        let coarse = meshes.iter().rev().find(is_coarser).map(level).transpose()?;
        let fine = level(mesh)?;
        let is_coarser =
            |it: &dyn Responses<'_, D>| it.cell_size() > REFINED * fine.solvers.cell_size();
        let orders = match &coarse {
            Some(coarse) if is_coarser(&*coarse.solvers) => {
                orders(&fine, &*coarse.solvers, &coarse.right)
            }
            _ => {
                let solvers = fine.solvers.coarser();
                orders(&fine, &*solvers, &of_methods(&fine.sight, &*solvers, exact.follow)?)
            }
        };
        Ok(Levels { exact, frame, fine, coarse, orders })
    }

    /// The order with which the error of a right method falls on this field; `None` if the method stops.
    pub fn order_of(&self, method: usize) -> Option<f64> {
        self.orders[method]
    }

    /// The degree of the cells; 1 if they are not known.
    pub fn degree(&self) -> u32 {
        self.fine.mesh.snapshots.iter().filter_map(|it| it.degree).min().unwrap_or(1)
    }

    /// Whether there are two meshes.
    pub fn are_two(&self) -> bool {
        self.coarse.is_some()
    }

    /// The order with which the error falls from the coarser mesh to the finer one.
    pub fn order(&self) -> Option<f64> {
        let coarse = self.coarse.as_ref()?;
        let [fine, coarse] = [&self.fine, coarse];
        let errors = size(&coarse.seen.coefficients) / size(&fine.seen.coefficients);
        Some(errors.ln() / (coarse.mesh.cell_size / fine.mesh.cell_size).ln())
    }

    /// Combines the errors on two meshes: the part that does not fall with h^2, and, weighted, the part that does. Errors of
    /// one mesh stay as they are.
    pub fn together(&self, of: impl Fn(&MeshLevel<'a, D>) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
        let fine = of(&self.fine)?;
        let Some(level) = &self.coarse else { return Some(fine) };
        let coarse = of(level)?;
        let ratio = (level.mesh.cell_size / self.fine.mesh.cell_size).powi(2);
        let length = ratio.hypot(1.0);
        let pairs = || fine.iter().zip(&coarse);
        let steady = pairs().map(|(fine, coarse)| (ratio * fine - coarse) / length);
        let falling = pairs().map(|(fine, coarse)| FALLING * (fine + ratio * coarse) / length);
        Some(steady.chain(falling).collect())
    }

    /// The error that a hypothesis makes on a mesh with a method, less a right solver's error. `size` is for the finest mesh.
    pub fn wrong(
        &self,
        level: &MeshLevel<'a, D>,
        method: usize,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Option<Vec<f64>> {
        let size = self.on_mesh(level, hypothesis, size);
        if let Change::Output(_) = hypothesis.change {
            let errors = written(self.exact, self.frame, level.mesh, hypothesis, &size)?;
            return Some(level.sight.see(&errors)?.coefficients);
        }
        self.beyond(level, method, &level.solvers.wrong(method, hypothesis, &size)?)
    }

    /// The error that a hypothesis makes with the first method, linearised; `None` if that takes as long as
    /// [`wrong`](Self::wrong).
    pub fn roughly(
        &self,
        level: &MeshLevel<'a, D>,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Option<Vec<f64>> {
        let size = self.on_mesh(level, hypothesis, size);
        self.beyond(level, 0, &level.solvers.roughly(hypothesis, &size)?)
    }

    /// Converts a size on the finest mesh to a size on a mesh.
    fn on_mesh(
        &self,
        level: &MeshLevel<'a, D>,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Vec<f64> {
        let steps = level.mesh.time_step.zip(self.fine.mesh.time_step);
        let sizes = (level.mesh.cell_size, self.fine.mesh.cell_size);
        let (own, finest) = steps.unwrap_or(sizes);
        let factor = if hypothesis.is_of_mesh { own / finest } else { 1.0 };
        size.iter().map(|it| it * factor).collect()
    }

    /// Coefficients of the errors of a wrong method, less the coefficients of the right method.
    fn beyond(
        &self,
        level: &MeshLevel<'a, D>,
        method: usize,
        errors: &[Vec<f64>],
    ) -> Option<Vec<f64>> {
        let wrong = level.sight.see(errors)?.coefficients;
        Some(less(&wrong, 1.0, level.right[method].as_ref()?))
    }
}

/// The orders of right methods, from their errors on the finest mesh and from solvers with larger cells.
fn orders<const D: usize>(
    fine: &MeshLevel<'_, D>,
    solvers: &dyn Responses<'_, D>,
    coarse: &[Option<Vec<f64>>],
) -> Vec<Option<f64>> {
    let refined = (solvers.cell_size() / fine.solvers.cell_size()).ln();
    let one = |(fine, coarse): (&Option<Vec<f64>>, &Option<Vec<f64>>)| {
        let [fine, coarse] = [fine, coarse].map(|it| it.as_deref().map(size));
        Some((coarse? / fine?).ln() / refined)
    };
    fine.right.iter().zip(coarse).map(one).collect()
}

/// Computes a function of the numbers below `count`, in their order. The follower gets a line for each, such as "mistake 3 of 90".
///
/// # Errors
/// The follower has ended the work.
pub fn on_all_processors<T: Send>(
    count: usize,
    (says, follow): (&str, &dyn Follow),
    of: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, Obstacle> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let take = || {
            let at = next.fetch_add(1, Relaxed);
            if at >= count || follow.is_stopped() {
                return None;
            }
            follow.say(&format!("{says}: {} of {count}", at + 1));
            Some(at)
        };
        std::iter::from_fn(take).map(|at| (at, of(at))).collect::<Vec<_>>()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<(usize, T)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|it| it.join().expect("a run that ends")).collect()
    });
    if follow.is_stopped() {
        return Err(Obstacle::Stopped);
    }
    all.sort_by_key(|(at, _)| *at);
    Ok(all.into_iter().map(|(_, it)| it).collect())
}
