//! B-splines on the knots of one axis: particles are points.
//!
//! de Boor, "A practical guide to splines", 1978, chapter X. Knots are integers, one cell apart, and every knot beyond the ends
//! lies on the end: splines are "open" there, reproduce linear functions up to it, and only one of them is not zero on it. So
//! walls need no images.

use mms_math::machine::{Machine, Plain};

use crate::column::BUNCH;
use crate::column::{Bunch as _, Matrices, Vectors};
use crate::defect::{Defect, on};
use crate::failure::Cause;
use crate::lanes::{components, vectors};
use crate::lattice::Lattice;
use crate::real::{Matrix, Real, Vector};
use crate::shape::{Shape, lost};
use crate::stencil::{Known, Tensor};

/// The distance beyond the ends that a particle may reach, in cells. Particles farther out are lost.
const SLACK: f64 = 0.5;

/// Splines of degree P, with N = P + 1 nodes along each axis.
pub struct Spline<const P: usize, const N: usize>;

impl<const P: usize, const N: usize> Shape for Spline<P, N> {
    const DEGREE: usize = P;
    type Domain<T: Real, const D: usize> = ();
    type Stencil<T: Real, const D: usize> = Tensor<T, D>;

    fn domain<T: Real, const D: usize>(_: &Matrix<T, D>) {}

    #[inline(always)]
    fn place<T: Real, M: Machine<T>, const D: usize>(
        machine: M,
        stencil: &mut Tensor<T, D>,
        lattice: &Lattice<T, D>,
        position: &[M::Eight; D],
        (): &(),
        _: &Matrices<T, D>,
    ) -> Result<(), Cause> {
        place::<T, M, D, P, N>(machine, stencil, lattice, position)
    }

    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<Tensor<T, D>, Cause> {
        point::<T, D, P, N>(lattice, position)
    }
}

/// Computes the products of splines of degree P along the axes, at the positions of a bunch of particles.
///
/// # Errors
/// A point is off the grid, or beyond the ends of the knots.
#[inline(always)]
pub fn place<T, M, const D: usize, const P: usize, const N: usize>(
    machine: M,
    stencil: &mut Tensor<T, D>,
    lattice: &Lattice<T, D>,
    position: &[M::Eight; D],
) -> Result<(), Cause>
where
    T: Real,
    M: Machine<T>,
{
    const { assert!(N == P + 1) };
    let [mut cells, mut cell] = [[machine.splat(T::zero()); D]; 2];
    for a in 0..D {
        cells[a] = lattice.cells_along(machine, a, position[a]);
        cell[a] = machine.floor(cells[a]);
    }
    if !machine.all_between(&cell, &lattice.inner) {
        let [position, cells] = [vectors(machine, *position), vectors(machine, cells)];
        return place_near_ends::<T, D, P, N>(stencil, lattice, &position, &cells);
    }
    stencil.begin::<N>(lattice, Known::Splines);
    if D == 2 && lattice.is_meridian {
        stencil.set_around::<M, N>(machine, position[0], None);
    }
    for a in 0..D {
        let weights = regular::<T, M, P, N>(machine, machine.minus(cells[a], cell[a]));
        stencil.set(machine, lattice, a, cell[a], weights);
    }
    Ok(())
}

/// Does the work of [`place`] for points, `cells` from the first knot along each axis, that may be near the ends or beyond
/// them.
#[cold]
fn place_near_ends<T: Real, const D: usize, const P: usize, const N: usize>(
    stencil: &mut Tensor<T, D>,
    lattice: &Lattice<T, D>,
    position: &Vectors<T, D>,
    cells: &Vectors<T, D>,
) -> Result<(), Cause> {
    // This function is not inlined into a loop and so cannot use the loop's better instructions.
    let machine = T::PlainMachine::from(Plain);
    let cells: [_; D] = components(machine, cells);
    let slack = T::of(SLACK);
    let near = lattice.ends.map(|[first, last]| [first - slack, last + slack]);
    if !machine.all_between(&cells, &near) {
        return Err(lost(position));
    }
    let is_regular = P == 1 || on(Defect::SplineEnds);
    stencil.begin::<N>(lattice, if is_regular { Known::Splines } else { Known::Nothing });
    if D == 2 && lattice.is_meridian {
        stencil.set_around::<_, N>(machine, machine.eight(&position.0[0]), None);
    }
    for a in 0..D {
        let [first, last] = lattice.ends[a];
        let floor = machine.greatest(machine.floor(cells[a]), machine.splat(first));
        let cell = machine.least(floor, machine.splat(last - T::one()));
        let weights = if is_regular {
            regular::<T, _, P, N>(machine, machine.minus(cells[a], cell))
        } else {
            near_any_ends::<T, _, P, N>(machine, cells[a], cell, lattice.ends[a])
        };
        stencil.set(machine, lattice, a, cell, weights);
    }
    Ok(())
}

