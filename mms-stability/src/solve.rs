//! Whether Newton's method converges to a static field, on the coarse mesh: from the exact state, and from zero in load steps.
//!
//! The loads need no integral over faces: by the balance of a static field, the work of b and of P N is the work of P.

use mms_codegen::compile::Compiled;
use mms_spec::Space;
use nalgebra::{DVector, SMatrix, SVector};

use crate::mesh::Mesh;
use crate::modes::Modes;
use crate::pencil::Pencil;
use crate::subject::{Formulas, State, Subject};

/// The number of steps in which loads and prescribed displacements grow from zero.
const STEPS: usize = 10;

/// The largest number of iterations of each step.
const ITERATIONS: usize = 15;
/// The largest change in the last iteration, as a fraction of the largest displacement.
const CONVERGED: f64 = 1e-9;

/// Two solutions on one mesh are the same if they differ by at most this fraction of the largest displacement.
const SAME: f64 = 1e-4;
/// A solution is the exact one, with the error of the coarse mesh, if both differ by at most this fraction of the largest
/// displacement.
const NEAR: f64 = 0.3;

/// The result of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solved {
    /// From zero the method converges to the exact state.
    Comes,
    /// The method stays at the exact state, and converges to another state from zero.
    GoesElsewhere,
    /// The method stays at the exact state, and does not converge from zero.
    Diverges,
    /// The method leaves the exact state.
    Leaves,
    /// The field is not static.
    Moving,
    /// The body has no coarse mesh.
    NoMesh,
    /// Axisymmetric bodies have no coarse mesh.
    Axisymmetric,
    /// The exact state has no value, or its evaluation takes too long.
    Unknown,
}

impl Solved {
    /// The name of the result.
    pub fn name(self) -> &'static str {
        match self {
            Solved::Comes => "comes",
            Solved::GoesElsewhere => "goes_elsewhere",
            Solved::Diverges => "diverges",
            Solved::Leaves => "leaves",
            Solved::Moving => "not_static",
            Solved::NoMesh | Solved::Axisymmetric => "no_mesh",
            Solved::Unknown => "unknown",
        }
    }

    /// The result in words.
    pub fn words(self) -> &'static str {
        match self {
            Solved::Comes => "Newton's method converges to the exact state from zero",
            Solved::GoesElsewhere => {
                "Newton's method stays at the exact state, and goes ELSEWHERE from zero: another solution exists"
            }
            Solved::Diverges => {
                "Newton's method stays at the exact state, and does NOT CONVERGE from zero in ten load steps"
            }
            Solved::Leaves => {
                "Newton's method LEAVES the exact state: it lies on an unstable branch"
            }
            Solved::Unknown => {
                "NOT SOLVED: the exact state is not finite at a point of the coarse mesh, or takes too long to evaluate there"
            }
            Solved::NoMesh => {
                "NOT SOLVED: this body is a polygon, and `--solve` makes coarse meshes only of boxes and of round bodies"
            }
            Solved::Axisymmetric => {
                "NOT SOLVED: the field is axisymmetric, and `--solve` has elements only in Cartesian coordinates"
            }
            Solved::Moving => "the field is not static: there is nothing to solve",
        }
    }
}

/// Solves a static field from the exact state and from zero.
pub fn solve(compiled: &Compiled) -> Solved {
    let formulas = Formulas::new(compiled);
    let solved = match compiled.field.space {
        Space::Axisymmetric { .. } => Solved::Axisymmetric,
        Space::Cartesian(1) => solved(compiled, &mut Subject::<1>::new(compiled, &formulas)),
        Space::Cartesian(2) => solved(compiled, &mut Subject::<2>::new(compiled, &formulas)),
        Space::Cartesian(_) => solved(compiled, &mut Subject::<3>::new(compiled, &formulas)),
    };
    if formulas.is_spent() { Solved::Unknown } else { solved }
}

fn solved<const D: usize>(compiled: &Compiled, subject: &mut Subject<'_, D>) -> Solved {
    if !subject.is_static {
        return Solved::Moving;
    }
    if !subject.chart.is_block() {
        return Solved::NoMesh;
    }
    let Some(mesh) = pinned(compiled, subject) else { return Solved::Unknown };
    let problem = Problem::new(&mesh, subject);
    let largest = problem.exact.amax();
    let apart = |a: &DVector<f64>, b: &DVector<f64>| (a - b).amax();
    let from_exact = problem.newton(subject, problem.exact.clone(), 1.0);
    let Some(near) = from_exact.filter(|it| apart(it, &problem.exact) <= NEAR * largest) else {
        return Solved::Leaves;
    };
    let mut state = Some(problem.exact.clone() * 0.0);
    for step in 1..=STEPS {
        let part = step as f64 / STEPS as f64;
        state = state.and_then(|state| problem.newton(subject, state, part));
    }
    match state {
        Some(state) if apart(&state, &near) <= SAME * largest => Solved::Comes,
        Some(_) => Solved::GoesElsewhere,
        None => Solved::Diverges,
    }
}

