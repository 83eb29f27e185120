//! Vectors and matrices of four particles, component by component: a particle in each lane.

use bytemuck::{cast_slice, cast_slice_mut};
use mms_math::machine::Machine;
use mms_math::structures::{put_columns, take_columns};

use crate::stencil::BUNCH;
use crate::{Matrix, Real, Vector};

/// The components of four vectors.
#[inline(always)]
pub fn components<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    vectors: &[Vector<T, D>; BUNCH],
) -> [M::Four; D] {
    let mut components = [machine.splat(T::zero()); D];
    take_columns(machine, cast_slice(vectors), &mut components);
    components
}

/// Gives four vectors these components.
#[inline(always)]
pub fn set_components<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    vectors: &mut [Vector<T, D>; BUNCH],
    components: [M::Four; D],
) {
    put_columns(machine, &components, cast_slice_mut(vectors));
}

/// The vectors with these components.
pub fn vectors<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    components: [M::Four; D],
) -> [Vector<T, D>; BUNCH] {
    let mut vectors = [Vector::zeros(); BUNCH];
    set_components(machine, &mut vectors, components);
    vectors
}

/// The components of four matrices, column by column.
#[inline(always)]
pub fn columns<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    matrices: &[Matrix<T, D>; BUNCH],
) -> [[M::Four; D]; D] {
    let mut columns = [[machine.splat(T::zero()); D]; D];
    take_columns(machine, cast_slice(matrices), columns.as_flattened_mut());
    columns
}

/// Gives four matrices these columns.
#[inline(always)]
pub fn set_columns<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    matrices: &mut [Matrix<T, D>; BUNCH],
    columns: [[M::Four; D]; D],
) {
    put_columns(machine, columns.as_flattened(), cast_slice_mut(matrices));
}

/// The determinants of four matrices with these columns; D = 1, 2, 3.
#[inline(always)]
pub fn determinants<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    columns: &[[M::Four; D]; D],
) -> M::Four {
    const { assert!(D >= 1 && D <= 3, "one to three dimensions") };
    let f = |i: usize, j: usize| columns[j % D][i % D];
    let minor = |rows: [usize; 2], [j, k]: [usize; 2]| {
        let other = machine.times(f(rows[0], k), f(rows[1], j));
        let product = machine.times(f(rows[0], j), f(rows[1], k));
        machine.minus(product, other)
    };
    match D {
        1 => f(0, 0),
        2 => minor([0, 1], [0, 1]),
        _ => {
            let others = machine.times(f(0, 1), minor([1, 2], [0, 2]));
            let first = machine.minus(machine.times(f(0, 0), minor([1, 2], [1, 2])), others);
            machine.times_plus(f(0, 2), minor([1, 2], [0, 1]), first)
        }
    }
}
