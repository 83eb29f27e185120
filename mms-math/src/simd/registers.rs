//! Eight numbers in the registers of x86-64: one of 256 bits in single precision, in double precision two of them, or
//! one of 512.
//!
//! Safety of all unsafe code in this module: a [`Fused`](super::Fused) proves that the processor has AVX2 and FMA, and a
//! [`Wide`](super::Wide) that it has AVX-512.

/// The number of bytes of a cache line.
const LINE: usize = 64;

// Methods that apply one instruction to every number, for each number of registers per value.
macro_rules! alike {
    (one: $($method:ident($($argument:ident),*) $instruction:ident;)*) => {
        $(
            #[inline(always)]
            fn $method(self, $($argument: Self::Eight),*) -> Self::Eight {
                unsafe { $instruction($($argument),*) }
            }
        )*
    };
    (two: $($method:ident($($argument:ident),*) $instruction:ident;)*) => {
        $(
            #[inline(always)]
            fn $method(self, $($argument: Self::Eight),*) -> Self::Eight {
                unsafe { [$instruction($($argument[0]),*), $instruction($($argument[1]),*)] }
            }
        )*
    };
}

// The methods that all instruction sets with registers share.
macro_rules! common {
    ($float:ident) => {
        #[inline(always)]
        fn add_first(self, to: &mut [$float; 4], eight: Self::Eight) {
            let [first, _] = fours(eight);
            add(to, first);
        }

        #[inline(always)]
        fn add_second(self, to: &mut [$float; 4], eight: Self::Eight) {
            let [_, second] = fours(eight);
            add(to, second);
        }

        #[inline(always)]
        fn fetch<V>(self, values: &[V], place: usize) {
            // A prefetch hint may point anywhere.
            let start = values.as_ptr().wrapping_add(place).cast::<i8>();
            for line in (0..size_of::<V>()).step_by(super::LINE) {
                unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(line)) };
            }
        }
    };
}

mod doubles;
mod singles;
mod wide;
