//! Stencils that are products of weights along the axes.
//!
//! The sums are factorised: factors that do not depend on the node along an axis are multiplied once for all nodes along it. So
//! a node needs one product per number, and one more if there are slopes.

use std::ops::Range;

use mms_math::dispatch::{IsaLevel, Work};
use mms_math::simd::Simd;

use super::gather::{Summed, Sums};
use super::scatter::Scatter;
use super::{Gathered, HALF, Members, PACK, Payload, Stencil, Wanted};
use crate::defect::{Defect, on};
use crate::lattice::Lattice;
use crate::nodal::{Nodal, Window};
use crate::real::{Real, Vector};

/// A number for each particle of a pack, for every axis and the first, second, .. node along it.
pub(super) type Along<T, const D: usize> = [[[T; PACK]; MOST]; D];

/// The largest number of nodes along an axis.
pub const MOST: usize = 4;

/// The particles of a pack that have the same nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sharing {
    /// All particles.
    All,
    /// The particles of each half.
    Halves,
    /// Not all particles of each half.
    Apart,
}

/// The properties that the weights have along every axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Nodes are one cell apart, and the weights are splines with knots one cell apart.
    Splines,
    /// Nodes are one cell apart, and weights sum to 1.
    Regular,
    /// The weights have none of these properties.
    Nothing,
}

/// A stencil that is the product of the weights along the axes. The number of nodes along each axis is the same for all
/// particles of a pack; the sums depend on nothing else of the shape function.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct ProductStencil<T, const D: usize> {
    pub(super) weight: Along<T, D>,
    /// The derivatives of the weights, per length.
    pub(super) slope: Along<T, D>,
    /// Number of the first node along each axis.
    start: [[i32; PACK]; D],
    /// Index of the first node in the grid's arrays.
    pub(super) first: [u32; PACK],
    /// Distance in the grid's arrays between neighbours along each axis.
    pub(super) stride: [u32; D],
    /// The sum of the strides.
    strides: u32,
    /// Whether all particles of each half have the same nodes.
    shared: bool,
    /// The largest number of nodes along each axis that have a weight: 2, 3 or 4. Entries at index >= `width` are unused.
    pub(super) width: usize,
    known: Known,
    /// On a meridian, the particles' distances from the axis, for the weights w/r of the strain around it.
    radius: [T; PACK],
    /// On a meridian, the factors w of the hoop weights w/r along the first axis, if they differ from [`weight`](Self::weight).
    around: Option<[[T; PACK]; MOST]>,
}

