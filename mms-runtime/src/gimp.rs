//! The generalised interpolation material point method: a particle is a box along the axes.
//!
//! Bardenhagen, Kober, "The generalized interpolation material point method", CMES 5 (2004)
//! 477-496, doi 10.3970/cmes.2004.005.477, with a box as characteristic function: weight and weight
//! gradient are the averages of the hat function and of its slope over the particle's domain,
//!
//! w = 1/(2 l) int hat(x) dx,  grad w = 1/(2 l) int hat'(x) dx,  x from x_p - l to x_p + l.

use nalgebra::ComplexField;

use crate::shape::{MAX_NODES, Shape};
use crate::stencil::Tensor;
use crate::tensor::{determinant, stretch_along_axes};
use crate::{Cause, Lattice, Matrix, Real, Vector};

/// GIMP with half widths that stay, or that follow the stretch along the axes.
pub struct Gimp<const FOLLOWS: bool>;

impl<const FOLLOWS: bool> Shape for Gimp<FOLLOWS> {
    const FOLLOWS: bool = FOLLOWS;
    type Domain<T: Real, const D: usize> = Vector<T, D>;
    type Stencil<T: Real, const D: usize> = Tensor<T, D, MAX_NODES>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
        half_widths(half_edges)
    }

    #[inline(always)]
    fn place<T: Real, const D: usize>(
        stencil: &mut Tensor<T, D, MAX_NODES>,
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        initial: &Vector<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<(), Cause> {
        let mut half_width = *initial;
        if FOLLOWS {
            let stretch = stretch_along_axes(displacement_gradient).ok_or(Cause::FlatDomain)?;
            half_width.component_mul_assign(&stretch);
        }
        let cells = lattice.in_cells(position);
        let mut narrow = true;
        for a in 0..D {
            let (l, h) = (half_width[a], lattice.cell_size[a]);
            if !(l > T::zero() && l < h) {
                return Err(Cause::HalfWidth { half_width: l.to_f64(), cell_size: h.to_f64() });
            }
            half_width[a] *= lattice.per_length[a];
            narrow &= half_width[a] <= T::ratio(1, 2);
        }
        for a in 0..D {
            if narrow {
                let (first, weights) = around_nearest(cells[a], half_width[a]);
                stencil.set(lattice, a, first, weights);
            } else {
                let (first, weights) = wide_averages(cells[a], half_width[a]);
                stencil.set(lattice, a, first, weights);
            }
        }
        let fits = stencil.settle(lattice, if narrow { 3 } else { MAX_NODES });
        if fits { Ok(()) } else { Err(Cause::lost(position)) }
    }
}

/// The half widths of the box that stands for a domain: its own if its edges run along the axes, else those
/// of the cube of its volume. (A body-fitted domain is turned; a box is not.)
fn half_widths<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
    let diagonal = half_edges.diagonal();
    if *half_edges == Matrix::from_diagonal(&diagonal) {
        return diagonal;
    }
    let volume = determinant(half_edges).abs();
    Vector::repeat(ComplexField::powf(volume, T::ratio(1, D as i32)))
}

/// Averages of hat functions, and of their slopes, over [position - l, position + l] with l of at most half a
/// cell: they reach no further than from the nearest node to its neighbours. No branch, and one division.
/// With them comes the first node.
#[inline(always)]
fn around_nearest<T: Real>(position: T, half_width: T) -> (T, [[T; 3]; 2]) {
    let (zero, one, half) = (T::zero(), T::one(), T::ratio(1, 2));
    let nearest = (position + half).floor();
    let offset = position - nearest;
    // The domain has the length `right` beyond the nearest node, and `left` before it.
    let inside = offset.max(-half_width).min(half_width);
    let (right, left) = (half_width + inside, half_width - inside);
    let per_width = half / half_width;
    let (rise, fall) = (right * per_width, left * per_width);
    let above = half * right * rise + (offset - half_width).max(zero);
    let below = half * left * fall + (-offset - half_width).max(zero);
    (nearest - one, [[below, one - below - above, above], [-fall, fall - rise, rise]])
}

/// Likewise for any l of less than a cell.
#[cold]
fn wide_averages<T: Real>(position: T, half_width: T) -> (T, [[T; MAX_NODES]; 2]) {
    let first = (position - half_width).floor();
    let (mut weights, mut slopes) = ([T::zero(); MAX_NODES], [T::zero(); MAX_NODES]);
    let mut offset = position - first;
    for (weight, slope) in weights.iter_mut().zip(&mut slopes) {
        [*weight, *slope] = average_of_hat(offset, half_width);
        offset -= T::one();
    }
    (first, [weights, slopes])
}

/// The average of the hat 1 - |x|, and of its slope, over [offset - l, offset + l]: on either side
/// of the node, the length of the overlap times the hat at its middle. Nothing cancels, whatever l.
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
