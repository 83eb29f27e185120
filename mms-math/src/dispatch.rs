//! Compiles a loop over points for several instruction sets, and takes the best one that the
//! processor has.

use crate::batch::{Float, Kernel, Points};

/// Drives a kernel over points, with vector instructions.
pub(crate) fn drive<T: Float, K: Kernel<T, I, O>, P, const I: usize, const O: usize>(
    kernel: &K,
    points: &mut P,
) where
    P: Points<T::Fused, I, O> + Points<T::Plain, I, O>,
{
    #[cfg(target_arch = "x86_64")]
    {
        if has_avx512() {
            // Safety: the processor has what the function is compiled for.
            #[allow(unsafe_code)]
            return unsafe { avx512::<T, K, P, I, O>(kernel, points) };
        }
        if has_avx2() {
            // Safety: as above.
            #[allow(unsafe_code)]
            return unsafe { avx2::<T, K, P, I, O>(kernel, points) };
        }
    }
    // Every processor of these multiplies and adds in one step.
    #[cfg(target_arch = "aarch64")]
    kernel.drive::<T::Fused>(points);
    #[cfg(not(target_arch = "aarch64"))]
    kernel.drive::<T::Plain>(points);
}

#[cfg(target_arch = "x86_64")]
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

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn avx512<
    T: Float,
    K: Kernel<T, I, O>,
    P: Points<T::Fused, I, O>,
    const I: usize,
    const O: usize,
>(
    kernel: &K,
    points: &mut P,
) {
    kernel.drive::<T::Fused>(points);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2<T: Float, K: Kernel<T, I, O>, P: Points<T::Fused, I, O>, const I: usize, const O: usize>(
    kernel: &K,
    points: &mut P,
) {
    kernel.drive::<T::Fused>(points);
}
