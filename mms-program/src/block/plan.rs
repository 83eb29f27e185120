//! Lowers a program to steps over blocks of points.
//!
//! A step is an operation, the register of its result, and operands that are registers or scalars. A register is a column of a
//! block, 512 bytes in the first cache, and is reused once its value is no longer read: liveness by a linear scan in the order
//! of the program. Inputs of points keep their registers, since a block may be computed again. Scalars are the numbers that are
//! the same at all points, constants and the stages Parameter and Time, and are broadcast from one number. So a b + c has one
//! step for each choice of columns and scalars as operands, and signs are applied to scalars in advance.
//!
//! `fusion` and `loops` decide which products are fused, which stages are loops of their own, and which values both loops
//! compute. Emission uses the same decisions: hence the same bits.

use std::collections::HashMap;
use std::ops::Range;

use crate::fusion::{Fused, Fusion};
use crate::loops::{Columns, Cut, WORTH_IN_CACHE, is_worth_two};
use crate::program::{Instr, Key, Op, Program, Value};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::{Function, Rational, Small, Symbol};

/// The operation of a step on the columns and scalars at its operands a, b and c.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum StepKind {
    /// Fills a column with the scalar a.
    Fill,
    /// a + b
    Add,
    /// a + b, b a scalar.
    AddScalar,
    /// a - b
    Subtract,
    /// b - a, b a scalar.
    SubtractFrom,
    /// a b
    Multiply,
    /// a b, b a scalar.
    Scale,
    /// a / b
    Divide,
    /// a / b, b a scalar.
    DivideBy,
    /// b / a, b a scalar.
    DivideInto,
    /// -a
    Negate,
    /// The square root of a.
    Root,
    /// a b + c
    MultiplyAdd,
    /// a b - c
    MultiplySubtract,
    /// c - a b
    SubtractProduct,
    /// a b + c, c a scalar.
    MultiplyAddScalar,
    /// c - a b, c a scalar.
    SubtractProductFrom,
    /// a b + c, b a scalar.
    ScaleAdd,
    /// a b - c, b a scalar.
    ScaleSubtract,
    /// a b + c, b and c scalars.
    ScaleAddScalar,
    /// A function of a, and the proved bound of a.
    Unary(Function, Option<Small>),
    /// A function of a and b.
    Binary(Function),
}

impl StepKind {
    /// The number of operands, of a, b and c in this order, and which of them are columns.
    fn columns(self) -> &'static [bool] {
        match self {
            StepKind::Fill => &[false],
            StepKind::Negate | StepKind::Root | StepKind::Unary(..) => &[true],
            StepKind::Add
            | StepKind::Subtract
            | StepKind::Multiply
            | StepKind::Divide
            | StepKind::Binary(_) => &[true, true],
            StepKind::AddScalar
            | StepKind::SubtractFrom
            | StepKind::Scale
            | StepKind::DivideBy
            | StepKind::DivideInto => &[true, false],
            StepKind::MultiplyAdd | StepKind::MultiplySubtract | StepKind::SubtractProduct => {
                &[true, true, true]
            }
            StepKind::MultiplyAddScalar | StepKind::SubtractProductFrom => &[true, true, false],
            StepKind::ScaleAdd | StepKind::ScaleSubtract => &[true, false, true],
            StepKind::ScaleAddScalar => &[true, false, false],
        }
    }

    /// Whether the step is a function made of many operations: it is compiled separately, since its coefficients would occupy
    /// the registers of all other steps.
    fn is_function(self) -> bool {
        matches!(self, StepKind::Unary(..) | StepKind::Binary(_))
    }
}

/// One operation on all points of a block. Operands are registers or scalars, as the kind says; the result is a register that
/// no operand uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct BlockStep {
    pub kind: StepKind,
    pub result: u32,
    pub operands: [u32; 3],
}

