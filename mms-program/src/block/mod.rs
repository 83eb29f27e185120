//! A block interpreter: runs programs over many points; every operation is a loop over a block of points (structure of arrays).
//!
//! A [`BlockPlan`] lists the steps, and is made once for some outputs; all threads, parameters and precisions share it.
//! [`Prepared`] has the values of the stage Parameter for one set of parameters. A [`Scratch`] has the values of the stage Time
//! for one time, and the registers; one thread uses it at a time. So a new parameter runs the stage Parameter, a new time runs
//! the stage Time, and nothing is allocated after the first use of a `Scratch`.
//!
//! With fused products, results have the bits of compiled loops. With rounded products, they have the bits of compiled
//! functions of one point and of the reference interpreter, on all processors. The other outputs of a plan do not change the
//! bits of an output. The reference interpreter computes one operation of one number at a time: tests compare the block
//! interpreter with it, and it serves scalars without blocks.

mod column;
mod plan;
mod steps;

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use mms_math::batch::Float;
use mms_math::dispatch::{Instructions, Work};

pub use column::{Blockwise, Column, Numbers};
pub use plan::BlockPlan;

use crate::interpret::apply;
use mms_symbolic::expr::Symbol;
use plan::{Operand, Scalar, ScalarSource};

/// The instructions that compute blocks, and whether a product is rounded before it is added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockMode {
    instructions: Instructions,
    fused: bool,
}

impl BlockMode {
    /// Rounds products: the results have the bits of the interpreter of one point, and of the functions of one point in
    /// compiled code, on all processors.
    pub fn portable() -> Self {
        BlockMode::portable_with(Instructions::best())
    }

    /// Fuses products with sums if the processor has such instructions: the results have the bits of the loops over many points
    /// in compiled code.
    pub fn fused() -> Self {
        BlockMode::fused_with(Instructions::best())
    }

    /// Computes like [`portable`](BlockMode::portable), with these instructions.
    pub fn portable_with(instructions: Instructions) -> Self {
        BlockMode { instructions, fused: false }
    }

    /// Computes like [`fused`](BlockMode::fused), with these instructions.
    pub fn fused_with(instructions: Instructions) -> Self {
        BlockMode { instructions, fused: true }
    }

    fn run<T: Float, W: Work<T>>(self, work: W) -> W::Output {
        match self.fused {
            true => self.instructions.run_in_any_build(work),
            false => self.instructions.run_plainly(work),
        }
    }
}

/// A plan with the numbers of one set of parameters. Threads share it, each with a [`Scratch`] of its own.
#[derive(Clone, Debug)]
pub struct Prepared<T: Blockwise> {
    plan: Arc<BlockPlan>,
    mode: BlockMode,
    /// The values of the stage Parameter.
    parameter_values: Vec<T::Wide>,
    /// The numbers that are the same at all points; numbers of the stage Time are unset here.
    scalars: Vec<T>,
    /// A stamp that differs for every instance, and for every set of parameters.
    stamp: u64,
}

/// The numbers of one time and of one block.
#[derive(Clone, Debug)]
pub struct Scratch<T: Blockwise> {
    /// The stamp of the prepared plan whose numbers these are.
    stamp: u64,
    time: Option<T>,
    /// The values of the stages Parameter and Time.
    uniform: Vec<T::Wide>,
    scalars: Vec<T>,
    columns: Vec<T::Column>,
}

impl<T: Blockwise> Default for Scratch<T> {
    fn default() -> Self {
        Scratch {
            stamp: 0,
            time: None,
            uniform: Vec::new(),
            scalars: Vec::new(),
            columns: Vec::new(),
        }
    }
}

/// The inputs of the points of a block, to be written.
pub struct Inputs<'a, T: Blockwise> {
    symbols: &'a [Symbol],
    columns: &'a mut [T::Column],
    count: usize,
}

/// The results at the points of a block.
pub struct Outputs<'a, T: Blockwise> {
    plan: &'a BlockPlan,
    scalars: &'a [T],
    columns: &'a [T::Column],
    count: usize,
}

/// A component of an output at the points of a block.
#[derive(Clone, Copy, Debug)]
pub enum Component<'a, T> {
    /// One number for each point.
    Each(&'a [T]),
    /// One number for all points.
    Same(T),
}

