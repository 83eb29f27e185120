//! Divisions: they take as long as ten to thirty products, so that a loop over points does several
//! together, and divides by a square root without finding the root first.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::Function;
use crate::program::{Op, Program, Value};

/// The product of more denominators may leave the range of a number.
const MAX_TOGETHER: usize = 6;

/// What a function does next, by positions in a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// One instruction.
    One(usize),
    /// Divisions of which none needs another.
    Together(Vec<usize>),
}

/// The instructions of a function in an order in which what can be divided together is.
pub(super) fn steps(program: &Program, computed: &[bool]) -> Vec<Step> {
    let groups = groups(program, computed);
    let mut group_of = BTreeMap::new();
    for group in &groups {
        group_of.extend(group.iter().map(|member| (*member, group)));
    }
    let mut done: Vec<bool> = computed.iter().map(|computed| !computed).collect();
    let mut left: Vec<usize> = (0..computed.len()).filter(|index| computed[*index]).collect();
    let mut steps = Vec::with_capacity(left.len());
    while !left.is_empty() {
        for index in core::mem::take(&mut left) {
            let ready = |index: &usize| {
                let mut operands = program.instrs[*index].op.operands();
                operands.all(|operand| done[operand.index()])
            };
            let members = group_of.get(&index).map_or(&[][..], |group| group.as_slice());
            if done[index] {
                continue;
            }
            if !ready(&index) || !members.iter().all(ready) {
                left.push(index);
                continue;
            }
            done[index] = true;
            members.iter().for_each(|member| done[*member] = true);
            steps.push(match members {
                [] => Step::One(index),
                members => Step::Together(members.to_vec()),
            });
        }
    }
    steps
}

/// The square roots that are computed here and divided by here.
pub(super) fn roots_below(program: &Program, computed: &[bool]) -> BTreeSet<Value> {
    let divided_by = (0..computed.len()).filter_map(|index| match program.instrs[index].op {
        Op::Divide(_, below) if computed[index] && computed[below.index()] => Some(below),
        _ => None,
    });
    let is_root = |value: &Value| matches!(program.instr(*value).op, Op::Unary(Function::Sqrt, _));
    divided_by.filter(is_root).collect()
}

/// Divisions that need as many divisions before them: none of them needs another.
fn groups(program: &Program, computed: &[bool]) -> Vec<Vec<usize>> {
    let roots = roots_below(program, computed);
    let divides = |index: usize| match program.instrs[index].op {
        Op::Divide(_, below) => computed[index] && !roots.contains(&below),
        _ => false,
    };
    let mut before = vec![0_usize; computed.len()];
    let mut levels = BTreeMap::<usize, Vec<usize>>::new();
    for index in (0..computed.len()).filter(|index| computed[*index]) {
        let count =
            |operand: Value| before[operand.index()] + usize::from(divides(operand.index()));
        before[index] = program.instrs[index].op.operands().map(count).max().unwrap_or(0);
        if divides(index) {
            levels.entry(before[index]).or_default().push(index);
        }
    }
    let groups = levels.values().flat_map(|level| level.chunks(MAX_TOGETHER));
    groups.filter(|group| group.len() > 1).map(<[usize]>::to_vec).collect()
}
