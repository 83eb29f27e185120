//! Compiles work for several instruction sets, and dispatches to the best one of the processor.
//!
//! The dispatcher calls a function that was compiled for the detected instructions. That is `unsafe`, as the instructions in
//! `simd/registers/` are. The environment variable `MMS_INSTRUCTIONS` limits the instructions: `baseline`, `avx2` or
//! `avx512`.

use core::fmt;
use core::sync::atomic::{AtomicU8, Ordering};

use crate::batch::Float;
#[cfg(target_arch = "x86_64")]
use crate::simd::Wide;
use crate::simd::{Fused, Plain, Simd};

/// Work on many numbers of type `T`, in versions of the same code.
pub trait Work<T> {
    /// The result.
    type Output;

    /// The last instruction set that makes the work faster; [`run`](Instructions::run) has no version for later ones.
    const WIDEST: IsaLevel = IsaLevel::Avx512;

    /// Does the work, with loops over `M::Lane` and eight numbers at a time. All called functions have to be inlined, or they
    /// are not compiled for the instruction set.
    fn on<M: Simd<T>>(self, simd: M) -> Self::Output;
}

/// Does work with the best instructions of the processor.
#[inline]
pub fn best<T: Float, W: Work<T>>(work: W) -> W::Output {
    Instructions::best().run(work)
}

/// The environment variable that limits [`Instructions::best`]: `baseline`, `avx2` or `avx512`. Instructions that the processor
/// lacks are never used, and other words set no limit.
pub const LIMIT: &str = "MMS_INSTRUCTIONS";

/// Instructions that the processor has: there are no values of this type for other instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instructions(IsaLevel);

/// The instruction sets that work is compiled for, from the least to the most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum IsaLevel {
    /// The instructions that every processor of this kind has.
    Baseline,
    /// AVX2 and FMA: four numbers of double precision in a register.
    Avx2,
    /// AVX-512: eight.
    Avx512,
}

const LEVELS: [IsaLevel; 3] = [IsaLevel::Baseline, IsaLevel::Avx2, IsaLevel::Avx512];

/// The instructions of work that asks for none.
const USUAL: &[IsaLevel] =
    if cfg!(all(debug_assertions, not(test))) { &[IsaLevel::Baseline] } else { &LEVELS };

impl IsaLevel {
    const fn reaches(self, other: IsaLevel) -> bool {
        self as u8 >= other as u8
    }

    const fn name(self) -> &'static str {
        match self {
            IsaLevel::Baseline => "baseline",
            IsaLevel::Avx2 => "avx2",
            IsaLevel::Avx512 => "avx512",
        }
    }

    /// Whether the processor has the instructions, and this crate was compiled for them. With debug assertions there is no
    /// version for AVX-512.
    fn is_here(self) -> bool {
        match self {
            IsaLevel::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            IsaLevel::Avx2 => {
                std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
            }
            #[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
            IsaLevel::Avx512 => {
                std::is_x86_feature_detected!("avx512f")
                    && std::is_x86_feature_detected!("avx512dq")
                    && std::is_x86_feature_detected!("avx512vl")
                    && IsaLevel::Avx2.is_here()
            }
            #[allow(unreachable_patterns)]
            _ => false,
        }
    }
}

impl fmt::Display for Instructions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.name())
    }
}

impl Instructions {
    /// The instructions that every processor of this kind has.
    pub const BASELINE: Instructions = Instructions(IsaLevel::Baseline);

    /// All instructions that the processor has, from the least to the most.
    pub fn all() -> impl Iterator<Item = Instructions> {
        LEVELS.into_iter().filter(|level| level.is_here()).map(Instructions)
    }

