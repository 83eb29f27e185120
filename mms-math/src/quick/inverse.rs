//! The inverse trigonometric functions.

use super::number::Float;
use crate::lane::Lane;

/// An angle as a sum whose second term is less than a quarter of the first.
type Angle<T, const FUSED: bool> = [Lane<T, FUSED>; 2];

/// atan(q) for 0 <= q <= 1.
#[inline(always)]
fn octant<T: Float, const FUSED: bool>(q: Lane<T, FUSED>) -> Angle<T, FUSED> {
    let z = q * q;
    [q, (q * z) * z.polynomial(T::POLYNOMIALS.atan)]
}

/// `quarters` times pi/2 minus an angle, with the digits that pi/2 lacks.
#[inline(always)]
fn less_than<T: Float, const FUSED: bool>(
    quarters: f64,
    [angle, rest]: Angle<T, FUSED>,
) -> Angle<T, FUSED> {
    let [high, low] = T::PI.map(|part| Lane(part * T::of(quarters / 2.0)));
    [high - angle, low - rest]
}

/// The first angle if the condition holds, otherwise the second. Both are already computed.
#[inline(always)]
fn choose<T: Float, const FUSED: bool>(
    condition: bool,
    [a, b]: Angle<T, FUSED>,
    [c, d]: Angle<T, FUSED>,
) -> Angle<T, FUSED> {
    [if condition { a } else { c }, if condition { b } else { d }]
}

/// The inverse tangent. At most 1.5 ulp in `f64` and 1.4 in `f32`.
#[inline(always)]
pub fn atan<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let magnitude = x.abs();
    let one = Lane::of(1.0);
    let steep = magnitude.0 > one.0;
    let [above, below] = choose(steep, [one, magnitude], [magnitude, one]);
    let angle = octant(above / below);
    let [angle, rest] = choose(steep, less_than(1.0, angle), angle);
    (angle + rest).turned(x.sign())
}

/// The angle of the point (x, y). At most 1.6 ulp; NaN if both are 0 or infinite.
#[inline(always)]
pub fn atan2<T: Float, const FUSED: bool>(y: Lane<T, FUSED>, x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let (rise, run) = (y.abs(), x.abs());
    let steep = rise.0 > run.0;
    let [above, below] = choose(steep, [run, rise], [rise, run]);
    let angle = octant(above / below);
    let [angle, rest] = choose(steep, less_than(1.0, angle), angle);
    let angle = angle + rest;
    let back = less_than(2.0, [angle, Lane::of(0.0)]);
    let angle = if x.0 < T::of(0.0) { back[0] + back[1] } else { angle };
    angle.turned(y.sign())
}

/// Whether |x| > 1/2, and asin |x| if it is not. If it is, the inverse sine of sqrt((1 - |x|)/2), which is half of the
/// difference between a quarter turn and asin |x|.
#[inline(always)]
fn half<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> (bool, Angle<T, FUSED>) {
    let magnitude = x.abs();
    let large = magnitude.0 > T::of(0.5);
    let other = magnitude.times_plus(Lane::of(-0.5), Lane::of(0.5));
    let [z, q] = choose(large, [other, Lane(other.0.sqrt())], [magnitude * magnitude, magnitude]);
    (large, [q, (q * z) * z.polynomial(T::POLYNOMIALS.asin)])
}

/// The inverse sine. At most 2.0 ulp.
#[inline(always)]
pub fn asin<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let (large, angle) = half(x);
    let [angle, rest] = choose(large, less_than(1.0, angle.map(|part| part + part)), angle);
    (angle + rest).turned(x.sign())
}

/// The inverse cosine. At most 1.3 ulp.
#[inline(always)]
pub fn acos<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let (large, angle) = half(x);
    let twice = angle.map(|part| part + part);
    let twice = choose(x.0 < T::of(0.0), less_than(2.0, twice), twice);
    let signed = angle.map(|part| part.turned(x.sign()));
    let [angle, rest] = choose(large, twice, less_than(1.0, signed));
    angle + rest
}
