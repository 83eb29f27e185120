//! B-splines on the knots of one axis: particles are points.
//!
//! de Boor, "A practical guide to splines", 1978, chapter X. Knots are integers, one cell apart, and
//! every knot beyond the ends lies on the end: splines are "open" there, reproduce linear functions up
//! to it, and only one of them is not zero on it. So walls need no images.

use mms_math::machine::{Machine, Plain};

use crate::defect::{Defect, on};
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
    fn place<T: Real, M: Machine<T>, const D: usize>(
        machine: M,
        stencil: &mut Tensor<T, D, N>,
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        (): &(),
        _: &Matrix<T, D>,
    ) -> Result<(), Cause> {
        place::<T, M, D, P, N>(machine, stencil, lattice, position)
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
pub fn place<T: Real, M: Machine<T>, const D: usize, const P: usize, const N: usize>(
    machine: M,
    stencil: &mut Tensor<T, D, N>,
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
) -> Result<(), Cause> {
    const { assert!(P < N) };
    let cells = lattice.in_frame(machine, position);
    let [first, last] = lattice.frame.ends.map(|ends| machine.four(&ends));
    let slack = machine.splat(T::of(SLACK));
    let within = machine.all_at_most(machine.minus(first, slack), cells)
        && machine.all_at_most(cells, machine.plus(last, slack));
    let last_cell = machine.minus(last, machine.splat(T::one()));
    let cell = machine.least(machine.greatest(machine.floor(cells), first), last_cell);
    let reach = machine.splat(T::of(P as f64 - 1.0));
    let regular = P == 1
        || on(Defect::SplineEnds)
        || machine.all_at_most(machine.plus(first, reach), cell)
            && machine.all_at_most(cell, machine.minus(last_cell, reach));
    let fits = if regular {
        set_regular::<T, M, D, P, N>(machine, stencil, lattice, cell, machine.minus(cells, cell))
    } else {
        set_near_ends::<T, M, D, P, N>(machine, stencil, lattice, cells, cell)
    };
    if within && fits { Ok(()) } else { Err(Cause::lost(position)) }
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
    let machine = T::PlainMachine::from(Plain);
    place::<T, _, D, P, MAX_NODES>(machine, &mut stencil, lattice, position)?;
    Ok(stencil)
}

/// The P + 1 splines of degree P at `r` from the lower end of a `cell` whose knots are one cell apart, and
/// their derivatives.
#[inline(always)]
fn set_regular<T: Real, M: Machine<T>, const D: usize, const P: usize, const N: usize>(
    machine: M,
    stencil: &mut Tensor<T, D, N>,
    lattice: &Lattice<T, D>,
    cell: M::Four,
    r: M::Four,
) -> bool {
    let zero = machine.splat(T::zero());
    let half = machine.splat(T::ratio(1, 2));
    let one = machine.splat(T::one());
    let s = machine.minus(one, r);
    match P {
        1 => {
            let slopes = [machine.minus(zero, one), one];
            stencil.set(machine, lattice, cell, [[s, r], slopes])
        }
        2 => {
            let (rr, ss) = (machine.times(r, r), machine.times(s, s));
            let middle = machine.times_plus(r, s, half);
            let weights = [machine.times(half, ss), middle, machine.times(half, rr)];
            let slopes = [machine.minus(zero, s), machine.minus(s, r), r];
            stencil.set(machine, lattice, cell, [weights, slopes])
        }
        _ => {
            let ([first, second], [rate, next_rate]) = cubics(machine, s, r);
            let ([fourth, third], [last_rate, third_rate]) = cubics(machine, r, s);
            let weights = [first, second, third, fourth];
            let rates =
                [machine.minus(zero, rate), next_rate, machine.minus(zero, third_rate), last_rate];
            stencil.set(machine, lattice, cell, [weights, rates])
        }
    }
}

/// The cubic spline s^3/6 of the node before a cell, 2/3 - r^2 (1 - r/2) of the next one, and s^2/2 and
/// r (3 r/2 - 2), which are but for signs their derivatives in r = 1 - s.
#[inline(always)]
fn cubics<T: Real, M: Machine<T>>(
    machine: M,
    s: M::Four,
    r: M::Four,
) -> ([M::Four; 2], [M::Four; 2]) {
    let half = machine.splat(T::ratio(1, 2));
    let half_square = machine.times(machine.times(half, s), s);
    let outer = machine.times(machine.times(machine.splat(T::ratio(1, 3)), s), half_square);
    let falling = machine.minus(machine.times(half, r), machine.splat(T::one()));
    let two_thirds = machine.splat(T::ratio(2, 3));
    let rounded = on(Defect::SplineConstant);
    let two_thirds = if rounded { machine.splat(T::of(0.667)) } else { two_thirds };
    let inner = machine.times_plus(machine.times(r, r), falling, two_thirds);
    let slope =
        machine.minus(machine.times(machine.splat(T::ratio(3, 2)), r), machine.splat(T::of(2.0)));
    ([outer, inner], [half_square, machine.times(r, slope)])
}

/// The P + 1 splines of degree P in cells whose knots are not all one cell apart.
#[cold]
fn set_near_ends<T: Real, M: Machine<T>, const D: usize, const P: usize, const N: usize>(
    machine: M,
    stencil: &mut Tensor<T, D, N>,
    lattice: &Lattice<T, D>,
    cells: M::Four,
    cell: M::Four,
) -> bool {
    let (cells, cell_numbers) = (machine.numbers(cells), machine.numbers(cell));
    let [mut weights, mut slopes] = [[[T::zero(); 4]; N]; 2];
    for a in 0..D {
        let [along, rates] = near_ends::<T, P, N>(cells[a], cell_numbers[a], lattice.ends[a]);
        for k in 0..N {
            (weights[k][a], slopes[k][a]) = (along[k], rates[k]);
        }
    }
    let all = [weights, slopes].map(|all| all.map(|along| machine.four(&along)));
    stencil.set(machine, lattice, cell, all)
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
