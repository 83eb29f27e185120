//! The errors that mistakes make at equilibrium: without waves, a time step, or errors of a method of our own.
//!
//! The motion is the exact one plus d, a sum of [smooth functions that vanish where the motion is given](crate::weak). A right
//! solver has d = 0. A mistake puts int (P' - P):grad w - int (rho0 b' - rho0 b).w - int (T' - T).w out of balance. P', b' and
//! T' contain the mistake; P' and T' are evaluated at the motion with d. Galerkin's method finds d, by Newton's method with the
//! tangent of the right law and Anderson's acceleration (Walker & Ni, "Anderson acceleration for fixed-point iterations", SIAM
//! J. Numer. Anal. 49 (2011)).

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use mms_runtime::nalgebra::{DMatrix, DVector, Dyn, LU};
use mms_runtime::{
    Condition, Domain, ManufacturedField as _, Material as _, Matrix, Refusal, Vector,
};

use crate::answer::Computed;
use crate::changed::{Changed, Without};
use crate::evidence::{ComparisonFrame, Mesh, nearest};
use crate::exact::{Exact, Quantity, vectors};
use crate::hypothesis::{Change, Hypothesis};
use crate::run::Responses;
use crate::smooth;
use crate::weak::{Weak, add, first};

/// The degree of functions, in one to three dimensions.
const DEGREE: [usize; 3] = [12, 9, 5];
/// The points of quadrature along an axis, in one to three dimensions.
const POINTS: [usize; 3] = [24, 16, 10];
/// The largest number of iterations for d.
const ROUNDS: usize = 30;
/// The number of earlier steps that the acceleration uses.
const DEPTH: usize = 6;
/// The iteration ends if d changes by at most this part.
const FOUND: f64 = 1e-6;
/// The number of increments in which a large mistake is applied.
const BITS: u32 = 6;
/// The step of differences of P.
const STEP: f64 = 1e-6;
/// The part of the stress below which unbalanced forces are rounding.
const ROUNDING: f64 = 1e-12;
/// The most halvings of a step that leads to a singular F.
const HALVES: usize = 6;

/// Equilibrium at a time, under the conditions on the faces.
struct System<'a, const D: usize> {
    weak: Weak<'a, D>,
    /// H and P of the exact motion, at the points of the quadrature.
    gradient: Vec<Matrix<f64, D>>,
    stress: Vec<Matrix<f64, D>>,
    /// rho0 b at these points.
    force: Vec<Vector<f64, D>>,
    /// H and P N of the exact motion on the pieces of faces without given motion.
    faces: Vec<OnFace<D>>,
    /// The size of the forces of the stress of the exact motion.
    stress_force_size: f64,
    /// The tangent of the right law.
    tangent: LU<f64, Dyn, Dyn>,
}

/// The forces that a mistake puts out of balance at the exact motion.
struct Imbalance {
    /// The loads, which do not depend on the motion.
    loads: DVector<f64>,
    /// The sum of all forces; `None` if it is not finite.
    all: Option<DVector<f64>>,
}

/// A way to find the coefficients of the functions that bring a mistake into balance.
type SolveMethod<'a, const D: usize> =
    fn(&System<'a, D>, &Changed<'_, D>, &Imbalance) -> Option<DVector<f64>>;

/// A piece of a face.
struct OnFace<const D: usize> {
    is_loaded: bool,
    position: Vector<f64, D>,
    area: Vector<f64, D>,
    gradient: Matrix<f64, D>,
    load: Vector<f64, D>,
    functions: Vec<f64>,
}

impl<'a, const D: usize> System<'a, D> {
    /// Sets up equilibrium of a field at a time, under these conditions; `None` if the body can move rigidly, or is unstable.
    fn new(exact: &'a Exact<'a, D>, time: f64, domain: &Domain<f64, D>) -> Option<Self> {
        let weak = Weak::with(exact, time, domain, DEGREE, POINTS[D - 1]).ok()?;
        let x = &weak.quadrature.points;
        let gradient = exact.gradient(time, x);
        let stress = exact.stress(time, x, &gradient);
        let stress: Vec<_> = stress.iter().zip(&gradient).map(|(tau, h)| first(tau, h)).collect();
        let force = weak.per_volume(x, exact.body_force(time, x));
        let is_free = |it: &Condition| matches!(it, Condition::Traction | Condition::Free);
        let own = weak.quadrature.pieces.iter();
        let own = own.filter(|it| {
            let condition = domain.condition(it.face);
            is_free(&condition) || condition == Condition::Roller
        });
        let faces = own.map(|piece| {
            let x = piece.position;
            let h = exact.gradient(time, &[x])[0];
            let tau = exact.stress(time, &[x], &[h])[0];
            OnFace {
                is_loaded: domain.condition(piece.face) == Condition::Traction,
                position: x,
                area: piece.area,
                gradient: h,
                load: first(&tau, &h) * piece.area,
                functions: weak.functions(&x),
            }
        });
        let faces = faces.collect();
        let tangent = tangent(exact, &weak, &gradient)?.lu();
        let stress_force_size = DVector::from_vec(weak.stress_term(stress.iter().copied())).norm();
        let system = System { weak, gradient, stress, force, faces, stress_force_size, tangent };
        system.tangent.is_invertible().then_some(system)
    }