impl<T: Real, const D: usize> ProductStencil<T, D> {
    /// A stencil without nodes.
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            weight: [[[T::zero(); PACK]; MOST]; D],
            slope: [[[T::zero(); PACK]; MOST]; D],
            start: [[0; PACK]; D],
            first: [0; PACK],
            stride: [0; D],
            strides: 0,
            shared: true,
            width: MOST,
            known: Known::Nothing,
            radius: [T::one(); PACK],
            around: None,
        }
    }

    /// Sets the distances r from the axis, and the w of the weights w/r along the first axis if they differ from the weights of
    /// [`set`](Self::set).
    #[inline(always)]
    pub fn set_around<M: Simd<T>, const W: usize>(
        &mut self,
        simd: M,
        radius: M::Eight,
        weights: Option<[M::Eight; W]>,
    ) {
        self.radius = simd.numbers(radius);
        self.around = weights.map(|weights| {
            let mut numbers = [[T::zero(); PACK]; MOST];
            for k in 0..W {
                numbers[k] = simd.numbers(weights[k]);
            }
            numbers
        });
    }

    /// The distances from the axis of revolution.
    pub fn radius(&self) -> &[T; PACK] {
        &self.radius
    }

    /// The stencil with the weights w of w/r, if they differ from the stencil's own weights.
    pub fn around(&self) -> Option<Self> {
        self.around.map(|weights| {
            let mut stencil = *self;
            stencil.weight[0] = weights;
            stencil
        })
    }

    /// Begins a stencil of `W` weights along each axis.
    #[inline(always)]
    pub fn begin<const W: usize>(&mut self, lattice: &Lattice<T, D>, known: Known) {
        const { assert!(W >= 2 && W <= MOST) };
        self.first = [0; PACK];
        // There are fewer than 2^32 nodes.
        self.stride = std::array::from_fn(|a| lattice.stride[a] as u32);
        self.strides = self.stride.iter().sum();
        (self.width, self.known) = (W, known);
    }

    /// Sets the weights along an axis, and their derivatives per cell, of the nodes from `first` on. If these are not all on
    /// the grid, the stencil must not be used.
    #[inline(always)]
    pub fn set<M: Simd<T>, const W: usize>(
        &mut self,
        simd: M,
        lattice: &Lattice<T, D>,
        axis: usize,
        first: M::Eight,
        [weight, slope]: [[M::Eight; W]; 2],
    ) {
        let length_axis = if on(Defect::SquareCells) { 0 } else { axis };
        let per_length = simd.splat(lattice.per_length[length_axis]);
        for k in 0..W {
            self.weight[axis][k] = simd.numbers(weight[k]);
            self.slope[axis][k] = simd.numbers(simd.times(slope[k], per_length));
        }
        self.start[axis] = simd.whole(first);
        for p in 0..PACK {
            let along = (self.start[axis][p] as u32).wrapping_mul(self.stride[axis]);
            self.first[p] = self.first[p].wrapping_add(along);
        }
        if axis + 1 == D {
            let mut different = 0;
            for p in 0..PACK {
                different |= self.first[p] ^ self.first[p / HALF * HALF];
            }
            self.shared = different == 0;
        }
    }

    /// The particles that have the same nodes.
    #[inline(always)]
    pub(super) fn sharing(&self) -> Sharing {
        if !self.shared {
            Sharing::Apart
        } else if self.first[0] == self.first[HALF] {
            Sharing::All
        } else {
            Sharing::Halves
        }
    }

    /// Whether all nodes are one cell apart, and along each axis weights sum to 1.
    #[inline(always)]
    pub(super) fn is_regular(&self) -> bool {
        self.known != Known::Nothing
    }

    /// The moments w (x_i - x_p), and the inverse of sum_i w (x_i - x_p)^2 along each axis, of `W` nodes.
    #[inline(always)]
    fn moments<M: Simd<T>, const W: usize>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
    ) -> (Along<T, D>, [M::Eight; D]) {
        let zero = simd.splat(T::zero());
        let mut moment = [[[T::zero(); PACK]; MOST]; D];
        let mut per_spread = [zero; D];
        for a in 0..D {
            let (mut weight, mut apart) = ([zero; W], [zero; W]);
            let mut middle = zero;
            for k in 0..W {
                weight[k] = simd.eight(&self.weight[a][k]);
                apart[k] = self.beyond_first(simd, lattice, a, k);
                middle = simd.times_plus(weight[k], apart[k], middle);
            }
            let mut spread = zero;
            for k in 0..W {
                apart[k] = simd.minus(apart[k], middle);
                weight[k] = simd.times(weight[k], apart[k]);
                spread = simd.times_plus(weight[k], apart[k], spread);
                moment[a][k] = simd.numbers(weight[k]);
            }
            per_spread[a] = if W > 2 && self.known == Known::Splines {
                // The variance of the sum of W uniform distributions over a cell, whose density is a B-spline.
                let h = lattice.cell_size[a];
                simd.splat(T::ratio(12, W as i32) / (h * h))
            } else {
                simd.over(simd.splat(T::one()), spread)
            };
        }
        (moment, per_spread)
    }

    /// The distance of a node from the first one along an axis.
    #[inline(always)]
    fn beyond_first<M: Simd<T>>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        axis: usize,
        k: usize,
    ) -> M::Eight {
        if self.is_regular() {
            return simd.splat(lattice.cell_size[axis] * T::of(k as f64));
        }
        let coordinate = &lattice.coordinate[axis];
        let apart = std::array::from_fn(|p| {
            let start = self.start[axis][p] as usize;
            // Beyond the width weights are 0, and nodes may not exist.
            coordinate.get(start + k).map_or(T::zero(), |&there| there - coordinate[start])
        });
        simd.eight(&apart)
    }

    /// The distance between the first and the last node in the grid's arrays.
    #[inline(always)]
    fn extent(&self) -> usize {
        (self.width - 1) * self.strides as usize
    }

    /// The first of the `members` whose first node is not among the nodes `start..start + room`.
    #[cold]
    #[inline(never)]
    fn first_beyond(&self, [from, to]: Members, start: u32, room: u32) -> Option<usize> {
        (from..to).find(|&p| self.first[p].wrapping_sub(start) >= room)
    }

    /// Does [`Stencil::scatter`] for stencils of `W` nodes along each axis.
    #[inline(always)]
    pub(crate) fn scatter_to<M: Simd<T>, const W: usize>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        payload: &Payload<M::Eight, D>,
        members: Members,
        nodes: Window<'_, T>,
    ) {
        if M::ALONE {
            let moment = payload.moments.map(|_| self.moments::<M, W>(simd, lattice).0);
            let payload = Payload::of(simd, payload);
            return self.scatter_alone(&payload, moment.as_ref(), members, nodes);
        }
        if payload.slopes.is_some() || payload.moments.is_some() {
            self.onto::<M, W, true>(simd, lattice, payload, members, nodes);
        } else {
            self.onto::<M, W, false>(simd, lattice, payload, members, nodes);
        }
    }

    /// Adds to the nodes, with gradient weights (`GRADIENTS`) or without. Sums of hat functions are inlined, since they take less
    /// time than a call.
    #[inline(always)]
    fn onto<M: Simd<T>, const W: usize, const GRADIENTS: bool>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        payload: &Payload<M::Eight, D>,
        members: Members,
        nodes: Window<'_, T>,
    ) {
        let stencil = self;
        if W == 2 {
            return stencil.add::<M, W, GRADIENTS>(simd, lattice, payload, members, nodes);
        }
        let payload = Payload::of(simd, payload);
        simd.apart(Onto::<_, D, W, GRADIENTS> { stencil, lattice, payload, members, nodes });
    }

    /// Adds to `W` nodes along every axis.
    #[inline(always)]
    fn add<M: Simd<T>, const W: usize, const GRADIENTS: bool>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        payload: &Payload<M::Eight, D>,
        members: Members,
        nodes: Window<'_, T>,
    ) {
        let (stencil, own);
        stencil = self;
        let moment = if GRADIENTS && payload.moments.is_some() {
            (own, _) = self.moments::<M, W>(simd, lattice);
            Some(&own)
        } else {
            None
        };
        let sums = Scatter::<M, T, D, GRADIENTS> { simd, stencil, payload, moment, members };
        sums.add::<W>(nodes);
    }

    /// Does [`Stencil::gather`] for stencils of `W` nodes along each axis.
    #[inline(always)]
    pub(crate) fn gather_from<M: Simd<T>, const W: usize>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        wanted: Wanted,
        nodes: &[Nodal<T>],
    ) -> Gathered<M::Eight, D> {
        let nothing = [[simd.splat(T::zero()); D]; D];
        match wanted {
            Wanted::Value => {
                let sums = Sums { stencil: self, gradient_weights: [], nodes };
                let Summed { value, gradient_weights: [] } = sums.over::<M, W>(simd);
                Gathered { value, gradient: nothing, slopes: nothing }
            }
            Wanted::Slopes if W > 2 && lattice.degree > 1 => {
                let (moment, per_spread) = self.moments::<M, W>(simd, lattice);
                let sums = Sums { stencil: self, gradient_weights: [&self.slope, &moment], nodes };
                let Summed { value, gradient_weights: [gradient, mut slopes] } =
                    sums.over::<M, W>(simd);
                for a in 0..D {
                    for c in 0..D {
                        slopes[a][c] = simd.times(slopes[a][c], per_spread[a]);
                    }
                }
                Gathered { value, gradient, slopes }
            }
            Wanted::Gradient | Wanted::Slopes => {
                let sums = Sums { stencil: self, gradient_weights: [&self.slope], nodes };
                let Summed { value, gradient_weights: [gradient] } = sums.over::<M, W>(simd);
                let slopes = if wanted == Wanted::Slopes { gradient } else { nothing };
                Gathered { value, gradient, slopes }
            }
        }
    }
}

