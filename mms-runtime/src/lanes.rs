//! Vectors and matrices of four particles, component by component: a particle in each lane.

use mms_math::machine::Machine;

use crate::stencil::BUNCH;
use crate::{Matrix, Real, Vector};

/// The components of four vectors.
#[inline(always)]
pub fn components<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    vectors: &[Vector<T, D>; BUNCH],
) -> [M::Four; D] {
    let [a, b, c, d] = vectors;
    let mut components = [machine.splat(T::zero()); D];
    for i in 0..D {
        components[i] = machine.four(&[a[i], b[i], c[i], d[i]]);
    }
    components
}

/// The vectors with these components.
#[inline(always)]
pub fn vectors<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    components: [M::Four; D],
) -> [Vector<T, D>; BUNCH] {
    let mut vectors = [Vector::zeros(); BUNCH];
    for i in 0..D {
        let numbers = machine.numbers(components[i]);
        for p in 0..BUNCH {
            vectors[p][i] = numbers[p];
        }
    }
    vectors
}

/// The components of four matrices, column by column.
#[inline(always)]
pub fn columns<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    matrices: &[Matrix<T, D>; BUNCH],
) -> [[M::Four; D]; D] {
    let [a, b, c, d] = matrices;
    let mut columns = [[machine.splat(T::zero()); D]; D];
    for j in 0..D {
        for i in 0..D {
            let at = (i, j);
            columns[j][i] = machine.four(&[a[at], b[at], c[at], d[at]]);
        }
    }
    columns
}

/// The matrices with these columns.
#[inline(always)]
pub fn matrices<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    columns: [[M::Four; D]; D],
) -> [Matrix<T, D>; BUNCH] {
    let mut matrices = [Matrix::zeros(); BUNCH];
    for j in 0..D {
        for i in 0..D {
            let numbers = machine.numbers(columns[j][i]);
            for p in 0..BUNCH {
                matrices[p][(i, j)] = numbers[p];
            }
        }
    }
    matrices
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
