//! Nodes at a face where the field prescribes the motion: they follow the field's velocity and acceleration.
//!
//! The face prescribes the nodes on and beyond it, and the nodes nearer to it than their weights are wide: the balance of
//! momentum of such a node misses the traction on the part of the face inside its support. Where the face runs along a plane of
//! nodes at which splines end, only the nodes on it are prescribed. Newton's method, started at the nearest sample of the face,
//! inverts x = X + u(X, t) for a node's reference position; in the total formulation it is the node's position. Beyond a face
//! at rest a node moves opposite to its mirror image inside, since the field may vary strongly outside its body.

use super::surface::Surface;
use crate::defect::{Defect, on};
use crate::failure::{Cause, Failure};
use crate::field::ManufacturedField;
use crate::grid::Grid;
use crate::lattice::Lattice;
use crate::nodal::Nodal;
use crate::real::{Matrix, Real, Vector};
use crate::tensor::{components, inverse_deformation_gradient, is_finite};

const NEWTON_ITERATIONS: usize = 30;

/// The largest number of nodes along an axis, to either side of a sample, that a face prescribes: those to which particles
/// inside add mass.
const NEIGHBOURS: usize = 2;

/// The prescribed faces, and the nodes that they prescribe at the present time. Empty if no face is prescribed.
pub struct Prescribed<T, const D: usize> {
    moves: bool,
    /// The faces, and whether each is at rest.
    faces: Vec<(Surface<T>, bool)>,
    /// Points on all faces, one for every cell.
    samples: Vec<Vector<T, D>>,
    /// The present positions of the samples.
    present: Vec<Vector<T, D>>,
    /// Per node: the distance from its nearest sample, and the number of that sample.
    nearest: Vec<Option<(T, usize)>>,
    /// The prescribed nodes.
    nodes: Vec<usize>,
    /// The positions of the nodes, or of their images in faces at rest.
    target: Vec<Vector<T, D>>,
    /// 1, or -1 for an image.
    sign: Vec<T>,
    /// The reference positions of the targets.
    reference: Vec<Vector<T, D>>,
    /// The nearest points of a face to the reference positions.
    foot: Vec<Vector<T, D>>,
    /// The reference normals at the feet.
    normal: Vec<Vector<T, D>>,
    held: Vec<bool>,
    value: Vec<Vector<T, D>>,
    displacement_gradient: Vec<Matrix<T, D>>,
}

impl<T: Real, const D: usize> Prescribed<T, D> {
    /// No face; `moves` tells whether the body moves through the grid.
    pub fn new(moves: bool) -> Self {
        Self {
            moves,
            faces: Vec::new(),
            samples: Vec::new(),
            present: Vec::new(),
            nearest: Vec::new(),
            nodes: Vec::new(),
            target: Vec::new(),
            sign: Vec::new(),
            reference: Vec::new(),
            foot: Vec::new(),
            normal: Vec::new(),
            held: Vec::new(),
            value: Vec::new(),
            displacement_gradient: Vec::new(),
        }
    }

    /// Prescribes the motion of a face, which may be at rest, with one sample for every cell.
    pub fn add_face(
        &mut self,
        surface: Surface<T>,
        at_rest: bool,
        samples: impl Iterator<Item = Vector<T, D>>,
        lattice: &Lattice<T, D>,
    ) {
        if self.faces.is_empty() {
            let count = lattice.len();
            self.nearest.resize(count, None);
            self.nodes.reserve(count);
            self.target.reserve(count);
            self.sign.reserve(count);
            self.reference.reserve(count);
            self.foot.reserve(count);
            self.normal.reserve(count);
            self.held.reserve(count);
            self.value.reserve(count);
            self.displacement_gradient.reserve(count);
        }
        self.faces.push((surface, at_rest));
        self.samples.extend(samples);
        self.present.resize(self.samples.len(), Vector::zeros());
    }

