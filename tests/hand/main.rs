//! Derivations on paper, in plain Rust: a second opinion on every generated quantity that shares
//! nothing with the compiler of field files. One file per field; what several derivations share has
//! a file of its own.

mod axis_aligned;
mod axis_aligned_1d;
mod axis_aligned_2d;
mod axis_aligned_3d;
mod bar_1d;
mod conformal_sector_2d;
mod consolidating_block_1d;
mod cyclic_shear_3d;
mod expanding_ring;
mod generalized_vortex;
mod generalized_vortex_third;
mod given_pressure_2d;
mod graded_bar;
mod heated_square_2d;
mod lame;
mod lame_sphere;
mod lame_tube;
mod nearly_incompressible_2d;
mod periodic_bar;
mod plane;
mod plane_strain_gent;
mod plane_strain_linear_elastic;
mod plane_strain_mooney_rivlin;
mod plane_strain_neo_hookean_isochoric;
mod plane_strain_saint_venant_kirchhoff;
mod plane_strain_transversely_isotropic;
mod quiet_boundary_2d;
mod rank_one;
mod self_weight_column;
mod sheared_block_2d;
mod starting;
mod starting_bar;
mod starting_cube_3d;
mod starting_square_2d;
mod static_bulge_3d;
mod static_square;
mod support;
mod travelling_wave_2d;
mod twisted_column;
mod twisted_tube;
mod uniform_stretch;
mod vortex;
