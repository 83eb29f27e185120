//! Vectors and matrices of a pack of particles, component by component: a particle in each lane.

use bytemuck::cast_slice;
use mms_math::simd::Simd;
use mms_math::structures::take_columns;

use crate::column::PACK;
use crate::column::{Matrices, Vectors};
use crate::real::{Real, Vector};

/// Transposes a pack of vectors that are stored one after the other into components.
#[inline(always)]
pub fn turned<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    vectors: &[Vector<T, D>; PACK],
) -> [M::Eight; D] {
    let mut components = [simd.splat(T::zero()); D];
    take_columns(simd, cast_slice(vectors), &mut components);
    components
}

/// Loads the components of the vectors of a pack.
#[inline(always)]
pub fn components<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    vectors: &Vectors<T, D>,
) -> [M::Eight; D] {
    let mut components = [simd.splat(T::zero()); D];
    for i in 0..D {
        components[i] = simd.eight(&vectors.0[i]);
    }
    components
}

/// Computes the components of the positions X + d of a pack; of X if nothing `moves`.
#[inline(always)]
pub fn positions<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    reference: &[Vector<T, D>; PACK],
    displacement: &Vectors<T, D>,
    moves: bool,
) -> [M::Eight; D] {
    let mut positions = turned(simd, reference);
    if moves {
        let apart = components(simd, displacement);
        for a in 0..D {
            positions[a] = simd.plus(positions[a], apart[a]);
        }
    }
    positions
}

/// Stores components in the vectors of a pack.
#[inline(always)]
pub fn set_components<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    vectors: &mut Vectors<T, D>,
    components: [M::Eight; D],
) {
    for i in 0..D {
        vectors.0[i] = simd.numbers(components[i]);
    }
}

/// Stores components as vectors of numbers, for rare cases, which are handled in functions that are not inlined.
#[inline(always)]
pub fn vectors<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    components: [M::Eight; D],
) -> Vectors<T, D> {
    let mut vectors = Vectors([[T::zero(); PACK]; D]);
    set_components(simd, &mut vectors, components);
    vectors
}

/// Loads the matrices of a pack, column by column.
#[inline(always)]
pub fn columns<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    matrices: &Matrices<T, D>,
) -> [[M::Eight; D]; D] {
    let mut columns = [[simd.splat(T::zero()); D]; D];
    for j in 0..D {
        for i in 0..D {
            columns[j][i] = simd.eight(&matrices.0[j][i]);
        }
    }
    columns
}

/// Stores columns in the matrices of a pack.
#[inline(always)]
pub fn set_columns<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    matrices: &mut Matrices<T, D>,
    columns: [[M::Eight; D]; D],
) {
    for j in 0..D {
        for i in 0..D {
            matrices.0[j][i] = simd.numbers(columns[j][i]);
        }
    }
}

/// Multiplies each matrix with these columns by its own number.
#[inline(always)]
pub fn scaled<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    mut columns: [[M::Eight; D]; D],
    factor: M::Eight,
) -> [[M::Eight; D]; D] {
    for j in 0..D {
        for i in 0..D {
            columns[j][i] = simd.times(columns[j][i], factor);
        }
    }
    columns
}

/// The determinants of matrices with these columns; D = 1, 2, 3.
#[inline(always)]
pub fn determinants<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    columns: &[[M::Eight; D]; D],
) -> M::Eight {
    dot(simd, &columns[0], &cofactors(simd, columns)[0])
}

/// The columns of the cofactor matrices, J F^-T for F; D = 1, 2, 3.
#[inline(always)]
pub fn cofactors<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    columns: &[[M::Eight; D]; D],
) -> [[M::Eight; D]; D] {
    const { assert!(D >= 1 && D <= 3, "one to three dimensions") };
    let mut cofactors = [[simd.splat(T::one()); D]; D];
    let f = |i: usize, j: usize| columns[j % D][i % D];
    for j in 0..D {
        for i in 0..D {
            if D == 2 {
                let other = f(i + 1, j + 1);
                let negative = simd.minus(simd.splat(T::zero()), other);
                cofactors[j][i] = if i == j { other } else { negative };
            }
            if D == 3 {
                let product = simd.times(f(i + 2, j + 1), f(i + 1, j + 2));
                let other = simd.times(f(i + 1, j + 1), f(i + 2, j + 2));
                cofactors[j][i] = simd.minus(other, product);
            }
        }
    }
    cofactors
}

/// a . b.
#[inline(always)]
fn dot<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    a: &[M::Eight; D],
    b: &[M::Eight; D],
) -> M::Eight {
    let mut sum = simd.times(a[0], b[0]);
    for i in 1..D {
        sum = simd.times_plus(a[i], b[i], sum);
    }
    sum
}

/// The maximum of iterations that find a rotation; each doubles the digits.
const POLAR_ITERATIONS: usize = 20;