impl BlockStep {
    /// The operands that are columns.
    fn columns(&self) -> impl Iterator<Item = u32> + use<> {
        let operands = self.operands.into_iter().zip(self.kind.columns());
        operands.filter(|(_, is_column)| **is_column).map(|(operand, _)| operand)
    }
}

/// The origin of a number that is the same at all points.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum ScalarSource {
    Constant(Rational),
    Pi,
    /// The result of this instruction of [`BlockPlan::uniform`].
    Once(usize),
}

/// A number that is the same at all points.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Scalar {
    pub source: ScalarSource,
    /// Whether the negative number is used.
    pub negated: bool,
}

/// The place of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operand {
    Column(u32),
    Scalar(u32),
}

/// The steps that compute some outputs of a program at many points. A plan is valid for all parameters, times and precisions,
/// and any number of threads share it.
#[derive(Clone, Debug)]
pub struct BlockPlan {
    /// The instructions of the stages Parameter and Time.
    pub(super) uniform: Vec<Instr>,
    /// The number of instructions in `uniform` that belong to the stage Parameter.
    pub(super) parameter_count: usize,
    pub(super) scalars: Vec<Scalar>,
    /// The inputs of a point, each in the register of its position.
    pub(super) inputs: Vec<Symbol>,
    /// The steps of the stages Point and PointTime.
    pub(super) steps: Vec<BlockStep>,
    /// The parts of the steps: functions one by one, and the steps between them.
    pub(super) parts: Vec<Range<usize>>,
    /// The number of parts that need X alone.
    pub(super) of_points: usize,
    /// The registers of those parts, and of inputs, that the other parts read.
    pub(super) kept: Vec<u32>,
    pub(super) registers: usize,
    /// The components of all outputs.
    pub(super) components: Vec<Operand>,
    /// The range of components of each output.
    pub(super) outputs: Vec<Range<usize>>,
}

impl BlockPlan {
    /// Plans some outputs, each with the bits that compiled code gives when it computes that output alone. `in_two_loops`
    /// states for which outputs compiled code may have two loops: one for values of X, one for values that also need t. An
    /// output that the program does not have gets no component.
    pub fn new<K: Key>(
        program: &Program<K>,
        outputs: &[K],
        in_two_loops: impl Fn(K) -> bool,
    ) -> Self {
        let mut lowering = Lowering::new(program, outputs);
        let mut components = Vec::new();
        let mut ranges = Vec::new();
        for output in outputs {
            let found = lowering.output(*output, in_two_loops(*output));
            ranges.push(components.len()..components.len() + found.len());
            components.extend(found);
        }
        lowering.finish(components, ranges)
    }

    /// The inputs that a point has to supply.
    pub fn inputs(&self) -> &[Symbol] {
        &self.inputs
    }

    /// The number of stored values of a point.
    pub fn kept(&self) -> usize {
        self.kept.len()
    }

    /// Whether the values depend on the time.
    pub fn needs_time(&self) -> bool {
        self.parameter_count < self.uniform.len()
    }
}

/// A plan under construction: every step has a column of its own.
struct Lowering<'a, K> {
    program: &'a Program<K>,
    uniform: Vec<Instr>,
    /// The instructions of `uniform`, by their positions in the program.
    renamed: Vec<Option<usize>>,
    scalars: Vec<Scalar>,
    scalar_places: HashMap<Scalar, u32>,
    /// The columns of inputs of points.
    inputs: Vec<(Symbol, u32)>,
    steps: Vec<BlockStep>,
    /// The columns of existing steps, by kind and operands.
    known: HashMap<(StepKind, [u32; 3]), u32>,
    columns: u32,
    /// The number of steps before the first one that needs the time.
    first_timed_step: Option<usize>,
    /// The operand of each value at points that has been lowered for the present output.
    lowered: Vec<Option<Operand>>,
}

