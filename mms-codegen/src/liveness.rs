//! The values that a stage stores for the next ones.

use mms_mechanics::{Output, Program};
use mms_program::{Op, Stage, Value};
use mms_symbolic::expr::Symbol;

/// The readers of each value, among the instructions that some outputs need.
pub struct Later<'a> {
    program: &'a Program,
    /// The values that are results. If this is empty, `kept` returns only the values that are read.
    pub outputs: Vec<Value>,
    needed: Vec<bool>,
}

impl<'a> Later<'a> {
    /// Prepares the readers for the wanted outputs.
    pub fn new(program: &'a Program, of: impl Fn(&Output) -> bool) -> Self {
        let outputs: Vec<Output> = program.outputs.keys().copied().filter(of).collect();
        let needed = program.needed(&outputs);
        let outputs = outputs.iter().flat_map(|output| &program.outputs[output]).copied().collect();
        Later { program, outputs, needed }
    }

    /// The values of the stages `written` that the stages `reading` read, or that are outputs: the members of a struct.
    /// Constants are literals, and arguments are passed on.
    pub fn kept(&self, written: &[Stage], reading: &[Stage]) -> Vec<bool> {
        let mut kept = vec![false; self.program.instrs.len()];
        for (instr, needed) in self.program.instrs.iter().zip(&self.needed) {
            if *needed && reading.contains(&instr.stage) {
                instr.op.operands().for_each(|operand| kept[operand.index()] = true);
            }
        }
        self.outputs.iter().for_each(|value| kept[value.index()] = true);
        for (kept, instr) in kept.iter_mut().zip(&self.program.instrs) {
            let free =
                matches!(instr.op, Op::Constant(_) | Op::Pi | Op::Input(Symbol::Coordinate(_)));
            *kept &= written.contains(&instr.stage) && !free;
        }
        kept
    }

    /// The values that [`Later::kept`] marks.
    pub fn kept_values(&self, written: &[Stage], reading: &[Stage]) -> Vec<Value> {
        let kept = self.kept(written, reading);
        (0..kept.len()).filter(|index| kept[*index]).map(|index| Value(index as u32)).collect()
    }
}