/// The diagonals of the right stretch tensors U of F = R U with these columns; not finite where an F is singular or
/// not finite.
///
/// U^2 = C = F^T F. If every C is diagonal up to entries of the order e, U_aa is sqrt(C_aa) up to e^2. If e^2 is less than
/// round-off, that is used: the stretches of eight diagonal F are exact. Otherwise R is the limit of (R + R^-T)/2 from R = F
/// (Higham, "Computing the polar decomposition, with applications", SIAM J. Sci. Stat. Comput. 7 (1986)).
#[inline(always)]
pub fn stretches<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    f: &[[M::Eight; D]; D],
) -> [M::Eight; D] {
    let round_off = simd.splat(T::default_epsilon());
    let mut stretches = [simd.splat(T::zero()); D];
    let mut straight = true;
    for a in 0..D {
        stretches[a] = dot(simd, &f[a], &f[a]);
        for b in 0..a {
            let aside = dot(simd, &f[a], &f[b]);
            let squares = simd.times(stretches[a], stretches[b]);
            let aside = simd.times(aside, aside);
            straight &= simd.all_at_most(aside, simd.times(round_off, squares));
        }
    }
    if straight {
        for a in 0..D {
            stretches[a] = simd.root(stretches[a]);
        }
        return stretches;
    }
    let mut rotation = *f;
    for _ in 0..POLAR_ITERATIONS {
        let inverse = cofactors(simd, &rotation);
        let twice = dot(simd, &rotation[0], &inverse[0]);
        let half = simd.splat(T::ratio(1, 2));
        let per_twice = simd.over(half, twice);
        let mut change = simd.splat(T::zero());
        for j in 0..D {
            for i in 0..D {
                let next = simd.times(half, rotation[j][i]);
                let next = simd.times_plus(inverse[j][i], per_twice, next);
                let apart = simd.minus(next, rotation[j][i]);
                change = simd.greatest(change, simd.times(apart, apart));
                rotation[j][i] = next;
            }
        }
        // The remaining error is the square of the change.
        if simd.all_at_most(change, round_off) {
            break;
        }
    }
    for a in 0..D {
        stretches[a] = dot(simd, &rotation[a], &f[a]);
    }
    stretches
}

#[cfg(test)]
mod tests {
    use mms_math::simd::Plain;

    use super::{columns, stretches};
    use crate::column::{Matrices, Pack as _};
    use crate::real::{Matrix, Vector};
    use crate::tensor::deformation_gradient;

    fn stretch<const D: usize>(f: &Matrix<f64, D>) -> Vector<f64, D> {
        let found = stretches::<f64, _, D>(Plain, &columns(Plain, &Matrices::alike(f)));
        Vector::from_fn(|a, _| found[a][0])
    }

    #[test]
    fn stretches_are_roots() {
        // U by the iteration of Denman and Beavers (1976), for all sizes of the entries off the diagonal.
        for aside in [1.0, 1e-3, 1e-7, 1e-9, 1e-20] {
            let h = Matrix::<f64, 3>::new(0.2, 1.5, -0.3, -0.9, 0.4, 0.1, 0.2, 0.0, -0.2);
            let h = h.map_with_location(|i, j, value| if i == j { value } else { value * aside });
            let f = deformation_gradient(&h);
            let (mut u, mut inverse) = (f.tr_mul(&f), Matrix::<f64, 3>::identity());
            for _ in 0..20 {
                let [next, other] = [inverse, u].map(|m| m.try_inverse().unwrap());
                (u, inverse) = ((u + next) * 0.5, (inverse + other) * 0.5);
            }
            let found = stretch(&f);
            assert!((found - u.diagonal()).amax() < 4e-15, "{aside}: {found}");
            // F/1024 has the stretches of F over 1024.
            let smaller = stretch(&(f / 1024.0)) * 1024.0;
            assert!((smaller - found).amax() < 4e-15, "{aside}: {smaller}");
        }
        let sheared = Matrix::<f64, 2>::new(1.5, 0.25, 0.0, 0.5);
        // U = (C + J)/sqrt(tr C + 2 J) in the plane.
        let c = sheared.tr_mul(&sheared);
        let root = (c.trace() + 2.0 * 0.75).sqrt();
        let exact = c.diagonal().map(|square| (square + 0.75) / root);
        assert!((stretch(&sheared) - exact).amax() < 4e-16);
        // Half a turn stretches nothing.
        let turned = Matrix::from_diagonal(&Vector::<f64, 3>::new(-1.0, -1.0, 1.0));
        assert_eq!(stretch(&turned), Vector::<f64, 3>::repeat(1.0));
        assert_eq!(stretch(&Matrix::<f64, 1>::new(0.3)), Vector::<f64, 1>::new(0.3));
        assert!(!stretch(&Matrix::<f64, 2>::repeat(1.0)).amax().is_finite());
        assert!(!stretch(&Matrix::<f64, 2>::repeat(f64::NAN))[0].is_finite());
    }
}