/// The sums onto `W` nodes along every axis, in a function that is not inlined, so that they are compiled once.
struct Onto<'a, T: Real, const D: usize, const W: usize, const GRADIENTS: bool> {
    stencil: &'a ProductStencil<T, D>,
    lattice: &'a Lattice<T, D>,
    payload: Payload<[T; PACK], D>,
    members: Members,
    nodes: Window<'a, T>,
}

impl<T: Real, const D: usize, const W: usize, const GRADIENTS: bool> Work<T>
    for Onto<'_, T, D, W, GRADIENTS>
{
    type Output = ();

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) {
        let Self { stencil, lattice, members, nodes, .. } = self;
        let payload = &self.payload.eights(simd);
        stencil.add::<M, W, GRADIENTS>(simd, lattice, payload, members, nodes);
    }
}

impl<T: Real, const D: usize> Default for ProductStencil<T, D> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const D: usize> Stencil<T, D> for ProductStencil<T, D> {
    const WIDEST: IsaLevel = match D {
        // A single row of nodes has little to sum.
        1 => IsaLevel::Baseline,
        // A register of AVX2 holds eight numbers of single precision.
        _ if size_of::<T>() < size_of::<f64>() => IsaLevel::Avx2,
        _ => IsaLevel::Avx512,
    };

