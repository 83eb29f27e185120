//! Nodes at a face where the field prescribes the motion: they take the field's velocity and acceleration.
//!
//! Held are the nodes on and beyond the face, and those nearer to it than their hat function is wide:
//! the balance of momentum of such a node misses the traction on the part of the face inside its
//! support. Where the face runs along a plane of nodes, these are just the nodes on and beyond it.
//! A node's reference position comes from inverting x = X + u(X, t) by Newton's method.

use crate::tensor::{components, inverse_deformation_gradient, is_finite};
use crate::{Cause, Failure, Grid, ManufacturedField, Matrix, Real, Vector};

const NEWTON_ITERATIONS: usize = 30;

/// A face of the reference body.
struct Plane<T> {
    axis: usize,
    upper: bool,
    position: T,
}

/// The prescribed faces, and the nodes that they hold at the present time. Without faces it is empty.
pub struct Prescribed<T, const D: usize> {
    faces: Vec<Plane<T>>,
    /// Per node: the reference position found last, where the next search starts.
    start: Vec<Vector<T, D>>,
    /// The nodes that are held.
    nodes: Vec<usize>,
    /// Their reference positions.
    reference: Vec<Vector<T, D>>,
    /// Their images on a face.
    foot: Vec<Vector<T, D>>,
    held: Vec<bool>,
    value: Vec<Vector<T, D>>,
    displacement_gradient: Vec<Matrix<T, D>>,
}

impl<T: Real, const D: usize> Prescribed<T, D> {
    /// No face.
    pub fn none() -> Self {
        Self {
            faces: Vec::new(),
            start: Vec::new(),
            nodes: Vec::new(),
            reference: Vec::new(),
            foot: Vec::new(),
            held: Vec::new(),
            value: Vec::new(),
            displacement_gradient: Vec::new(),
        }
    }

    /// Prescribes the motion of a face of the reference box.
    pub fn add_face(&mut self, grid: &Grid<T, D>, axis: usize, upper: bool, position: T) {
        if self.faces.is_empty() {
            self.start = (0..grid.len()).map(|node| grid.position(node)).collect();
            self.nodes.reserve(grid.len());
            self.reference.reserve(grid.len());
            self.foot.reserve(grid.len());
            self.held.reserve(grid.len());
            self.value.reserve(grid.len());
            self.displacement_gradient.reserve(grid.len());
        }
        self.faces.push(Plane { axis, upper, position });
    }

    /// Finds the nodes with mass that the faces hold at `time`, and their reference positions.
    pub fn locate<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        if self.faces.is_empty() {
            return Ok(());
        }
        self.nodes.clear();
        self.nodes.extend((0..grid.len()).filter(|&node| grid.mass[node] > grid.mass_floor));
        let count = self.nodes.len();
        self.reference.clear();
        self.reference.extend(self.nodes.iter().map(|&node| self.start[node]));
        self.value.resize(count, Vector::zeros());
        self.displacement_gradient.resize(count, Matrix::zeros());
        self.invert_motion(field, time, grid)?;
        for (&node, reference) in self.nodes.iter().zip(&self.reference) {
            self.start[node] = *reference;
        }
        self.keep_held_nodes(field, time, grid);
        Ok(())
    }

    /// Newton's method for x = X + u(X, t), all nodes at once; x is the node's position.
    fn invert_motion<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let mut unsettled = None;
        for _ in 0..NEWTON_ITERATIONS {
            field.displacement(time, &self.reference, &mut self.value);
            field.displacement_gradient(time, &self.reference, &mut self.displacement_gradient);
            unsettled = None;
            for (k, &node) in self.nodes.iter().enumerate() {
                let position = grid.position(node);
                let residual = self.reference[k] + self.value[k] - position;
                let size = position.amax() + self.value[k].amax() + grid.cell_size;
                let settled = residual.amax() <= T::of(32.0) * T::default_epsilon() * size;
                if settled {
                    continue;
                }
                unsettled = Some(k);
                let inverse = inverse_deformation_gradient(&self.displacement_gradient[k]);
                match inverse.map(|inverse| inverse * residual).filter(is_finite) {
                    Some(correction) => self.reference[k] -= correction,
                    None => return Err(self.not_found(k, time, grid)),
                }
            }
            if unsettled.is_none() {
                return Ok(());
            }
        }
        unsettled.map_or(Ok(()), |k| Err(self.not_found(k, time, grid)))
    }

    fn not_found(&self, k: usize, time: T, grid: &Grid<T, D>) -> Failure {
        Failure {
            step: 0, // the solver knows
            time: time.to_f64(),
            particle: None,
            reference_position: components(&self.reference[k]),
            cause: Cause::NoReferencePosition {
                position: components(&grid.position(self.nodes[k])),
            },
        }
    }

    /// Drops the nodes whose hat functions lie inside the body.
    ///
    /// For each node and face, the foot is the point of the face with the node's other reference
    /// coordinates: the node is held if the foot's present position is nearer than one cell, or behind.
    fn keep_held_nodes<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        // Where the hat just touches the face, round-off must not decide.
        let reach = grid.cell_size * T::of(1.0 - 1e-3);
        self.held.clear();
        self.held.resize(self.nodes.len(), false);
        for &Plane { axis, upper, position } in &self.faces {
            self.foot.clone_from(&self.reference);
            self.foot.iter_mut().for_each(|foot| foot[axis] = position);
            field.displacement(time, &self.foot, &mut self.value);
            for (k, &node) in self.nodes.iter().enumerate() {
                let above = grid.position(node)[axis] - position - self.value[k][axis];
                let depth = if upper { -above } else { above };
                self.held[k] |= depth < reach;
            }
        }
        let mut kept = 0;
        for k in 0..self.nodes.len() {
            if self.held[k] {
                self.nodes[kept] = self.nodes[k];
                self.reference[kept] = self.reference[k];
                kept += 1;
            }
        }
        self.nodes.truncate(kept);
        self.reference.truncate(kept);
        self.value.truncate(kept);
    }

    /// Writes the field's `exact` values to the nodes that are held.
    pub fn impose(
        &mut self,
        nodal: &mut [Vector<T, D>],
        exact: impl FnOnce(&[Vector<T, D>], &mut [Vector<T, D>]),
    ) {
        if self.nodes.is_empty() {
            return;
        }
        exact(&self.reference, &mut self.value);
        for (&node, value) in self.nodes.iter().zip(&self.value) {
            nodal[node] = *value;
        }
    }
}
