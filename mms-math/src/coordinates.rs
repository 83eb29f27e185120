//! Systems of coordinates in which a body is a box: Cartesian coordinates, radius and angle, and radius and two angles. Solver,
//! proofs and emitted code share these positions, directions and areas.

/// A system of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// X, Y and Z.
    Cartesian,
    /// The radius R and the angle theta in the plane of X and Y, and Z in space: X = R cos theta, Y = R sin theta.
    Polar,
    /// The radius R, the angle theta about the axis Z, and the angle phi from it: X = R sin phi cos theta,
    /// Y = R sin phi sin theta, Z = R cos phi.
    Spherical,
}

/// The arithmetic that positions are computed in: of numbers, or of formulas.
pub trait Arithmetic {
    /// The type of the values, such as a number or a formula.
    type Value: Clone;

    /// A whole number.
    fn number(&mut self, number: i8) -> Self::Value;

    /// A product.
    fn times(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;

    /// The cosine and the sine of an angle.
    fn circular(&mut self, angle: &Self::Value) -> [Self::Value; 2];
}

/// The arithmetic of a scalar.
#[derive(Clone, Copy, Debug, Default)]
pub struct Numbers<T>(core::marker::PhantomData<T>);

impl<T> Numbers<T> {
    /// Creates the arithmetic.
    pub fn new() -> Self {
        Numbers(core::marker::PhantomData)
    }
}

impl<T: crate::Scalar> Arithmetic for Numbers<T> {
    type Value = T;

    fn number(&mut self, number: i8) -> T {
        T::from_f64(f64::from(number))
    }

    fn times(&mut self, a: &T, b: &T) -> T {
        a.clone() * b.clone()
    }

    fn circular(&mut self, angle: &T) -> [T; 2] {
        [angle.clone().cos(), angle.clone().sin()]
    }
}

impl System {
    /// X at the given coordinates; further coordinates of a body of fewer dimensions are 0.
    pub fn position<A: Arithmetic>(self, with: &mut A, at: &[A::Value; 3]) -> [A::Value; 3] {
        match self {
            System::Cartesian => at.clone(),
            System::Polar => {
                let [cosine, sine] = with.circular(&at[1]);
                [with.times(&at[0], &cosine), with.times(&at[0], &sine), at[2].clone()]
            }
            System::Spherical => {
                let [cosine, sine] = with.circular(&at[1]);
                let [along, across] = with.circular(&at[2]);
                let across = with.times(&at[0], &across);
                let (x, y) = (with.times(&across, &cosine), with.times(&across, &sine));
                [x, y, with.times(&at[0], &along)]
            }
        }
    }

    /// The unit vectors along which the coordinates grow, one after another.
    pub fn basis<A: Arithmetic>(self, with: &mut A, at: &[A::Value; 3]) -> [[A::Value; 3]; 3] {
        let [zero, one, minus] = [0, 1, -1].map(|number| with.number(number));
        let turned = |with: &mut A| {
            let [cosine, sine] = with.circular(&at[1]);
            let back = with.times(&minus, &sine);
            [[cosine.clone(), sine.clone()], [back, cosine]]
        };
        let third = [zero.clone(), zero.clone(), one.clone()];
        match self {
            System::Cartesian => {
                let first = [one.clone(), zero.clone(), zero.clone()];
                [first, [zero.clone(), one, zero], third]
            }
            System::Polar => {
                let [[a, b], [c, d]] = turned(with);
                [[a, b, zero.clone()], [c, d, zero], third]
            }
            System::Spherical => {
                let [[cosine, sine], [a, b]] = turned(with);
                let [along, across] = with.circular(&at[2]);
                let down = with.times(&minus, &across);
                let mut in_plane = |length: &A::Value, height: &A::Value| {
                    [with.times(length, &cosine), with.times(length, &sine), height.clone()]
                };
                let radial = in_plane(&across, &along);
                let polar = in_plane(&along, &down);
                [radial, [a, b, zero], polar]
            }
        }
    }

    /// The derivative of X by each coordinate, in length: 1, or R, or R sin phi.
    pub fn scales<A: Arithmetic>(self, with: &mut A, at: &[A::Value; 3]) -> [A::Value; 3] {
        let one = with.number(1);
        match self {
            System::Cartesian => [one.clone(), one.clone(), one],
            System::Polar => [one.clone(), at[0].clone(), one],
            System::Spherical => {
                let [_, across] = with.circular(&at[2]);
                [one, with.times(&at[0], &across), at[0].clone()]
            }
        }
    }

    /// Whether a coordinate is an angle.
    pub fn is_angle(self, axis: usize) -> bool {
        match self {
            System::Cartesian => false,
            System::Polar => axis == 1,
            System::Spherical => axis > 0,
        }
    }
}

#[cfg(feature = "std")]
impl System {
    /// The coordinates of X, with an angle theta between -pi and pi.
    pub fn local(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            System::Cartesian => [x, y, z],
            System::Polar => [x.hypot(y), y.atan2(x), z],
            System::Spherical => {
                let across = x.hypot(y);
                [across.hypot(z), y.atan2(x), across.atan2(z)]
            }
        }
    }

