//! Derivations on paper, in plain Rust: a second opinion on every generated quantity that shares
//! nothing with the compiler of field files. One file per field.

mod bar_1d;
mod plane;
mod plane_strain_gent;
mod plane_strain_linear_elastic;
mod plane_strain_mooney_rivlin;
mod plane_strain_neo_hookean_isochoric;
mod plane_strain_saint_venant_kirchhoff;
mod plane_strain_transversely_isotropic;
