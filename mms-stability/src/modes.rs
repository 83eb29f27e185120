//! Stiffness, mass and rigid motions of a body on a mesh, about the exact state.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use crate::elasticity::unit;
use crate::mesh::Mesh;
use crate::pencil::Pencil;
use crate::subject::{State, Subject};

/// A rigid motion that moves constrained displacements by less than this fraction counts as free.
const HELD: f64 = 1e-10;

/// The free displacements of a mesh.
pub struct Modes<'a, const D: usize> {
    mesh: &'a Mesh<D>,
    /// The number of each free displacement of each node.
    numbers: Vec<[Option<usize>; D]>,
    free: usize,
}

impl<'a, const D: usize> Modes<'a, D> {
    /// The free displacements of `mesh`.
    pub fn new(mesh: &'a Mesh<D>) -> Self {
        let mut free = 0;
        let number = |is_constrained: bool| {
            free += usize::from(!is_constrained);
            (!is_constrained).then(|| free - 1)
        };
        let mut number = number;
        let numbers = mesh.nodes.iter().map(|node| node.is_constrained.map(&mut number)).collect();
        Modes { mesh, numbers, free }
    }

    /// The number of free displacements.
    pub fn free(&self) -> usize {
        self.free
    }

    /// The node and the axis of a free displacement.
    pub fn place(&self, number: usize) -> Option<(usize, usize)> {
        let at = self.numbers.as_flattened().iter().position(|it| *it == Some(number))?;
        Some((at / D, at % D))
    }

    /// K of dP/dF and M of rho0 at a time; `None` if a state is not finite.
    pub fn pencil(&self, subject: &mut Subject<'_, D>, time: f64) -> Option<Pencil> {
        let mut pencil = self.empty();
        for index in 0..self.mesh.points.len() {
            let state = subject.state(&self.mesh.points[index].place, time)?;
            self.add(&mut pencil, index, &state);
        }
        Some(pencil)
    }

    /// Zero stiffness and mass.
    pub fn empty(&self) -> Pencil {
        let [stiffness, mass] = [(); 2].map(|()| DMatrix::zeros(self.free, self.free));
        Pencil { stiffness, mass }
    }

    /// Sets the constrained displacements to their values in another state.
    pub fn set_constrained(&self, state: &mut DVector<f64>, given: &DVector<f64>) {
        for (at, number) in self.numbers.as_flattened().iter().enumerate() {
            if number.is_none() {
                state[at] = given[at];
            }
        }
    }

    /// Adds a change to the free displacements.
    pub fn move_free(&self, state: &mut DVector<f64>, change: &DVector<f64>) {
        for (at, number) in self.numbers.as_flattened().iter().enumerate() {
            state[at] += number.map_or(0.0, |number| change[number]);
        }
    }

    /// Adds the forces of a stress, times its volume, at a point.
    pub fn add_forces(&self, forces: &mut DVector<f64>, index: usize, stress: &SMatrix<f64, D, D>) {
        for (node, _, slope) in &self.mesh.points[index].shapes {
            let force = self.mesh.nodes[*node].basis.transpose() * (stress * slope);
            for (axis, number) in self.numbers[*node].iter().enumerate() {
                if let Some(number) = number {
                    forces[*number] += force[axis];
                }
            }
        }
    }

    /// Adds the stiffness and mass of a state at a point.
    pub fn add(&self, pencil: &mut Pencil, index: usize, state: &State<D>) {
        let point = &self.mesh.points[index];
        for (b, value_b, slope_b) in &point.shapes {
            // A_iJkL N_b,L, with k along the directions of the node.
            let half = self.half(state, *b, slope_b);
            for (a, value_a, slope_a) in &point.shapes {
                let basis = self.mesh.nodes[*a].basis.transpose();
                let stiff = basis * contracted(&half, slope_a) * point.weight;
                let turn = basis * self.mesh.nodes[*b].basis;
                let mass = turn * (state.density * value_a * value_b * point.weight);
                self.spread(&mut pencil.stiffness, [*a, *b], &stiff);
                self.spread(&mut pencil.mass, [*a, *b], &mass);
            }
        }
    }

