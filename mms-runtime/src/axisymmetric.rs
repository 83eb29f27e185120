//! Bodies of revolution: the grid's plane is the meridian (R, Z), and masses, volumes and forces are per radian.
//!
//! A particle represents a ring. In the meridian it is a box with the half width l along R and its middle at R_m. The ring's
//! volume per radian is V0 = A R_m (Pappus), A being the area of the box. Beside the displacement gradient H of the meridian
//! the particle stores the hoop strain h = F_tt - 1 = u_R/R. Forces and strains around the axis follow from the weights w_i/r,
//! r being the distance from the axis:
//!
//! f_iR += - V0 S_tt w_i/r,   dF_tt/dt = F_tt sum_i v_iR w_i/r in the updated formulation,
//!
//! with S_tt = tau_tt. In the total formulation S_tt = P_tt, r is R, and the factor F_tt is left out.
//!
//! Shape functions that treat a particle as a point evaluate it at the middle of its box. Shape functions that treat it as a
//! box average over the ring (Nairn and Guilkey, "Axisymmetric form of the generalized interpolation material point method",
//! Int. J. Numer. Meth. Engng 101 (2015) 127-147, see [`crate::gimp`]). Averages of linear functions are their values at the
//! ring's centroid,
//!
//! R_m + l^2/(3 R_m),
//!
//! and so these particles lie there. Either way a uniform pressure leaves nodes inside a body in equilibrium.
//!
//! The axis is a wall that constrains its normal component: u_R = 0 there. No traction acts along it, for it has no area.

use crate::body::Filling;
use crate::column::{Column, Matrices, PACK, Packs};
use crate::defect::{Defect, on};
use crate::field::{Face, ManufacturedField};
use crate::material::Axisymmetric;
use crate::real::{Matrix, Real, Vector};

/// Computes the Kirchhoff stress of a field's material in the plane of the grid and, if the field is axisymmetric, around the
/// axis. Hoop strains and stresses are empty for other fields.
///
/// # Panics
/// If the slices have different lengths.
pub fn kirchhoff_stress<T: Real, const D: usize, F>(
    field: &F,
    time: T,
    reference: &[Vector<T, D>],
    (displacement_gradient, hoop_strain): (&[Matrix<T, D>], &[T]),
    (stress, hoop_stress): (&mut [Matrix<T, D>], &mut [T]),
) where
    F: ManufacturedField<T, D> + ?Sized,
{
    let Some(axisymmetric) = field.axisymmetric() else {
        return field.kirchhoff_stress(time, reference, displacement_gradient, stress);
    };
    let points: Column<Vector<T, D>> = reference.iter().copied().collect();
    let gradients: Packs<Matrices<T, D>> = displacement_gradient.iter().copied().collect();
    let strains: Column<T> = hoop_strain.iter().copied().collect();
    let (mut meridian, mut hoop): (Packs<Matrices<T, D>>, Column<T>) =
        (gradients.clone(), strains.clone());
    axisymmetric.kirchhoff_stress_of_packs(
        time,
        points.packs(),
        (gradients.packs(), strains.packs()),
        (meridian.packs_mut(), hoop.packs_mut()),
    );
    stress.iter_mut().zip(meridian.iter()).for_each(|(to, from)| *to = from);
    hoop_stress.copy_from_slice(&hoop);
}

/// Computes the strain energy of a field's material; see [`kirchhoff_stress`] for the strains.
pub fn strain_energy<T: Real, const D: usize, F>(
    field: &F,
    time: T,
    reference: &[Vector<T, D>],
    strains: (&[Matrix<T, D>], &[T]),
    energy: &mut [T],
) -> bool
where
    F: ManufacturedField<T, D> + ?Sized,
{
    match field.axisymmetric() {
        Some(axisymmetric) => axisymmetric.strain_energy(time, reference, strains, energy),
        None => field.strain_energy(time, reference, strains.0, energy),
    }
}

/// The field's hoop strain at each position; empty if the field is not axisymmetric.
pub fn hoop_strain<T: Real, const D: usize, F>(
    field: &F,
    time: T,
    reference: &[Vector<T, D>],
) -> Vec<T>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    let Some(axisymmetric) = field.axisymmetric() else { return Vec::new() };
    let mut strain = vec![T::zero(); reference.len()];
    axisymmetric.hoop_strain(time, reference, &mut strain);
    strain
}

/// The place of the particle of a ring along R.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Station {
    /// In the middle of its box.
    Middle,
    /// At the centroid of the ring.
    Centroid,
}

impl Station {
    /// The radius of the particle of a ring between `middle` - `half_width` and `middle` + `half_width`.
    fn radius(self, middle: f64, half_width: f64) -> f64 {
        match self {
            Station::Middle => middle,
            Station::Centroid => middle + half_width * half_width / (3.0 * middle),
        }
    }
}