impl<'a, K: Key> Lowering<'a, K> {
    fn new(program: &'a Program<K>, outputs: &[K]) -> Self {
        let needed = program.needed(outputs);
        let mut renamed = vec![None; program.instrs.len()];
        let mut uniform: Vec<Instr> = Vec::new();
        for index in (0..program.start(Stage::Point)).filter(|index| needed[*index]) {
            let Instr { op, stage } = &program.instrs[index];
            let rename = |value: Value| {
                Value(renamed[value.index()].expect("operands come first and are needed") as u32)
            };
            let op = op.map(rename);
            renamed[index] = Some(uniform.len());
            uniform.push(Instr { op, stage: *stage });
        }
        Lowering {
            program,
            uniform,
            renamed,
            scalars: Vec::new(),
            scalar_places: HashMap::new(),
            inputs: Vec::new(),
            steps: Vec::new(),
            known: HashMap::new(),
            columns: 0,
            first_timed_step: None,
            lowered: vec![None; program.instrs.len()],
        }
    }

    /// Lowers an output, and returns the places of its components.
    fn output(&mut self, output: K, in_two_loops: bool) -> Vec<Operand> {
        let program = self.program;
        let roots = program.outputs.get(&output).map_or(&[][..], Vec::as_slice);
        self.lowered.fill(None);
        if in_two_loops && is_worth_two(program, roots) {
            self.in_two_loops(roots);
        } else {
            self.statements(roots, &[Stage::Point, Stage::PointTime]);
        }
        roots.iter().map(|root| self.place(*root)).collect()
    }

    fn in_two_loops(&mut self, roots: &[Value]) {
        let columns = Columns::of(self.program, roots);
        let cut = Cut::new(self.program, &columns, WORTH_IN_CACHE);
        self.statements(&cut.columns.values, &[Stage::Point]);
        self.first_timed_step.get_or_insert(self.steps.len());
        let mut handed = vec![None; self.lowered.len()];
        for value in &cut.columns.values {
            handed[value.index()] = self.lowered[value.index()];
        }
        self.lowered = handed;
        for value in &cut.made {
            self.operation(*value);
        }
        self.statements(roots, &[Stage::PointTime]);
    }

    /// Lowers the statements that `roots` need of the stages that a loop computes.
    fn statements(&mut self, roots: &[Value], own: &[Stage]) {
        let program = self.program;
        let needed = program.needed_for(roots.iter().copied());
        let fusion = Fusion::new(&program.instrs, roots, &needed, own);
        for (index, instr) in program.instrs.iter().enumerate() {
            let computed = needed[index] && own.contains(&instr.stage) && !fusion.absorbed[index];
            if computed && instr.stage == Stage::PointTime {
                self.first_timed_step.get_or_insert(self.steps.len());
            }
            match &fusion.fused[index] {
                _ if !computed => {}
                Some(fused) => self.lowered[index] = Some(self.fused(fused)),
                None => self.operation(Value(index as u32)),
            }
        }
    }

    /// Lowers the operation of a value; numbers and inputs have places already.
    fn operation(&mut self, value: Value) {
        let (kind, operands) = match &self.program.instr(value).op {
            Op::Constant(_) | Op::Pi | Op::Input(_) => return,
            Op::Add(a, b) => self.sum(*a, *b),
            Op::Subtract(a, b) => self.difference(*a, *b),
            Op::Multiply(a, b) => self.product(*a, *b),
            Op::Divide(a, b) => self.quotient(*a, *b),
            Op::Negate(a) => (StepKind::Negate, [self.column(*a), 0, 0]),
            Op::Unary(Function::Sqrt, _, a) => (StepKind::Root, [self.column(*a), 0, 0]),
            Op::Unary(function, small, a) => {
                (StepKind::Unary(*function, *small), [self.column(*a), 0, 0])
            }
            Op::Binary(function, a, b) => {
                (StepKind::Binary(*function), [self.column(*a), self.column(*b), 0])
            }
        };
        self.lowered[value.index()] = Some(Operand::Column(self.step(kind, operands)));
    }

