//! The sums between a particle and its nodes, which are factorised, against their definitions, node by node;
//! with every machine of the processor.

mod common;

use common::weights::{CELLS, Particle, lattice};
use mms_runtime::math::dispatch::{Work, narrow};
use mms_runtime::math::machine::{Fused, Machine, Plain};
use mms_runtime::nodal::{Nodal, Window};
use mms_runtime::shape::{Shape, ShapeVisitor};
use mms_runtime::stencil::Stencil;
use mms_runtime::{Lattice, Real, ShapeName, Vector};
use proptest::prelude::*;

/// Any numbers, no two alike.
fn numbers<T: Real>(count: usize) -> Vec<Nodal<T>> {
    let number = |index: usize| T::of((1.7 * index as f64 + 0.3).sin());
    (0..count).map(|node| Nodal(std::array::from_fn(|k| number(4 * node + k)))).collect()
}

/// The four numbers of a vector, times another number.
struct Sums<'a, T, const D: usize, S> {
    stencil: &'a S,
    lattice: &'a Lattice<T, D>,
    nodes: &'a [Nodal<T>],
}

impl<T: Real, const D: usize, S: Stencil<T, D>> Sums<'_, T, D, S> {
    /// What every sum gives: of nodes, to nodes without and with slopes, and with moments; and the slopes.
    fn by<M: Machine<T>>(&self, machine: M) -> Vec<Nodal<T>> {
        let Self { stencil, lattice, nodes } = self;
        let node = |four: M::Four| Nodal(machine.numbers(four));
        let mut all = vec![node(stencil.collect_value(machine, nodes))];
        let (value, slopes) = stencil.collect(machine, nodes);
        all.push(node(value));
        all.extend(slopes.map(node));
        let (values, slopes) = stencil.collect_both(machine, [&nodes[1..], nodes]);
        all.extend(values.map(node));
        all.extend(slopes.map(node));
        all.extend(stencil.collect_slopes(machine, lattice, nodes).map(node));
        let [value, slopes @ ..] = [0, 1, 2, 3].map(|k| machine.four(&nodes[k].0));
        let slopes: [M::Four; D] = std::array::from_fn(|a| slopes[a]);
        let mut sums: [Vec<_>; 5] = std::array::from_fn(|_| nodes.to_vec());
        let [a, b, c, d, e] = sums.each_mut().map(|nodes| Window { start: 0, nodes });
        stencil.spread_value(machine, value, a);
        stencil.spread(machine, value, slopes, b);
        stencil.spread_moments(machine, lattice, value, slopes, c);
        stencil.spread_both(machine, [slopes[0], value], slopes, [d, e]);
        all.extend(sums.into_iter().flatten());
        all
    }

    /// The same by their definitions, but for the slopes, of which only those of linear functions are known.
    fn by_definition(&self, position: &Vector<T, D>) -> Vec<Nodal<T>> {
        let Self { stencil, lattice, nodes } = self;
        let (mut shifted, mut collected) = (Nodal::zero(), vec![Nodal::zero(); 1 + D]);
        let mut sums: [Vec<_>; 4] = std::array::from_fn(|_| nodes.to_vec());
        stencil.each(|i, w, gradient| {
            let apart = lattice.position(i) - position;
            collected[0] += nodes[i] * w;
            shifted += nodes[i + 1] * w;
            for sum in &mut sums[..3] {
                sum[i] += nodes[0] * w;
            }
            sums[3][i] += nodes[1] * w;
            for a in 0..D {
                collected[1 + a] += nodes[i] * gradient[a];
                sums[1][i] += nodes[1 + a] * gradient[a];
                sums[2][i] += nodes[1 + a] * (w * apart[a]);
            }
        });
        let [values, slopes, moments, others] = sums;
        let mut all = vec![collected[0]];
        all.extend(&collected);
        all.push(shifted);
        all.extend(&collected);
        all.extend([values, slopes.clone(), moments, others, slopes].into_iter().flatten());
        all
    }
}

impl<T: Real, const D: usize, S: Stencil<T, D>> Work for &Sums<'_, T, D, S> {
    type Output = Vec<Nodal<T>>;

    fn fused(self, machine: Fused) -> Self::Output {
        self.by(T::FusedMachine::from(machine))
    }

    fn plain(self, machine: Plain) -> Self::Output {
        self.by(T::PlainMachine::from(machine))
    }
}

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
        let position = self.particle.position(&lattice);
        let stencil = self.particle.stencil::<T, S>(&lattice).unwrap();
        let name = std::any::type_name::<S>();
        // Domains may be narrow, and gradients then large differences of small numbers.
        let tolerance = T::default_epsilon() * T::of(2e4);
        let close = |found: &Nodal<T>, expected: &Nodal<T>| {
            for (a, b) in found.0.iter().zip(&expected.0) {
                let difference = (*a - *b).abs();
                assert!(difference <= tolerance * (T::one() + b.abs()), "{name}: {a}, not {b}");
            }
        };

        let nodes = numbers(lattice.len());
        let sums = Sums { stencil: &stencil, lattice: &lattice, nodes: &nodes };
        let mut expected = sums.by_definition(&position);
        for mut found in [sums.by(T::PlainMachine::from(Plain)), narrow(&sums)] {
            found.drain(4 + 2 * D..4 + 3 * D);
            assert_eq!(found.len(), expected.len());
            found.iter().zip(&expected).for_each(|(found, expected)| close(found, expected));
        }

        // q_i = x_i, of which the slopes are 1. Of hat functions nobody asks for them: at a node they are
        // quotients of numbers that vanish.
        if S::DEGREE == 1 {
            return;
        }
        let place = |node: usize| Nodal::new(&lattice.position(node), T::zero());
        let places: Vec<_> = (0..lattice.len()).map(place).collect();
        let sums = Sums { stencil: &stencil, lattice: &lattice, nodes: &places };
        expected.truncate(0);
        expected.extend((0..D).map(|a| {
            Nodal::new(
                &Vector::<T, D>::from_fn(|b, _| T::of(f64::from(u8::from(a == b)))),
                T::zero(),
            )
        }));
        for found in [sums.by(T::PlainMachine::from(Plain)), narrow(&sums)] {
            let slopes = found[4 + 2 * D..4 + 3 * D].iter();
            slopes.zip(&expected).for_each(|(found, expected)| close(found, expected));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn sums_are_those_of_their_definitions(
        cells in prop::array::uniform3(3.1..8.9f64),
        half in prop::array::uniform3(0.1..0.7f64),
        h in prop::array::uniform9(-0.1..0.1f64),
        ended in any::<bool>(),
    ) {
        let ends = if ended { [3, 9] } else { [0, CELLS as i64] };
        for shape in ShapeName::ALL {
            check::<f64, 1>(*shape, cells, half, h, ends);
            check::<f64, 2>(*shape, cells, half, h, ends);
            check::<f64, 3>(*shape, cells, half, h, ends);
            check::<f32, 2>(*shape, cells, half, h, ends);
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
