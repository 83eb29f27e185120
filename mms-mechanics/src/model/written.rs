//! The formulas of a field as written: the canonical form of each, and each of its steps.
//!
//! Canonical form cancels terms, and derivatives do not show cuts. So the formulas of a file are stored beside their canonical
//! form.

use super::Reader;
use crate::resolve::WrittenOperation;
use mms_spec::source::Span;
use mms_spec::syntax::{Ast, NodeKind};
use mms_symbolic::expr::Expr;
use mms_symbolic::sorted::SortedSet;

/// The formulas of which all quantities are made.
#[derive(Clone, Debug, Default)]
pub struct Written {
    /// u, the density, the arguments of the material, the fibres and the rigid motion.
    pub field: Part,
    /// W, as a function of the invariants and of the arguments.
    pub energy: Part,
}

/// Some formulas, and the steps of all formulas that they use.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// The formulas, and their places in the file.
    pub formulas: Vec<(Expr, Span)>,
    /// The steps in order: each one follows the steps that it needs.
    pub steps: Vec<WrittenOperation>,
}

/// A formula that was read.
pub(super) struct Read {
    /// The name that the formula defines.
    name: Option<String>,
    /// The names that the formula uses.
    uses: Vec<String>,
    value: Expr,
    span: Span,
    steps: Vec<WrittenOperation>,
}

impl Read {
    pub fn new(ast: &Ast, value: Expr, span: Span, steps: Vec<WrittenOperation>) -> Self {
        let name = |kind: &NodeKind| match kind {
            NodeKind::Name(name) => Some(name.clone()),
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

    /// All formulas read so far that are used.
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
