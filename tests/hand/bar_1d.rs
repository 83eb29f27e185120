//! The 1D bar of Wallstedt & Guilkey's slides, derived by hand.
//!
//! ```text
//! u     = X (2L - X)/L^2 A(t),  A(t) = a cos(c pi t/L),  c = sqrt(E/rho0)
//! F     = 1 + du/dX = 1 + 2 (L - X) A/L^2
//! P     = E/2 (F - 1/F)                       (neo-Hookean, nu = 0: lambda = 0, mu = E/2)
//! Div P = E/2 (1 + F^-2) dF/dX = -(E A/L^2) (1 + F^-2)
//! b     = A'' X (2L - X)/L^2 - Div P/rho0     (rho0 a = Div P + rho0 b)
//! ```

use mms_gallery::bar_1d::{Parameters, prepare};

use crate::support::random;

/// E, rho0, L and a of one bar.
struct Bar {
    young: f64,
    rho0: f64,
    length: f64,
    amplitude: f64,
}

impl Bar {
    fn wave_number(&self) -> f64 {
        (self.young / self.rho0).sqrt() * std::f64::consts::PI / self.length
    }

    /// A(t).
    fn end(&self, t: f64) -> f64 {
        self.amplitude * (self.wave_number() * t).cos()
    }

    /// A''(t) = -(c pi/L)^2 A(t).
    fn end_acceleration(&self, t: f64) -> f64 {
        -self.wave_number() * self.wave_number() * self.end(t)
    }

    fn displacement(&self, x: f64, t: f64) -> f64 {
        x * (2.0 * self.length - x) / (self.length * self.length) * self.end(t)
    }

    fn deformation_gradient(&self, x: f64, t: f64) -> f64 {
        1.0 + 2.0 * (self.length - x) / (self.length * self.length) * self.end(t)
    }

    fn stress(&self, x: f64, t: f64) -> f64 {
        let f = self.deformation_gradient(x, t);
        self.young / 2.0 * (f - 1.0 / f)
    }

    fn stress_divergence(&self, x: f64, t: f64) -> f64 {
        let f = self.deformation_gradient(x, t);
        -self.young * self.end(t) / (self.length * self.length) * (1.0 + 1.0 / (f * f))
    }

    fn inertia(&self, x: f64, t: f64) -> f64 {
        x * (2.0 * self.length - x) / (self.length * self.length) * self.end_acceleration(t)
    }

    fn body_force(&self, x: f64, t: f64) -> f64 {
        self.inertia(x, t) - self.stress_divergence(x, t) / self.rho0
    }

    /// b as the slide "Return to the 1D Bar: Take Derivatives" prints it, with a minus sign in
    /// front of E/rho0.
    fn printed_body_force(&self, x: f64, t: f64) -> f64 {
        let f = self.deformation_gradient(x, t);
        let squared = self.length * self.length;
        let stiffness = self.young / self.rho0 * (1.0 + 1.0 / (f * f)) * self.end(t);
        (x * (2.0 * self.length - x) * self.end_acceleration(t) - stiffness) / squared
    }
}

/// Bars of several sizes and stiffnesses, each with points and times within its window.
fn cases() -> impl Iterator<Item = (Bar, f64, f64)> {
    let mut random = random();
    (0..2000).map(move |_| {
        let bar = Bar {
            young: 10f64.powf(12.0 * random()),
            rho0: 10f64.powf(4.0 * random()),
            length: 10f64.powf(2.0 * random() - 1.0),
            amplitude: 0.0,
        };
        let amplitude = (0.4 * random() - 0.2) * bar.length;
        let bar = Bar { amplitude, ..bar };
        let period = 2.0 * bar.length / (bar.young / bar.rho0).sqrt();
        let (x, t) = (bar.length * random(), period * random());
        (bar, x, t)
    })
}

/// Both sides round a dozen operations, and the cosine of an angle of up to 2 pi turns the rounding of its argument into an
/// error of 2 pi eps.
const TOLERANCE: f64 = 64.0 * f64::EPSILON;

/// The largest 1 + F^-2: |A| <= L/5 gives F >= 3/5.
const STIFFNESS: f64 = 1.0 + 25.0 / 9.0;

/// The largest X (2L - X) (pi/L)^2: the part of A'' in b, in units of E A/(rho0 L^2).
const INERTIA: f64 = std::f64::consts::PI * std::f64::consts::PI;

#[track_caller]
fn assert_close(what: &str, generated: f64, by_hand: f64, scale: f64) {
    let error = (generated - by_hand).abs() / scale;
    assert!(
        error <= TOLERANCE,
        "{what}: generated {generated:e}, by hand {by_hand:e}, scale {scale:e}"
    );
}

#[test]
fn the_generated_bar_is_the_bar_on_paper() {
    for (bar, x, t) in cases() {
        let Bar { young, rho0, length, amplitude } = bar;
        let field = prepare(&Parameters { length, young, rho0, amplitude });
        let at = field.at_time(t);
        let size = amplitude.abs();
        assert_close("u", at.displacement([x])[0], bar.displacement(x, t), size);
        assert_close("F", at.deformation_gradient([x])[0][0], bar.deformation_gradient(x, t), 1.0);
        assert_close("J", at.jacobian([x]), bar.deformation_gradient(x, t), 1.0);
        let strain = size / length;
        // By hand P is written in F, which loses eps/strain; the bound for it is eps E.
        assert_close("P", at.first_piola_kirchhoff([x])[0][0], bar.stress(x, t), young);
        let slope = young * strain / length;
        assert_close("Div P", at.div_p([x])[0], bar.stress_divergence(x, t), STIFFNESS * slope);
        let force = (INERTIA + STIFFNESS) * slope / rho0;
        assert_close("b", at.body_force([x])[0], bar.body_force(x, t), force);
        assert_close("a", at.acceleration([x])[0], bar.inertia(x, t), force);
    }
}

/// The slides print b = [X (2L - X) A'' - (E/rho0)(1 + F^-2) A]/L^2. From b = a - Div P/rho0 with
/// their own Div P = -(E/L^2)(1 + F^-2) A the sign in front of E/rho0 is plus, so that the right
/// b less the printed one is 2 (E/rho0)(1 + F^-2) A/L^2.
#[test]
fn the_printed_sign_of_b_is_wrong() {
    for (bar, x, t) in cases() {
        let Bar { young, rho0, length, amplitude } = bar;
        let field = prepare(&Parameters { length, young, rho0, amplitude });
        let right = field.at_time(t).body_force([x])[0];
        let f = bar.deformation_gradient(x, t);
        let twice = 2.0 * (young / rho0) * (1.0 + 1.0 / (f * f)) * bar.end(t) / (length * length);
        let slope = young * amplitude.abs() / (length * length);
        // Two accelerations are subtracted, and each rounds.
        let scale = 2.0 * (INERTIA + STIFFNESS) * slope / rho0;
        assert_close("b - printed b", right - bar.printed_body_force(x, t), twice, scale);
    }
}

/// 60 digits by numerical differentiation of x(X, t), which uses no formula for b.
#[test]
fn j_and_b_have_the_values_that_differentiation_in_60_digits_gives() {
    let field = prepare(&Parameters::<f64> { young: 1e7, ..Parameters::default() });
    let at = field.at_time(0.0023);
    let (jacobian, force) = (at.jacobian([0.3]), at.body_force([0.3])[0]);
    assert!((jacobian - 1.210031099497).abs() < 1e-12, "{jacobian}");
    assert!((force - -5026.52412833426).abs() < 1e-10, "{force}");
}
