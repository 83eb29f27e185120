//! The generalised interpolation material point method: a particle is a box along the axes.
//!
//! Bardenhagen, Kober, "The generalized interpolation material point method", CMES 5 (2004)
//! 477-496, doi 10.3970/cmes.2004.005.477, with a box as characteristic function: weight and weight
//! gradient are the averages of the hat function and of its slope over the particle's domain,
//!
//! w = 1/(2 l) int hat(x) dx,  grad w = 1/(2 l) int hat'(x) dx,  x from x_p - l to x_p + l.
//!
//! On a meridian the domain is a ring, and the averages along R are over the ring, that is with the weight r (Nairn and
//! Guilkey, "Axisymmetric form of the generalized interpolation material point method", Int. J. Numer. Meth. Engng 101 (2015)
//! 127-147). With the middle r_m of the box they are the averages above plus a first moment each,
//!
//! w + 1/(2 l r_m) int (r - r_m) hat(r) dr,  grad w + 1/(2 l r_m) int (r - r_m) hat'(r) dr,
//!
//! and the weights w/r of the strain around the axis are the averages above over r_m. A ring that would cross the axis ends
//! there.

use mms_math::simd::{Plain, Simd};
use nalgebra::ComplexField;

use crate::column::PACK;
use crate::column::{Matrices, Vectors};
use crate::defect::{Defect, on};
use crate::failure::Cause;
use crate::lanes::{columns, components, stretches, vectors};
use crate::lattice::Lattice;
use crate::real::{Matrix, Real, Vector};
use crate::shape::{Shape, lost};
use crate::spline;
use crate::stencil::{Known, MOST, ProductStencil};
use crate::tensor::determinant;

/// The number of nodes along an axis that domains of up to a cell's width reach: the nearest one and its neighbours. Domains of
/// up to two cells reach [`MOST`].
const NEAREST: usize = 3;

/// GIMP with constant half widths, or with half widths that follow the stretch along the axes.
pub struct Gimp<const FOLLOWS: bool>;

impl<const FOLLOWS: bool> Shape for Gimp<FOLLOWS> {
    const FOLLOWS: bool = FOLLOWS;
    const ORIGIN: f64 = -0.5;
    type Domain<T: Real, const D: usize> = Vectors<T, D>;
    type Stencil<T: Real, const D: usize> = ProductStencil<T, D>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
        half_widths(half_edges)
    }

    #[inline(always)]
    fn place<T: Real, M: Simd<T>, const D: usize>(
        simd: M,
        stencil: &mut ProductStencil<T, D>,
        lattice: &Lattice<T, D>,
        position: &[M::Eight; D],
        initial: &Vectors<T, D>,
        displacement_gradient: &Matrices<T, D>,
    ) -> Result<(), Cause> {
        let mut half_width = components(simd, initial);
        if FOLLOWS && !on(Defect::HalfWidthKept) {
            let mut f = columns(simd, displacement_gradient);
            for a in 0..D {
                f[a][a] = simd.plus(f[a][a], simd.splat(T::one()));
            }
            let stretch = stretches(simd, &f);
            for a in 0..D {
                half_width[a] = simd.times(half_width[a], stretch[a]);
            }
        }
        let mut middle = *position;
        if D == 2 && lattice.is_meridian {
            (middle[0], half_width[0]) = ring(simd, position[0], half_width[0]);
        }
        let position = &middle;
        let mut in_cells = half_width;
        for a in 0..D {
            in_cells[a] = simd.times(in_cells[a], simd.splat(lattice.per_length[a]));
        }
        if !simd.all_between(&in_cells, &[[T::default_epsilon(), T::ratio(1, 2)]; D]) {
            let [position, half_width] = [vectors(simd, *position), vectors(simd, half_width)];
            if FOLLOWS && !half_width.0.as_flattened().iter().all(|l| l.is_finite()) {
                return Err(Cause::FlatDomain);
            }
            return place_wide(stencil, lattice, &position, &half_width);
        }
        // Without the last node, weights do not sum to 1.
        let short = on(Defect::ShortSupport);
        stencil.begin::<NEAREST>(lattice, if short { Known::Nothing } else { Known::Regular });
        let mut first = in_cells;
        for a in 0..D {
            let cells = lattice.cells_along(simd, a, position[a]);
            let mut weights;
            (first[a], weights) = around_nearest(simd, cells, in_cells[a]);
            if D == 2 && a == 0 && lattice.is_meridian {
                let radius = simd.times(position[0], simd.splat(lattice.per_length[0]));
                let moments = moments_around_nearest(simd, cells, in_cells[0]);
                let flat = weights;
                revolve(simd, &mut weights, moments, radius);
                stencil.set_around(simd, position[0], Some(flat[0]));
            }
            if short {
                weights.iter_mut().for_each(|weights| weights[2] = simd.splat(T::zero()));
            }
            stencil.set(simd, lattice, a, first[a], weights);
        }
        // NaN is on no grid.
        let last = T::of(NEAREST as f64);
        let on_grid = std::array::from_fn(|a| [T::zero(), lattice.nodes[a] - last]);
        if simd.all_between(&first, &on_grid) {
            Ok(())
        } else {
            Err(lost(&vectors(simd, *position)))
        }
    }

    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<ProductStencil<T, D>, Cause> {
        spline::point::<T, D, 1, 2>(lattice, position)
    }
}