    /// Lower and upper corner of the smallest box around the body between bounds; further coordinates of a body of fewer
    /// dimensions are 0.
    pub fn bounding_box(self, bounds: &[[f64; 2]]) -> [[f64; 3]; 2] {
        use core::f64::consts::FRAC_PI_2;
        let axis = |axis: usize| bounds.get(axis).copied().unwrap_or([0.0; 2]);
        // The ends, and for an angle the quarters of a turn between them.
        let places = |own: usize| {
            let [first, last] = axis(own);
            // A length has no quarters, however large it is.
            let [from, to] = if self.is_angle(own) { [first, last] } else { [0.5, 0.0] };
            let quarters = (from / FRAC_PI_2).ceil() as i64..=(to / FRAC_PI_2).floor() as i64;
            quarters.map(|k| k as f64 * FRAC_PI_2).chain([first, last])
        };
        let mut corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for first in places(0) {
            for second in places(1) {
                for third in places(2) {
                    let at = [first, second, third];
                    let point = self.position(&mut Numbers::<f64>::new(), &at);
                    for k in 0..3 {
                        // Round-off of a sine must not move a corner off a knot.
                        let is_round = self != System::Cartesian;
                        let is_zero = is_round && point[k].abs() < 1e-12 * axis(0)[1];
                        let x = if is_zero { 0.0 } else { point[k] };
                        corners[0][k] = corners[0][k].min(x);
                        corners[1][k] = corners[1][k].max(x);
                    }
                }
            }
        }
        corners
    }

    /// The volume between bounds of all coordinates; if one coordinate is a fixed number, the area between the bounds of the
    /// others.
    pub fn measure(self, sides: &[Side]) -> f64 {
        let ranges = |axis: usize| matches!(sides.get(axis), Some(Side::Between(_)));
        // The integrand is R^power, times sin phi where theta varies.
        let power = match self {
            System::Cartesian => 0,
            System::Polar => i32::from(ranges(1)),
            System::Spherical => i32::from(ranges(1)) + i32::from(ranges(2)),
        };
        let is_round = self != System::Cartesian;
        let part = |(axis, side): (usize, &Side)| match (axis, *side) {
            (0, Side::Between([from, to])) if is_round => {
                (to.powi(power + 1) - from.powi(power + 1)) / f64::from(power + 1)
            }
            (0, Side::At(radius)) if is_round => radius.powi(power),
            // cos a - cos b without cancellation.
            (2, Side::Between([from, to])) if self == System::Spherical && ranges(1) => {
                2.0 * ((from + to) / 2.0).sin() * ((to - from) / 2.0).sin()
            }
            (2, Side::At(angle)) if self == System::Spherical => angle.sin(),
            (_, Side::Between([from, to])) => to - from,
            (_, Side::At(_)) => 1.0,
        };
        sides.iter().enumerate().map(part).product()
    }
}

/// The extent of one coordinate over a part of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// The coordinate varies between these bounds.
    Between([f64; 2]),
    /// The coordinate is this number, as on a face.
    At(f64),
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use core::f64::consts::{PI, TAU};

    const AT: [f64; 3] = [1.3, 0.7, 0.9];

    fn place(system: System, at: [f64; 3]) -> [f64; 3] {
        system.position(&mut Numbers::<f64>::new(), &at)
    }

    /// Directions and scales against differences of positions.
    #[test]
    fn coordinates_move_x_along_their_directions() {
        for system in [System::Cartesian, System::Polar, System::Spherical] {
            let basis = system.basis(&mut Numbers::<f64>::new(), &AT);
            let scales = system.scales(&mut Numbers::<f64>::new(), &AT);
            for axis in 0..3 {
                let step = 1e-6;
                let mut ends = [AT; 2];
                ends[0][axis] -= step;
                ends[1][axis] += step;
                let [from, to] = ends.map(|at| place(system, at));
                for k in 0..3 {
                    let slope = (to[k] - from[k]) / (2.0 * step);
                    assert!((slope - scales[axis] * basis[axis][k]).abs() < 1e-9, "{system:?}");
                }
            }
            let back = system.local(place(system, AT));
            assert!((0..3).all(|k| (back[k] - AT[k]).abs() < 1e-14), "{system:?}: {back:?}");
        }
    }

    #[test]
    fn volumes_and_areas_are_those_on_paper() {
        use Side::{At, Between};
        let is = |system: System, sides: [Side; 3], exact: f64| {
            let found = system.measure(&sides);
            assert!((found - exact).abs() < 1e-14 * exact, "{system:?}, {sides:?}: {found}");
        };
        let (all, half, radii) = (Between([0.0, TAU]), Between([0.0, PI]), Between([1.0, 2.0]));
        is(System::Cartesian, [radii, Between([0.0, 3.0]), At(5.0)], 3.0);
        is(System::Polar, [radii, all, Between([0.0, 3.0])], 9.0 * PI);
        is(System::Polar, [At(2.0), all, Between([0.0, 3.0])], 12.0 * PI);
        is(System::Polar, [radii, At(0.5), Between([0.0, 3.0])], 3.0);
        is(System::Polar, [radii, all, At(3.0)], 3.0 * PI);
        is(System::Spherical, [radii, all, half], 4.0 * PI / 3.0 * 7.0);
        is(System::Spherical, [At(2.0), all, half], 16.0 * PI);
        is(System::Spherical, [radii, At(0.5), half], 1.5 * PI);
        // A cone of that angle: pi times its slant height times its radius, between two spheres.
        is(System::Spherical, [radii, all, At(PI / 6.0)], PI * 1.5);
    }
}