    fn sum(&mut self, a: Value, b: Value) -> (StepKind, [u32; 3]) {
        match (self.place(a), self.place(b)) {
            (Operand::Column(a), Operand::Column(b)) => (StepKind::Add, [a, b, 0]),
            (Operand::Column(a), Operand::Scalar(b)) => (StepKind::AddScalar, [a, b, 0]),
            (Operand::Scalar(a), _) => (StepKind::AddScalar, [self.column(b), a, 0]),
        }
    }

    fn difference(&mut self, a: Value, b: Value) -> (StepKind, [u32; 3]) {
        match (self.place(a), self.place(b)) {
            (Operand::Column(a), Operand::Column(b)) => (StepKind::Subtract, [a, b, 0]),
            (Operand::Column(a), Operand::Scalar(b)) => {
                (StepKind::AddScalar, [a, self.negative(b), 0])
            }
            (Operand::Scalar(a), _) => (StepKind::SubtractFrom, [self.column(b), a, 0]),
        }
    }

    fn product(&mut self, a: Value, b: Value) -> (StepKind, [u32; 3]) {
        match (self.place(a), self.place(b)) {
            (Operand::Column(a), Operand::Column(b)) => (StepKind::Multiply, [a, b, 0]),
            (Operand::Column(a), Operand::Scalar(b)) => (StepKind::Scale, [a, b, 0]),
            (Operand::Scalar(a), _) => (StepKind::Scale, [self.column(b), a, 0]),
        }
    }

    fn quotient(&mut self, a: Value, b: Value) -> (StepKind, [u32; 3]) {
        match (self.place(a), self.place(b)) {
            (Operand::Column(a), Operand::Column(b)) => (StepKind::Divide, [a, b, 0]),
            (Operand::Column(a), Operand::Scalar(b)) => (StepKind::DivideBy, [a, b, 0]),
            (Operand::Scalar(a), _) => (StepKind::DivideInto, [self.column(b), a, 0]),
        }
    }

    /// A product and a sum in one step. Signs of scalars are changed in advance, which changes no bit.
    fn fused(&mut self, fused: &Fused) -> Operand {
        let Fused { factors: [a, b], term, minus_product, minus_term } = *fused;
        let places = [a, b].map(|factor| self.place(factor));
        let (a, scalar) = match places {
            [Operand::Column(a), b] => (a, b),
            [b, Operand::Column(a)] => (a, b),
            [Operand::Scalar(_), b] => (self.column(a), b),
        };
        let (kind, operands) = match (scalar, self.place(term)) {
            (Operand::Column(b), Operand::Column(c)) => {
                let kind = match (minus_product, minus_term) {
                    (true, _) => StepKind::SubtractProduct,
                    (_, true) => StepKind::MultiplySubtract,
                    _ => StepKind::MultiplyAdd,
                };
                (kind, [a, b, c])
            }
            (Operand::Column(b), Operand::Scalar(c)) => match minus_product {
                true => (StepKind::SubtractProductFrom, [a, b, c]),
                false => (StepKind::MultiplyAddScalar, [a, b, self.turned(c, minus_term)]),
            },
            (Operand::Scalar(b), Operand::Column(c)) => match minus_term {
                true => (StepKind::ScaleSubtract, [a, b, c]),
                false => (StepKind::ScaleAdd, [a, self.turned(b, minus_product), c]),
            },
            (Operand::Scalar(b), Operand::Scalar(c)) => {
                let operands = [a, self.turned(b, minus_product), self.turned(c, minus_term)];
                (StepKind::ScaleAddScalar, operands)
            }
        };
        Operand::Column(self.step(kind, operands))
    }

    /// The column of a step; an equal step is reused.
    fn step(&mut self, kind: StepKind, operands: [u32; 3]) -> u32 {
        if let Some(known) = self.known.get(&(kind, operands)) {
            return *known;
        }
        let result = self.new_column();
        self.steps.push(BlockStep { kind, result, operands });
        self.known.insert((kind, operands), result);
        result
    }

