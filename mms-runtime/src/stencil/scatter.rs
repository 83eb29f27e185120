//! The sums of a pack onto its nodes (P2G, scatter).
//!
//! A node receives w0 w1 w2 q + A0 w1 w2 + w0 A1 w2 + w0 w1 A2. The gradient weight A_a of a node replaces the weight along
//! axis a (`gradient_weights`; `GRADIENTS` says whether there are any). It is the sum of two terms: Q_a times the slope of the
//! weight, for forces, and M_a times the moment of the weight, for APIC. So one sum serves both.
//!
//! Along an axis with three nodes one cell apart, weights sum to 1 and gradient weights to 0, and the middle node has the
//! largest weight. So the total of the three nodes needs no product, and the middle node receives the total minus the outer
//! two: a third fewer multiply-adds.

use mms_math::simd::Simd;

use super::tensor::{Along, ProductStencil, Sharing};
use super::{ALL, HALF, Members, Payload};
use crate::nodal::Window;
use crate::real::Real;

/// The data to add to the nodes, with gradient weights (`GRADIENTS`) or without.
pub(super) struct Scatter<'a, M: Simd<T>, T: Real, const D: usize, const GRADIENTS: bool> {
    pub simd: M,
    pub stencil: &'a ProductStencil<T, D>,
    pub payload: &'a Payload<M::Eight, D>,
    /// Moments of the weights, if the data have moments.
    pub moment: Option<&'a Along<T, D>>,
    pub members: Members,
}

/// The nodes that the data of the two halves of a pack are added to.
#[derive(Clone, Copy)]
enum Targets {
    /// Both halves to the same nodes, from this one on.
    Together(u32),
    /// Each half to its own nodes; `None` skips a half whose particle is not a member.
    Apart([Option<u32>; 2]),
}

/// For every axis, and `W` nodes along it, the gradient weights of each particle of both halves.
type GradientWeights<F, const D: usize, const W: usize> = [[[F; HALF]; W]; D];

