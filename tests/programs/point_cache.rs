//! Cached values of a point give the same bits as the point, in either precision.
#![deny(warnings)]

mms_macros::field!("fields/bar_1d.toml");
mms_macros::field!("examples/fields/standing_wave_3d.toml");
mms_macros::field!("examples/fields/static_3d.toml", quantities = [body_force, traction]);

/// Asserts that quantities are equal by both ways.
macro_rules! same {
    ($now:ident, $at:ident, $point:ident: $($name:ident $kept:ident,)*) => {
        $(assert_eq!($now.$name($at), $now.$kept(&$point), stringify!($name));)*
    };
}

macro_rules! every_quantity {
    ($module:ident, $scalar:ty, $points:expr, $normal:expr) => {
        let field = $module::prepare(&$module::Parameters::<$scalar>::default());
        for at in $points {
            // Once per point, and then for all times.
            let point = field.at_point(at);
            assert_eq!(point.reference_position, at);
            for time in [0.0, 0.013, 1.7] {
                let now = field.at_time(time);
                same!(now, at, point:
                    displacement displacement_at,
                    velocity velocity_at,
                    acceleration acceleration_at,
                    displacement_gradient displacement_gradient_at,
                    deformation_gradient deformation_gradient_at,
                    jacobian jacobian_at,
                    right_cauchy_green right_cauchy_green_at,
                    left_cauchy_green left_cauchy_green_at,
                    green_lagrange green_lagrange_at,
                    mass_density mass_density_at,
                    strain_energy strain_energy_at,
                    first_piola_kirchhoff first_piola_kirchhoff_at,
                    nominal_stress nominal_stress_at,
                    cauchy_stress cauchy_stress_at,
                    kirchhoff_stress kirchhoff_stress_at,
                    div_p div_p_at,
                    div_sigma div_sigma_at,
                    body_force body_force_at,
                    body_force_density body_force_density_at,
                    current_body_force_density current_body_force_density_at,
                );
                assert_eq!(now.traction(at, $normal), now.traction_at(&point, $normal));
            }
        }
    };
}

#[test]
fn what_is_kept_of_a_point_gives_the_same_bits() {
    every_quantity!(bar_1d, f64, [[0.0], [0.37], [1.0]], [1.0]);
    every_quantity!(bar_1d, f32, [[0.0], [0.37], [1.0]], [-1.0]);
    let points = [[0.1, 0.2, 0.3], [0.9, 0.5, 0.7]];
    every_quantity!(standing_wave_3d, f64, points, [0.6, 0.0, 0.8]);
    let points = [[0.1, 0.2, 0.3], [0.9, 0.5, 0.7]];
    every_quantity!(standing_wave_3d, f32, points, [0.6, 0.0, 0.8]);

    // A field at rest caches the result itself.
    let field = static_3d::prepare(&static_3d::Parameters::<f64>::default());
    let point = field.at_point([0.1, 0.2, 0.3]);
    let b = field.at_time(0.0).body_force(point.reference_position);
    assert_eq!(field.at_time(9.0).body_force_at(&point), b);

    assert_eq!(bar_1d::Point::<f64>::BYTES, 2 * bar_1d::Point::<f32>::BYTES);
    assert_eq!(
        bar_1d::Point::<f64>::BYTES,
        size_of_val(&bar_1d::prepare(&bar_1d::Parameters::<f64>::default()).at_point([0.0]))
    );
}
