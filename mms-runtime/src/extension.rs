//! The macro that declares a family of extensions (shape functions, time integrators, formulations) in one visible list.

/// Declares the modules of a family, and from the same list the family's names and its dispatch.
///
/// Each entry `module::Type` is one file `module.rs` beside the list, with a type that implements the
/// family's trait. The module's name is the name that users write. (rustfmt does not follow modules
/// that a macro declares: format these files by name.)
macro_rules! extension_list {
    (
        $(#[$doc:meta])*
        $name:ident, $visitor:ident: $family:ident, $what:literal;
        $($module:ident::$member:ident),* $(,)?
    ) => {
        $(mod $module;)*
        $(pub use $module::$member;)*

        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $(#[doc = concat!("[`", stringify!($member), "`], written `", stringify!($module), "`.")]
            $member,)*
        }

        impl $name {
            /// Every member of the family, in the order of the list.
            pub const ALL: &'static [Self] = &[$(Self::$member),*];

            /// The names of [`Self::ALL`], in the same order.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($module)),*];

            /// The name that users write.
            pub fn name(self) -> &'static str {
                match self { $(Self::$member => stringify!($module)),* }
            }

            /// Calls the visitor with the type that has this name.
            pub fn visit<V: $visitor>(self, visitor: V) -> V::Output {
                match self { $(Self::$member => visitor.visit::<$member>()),* }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }

        impl std::str::FromStr for $name {
            type Err = crate::UnknownName;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                let found = Self::ALL.iter().find(|member| member.name() == text);
                found.copied().ok_or_else(|| crate::UnknownName {
                    what: $what,
                    given: text.to_owned(),
                    known: Self::NAMES,
                })
            }
        }

        /// An operation on any member of the family.
        pub trait $visitor {
            /// The result, the same type for every member.
            type Output;

            /// Performs the operation with the member `M`.
            fn visit<M: $family>(self) -> Self::Output;
        }
    };
}

pub(crate) use extension_list;

/// The names that start or end with the given one, as `ugimp` and `cpgimp` end with `gimp`: likely one of them is meant.
fn ending(given: &str, known: &[&str]) -> String {
    let given = given.to_lowercase().replace('-', "_");
    let ends = |it: &&&str| !given.is_empty() && (it.ends_with(&given) || it.starts_with(&given));
    let names: Vec<_> = known.iter().filter(ends).map(|it| format!("`{it}`")).collect();
    match names.as_slice() {
        [] => String::new(),
        names => format!("did you mean {}? ", names.join(" or ")),
    }
}

/// A name that no member of a family has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown {what} `{given}`; {}known are: {}", ending(given, known), known.join(", "))]
pub struct UnknownName {
    /// The family: `shape function` or `time integrator`.
    pub what: &'static str,
    /// The name as given.
    pub given: String,
    /// The names there are.
    pub known: &'static [&'static str],
}
