//! What the machine does at best, measured beside the cases: multiply-adds, and bytes in place.

use std::fmt;
use std::hint::black_box;
use std::time::Instant;

use mms_runtime::Real;
use mms_runtime::math::batch::Stand;
use mms_runtime::math::dispatch::{Work, wide};
use mms_runtime::math::machine::{Fused, Plain};

/// Chains of multiply-adds that do not wait for each other, numbers in each of them, and how often.
const CHAINS: [usize; 3] = [8, 16, 20_000];

/// Bytes that are read and written in place; more than any cache holds.
const STREAMED: usize = 1 << 27;

/// Keeps the thread on one processor; without that, times are what they are.
pub fn pin() {
    if let Some(core) = core_affinity::get_core_ids().and_then(|cores| cores.into_iter().last()) {
        core_affinity::set_for_current(core);
    }
}

/// The multiply-adds of a particle in a step: those of the sums over its nodes, factorised axis by axis.
#[derive(Clone, Copy)]
pub struct Count(usize);

impl Count {
    /// FLIP with `width` nodes along each of `axes`: mass, momentum and acceleration without slopes, forces
    /// and velocity with them.
    pub fn flip(axes: usize, width: usize) -> Self {
        Count(
            values(axes, width, axes + 1)
                + values(axes, width, axes)
                + 2 * slopes(axes, width, axes),
        )
    }

    /// APIC: all sums with slopes, and those of the velocity twice.
    pub fn apic(axes: usize, width: usize) -> Self {
        Count(slopes(axes, width, axes + 1) + 3 * slopes(axes, width, axes))
    }
}

/// Of the sum of so many numbers: one for every node, row and plane.
fn values(axes: usize, width: usize, numbers: usize) -> usize {
    numbers * (1..=axes as u32).map(|power| width.pow(power)).sum::<usize>()
}

/// Likewise with their slopes along every axis: 2 for every node, 3 for every row, 4 for every plane.
fn slopes(axes: usize, width: usize, numbers: usize) -> usize {
    let of = |power: u32| (axes as u32 - power + 2) as usize * width.pow(power);
    numbers * (1..=axes as u32).map(of).sum::<usize>()
}

/// The best that was seen of the machine in one precision.
pub struct Roof {
    pub precision: &'static str,
    turn: fn() -> [f64; 2],
    /// Multiply-adds, and bytes read and written, in a nanosecond.
    best: [f64; 2],
}

impl Roof {
    pub fn of<T: Real>(precision: &'static str) -> Self {
        Self { precision, turn: turn::<T>, best: [0.0; 2] }
    }

    /// One more round.
    pub fn round(&mut self) {
        let seen = (self.turn)();
        self.best = std::array::from_fn(|k| self.best[k].max(seen[k]));
    }

    /// What a particle's multiply-adds take alone.
    pub fn nanoseconds(&self, count: Count) -> f64 {
        count.0 as f64 / self.best[0]
    }

    pub fn document(&self) -> serde_json::Value {
        serde_json::json!({
            "precision": self.precision,
            "multiply_adds_per_ns": self.best[0],
            "bytes_in_place_per_ns": self.best[1],
        })
    }
}

impl fmt::Display for Roof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [adds, bytes] = self.best;
        write!(f, "{}: {adds:.1} multiply-adds and {bytes:.1} bytes in place a ns", self.precision)
    }
}

fn turn<T: Real>() -> [f64; 2] {
    let start = Instant::now();
    black_box(wide(Chains::<T>(T::of(black_box(0.999)))));
    let adds = (CHAINS[0] * CHAINS[1] * CHAINS[2]) as f64 / (1e9 * start.elapsed().as_secs_f64());

    let mut numbers = vec![T::one(); STREAMED / size_of::<T>()];
    let start = Instant::now();
    let factor = T::of(black_box(0.999));
    black_box(&mut numbers).iter_mut().for_each(|number| *number *= factor);
    let seconds = start.elapsed().as_secs_f64();
    black_box(&numbers);
    [adds, 2.0 * STREAMED as f64 / (1e9 * seconds)]
}

struct Chains<T>(T);

impl<T: Real> Work for Chains<T> {
    type Output = T;

    #[inline(always)]
    fn fused(self, _: Fused) -> T {
        self.add::<T::Fused>()
    }

    #[inline(always)]
    fn plain(self, _: Plain) -> T {
        self.add::<T::Plain>()
    }
}

impl<T: Real> Chains<T> {
    #[inline(always)]
    fn add<S: Stand<T>>(self) -> T {
        let x: S = S::standing_for(self.0);
        let mut chains = [[x; CHAINS[1]]; CHAINS[0]];
        for _ in 0..CHAINS[2] {
            for chain in &mut chains {
                *chain = chain.map(|value| value.mul_add(x, x));
            }
        }
        let all = chains.iter().flatten().map(|value| value.value());
        all.fold(T::zero(), |sum, value| sum + value)
    }
}
