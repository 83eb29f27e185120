//! The sums over the nodes of a pack (G2P, gather): for all its particles together, one component of the nodes' vectors after
//! the other.

use mms_math::dispatch::Work;
use mms_math::simd::Simd;

use super::tensor::{Along, ProductStencil, Sharing};
use super::{HALF, PACK, eights, numbers};
use crate::nodal::Nodal;
use crate::real::Real;

/// The sums to compute, and the nodes.
pub(super) struct Sums<'a, T, const D: usize, const K: usize> {
    pub stencil: &'a ProductStencil<T, D>,
    /// The `K` kinds of gradient weights, which replace the weights along one axis: slopes, moments.
    pub gradient_weights: [&'a Along<T, D>; K],
    pub nodes: &'a [Nodal<T>],
}

/// The sums of a vector: with weights, and with each of the `K` kinds of gradient weights for every axis.
#[derive(Clone, Copy)]
pub(super) struct Summed<F, const D: usize, const K: usize> {
    pub value: [F; D],
    pub gradient_weights: [[[F; D]; D]; K],
}

/// The weights and gradient weights of the nodes along an axis.
#[derive(Clone, Copy)]
struct Axis<F, const W: usize, const K: usize> {
    weight: [F; W],
    gradient_weights: [[F; W]; K],
}

/// A row of nodes along the first axis, for each half.
type NodeRow<'a, T, const W: usize> = [&'a [Nodal<T>; W]; 2];

/// The sums over `W` nodes along every axis.
struct Over<'a, T, const D: usize, const K: usize, const W: usize>(Sums<'a, T, D, K>);

impl<T: Real, const D: usize, const K: usize, const W: usize> Work<T> for Over<'_, T, D, K, W> {
    type Output = Summed<[T; PACK], D, K>;

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
        let summed = self.0.all::<M, W>(simd);
        let nothing = [T::zero(); PACK];
        let mut all = Summed { value: [nothing; D], gradient_weights: [[[nothing; D]; D]; K] };
        for c in 0..D {
            all.value[c] = simd.numbers(summed.value[c]);
        }
        for s in 0..K {
            all.gradient_weights[s] = numbers(simd, &summed.gradient_weights[s]);
        }
        all
    }
}

