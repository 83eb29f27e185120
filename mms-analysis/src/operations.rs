//! Operation counts of quantities, before and after simplification.

use mms_codegen::compile::Compiled;
use mms_mechanics::Derivation;
use mms_program::schedule::{cost, schedule, schedule_plainly};
use mms_program::{Op, Program, Stage, unary_name};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Expr;
use mms_symbolic::pass::half_turns::half_turns;
use mms_symbolic::sorted::SortedMap;

/// The number of scalar operations of the program of some quantities: + - * / and each call of a function count one; constants,
/// loads and changes of sign count none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operations {
    /// The number for the expressions as derived, in which equal expressions are computed once.
    pub before: usize,
    /// The number for the chosen expressions, with common subexpressions extracted.
    pub after: usize,
    /// The number after simplification, stage by stage.
    pub by_stage: SortedMap<Stage, usize>,
    /// The number after simplification by kind: `add`, `multiply`, `sin`, ...; no entry is 0.
    pub by_kind: SortedMap<&'static str, usize>,
}

impl Operations {
    /// Counts the operations that compute all of `quantities` together.
    pub fn of(compiled: &Compiled, quantities: &[Quantity]) -> Self {
        let components = |derivation: &Derivation| -> Vec<Expr> {
            quantities
                .iter()
                .flat_map(|quantity| &derivation.quantities[quantity])
                .copied()
                .collect()
        };
        let (derived, chosen) = (components(&compiled.derived), components(&compiled.derivation));
        let before = schedule_plainly(&compiled.graph, &SortedMap::from([((), derived.clone())]));
        // The cheapest form for each quantity alone may not be the cheapest for all.
        let forms = [chosen, derived];
        let cheapest = forms.into_iter().min_by_key(|form| cost(&compiled.graph, form));
        let mut graph = compiled.graph.clone();
        graph.make_room();
        let outputs = half_turns(&mut graph, &cheapest.unwrap_or_default());
        let after = schedule(&graph, &SortedMap::from([((), outputs)]));
        Operations {
            before: before.operations(&[()]).values().sum(),
            after: after.operations(&[()]).values().sum(),
            by_stage: after.operations(&[()]),
            by_kind: by_kind(&after),
        }
    }
}

fn by_kind(program: &Program<()>) -> SortedMap<&'static str, usize> {
    let mut counts = SortedMap::new();
    for instr in program.instrs.iter().filter(|instr| instr.op.is_counted()) {
        let kind = match instr.op {
            Op::Constant(_) | Op::Pi | Op::Input(_) | Op::Negate(_) => continue,
            Op::Add(..) => "add",
            Op::Subtract(..) => "subtract",
            Op::Multiply(..) => "multiply",
            Op::Divide(..) => "divide",
            Op::Unary(function, small, _) => unary_name(function, small),
            Op::Binary(function, ..) => function.name(),
        };
        *counts.get_or_default(kind) += 1;
    }
    counts
}
