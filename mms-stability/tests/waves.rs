//! Strong ellipticity: what is sampled against what is proved, and where it is lost.

mod support;

use mms_codegen::certify::certificate::certify;
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_stability::judge;
use support::{field, gallery};

/// What is met lies above the proved bound.
#[test]
fn no_wave_of_the_gallery_is_softer_than_is_proved() {
    for (name, compiled) in &gallery() {
        let stability = judge(compiled);
        let modulus = stability.material.expect("a material").middle.modulus();
        let met = stability.waves.expect("states").least;
        assert!(met > 0.0, "{name}: {met}");
        // Moduli that depend on X are measured by those of the place.
        if let (Ellipticity::Strong(bound), false) =
            (certify(compiled).ellipticity, name.starts_with("graded"))
        {
            assert!(bound / modulus <= met * (1.0 + 1e-9), "{name}: {bound} {met}");
        }
    }
}

/// Saint Venant-Kirchhoff matter softens when it is compressed: along X with F = s, A_1111 = (lambda + 2 mu)(3 s^2 - 1)/2 is 0
/// at s = 1/sqrt(3) (Raoult, Aequationes Math. 31, 1986).
#[test]
fn compressed_saint_venant_kirchhoff_matter_is_not_strongly_elliptic() {
    let compressed = |shortening: f64| {
        field(&format!(
            r#"
[field]
title = "compressed"
dimension = 1
[displacement]
u = ["-{shortening}*t*X"]
[material]
model = "saint_venant_kirchhoff"
lambda = 2
mu = 1
density = 1
[domain]
shape = "box"
lower = [0]
upper = [1]
time = [0, 1]
"#
        ))
    };
    let critical = 1.0 - 1.0 / 3.0_f64.sqrt();
    for (part, is_lost) in [(0.98, false), (1.02, true)] {
        let shortening = part * critical;
        let compiled = compressed(shortening);
        let expected = 4.0 * (3.0 * (1.0 - shortening).powi(2) - 1.0) / 2.0;
        let waves = judge(&compiled).waves.expect("states");
        assert!((waves.least - expected).abs() < 1e-9, "{waves:?} {expected}");
        assert_eq!(waves.time, 1.0);
        let proved = matches!(certify(&compiled).ellipticity, Ellipticity::Strong(_));
        assert_eq!(proved, !is_lost, "{part}");
    }
}