    /// The sums that b and tractions of a mistake put out of balance; they do not depend on the motion.
    fn loads(&self, field: &Changed<'_, D>) -> DVector<f64> {
        let weak = &self.weak;
        let (x, time) = (&weak.quadrature.points, weak.time);
        let (mut b, mut density) = (vec![Vector::zeros(); x.len()], vec![0.0; x.len()]);
        field.body_force(time, x, &mut b);
        field.density(x, &mut density);
        let own = b.iter().zip(density).zip(&self.force).map(|((b, rho), right)| b * rho - right);
        let mut sums = weak.integrate(&own.collect::<Vec<_>>());
        let position: Vec<_> = self.faces.iter().map(|it| it.position).collect();
        let gradient: Vec<_> = self.faces.iter().map(|it| it.gradient).collect();
        let mut tau = vec![Matrix::zeros(); position.len()];
        field.surface_stress(time, &position, &gradient, &mut tau);
        for (it, tau) in self.faces.iter().zip(&tau) {
            let own =
                if it.is_loaded { first(tau, &it.gradient) * it.area } else { Vector::zeros() };
            if own != it.load {
                add(&mut sums, &it.functions, &(own - it.load));
            }
        }
        DVector::from_vec(sums)
    }

    /// The imbalance of each sum with these loads, at the exact motion plus functions with the coefficients `parts`.
    fn unbalanced(
        &self,
        field: &Changed<'_, D>,
        loads: &DVector<f64>,
        parts: &DVector<f64>,
    ) -> Option<DVector<f64>> {
        let weak = &self.weak;
        let slopes = weak.slopes_at_points.chunks(weak.count());
        let moved: Vec<Matrix<f64, D>> =
            self.gradient.iter().zip(slopes).map(|(h, of)| h + gradient(of, parts)).collect();
        let stress = weak.stress(field, &moved);
        let changed = stress.iter().zip(&self.stress).map(|(own, right)| own - right);
        let sums = loads + DVector::from_vec(weak.stress_term(changed));
        sums.iter().all(|it| it.is_finite()).then_some(sums)
    }

    /// The forces that a mistake puts out of balance at the exact motion.
    fn imbalance(&self, field: &Changed<'_, D>) -> Imbalance {
        let loads = self.loads(field);
        let all = self.unbalanced(field, &loads, &DVector::zeros(self.weak.count()));
        Imbalance { loads, all }
    }

    /// Whether a mistake puts more than rounding out of balance at the exact motion.
    fn is_significant(&self, imbalance: &Imbalance) -> bool {
        imbalance.all.as_ref().is_none_or(|all| all.norm() > ROUNDING * self.stress_force_size)
    }

    /// The coefficients of the functions that bring a small mistake into balance, by linearisation.
    fn linear(&self, _: &Changed<'_, D>, imbalance: &Imbalance) -> Option<DVector<f64>> {
        self.tangent.solve(imbalance.all.as_ref()?)
    }

    /// The coefficients at which a mistake is in balance; `None` if there are none. Applies a large mistake in increments.
    fn balance(
        &self,
        field: &Changed<'_, D>,
        Imbalance { loads, all }: &Imbalance,
    ) -> Option<DVector<f64>> {
        let (none, all) = (DVector::zeros(self.weak.count()), all.as_ref()?);
        if let Some(found) = self.near(field, &self.tangent, (&none, all), loads) {
            return Some(found);
        }
        let mut parts = none;
        for made in 1..=BITS {
            let left = all * (1.0 - f64::from(made) / f64::from(BITS));
            let slopes = self.weak.slopes_at_points.chunks(self.weak.count());
            let moved = self.gradient.iter().zip(slopes).map(|(h, of)| h + gradient(of, &parts));
            let tangent = tangent(self.weak.exact, &self.weak, &moved.collect::<Vec<_>>())?.lu();
            let loads = loads - left;
            let out = self.unbalanced(field, &loads, &parts)?;
            parts = self.near(field, &tangent, (&parts, &out), &loads)?;
        }
        Some(parts)
    }

