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

use mms_math::{Double, Real};

/// A function that compiles if the trait is implemented: the modules need `mms-math`, and nothing of the solver.
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

    // With its own lambda the field has another force, and the parameters change it.
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
}

/// The ratio of P to its true value, in the stable and the fast form, where a bar is stretched by 1e-13.
fn stress<T: Real>(to_f64: fn(T) -> f64) -> [f64; 2] {
    let [length, young, rho0, amplitude] = [1.0, 1e6, 1e3, 1e-13].map(T::from_f64);
    let fast = fast::prepare(&fast::Parameters { length, young, rho0, amplitude });
    let stable = stable::prepare(&stable::Parameters { length, young, rho0, amplitude });
    let [time, x] = [0.0, 0.5].map(T::from_f64);
    let [[stable]] = stable.at_time(time).first_piola_kirchhoff([x]);
    let [[fast]] = fast.at_time(time).first_piola_kirchhoff([x]);
    [stable, fast].map(|stress| to_f64(stress) / 1e-7)
}

/// F = 1 + H rounds H to eps, and so does the fast form of P = E H.
#[test]
fn every_precision_computes_in_either_form() {
    for ([stable, fast], eps, is_kept) in [
        (stress::<f32>(f64::from), 1.2e-7, false),
        (stress::<f64>(f64::from), 2.2e-16, false),
        (stress(Double::to_f64), 2.2e-16, true),
    ] {
        // Second order in the strain is 1e-13.
        assert!((stable - 1.0).abs() < 8.0 * eps + 1e-12, "{stable:e}");
        assert_eq!((fast - 1.0).abs() < 1e-12, is_kept, "{fast:e}");
    }
}
