//! `mms diagnose` of codes that share nothing with this project: each run has one planted mistake. Runs are listed in
//! docs/diagnosis.md#by-codes-of-other-people: scikit-fem 12 in motion, on 16 and 32 cells, and FElupe 11.3 at rest, on 4 and
//! 8,
//! in single precision.

use std::path::Path;

use super::mms::Folder;
use crate::sampled::sampled;

/// One run in `SHARE` is tried.
const SHARE: usize = 115;

/// A run; the names that say what was planted, or `nothing` if it is harmless; and the size, if it has one. A run without a
/// name has a mistake that docs/diagnosis.md lists as missed: it must be reported neither as another one nor as `nothing`.
type Planted = (&'static str, &'static [&'static str], Option<f64>);

const RUNS: [Planted; 77] = [
    ("felupe_C10_5pc", &["parameter_factor [C10]"], Some(1.05)),
    ("felupe_C20_missing", &["parameter_missing [C20]"], None),
    ("felupe_C20_sign", &["parameter_sign [C20]"], Some(-1.0)),
    ("felupe_PtN", &["traction_transposed [all faces]"], None),
    ("felupe_PtN_xmax", &["traction_transposed on x_max"], None),
    ("felupe_b_at_x", &["force_at_present"], None),
    ("felupe_b_missing", &["force_missing"], None),
    ("felupe_b_old_step", &[], None),
    ("felupe_b_per_mass", &["force_factor", "density_factor"], Some(0.9090909090909091)),
    ("felupe_b_sign", &["force_reversed", "force_sign"], None),
    ("felupe_b_swapped", &["force_swapped [x and y]"], None),
    ("felupe_b_times_J", &["force_times_jacobian", "force_present_density"], None),
    ("felupe_base_moved", &["displacement_offset"], None),
    ("felupe_bulk_2pc", &[], None),
    ("felupe_gravity_on", &["constant_force"], None),
    ("felupe_lambda_for_K", &["parameter_factor [bulk]"], Some(0.8666666666666666)),
    ("felupe_mu_2", &["parameter_twice [C10]"], Some(2.0)),
    ("felupe_out_swapped", &["components_swapped [y and z]"], None),
    ("felupe_pressure_only", &["traction_normal [all faces]"], None),
    ("felupe_sigma_N", &["traction_cauchy [all faces]"], None),
    ("felupe_t_area_xmax", &["traction_factor on x_max"], Some(1.05)),
    ("felupe_t_missing_zmax", &["traction_missing on z_max"], None),
    ("felupe_t_old_step", &[], None),
    ("scikit_fem_E_1pc", &["moduli_factor"], Some(1.01)),
    ("scikit_fem_F_transposed", &["stress_transposed"], None),
    ("scikit_fem_P12_missing", &[], None),
    ("scikit_fem_PK2_for_P", &["stress_second_piola"], None),
    ("scikit_fem_P_over_J", &["stress_volume"], None),
    ("scikit_fem_P_transposed", &["stress_transposed"], None),
    ("scikit_fem_PtN", &["traction_transposed [all faces]"], None),
    ("scikit_fem_PtN_xmax", &["traction_transposed on x_max"], None),
    ("scikit_fem_b_at_x", &["force_at_present"], None),
    ("scikit_fem_b_early", &["force_early"], None),
    ("scikit_fem_b_half_late", &["force_late"], None),
    ("scikit_fem_b_late", &["force_late", "loads_late"], None),
    ("scikit_fem_b_missing", &["force_missing"], None),
    ("scikit_fem_b_no_inertia", &["inertia_missing"], None),
    ("scikit_fem_b_over_J", &["force_over_jacobian"], None),
    ("scikit_fem_b_rho_twice", &["force_factor"], Some(1.15)),
    ("scikit_fem_b_sign", &["force_reversed"], Some(-1.0)),
    ("scikit_fem_b_swapped", &["force_swapped"], None),
    ("scikit_fem_b_times_J", &["force_times_jacobian"], None),
    ("scikit_fem_b_y_missing", &["force_component_missing [y]"], None),
    ("scikit_fem_damping", &["damping"], Some(20.0)),
    ("scikit_fem_density_5pc", &["density_factor"], Some(1.05)),
    ("scikit_fem_first_step_full", &["start_half_step [walls]"], None),
    ("scikit_fem_gravity_on", &["constant_force"], None),
    ("scikit_fem_lambda_is_K", &["lambda_bulk"], None),
    ("scikit_fem_lnJ_is_J_1", &["material [neo_hookean_linear_volume]"], None),
    ("scikit_fem_mass_not_on_edge", &[], None),
    ("scikit_fem_mu_2", &["mu_twice"], Some(2.0)),
    ("scikit_fem_no_a0", &["initial_acceleration_missing [walls]"], None),
    ("scikit_fem_nu_032", &["parameter_factor [nu]"], Some(0.9142857142857144)),
    ("scikit_fem_one_point", &["nothing"], None),
    ("scikit_fem_out_f32", &["nothing"], None),
    ("scikit_fem_out_swapped", &["components_swapped [displacement]"], None),
    ("scikit_fem_plane_stress_lambda", &["lambda_plane_stress"], None),
    ("scikit_fem_pressure_only", &["traction_normal [all faces]"], None),
    ("scikit_fem_shear_half", &["shear_half_of_first_piola"], Some(0.5)),
    ("scikit_fem_sigma_N", &["traction_cauchy [all faces]"], None),
    ("scikit_fem_sigma_for_P", &["stress_cauchy"], None),
    ("scikit_fem_small_strain", &["stress_small_strain"], None),
    ("scikit_fem_start_at_rest", &["start_at_rest [walls]"], None),
    ("scikit_fem_start_undeformed", &["start_undeformed [u]"], None),
    ("scikit_fem_start_v_half", &["initial_acceleration_missing [walls]"], None),
    ("scikit_fem_svk", &["material [saint_venant_kirchhoff]"], None),
    ("scikit_fem_t_half_thickness", &["traction_factor [all faces]"], Some(0.5)),
    ("scikit_fem_t_late", &["traction_late [all faces]"], None),
    ("scikit_fem_t_missing_xmax", &["traction_missing on x_max"], None),
    ("scikit_fem_t_present_area", &["traction_present_area [all faces]"], None),
    ("scikit_fem_t_sign_all", &["traction_sign [all faces]"], Some(-1.0)),
    ("scikit_fem_t_sign_ymax", &["traction_sign on y_max"], Some(-1.0)),
    ("scikit_fem_t_swapped_xmax", &["traction_swapped on x_max"], None),
    ("scikit_fem_tau_for_P", &["stress_kirchhoff"], None),
    ("scikit_fem_wall_frozen", &["wall_acceleration_missing"], None),
    ("scikit_fem_wall_late", &["wall_late [acceleration]"], None),
    ("scikit_fem_wall_u_old", &[], None),
];

#[test]
fn planted_mistakes_are_named() {
    let folder = Folder::new();
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/data/foreign");
    let path = |name: &str| data.join(name).to_string_lossy().into_owned();
    for (run, accepted, size) in sampled(RUNS, SHARE) {
        let (field, cells, time) = match run.starts_with("felupe") {
            true => ("rubber_block_3d.toml", [4, 8], ""),
            false => ("pushed_block_2d.toml", [16, 32], "--time 0.05572252686302013"),
        };
        let files = cells.map(|cells| path(&format!("{run}_{cells}.npz"))).join(" ");
        let command = format!("diagnose {} {files} {time} --json", path(field));
        if accepted == ["nothing"] {
            assert_eq!(folder.mms(&command).exits(0).json()["finding"], "nothing", "{run}");
            continue;
        }
        let found = folder.mms(&command).exits(1).json();
        let best = &found["ranked"][0];
        let part = |key: &str| best[key].as_str();
        let which = part("which").map_or(String::new(), |it| format!(" [{it}]"));
        let face = part("face").map_or(String::new(), |it| format!(" on {it}"));
        let title = format!("{}{which}{face}", part("hypothesis").expect("a name"));
        if accepted.is_empty() {
            assert_eq!(found["finding"], "unexplained", "{run}: {title}");
            continue;
        }
        assert_eq!(found["finding"], "named", "{run}: {title}");
        assert!(accepted.contains(&&*title), "{run}: {title}");
        if let Some(size) = size {
            let own = best["factor"].as_f64().expect("a size");
            assert!((own / size - 1.0).abs() < 0.1, "{run}: {own} for {size}");
        }
    }
}
