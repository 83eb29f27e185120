//! The numbers that check programs compare, for a field with a given pressure.

use mms_emit::Subject;
use mms_emit::port::callable::callables;

use super::gallery::field;

/// Every check program compares b with these numbers. Without the gradient of the pressure, rho0 b would lack cof F grad p, an
/// error of millions of times the accepted one.
#[test]
fn the_checks_of_every_target_see_the_gradient_of_a_given_pressure() {
    let compiled = &field("given_pressure_2d");
    let subject = Subject::new(compiled);
    let vectors = subject.vectors();
    let names: Vec<_> = callables(compiled).into_iter().map(|it| it.name).collect();
    let place = |name: &str| names.iter().position(|it| it == name).expect("a function");
    let of = |name: &str| &vectors.expected[place(name)];
    let rows = of("body_force_density").iter().zip(of("deformation_gradient"));
    let (mut largest, mut lost) = (0.0_f64, 0.0_f64);
    for ((force, f), slope) in rows.zip(of("p_gradient")) {
        let pressed = [f[3] * slope[0] - f[2] * slope[1], f[0] * slope[1] - f[1] * slope[0]];
        largest = force.iter().fold(largest, |largest, it| largest.max(it.abs()));
        lost = pressed.iter().fold(lost, |lost, it| lost.max(it.abs()));
    }
    let accepted =
        f64::from(vectors.accepted[place("body_force_density")]) * f64::EPSILON * largest;
    assert!(lost > 1e6 * accepted, "{lost:e}, {accepted:e}");
    for name in ["p", "p_gradient", "p_rate", "volume_residual"] {
        assert!(of(name).iter().flatten().any(|it| *it != 0.0), "{name}");
    }
}