impl<M: Simd<T>, T: Real, const D: usize, const GRADIENTS: bool> Scatter<'_, M, T, D, GRADIENTS> {
    /// Adds to `W` nodes along every axis: for the particles of each half together if they share their nodes, otherwise for one
    /// particle of each half after the other.
    #[inline(always)]
    pub fn add<const W: usize>(&self, mut nodes: Window<'_, T>) {
        let ProductStencil { first, .. } = self.stencil;
        let regular = self.stencil.is_regular();
        let sharing = self.stencil.sharing();
        if sharing != Sharing::Apart && self.members == ALL && (W != 3 || regular) {
            let targets = match sharing {
                Sharing::All => Targets::Together(first[0]),
                _ => Targets::Apart([Some(first[0]), Some(first[HALF])]),
            };
            if W == 3 {
                let gradient_weights = self.gradient_weights::<W, true>();
                self.of::<W, HALF, true>(0, targets, &gradient_weights, nodes);
            } else {
                let gradient_weights = self.gradient_weights::<W, false>();
                self.of::<W, HALF, false>(0, targets, &gradient_weights, nodes);
            }
            return;
        }
        let gradient_weights = self.gradient_weights::<W, false>();
        let [from, to] = self.members;
        for k in 0..HALF {
            let meant = |p: usize| (from <= p && p < to).then_some(first[p]);
            let pair = [meant(k), meant(k + HALF)];
            if pair != [None; 2] {
                self.of::<W, 1, false>(
                    k,
                    Targets::Apart(pair),
                    &gradient_weights,
                    nodes.reborrow(),
                );
            }
        }
    }

    /// The gradient weights of all nodes; with `REST`, the middle node, which receives the rest, has none.
    #[inline(always)]
    fn gradient_weights<const W: usize, const REST: bool>(
        &self,
    ) -> GradientWeights<M::Eight, D, W> {
        // Tested once, not for every node.
        match (GRADIENTS, self.moment) {
            (true, Some(_)) => self.asides_with::<W, REST, true>(),
            (true, None) => self.asides_with::<W, REST, false>(),
            (false, _) => [[[self.simd.splat(T::zero()); HALF]; W]; D],
        }
    }

    /// The gradient weights of all nodes, with `MOMENTS` or without.
    #[inline(always)]
    fn asides_with<const W: usize, const REST: bool, const MOMENTS: bool>(
        &self,
    ) -> GradientWeights<M::Eight, D, W> {
        let simd = self.simd;
        let nothing = simd.splat(T::zero());
        let mut gradient_weights = [[[nothing; HALF]; W]; D];
        for a in 0..D {
            for k in 0..W {
                if !(REST && k == 1) {
                    gradient_weights[a][k] = self.gradient_weight::<MOMENTS>(a, k);
                }
            }
        }
        if REST && D > 2 {
            // The middle plane does not receive a rest: its gradient weight makes the sum of all three 0.
            for p in 0..HALF {
                let outer =
                    simd.plus(gradient_weights[2 % D][0][p], gradient_weights[2 % D][W - 1][p]);
                gradient_weights[2 % D][1][p] = simd.minus(nothing, outer);
            }
        }
        gradient_weights
    }

    /// The gradient weights of node `k` along an axis, one for each particle.
    #[inline(always)]
    fn gradient_weight<const MOMENTS: bool>(&self, axis: usize, k: usize) -> [M::Eight; HALF] {
        let Self { simd, stencil, moment, .. } = *self;
        let Payload { slopes, moments, .. } = self.payload;
        let mut rows = [simd.splat(T::zero()); HALF];
        if let Some(slopes) = slopes {
            let slope = simd.eight(&stencil.slope[axis][k]);
            for c in 0..D {
                rows[c] = simd.times(slope, slopes[axis][c]);
            }
        }
        if let (true, Some(moments), Some(moment)) = (MOMENTS, moments, moment) {
            let moment = simd.eight(&moment[axis][k]);
            for c in 0..D {
                rows[c] = simd.times_plus(moment, moments[axis][c], rows[c]);
            }
        }
        simd.transposed(rows)
    }

    /// Adds `P` particles of each half from `from` on; with `REST`, the middle one of three nodes receives the total minus the
    /// outer two.
    #[inline(always)]
    fn of<const W: usize, const P: usize, const REST: bool>(
        &self,
        from: usize,
        targets: Targets,
        gradient_weights: &GradientWeights<M::Eight, D, W>,
        mut nodes: Window<'_, T>,
    ) {
        let Self { simd, stencil: ProductStencil { stride, .. }, .. } = self;
        let simd = *simd;
        let mut along = [[simd.splat(T::zero()); P]; W];
        for k0 in 0..W {
            along[k0] = self.weights(from, 0, k0);
        }
        for k2 in 0..if D > 2 { W } else { 1 } {
            let plane = self.plane::<W, P>(from, k2, gradient_weights);
            let apart = if D > 2 { k2 as u32 * stride[2 % D] } else { 0 };
            if D == 1 {
                let sums = self.sums::<W, P, REST>(&along, &plane, None);
                self.put(&mut nodes, targets, apart, &sums);
            } else if REST {
                let mut rest = self.sums::<W, P, REST>(&along, &plane, None);
                let before =
                    self.sums::<W, P, REST>(&along, &plane, Some((0, self.weights(from, 1, 0))));
                self.put(&mut nodes, targets, apart, &before);
                let after =
                    self.sums::<W, P, REST>(&along, &plane, Some((2, self.weights(from, 1, 2))));
                self.put(&mut nodes, targets, apart + 2 * stride[1 % D], &after);
                for k0 in 0..W {
                    rest[k0] = simd.minus(simd.minus(rest[k0], before[k0]), after[k0]);
                }
                self.put(&mut nodes, targets, apart + stride[1 % D], &rest);
            } else {
                for k1 in 0..W {
                    let row = Some((k1, self.weights(from, 1, k1)));
                    let sums = self.sums::<W, P, REST>(&along, &plane, row);
                    self.put(&mut nodes, targets, apart + k1 as u32 * stride[1 % D], &sums);
                }
            }
        }
    }

    /// The weights of node `k` along an axis for `P` particles of each half from `from` on, each repeated in all places of its
    /// half.
    #[inline(always)]
    fn weights<const P: usize>(&self, from: usize, axis: usize, k: usize) -> [M::Eight; P] {
        let Self { simd, stencil: ProductStencil { weight, .. }, .. } = self;
        let (simd, weight) = (*simd, &weight[axis % D][k]);
        let mut weights = [simd.splat(T::zero()); P];
        if P == HALF {
            weights.copy_from_slice(&simd.spread(simd.eight(weight)));
        } else {
            for p in 0..P {
                weights[p] = simd.splat_halves(weight[from + p], weight[from + p + HALF]);
            }
        }
        weights
    }

    /// Computes the data of a plane.
    #[inline(always)]
    fn plane<const W: usize, const P: usize>(
        &self,
        from: usize,
        k2: usize,
        gradient_weights: &GradientWeights<M::Eight, D, W>,
    ) -> Plane<M::Eight, W, P> {
        let Self { simd, payload, .. } = *self;
        let zero = simd.splat(T::zero());
        let mut plane = Plane { value: [zero; P], gradient_weights: [[[zero; P]; W]; 2] };
        let weights = if D > 2 { self.weights::<P>(from, 2, k2) } else { [zero; P] };
        for p in 0..P {
            let (value, weight) = (payload.value[from + p], weights[p]);
            plane.value[p] = match (D > 2, GRADIENTS) {
                (false, _) => value,
                (true, false) => simd.times(weight, value),
                (true, true) => {
                    simd.times_plus(weight, value, gradient_weights[2 % D][k2][from + p])
                }
            };
            for a in 0..2 {
                for k in 0..W {
                    let gradient_weight = gradient_weights[a % D][k][from + p];
                    plane.gradient_weights[a][k][p] =
                        if D > 2 { simd.times(weight, gradient_weight) } else { gradient_weight };
                }
            }
        }
        plane
    }

    /// The sums for the nodes of one row of a plane, given its number and weights, or of all rows together if `None`.
    #[inline(always)]
    fn sums<const W: usize, const P: usize, const REST: bool>(
        &self,
        along: &[[M::Eight; P]; W],
        plane: &Plane<M::Eight, W, P>,
        row: Option<(usize, [M::Eight; P])>,
    ) -> [M::Eight; W] {
        let simd = self.simd;
        // -0 + x is x for every x, so the compiler drops the first addition.
        let mut sums = [simd.splat(-T::zero()); W];
        for p in 0..P {
            let value = match row {
                Some((k1, weights)) if GRADIENTS => {
                    simd.times_plus(weights[p], plane.value[p], plane.gradient_weights[1][k1][p])
                }
                Some((_, weights)) => simd.times(weights[p], plane.value[p]),
                None => plane.value[p],
            };
            for k0 in 0..W {
                if REST && k0 == 1 {
                    sums[1] = simd.plus(sums[1], value);
                } else {
                    sums[k0] = simd.times_plus(along[k0][p], value, sums[k0]);
                    if GRADIENTS {
                        let gradient_weight = plane.gradient_weights[0][k0][p];
                        sums[k0] = match row {
                            Some((_, weights)) => {
                                simd.times_plus(weights[p], gradient_weight, sums[k0])
                            }
                            None => simd.plus(sums[k0], gradient_weight),
                        };
                    }
                }
            }
        }
        if REST {
            sums[1] = simd.minus(sums[1], simd.plus(sums[0], sums[2]));
        }
        sums
    }

    /// Adds to the nodes of the row at the distance `apart` from the first one.
    #[inline(always)]
    fn put<const W: usize>(
        &self,
        nodes: &mut Window<'_, T>,
        targets: Targets,
        apart: u32,
        sums: &[M::Eight; W],
    ) {
        let simd = self.simd;
        match targets {
            Targets::Together(first) => {
                let row = nodes.row::<W>(first.wrapping_add(apart));
                for k0 in 0..W {
                    simd.add_halves(&mut row[k0].0, sums[k0]);
                }
            }
            Targets::Apart([one, two]) => {
                if let Some(first) = one {
                    let row = nodes.row::<W>(first.wrapping_add(apart));
                    for k0 in 0..W {
                        simd.add_first(&mut row[k0].0, sums[k0]);
                    }
                }
                if let Some(first) = two {
                    let row = nodes.row::<W>(first.wrapping_add(apart));
                    for k0 in 0..W {
                        simd.add_second(&mut row[k0].0, sums[k0]);
                    }
                }
            }
        }
    }
}

/// The data of `P` particles of each half for a plane of nodes, without the factors of the weights along the first two axes.
#[derive(Clone, Copy)]
struct Plane<F, const W: usize, const P: usize> {
    value: [F; P],
    /// The gradient weights along the first two axes.
    gradient_weights: [[[F; P]; W]; 2],
}
