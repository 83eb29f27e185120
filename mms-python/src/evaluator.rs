//! One output at many points, by several threads.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::thread;

use mms_mechanics::{Output, Program};
use mms_program::block::{
    BlockMode, BlockPlan, Blockwise, Inputs, Outputs, PointCache, Prepared, Scratch, ScratchPool,
};
use mms_symbolic::expr::Symbol;
use numpy::Element;

/// The least number of points that several threads share.
const MANY: usize = 1 << 14;

/// The number of points that are checked, evaluated, and checked again while they are in the cache.
const SHARE: usize = 1 << 10;

/// The precision of an array.
pub trait Precision: Blockwise + Element {
    /// The nearest number.
    fn near(number: f64) -> Self;
    /// Whether the number is finite.
    fn is_finite(self) -> bool;
}

macro_rules! precisions {
    ($($float:ident)*) => {
        $(impl Precision for $float {
            fn near(number: f64) -> Self {
                number as $float
            }

            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
        })*
    };
}

precisions!(f32 f64);

/// An output of a field for one set of parameters.
pub struct Evaluator<T: Blockwise> {
    prepared: Prepared<T>,
    pool: ScratchPool<T>,
    /// The number of components of a result.
    components: usize,
}

/// Points, one after the other: coordinates X, and the further inputs of the output.
#[derive(Clone, Copy)]
pub struct Places<'a, T> {
    /// The number of points.
    pub count: usize,
    /// The coordinates of a point.
    pub dimension: usize,
    /// X; empty if the output does not need it.
    pub points: &'a [T],
    /// Unit normals N; empty if the output does not need them.
    pub normals: &'a [T],
    /// Displacement gradients H, row by row; empty if the output does not need them.
    pub gradients: &'a [T],
    /// The rows of H.
    pub rows: usize,
}

impl<'a, T> Places<'a, T> {
    fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.count);
        let cut = |numbers: &'a [T], each: usize| numbers.split_at(numbers.len().min(count * each));
        let points = cut(self.points, self.dimension);
        let normals = cut(self.normals, self.dimension);
        let gradients = cut(self.gradients, self.rows * self.rows);
        let of = |count, points, normals, gradients| Places {
            count,
            points,
            normals,
            gradients,
            ..self
        };
        let first = of(count, points.0, normals.0, gradients.0);
        (first, of(self.count - count, points.1, normals.1, gradients.1))
    }
}

/// A number that is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NonFinite {
    /// The position of its point.
    pub index: usize,
    /// Whether the number is an input, and not a result.
    pub is_input: bool,
}

impl<T: Precision> Evaluator<T> {
    /// Creates an evaluator, and computes the stage Parameter.
    pub fn new(program: &Program, output: Output, components: usize, parameters: &[T]) -> Self {
        let plan = Arc::new(BlockPlan::new(program, &[output], Output::is_quantity));
        let prepared = Prepared::new(plan, BlockMode::portable(), parameters);
        Evaluator { prepared, pool: ScratchPool::default(), components }
    }

    /// The number of components of a result.
    pub fn components(&self) -> usize {
        self.components
    }

    /// Fills `values`; the error is the place of a number that is not finite.
    pub fn fill(&self, time: T, places: Places<'_, T>, values: &mut [T]) -> Result<(), NonFinite> {
        let count = places.count;
        if count < MANY {
            return self.pool.with(|scratch| self.evaluate_chunk(scratch, time, places, values));
        }
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let each = count.div_ceil(threads).next_multiple_of(SHARE);
        thread::scope(|scope| {
            let (mut places, mut values, mut spawned) = (places, values, Vec::new());
            while places.count > 0 {
                let (own, others) = places.split_at(each);
                let (scratch, rest) = values.split_at_mut(own.count * self.components);
                (places, values) = (others, rest);
                let work = move || self.pool.with(|it| self.evaluate_chunk(it, time, own, scratch));
                spawned.push(scope.spawn(work));
            }
            let found = spawned.into_iter().enumerate().try_for_each(|(at, thread)| {
                match thread.join().expect("a panic is passed on") {
                    Ok(()) => ControlFlow::Continue(()),
                    Err(number) => {
                        ControlFlow::Break(NonFinite { index: at * each + number.index, ..number })
                    }
                }
            });
            found.break_value().map_or(Ok(()), Err)
        })
    }