/// Does the work of [`place`] for a bunch of copies of one point.
///
/// # Errors
/// The errors of [`place`].
pub fn point<T: Real, const D: usize, const P: usize, const N: usize>(
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
) -> Result<Tensor<T, D>, Cause> {
    let mut stencil = Tensor::new();
    let machine = T::PlainMachine::from(Plain);
    let position = components(machine, &Vectors::alike(position));
    place::<T, _, D, P, N>(machine, &mut stencil, lattice, &position)?;
    Ok(stencil)
}

/// The P + 1 splines of degree P at `r` from the lower end of a cell whose knots are one cell apart, and
/// their derivatives.
#[inline(always)]
fn regular<T: Real, M: Machine<T>, const P: usize, const N: usize>(
    machine: M,
    r: M::Eight,
) -> [[M::Eight; N]; 2] {
    let zero = machine.splat(T::zero());
    let half = machine.splat(T::ratio(1, 2));
    let one = machine.splat(T::one());
    let s = machine.minus(one, r);
    let mut all = [[zero; N]; 2];
    let [weights, slopes] = &mut all;
    match P {
        1 => {
            weights.copy_from_slice(&[s, r]);
            slopes.copy_from_slice(&[machine.minus(zero, one), one]);
        }
        2 => {
            let (rr, ss) = (machine.times(r, r), machine.times(s, s));
            let middle = machine.times_plus(r, s, half);
            weights.copy_from_slice(&[machine.times(half, ss), middle, machine.times(half, rr)]);
            slopes.copy_from_slice(&[machine.minus(zero, s), machine.minus(s, r), r]);
        }
        _ => {
            let ([first, second], [rate, next_rate]) = cubics(machine, s, r);
            let ([fourth, third], [last_rate, third_rate]) = cubics(machine, r, s);
            weights.copy_from_slice(&[first, second, third, fourth]);
            let (rate, third_rate) = (machine.minus(zero, rate), machine.minus(zero, third_rate));
            slopes.copy_from_slice(&[rate, next_rate, third_rate, last_rate]);
        }
    }
    all
}

/// The cubic splines s^3/6 of the node before a cell and 2/3 - r^2 (1 - r/2) of the next one, and s^2/2 and r (3 r/2 - 2),
/// which are their derivatives in r = 1 - s up to signs.
#[inline(always)]
fn cubics<T: Real, M: Machine<T>>(
    machine: M,
    s: M::Eight,
    r: M::Eight,
) -> ([M::Eight; 2], [M::Eight; 2]) {
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

/// Does the work of [`regular`] where knots may end.
#[cold]
fn near_any_ends<T: Real, M: Machine<T>, const P: usize, const N: usize>(
    machine: M,
    cells: M::Eight,
    cell: M::Eight,
    ends: [T; 2],
) -> [[M::Eight; N]; 2] {
    let (cells, cell) = (machine.numbers(cells), machine.numbers(cell));
    let mut all = [[[T::zero(); BUNCH]; N]; 2];
    for p in 0..BUNCH {
        let [weights, slopes] = near_ends::<T, P, N>(cells[p], cell[p], ends);
        for k in 0..N {
            (all[0][k][p], all[1][k][p]) = (weights[k], slopes[k]);
        }
    }
    all.map(|all| all.map(|numbers| machine.eight(&numbers)))
}

/// The splines in a `cell` whose knots are not all one cell apart, by the recurrence of Cox and de Boor, and their derivatives.
/// Knots are clamped to the `ends`; outside, the polynomials of the last cell are continued.
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