/// Computes weights for half widths of up to a cell.
#[cold]
fn place_wide<T: Real, const D: usize>(
    stencil: &mut ProductStencil<T, D>,
    lattice: &Lattice<T, D>,
    position: &Vectors<T, D>,
    half_width: &Vectors<T, D>,
) -> Result<(), Cause> {
    // This function is not inlined into a loop and so cannot use the loop's better instructions.
    let simd = T::PlainSimd::from(Plain);
    stencil.begin::<MOST>(lattice, Known::Regular);
    let mut fits = true;
    for a in 0..D {
        let cells = simd.numbers(lattice.cells_along(simd, a, simd.eight(&position.0[a])));
        let h = lattice.cell_size[a];
        // A particle with fewer nodes may be near the last one.
        let last = lattice.nodes[a] - T::one();
        let last_first = lattice.nodes[a] - T::of(MOST as f64);
        let mut first = [T::zero(); PACK];
        let [mut weights, mut slopes] = [[[T::zero(); PACK]; MOST]; 2];
        let mut moments = [[[T::zero(); PACK]; MOST]; 2];
        for p in 0..PACK {
            let l = half_width.0[a][p];
            if !(l > T::zero() && l < h) {
                let (half_width, cell_size) = (l.to_f64(), h.to_f64());
                return Err(Cause::HalfWidth { half_width, cell_size });
            }
            let l = l * lattice.per_length[a];
            first[p] = (cells[p] - l).floor().min(last_first);
            fits &= first[p] >= T::zero() && cells[p] + l <= last;
            for k in 0..MOST {
                let offset = cells[p] - (first[p] + T::of(k as f64));
                [weights[k][p], slopes[k][p]] = average_of_hat(offset, l);
                if lattice.is_meridian {
                    [moments[0][k][p], moments[1][k][p]] = moment_of_hat(offset, l);
                }
            }
        }
        let mut all = [weights, slopes].map(|all| all.map(|along| simd.eight(&along)));
        if D == 2 && a == 0 && lattice.is_meridian {
            let radius = simd.eight(&position.0[0]);
            stencil.set_around(simd, radius, Some(all[0]));
            let radius = simd.times(radius, simd.splat(lattice.per_length[0]));
            let moments = moments.map(|all| all.map(|along| simd.eight(&along)));
            revolve(simd, &mut all, moments, radius);
        }
        stencil.set(simd, lattice, a, simd.eight(&first), all);
    }
    if fits { Ok(()) } else { Err(lost(position)) }
}

/// The half widths of the box that replaces a domain: the domain's own if its edges run along the axes, else the half widths of
/// the cube with its volume. (A body-fitted domain is turned; a box is not.)
fn half_widths<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
    let diagonal = half_edges.diagonal();
    if *half_edges == Matrix::from_diagonal(&diagonal) {
        let wrong = on(Defect::HalfWidthsSwapped);
        return if wrong { Vector::from_fn(|a, _| diagonal[D - 1 - a]) } else { diagonal };
    }
    let volume = determinant(half_edges).abs();
    Vector::repeat(ComplexField::powf(volume, T::ratio(1, D as i32)))
}

/// Averages of hat functions, and of their slopes, over [position - l, position + l] along an axis, with l of at most half a
/// cell: they reach no further than from the nearest node to its neighbours. Computes them without a branch and with one
/// division. Also returns the first node.
#[inline(always)]
fn around_nearest<T: Real, M: Simd<T>>(
    simd: M,
    position: M::Eight,
    half_width: M::Eight,
) -> (M::Eight, [[M::Eight; NEAREST]; 2]) {
    let halves = |count: i32| simd.splat(T::ratio(count, 2));
    let (zero, half, one) = (halves(0), halves(1), halves(2));
    let nearest = simd.floor(simd.plus(position, half));
    let offset = simd.minus(position, nearest);
    let [before, after] = [simd.minus(zero, half_width), half_width];
    // The domain has the length `right` beyond the nearest node, and `left` before it.
    let inside = simd.least(simd.greatest(offset, before), after);
    let (right, left) = (simd.plus(half_width, inside), simd.minus(half_width, inside));
    let per_width = simd.over(half, half_width);
    let (rise, fall) = (simd.times(right, per_width), simd.times(left, per_width));
    let beyond = simd.greatest(simd.minus(offset, after), zero);
    let short = simd.greatest(simd.minus(before, offset), zero);
    let above = simd.times_plus(simd.times(half, right), rise, beyond);
    let below = simd.times_plus(simd.times(half, left), fall, short);
    let middle = simd.minus(simd.minus(one, below), above);
    let slopes = [simd.minus(zero, fall), simd.minus(fall, rise), rise];
    (simd.minus(nearest, one), [[below, middle, above], slopes])
}

