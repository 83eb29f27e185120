//! Splits the computation of a quantity at many points into two loops over a block of them, and decides which
//! numbers of a point are kept in memory. The decision is made once, for compiled code and for programs that are
//! run in blocks.
//!
//! What needs X alone and what needs t as well are two loops where both have something to do. A number that the
//! first one hands on, or that is kept of a point, is written once and read every time. So sums and products of
//! numbers that are there anyway are computed where they are read; and where several can be made of one number,
//! that is handed on in their place.

use crate::program::{Key, Op, Program, Value};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::Symbol;
use mms_symbolic::sorted::SortedSet;

/// How many sums and products a number is worth that one loop over points leaves to the next one.
pub const WORTH_IN_CACHE: usize = 1;

/// The same of a number that is kept of a point and comes from memory.
pub const WORTH_IN_MEMORY: usize = 3;

/// What a loop has to do at least, as [`weight`] counts.
const WORTH_A_LOOP: usize = 20;

/// What a function of a point takes from what was found of the point before.
#[derive(Clone, Debug)]
pub struct Columns {
    /// Coordinates, by axis.
    pub axes: Vec<usize>,
    /// Values of the stage Point.
    pub values: Vec<Value>,
}

impl Columns {
    /// How many there are.
    pub fn count(&self) -> usize {
        self.axes.len() + self.values.len()
    }

    /// What `roots` need of the stage Point; something, so that a batch has a length.
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

/// What a function of a point starts from.
pub struct Cut {
    /// What it reads: coordinates, and values that were found before.
    pub columns: Columns,
    /// What it makes of those, operands first.
    pub made: Vec<Value>,
}

impl Cut {
    /// What is taken in place of these columns, where a number is `worth` so many operations.
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

/// The number of which most of those that are `taken` could be made, if more than one.
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

/// The sums and products, no more than `most`, that make a value of others that are `there`.
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

/// What comes before a value, up to so many sums and products.
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

/// Whether the stages that `roots` need are loops of their own: each then has a shorter chain of operations that wait for
/// each other. That pays where both have something to do.
pub fn is_worth_two<K: Key>(program: &Program<K>, roots: &[Value]) -> bool {
    let needed = program.needed_for(roots.iter().copied());
    [Stage::Point, Stage::PointTime].into_iter().all(|stage| {
        let work = program.range(stage).filter(|index| needed[*index]);
        work.map(|index| weight(&program.instrs[index].op)).sum::<usize>() >= WORTH_A_LOOP
    })
}

/// How long an operation takes, in sums or products: roughly, and of vectors.
fn weight(op: &Op) -> usize {
    match op {
        Op::Constant(_) | Op::Pi | Op::Input(_) | Op::Negate(_) => 0,
        Op::Add(..) | Op::Subtract(..) | Op::Multiply(..) => 1,
        Op::Divide(..) => 10,
        Op::Unary(..) | Op::Binary(..) => 20,
    }
}
