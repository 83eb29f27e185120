//! Deliberate mistakes (fault injection), to prove that a verification finds them.
//!
//! `defects!` makes the list of a crate's mistakes, and a place that can be wrong asks `on(Defect::Name)`. Without
//! the feature `defects` that is the constant `false`, and nothing of it is in a program. With it, one mistake at
//! a time is selected for the whole process.

/// Makes the list of a crate's deliberate mistakes: `Variant, "name", "what is wrong";` for each.
///
/// A place that can be wrong asks `on(Defect::Variant)`. Unless the crate that calls the macro is built with its
/// feature `defects`, that is the constant `false`, and nothing of the list is left in a program. With the
/// feature, `select` names the mistake that the whole process makes.
#[macro_export]
macro_rules! defects {
    ($($variant:ident, $name:literal, $what:literal;)+) => {
        /// A deliberate mistake.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Defect {
            $(#[doc = $what] $variant,)+
        }

        /// Whether the process makes this mistake.
        #[cfg(not(feature = "defects"))]
        #[inline(always)]
        pub(crate) const fn on(_: Defect) -> bool {
            false
        }

        /// Whether the process makes this mistake.
        #[cfg(feature = "defects")]
        #[inline(always)]
        pub(crate) fn on(defect: Defect) -> bool {
            SELECTED.load(::core::sync::atomic::Ordering::Relaxed) == defect as usize
        }

        /// The mistake that the process makes.
        #[cfg(feature = "defects")]
        static SELECTED: ::core::sync::atomic::AtomicUsize =
            ::core::sync::atomic::AtomicUsize::new(usize::MAX);

        /// Makes the process make this mistake from now on, or none.
        #[cfg(feature = "defects")]
        pub fn select(defect: Option<Defect>) {
            let number = defect.map_or(usize::MAX, |defect| defect as usize);
            SELECTED.store(number, ::core::sync::atomic::Ordering::Relaxed);
        }

        #[cfg(feature = "defects")]
        impl Defect {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$variant,)+];

            /// The name that users write.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }

            /// What is wrong.
            pub fn what(self) -> &'static str {
                match self {
                    $(Self::$variant => $what,)+
                }
            }
        }
    };
}