impl<T: Real, const D: usize, const K: usize> Sums<'_, T, D, K> {
    /// Computes the sums over `W` nodes along every axis in a function that is not inlined, so that they are compiled once for
    /// all shape functions and callers. Sums of hat functions are inlined, since they take less time than a call.
    #[inline(always)]
    pub fn over<M: Simd<T>, const W: usize>(self, simd: M) -> Summed<M::Eight, D, K> {
        if M::ALONE {
            return Self::eights(simd, &self.all_alone());
        }
        if W == 2 {
            return self.all::<M, W>(simd);
        }
        Self::eights(simd, &simd.apart(Over::<T, D, K, W>(self)))
    }

    /// Loads sums of numbers as registers.
    #[inline(always)]
    fn eights<M: Simd<T>>(simd: M, summed: &Summed<[T; PACK], D, K>) -> Summed<M::Eight, D, K> {
        let nothing = simd.splat(T::zero());
        let mut all = Summed { value: [nothing; D], gradient_weights: [[[nothing; D]; D]; K] };
        for c in 0..D {
            all.value[c] = simd.eight(&summed.value[c]);
        }
        for s in 0..K {
            all.gradient_weights[s] = eights(simd, &summed.gradient_weights[s]);
        }
        all
    }

    /// Computes all sums over `W` nodes along every axis; particles that share their nodes are summed together.
    #[inline(always)]
    fn all<M: Simd<T>, const W: usize>(&self, simd: M) -> Summed<M::Eight, D, K> {
        let along = self.axis::<M, W>(simd, 0);
        let firsts = self.stencil.first;
        let sharing = self.stencil.sharing();
        if sharing == Sharing::All {
            return self.space::<M, W, true>(simd, &along, [firsts[0]; 2]);
        }
        let nothing = simd.splat(T::zero());
        let mut summed = Summed { value: [nothing; D], gradient_weights: [[[nothing; D]; D]; K] };
        // A bit of every particle whose nodes have not been visited.
        let mut left = (1_u32 << PACK) - 1;
        while left != 0 {
            // The first remaining particle of each half.
            let next = [left % (1 << HALF), left >> HALF];
            let at = std::array::from_fn(|half| {
                firsts[half * HALF + next[half].trailing_zeros() as usize % HALF]
            });
            let mut own = along;
            // Halves that share their nodes take one round, with whole weights: the sums are compiled once for both.
            if sharing == Sharing::Apart {
                let mut share = [T::zero(); PACK];
                for p in 0..PACK {
                    if firsts[p] == at[p / HALF] && left >> p & 1 == 1 {
                        share[p] = T::one();
                        left &= !(1 << p);
                    }
                }
                // Every product has a factor of the first axis: it is 0 for the other particles.
                let share = simd.eight(&share);
                for k in 0..W {
                    own.weight[k] = simd.times(own.weight[k], share);
                    for gradient_weight in &mut own.gradient_weights {
                        gradient_weight[k] = simd.times(gradient_weight[k], share);
                    }
                }
            }
            let theirs = self.space::<M, W, false>(simd, &own, at);
            if sharing == Sharing::Halves {
                return theirs;
            }
            for c in 0..D {
                summed.value[c] = simd.plus(summed.value[c], theirs.value[c]);
                for s in 0..K {
                    for a in 0..D {
                        let sum = &mut summed.gradient_weights[s][a][c];
                        *sum = simd.plus(*sum, theirs.gradient_weights[s][a][c]);
                    }
                }
            }
        }
        summed
    }

    #[inline(always)]
    fn axis<M: Simd<T>, const W: usize>(&self, simd: M, a: usize) -> Axis<M::Eight, W, K> {
        let nothing = [simd.splat(T::zero()); W];
        let mut along = Axis { weight: nothing, gradient_weights: [nothing; K] };
        for k in 0..W {
            along.weight[k] = simd.eight(&self.stencil.weight[a][k]);
            for s in 0..K {
                along.gradient_weights[s][k] = simd.eight(&self.gradient_weights[s][a][k]);
            }
        }
        along
    }

    /// The nodes of a row.
    #[inline(always)]
    fn nodes<const W: usize>(&self, first: [u32; 2], [k1, k2]: [usize; 2]) -> NodeRow<'_, T, W> {
        let stride = |a: usize| if a < D { self.stencil.stride[a] } else { 0 };
        let apart = k1 as u32 * stride(1) + k2 as u32 * stride(2);
        std::array::from_fn(|half| {
            // With 32 bits, as in [`Window::row`](crate::nodal::Window::row).
            let first = first[half].wrapping_add(apart) as usize;
            self.nodes[first..first + W].first_chunk().expect("a range of W nodes")
        })
    }

    /// The sums over the nodes from `first` on, which are the `SAME` for both halves or not: the sum of planes.
    #[inline(always)]
    fn space<M: Simd<T>, const W: usize, const SAME: bool>(
        &self,
        simd: M,
        along: &Axis<M::Eight, W, K>,
        first: [u32; 2],
    ) -> Summed<M::Eight, D, K> {
        if D < 3 {
            return self.plane::<M, W, SAME>(simd, along, first, 0);
        }
        // -0 + x is x for every x, so the compiler drops the first addition.
        let zero = simd.splat(-T::zero());
        let mut space = Summed { value: [zero; D], gradient_weights: [[[zero; D]; D]; K] };
        for k2 in 0..W {
            let plane = self.plane::<M, W, SAME>(simd, along, first, k2);
            self.accumulate(simd, 2, k2, &plane, &mut space);
        }
        space
    }

    /// The sums over the nodes of a plane: the sum of rows.
    #[inline(always)]
    fn plane<M: Simd<T>, const W: usize, const SAME: bool>(
        &self,
        simd: M,
        along: &Axis<M::Eight, W, K>,
        first: [u32; 2],
        k2: usize,
    ) -> Summed<M::Eight, D, K> {
        if D < 2 {
            return self.row::<M, W, SAME>(simd, along, self.nodes(first, [0, 0]));
        }
        let zero = simd.splat(-T::zero());
        let mut plane = Summed { value: [zero; D], gradient_weights: [[[zero; D]; D]; K] };
        for k1 in 0..W {
            let row = self.row::<M, W, SAME>(simd, along, self.nodes(first, [k1, k2]));
            self.accumulate(simd, 1, k1, &row, &mut plane);
        }
        plane
    }

    /// The sums over the nodes of a row.
    #[inline(always)]
    fn row<M: Simd<T>, const W: usize, const SAME: bool>(
        &self,
        simd: M,
        along: &Axis<M::Eight, W, K>,
        [one, two]: NodeRow<'_, T, W>,
    ) -> Summed<M::Eight, D, K> {
        let zero = simd.splat(-T::zero());
        let mut row = Summed { value: [zero; D], gradient_weights: [[[zero; D]; D]; K] };
        for k0 in 0..W {
            let numbers = simd.spread(simd.halves(&one[k0].0, &two[k0].0));
            for c in 0..D {
                let number = if SAME { simd.splat(one[k0].0[c]) } else { numbers[c] };
                row.value[c] = simd.times_plus(along.weight[k0], number, row.value[c]);
                for s in 0..K {
                    let sum = &mut row.gradient_weights[s][0][c];
                    *sum = simd.times_plus(along.gradient_weights[s][k0], number, *sum);
                }
            }
        }
        row
    }

    /// Adds to sums the sums along the axes before axis `a`, at node `k` along axis `a`.
    #[inline(always)]
    fn accumulate<M: Simd<T>>(
        &self,
        simd: M,
        a: usize,
        k: usize,
        before: &Summed<M::Eight, D, K>,
        sums: &mut Summed<M::Eight, D, K>,
    ) {
        let weight = simd.eight(&self.stencil.weight[a % D][k]);
        for c in 0..D {
            sums.value[c] = simd.times_plus(weight, before.value[c], sums.value[c]);
        }
        for s in 0..K {
            let gradient_weight = simd.eight(&self.gradient_weights[s][a % D][k]);
            for c in 0..D {
                for b in 0..a {
                    let sum = &mut sums.gradient_weights[s][b % D][c];
                    *sum = simd.times_plus(weight, before.gradient_weights[s][b % D][c], *sum);
                }
                let sum = &mut sums.gradient_weights[s][a % D][c];
                *sum = simd.times_plus(gradient_weight, before.value[c], *sum);
            }
        }
    }
}