/// The middle and the half width, along R, of a box of the meridian whose ring has its centroid at `position`. A ring that
/// would cross the axis is shortened to end there.
#[inline(always)]
fn ring<T: Real, M: Simd<T>>(
    simd: M,
    position: M::Eight,
    half_width: M::Eight,
) -> (M::Eight, M::Eight) {
    let widest = simd.times(simd.splat(T::ratio(3, 4)), position);
    let half_width = simd.least(half_width, widest);
    let square = simd.times(half_width, half_width);
    // The larger root of r_m^2 - r_p r_m + l^2/3 = 0.
    let part = simd.times(simd.splat(T::ratio(4, 3)), square);
    let apart = simd.root(simd.minus(simd.times(position, position), part));
    let middle = simd.times(simd.splat(T::ratio(1, 2)), simd.plus(position, apart));
    (middle, half_width)
}

/// Adds the first moments over the radius, in cells, to weights and slopes.
#[inline(always)]
fn revolve<T: Real, M: Simd<T>, const W: usize>(
    simd: M,
    weights: &mut [[M::Eight; W]; 2],
    moments: [[M::Eight; W]; 2],
    radius: M::Eight,
) {
    if on(Defect::FlatWeights) {
        return;
    }
    let per_radius = simd.over(simd.splat(T::one()), radius);
    for s in 0..2 {
        for k in 0..W {
            weights[s][k] = simd.times_plus(moments[s][k], per_radius, weights[s][k]);
        }
    }
}

/// The averages of (x - position) times hat functions, and times their slopes, over the domains of [`around_nearest`].
#[inline(always)]
fn moments_around_nearest<T: Real, M: Simd<T>>(
    simd: M,
    position: M::Eight,
    half_width: M::Eight,
) -> [[M::Eight; NEAREST]; 2] {
    let halves = |count: i32| simd.splat(T::ratio(count, 2));
    let (zero, half) = (halves(0), halves(1));
    let nearest = simd.floor(simd.plus(position, half));
    let offset = simd.minus(position, nearest);
    let before = simd.minus(zero, half_width);
    let inside = simd.least(simd.greatest(offset, before), half_width);
    let (right, left) = (simd.plus(half_width, inside), simd.minus(half_width, inside));
    let per_width = simd.over(half, half_width);
    let beyond = simd.minus(half_width, simd.times(half, right));
    let above = moments_of_part(simd, [right, beyond], offset, per_width);
    let short = simd.minus(simd.times(half, left), half_width);
    let below = moments_of_part(simd, [left, short], offset, per_width);
    let mut moments = [[zero; NEAREST]; 2];
    for s in 0..2 {
        let falling = simd.minus(zero, below[s]);
        moments[s] = [falling, simd.minus(below[s], above[s]), above[s]];
    }
    moments
}

/// The averages of (x - offset) x and of x - offset over a part of a domain. `length` is the part's length, `apart` the
/// distance from the domain's middle `offset` to the part's middle.
#[inline(always)]
fn moments_of_part<T: Real, M: Simd<T>>(
    simd: M,
    [length, apart]: [M::Eight; 2],
    offset: M::Eight,
    per_width: M::Eight,
) -> [M::Eight; 2] {
    let share = simd.times(length, per_width);
    let variance = simd.times(simd.splat(T::ratio(1, 12)), simd.times(length, length));
    let middle = simd.plus(offset, apart);
    let product = simd.times_plus(middle, apart, variance);
    [simd.times(share, product), simd.times(share, apart)]
}

/// The averages of (x - offset) times the hat 1 - |x|, and times its slope, over the domain of [`average_of_hat`].
fn moment_of_hat<T: Real>(offset: T, half_width: T) -> [T; 2] {
    let (zero, one) = (T::zero(), T::one());
    let (from, to) = (offset - half_width, offset + half_width);
    let width = half_width + half_width;
    // Over the part between two ends, with the slope of the hat there.
    let part = |left: T, right: T, slope: T| {
        let length = (right - left).max(zero);
        let middle = (left + right) * T::ratio(1, 2);
        let apart = middle - offset;
        let product = (one + slope * middle) * apart + slope * length * length * T::ratio(1, 12);
        [length * product, length * slope * apart]
    };
    let rising = part(from.max(-one), to.min(zero), one);
    let falling = part(from.max(zero), to.min(one), -one);
    std::array::from_fn(|s| (rising[s] + falling[s]) / width)
}

/// The average of the hat 1 - |x|, and of its slope, over [offset - l, offset + l]: on either side of the node, the length of
/// the overlap times the hat at its middle. Nothing cancels for any l.
fn average_of_hat<T: Real>(offset: T, half_width: T) -> [T; 2] {
    let (zero, one, half) = (T::zero(), T::one(), T::ratio(1, 2));
    let (from, to) = (offset - half_width, offset + half_width);

    let (left, right) = (from.max(-one), to.min(zero));
    let rising = (right - left).max(zero);
    let rising_hat = one + half * (left + right);

    let (left, right) = (from.max(zero), to.min(one));
    let falling = (right - left).max(zero);
    let falling_hat = one - half * (left + right);

    let width = half_width + half_width;
    [(rising * rising_hat + falling * falling_hat) / width, (rising - falling) / width]
}
