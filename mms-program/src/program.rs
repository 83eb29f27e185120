//! Straight-line code, value-numbered.

use std::fmt::{self, Debug, Display, Formatter};
use std::ops::Range;

use mms_symbolic::expr::{Function, Rational, Small, Stage, Symbol};
use mms_symbolic::sorted::SortedMap;

/// The name of an output of a program. Outputs are scheduled in the order of their keys.
pub trait Key: Copy + Ord + Debug {}

impl<K: Copy + Ord + Debug> Key for K {}

/// A handle to the result of one instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Value(pub u32);

impl Value {
    /// The position of the instruction in its program.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operation on values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// An exact number, rounded by the evaluation.
    Constant(Rational),
    /// pi.
    Pi,
    /// A leaf.
    Input(Symbol),
    /// a + b
    Add(Value, Value),
    /// a - b
    Subtract(Value, Value),
    /// a b
    Multiply(Value, Value),
    /// a / b
    Divide(Value, Value),
    /// -a
    Negate(Value),
    /// f(a), and a proved bound of a that allows a quicker form of f
    Unary(Function, Option<Small>, Value),
    /// f(a, b)
    Binary(Function, Value, Value),
}

impl Op {
    /// The operands.
    pub fn operands(&self) -> impl Iterator<Item = Value> {
        let pair = match *self {
            Op::Constant(_) | Op::Pi | Op::Input(_) => [None, None],
            Op::Negate(a) | Op::Unary(_, _, a) => [Some(a), None],
            Op::Add(a, b)
            | Op::Subtract(a, b)
            | Op::Multiply(a, b)
            | Op::Divide(a, b)
            | Op::Binary(_, a, b) => [Some(a), Some(b)],
        };
        pair.into_iter().flatten()
    }

    /// Applies the operation to other operands.
    pub fn map(&self, mut rename: impl FnMut(Value) -> Value) -> Op {
        match *self {
            Op::Constant(ref number) => Op::Constant(number.clone()),
            Op::Pi => Op::Pi,
            Op::Input(symbol) => Op::Input(symbol),
            Op::Add(a, b) => Op::Add(rename(a), rename(b)),
            Op::Subtract(a, b) => Op::Subtract(rename(a), rename(b)),
            Op::Multiply(a, b) => Op::Multiply(rename(a), rename(b)),
            Op::Divide(a, b) => Op::Divide(rename(a), rename(b)),
            Op::Negate(a) => Op::Negate(rename(a)),
            Op::Unary(function, small, a) => Op::Unary(function, small, rename(a)),
            Op::Binary(function, a, b) => Op::Binary(function, rename(a), rename(b)),
        }
    }

    /// Whether the operation computes: constants, loads and a change of sign are free.
    pub fn is_counted(&self) -> bool {
        !matches!(self, Op::Constant(_) | Op::Pi | Op::Input(_) | Op::Negate(_))
    }
}

/// The name of a function of one argument, with an optional proved bound of it, as the scalar trait spells it.
pub fn unary_name(function: Function, small: Option<Small>) -> &'static str {
    match (function, small) {
        (Function::Sin, Some(Small::NearZero)) => "sin_near_zero",
        (Function::Cos, Some(Small::NearZero)) => "cos_near_zero",
        (Function::Sin, Some(Small::WithinOne)) => "sin_within_one",
        (Function::Cos, Some(Small::WithinOne)) => "cos_within_one",
        (other, _) => other.name(),
    }
}

/// One operation, and the time when its result is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instr {
    /// The operation.
    pub op: Op,
    /// The time when its result is known.
    pub stage: Stage,
}

/// Straight-line code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program<K> {
    /// The instructions in order of stage, operands first.
    pub instrs: Vec<Instr>,
    /// The components of each output, tensors row-major.
    pub outputs: SortedMap<K, Vec<Value>>,
}