    /// Finds the coefficients of the functions in balance with loads, starting from coefficients nearby and their imbalance.
    fn near(
        &self,
        field: &Changed<'_, D>,
        tangent: &LU<f64, Dyn, Dyn>,
        (from, out): (&DVector<f64>, &DVector<f64>),
        loads: &DVector<f64>,
    ) -> Option<DVector<f64>> {
        let step = |parts: &DVector<f64>| tangent.solve(&self.unbalanced(field, loads, parts)?);
        let mut parts = from.clone();
        let mut last = tangent.solve(out)?;
        let mut history: Vec<[DVector<f64>; 2]> = Vec::new();
        for _ in 0..ROUNDS {
            if self.weak.exact.follow.is_stopped() {
                return None;
            }
            let own = accelerated(&history, &last);
            let halved = |half: usize| &parts + &own * 0.5_f64.powi(half as i32);
            let (found, next) =
                (0..HALVES).map(halved).find_map(|next| Some((step(&next)?, next)))?;
            if found.norm() <= FOUND * next.norm() {
                return Some(next);
            }
            history.push([&next - &parts, &found - &last]);
            if history.len() > DEPTH {
                history.remove(0);
            }
            (parts, last) = (next, found);
        }
        None
    }
}

/// The step of Anderson's acceleration, from earlier steps, each with its change of the remainder, and from the last step.
fn accelerated(history: &[[DVector<f64>; 2]], last: &DVector<f64>) -> DVector<f64> {
    let columns: Vec<Vec<f64>> = history.iter().map(|[_, left]| left.as_slice().to_vec()).collect();
    let weights = smooth::nearest(&columns, last.as_slice());
    let mut own = last.clone();
    for ([moved, left], weight) in history.iter().zip(weights) {
        own -= (moved + left) * weight;
    }
    own
}

/// The gradient of a sum of functions, whose components come one after the other.
fn gradient<const D: usize>(slopes: &[Vector<f64, D>], parts: &DVector<f64>) -> Matrix<f64, D> {
    let count = slopes.len() / D;
    let mut h = Matrix::zeros();
    let each = slopes.chunks_exact(count).zip(parts.as_slice().chunks_exact(count));
    for (i, (slopes, parts)) in each.enumerate() {
        let mut row = [0.0; D];
        for (slope, part) in slopes.iter().zip(parts) {
            (0..D).for_each(|axis| row[axis] += part * slope[axis]);
        }
        (0..D).for_each(|axis| h[(i, axis)] = row[axis]);
    }
    h
}

/// int grad w : dP/dH : grad w' for all pairs of functions, of the right law.
fn tangent<const D: usize>(
    exact: &Exact<'_, D>,
    weak: &Weak<'_, D>,
    at: &[Matrix<f64, D>],
) -> Option<DMatrix<f64>> {
    let x = &weak.quadrature.points;
    let stress = |entry: (usize, usize), step: f64| -> Vec<Matrix<f64, D>> {
        let mut moved = at.to_vec();
        moved.iter_mut().for_each(|h| h[entry] += step);
        let tau = exact.stress(weak.time, x, &moved);
        tau.iter().zip(&moved).map(|(tau, h)| first(tau, h)).collect()
    };
    let (all, count) = (weak.count(), weak.count() / D);
    let slopes: Vec<DMatrix<f64>> = (0..D)
        .map(|i| {
            DMatrix::from_fn(D * x.len(), count, |row, n| {
                weak.slopes_at_points[row / D * all + i * count + n][row % D]
            })
        })
        .collect();
    let transposed: Vec<DMatrix<f64>> = slopes.iter().map(DMatrix::transpose).collect();
    let mut tangent = DMatrix::zeros(all, all);
    for (j, of_j) in slopes.iter().enumerate() {
        let mut made = vec![DMatrix::zeros(D * x.len(), count); D];
        for b in 0..D {
            let [before, after] = [-STEP, STEP].map(|step| stress((j, b), step));
            let changes = before.iter().zip(&after).zip(&weak.quadrature.volumes);
            let changes: Vec<Matrix<f64, D>> = changes
                .map(|((before, after), volume)| (after - before) * (volume / (2.0 * STEP)))
                .collect();
            for (i, made) in made.iter_mut().enumerate() {
                // The rows of a column belong to the points, D rows to each.
                let rows = changes.len() * D;
                let columns = made.as_mut_slice().chunks_exact_mut(rows);
                for (made, of_j) in columns.zip(of_j.as_slice().chunks_exact(rows)) {
                    let points = made.chunks_exact_mut(D).zip(of_j.chunks_exact(D));
                    for ((made, of_j), change) in points.zip(&changes) {
                        (0..D).for_each(|a| made[a] += change[(i, a)] * of_j[b]);
                    }
                }
            }
        }
        for (i, made) in made.iter().enumerate() {
            let block = &transposed[i] * made;
            tangent.view_mut((i * count, j * count), (count, count)).copy_from(&block);
        }
    }
    tangent.iter().all(|it| it.is_finite()).then_some(tangent)
}

