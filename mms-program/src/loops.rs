//! Splits the computation of a quantity at many points into two loops over a block of them, and decides which numbers of a
//! point are stored in memory. The decision is made once, for compiled code and for programs that are run in blocks.
//!
//! The values that need X alone and the values that need t as well have two loops if both have enough to compute. A number that
//! the first loop passes on, or that is stored for a point, is written once and read every time. So sums and products of
//! available numbers are computed where they are read; and if several numbers can be computed from one, that one is passed on
//! instead.

use crate::program::{Key, Op, Program, Value};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::Symbol;
use mms_symbolic::sorted::SortedSet;

/// The number of sums and products that a loop over points leaves to the next one in order to save one number.
pub const WORTH_IN_CACHE: usize = 1;

/// The number of sums and products that are repeated in order to save one number of a point in memory.
pub const WORTH_IN_MEMORY: usize = 3;

/// The least work of a loop, in units of [`weight`].
const WORTH_A_LOOP: usize = 20;

/// The values that a function of a point reads from the stage Point.
#[derive(Clone, Debug)]
pub struct Columns {
    /// Coordinates, by axis.
    pub axes: Vec<usize>,
    /// Values of the stage Point.
    pub values: Vec<Value>,
}

impl Columns {
    /// The number of columns.
    pub fn count(&self) -> usize {
        self.axes.len() + self.values.len()
    }

    /// The values of the stage Point that `roots` need; at least one, so that a batch has a length.
    pub fn of<K: Key>(program: &Program<K>, roots: &[Value]) -> Self {
        let needed = program.needed_for(roots.iter().copied());
        let mut read = vec![false; program.instrs.len()];
        roots.iter().for_each(|root| read[root.index()] = true);
        for index in program.range(Stage::PointTime).filter(|index| needed[*index]) {
            let operands = program.instrs[index].op.operands();
            operands.for_each(|operand| read[operand.index()] = true);
        }
        let mut columns = Columns { axes: Vec::new(), values: Vec::new() };
        for index in program.range(Stage::Point).filter(|index| read[*index]) {
            match program.instrs[index].op {
                Op::Input(Symbol::Coordinate(axis)) => columns.axes.push(axis),
                _ => columns.values.push(Value(index as u32)),
            }
        }
        if columns.axes.is_empty() && columns.values.is_empty() {
            columns.axes.push(0);
        }
        columns
    }
}

/// The start of a function of a point.
pub struct Cut {
    /// The columns that it reads: coordinates, and values that were computed before.
    pub columns: Columns,
    /// The values that it computes from the columns, operands first.
    pub made: Vec<Value>,
}

impl Cut {
    /// Replaces columns by fewer ones, where saving a number is `worth` this many operations.
    pub fn new<K: Key>(program: &Program<K>, columns: &Columns, worth: usize) -> Self {
        let mut taken: SortedSet<Value> = columns.values.iter().copied().collect();
        let mut made = SortedSet::new();
        loop {
            let there = taken.iter().chain(&made).copied().collect();
            let steps = |value: &Value| Some((*value, steps(program, *value, worth, &there)?));
            if let Some((value, steps)) = taken.iter().find_map(steps) {
                taken.remove(&value);
                made.extend(steps);
                continue;
            }
            match best_of_those_behind(program, &taken, &there, worth) {
                Some(other) => drop(taken.insert(other)),
                None => break,
            }
        }
        let mut axes: SortedSet<usize> = columns.axes.iter().copied().collect();
        for value in &made {
            for operand in program.instr(*value).op.operands() {
                if let Op::Input(Symbol::Coordinate(axis)) = program.instr(operand).op {
                    axes.insert(axis);
                }
            }
        }
        let columns = Columns { axes: Vec::from_iter(axes), values: Vec::from_iter(taken) };
        Cut { columns, made: Vec::from_iter(made) }
    }
}

/// The number from which most of the `taken` values can be computed, if more than one can.
fn best_of_those_behind<K: Key>(
    program: &Program<K>,
    taken: &SortedSet<Value>,
    there: &SortedSet<Value>,
    worth: usize,
) -> Option<Value> {
    let of_it = |another: &Value| {
        let mut there = there.clone();
        there.insert(*another);
        let is_made = |value: &&Value| steps(program, **value, worth, &there).is_some();
        taken.iter().filter(is_made).count()
    };
    let others: SortedSet<Value> =
        taken.iter().flat_map(|value| behind(program, *value, worth)).collect();
    let best = others.iter().map(|other| (of_it(other), *other)).max();
    best.filter(|(several, _)| *several > 1).map(|(_, other)| other)
}

/// The sums and products, at most `most`, that compute a value from others that are `there`.
fn steps<K: Key>(
    program: &Program<K>,
    value: Value,
    most: usize,
    there: &SortedSet<Value>,
) -> Option<SortedSet<Value>> {
    let mut steps = SortedSet::from([value]);
    let mut open = vec![value];
    while let Some(step) = open.pop() {
        let op = &program.instr(step).op;
        let counted = steps.iter().filter(|step| program.instr(**step).op.is_counted());
        if !is_cheap(op) || counted.count() > most {
            return None;
        }
        let missing = |other: &Value| is_found_at_points(program, *other) && !there.contains(other);
        open.extend(op.operands().filter(missing).filter(|other| steps.insert(*other)));
    }
    Some(steps)
}

/// The values before a value, up to `most` sums and products away.
fn behind<K: Key>(program: &Program<K>, value: Value, most: usize) -> SortedSet<Value> {
    let op = &program.instr(value).op;
    let mut found = SortedSet::new();
    if most > 0 && is_cheap(op) {
        for operand in op.operands().filter(|operand| is_found_at_points(program, *operand)) {
            found.insert(operand);
            found.extend(behind(program, operand, most - 1));
        }
    }
    found
}

/// Whether a value has to be computed from a position.
fn is_found_at_points<K: Key>(program: &Program<K>, value: Value) -> bool {
    let instr = program.instr(value);
    instr.stage == Stage::Point && !matches!(instr.op, Op::Input(_))
}

/// Whether an operation takes no longer than a sum or a product.
fn is_cheap(op: &Op) -> bool {
    matches!(op, Op::Add(..) | Op::Subtract(..) | Op::Multiply(..) | Op::Negate(_))
}

/// Whether the stages that `roots` need should be separate loops, each with a shorter chain of dependent operations. That pays
/// if both have enough to compute.
pub fn is_worth_two<K: Key>(program: &Program<K>, roots: &[Value]) -> bool {
    let needed = program.needed_for(roots.iter().copied());
    [Stage::Point, Stage::PointTime].into_iter().all(|stage| {
        let work = program.range(stage).filter(|index| needed[*index]);
        work.map(|index| weight(&program.instrs[index].op)).sum::<usize>() >= WORTH_A_LOOP
    })
}

/// The time of an operation, in sums or products: roughly, and for vectors.
fn weight(op: &Op) -> usize {
    match op {
        Op::Constant(_) | Op::Pi | Op::Input(_) | Op::Negate(_) => 0,
        Op::Add(..) | Op::Subtract(..) | Op::Multiply(..) => 1,
        Op::Divide(..) => 10,
        Op::Unary(..) | Op::Binary(..) => 20,
    }
}
