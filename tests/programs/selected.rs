//! Two parts of one field side by side, in a crate that allows no warning.
#![deny(warnings, missing_docs, unsafe_code, clippy::all)]

mms_macros::field!("examples/fields/standing_wave_1d.toml", quantities = [b, velocity]);
mms_macros::field!(
    "examples/fields/standing_wave_1d.toml",
    quantities = [body_force],
    set = { lambda = 0, rho0 = 1_00.0e1, amplitude = "-length/100", },
    freeze = [lambda, amplitude],
    name = neo,
);
mms_macros::field!("examples/fields/static_3d.toml", freeze, quantities = [velocity], name = rest);
mms_macros::field!("examples/fields/static_3d.toml", freeze);
mms_macros::field!(
    "examples/fields/static_3d.toml",
    rigid = "translation = [0, 'length*t^2/duration^2', 0]",
    name = moved,
);

mms_macros::field!("fields/bar_1d.toml", quantities = [P], form = "fast", name = fast);
mms_macros::field!("fields/bar_1d.toml", quantities = [P], form = "stable", name = stable);

use mms_math::Real;

/// Compiles where the trait is implemented: the modules need it, and nothing of the solver.
fn needs_math_only<T: Real>(x: T) -> [T; 1] {
    let field = standing_wave_1d::prepare(&standing_wave_1d::Parameters::default());
    field.at_time(x).velocity([x])
}

#[test]
fn parts_of_one_field_stand_side_by_side() {
    assert_eq!(standing_wave_1d::NAMES, ["length", "lambda", "mu", "rho0", "amplitude"]);
    assert_eq!(neo::NAMES, ["length", "mu", "rho0"]);
    let defaults = neo::Parameters { length: 1.0, mu: 4e5, rho0: 1e3 };
    assert_eq!(neo::Parameters::<f64>::default(), defaults);
    assert_eq!(rest::NAMES.len() + static_3d::NAMES.len(), 0);

    // b of W = mu/2 (I1 - 3) - mu ln J with F = 1 + pi A cos(pi X), by hand:
    // b = -(c pi)^2 A sin(pi X) + mu/rho0 (1 + F^-2) pi^2 A sin(pi X), c^2 = 2 mu/rho0.
    let pi = std::f64::consts::PI;
    let (mu, rho0, amplitude, x, t) = (4e5, 1e3, -0.01, 0.37_f64, 0.013_f64);
    let speed = f64::sqrt(2.0 * mu / rho0);
    let a = amplitude * (speed * pi * t).cos();
    let (stretch, u) = (1.0 + pi * a * (pi * x).cos(), a * (pi * x).sin());
    let expected = pi * pi * u * (mu / rho0 * (1.0 + stretch.powi(-2)) - speed * speed);
    let field = neo::prepare(&neo::Parameters::default());
    let [b] = field.at_time(t).body_force([x]);
    // The two moduli nearly cancel.
    let size = (pi * speed).powi(2) * amplitude.abs();
    assert!((b - expected).abs() < 1e-14 * size, "{b}, by hand {expected}");

    // With its lambda the field has another force, and the parameters change it.
    let other = standing_wave_1d::prepare(&standing_wave_1d::Parameters::default());
    assert_ne!(other.at_time(t).body_force([x]), [b]);
    let parameters = standing_wave_1d::Parameters { length: 1.0, lambda: 0.0, mu, rho0, amplitude };
    let [same] = standing_wave_1d::prepare(&parameters).at_time(t).body_force([x]);
    assert!((same - b).abs() < 1e-14 * size, "{same}, frozen {b}");
    assert_eq!(needs_math_only(0.0), [0.0]);

    let rest = rest::prepare::<f64>(&rest::Parameters {});
    assert_eq!(rest.at_time(0.5).velocity([0.1, 0.2, 0.3]), [0.0; 3]);
    let solver = static_3d::prepare::<f64>(&static_3d::Parameters {}).boxed();
    assert_eq!(solver.domain().time, [0.0, 1.0]);

    let moved = moved::prepare::<f64>(&moved::Parameters::default());
    assert_eq!(moved.at_time(0.5).velocity([0.1, 0.2, 0.3]), [0.0, 1.0, 0.0]);

    // Where it is stretched by 1e-13, F = 1 + H has lost most of H, and with it P = E H.
    let (length, young, rho0, amplitude) = (1.0, 1e6, 1e3, 1e-13);
    let fast = fast::prepare(&fast::Parameters { length, young, rho0, amplitude });
    let stable = stable::prepare(&stable::Parameters { length, young, rho0, amplitude });
    let [[fast]] = fast.at_time(0.0_f64).first_piola_kirchhoff([0.5]);
    let [[stable]] = stable.at_time(0.0_f64).first_piola_kirchhoff([0.5]);
    assert!((stable / 1e-7 - 1.0).abs() < 1e-12, "{stable:e}");
    assert!((fast / 1e-7 - 1.0).abs() > 1e-6, "{fast:e}");
}
