//! Convected particle domain interpolation: a particle is a parallelepiped that follows F.
//!
//! Sadeghirad, Brannon, Burghardt, "A convected particle domain interpolation technique to extend
//! applicability of the material point method for problems involving massive deformations", Int. J.
//! Numer. Meth. Engng 86 (2011), doi 10.1002/nme.3110. The hat functions N_i are replaced by their
//! multilinear interpolants between the corners x_c of x_p + R xi, |xi_a| <= 1, R = F R_0, and averaged:
//!
//! w = 2^-D sum_c N_i(x_c),   grad w = 2^-D sum_c N_i(x_c) R^-T s_c,   s_c the signs of xi at the corner.

use std::ops::Range;

use mms_math::dispatch::IsaLevel;
use mms_math::simd::Simd;

use super::Shape;
use crate::column::{HALF, PACK};
use crate::column::{Matrices, Pack as _};
use crate::defect::{Defect, on};
use crate::failure::Cause;
use crate::lanes::{columns, scaled};
use crate::lattice::Lattice;
use crate::nodal::{Nodal, Window};
use crate::real::{Matrix, Real, Vector};
use crate::spline;
use crate::stencil::{Gathered, Members, Payload, ProductStencil, Stencil, Wanted};
use crate::tensor::{deformation_gradient, inverse};

/// GIMP on parallelepipeds: shear and rotation are followed, without gaps or overlaps in a uniform F.
pub struct Cpdi;

/// The corners of a parallelepiped in three dimensions.
const MOST_CORNERS: usize = 8;

/// Every corner's hat functions, and the directions of their gradients: a number for each particle of a pack.
#[derive(Clone, Debug)]
pub struct Corners<T, const D: usize> {
    /// The hat functions at the corners; only the first 2^D are used.
    hats: [ProductStencil<T, D>; MOST_CORNERS],
    /// 2^-D R^-T s_c.
    direction: [[[T; PACK]; D]; MOST_CORNERS],
    /// R s_c, from the particle to the corner.
    apart: [[[T; PACK]; D]; MOST_CORNERS],
}

impl Shape for Cpdi {
    const FOLLOWS: bool = true;
    const NEAR: bool = false;
    type Domain<T: Real, const D: usize> = Matrices<T, D>;
    type Stencil<T: Real, const D: usize> = Corners<T, D>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Matrix<T, D> {
        *half_edges
    }

    #[inline(always)]
    fn place<T: Real, M: Simd<T>, const D: usize>(
        simd: M,
        corners: &mut Corners<T, D>,
        lattice: &Lattice<T, D>,
        position: &[M::Eight; D],
        half_edges: &Matrices<T, D>,
        displacement_gradient: &Matrices<T, D>,
    ) -> Result<(), Cause> {
        let [mut all_present, mut all_inverse] = [Matrices::zeros(); 2];
        for p in 0..PACK {
            let half_edges = half_edges.get(p);
            let present = deformation_gradient(&displacement_gradient.get(p)) * half_edges;
            let present = if on(Defect::CornersKept) { half_edges } else { present };
            let inverse = inverse(&present).ok_or(Cause::FlatDomain)?;
            let transposed = on(Defect::CornersTransposed);
            all_present.set(p, &present);
            all_inverse.set(p, &if transposed { inverse.transpose() } else { inverse });
        }
        let (present, inverse) = (columns(simd, &all_present), columns(simd, &all_inverse));
        for c in 0..1 << D {
            let sign = |a: usize| if c >> a & 1 == 0 { -T::one() } else { T::one() };
            let share = simd.splat(T::ratio(1, 1 << D));
            let mut corner = *position;
            for i in 0..D {
                let [mut apart, mut direction] = [simd.splat(T::zero()); 2];
                for a in 0..D {
                    let sign = simd.splat(sign(a));
                    apart = simd.times_plus(present[a][i], sign, apart);
                    direction = simd.times_plus(inverse[i][a], sign, direction);
                }
                corner[i] = simd.plus(position[i], apart);
                corners.apart[c][i] = simd.numbers(apart);
                corners.direction[c][i] = simd.numbers(simd.times(direction, share));
            }
            spline::place::<T, M, D, 1, 2>(simd, &mut corners.hats[c], lattice, &corner)?;
        }
        Ok(())
    }

    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<ProductStencil<T, D>, Cause> {
        spline::point::<T, D, 1, 2>(lattice, position)
    }
}

