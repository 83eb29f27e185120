//! The best rates of the machine, measured beside the cases: multiply-adds, and bytes updated in place.

use std::fmt;
use std::hint::black_box;
use std::sync::OnceLock;

use core_affinity::CoreId;
use cpu_time::ThreadTime;
use mms_runtime::Real;
use mms_runtime::math::dispatch::{Work, best};
use mms_runtime::math::simd::Simd;

/// The number of independent chains of multiply-adds, and the length of each.
const CHAINS: [usize; 2] = [12, 1_000_000];

/// The bytes that are read and written in place; more than fit into any cache.
const STREAMED: usize = 1 << 27;

/// Pins each thread to its own core, the last core for the first thread; without core IDs, threads are not pinned.
pub fn pin(thread: usize) {
    static CORES: OnceLock<Vec<CoreId>> = OnceLock::new();
    let cores = CORES.get_or_init(|| core_affinity::get_core_ids().unwrap_or_default());
    if let Some(core) = cores.iter().rev().nth(thread) {
        core_affinity::set_for_current(*core);
    }
}

/// The multiply-adds of a particle in a step, for sums onto and over its nodes, factorised axis by axis. Additions run
/// beside them.
#[derive(Clone, Copy)]
pub struct Count(usize);

impl Count {
    /// The count for FLIP with `width` nodes along each of `axes`: mass, momentum and acceleration without slopes, forces
    /// and velocity with slopes.
    pub fn flip(axes: usize, width: usize) -> Self {
        let momentum = (axes + 1) * onto(axes, width, 0);
        let force = axes * onto(axes, width, 1);
        Count(momentum + force + axes * (over(axes, width, 0) + over(axes, width, 1)))
    }

    /// The count for APIC: mass, momentum with force, and velocity, with slopes and moments.
    pub fn apic(axes: usize, width: usize) -> Self {
        Count((axes + 1) * onto(axes, width, 2) + axes * over(axes, width, 2))
    }
}

/// The multiply-adds of the sum of one number onto nodes, with `kinds` kinds of gradient weights: for every node one product of
/// the value and one of the gradient weight; for every row one; for every plane one, and products of the gradient weights along
/// the axes before; and the products that make the gradient weights.
fn onto(axes: usize, width: usize, kinds: usize) -> usize {
    // Of three nodes, the middle one gets the total less the outer two, without products, and so does its row of a plane.
    let outer = if width == 3 { 2 } else { width };
    let aside = kinds.min(1);
    let along = |axis: usize| {
        let products = if axis < 2 { 1 + aside * (1 - axis) } else { 1 + aside * axis * outer };
        let multiplied = if axis < 2 { outer } else { width };
        products * width.pow((axes - axis - 1) as u32) * multiplied
    };
    kinds * axes * outer + (0..axes).map(along).sum::<usize>()
}

/// The multiply-adds of the sum of one number over nodes, with `kinds` kinds of slopes along every axis: 1 for every node,
/// row and plane, and for each kind 1 more for a node, 2 for a row, 3 for a plane.
fn over(axes: usize, width: usize, kinds: usize) -> usize {
    let along = |axis: usize| (1 + kinds * (axis + 1)) * width.pow((axes - axis) as u32);
    (0..axes).map(along).sum()
}

/// The best measured rates of the machine in one precision.
pub struct Roof {
    pub precision: &'static str,
    turn: fn() -> [f64; 2],
    /// Multiply-adds, and bytes read and written, per nanosecond.
    best: [f64; 2],
}

impl Roof {
    pub fn of<T: Real>(precision: &'static str) -> Self {
        Self { precision, turn: turn::<T>, best: [0.0; 2] }
    }

    /// Measures one more round.
    pub fn round(&mut self) {
        let seen = (self.turn)();
        self.best = std::array::from_fn(|k| self.best[k].max(seen[k]));
    }

    /// The nanoseconds of a particle's multiply-adds alone.
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
        write!(
            f,
            "{}: {adds:.1} multiply-adds, eight at a time, and {bytes:.1} bytes in place a ns",
            self.precision
        )
    }
}

fn turn<T: Real>() -> [f64; 2] {
    let start = ThreadTime::now();
    black_box(best(Chains::<T>(T::of(black_box(0.999)))));
    let numbers = 8 * CHAINS[0] * CHAINS[1];
    let adds = numbers as f64 / (1e9 * start.elapsed().as_secs_f64());

    let mut numbers = vec![T::one(); STREAMED / size_of::<T>()];
    let start = ThreadTime::now();
    let factor = T::of(black_box(0.999));
    black_box(&mut numbers).iter_mut().for_each(|number| *number *= factor);
    let seconds = start.elapsed().as_secs_f64();
    black_box(&numbers);
    [adds, 2.0 * STREAMED as f64 / (1e9 * seconds)]
}

/// Chains of multiply-adds on eight numbers at a time, as in the solver's sums.
struct Chains<T>(T);

impl<T: Real> Work<T> for Chains<T> {
    type Output = [T; 8];

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) -> [T; 8] {
        let x = simd.splat(self.0);
        let mut chains = [x; CHAINS[0]];
        for _ in 0..CHAINS[1] {
            for chain in 0..CHAINS[0] {
                chains[chain] = simd.times_plus(chains[chain], x, x);
            }
        }
        let mut sum = x;
        for chain in chains {
            sum = simd.plus(sum, chain);
        }
        simd.numbers(sum)
    }
}