    /// For each J the matrix A_iJkL N,L Q_kn.
    fn half(
        &self,
        state: &State<D>,
        node: usize,
        slope: &SVector<f64, D>,
    ) -> [SMatrix<f64, D, D>; D] {
        let basis = self.mesh.nodes[node].basis;
        std::array::from_fn(|j| {
            let entry = |i, k| (0..D).map(|l| state.elasticity.at([i, j, k, l]) * slope[l]).sum();
            SMatrix::<f64, D, D>::from_fn(entry) * basis
        })
    }

    fn spread(&self, whole: &mut DMatrix<f64>, [a, b]: [usize; 2], part: &SMatrix<f64, D, D>) {
        for (i, row) in self.numbers[a].iter().enumerate() {
            for (k, column) in self.numbers[b].iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column) {
                    whole[(*row, *column)] += part[(i, k)];
                }
            }
        }
    }

    /// The rigid motions of the deformed body that the constraints allow, M-orthonormal.
    pub fn rigid(
        &self,
        subject: &mut Subject<'_, D>,
        time: f64,
        pencil: &Pencil,
    ) -> Vec<DVector<f64>> {
        let places: Vec<_> =
            self.mesh.nodes.iter().map(|node| subject.position(&node.place, time)).collect();
        let middle = places.iter().sum::<SVector<f64, D>>() / places.len() as f64;
        let size = subject.chart.size();
        let motions: Vec<Vec<SVector<f64, D>>> = rigid_motions::<D>()
            .iter()
            .map(|motion| places.iter().map(|x| motion((x - middle) / size)).collect())
            .collect();
        let constrained: Vec<_> =
            motions.iter().map(|motion| self.components(motion, true)).collect();
        let gram = DMatrix::from_fn(constrained.len(), constrained.len(), |a, b| {
            constrained[a].dot(&constrained[b])
        });
        let eigen = gram.symmetric_eigen();
        let most = HELD * (self.mesh.nodes.len() as f64);
        let mut rigid = Vec::new();
        for (value, shares) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value > most {
                continue;
            }
            let free = motions.iter().zip(shares.iter());
            let free = free.map(|(motion, share)| self.components(motion, false) * *share);
            rigid.extend(pencil.normal(free.sum(), &rigid));
        }
        rigid
    }

    /// The displacements that are constrained, or the free ones.
    fn components(&self, motion: &[SVector<f64, D>], is_constrained: bool) -> DVector<f64> {
        let mut components = Vec::new();
        for ((node, numbers), moved) in self.mesh.nodes.iter().zip(&self.numbers).zip(motion) {
            let local = node.basis.transpose() * moved;
            // A node without elements constrains nothing.
            let kept =
                (0..D).filter(|axis| numbers[*axis].is_none() == is_constrained && !node.is_unused);
            components.extend(kept.map(|axis| local[axis]));
        }
        DVector::from_vec(components)
    }
}

/// The sum over J of the matrices of J times N,J.
fn contracted<const D: usize>(
    half: &[SMatrix<f64, D, D>; D],
    slope: &SVector<f64, D>,
) -> SMatrix<f64, D, D> {
    (0..D).map(|j| half[j] * slope[j]).sum()
}

/// A displacement as a function of x.
type RigidMotion<const D: usize> = Box<dyn Fn(SVector<f64, D>) -> SVector<f64, D>>;

/// Translations along the axes, and rotations in the planes of two of them.
fn rigid_motions<const D: usize>() -> Vec<RigidMotion<D>> {
    let mut motions: Vec<RigidMotion<D>> = Vec::new();
    for a in 0..D {
        motions.push(Box::new(move |_| unit(a)));
        for b in 0..a {
            motions.push(Box::new(move |x| {
                let mut turned = SVector::zeros();
                (turned[a], turned[b]) = (x[b], -x[a]);
                turned
            }));
        }
    }
    motions
}
