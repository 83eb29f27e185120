//! B-splines on the knots of one axis: particles are points.
//!
//! de Boor, "A practical guide to splines", 1978, chapter X. Knots are integers, one cell apart, and every knot beyond the ends
//! lies on the end: splines are "open" there, reproduce linear functions up to it, and only one of them is not zero on it. So
//! walls need no images.

use mms_math::simd::{Plain, Simd};

use crate::column::PACK;
use crate::column::{Matrices, Pack as _, Vectors};
use crate::defect::{Defect, on};
use crate::failure::Cause;
use crate::lanes::{components, vectors};
use crate::lattice::Lattice;
use crate::real::{Matrix, Real, Vector};
use crate::shape::{Shape, lost};
use crate::stencil::{Known, ProductStencil};

/// The distance beyond the ends that a particle may reach, in cells. Particles farther out are lost.
const SLACK: f64 = 0.5;

/// Splines of degree P, with N = P + 1 nodes along each axis.
pub struct Spline<const P: usize, const N: usize>;

impl<const P: usize, const N: usize> Shape for Spline<P, N> {
    const DEGREE: usize = P;
    type Domain<T: Real, const D: usize> = ();
    type Stencil<T: Real, const D: usize> = ProductStencil<T, D>;

    fn domain<T: Real, const D: usize>(_: &Matrix<T, D>) {}

    #[inline(always)]
    fn place<T: Real, M: Simd<T>, const D: usize>(
        simd: M,
        stencil: &mut ProductStencil<T, D>,
        lattice: &Lattice<T, D>,
        position: &[M::Eight; D],
        (): &(),
        _: &Matrices<T, D>,
    ) -> Result<(), Cause> {
        place::<T, M, D, P, N>(simd, stencil, lattice, position)
    }

    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<ProductStencil<T, D>, Cause> {
        point::<T, D, P, N>(lattice, position)
    }
}

/// Computes the products of splines of degree P along the axes, at the positions of a pack of particles.
///
/// # Errors
/// A point is off the grid, or beyond the ends of the knots.
#[inline(always)]
pub fn place<T, M, const D: usize, const P: usize, const N: usize>(
    simd: M,
    stencil: &mut ProductStencil<T, D>,
    lattice: &Lattice<T, D>,
    position: &[M::Eight; D],
) -> Result<(), Cause>
where
    T: Real,
    M: Simd<T>,
{
    const { assert!(N == P + 1) };
    let [mut cells, mut cell] = [[simd.splat(T::zero()); D]; 2];
    for a in 0..D {
        cells[a] = lattice.cells_along(simd, a, position[a]);
        cell[a] = simd.floor(cells[a]);
    }
    if !simd.all_between(&cell, &lattice.inner) {
        let [position, cells] = [vectors(simd, *position), vectors(simd, cells)];
        return place_near_ends::<T, D, P, N>(stencil, lattice, &position, &cells);
    }
    stencil.begin::<N>(lattice, Known::Splines);
    if D == 2 && lattice.is_meridian {
        stencil.set_around::<M, N>(simd, position[0], None);
    }
    for a in 0..D {
        let weights = regular::<T, M, P, N>(simd, simd.minus(cells[a], cell[a]));
        stencil.set(simd, lattice, a, cell[a], weights);
    }
    Ok(())
}

/// Does the work of [`place`] for points, `cells` from the first knot along each axis, that may be near the ends or beyond
/// them.
#[cold]
fn place_near_ends<T: Real, const D: usize, const P: usize, const N: usize>(
    stencil: &mut ProductStencil<T, D>,
    lattice: &Lattice<T, D>,
    position: &Vectors<T, D>,
    cells: &Vectors<T, D>,
) -> Result<(), Cause> {
    // This function is not inlined into a loop and so cannot use the loop's better instructions.
    let simd = T::PlainSimd::from(Plain);
    let cells: [_; D] = components(simd, cells);
    let slack = T::of(SLACK);
    let near = lattice.ends.map(|[first, last]| [first - slack, last + slack]);
    if !simd.all_between(&cells, &near) {
        return Err(lost(position));
    }
    let is_regular = P == 1 || on(Defect::SplineEnds);
    stencil.begin::<N>(lattice, if is_regular { Known::Splines } else { Known::Nothing });
    if D == 2 && lattice.is_meridian {
        stencil.set_around::<_, N>(simd, simd.eight(&position.0[0]), None);
    }
    for a in 0..D {
        let [first, last] = lattice.ends[a];
        let floor = simd.greatest(simd.floor(cells[a]), simd.splat(first));
        let cell = simd.least(floor, simd.splat(last - T::one()));
        let weights = if is_regular {
            regular::<T, _, P, N>(simd, simd.minus(cells[a], cell))
        } else {
            near_any_ends::<T, _, P, N>(simd, cells[a], cell, lattice.ends[a])
        };
        stencil.set(simd, lattice, a, cell, weights);
    }
    Ok(())
}

