//! What quantities cost, before and after simplification.

use std::collections::BTreeMap;

use crate::compile::Compiled;
use crate::expr::Expr;
use crate::mechanics::Derivation;
use crate::pass::half_turns::half_turns;
use crate::program::schedule::{cost, schedule, schedule_plainly};
use crate::program::{Op, Output, Program, Stage};
use crate::quantity::Quantity;

/// The number of scalar operations of the program of some quantities: + - * / and each call of a
/// function count one; constants, loads and changes of sign none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operations {
    /// Of the expressions as they were derived, where only equal ones are computed once.
    pub before: usize,
    /// Of the expressions that were chosen, and what they share taken out.
    pub after: usize,
    /// The latter, stage by stage.
    pub by_stage: BTreeMap<Stage, usize>,
    /// The latter by what is done: `add`, `multiply`, `sin`, ...; no entry is 0.
    pub by_kind: BTreeMap<&'static str, usize>,
}

/// The name under which the components of all quantities are scheduled as one.
const TOGETHER: Output = Output::Expected(0);

impl Compiled {
    /// What it takes to compute all of `quantities` together.
    pub fn operations(&self, quantities: &[Quantity]) -> Operations {
        let components = |derivation: &Derivation| -> Vec<Expr> {
            quantities
                .iter()
                .flat_map(|quantity| &derivation.quantities[quantity])
                .copied()
                .collect()
        };
        let (derived, chosen) = (components(&self.derived), components(&self.derivation));
        let before = schedule_plainly(&self.graph, &BTreeMap::from([(TOGETHER, derived.clone())]));
        // What is cheapest for each alone need not be so together.
        let forms = [chosen, derived];
        let cheapest = forms.into_iter().min_by_key(|form| cost(&self.graph, form));
        let mut graph = self.graph.clone();
        graph.make_room();
        let outputs = half_turns(&mut graph, &cheapest.unwrap_or_default());
        let after = schedule(&graph, &BTreeMap::from([(TOGETHER, outputs)]));
        Operations {
            before: before.operations(&[TOGETHER]).values().sum(),
            after: after.operations(&[TOGETHER]).values().sum(),
            by_stage: after.operations(&[TOGETHER]),
            by_kind: by_kind(&after),
        }
    }
}

fn by_kind(program: &Program) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for instr in program.instrs.iter().filter(|instr| instr.op.is_counted()) {
        let kind = match instr.op {
            Op::Constant(_) | Op::Pi | Op::Input(_) | Op::Negate(_) => continue,
            Op::Add(..) => "add",
            Op::Subtract(..) => "subtract",
            Op::Multiply(..) => "multiply",
            Op::Divide(..) => "divide",
            Op::Unary(function, _) | Op::Binary(function, ..) => function.name(),
        };
        *counts.entry(kind).or_default() += 1;
    }
    counts
}