/// The rules that turn boxes in the meridian into particles.
#[derive(Clone, Copy)]
pub struct Rings<'a> {
    /// The places of the particles.
    pub station: Station,
    /// The volume of a ring divided by the area of its box, by the radius of its middle: see [`Axisymmetric::weight`].
    pub weight: &'a dyn Fn(f64) -> f64,
}

/// F_tt = 1 + h of a particle; 1 if there are no hoop strains.
pub fn hoop_stretch<T: Real>(hoop_strain: &[T], particle: usize) -> T {
    hoop_strain.get(particle).map_or(T::one(), |&strain| T::one() + strain)
}

/// The entries of a pack of tensors of the meridian, column by column, and then the entry around the axis.
pub type Ring<T> = [[T; PACK]; 5];

/// The number of packs that are evaluated together.
const TOGETHER: usize = 32;

/// Evaluates a material that reads and writes [`Ring`]s, for some packs of particles.
pub fn by_rings<T: Real>(
    reference: &[[Vector<T, 2>; PACK]],
    (displacement_gradient, hoop_strain): (&[Matrices<T, 2>], &[[T; PACK]]),
    (stress, hoop_stress): (&mut [Matrices<T, 2>], &mut [[T; PACK]]),
    evaluate: impl Fn(&[[Vector<T, 2>; PACK]], &[Ring<T>], &mut [Ring<T>]),
) {
    let [mut strains, mut stresses] = [[[[T::zero(); PACK]; 5]; TOGETHER]; 2];
    for start in (0..reference.len()).step_by(TOGETHER) {
        let some = start..reference.len().min(start + TOGETHER);
        let (strains, stresses) = (&mut strains[..some.len()], &mut stresses[..some.len()]);
        let given = displacement_gradient[some.clone()].iter().zip(&hoop_strain[some.clone()]);
        for (ring, (h, hoop)) in strains.iter_mut().zip(given) {
            let [[rr, zr], [rz, zz]] = h.0;
            *ring = [rr, zr, rz, zz, *hoop];
        }
        evaluate(&reference[some.clone()], strains, stresses);
        let found = stress[some.clone()].iter_mut().zip(&mut hoop_stress[some]);
        for (&[rr, zr, rz, zz, around], (stress, hoop)) in stresses.iter().zip(found) {
            (stress.0, *hoop) = ([[rr, zr], [rz, zz]], around);
        }
    }
}

/// Computes the Kirchhoff stress in the meridian at the field's own hoop strains: the
/// [`Material::kirchhoff_stress_of_packs`](crate::Material::kirchhoff_stress_of_packs) of an axisymmetric field.
pub fn stress_at_own_strain<T: Real, const D: usize>(
    field: &(impl Axisymmetric<T, D> + ?Sized),
    time: T,
    reference: &[[Vector<T, D>; PACK]],
    displacement_gradient: &[Matrices<T, D>],
    stress: &mut [Matrices<T, D>],
) {
    let mut strains = vec![[T::zero(); PACK]; reference.len()];
    field.hoop_strain(time, reference.as_flattened(), strains.as_flattened_mut());
    let mut unread = strains.clone();
    let strains = (displacement_gradient, &strains[..]);
    field.kirchhoff_stress_of_packs(time, reference, strains, (stress, &mut unread));
}

/// Computes the strain energy at the field's own hoop strains: the
/// [`Material::strain_energy`](crate::Material::strain_energy) of an axisymmetric field.
pub fn energy_at_own_strain<T: Real, const D: usize>(
    field: &(impl Axisymmetric<T, D> + ?Sized),
    time: T,
    reference: &[Vector<T, D>],
    displacement_gradient: &[Matrix<T, D>],
    energy: &mut [T],
) -> bool {
    let mut strains = vec![T::zero(); reference.len()];
    field.hoop_strain(time, reference, &mut strains);
    field.strain_energy(time, reference, (displacement_gradient, &strains), energy)
}

impl<const D: usize> Filling<D> {
    /// Revolves boxes of the meridian: moves particles to their stations, and multiplies volumes and pieces of faces by the
    /// weight of their radius, which makes them volumes and pieces of rings, per radian.
    pub(crate) fn revolve(&mut self, Rings { station, weight }: Rings<'_>) {
        let middles: Vec<[f64; 2]> = self
            .position
            .iter()
            .zip(&self.half_edges)
            .map(|(x, edges)| [x[0], edges[(0, 0)]])
            .collect();
        for (p, &[middle, half_width]) in middles.iter().enumerate() {
            self.position[p][0] = station.radius(middle, half_width);
            self.volume[p] *= match () {
                () if on(Defect::RadiusWeight) => 1.0,
                () if on(Defect::EdgeVolume) => middle + half_width,
                () => weight(middle),
            };
        }
        for piece in &mut self.pieces {
            piece.area *= weight(piece.position[0]);
            if !matches!(piece.face, Face::Min(0) | Face::Max(0)) {
                let [middle, half_width] = middles[piece.particle];
                piece.position[0] = station.radius(middle, half_width);
            }
        }
    }
}