/// Does the work of [`place`] for a pack of copies of one point.
///
/// # Errors
/// The errors of [`place`].
pub fn point<T: Real, const D: usize, const P: usize, const N: usize>(
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
) -> Result<ProductStencil<T, D>, Cause> {
    let mut stencil = ProductStencil::new();
    let simd = T::PlainSimd::from(Plain);
    let position = components(simd, &Vectors::alike(position));
    place::<T, _, D, P, N>(simd, &mut stencil, lattice, &position)?;
    Ok(stencil)
}

/// The P + 1 splines of degree P at `r` from the lower end of a cell whose knots are one cell apart, and
/// their derivatives.
#[inline(always)]
fn regular<T: Real, M: Simd<T>, const P: usize, const N: usize>(
    simd: M,
    r: M::Eight,
) -> [[M::Eight; N]; 2] {
    let zero = simd.splat(T::zero());
    let half = simd.splat(T::ratio(1, 2));
    let one = simd.splat(T::one());
    let s = simd.minus(one, r);
    let mut all = [[zero; N]; 2];
    let [weights, slopes] = &mut all;
    match P {
        1 => {
            weights.copy_from_slice(&[s, r]);
            slopes.copy_from_slice(&[simd.minus(zero, one), one]);
        }
        2 => {
            let (rr, ss) = (simd.times(r, r), simd.times(s, s));
            let middle = simd.times_plus(r, s, half);
            weights.copy_from_slice(&[simd.times(half, ss), middle, simd.times(half, rr)]);
            slopes.copy_from_slice(&[simd.minus(zero, s), simd.minus(s, r), r]);
        }
        _ => {
            let ([first, second], [rate, next_rate]) = cubics(simd, s, r);
            let ([fourth, third], [last_rate, third_rate]) = cubics(simd, r, s);
            weights.copy_from_slice(&[first, second, third, fourth]);
            let (rate, third_rate) = (simd.minus(zero, rate), simd.minus(zero, third_rate));
            slopes.copy_from_slice(&[rate, next_rate, third_rate, last_rate]);
        }
    }
    all
}

/// The cubic splines s^3/6 of the node before a cell and 2/3 - r^2 (1 - r/2) of the next one, and s^2/2 and r (3 r/2 - 2),
/// which are their derivatives in r = 1 - s up to signs.
#[inline(always)]
fn cubics<T: Real, M: Simd<T>>(
    simd: M,
    s: M::Eight,
    r: M::Eight,
) -> ([M::Eight; 2], [M::Eight; 2]) {
    let half = simd.splat(T::ratio(1, 2));
    let half_square = simd.times(simd.times(half, s), s);
    let outer = simd.times(simd.times(simd.splat(T::ratio(1, 3)), s), half_square);
    let falling = simd.minus(simd.times(half, r), simd.splat(T::one()));
    let two_thirds = simd.splat(T::ratio(2, 3));
    let rounded = on(Defect::SplineConstant);
    let two_thirds = if rounded { simd.splat(T::of(0.667)) } else { two_thirds };
    let inner = simd.times_plus(simd.times(r, r), falling, two_thirds);
    let slope = simd.minus(simd.times(simd.splat(T::ratio(3, 2)), r), simd.splat(T::of(2.0)));
    ([outer, inner], [half_square, simd.times(r, slope)])
}

/// Does the work of [`regular`] where knots may end.
#[cold]
fn near_any_ends<T: Real, M: Simd<T>, const P: usize, const N: usize>(
    simd: M,
    cells: M::Eight,
    cell: M::Eight,
    ends: [T; 2],
) -> [[M::Eight; N]; 2] {
    let (cells, cell) = (simd.numbers(cells), simd.numbers(cell));
    let mut all = [[[T::zero(); PACK]; N]; 2];
    for p in 0..PACK {
        let [weights, slopes] = near_ends::<T, P, N>(cells[p], cell[p], ends);
        for k in 0..N {
            (all[0][k][p], all[1][k][p]) = (weights[k], slopes[k]);
        }
    }
    all.map(|all| all.map(|numbers| simd.eight(&numbers)))
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