impl<T: Blockwise> Prepared<T> {
    /// Runs the stage Parameter. `parameters` are in the order of the field file.
    pub fn new(plan: Arc<BlockPlan>, mode: BlockMode, parameters: &[T]) -> Self {
        let constant = |scalar: &Scalar| match &scalar.source {
            ScalarSource::Constant(number) => signed(scalar, T::from_rational(number)),
            ScalarSource::Pi => signed(scalar, T::pi()),
            ScalarSource::Once(_) => T::from_f64(0.0),
        };
        let scalars = plan.scalars.iter().map(constant).collect();
        let early = Vec::with_capacity(plan.parameter_count);
        let mut prepared = Prepared { plan, mode, parameter_values: early, scalars, stamp: 0 };
        prepared.set(parameters);
        prepared
    }

    /// Runs the stage Parameter again.
    pub fn set(&mut self, parameters: &[T]) {
        // 0 is the stamp of no prepared plan.
        static STAMPS: AtomicU64 = AtomicU64::new(1);
        self.stamp = STAMPS.fetch_add(1, Ordering::Relaxed);
        let plan = &self.plan;
        self.parameter_values.clear();
        let input = |symbol| match symbol {
            Symbol::Parameter(index) => parameters[index].widen(),
            _ => unreachable!("the stage Parameter reads parameters only"),
        };
        for instr in &plan.uniform[..plan.parameter_count] {
            let value = apply(
                &instr.op,
                &self.parameter_values,
                T::wide_from_rational,
                T::wide_square,
                &input,
            );
            self.parameter_values.push(value);
        }
        for (number, scalar) in self.scalars.iter_mut().zip(&plan.scalars) {
            if let ScalarSource::Once(index) = scalar.source
                && index < plan.parameter_count
            {
                *number = signed(scalar, T::narrow(self.parameter_values[index]));
            }
        }
    }

    /// The plan.
    pub fn plan(&self) -> &BlockPlan {
        &self.plan
    }

    /// Runs the plan at `count` points. For each block, calls `write_inputs` before the steps, and `read_outputs` after them;
    /// their first argument is the index of the block's first point.
    pub fn run(
        &self,
        scratch: &mut Scratch<T>,
        time: T,
        count: usize,
        write_inputs: &mut dyn FnMut(usize, &mut Inputs<'_, T>),
        read_outputs: &mut dyn FnMut(usize, &Outputs<'_, T>),
    ) {
        let plan = &*self.plan;
        scratch.enter(self, time);
        let Scratch { scalars, columns, .. } = scratch;
        for start in (0..count).step_by(T::BLOCK) {
            let count = (count - start).min(T::BLOCK);
            let pieces = count.div_ceil(T::TOGETHER);
            let inputs = &mut columns[..plan.inputs.len()];
            write_inputs(start, &mut Inputs { symbols: &plan.inputs, columns: inputs, count });
            // Copies of the first point fill the last piece: a program may be undefined at other numbers.
            for column in inputs {
                let numbers = &mut column.numbers_mut()[..pieces * T::TOGETHER];
                let first = numbers[0];
                numbers[count..].fill(first);
            }
            T::run(plan, self.mode, scalars, columns, pieces);
            read_outputs(start, &Outputs { plan, scalars, columns, count });
        }
    }
}

impl<T: Blockwise> Prepared<T> {
    /// Computes the components of the first output at points whose coordinates X follow each other in `points`, and normals N
    /// in `normals` if the output needs them. `values` has exactly the length of all components.
    pub fn at_points(
        &self,
        scratch: &mut Scratch<T>,
        time: T,
        dimension: usize,
        [points, normals]: [&[T]; 2],
        values: &mut [T],
    ) {
        let count = points.len() / dimension;
        let components = values.len().checked_div(count).unwrap_or(0);
        let mut write_inputs = |start: usize, inputs: &mut Inputs<'_, T>| {
            for (symbol, column) in inputs.columns() {
                let (numbers, axis) = match symbol {
                    Symbol::Coordinate(axis) => (points, axis),
                    Symbol::Normal(axis) => (normals, axis),
                    _ => unreachable!("a quantity takes positions and normals"),
                };
                let numbers = &numbers[start * dimension..];
                match dimension {
                    1 => column.copy_from_slice(&numbers[..column.len()]),
                    _ => {
                        let numbers = numbers[axis..].iter().step_by(dimension);
                        column.iter_mut().zip(numbers).for_each(|(to, number)| *to = *number);
                    }
                }
            }
        };
        let mut read_outputs = |start: usize, outputs: &Outputs<'_, T>| {
            let own = &mut values[start * components..][..outputs.count() * components];
            for (index, component) in outputs.components(0).enumerate() {
                match components {
                    1 => component.write(own.iter_mut()),
                    _ => component.write(own[index..].iter_mut().step_by(components)),
                }
            }
        };
        self.run(scratch, time, count, &mut write_inputs, &mut read_outputs);
    }
}