    fn new_column(&mut self) -> u32 {
        self.columns += 1;
        self.columns - 1
    }

    /// The place of a value: a number, an input of a point, or a lowered value.
    fn place(&mut self, value: Value) -> Operand {
        let Instr { op, stage } = self.program.instr(value);
        match op {
            Op::Constant(number) => self.scalar(ScalarSource::Constant(number.clone())),
            Op::Pi => self.scalar(ScalarSource::Pi),
            _ if !stage.needs_point() => {
                let index =
                    self.renamed[value.index()].expect("every value that is read is needed");
                self.scalar(ScalarSource::Once(index))
            }
            Op::Input(symbol) => Operand::Column(self.input(*symbol)),
            _ => self.lowered[value.index()].expect("operands come first"),
        }
    }

    /// The column of a value; a number is written to one.
    fn column(&mut self, value: Value) -> u32 {
        match self.place(value) {
            Operand::Column(column) => column,
            Operand::Scalar(scalar) => self.step(StepKind::Fill, [scalar, 0, 0]),
        }
    }

    fn input(&mut self, symbol: Symbol) -> u32 {
        if let Some((_, column)) = self.inputs.iter().find(|(known, _)| *known == symbol) {
            return *column;
        }
        let column = self.new_column();
        self.inputs.push((symbol, column));
        column
    }

    fn scalar(&mut self, source: ScalarSource) -> Operand {
        Operand::Scalar(self.scalar_place(Scalar { source, negated: false }))
    }

    fn negative(&mut self, scalar: u32) -> u32 {
        let Scalar { source, negated } = self.scalars[scalar as usize].clone();
        self.scalar_place(Scalar { source, negated: !negated })
    }

    fn turned(&mut self, scalar: u32, negative: bool) -> u32 {
        if negative { self.negative(scalar) } else { scalar }
    }

    fn scalar_place(&mut self, scalar: Scalar) -> u32 {
        *self.scalar_places.entry(scalar).or_insert_with_key(|scalar| {
            self.scalars.push(scalar.clone());
            self.scalars.len() as u32 - 1
        })
    }

    /// The columns that exist at a border and are read after it.
    fn kept(&self, border: usize, components: &[Operand]) -> Vec<u32> {
        let (before, after) = self.steps.split_at(border);
        let outputs = components.iter().filter_map(|place| match place {
            Operand::Column(column) => Some(*column),
            Operand::Scalar(_) => None,
        });
        let mut is_read = vec![false; self.columns as usize];
        let read = after.iter().flat_map(BlockStep::columns).chain(outputs);
        read.for_each(|column| is_read[column as usize] = true);
        let inputs = self.inputs.iter().map(|(_, column)| *column);
        let there = inputs.chain(before.iter().map(|step| step.result));
        there.filter(|column| is_read[*column as usize]).collect()
    }