/// The mesh of a body. If rigid motions are free, as many displacements are constrained, each where a rigid motion is largest.
/// `None` if the exact state is not finite.
fn pinned<const D: usize>(compiled: &Compiled, subject: &mut Subject<'_, D>) -> Option<Mesh<D>> {
    let mut mesh = Mesh::new(compiled, &subject.chart);
    let time = subject.window[0];
    let modes = Modes::new(&mesh);
    let pencil = modes.pencil(subject, time)?;
    let mut rigid = modes.rigid(subject, time, &pencil);
    let mut pins = Vec::new();
    while let Some(motion) = rigid.pop() {
        let pin = motion.iamax();
        for other in &mut rigid {
            let share = other[pin] / motion[pin];
            other.axpy(-share, &motion, 1.0);
        }
        pins.extend(modes.place(pin));
    }
    for (node, axis) in pins {
        mesh.nodes[node].is_constrained[axis] = true;
    }
    Some(mesh)
}

/// The balance of a mesh.
struct Problem<'a, const D: usize> {
    mesh: &'a Mesh<D>,
    modes: Modes<'a, D>,
    /// The exact displacements of the nodes, node by node, in their directions.
    exact: DVector<f64>,
    /// The exact P at each point.
    stress: Vec<SMatrix<f64, D, D>>,
}

impl<'a, const D: usize> Problem<'a, D> {
    fn new(mesh: &'a Mesh<D>, subject: &mut Subject<'_, D>) -> Self {
        let time = subject.window[0];
        let displacements = mesh.nodes.iter().flat_map(|node| {
            let moved = subject.position(&node.place, time) - node.place;
            (node.basis.transpose() * moved).iter().copied().collect::<Vec<_>>()
        });
        let exact = DVector::from_vec(displacements.collect());
        let undefined = SMatrix::repeat(f64::NAN);
        let stress = |place| subject.state(place, time).map_or(undefined, |state| state.stress);
        let stress = mesh.points.iter().map(|point| &point.place).map(stress).collect();
        Problem { mesh, modes: Modes::new(mesh), exact, stress }
    }

    /// Newton's method for a part of the loads and of the prescribed displacements; `None` if it does not converge.
    fn newton(
        &self,
        subject: &mut Subject<'_, D>,
        mut state: DVector<f64>,
        part: f64,
    ) -> Option<DVector<f64>> {
        self.modes.set_constrained(&mut state, &(&self.exact * part));
        for _ in 0..ITERATIONS {
            let (residual, pencil) = self.linear(subject, &state, part)?;
            let change = pencil.stiffness.lu().solve(&residual)?;
            self.modes.move_free(&mut state, &change);
            if !state.iter().all(|it| it.is_finite()) {
                return None;
            }
            if change.amax() <= CONVERGED * self.exact.amax() {
                return Some(state);
            }
        }
        None
    }

    /// The difference of loads and forces of the stress at the free displacements, and the tangent.
    fn linear(
        &self,
        subject: &mut Subject<'_, D>,
        state: &DVector<f64>,
        part: f64,
    ) -> Option<(DVector<f64>, Pencil)> {
        let (mut residual, time) = (DVector::zeros(self.modes.free()), subject.window[0]);
        let mut pencil = self.modes.empty();
        for (index, point) in self.mesh.points.iter().enumerate() {
            let gradient = self.gradient(index, state);
            let rows = gradient.transpose();
            let (stress, elasticity) = subject.response(&point.place, time, rows.as_slice());
            if !elasticity.is_finite() || (SMatrix::identity() + gradient).try_inverse().is_none() {
                return None;
            }
            let excess = (self.stress[index] * part - stress) * point.weight;
            self.modes.add_forces(&mut residual, index, &excess);
            let deformation = SMatrix::identity() + gradient;
            let (density, modulus) = (0.0, 1.0);
            let state = State { deformation, stress, elasticity, density, modulus };
            self.modes.add(&mut pencil, index, &state);
        }
        Some((residual, pencil))
    }

    /// H at a point of the mesh.
    fn gradient(&self, index: usize, state: &DVector<f64>) -> SMatrix<f64, D, D> {
        let shapes = self.mesh.points[index].shapes.iter();
        let term = |(node, _, slope): &(usize, f64, SVector<f64, D>)| {
            let own = SVector::<f64, D>::from_fn(|axis, _| state[node * D + axis]);
            self.mesh.nodes[*node].basis * own * slope.transpose()
        };
        shapes.map(term).sum()
    }
}