/// The numbers of the first output that X alone determines, stored for later times, one block of points after the other.
#[derive(Clone, Debug)]
pub struct PointCache<T: Blockwise>(Vec<T::Column>);

impl<T: Blockwise> Prepared<T> {
    /// Stores the numbers that X determines at points, which have the form of [`at_points`](Self::at_points).
    pub fn keep(&self, scratch: &mut Scratch<T>, dimension: usize, points: &[T]) -> PointCache<T> {
        let plan = &*self.plan;
        // No step of X alone reads a value of the stage Time.
        scratch.enter(self, T::from_f64(0.0));
        let Scratch { scalars, columns, .. } = scratch;
        let mut kept = Vec::with_capacity(plan.kept.len() * points.len().div_ceil(T::BLOCK));
        for points in points.chunks(T::BLOCK * dimension) {
            let pieces = self.supply(columns, dimension, points);
            T::run_parts((plan, 0..plan.of_points), self.mode, scalars, columns, pieces);
            kept.extend(plan.kept.iter().map(|register| columns[*register as usize].clone()));
        }
        PointCache(kept)
    }

    /// Computes the components of the first output at points with stored numbers, in `values`: with the same bits as
    /// [`at_points`](Self::at_points).
    pub fn at_kept(
        &self,
        scratch: &mut Scratch<T>,
        time: T,
        (dimension, points, kept): (usize, &[T], &PointCache<T>),
        values: &mut [T],
    ) {
        let plan = &*self.plan;
        scratch.enter(self, time);
        let Scratch { scalars, columns, .. } = scratch;
        let components = plan.outputs.first().map_or(0, |places| places.len());
        let late = plan.of_points..plan.parts.len();
        let blocks = points.chunks(T::BLOCK * dimension);
        let values = values.chunks_mut((T::BLOCK * components).max(1));
        for (block, (points, values)) in blocks.zip(values).enumerate() {
            let count = points.len() / dimension;
            let pieces = count.div_ceil(T::TOGETHER);
            let kept = &kept.0[block * plan.kept.len()..];
            for (register, column) in plan.kept.iter().zip(kept) {
                columns[*register as usize].clone_from(column);
            }
            if !T::run_parts((plan, late.clone()), self.mode, scalars, columns, pieces) {
                self.supply(columns, dimension, points);
                T::run(plan, self.mode, scalars, columns, pieces);
            }
            let outputs = Outputs { plan, scalars, columns, count };
            for (index, component) in outputs.components(0).enumerate() {
                component.write(values[index..].iter_mut().step_by(components));
            }
        }
    }

    /// Writes the coordinates of the points of a block; returns the number of its pieces.
    fn supply(&self, columns: &mut [T::Column], dimension: usize, points: &[T]) -> usize {
        let plan = &*self.plan;
        let count = points.len() / dimension;
        let pieces = count.div_ceil(T::TOGETHER);
        for (symbol, column) in plan.inputs.iter().zip(columns) {
            let Symbol::Coordinate(axis) = symbol else {
                unreachable!("a quantity that is kept takes positions alone")
            };
            let numbers = &mut column.numbers_mut()[..pieces * T::TOGETHER];
            let own = points[*axis..].iter().step_by(dimension);
            numbers.iter_mut().zip(own).for_each(|(to, number)| *to = *number);
            let first = numbers[0];
            numbers[count..].fill(first);
        }
        pieces
    }
}