    fn each(&self, particle: usize, mut visit: impl FnMut(usize, T, Vector<T, D>)) {
        let width = |a: usize| if a < D { self.width } else { 1 };
        for k2 in 0..width(2) {
            for k1 in 0..width(1) {
                for k0 in 0..width(0) {
                    let k = [k0, k1, k2];
                    let from_first: usize = (0..D).map(|a| k[a] * self.stride[a] as usize).sum();
                    let product = |skip: usize| {
                        let others = (0..D).filter(|&a| a != skip);
                        others.fold(T::one(), |product, a| product * self.weight[a][k[a]][particle])
                    };
                    let gradient =
                        Vector::from_fn(|a, _| self.slope[a][k[a]][particle] * product(a));
                    visit(self.first[particle] as usize + from_first, product(D), gradient);
                }
            }
        }
    }

    #[inline(always)]
    fn beyond(&self, members: Members, nodes: &Range<usize>) -> Option<usize> {
        // The number of possible first nodes; there are fewer than 2^32.
        let room = nodes.len().saturating_sub(self.extent()) as u32;
        let mut farthest = 0;
        for first in self.first {
            farthest = farthest.max(first.wrapping_sub(nodes.start as u32));
        }
        if farthest < room { None } else { self.first_beyond(members, nodes.start as u32, room) }
    }

    #[inline(always)]
    fn scatter<M: Simd<T>>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        payload: &Payload<M::Eight, D>,
        members: Members,
        nodes: Window<'_, T>,
    ) {
        match self.width {
            2 => self.scatter_to::<M, 2>(simd, lattice, payload, members, nodes),
            3 => self.scatter_to::<M, 3>(simd, lattice, payload, members, nodes),
            _ => self.scatter_to::<M, MOST>(simd, lattice, payload, members, nodes),
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
        match self.width {
            2 => self.gather_from::<M, 2>(simd, lattice, wanted, nodes),
            3 => self.gather_from::<M, 3>(simd, lattice, wanted, nodes),
            _ => self.gather_from::<M, MOST>(simd, lattice, wanted, nodes),
        }
    }

    fn product(&self) -> Option<&ProductStencil<T, D>> {
        Some(self)
    }
}
