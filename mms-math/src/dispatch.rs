//! Compiles work for several instruction sets, and takes the best one that the processor has.

use crate::machine::{Fused, Plain};

/// Work on many numbers, in two versions of the same code: everything it calls has to be inlined, or is not
/// compiled for the instruction set.
pub trait Work {
    /// What comes of it.
    type Output;

    /// Where the processor multiplies and adds in one step: with [`Float::Fused`](crate::batch::Float::Fused), or four numbers at a time.
    fn fused(self, machine: Fused) -> Self::Output;

    /// Where it does not: with [`Float::Plain`](crate::batch::Float::Plain).
    fn plain(self, machine: Plain) -> Self::Output;
}

/// Does work with the most that the processor has. Numbers four at a time gain by AVX-512 too: it has twice as many
/// registers, and takes one number of memory for all four. With debug assertions there is no such version: every
/// batch and every step of a solver would be compiled once more, for programs that need not be fast.
#[inline]
pub fn best<W: Work>(work: W) -> W::Output {
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

fn baseline<W: Work>(work: W) -> W::Output {
    // Every processor of these multiplies and adds in one step.
    if cfg!(target_arch = "aarch64") { work.fused(Fused::known()) } else { work.plain(Plain) }
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

#[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn avx512<W: Work>(work: W) -> W::Output {
    work.fused(Fused::known())
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2<W: Work>(work: W) -> W::Output {
    work.fused(Fused::known())
}