impl<T: Real, const D: usize> Default for Corners<T, D> {
    fn default() -> Self {
        let nothing = [[[T::zero(); PACK]; D]; MOST_CORNERS];
        Self { hats: [ProductStencil::new(); MOST_CORNERS], direction: nothing, apart: nothing }
    }
}

impl<T: Real, const D: usize> Stencil<T, D> for Corners<T, D> {
    // AVX2 is as fast as AVX-512, and in one dimension the baseline is as fast as AVX2, as measured.
    const WIDEST: IsaLevel = if D == 1 { IsaLevel::Baseline } else { IsaLevel::Avx2 };

    fn each(&self, particle: usize, mut visit: impl FnMut(usize, T, Vector<T, D>)) {
        let share = T::ratio(1, 1 << D);
        for (hats, direction) in self.hats.iter().zip(&self.direction).take(1 << D) {
            let direction = Vector::<T, D>::from_fn(|a, _| direction[a][particle]);
            hats.each(particle, |node, w, _| visit(node, w * share, direction * w));
        }
    }

    fn beyond(&self, members: Members, nodes: &Range<usize>) -> Option<usize> {
        let hats = self.hats.iter().take(1 << D);
        hats.filter_map(|hats| hats.beyond(members, nodes)).min()
    }

    /// Scatters corner by corner: the moments of hat functions are about their corner, and the corner adds its own moment about
    /// the particle.
    #[inline(always)]
    fn scatter<M: Simd<T>>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        payload: &Payload<M::Eight, D>,
        members: Members,
        mut nodes: Window<'_, T>,
    ) {
        let zero = simd.splat(T::zero());
        let share = simd.splat(T::ratio(1, 1 << D));
        let mut moments = payload.moments;
        if let Some(moments) = &mut moments {
            *moments = scaled(simd, *moments, share);
        }
        for c in 0..1 << D {
            let mut rows = [zero; HALF];
            for a in 0..D {
                let direction = simd.eight(&self.direction[c][a]);
                let apart = simd.eight(&self.apart[c][a]);
                for i in 0..D {
                    if let Some(slopes) = &payload.slopes {
                        rows[i] = simd.times_plus(direction, slopes[a][i], rows[i]);
                    }
                    if let Some(moments) = &moments {
                        rows[i] = simd.times_plus(apart, moments[a][i], rows[i]);
                    }
                }
            }
            let mut value = simd.transposed(rows);
            for k in 0..HALF {
                value[k] = simd.times_plus(share, payload.value[k], value[k]);
            }
            let payload = Payload { value, slopes: None, moments };
            let nodes = nodes.reborrow();
            self.hats[c].scatter_to::<M, 2>(simd, lattice, &payload, members, nodes);
        }
    }

    #[inline(always)]
    fn gather<M: Simd<T>>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        wanted: Wanted,
        nodes: &[Nodal<T>],
    ) -> Gathered<M::Eight, D> {
        let zero = simd.splat(T::zero());
        let nothing = [[zero; D]; D];
        let mut gathered = Gathered { value: [zero; D], gradient: nothing, slopes: nothing };
        let share = simd.splat(T::ratio(1, 1 << D));
        for (hats, direction) in self.hats.iter().zip(&self.direction).take(1 << D) {
            let of_corner = hats.gather_from::<M, 2>(simd, lattice, Wanted::Value, nodes).value;
            for c in 0..D {
                let value = &mut gathered.value[c];
                *value = simd.times_plus(share, of_corner[c], *value);
                if wanted == Wanted::Value {
                    continue;
                }
                for a in 0..D {
                    let gradient = &mut gathered.gradient[a][c];
                    let along = simd.eight(&direction[a]);
                    *gradient = simd.times_plus(along, of_corner[c], *gradient);
                }
            }
        }
        if wanted == Wanted::Slopes {
            gathered.slopes = gathered.gradient;
        }
        gathered
    }
}
