//! Strong ellipticity: samples against proofs, and where it is lost.

use crate::sampled::sampled;
use crate::support::{field, gallery};
use mms_codegen::Compiled;
use mms_codegen::certify::certificate::certify;
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::certify::softening::Softening;
use mms_stability::judge;
use mms_stability::subject::{Formulas, Subject};
use nalgebra::SVector;

/// The sampled minimum lies above the proved bound.
#[test]
fn no_wave_of_the_gallery_is_softer_than_is_proved() {
    for (name, compiled) in sampled(gallery(), 2) {
        let stability = judge(compiled);
        let modulus = stability.material.expect("a material").middle.modulus();
        let met = stability.waves.expect("states").least;
        assert!(met > 0.0, "{name}: {met}");
        // If moduli depend on X, the unit is the modulus of the place.
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
        match certify(&compiled).ellipticity {
            Ellipticity::Strong(bound) => assert!(!is_lost && bound <= expected, "{part}: {bound}"),
            Ellipticity::Lost(found) => {
                assert!(is_lost && found.value <= 0.0, "{part}: {found:?}");
                assert_eq!(found.direction, [1.0]);
                let there = 1.0 - shortening * found.witness.time;
                let value = 4.0 * (3.0 * there * there - 1.0) / 2.0;
                assert!((found.value - value).abs() < 1e-9, "{part}: {found:?} {value}");
            }
            Ellipticity::Unproved => panic!("{part}: unproved"),
        }
    }
}

/// In a shear that turns its axes with X, this matter loses ellipticity along one of them: the acoustic tensor of the reported
/// direction, from the tangent by dual numbers, has an eigenvalue that is not positive.
#[test]
fn what_is_lost_is_named_with_its_direction() {
    for dimension in [2, 3] {
        let compiled = field(&bent(dimension));
        let Ellipticity::Lost(found) = certify(&compiled).ellipticity else {
            panic!("{dimension}")
        };
        let formulas = Formulas::new(&compiled);
        let least = match dimension {
            2 => acoustic::<2>(&compiled, &formulas, &found),
            _ => acoustic::<3>(&compiled, &formulas, &found),
        };
        assert!(
            least <= found.value + 1e-9 && found.value <= 0.0,
            "{dimension}: {found:?} {least}"
        );
    }
}

fn acoustic<const D: usize>(compiled: &Compiled, formulas: &Formulas, found: &Softening) -> f64 {
    let mut subject = Subject::<D>::new(compiled, formulas);
    let place = SVector::from_column_slice(&found.witness.coordinates);
    let state = subject.state(&place, found.witness.time).expect("a state");
    state.elasticity.least_acoustic(&SVector::from_column_slice(&found.direction))
}

/// Saint Venant-Kirchhoff matter that is compressed across a layer that turns.
fn bent(dimension: usize) -> String {
    let axes = |each: &str| vec![each; dimension].join(", ");
    let rest = if dimension == 3 { ", \"0.01*Z\"" } else { "" };
    format!(
        r#"
[field]
title = "bent"
dimension = {dimension}
[displacement]
u = ["-0.5*t*(X + 0.4*Y)", "0.3*t*X*Y"{rest}]
[material]
model = "saint_venant_kirchhoff"
lambda = 2
mu = 1
density = 1
[domain]
shape = "box"
lower = [{}]
upper = [{}]
time = [0, 1]
"#,
        axes("0"),
        axes("1")
    )
}