    /// Assigns registers to columns. The registers of inputs are never reused, since a block may have to be computed again.
    fn finish(mut self, mut components: Vec<Operand>, outputs: Vec<Range<usize>>) -> BlockPlan {
        const KEPT: usize = usize::MAX;
        let border = self.first_timed_step.unwrap_or(self.steps.len());
        let mut kept = self.kept(border, &components);
        let mut last = vec![0; self.columns as usize];
        for (index, step) in self.steps.iter().enumerate() {
            step.columns().for_each(|column| last[column as usize] = index);
        }
        let columns = components.iter().filter_map(|place| match place {
            Operand::Column(column) => Some(*column),
            Operand::Scalar(_) => None,
        });
        let inputs = self.inputs.iter().map(|(_, column)| *column);
        columns.chain(inputs).for_each(|column| last[column as usize] = KEPT);
        let mut registers = vec![0_u32; self.columns as usize];
        for (register, (_, column)) in self.inputs.iter().enumerate() {
            registers[*column as usize] = register as u32;
        }
        let (mut free, mut count) = (Vec::new(), self.inputs.len() as u32);
        for (index, step) in self.steps.iter_mut().enumerate() {
            // The result gets its register before the registers of the operands are free.
            let result = free.pop().unwrap_or_else(|| {
                count += 1;
                count - 1
            });
            registers[step.result as usize] = result;
            step.result = result;
            let is_column = step.kind.columns();
            for place in (0..is_column.len()).filter(|place| is_column[*place]) {
                let column = step.operands[place] as usize;
                step.operands[place] = registers[column];
                if last[column] == index {
                    free.push(registers[column]);
                    last[column] = KEPT;
                }
            }
        }
        for place in &mut components {
            if let Operand::Column(column) = place {
                *column = registers[*column as usize];
            }
        }
        kept.iter_mut().for_each(|column| *column = registers[*column as usize]);
        let mut parts = parts(&self.steps[..border], 0);
        let of_points = parts.len();
        parts.extend(self::parts(&self.steps[border..], border));
        BlockPlan {
            parameter_count: self.uniform.partition_point(|instr| instr.stage == Stage::Parameter),
            uniform: self.uniform,
            scalars: self.scalars,
            inputs: self.inputs.into_iter().map(|(symbol, _)| symbol).collect(),
            parts,
            of_points,
            kept,
            steps: self.steps,
            registers: count as usize,
            components,
            outputs,
        }
    }
}

/// The parts of steps whose first one has this position: functions one by one, and the steps between them.
fn parts(steps: &[BlockStep], first: usize) -> Vec<Range<usize>> {
    let together = |a: &BlockStep, b: &BlockStep| !a.kind.is_function() && !b.kind.is_function();
    let mut start = first;
    let parts = steps.chunk_by(together).map(|part| {
        start += part.len();
        start - part.len()..start
    });
    parts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Value;
    use mms_symbolic::expr::Stage;
    use mms_symbolic::sorted::SortedMap;

    /// The plan of a program whose last value is the output.
    fn plan(ops: Vec<Op>) -> BlockPlan {
        let stage = |op: &Op| match op {
            Op::Input(symbol) => Stage::of(*symbol),
            _ => Stage::Point,
        };
        let last = Value(ops.len() as u32 - 1);
        let instrs = ops.into_iter().map(|op| Instr { stage: stage(&op), op }).collect();
        let program = Program { instrs, outputs: SortedMap::from([(0, vec![last])]) };
        BlockPlan::new(&program, &[0], |_| false)
    }

    #[test]
    fn registers_are_used_again() {
        // A long chain of functions needs two registers at a time.
        let chain = (0..100).map(|k| Op::Unary(Function::Sin, None, Value(k)));
        let plan = plan([Op::Input(Symbol::Coordinate(0))].into_iter().chain(chain).collect());
        assert_eq!((plan.steps.len(), plan.registers), (100, 3));
    }

    /// Each operand of a sum with a product may be the same at all points.
    #[test]
    fn a_product_that_is_added_is_no_step_of_its_own() {
        let [x, y] = [0, 1].map(|axis| Op::Input(Symbol::Coordinate(axis)));
        let [a, b] = [0, 1].map(|index| Op::Input(Symbol::Parameter(index)));
        for factors in [[2, 3], [2, 0], [0, 3]] {
            for term in [0, 1, 2, 3] {
                let [first, second] = factors.map(Value);
                for sum in [
                    Op::Add(Value(4), Value(term)),
                    Op::Subtract(Value(4), Value(term)),
                    Op::Subtract(Value(term), Value(4)),
                ] {
                    let product = Op::Multiply(first, second);
                    let plan = plan(vec![a.clone(), b.clone(), x.clone(), y.clone(), product, sum]);
                    assert_eq!(plan.steps.len(), 1, "{:?}", plan.steps);
                }
            }
        }
    }
}