    /// The names of instructions, from the least to the most.
    pub fn names() -> impl Iterator<Item = &'static str> {
        LEVELS.into_iter().map(IsaLevel::name)
    }

    /// The value of the environment variable [`LIMIT`], if it is not one of the names of instructions.
    pub fn unknown_limit() -> Option<std::string::String> {
        let limit = std::env::var_os(LIMIT)?.to_string_lossy().into_owned();
        (!Instructions::names().any(|name| name == limit)).then_some(limit)
    }

    /// The best instructions that the processor has and the environment variable [`LIMIT`] allows; with debug assertions the
    /// baseline, as in [`run`](Instructions::run). The variable is read once.
    #[inline]
    pub fn best() -> Instructions {
        // An index into `LEVELS`; initially invalid.
        static FOUND: AtomicU8 = AtomicU8::new(u8::MAX);
        let found = FOUND.load(Ordering::Relaxed);
        match LEVELS.get(usize::from(found)) {
            Some(level) => Instructions(*level),
            None => {
                let level = found_with(std::env::var(LIMIT).ok());
                FOUND.store(level as u8, Ordering::Relaxed);
                Instructions(level)
            }
        }
    }

    /// Does work with these instructions, but none beyond [`Work::WIDEST`]. In builds with debug assertions it uses the baseline:
    /// such programs may be slow, and a second version of every batch and of every step of a solver would nearly double the time
    /// to compile them.
    #[inline]
    pub fn run<T: Float, W: Work<T>>(self, work: W) -> W::Output {
        #[cfg(all(debug_assertions, not(test)))]
        return baseline(work);
        #[cfg(any(not(debug_assertions), test))]
        self.run_in_any_build(work)
    }

    /// Does work with these instructions, with debug assertions or without.
    #[inline]
    pub fn run_in_any_build<T: Float, W: Work<T>>(self, work: W) -> W::Output {
        match self.0 {
            // Safety: the processor has the instructions that the function is compiled for, or there would be no such value.
            #[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
            #[allow(unsafe_code)]
            IsaLevel::Avx512 if const { W::WIDEST.reaches(IsaLevel::Avx512) } => unsafe {
                avx512(work)
            },
            // Safety: likewise; a processor with AVX-512 has AVX2.
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            IsaLevel::Avx2 | IsaLevel::Avx512 if const { W::WIDEST.reaches(IsaLevel::Avx2) } => unsafe {
                avx2(work)
            },
            _ => baseline(work),
        }
    }

    /// Does work with these instructions, up to AVX2, and rounds products before additions: the results are the same bits on
    /// all processors.
    #[inline]
    pub fn run_plainly<T: Float, W: Work<T>>(self, work: W) -> W::Output {
        match self.0 {
            // Safety: as above; a processor with AVX-512 has AVX2.
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            IsaLevel::Avx2 | IsaLevel::Avx512 => unsafe { plain_avx2(work) },
            _ => work.on(T::PlainSimd::from(Plain)),
        }
    }
}

#[cold]
fn found_with(limit: Option<std::string::String>) -> IsaLevel {
    let limit = LEVELS.into_iter().find(|level| Some(level.name()) == limit.as_deref());
    let mut levels = USUAL.iter().copied().rev().filter(|level| level.is_here());
    levels.find(|level| limit.is_none_or(|limit| *level <= limit)).unwrap_or(IsaLevel::Baseline)
}

fn baseline<T: Float, W: Work<T>>(work: W) -> W::Output {
    // Every processor of this kind multiplies and adds in one step.
    if cfg!(target_arch = "aarch64") {
        work.on(T::FusedMachine::from(Fused::known()))
    } else {
        work.on(T::PlainSimd::from(Plain))
    }
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

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn plain_avx2<T: Float, W: Work<T>>(work: W) -> W::Output {
    work.on(T::PlainSimd::from(Plain))
}

#[cfg(test)]
mod tests {
    use std::string::String;
    use std::vec::Vec;

    use super::{Instructions, IsaLevel, LEVELS, found_with};

    #[test]
    fn instructions_are_limited_and_never_more_than_the_processor_has() {
        let all: Vec<_> = Instructions::all().collect();
        assert!(all.is_sorted() && all[0] == Instructions::BASELINE);
        let most = all[all.len() - 1].0;
        for level in LEVELS {
            let limit = Some(String::from(level.name()));
            assert_eq!(found_with(limit), level.min(most));
        }
        assert_eq!([found_with(None), found_with(Some("sse".into()))], [most; 2]);
        assert_eq!(found_with(Some("baseline".into())), IsaLevel::Baseline);
    }
}
