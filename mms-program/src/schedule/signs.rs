//! Changes of sign that cost nothing: -((a - b) c) is (b - a) c.

use super::Unnamed;
use crate::program::{Op, Value};
use mms_symbolic::sorted::SortedSet;

/// Reverses a difference if that saves a change of sign.
///
/// The sign is carried to the difference through products and quotients that nothing else reads. So every value is the same
/// number as before, or has the other sign and is read accordingly.
pub(super) fn carried(mut program: Unnamed) -> Unnamed {
    let mut readers = readers(&program);
    let mut differences: SortedSet<(Value, Value)> =
        program.instrs.iter().filter_map(|instr| difference(&instr.op)).collect();
    let mut renamed: Vec<Value> =
        (0..program.instrs.len()).map(|index| Value(index as u32)).collect();
    for index in 0..program.instrs.len() {
        program.instrs[index].op = program.instrs[index].op.map(|value| renamed[value.index()]);
        let Op::Negate(value) = program.instrs[index].op else { continue };
        let Some((place, [a, b])) = carrier(&program, &readers, value) else { continue };
        // A difference that exists already is not computed again.
        if differences.insert((b, a)) {
            differences.remove(&(a, b));
            program.instrs[place.index()].op = Op::Subtract(b, a);
            readers[value.index()] = readers[index];
            renamed[index] = value;
        }
    }
    for value in program.outputs.iter_mut().flatten() {
        *value = renamed[value.index()];
    }
    program
}

/// The number of instructions and outputs that read each value.
fn readers(program: &Unnamed) -> Vec<usize> {
    let mut readers = vec![0; program.instrs.len()];
    let operands = program.instrs.iter().flat_map(|instr| instr.op.operands());
    for value in operands.chain(program.outputs.iter().flatten().copied()) {
        readers[value.index()] += 1;
    }
    readers
}

fn difference(op: &Op) -> Option<(Value, Value)> {
    match *op {
        Op::Subtract(a, b) => Some((a, b)),
        _ => None,
    }
}

/// The difference that can change its sign instead of a value: the value itself, or a factor of it.
fn carrier(program: &Unnamed, readers: &[usize], value: Value) -> Option<(Value, [Value; 2])> {
    let mut open = vec![value];
    while let Some(value) = open.pop() {
        match program.instrs[value.index()].op {
            _ if readers[value.index()] > 1 => {}
            Op::Subtract(a, b) => return Some((value, [a, b])),
            Op::Multiply(a, b) | Op::Divide(a, b) => open.extend([b, a]),
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Instr;
    use mms_symbolic::expr::Stage;
    use mms_symbolic::expr::Symbol;

    /// x, y, x - y, (x - y) y and its negative, which is an output like these `others`.
    fn program(others: &[u32]) -> Unnamed {
        let [x, y, difference, product] = [0, 1, 2, 3].map(Value);
        let ops = [
            Op::Input(Symbol::Coordinate(0)),
            Op::Input(Symbol::Coordinate(1)),
            Op::Subtract(x, y),
            Op::Multiply(difference, y),
            Op::Negate(product),
        ];
        let values = [4].iter().chain(others).map(|index| Value(*index)).collect();
        Unnamed {
            instrs: ops.map(|op| Instr { op, stage: Stage::Point }).into(),
            outputs: vec![values],
        }
    }

    #[test]
    fn a_difference_that_nothing_else_reads_takes_the_sign() {
        let carried = carried(program(&[]));
        assert_eq!(carried.instrs[2].op, Op::Subtract(Value(1), Value(0)));
        assert_eq!(carried.outputs[0], [Value(3)]);
    }

    #[test]
    fn what_others_read_stays_as_it_is() {
        for other in [2, 3] {
            assert_eq!(carried(program(&[other])), program(&[other]));
        }
    }
}