fn signed<T: Blockwise>(scalar: &Scalar, number: T) -> T {
    if scalar.negated { -number } else { number }
}

impl<T: Blockwise> Scratch<T> {
    /// Prepares the memory for a plan and a time, and runs the stage Time unless that has been done.
    fn enter(&mut self, prepared: &Prepared<T>, time: T) {
        let plan = &*prepared.plan;
        if self.stamp != prepared.stamp {
            self.stamp = prepared.stamp;
            self.time = None;
            self.uniform.clone_from(&prepared.parameter_values);
            self.scalars.clone_from(&prepared.scalars);
            if self.columns.len() < plan.registers {
                self.columns.resize_with(plan.registers, || T::Column::of(T::from_f64(0.0)));
            }
        }
        if self.time.is_none_or(|known| !known.is_same(time)) {
            self.time = Some(time);
            self.pass_time(plan, time);
        }
    }

    fn pass_time(&mut self, plan: &BlockPlan, time: T) {
        self.uniform.truncate(plan.parameter_count);
        let input = |symbol| match symbol {
            Symbol::Time => time.widen(),
            _ => unreachable!("the stage Time reads the time only"),
        };
        for instr in &plan.uniform[plan.parameter_count..] {
            let value =
                apply(&instr.op, &self.uniform, T::wide_from_rational, T::wide_square, &input);
            self.uniform.push(value);
        }
        for (number, scalar) in self.scalars.iter_mut().zip(&plan.scalars) {
            if let ScalarSource::Once(index) = scalar.source
                && index >= plan.parameter_count
            {
                *number = signed(scalar, T::narrow(self.uniform[index]));
            }
        }
    }
}

impl<T: Blockwise> Inputs<'_, T> {
    /// The inputs that the points have to supply, each with one number per point.
    pub fn columns(&mut self) -> impl Iterator<Item = (Symbol, &mut [T])> {
        let count = self.count;
        let columns = self.columns.iter_mut().map(move |column| &mut column.numbers_mut()[..count]);
        self.symbols.iter().copied().zip(columns)
    }
}

impl<'a, T: Blockwise> Outputs<'a, T> {
    /// The number of points.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The components of the output at this position in the plan.
    pub fn components(&self, output: usize) -> impl Iterator<Item = Component<'a, T>> + use<'a, T> {
        let (columns, scalars, count) = (self.columns, self.scalars, self.count);
        self.plan.components[self.plan.outputs[output].clone()].iter().map(move |place| match place
        {
            Operand::Column(column) => {
                Component::Each(&columns[*column as usize].numbers()[..count])
            }
            Operand::Scalar(scalar) => Component::Same(scalars[*scalar as usize]),
        })
    }
}

impl<T: Copy> Component<'_, T> {
    /// The value at a point of the block.
    pub fn at(&self, point: usize) -> T {
        match self {
            Component::Each(numbers) => numbers[point],
            Component::Same(number) => *number,
        }
    }

    /// Writes the values to `places`, as many as there are.
    pub fn write<'a>(&self, places: impl Iterator<Item = &'a mut T>)
    where
        T: 'a,
    {
        match self {
            Component::Each(numbers) => {
                places.zip(*numbers).for_each(|(place, number)| *place = *number);
            }
            Component::Same(number) => places.for_each(|place| *place = *number),
        }
    }
}

/// A pool of working memory for threads that come and go.
#[derive(Debug)]
pub struct ScratchPool<T: Blockwise>(Mutex<Vec<Scratch<T>>>);

impl<T: Blockwise> Default for ScratchPool<T> {
    fn default() -> Self {
        ScratchPool(Mutex::new(Vec::new()))
    }
}

impl<T: Blockwise> ScratchPool<T> {
    /// Calls `work` with memory that no other thread uses meanwhile.
    pub fn with<R>(&self, work: impl FnOnce(&mut Scratch<T>) -> R) -> R {
        let pool = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut scratch = pool().pop().unwrap_or_default();
        let result = work(&mut scratch);
        pool().push(scratch);
        result
    }
}
