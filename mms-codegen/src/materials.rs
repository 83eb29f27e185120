//! The materials that come with the crate.

/// The materials that come with the crate: stem and text.
pub const MATERIALS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/materials.rs"));

/// The stem and the text of the material of that stem that comes with the crate.
pub(crate) fn shipped(stem: &str) -> Option<&'static (&'static str, &'static str)> {
    MATERIALS.iter().find(|(shipped, _)| *shipped == stem)
}
