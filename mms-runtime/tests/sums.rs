//! The sums between the particles of a pack and their nodes, which are factorised and may be computed together, against their
//! definitions, particle by particle and node by node; with every instruction set of the processor.

use crate::common::weights::{CELLS, Particle, lattice};
use mms_runtime::column::{HALF, PACK};
use mms_runtime::math::dispatch::{Work, best};
use mms_runtime::math::simd::{Plain, Simd};
use mms_runtime::nodal::{Nodal, Window};
use mms_runtime::shape::{Shape, ShapeVisitor};
use mms_runtime::stencil::{ALL, Gathered, Members, Payload, Stencil, Wanted};
use mms_runtime::{Lattice, Real, ShapeName, Vector};
use proptest::prelude::*;

/// The number of vectors that a particle adds: a value, and vectors for slopes and for moments along up to three axes.
const EACH: usize = 1 + 2 * 3;

/// Arbitrary numbers, all different.
fn numbers<T: Real>(count: usize) -> Vec<Nodal<T>> {
    let number = |index: usize| T::of((1.7 * index as f64 + 0.3).sin());
    (0..count).map(|node| Nodal(std::array::from_fn(|k| number(4 * node + k)))).collect()
}

/// The sums of a pack.
#[derive(Clone, Copy)]
struct Sums<'a, T, const D: usize, S> {
    stencil: &'a S,
    lattice: &'a Lattice<T, D>,
    nodes: &'a [Nodal<T>],
    /// For each particle a value, then the slopes and the moments along the axes.
    carried: &'a [Nodal<T>],
    members: Members,
}

impl<T: Real, const D: usize, S: Stencil<T, D>> Sums<'_, T, D, S> {
    /// Computes the sums of nodes for every particle, and the sums to nodes: of values, with slopes, with moments, and with
    /// both. Then computes the slopes of the linear functions nearest to the nodes. `wanted` is not a constant, so that sums
    /// are compiled once.
    fn by<M: Simd<T>>(&self, simd: M) -> [Vec<T>; 2] {
        let Self { stencil, lattice, nodes, carried, members } = *self;
        let (mut all, mut nearest) = (Vec::new(), Vec::new());
        for wanted in [Wanted::Value, Wanted::Gradient, Wanted::Slopes] {
            let Gathered { value, gradient, slopes } = stencil.gather(simd, lattice, wanted, nodes);
            let (found, vectors) = match wanted {
                Wanted::Value => (&mut all, vec![value]),
                Wanted::Gradient => (&mut all, [&[value], &gradient[..]].concat()),
                Wanted::Slopes => (&mut nearest, slopes.to_vec()),
            };
            found.extend(vectors.iter().flatten().flat_map(|&eight| simd.numbers(eight)));
        }
        let value = std::array::from_fn(|p| {
            simd.halves(&carried[EACH * p].0, &carried[EACH * (p + HALF)].0)
        });
        let vectors = |first: usize| {
            let number = |a: usize, c: usize, p: usize| carried[EACH * p + first + a].0[c];
            let eight = |a, c| simd.eight(&std::array::from_fn(|p| number(a, c, p)));
            Some(std::array::from_fn(|a| std::array::from_fn(|c| eight(a, c))))
        };
        let mut sums: [Vec<_>; 4] = std::array::from_fn(|_| nodes.to_vec());
        for (which, nodes) in sums.iter_mut().enumerate() {
            let slopes = if which & 1 != 0 { vectors(1) } else { None };
            let moments = if which & 2 != 0 { vectors(1 + D) } else { None };
            let carried = Payload { value, slopes, moments };
            stencil.scatter(simd, lattice, &carried, members, Window { start: 0, nodes });
        }
        all.extend(sums.iter().flatten().flat_map(|node| node.0));
        [all, nearest]
    }

    /// Computes the sums by their definitions.
    fn by_definition(&self, positions: &[Vector<T, D>; PACK]) -> Vec<T> {
        let Self { stencil, lattice, nodes, carried, members } = *self;
        let mut gathered = vec![[[T::zero(); PACK]; D]; 1 + D];
        let mut sums: [Vec<_>; 4] = std::array::from_fn(|_| nodes.to_vec());
        for p in 0..PACK {
            stencil.each(p, |i, w, gradient| {
                for c in 0..D {
                    gathered[0][c][p] += nodes[i].0[c] * w;
                    for a in 0..D {
                        gathered[1 + a][c][p] += nodes[i].0[c] * gradient[a];
                    }
                }
                if !(members[0]..members[1]).contains(&p) {
                    return;
                }
                let carried = |k: usize| carried[EACH * p + k];
                let vector = |k: usize| Nodal::new(&carried(k).vector::<D>(), T::zero());
                let apart = lattice.position(i) - positions[p];
                for sum in &mut sums {
                    sum[i] += carried(0) * w;
                }
                for a in 0..D {
                    let sloping = vector(1 + a) * gradient[a];
                    let moment = vector(1 + D + a) * (w * apart[a]);
                    sums[1][i] += sloping;
                    sums[2][i] += moment;
                    sums[3][i] += sloping + moment;
                }
            });
        }
        let values = gathered[0].iter().flatten();
        let gathered = values.chain(gathered.iter().flatten().flatten());
        gathered.copied().chain(sums.iter().flatten().flat_map(|node| node.0)).collect()
    }
}