/// The coefficients of the functions for each hypothesis and size.
type CoefficientCache = HashMap<(usize, Vec<u64>), Option<DVector<f64>>>;

/// Equilibrium of a field, for results of any mesh.
pub struct Equilibrium<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    system: System<'a, D>,
    /// The error of elements of degree 1, for the cell size of the exact solution.
    of_elements: DVector<f64>,
    /// The responses to mistakes, and the responses to small mistakes.
    found: [Mutex<CoefficientCache>; 2],
}

impl<'a, const D: usize> Equilibrium<'a, D> {
    /// Sets up equilibrium at the last time that is compared; `None` if the body can move rigidly, or is unstable.
    ///
    /// # Errors
    /// A body without extent.
    pub fn new(
        exact: &'a Exact<'a, D>,
        frame: &ComparisonFrame<D>,
    ) -> Result<Option<Self>, Refusal> {
        let Some(time) = frame.times.last() else { return Ok(None) };
        let Some(system) = System::new(exact, *time, &exact.domain) else { return Ok(None) };
        let methods = system.weak.of_elements(Computed::NodalResidual, &Without::default()).methods;
        let residual = methods.last().map(|it| DVector::from_column_slice(it));
        let of_elements = residual.and_then(|it| system.tangent.solve(&-it));
        Ok(of_elements.map(|of_elements| Equilibrium {
            exact,
            system,
            of_elements,
            found: Default::default(),
        }))
    }

    /// The coefficients of the functions that a mistake makes, linearised if `is_small`; computed once.
    fn response(
        &self,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
        is_small: bool,
    ) -> Option<DVector<f64>> {
        let bits = size.iter().map(|it| it.to_bits()).collect();
        let key = (std::ptr::from_ref(hypothesis).addr(), bits);
        let found =
            || self.found[usize::from(is_small)].lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = found().get(&key) {
            return known.clone();
        }
        let by = if is_small { System::linear } else { System::balance };
        let own = self.coefficients(hypothesis, size, by).filter(|it| it.norm() > 0.0);
        found().insert(key, own.clone());
        own
    }

    /// The coefficients of the functions that a mistake makes, 0 if it changes nothing at rest; `None` without an equilibrium.
    fn coefficients(
        &self,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
        by: SolveMethod<'a, D>,
    ) -> Option<DVector<f64>> {
        let field = Changed::with(self.exact, Without::default(), hypothesis, size);
        let nothing = || Some(DVector::zeros(self.system.weak.count()));
        match hypothesis.change {
            Change::Force(_)
            | Change::Stress(..)
            | Change::Surface(_)
            | Change::Loads(..)
            | Change::Density => {
                let imbalance = self.system.imbalance(&field);
                if self.system.is_significant(&imbalance) {
                    by(&self.system, &field, &imbalance)
                } else {
                    nothing()
                }
            }
            Change::Condition(Condition::Free) => {
                let own = System::new(self.exact, self.system.weak.time, &field.domain())?;
                by(&own, &field, &own.imbalance(&field))
            }
            // At rest the other mistakes change nothing that is computed.
            _ => nothing(),
        }
    }
}

/// The errors of results of one mesh at equilibrium.
pub struct Statics<'a, const D: usize> {
    /// Shared by all meshes.
    equilibrium: Arc<Equilibrium<'a, D>>,
    /// The frame in which errors are compared.
    frame: &'a ComparisonFrame<D>,
    /// The mesh.
    mesh: &'a Mesh,
    /// The h of the mesh, or a larger one.
    cell_size: f64,
    /// The functions at the points of the mesh, for each time and quantity; `None` without results.
    functions: OnceLock<Option<Vec<AtPoints<D>>>>,
}