    /// Evaluates on this thread.
    fn evaluate_chunk(
        &self,
        scratch: &mut Scratch<T>,
        time: T,
        mut places: Places<'_, T>,
        mut values: &mut [T],
    ) -> Result<(), NonFinite> {
        let mut start = 0;
        while places.count > 0 {
            let (own, others) = places.split_at(SHARE);
            let count = own.count;
            let given = [(own.points, own.dimension), (own.gradients, own.rows * own.rows)];
            for (numbers, each) in given {
                if let Some(at) = first_odd(numbers) {
                    return Err(NonFinite { index: start + at / each, is_input: true });
                }
            }
            let (found, rest) = values.split_at_mut(count * self.components);
            self.evaluate(scratch, time, own, found);
            if let Some(at) = first_odd(found) {
                return Err(NonFinite { index: start + at / self.components, is_input: false });
            }
            (places, values, start) = (others, rest, start + count);
        }
        Ok(())
    }

    fn evaluate(&self, scratch: &mut Scratch<T>, time: T, places: Places<'_, T>, values: &mut [T]) {
        let Places { count, dimension, points, normals, gradients, rows } = places;
        if gradients.is_empty() {
            return self.prepared.at_points(scratch, time, dimension, [points, normals], values);
        }
        let mut write_inputs = |start: usize, inputs: &mut Inputs<'_, T>| {
            for (symbol, column) in inputs.columns() {
                let (numbers, each, at) = match symbol {
                    Symbol::Coordinate(axis) => (points, dimension, axis),
                    Symbol::Gradient(row, axis) => (gradients, rows * rows, row * rows + axis),
                    _ => unreachable!("a response takes positions and gradients"),
                };
                let numbers = numbers[start * each + at..].iter().step_by(each);
                column.iter_mut().zip(numbers).for_each(|(to, number)| *to = *number);
            }
        };
        let components = self.components;
        let mut read_outputs = |start: usize, outputs: &Outputs<'_, T>| {
            let own = &mut values[start * components..][..outputs.count() * components];
            for (index, component) in outputs.components(0).enumerate() {
                component.write(own[index..].iter_mut().step_by(components));
            }
        };
        self.prepared.run(scratch, time, count, &mut write_inputs, &mut read_outputs);
    }
}

/// The numbers of an output that X alone determines, share by share.
pub struct KeptPoints<T: Blockwise>(Vec<PointCache<T>>);

impl<T: Precision> Evaluator<T> {
    /// Stores the values that X determines at points, for [`fill_kept`](Self::fill_kept); the error is the place of a
    /// coordinate that is not finite.
    pub fn keep(&self, dimension: usize, points: &[T]) -> Result<KeptPoints<T>, NonFinite> {
        if let Some(at) = first_odd(points) {
            return Err(NonFinite { index: at / dimension, is_input: true });
        }
        let shares = points.chunks(SHARE * dimension);
        let keep = |scratch: &mut Scratch<T>| {
            shares.map(|it| self.prepared.keep(scratch, dimension, it)).collect()
        };
        Ok(KeptPoints(self.pool.with(keep)))
    }

    /// Fills `values` at the points from `first` on, which is the first of a share; the error is the place of a number that is
    /// not finite.
    pub fn fill_kept(
        &self,
        time: T,
        (dimension, points, kept): (usize, &[T], &KeptPoints<T>),
        first: usize,
        values: &mut [T],
    ) -> Result<(), NonFinite> {
        let count = values.len() / self.components.max(1);
        let threads = match count < MANY {
            true => 1,
            false => thread::available_parallelism().map_or(1, usize::from),
        };
        let each = count.div_ceil(threads).next_multiple_of(SHARE);
        let work = |start: usize, values: &mut [T]| {
            self.pool.with(|scratch| {
                for (at, values) in values.chunks_mut(SHARE * self.components).enumerate() {
                    let start = start + at * SHARE;
                    let end = start + values.len() / self.components;
                    let points = &points[start * dimension..end * dimension];
                    let of = (dimension, points, &kept.0[start / SHARE]);
                    self.prepared.at_kept(scratch, time, of, values);
                    if let Some(at) = first_odd(values) {
                        let index = start + at / self.components;
                        return Err(NonFinite { index, is_input: false });
                    }
                }
                Ok(())
            })
        };
        if threads == 1 {
            return work(first, values);
        }
        thread::scope(|scope| {
            let shares = values.chunks_mut(each * self.components).enumerate();
            let spawned: Vec<_> = shares
                .map(|(at, values)| scope.spawn(move || work(first + at * each, values)))
                .collect();
            let joined = spawned.into_iter().map(|it| it.join().expect("a panic is passed on"));
            joined.collect::<Vec<_>>().into_iter().collect()
        })
    }
}

/// The position of the first number that is not finite. Tests all numbers first, without a branch for each.
fn first_odd<T: Precision>(numbers: &[T]) -> Option<usize> {
    match numbers.iter().fold(true, |all, number| all & number.is_finite()) {
        true => None,
        false => numbers.iter().position(|number| !number.is_finite()),
    }
}
