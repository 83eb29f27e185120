//! Fields for the tests, and the elasticity of neo-Hookean matter in closed form.
#![allow(dead_code)]

use std::fs;
use std::sync::LazyLock;

use crate::sampled::is_in_depth;
use mms_codegen::{Compiled, compile};
use mms_stability::elasticity::Elasticity;
use nalgebra::SMatrix;

/// Compiles a field from text.
pub fn field(text: &str) -> Compiled {
    compile("test", "test.toml", text, &|_| Err("none".into()))
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// A field of two dimensions that does not move: u, the moduli of a neo-Hookean material, the upper corner of a box at the
/// origin, and the claims about its faces.
pub fn plane(u: [&str; 2], [lambda, mu]: [f64; 2], [x, y]: [f64; 2], boundary: &str) -> Compiled {
    field(&format!(
        r#"
[field]
title = "plane"
dimension = 2
[displacement]
u = ["{}", "{}"]
[material]
model = "neo_hookean"
lambda = {lambda}
mu = {mu}
density = 1
[domain]
shape = "box"
lower = [0, 0]
upper = [{x}, {y}]
time = [0, 1]
[boundary]
{boundary}
"#,
        u[0], u[1]
    ))
}

/// A = lambda F^-T x F^-T + mu I + (mu - lambda ln J) F^-1_Li F^-1_Jk for W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2, by
/// hand (Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, section 6.4).
pub fn neo_hookean<const D: usize>(
    f: &SMatrix<f64, D, D>,
    volume: f64,
    [lambda, mu]: [f64; 2],
) -> Elasticity<D> {
    let inverse = f.try_inverse().expect("an inverse");
    let delta = |a: usize, b: usize| f64::from(u8::from(a == b));
    Elasticity::from_fn(|[i, j, k, l]| {
        lambda * inverse[(j, i)] * inverse[(l, k)]
            + mu * delta(i, k) * delta(j, l)
            + (mu - lambda * volume.ln()) * inverse[(l, i)] * inverse[(j, k)]
    })
}

/// The zero of a function between two points where it has different signs.
pub fn zero(mut from: f64, mut to: f64, value: impl Fn(f64) -> f64) -> f64 {
    let sign = value(from) > 0.0;
    loop {
        let middle = (from + to) / 2.0;
        // There is no number between the two.
        if middle == from || middle == to {
            return middle;
        }
        if (value(middle) > 0.0) == sign { from = middle } else { to = middle }
    }
}

/// The fields of the gallery that are tested in depth, in the order of their names.
pub fn gallery() -> &'static [(String, Compiled)] {
    static GALLERY: LazyLock<Vec<(String, Compiled)>> = LazyLock::new(compiled_gallery);
    &GALLERY
}

fn compiled_gallery() -> Vec<(String, Compiled)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../fields");
    let mut fields = Vec::new();
    let paths = fs::read_dir(folder).expect("the gallery").map(|it| it.expect("an entry").path());
    for path in paths.filter(|path| is_in_depth(path)) {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let compiled = compile(&name, &name, &text, &|_| Err("none".into()));
        fields.extend(compiled.ok().map(|compiled| (name, compiled)));
    }
    assert!(fields.len() > 10, "{}", fields.len());
    fields.sort_by(|(one, _), (other, _)| one.cmp(other));
    fields
}