impl<T: Real, const D: usize, S: Stencil<T, D>> Work<T> for &Sums<'_, T, D, S> {
    type Output = [Vec<T>; 2];

    fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
        self.by(simd)
    }
}

/// The distances of the particles of a pack along each axis, in cells. All share their nodes; the particles of each half do
/// (almost always); the particles of one half do; or none do.
const APART: [[f64; PACK]; 5] = [
    [0.0; PACK],
    [0.0, 0.02, 0.01, 0.03, 0.02, 0.0, 0.01, 0.03],
    [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
    [0.0, 1e-3, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [0.4, 0.0, 1.7, 0.0, 1.7, 0.4, 1.0, 0.4],
];

/// A particle, for every shape function.
struct Check<T, const D: usize> {
    particle: Particle<D>,
    ends: [i64; 2],
    precision: std::marker::PhantomData<T>,
}

impl<T: Real, const D: usize> ShapeVisitor for Check<T, D> {
    type Output = ();

    fn visit<S: Shape>(self) {
        let lattice = lattice::<T, D, S>([self.ends; D]);
        let name = std::any::type_name::<S>();
        // Domains may be narrow, and gradients then are large differences of small numbers.
        let tolerance = T::default_epsilon() * T::of(2e4);
        let close = |found: &[T], expected: &[T]| {
            assert_eq!(found.len(), expected.len());
            for (a, b) in found.iter().zip(expected) {
                let difference = (*a - *b).abs();
                assert!(difference <= tolerance * (T::one() + b.abs()), "{name}: {a}, not {b}");
            }
        };

        for (apart, members) in APART.into_iter().zip([ALL, ALL, ALL, [0, 6], [1, 7]]) {
            let (stencil, positions) = self.particle.pack::<T, S>(&lattice, apart).unwrap();
            let (nodes, carried) = (&numbers(lattice.len())[..], &numbers(EACH * PACK)[..]);
            let sums = Sums { stencil: &stencil, lattice: &lattice, nodes, carried, members };
            let expected = sums.by_definition(&positions);
            for [found, _] in [sums.on(T::PlainSimd::from(Plain)), best(&sums)] {
                close(&found, &expected);
            }

            // q_i = x_i, whose slopes are 1. Hat functions are skipped: at a node their slopes are quotients of numbers that
            // vanish.
            if S::DEGREE == 1 {
                continue;
            }
            let place = |node: usize| Nodal::new(&lattice.position(node), T::zero());
            let places: Vec<_> = (0..lattice.len()).map(place).collect();
            let sums = Sums { nodes: &places, ..sums };
            let diagonal = |k: usize| (k / PACK).is_multiple_of(D + 1);
            let unit = |k: usize| if diagonal(k) { T::one() } else { T::zero() };
            let expected: Vec<T> = (0..PACK * D * D).map(unit).collect();
            for [_, found] in [sums.on(T::PlainSimd::from(Plain)), best(&sums)] {
                close(&found, &expected);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: crate::sampled::sampled_count(48, 4) as u32,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn sums_are_those_of_their_definitions(
        // Other particles of the pack are up to 1.7 further.
        cells in prop::array::uniform3(3.1..7.2f64),
        half in prop::array::uniform3(0.1..0.7f64),
        h in prop::array::uniform9(-0.1..0.1f64),
        ended in any::<bool>(),
    ) {
        let ends = if ended { [3, 9] } else { [0, CELLS as i64] };
        for shape in ShapeName::ALL {
            check::<f64, 1>(*shape, cells, half, h, ends);
            check::<f64, 2>(*shape, cells, half, h, ends);
            check::<f64, 3>(*shape, cells, half, h, ends);
            check::<f32, 3>(*shape, cells, half, h, ends);
        }
    }
}

fn check<T: Real, const D: usize>(
    shape: ShapeName,
    cells: [f64; 3],
    half: [f64; 3],
    h: [f64; 9],
    ends: [i64; 2],
) {
    let particle = Particle::<D>::new(cells, half, h, false);
    shape.visit(Check::<T, D> { particle, ends, precision: std::marker::PhantomData });
}
