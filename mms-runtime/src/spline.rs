//! B-splines on the knots of one axis: particles are points.
//!
//! de Boor, "A practical guide to splines", 1978, chapter X. Knots are integers, one cell apart, and
//! every knot beyond the ends lies on the end: splines are "open" there, reproduce linear functions up
//! to it, and only one of them is not zero on it. So walls need no images.

use crate::shape::{MAX_NODES, PointStencil, Shape};
use crate::stencil::Tensor;
use crate::{Cause, Lattice, Matrix, Real, Vector};

/// How far beyond the ends a particle may come, in cells: it has no business there.
const SLACK: f64 = 0.5;

/// Splines of degree P, with N = P + 1 nodes along each axis.
pub struct Spline<const P: usize, const N: usize>;

impl<const P: usize, const N: usize> Shape for Spline<P, N> {
    const DEGREE: usize = P;
    type Domain<T: Real, const D: usize> = ();
    type Stencil<T: Real, const D: usize> = Tensor<T, D, N>;

    fn domain<T: Real, const D: usize>(_: &Matrix<T, D>) {}

    #[inline(always)]
    fn place<T: Real, const D: usize>(
        stencil: &mut Tensor<T, D, N>,
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        (): &(),
        _: &Matrix<T, D>,
    ) -> Result<(), Cause> {
        place::<T, D, P, N>(stencil, lattice, position)
    }

    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<PointStencil<T, D>, Cause> {
        point::<T, D, P>(lattice, position)
    }
}

/// The products of splines of degree P along the axes, at a point.
///
/// # Errors
/// The point is off the grid, or beyond the ends of the knots.
#[inline(always)]
pub fn place<T: Real, const D: usize, const P: usize, const N: usize>(
    stencil: &mut Tensor<T, D, N>,
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
) -> Result<(), Cause> {
    const { assert!(P < N) };
    let cells = lattice.in_cells(position);
    let (slack, reach) = (T::of(SLACK), T::of(P as f64 - 1.0));
    let (mut within, mut regular) = (true, true);
    let mut cell = cells;
    for a in 0..D {
        let [first, last] = lattice.ends[a];
        within &= first - slack <= cells[a] && cells[a] <= last + slack;
        cell[a] = cells[a].floor().max(first).min(last - T::one());
        regular &= first + reach <= cell[a] && cell[a] + T::one() <= last - reach;
    }
    if regular {
        for a in 0..D {
            set_regular::<T, D, P, N>(stencil, lattice, a, cell[a], cells[a] - cell[a]);
        }
    } else {
        for a in 0..D {
            let weights = near_ends::<T, P, N>(cells[a], cell[a], lattice.ends[a]);
            stencil.set(lattice, a, cell[a], weights);
        }
    }
    let width = if N > P + 1 { N.min(P.max(2) + 1) } else { N };
    within &= stencil.settle(lattice, width);
    if within { Ok(()) } else { Err(Cause::lost(position)) }
}

/// As [`place`], of any degree.
///
/// # Errors
/// Likewise.
pub fn point<T: Real, const D: usize, const P: usize>(
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
) -> Result<PointStencil<T, D>, Cause> {
    let mut stencil = PointStencil::new();
    place::<T, D, P, MAX_NODES>(&mut stencil, lattice, position)?;
    Ok(stencil)
}

/// The P + 1 splines of degree P at `r` from the lower end of a `cell` whose knots are one cell apart, and
/// their derivatives.
#[inline(always)]
fn set_regular<T: Real, const D: usize, const P: usize, const N: usize>(
    stencil: &mut Tensor<T, D, N>,
    lattice: &Lattice<T, D>,
    a: usize,
    cell: T,
    r: T,
) {
    let (one, half) = (T::one(), T::ratio(1, 2));
    let s = one - r;
    match P {
        1 => stencil.set(lattice, a, cell, [[s, r], [-one, one]]),
        2 => {
            let weights = [half * s * s, half + r * s, half * r * r];
            stencil.set(lattice, a, cell, [weights, [-s, s - r, r]]);
        }
        _ => {
            let sixth = T::ratio(1, 6);
            let middle = |x: T| T::ratio(2, 3) - x * x * (one - half * x);
            let rate = |x: T| x * (T::ratio(3, 2) * x - T::of(2.0));
            let weights = [sixth * s * s * s, middle(r), middle(s), sixth * r * r * r];
            let rates = [-half * s * s, rate(r), -rate(s), half * r * r];
            stencil.set(lattice, a, cell, [weights, rates]);
        }
    }
}

/// The splines in a `cell` whose knots are not all one cell apart, by the recurrence of Cox and de Boor, and
/// their derivatives. Knots are held between the `ends`; outside, the polynomials of the last cell go on.
#[cold]
fn near_ends<T: Real, const P: usize, const N: usize>(
    position: T,
    cell: T,
    ends: [T; 2],
) -> [[T; N]; 2] {
    // The knot k after the one at the lower end of the cell; differences of knots are exact.
    let knot = |k: f64| (cell + T::of(k)).max(ends[0]).min(ends[1]);
    let (mut weight, mut slope) = ([T::zero(); N], [T::zero(); N]);
    weight[0] = T::one();
    for degree in 1..=P {
        let (mut from_left, mut slope_from_left) = (T::zero(), T::zero());
        for r in 0..degree {
            let right = r as f64 + 1.0;
            let (left, right) = (knot(right - degree as f64), knot(right));
            let share = weight[r] / (right - left);
            let rate = share * T::of(degree as f64);
            weight[r] = from_left + (right - position) * share;
            from_left = (position - left) * share;
            slope[r] = slope_from_left - rate;
            slope_from_left = rate;
        }
        weight[degree] = from_left;
        slope[degree] = slope_from_left;
    }
    [weight, slope]
}
