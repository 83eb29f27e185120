//! X(x, t): the result is the point that was moved there, and refused points are nowhere or in two places.

use mms_analysis::inverse_motion::{Inverse, Unplaced};
use mms_codegen::{Compiled, compile};
use mms_mechanics::Output;
use mms_mechanics::sample::{domain, samples};
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;
use mms_symbolic::sorted::SortedMap;

fn gallery(name: &str) -> Compiled {
    let path = format!("{}/../fields/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    field(&std::fs::read_to_string(path).unwrap())
}

fn field(text: &str) -> Compiled {
    let none = |_: &str| Err("no other file".to_owned());
    let compiled = compile("field", "field.toml", text, &none);
    compiled.unwrap_or_else(|failure| panic!("{failure}"))
}

fn parameters(compiled: &Compiled) -> Vec<f64> {
    compiled.parameters::<f64>(&SortedMap::new())
}

/// x of a point, by the interpreter.
fn moved(compiled: &Compiled, reference: &[f64], time: f64) -> Vec<f64> {
    let mut interpreter = Interpreter::new(&compiled.program, &parameters(compiled));
    interpreter.set_time(&time);
    let output = Output::Quantity(Quantity::Position);
    let plan = interpreter.plan(&[output]);
    interpreter.set_point(&plan, Point::at(reference));
    interpreter.output(output)
}

/// A strip that is bent about the origin, by more than a turn if it is longer than that.
fn bent(length: &str) -> Compiled {
    field(&format!(
        r#"
[field]
title = "A bent strip"
dimension = 2
[displacement]
u = ["X*cos(Y) - X", "X*sin(Y) - Y"]
[material]
model = "neo_hookean"
density = "1000"
lambda = "1e6"
mu = "1e6"
[domain]
shape = "box"
lower = ["1", "0"]
upper = ["2", "{length}"]
time = ["0", "1"]
"#
    ))
}

#[test]
fn a_point_of_the_bar_is_where_it_came_from() {
    let bar = gallery("bar_1d");
    let mut inverse = Inverse::new(&bar, &SortedMap::new(), 0.013);
    let found = inverse.reference(&[0.4], 0.0).unwrap();
    // By bisection of x(X, 0.013) = 0.4 with 50 digits.
    assert!((found[0] - 0.3669589318356906).abs() <= f64::EPSILON / 4.0, "{found:?}");
}

#[test]
fn points_come_back_in_fields_of_every_dimension() {
    for name in [
        "bar_1d",
        "axis_aligned_2d",
        "generalized_vortex",
        "conformal_sector_2d",
        "cyclic_shear_3d",
        "axis_aligned_3d",
    ] {
        let compiled = gallery(name);
        let (body, [_, last]) = domain(&compiled.program, &parameters(&compiled));
        for time in [0.3 * last, last] {
            let mut inverse = Inverse::new(&compiled, &SortedMap::new(), time);
            for sample in samples(&compiled.program, &parameters(&compiled), 12) {
                let x = moved(&compiled, &sample.coordinates, time);
                let found = inverse.reference(&x, 0.0);
                let found = found.unwrap_or_else(|why| panic!("{name}, {sample:?}: {why:?}"));
                for (found, exact) in found.iter().zip(&sample.coordinates) {
                    let size = body.point(&[1.0; 3]).iter().fold(1.0, |a: f64, b| a.max(b.abs()));
                    assert!((found - exact).abs() < 1e-13 * size, "{name}: {found} is not {exact}");
                }
            }
        }
    }
}

#[test]
fn corners_of_a_body_are_found_and_lie_on_it() {
    let compiled = gallery("axis_aligned_2d");
    let (body, [_, last]) = domain(&compiled.program, &parameters(&compiled));
    let mut inverse = Inverse::new(&compiled, &SortedMap::new(), 0.7 * last);
    for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let corner = body.point(&corner);
        let x = moved(&compiled, &corner, 0.7 * last);
        let found = inverse.reference(&x, 0.0).unwrap();
        assert!(body.contains(&found), "{found:?}");
        assert!(found.iter().zip(&corner).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
    }
}

#[test]
fn two_points_in_one_place_are_both_named() {
    let once = bent("3");
    let mut inverse = Inverse::new(&once, &SortedMap::new(), 0.5);
    let x = moved(&once, &[1.25, 0.5], 0.5);
    let found = inverse.reference(&x, 0.0).unwrap();
    assert!((found[0] - 1.25).abs() < 1e-14 && (found[1] - 0.5).abs() < 1e-14, "{found:?}");

    let overlapping = bent("7");
    let mut inverse = Inverse::new(&overlapping, &SortedMap::new(), 0.5);
    let found = inverse.reference(&x, 0.0);
    let Err(Unplaced::Several(mut both)) = found else { panic!("{found:?}") };
    both.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let expected = [[1.25, 0.5], [1.25, 0.5 + std::f64::consts::TAU]];
    for (found, expected) in both.iter().zip(expected) {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-13), "{both:?}");
    }
    // Beyond the overlapping part there is one reference position again.
    let x = moved(&overlapping, &[1.25, 2.0], 0.5);
    assert!(inverse.reference(&x, 0.0).is_ok());
}

#[test]
fn a_point_outside_the_image_is_outside() {
    let bar = gallery("bar_1d");
    let mut inverse = Inverse::new(&bar, &SortedMap::new(), 0.013);
    let end = moved(&bar, &[1.0], 0.013)[0];
    for outside in [-1e-9, end + 1e-9, 5.0] {
        assert_eq!(inverse.reference(&[outside], 0.0), Err(Unplaced::Outside), "{outside}");
    }
    // Within the given rounding, the point is the end.
    assert_eq!(inverse.reference(&[end + 1e-9], 1e-8), Ok(vec![1.0]));
    assert_eq!(inverse.reference(&[f64::NAN], 0.0), Err(Unplaced::Outside));
}
