//! The nodes of a pack of particles, with their weights w_ip and weight gradients grad w_ip; the sums between particles and
//! nodes.
//!
//! There are two sums, each the transpose of the other. [`Stencil::scatter`] (P2G) adds to each node w q, and for each axis a
//! (grad w)_a Q_a, and w (x_i - x_p)_a M_a, where w (x_i - x_p)_a is the moment of the weight. [`Stencil::gather`] (G2P)
//! returns sum_i w q_i, sum_i (grad w)_a q_i, and slopes computed from the moments. Mass, momentum, forces, interpolated
//! velocities and their gradients are sums of this kind; the linear velocity of APIC uses moments. Sums over three and four
//! nodes along an axis are functions that are not inlined, one for all passes and shape functions.
//!
//! A pack is eight adjacent particles, in two halves of four (an AoSoA tile). A register of particle data has one particle in
//! each lane. A register of nodal data has the four numbers of a node in the lanes of each half: in the first half a node of
//! particle k of the first half, and in the second half a node of particle k of the second. Numbers move only within their half
//! of a register, which takes one instruction. So the halves of a pack may be in different cells, as they are if a cell has
//! four particles.
//!
//! In most packs the particles of a half share their nodes, since particles are sorted by cells: then a node is looked up
//! once for all four. Otherwise [`Stencil::gather`] sums once for each set of particles with the same nodes, with weight 0 for
//! all others, and [`Stencil::scatter`] adds one particle of each half at a time. The sums use no closures, nor methods that
//! take one, such as `map` of arrays: the compiler does not always inline a closure into the dispatched function, and then
//! compiles it without the processor's vector instructions. Packs begin at every eighth particle for any slabs and threads; a
//! slab adds only its own particles of a pack. The last pack is padded with copies of the last particle.
//!
//! On x86-64 without AVX2, and in one dimension, eight particles at a time are not faster. There `alone.rs` sums particle by
//! particle, in little code.

mod alone;
mod gather;
mod scatter;
mod tensor;

use std::ops::Range;

use mms_math::dispatch::IsaLevel;
use mms_math::simd::Simd;

use crate::column::{HALF, PACK};
use crate::lattice::Lattice;
use crate::nodal::{Nodal, Window};
use crate::real::{Real, Vector};

pub use tensor::{Known, MOST, ProductStencil};

/// The data that a pack adds to its nodes.
#[derive(Clone, Copy)]
pub struct Payload<F, const D: usize> {
    /// q: the four numbers of a node for each particle of both halves.
    pub value: [F; HALF],
    /// Q_a for every axis a: vectors, a number for each particle.
    pub slopes: Option<[[F; D]; D]>,
    /// M_a, in the layout of `slopes`.
    pub moments: Option<[[F; D]; D]>,
}

impl<F, const D: usize> Payload<F, D> {
    /// q alone.
    pub fn value(value: [F; HALF]) -> Self {
        Self { value, slopes: None, moments: None }
    }
}

impl<T: Real, const D: usize> Payload<[T; PACK], D> {
    /// Stores the data of a pack as numbers.
    #[inline(always)]
    fn of<M: Simd<T>>(simd: M, payload: &Payload<M::Eight, D>) -> Self {
        let mut all = Self { value: [[T::zero(); PACK]; HALF], slopes: None, moments: None };
        for k in 0..HALF {
            all.value[k] = simd.numbers(payload.value[k]);
        }
        if let Some(slopes) = &payload.slopes {
            all.slopes = Some(numbers(simd, slopes));
        }
        if let Some(moments) = &payload.moments {
            all.moments = Some(numbers(simd, moments));
        }
        all
    }

    /// Loads the data of a pack as registers.
    #[inline(always)]
    fn eights<M: Simd<T>>(&self, simd: M) -> Payload<M::Eight, D> {
        let nothing = simd.splat(T::zero());
        let mut all = Payload { value: [nothing; HALF], slopes: None, moments: None };
        for k in 0..HALF {
            all.value[k] = simd.eight(&self.value[k]);
        }
        if let Some(slopes) = &self.slopes {
            all.slopes = Some(eights(simd, slopes));
        }
        if let Some(moments) = &self.moments {
            all.moments = Some(eights(simd, moments));
        }
        all
    }
}

#[inline(always)]
fn numbers<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    columns: &[[M::Eight; D]; D],
) -> [[[T; PACK]; D]; D] {
    let mut all = [[[T::zero(); PACK]; D]; D];
    for j in 0..D {
        for i in 0..D {
            all[j][i] = simd.numbers(columns[j][i]);
        }
    }
    all
}

#[inline(always)]
fn eights<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    columns: &[[[T; PACK]; D]; D],
) -> [[M::Eight; D]; D] {
    let mut all = [[simd.splat(T::zero()); D]; D];
    for j in 0..D {
        for i in 0..D {
            all[j][i] = simd.eight(&columns[j][i]);
        }
    }
    all
}

/// Sums over the nodes' vectors q at a pack of particles: a number for each particle.
#[derive(Clone, Copy)]
pub struct Gathered<F, const D: usize> {
    /// sum_i w q_i.
    pub value: [F; D],
    /// sum_i (grad w)_a q_i for every axis a.
    pub gradient: [[F; D]; D],
    /// (sum_i w q_i (x) (x_i - x_p)) (sum_i w (x_i - x_p) (x) (x_i - x_p))^-1 for every axis: the slopes of the
    /// linear function that is nearest to q_i, as the weights measure it.
    pub slopes: [[F; D]; D],
}

/// The sums that a caller needs in addition to the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// [`Gathered::value`] alone.
    Value,
    /// The gradient too.
    Gradient,
    /// The gradient, and the slopes of the nearest linear function.
    Slopes,
}

/// The nodes of a pack of particles.
pub trait Stencil<T: Real, const D: usize>: Clone + Default + Send + Sync {
    /// The last instruction set that makes the sums, and the search for the weights, faster.
    const WIDEST: IsaLevel;

    /// Calls `visit(i, w_ip, grad w_ip)` for every node i of one of the particles. If a node is visited more than once, its
    /// weights add up.
    fn each(&self, particle: usize, visit: impl FnMut(usize, T, Vector<T, D>));

    /// The first of the `members` that has nodes beyond these; `None` if all are within.
    fn beyond(&self, members: Members, nodes: &Range<usize>) -> Option<usize>;

    /// q_i += w q + sum_a ((grad w)_a Q_a + w (x_i - x_p)_a M_a) for every node i of the `members`.
    fn scatter<M: Simd<T>>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        payload: &Payload<M::Eight, D>,
        members: Members,
        nodes: Window<'_, T>,
    );

    /// Computes the sums over the nodes; sums that are not `wanted` are 0. For hat functions, the nearest linear function is
    /// the interpolant between the nodes.
    fn gather<M: Simd<T>>(
        &self,
        simd: M,
        lattice: &Lattice<T, D>,
        wanted: Wanted,
        nodes: &[Nodal<T>],
    ) -> Gathered<M::Eight, D>;

    /// The stencil as a product of weights along the axes, if it is one.
    fn product(&self) -> Option<&ProductStencil<T, D>> {
        None
    }
}

/// The range of particles of a pack: the first one, and the one after the last.
pub type Members = [usize; 2];

/// All particles of a pack.
pub const ALL: Members = [0, PACK];