/// The positions of the instructions of a stage.
pub(crate) fn range(instrs: &[Instr], stage: Stage) -> Range<usize> {
    let position =
        |is_before: &dyn Fn(Stage) -> bool| instrs.partition_point(|it| is_before(it.stage));
    position(&|other| other < stage)..position(&|other| other <= stage)
}

/// Marks the instructions that some values need, including their own, by position.
pub(crate) fn needed(instrs: &[Instr], values: &mut dyn Iterator<Item = Value>) -> Vec<bool> {
    let mut needed = vec![false; instrs.len()];
    for value in values {
        needed[value.index()] = true;
    }
    for index in (0..instrs.len()).rev() {
        if needed[index] {
            for operand in instrs[index].op.operands() {
                needed[operand.index()] = true;
            }
        }
    }
    needed
}

impl<K: Key> Program<K> {
    /// The instruction that makes a value.
    pub fn instr(&self, value: Value) -> &Instr {
        &self.instrs[value.index()]
    }

    /// The position of the first instruction of a stage or of a later one.
    pub fn start(&self, stage: Stage) -> usize {
        self.range(stage).start
    }

    /// The positions of the instructions of a stage.
    pub fn range(&self, stage: Stage) -> Range<usize> {
        range(&self.instrs, stage)
    }

    /// Marks the instructions that `outputs` need, by position.
    pub fn needed(&self, outputs: &[K]) -> Vec<bool> {
        let values = outputs.iter().filter_map(|output| self.outputs.get(output)).flatten();
        self.needed_for(values.copied())
    }

    /// Marks the instructions that `values` need, including their own, by position.
    pub fn needed_for(&self, values: impl IntoIterator<Item = Value>) -> Vec<bool> {
        needed(&self.instrs, &mut values.into_iter())
    }

    /// The number of operations of `outputs`, stage by stage: + - * / and each function call count as one; constants, loads and
    /// changes of sign are free.
    pub fn operations(&self, outputs: &[K]) -> SortedMap<Stage, usize> {
        let mut counts: SortedMap<Stage, usize> = Stage::ALL.map(|stage| (stage, 0)).into();
        for (instr, needed) in self.instrs.iter().zip(self.needed(outputs)) {
            if needed && instr.op.is_counted() {
                *counts.get_or_default(instr.stage) += 1;
            }
        }
        counts
    }
}

impl<K: Key> Display for Program<K> {
    /// Prints one instruction a line, then the outputs: the form in which programs are reviewed.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut stage = None;
        for (index, instr) in self.instrs.iter().enumerate() {
            if stage != Some(instr.stage) {
                stage = Some(instr.stage);
                writeln!(f, "{}:", instr.stage.name())?;
            }
            write!(f, "  v{index} = ")?;
            match &instr.op {
                Op::Constant(number) => writeln!(f, "{number}"),
                Op::Pi => writeln!(f, "pi"),
                Op::Input(symbol) => writeln!(f, "{symbol:?}"),
                Op::Add(a, b) => writeln!(f, "v{} + v{}", a.0, b.0),
                Op::Subtract(a, b) => writeln!(f, "v{} - v{}", a.0, b.0),
                Op::Multiply(a, b) => writeln!(f, "v{} * v{}", a.0, b.0),
                Op::Divide(a, b) => writeln!(f, "v{} / v{}", a.0, b.0),
                Op::Negate(a) => writeln!(f, "-v{}", a.0),
                Op::Unary(function, small, a) => {
                    writeln!(f, "{}(v{})", unary_name(*function, *small), a.0)
                }
                Op::Binary(function, a, b) => {
                    writeln!(f, "{}(v{}, v{})", function.name(), a.0, b.0)
                }
            }?;
        }
        writeln!(f, "outputs:")?;
        for (output, values) in &self.outputs {
            let values: Vec<_> = values.iter().map(|value| format!("v{}", value.0)).collect();
            writeln!(f, "  {output:?} = [{}]", values.join(", "))?;
        }
        Ok(())
    }
}