    /// Finds the nodes with mass that the faces prescribe at `time`, and their reference positions.
    ///
    /// # Errors
    /// The motion cannot be inverted at a node.
    pub fn locate<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let located = !self.moves && !self.nodes.is_empty();
        if self.faces.is_empty() || located {
            return Ok(());
        }
        self.find_nodes_nearby(field, time, grid);
        self.reference.clear();
        self.target.clear();
        self.sign.clear();
        for &node in &self.nodes {
            let position = grid.lattice.position(node);
            let at_rest = self.faces.iter().filter(|(_, at_rest)| *at_rest);
            let image = at_rest.filter_map(|(surface, _)| surface.image(&position)).next();
            let target = image.unwrap_or(position);
            self.sign.push(if image.is_some() { -T::one() } else { T::one() });
            self.target.push(target);
            let nearest = self.nearest[node].take().filter(|_| self.moves);
            let moved = nearest.map_or(Vector::zeros(), |(_, k)| self.present[k] - self.samples[k]);
            self.reference.push(target - moved);
        }
        self.value.resize(self.nodes.len(), Vector::zeros());
        self.displacement_gradient.resize(self.nodes.len(), Matrix::zeros());
        if self.moves && !on(Defect::UninvertedWall) {
            self.invert_motion(field, time, grid)?;
        }
        self.keep_held_nodes(field, time, grid);
        Ok(())
    }

    /// Finds the nodes with mass that are near a sample, and the nearest sample of each.
    fn find_nodes_nearby<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let Self { samples, present, nearest, nodes, .. } = self;
        let lattice = &grid.lattice;
        present.clone_from(samples);
        if self.moves {
            field.displacement(time, samples, present);
            present.iter_mut().zip(samples).for_each(|(position, sample)| *position += *sample);
        }
        nodes.clear();
        for (k, position) in present.iter().enumerate() {
            let cells = lattice.in_cells(position);
            let first: [usize; D] = std::array::from_fn(|a| {
                (cells[a].to_f64().max(0.0) as usize).saturating_sub(NEIGHBOURS)
            });
            let width = 2 * NEIGHBOURS + 2;
            for number in 0..width.pow(D as u32) {
                let along = |a: usize| first[a] + number / width.pow(a as u32) % width;
                if (0..D).any(|a| along(a) >= lattice.count[a]) {
                    continue;
                }
                let node = (0..D).map(|a| along(a) * lattice.stride[a]).sum::<usize>();
                if grid.mass(node) <= grid.mass_floor {
                    continue;
                }
                let distance = (lattice.position(node) - position).norm();
                match nearest[node] {
                    None => nodes.push(node),
                    Some((least, _)) if distance >= least => continue,
                    Some(_) => {}
                }
                nearest[node] = Some((distance, k));
            }
        }
    }

    /// Newton's method for x = X + u(X, t), all nodes at once; x is the targets.
    fn invert_motion<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let mut unsettled = None;
        for _ in 0..NEWTON_ITERATIONS {
            field.displacement(time, &self.reference, &mut self.value);
            field.displacement_gradient(time, &self.reference, &mut self.displacement_gradient);
            unsettled = None;
            for (k, position) in self.target.iter().enumerate() {
                let residual = self.reference[k] + self.value[k] - position;
                let size = position.amax() + self.value[k].amax() + grid.lattice.cell_size.amax();
                if residual.amax() <= T::of(32.0) * T::default_epsilon() * size {
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
            step: 0, // set by the solver
            time: time.to_f64(),
            particle: None,
            reference_position: components(&self.reference[k]),
            cause: Cause::NoReferencePosition {
                position: components(&grid.lattice.position(self.nodes[k])),
            },
        }
    }

    /// Drops the nodes whose weights are 0 on all faces.
    ///
    /// A face prescribes a node if the present position of the face's nearest point is behind the node, or nearer along the
    /// present normal than the node's weights reach.
    fn keep_held_nodes<F>(&mut self, field: &F, time: T, grid: &Grid<T, D>)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.held.clear();
        self.held.resize(self.nodes.len(), false);
        for (surface, _) in &self.faces {
            self.foot.clone_from(&self.reference);
            self.normal.clone_from(&self.reference);
            for (foot, normal) in self.foot.iter_mut().zip(&mut self.normal) {
                [*foot, *normal] = surface.foot(foot);
            }
            if self.moves {
                let gradient = &mut self.displacement_gradient;
                field.displacement_gradient(time, &self.foot, gradient);
                field.displacement(time, &self.foot, &mut self.value);
                self.foot.iter_mut().zip(&self.value).for_each(|(foot, u)| *foot += *u);
                for (normal, gradient) in self.normal.iter_mut().zip(&*gradient) {
                    // Nanson: n is along F^-T N.
                    if let Some(inverse) = inverse_deformation_gradient(gradient) {
                        *normal = inverse.tr_mul(normal).normalize();
                    }
                }
            }
            for (k, &node) in self.nodes.iter().enumerate() {
                let depth = (self.foot[k] - grid.lattice.position(node)).dot(&self.normal[k]);
                self.held[k] |= depth < surface.reach(&self.normal[k], &grid.lattice);
            }
        }
        let mut kept = 0;
        for k in 0..self.nodes.len() {
            if self.held[k] {
                self.nodes[kept] = self.nodes[k];
                self.reference[kept] = self.reference[k];
                self.sign[kept] = self.sign[k];
                kept += 1;
            }
        }
        self.nodes.truncate(kept);
        self.reference.truncate(kept);
        self.value.truncate(kept);
    }

    /// Writes the field's `exact` values to the prescribed nodes.
    pub fn impose(
        &mut self,
        nodal: &mut [Nodal<T>],
        exact: impl FnOnce(&[Vector<T, D>], &mut [Vector<T, D>]),
    ) {
        if self.nodes.is_empty() {
            return;
        }
        exact(&self.reference, &mut self.value);
        for ((&node, value), &sign) in self.nodes.iter().zip(&self.value).zip(&self.sign) {
            nodal[node] = Nodal::new(&(value * sign), T::zero());
        }
    }
}
