//! Compiles work for several instruction sets, and takes the best one that the processor has.

use crate::batch::Float;
#[cfg(target_arch = "x86_64")]
use crate::machine::Wide;
use crate::machine::{Fused, Machine, Plain};

/// Work on many numbers of type `T`, in versions of the same code.
pub trait Work<T> {
    /// What comes of it.
    type Output;

    /// Does it, with loops over `M::Lane` and eight numbers at a time. Everything that is called has to be inlined, or
    /// is not compiled for the instruction set.
    fn on<M: Machine<T>>(self, machine: M) -> Self::Output;
}

/// Does work with the most that the processor has. With debug assertions there is no version for AVX-512: every
/// batch and every step of a solver would be compiled once more, for programs that need not be fast.
#[inline]
pub fn best<T: Float, W: Work<T>>(work: W) -> W::Output {
    #[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
    if has_avx512() {
        // Safety: the processor has what the function is compiled for.
        #[allow(unsafe_code)]
        return unsafe { avx512(work) };
    }
    #[cfg(target_arch = "x86_64")]
    if has_avx2() {
        // Safety: likewise.
        #[allow(unsafe_code)]
        return unsafe { avx2(work) };
    }
    baseline(work)
}

fn baseline<T: Float, W: Work<T>>(work: W) -> W::Output {
    // Every processor of these multiplies and adds in one step.
    if cfg!(target_arch = "aarch64") {
        work.on(T::FusedMachine::from(Fused::known()))
    } else {
        work.on(T::PlainMachine::from(Plain))
    }
}

#[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
fn has_avx512() -> bool {
    std::is_x86_feature_detected!("avx512f")
        && std::is_x86_feature_detected!("avx512dq")
        && std::is_x86_feature_detected!("avx512vl")
        && has_avx2()
}

#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

/// Does work with AVX-512.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
#[inline(never)]
pub(crate) fn avx512<T: Float, W: Work<T>>(work: W) -> W::Output {
    work.on(T::WideMachine::from(Wide::known()))
}

/// Does work with AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
#[inline(never)]
pub(crate) fn avx2<T: Float, W: Work<T>>(work: W) -> W::Output {
    work.on(T::FusedMachine::from(Fused::known()))
}
