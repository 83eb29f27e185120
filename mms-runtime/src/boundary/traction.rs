//! Tractions of the field on the faces of the body.
//!
//! f_i += sum over the pieces of a face of w_i(x_s) sigma n a, with sigma the stress of the material at the field's H at X_s.
//! In the updated formulation a piece is carried by the particle next to it, to x_s = x_p + F_p (X_s - X_p), and n a = cof(F_p)
//! N A0 (Nanson): a load that turns with the surface. On a meridian cof(F_p) is the cofactor matrix in the plane times F_tt.
//! Loads P N A0 of given direction would let a body under pressure on all sides turn over. In the total formulation F_p is the
//! field's, and the loads are P N A0.

use mms_math::simd::Plain;

use crate::axisymmetric::{hoop_strain, hoop_stretch};
use crate::body::Piece;
use crate::column::HALF;
use crate::defect::{Defect, on};
use crate::failure::{Cause, Failure, Refusal};
use crate::field::{Condition, Face, ManufacturedField};
use crate::lattice::Lattice;
use crate::nodal::{Nodal, Window, halves};
use crate::real::{Matrix, Real, Vector};
use crate::stencil::{Payload, ProductStencil, Stencil as _};
use crate::tensor::{cofactor, components, jacobian};

/// The present position of a piece of a face.
pub struct FacePoint<T, const D: usize> {
    /// x_s, where its force acts.
    pub position: Vector<T, D>,
    /// H of the particle that carries the piece, and F_tt or 1; `None` if the field's H is used.
    pub carrier: Option<(Matrix<T, D>, T)>,
}

/// The grid's geometry, and a function that finds the nodes and weights of a point
/// ([`Shape::point`](crate::shape::Shape::point)).
#[derive(Clone, Copy)]
pub struct TractionPoint<'a, T: Real, const D: usize> {
    /// The nodes.
    pub lattice: &'a Lattice<T, D>,
    /// Finds the nodes and weights of a point.
    pub stencil: StencilOf<T, D>,
}

/// A function that finds the nodes and weights of a point of a grid.
pub type StencilOf<T, const D: usize> =
    fn(&Lattice<T, D>, &Vector<T, D>) -> Result<ProductStencil<T, D>, Cause>;

/// The pieces of the faces with tractions; entry `k` of every array belongs to piece `k`.
pub struct Traction<T, const D: usize> {
    particle: Vec<usize>,
    /// X_s.
    reference: Vec<Vector<T, D>>,
    /// N A0.
    area: Vec<Vector<T, D>>,
    displacement_gradient: Vec<Matrix<T, D>>,
    kirchhoff_stress: Vec<Matrix<T, D>>,
}

impl<T: Real, const D: usize> Traction<T, D> {
    /// No face.
    pub fn none() -> Self {
        Self {
            particle: Vec::new(),
            reference: Vec::new(),
            area: Vec::new(),
            displacement_gradient: Vec::new(),
            kirchhoff_stress: Vec::new(),
        }
    }

    /// Adds the pieces of a face.
    ///
    /// # Errors
    /// The face has no pieces: particles do not lie along it.
    pub fn add_face(&mut self, face: Face, pieces: &[Piece<D>]) -> Result<(), Refusal> {
        let before = self.particle.len();
        for piece in pieces.iter().filter(|piece| piece.face == face) {
            self.particle.push(piece.particle);
            self.reference.push(piece.position.map(T::of));
            self.area.push(piece.area.map(T::of));
        }
        let count = self.particle.len();
        if count == before {
            return Err(Refusal::RaggedFace { face, condition: Condition::Traction });
        }
        self.displacement_gradient.resize(count, Matrix::zeros());
        self.kirchhoff_stress.resize(count, Matrix::zeros());
        Ok(())
    }

    /// Adds this `share` of the forces at `time`. `place` computes where the piece of a face at X that a particle carries is,
    /// and `point` the nodes of a place.
    ///
    /// # Errors
    /// A piece is off the grid, or the field's F is singular there.
    pub fn apply<F>(
        &mut self,
        field: &F,
        time: T,
        point: TractionPoint<'_, T, D>,
        place: impl Fn(usize, &Vector<T, D>) -> FacePoint<T, D>,
        share: T,
        extensive: &mut [Nodal<T>],
    ) -> Result<(), Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        if self.particle.is_empty() {
            return Ok(());
        }
        let simd = T::PlainSimd::from(Plain);
        let Self { particle, reference, area, displacement_gradient, kirchhoff_stress } = self;
        field.displacement_gradient(time, reference, displacement_gradient);
        field.surface_stress(time, reference, displacement_gradient, kirchhoff_stress);
        let hoop_strain = hoop_strain(field, time, reference);
        for (k, &particle) in particle.iter().enumerate() {
            let fail = |cause: Cause| Failure {
                step: 0, // set by the solver
                time: time.to_f64(),
                particle: Some(particle),
                reference_position: components(&reference[k]),
                cause,
            };
            let exact = (displacement_gradient[k], hoop_stretch(&hoop_strain, k));
            let FacePoint { position, carrier } = place(particle, &reference[k]);
            let (carrier, hoop) = carrier.unwrap_or(exact);
            let present_area = match cofactor(&carrier) {
                None => return Err(fail(Cause::NotFinite { quantity: "traction" })),
                Some(_) if on(Defect::TractionArea) => area[k],
                Some(cofactor) => cofactor * area[k] * hoop,
            };
            let volume = jacobian(&exact.0) * exact.1;
            let ratio = if on(Defect::TractionOfKirchhoff) { T::one() } else { volume };
            let traction = kirchhoff_stress[k] * present_area * share / ratio;
            let stencil = (point.stencil)(point.lattice, &position).map_err(fail)?;
            let traction = halves(simd, [&traction; 2], T::zero());
            let nodes = Window { start: 0, nodes: &mut *extensive };
            let payload = Payload::value([traction; HALF]);
            stencil.scatter(simd, point.lattice, &payload, [0, 1], nodes);
        }
        Ok(())
    }
}