impl<'a, const D: usize> Statics<'a, D> {
    /// The responses at the points of a mesh.
    pub fn new(
        equilibrium: Arc<Equilibrium<'a, D>>,
        frame: &'a ComparisonFrame<D>,
        mesh: &'a Mesh,
    ) -> Self {
        let (cell_size, functions) = (mesh.cell_size, OnceLock::new());
        Statics { equilibrium, frame, mesh, cell_size, functions }
    }

    /// The errors that a mistake adds to the errors of a right solver; `None` if it has no equilibrium near the exact one.
    pub fn added(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<Vec<f64>>> {
        self.errors(&self.equilibrium.coefficients(hypothesis, size, System::balance)?)
    }

    /// The errors at the user's points, for each time and quantity.
    fn errors(&self, parts: &DVector<f64>) -> Option<Vec<Vec<f64>>> {
        let own = self.functions.get_or_init(|| {
            let weak = &self.equilibrium.system.weak;
            let one = |(at, quantity): (usize, Quantity)| {
                let points = vectors::<D>(&nearest(self.mesh, self.frame.times[at])?.reference);
                Some(AtPoints::new(weak, quantity, &points))
            };
            self.frame.each().map(one).collect()
        });
        Some(own.as_ref()?.iter().map(|it| it.values(parts)).collect())
    }
}

/// The values of the functions that make up a quantity at some points.
enum AtPoints<const D: usize> {
    /// The functions, point by point.
    Displacement(Vec<f64>),
    /// The number of points, whose velocities are 0.
    Velocity(usize),
    /// The gradients of the functions, point by point.
    DisplacementGradient(Vec<Vector<f64, D>>),
}

impl<const D: usize> AtPoints<D> {
    fn new(weak: &Weak<'_, D>, quantity: Quantity, points: &[Vector<f64, D>]) -> Self {
        match quantity {
            Quantity::Displacement => {
                AtPoints::Displacement(points.iter().flat_map(|x| weak.functions(x)).collect())
            }
            Quantity::Velocity => AtPoints::Velocity(points.len()),
            Quantity::DisplacementGradient => AtPoints::DisplacementGradient(
                points.iter().flat_map(|x| weak.gradients(x)).collect(),
            ),
        }
    }

    /// The quantity of a sum of functions, at the points.
    fn values(&self, parts: &DVector<f64>) -> Vec<f64> {
        let count = parts.len() / D;
        match self {
            AtPoints::Displacement(functions) => {
                let own = functions.chunks(count).zip(parts.as_slice().chunks(count).cycle());
                own.map(|(of, parts)| of.iter().zip(parts).map(|(a, b)| a * b).sum()).collect()
            }
            AtPoints::Velocity(points) => vec![0.0; D * points],
            AtPoints::DisplacementGradient(slopes) => {
                let own = slopes.chunks(parts.len()).map(|slopes| gradient(slopes, parts));
                own.flat_map(|h| h.transpose().iter().copied().collect::<Vec<_>>()).collect()
            }
        }
    }
}

impl<'a, const D: usize> Responses<'a, D> for Statics<'a, D> {
    fn cell_size(&self) -> f64 {
        self.cell_size
    }

    fn methods(&self) -> usize {
        1
    }

    fn described(&self, _: usize) -> Option<String> {
        None
    }

    fn is_of_second_order(&self, _: usize) -> bool {
        true
    }

    /// The errors of elements of degree 1, which fall with h^2.
    fn right(&self, _: usize) -> Option<Vec<Vec<f64>>> {
        let Equilibrium { exact, of_elements, .. } = &*self.equilibrium;
        self.errors(&(of_elements * (self.cell_size / exact.cell_size).powi(2)))
    }

    fn wrong(&self, _: usize, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<Vec<f64>>> {
        let Equilibrium { exact, of_elements, .. } = &*self.equilibrium;
        let ratio = (self.cell_size / exact.cell_size).powi(2);
        self.errors(&(self.equilibrium.response(hypothesis, size, false)? + of_elements * ratio))
    }

    fn roughly(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<Vec<f64>>> {
        let Equilibrium { exact, of_elements, .. } = &*self.equilibrium;
        let ratio = (self.cell_size / exact.cell_size).powi(2);
        self.errors(&(self.equilibrium.response(hypothesis, size, true)? + of_elements * ratio))
    }

    fn coarser(&self) -> Box<dyn Responses<'a, D> + 'a> {
        Box::new(Statics {
            cell_size: 2.0 * self.cell_size,
            ..Statics::new(self.equilibrium.clone(), self.frame, self.mesh)
        })
    }
}
