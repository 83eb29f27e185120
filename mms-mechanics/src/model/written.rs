//! The formulas of a field as they are written: what canonical form made of each, and each step of it.
//!
//! Canonical form cancels, and derivatives know of no cut. What a file says is therefore kept beside what is made of it.

use super::Reader;
use crate::resolve::Step;
use mms_spec::source::Span;
use mms_spec::syntax::{Ast, Kind};
use mms_symbolic::expr::Expr;
use mms_symbolic::sorted::SortedSet;

/// What all quantities of a field are made of.
#[derive(Clone, Debug, Default)]
pub struct Written {
    /// u, the density, the arguments of the material, the fibres and the rigid motion.
    pub field: Part,
    /// W, as a function of the invariants and of the arguments.
    pub energy: Part,
}

/// Some formulas, and the steps of all that they use.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// What they are, and where they stand.
    pub formulas: Vec<(Expr, Span)>,
    /// In order: what a step needs stands before it.
    pub steps: Vec<Step>,
}

/// A formula that was read.
pub(super) struct Read {
    /// The name that it defines.
    name: Option<String>,
    /// The names that it uses.
    uses: Vec<String>,
    value: Expr,
    span: Span,
    steps: Vec<Step>,
}

impl Read {
    pub fn new(ast: &Ast, value: Expr, span: Span, steps: Vec<Step>) -> Self {
        let name = |kind: &Kind| match kind {
            Kind::Name(name) => Some(name.clone()),
            _ => None,
        };
        let uses = ast.nodes.iter().filter_map(|node| name(&node.kind)).collect();
        Read { name: None, uses, value, span, steps }
    }
}

impl Reader<'_> {
    /// Makes the formula that was read last the definition of a name.
    pub(super) fn definition_of(&mut self, name: &str) {
        if let Some(last) = self.read.last_mut() {
            last.name = Some(name.to_string());
        }
    }

    /// All that was read and is used.
    pub(super) fn written(&mut self) -> Written {
        let [field, energy] = [&mut self.read, &mut self.of_energy].map(std::mem::take);
        Written { field: Part::of(field), energy: Part::of(energy) }
    }
}

impl Part {
    /// The formulas that define nothing, and the definitions that they need.
    fn of(read: Vec<Read>) -> Self {
        let (mut part, mut needed) = (Part::default(), SortedSet::new());
        for Read { name, uses, value, span, steps } in read.into_iter().rev() {
            match &name {
                None => part.formulas.push((value, span)),
                Some(name) if needed.contains(name) => {}
                Some(_) => continue,
            }
            needed.extend(uses);
            part.steps.extend(steps.into_iter().rev());
        }
        part.formulas.reverse();
        part.steps.reverse();
        part
    }
}
