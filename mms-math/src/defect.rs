//! Deliberate mistakes (fault injection), to prove that a verification detects them.
//!
//! `defects!` makes the list of a crate's mistakes, and code that can be wrong tests `on(Defect::Name)`. Without the feature
//! `defects` that is the constant `false`, and no program contains any of the list. With the feature, one mistake at a time is
//! selected for the whole process.

/// Makes the list of a crate's deliberate mistakes: `Variant, "name", "what is wrong";` for each.
///
/// Code that can be wrong tests `on(Defect::Variant)`. Unless the crate that calls the macro is built with its feature
/// `defects`, that is the constant `false`, and no program contains any of the list. With the feature, `select` selects the
/// mistake that the whole process makes.
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

        /// Selects the mistake that the process makes from now on; `None` for no mistake.
        #[cfg(feature = "defects")]
        pub fn select(defect: Option<Defect>) {
            let number = defect.map_or(usize::MAX, |defect| defect as usize);
            SELECTED.store(number, ::core::sync::atomic::Ordering::Relaxed);
        }

        #[cfg(feature = "defects")]
        impl Defect {
            /// All mistakes.
            pub const ALL: &[Self] = &[$(Self::$variant,)+];

            /// The name that users write.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }

            /// A description of the mistake.
            pub fn what(self) -> &'static str {
                match self {
                    $(Self::$variant => $what,)+
                }
            }
        }
    };
}
