//! Selects parts of long sweeps.
//!
//! `MMS_SWEEPS=all` tries everything, as `.ci/long` does. Any other text selects a part: `.ci/run` sets the hash of the tree,
//! so that one commit always gets one answer. Without the variable the part is always the same.

// Each program uses some of these functions.
#![allow(dead_code)]

use std::path::Path;

/// The variable that selects the part.
const VARIABLE: &str = "MMS_SWEEPS";

/// The fields of the gallery that are measured in depth: the bar of the slides, one of each material, one of each kind of body,
/// and fields with graded moduli, tractions, moving walls and P without symmetry. Others pass the cheaper tests, so that a new
/// field costs little.
const IN_DEPTH: [&str; 12] = [
    "bar_1d",
    "cyclic_shear_3d",
    "generalized_vortex",
    "graded_bar",
    "plane_strain_gent",
    "plane_strain_linear_elastic",
    "plane_strain_mooney_rivlin",
    "plane_strain_neo_hookean_isochoric",
    "plane_strain_saint_venant_kirchhoff",
    "plane_strain_transversely_isotropic",
    "sheared_block_2d",
    "travelling_wave_2d",
];

/// Whether a field of the gallery, or its file, is measured in depth.
pub fn is_in_depth(field: &Path) -> bool {
    all_is_tried()
        || field.file_stem().is_some_and(|stem| IN_DEPTH.iter().any(|name| stem == *name))
}

/// Whether whole sweeps are tried.
pub fn all_is_tried() -> bool {
    std::env::var(VARIABLE).is_ok_and(|it| it == "all")
}

/// One item in `share` of a sweep, and at least one, in their order; all of them if everything is tried.
pub fn sampled<T>(sweep: impl IntoIterator<Item = T>, share: usize) -> Vec<T> {
    let items: Vec<T> = sweep.into_iter().collect();
    if all_is_tried() {
        return items;
    }
    let text = std::env::var(VARIABLE).unwrap_or_default();
    let mut places: Vec<usize> = (0..items.len()).collect();
    places.sort_by_key(|place| hash(&format!("{text} {place}")));
    places.truncate(items.len().div_ceil(share));
    let is_chosen = |place: &usize| places.contains(place);
    items
        .into_iter()
        .enumerate()
        .filter(|(place, _)| is_chosen(place))
        .map(|(_, item)| item)
        .collect()
}

/// The number of random cases that are tried: one in `share`, or all.
pub fn sampled_count(cases: usize, share: usize) -> usize {
    if all_is_tried() { cases } else { cases.div_ceil(share) }
}

/// Whether a case of this name is tried: one in `share`, or all.
pub fn is_tried(case: &str, share: u64) -> bool {
    let text = std::env::var(VARIABLE).unwrap_or_default();
    all_is_tried() || hash(&format!("{text} {case}")).is_multiple_of(share)
}

/// The hash FNV-1a of 64 bits, mixed once more: texts that differ in their last digit differ in all bits.
fn hash(text: &str) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325, step);
    (hash ^ (hash >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}
