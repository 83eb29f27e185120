//! Finds the part of a field file that makes a derivation too large. The caret of that message points at it.
//!
//! A full graph returns no result. The message names the quantity, the part of the file that makes most of the nodes, the
//! number of nodes, and the remedy. A part is measured by the sizes of its derivatives, up to the second, since all quantities
//! are made of them. Trials in graphs of their own start at the largest component of u and descend, to a definition that it
//! uses or to an operand, as long as that part alone makes most of the nodes. Trials are bounded in size and number.

use mms_mechanics::resolve::Scope;
use mms_spec::source::Span;
use mms_spec::syntax;
use mms_spec::syntax::{Ast, NodeKind, Operator};
use mms_spec::{FieldSpec, Formula, RigidSpec, Space};
use mms_symbolic::expr::{Graph, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::sorted::SortedSet;

/// The largest graph of a trial: enough to distinguish sizes.
const TRIAL: usize = 20_000;

/// The largest number of definitions that are tried.
const TRIALS: usize = 20;

/// The part of a field that makes most of the nodes of a derivation.
#[derive(Clone, Debug, PartialEq)]
pub struct Culprit {
    /// The place of the part: a sub-expression of a formula, or the whole formula.
    pub span: Span,
    /// The definition that contains the part: a name, or a component of u.
    pub definition: String,
}

/// A formula that u may depend on.
struct Definition<'a> {
    /// The name of the formula in later ones, if it has one.
    name: Option<&'a str>,
    shown: String,
    formula: &'a Formula,
    ast: Ast,
}

/// Finds the part that makes most of the nodes; `None` if a formula cannot be read.
pub fn culprit(field: &FieldSpec) -> Option<Culprit> {
    let definitions = definitions(field)?;
    let trial = Trial::new(field, &definitions);
    let components = field.lets.len()..definitions.len();
    let (mut size, mut index) =
        components.map(|index| (trial.size(index), index)).max_by_key(|(size, _)| *size)?;
    let mut tried = SortedSet::new();
    while let Some(larger) = trial.used(index).find_map(|used| {
        let new = tried.len() < TRIALS && tried.insert(used);
        let own = if new { trial.size(used) } else { 0 };
        (2 * own > size).then_some((own, used))
    }) {
        (size, index) = larger;
    }
    let span = trial.sub_expression(index, size).unwrap_or(definitions[index].formula.span);
    Some(Culprit { span, definition: definitions[index].shown.clone() })
}

/// The formulas in the order of the file, up to the displacement, and then the formulas of a rigid motion.
fn definitions(field: &FieldSpec) -> Option<Vec<Definition<'_>>> {
    let lets = field.lets.iter().map(|definition| {
        let name = definition.name.value.as_str();
        (Some(name), format!("`{name}`"), &definition.value)
    });
    let components = field.displacement.iter().enumerate();
    let components =
        components.map(|(axis, formula)| (None, component(field.space, axis), formula));
    let motion = field.rigid.iter().flat_map(RigidSpec::formulas);
    let motion = motion.map(|formula| (None, "the rigid motion".to_string(), formula));
    lets.chain(components)
        .chain(motion)
        .map(|(name, shown, formula)| {
            let ast = syntax::parse(formula, &mut Vec::new())?;
            Some(Definition { name, shown, formula, ast })
        })
        .collect()
}

/// The first of `count` positions where `holds` is true, if it is true at the last one; once true, it must stay true.
fn first(count: usize, holds: impl Fn(usize) -> bool) -> Option<usize> {
    let (mut from, mut to) = (0, count);
    while from < to {
        let middle = from.midpoint(to);
        if holds(middle) { to = middle } else { from = middle + 1 }
    }
    (from < count).then_some(from)
}

struct Trial<'a> {
    definitions: &'a [Definition<'a>],
    /// All definitions as expressions.
    graph: Graph,
    scope: Scope,
}

impl<'a> Trial<'a> {
    fn new(field: &FieldSpec, definitions: &'a [Definition<'a>]) -> Self {
        let mut graph = Graph::default();
        let mut scope = scope(&mut graph, field);
        for definition in definitions {
            if let Some(name) = definition.name {
                let value = scope.resolve(&mut graph, &definition.ast, &mut Vec::new());
                scope.define(name, value);
            }
        }
        Trial { definitions, graph, scope }
    }

    /// The number of nodes and operands of the derivatives of a definition, at most about [`TRIAL`].
    fn size(&self, index: usize) -> usize {
        self.size_of_derivatives(&self.definitions[index].ast)
    }

    /// The number of nodes and operands of the derivatives of an expression that kinematics needs.
    fn size_of_derivatives(&self, ast: &Ast) -> usize {
        let mut graph = self.graph.clone();
        let before = graph.size();
        graph.set_limit(before + TRIAL);
        let value = self.scope.resolve(&mut graph, ast, &mut Vec::new());
        for (symbol, again) in SYMBOLS.iter().flat_map(|a| SYMBOLS.iter().map(move |b| (*a, *b))) {
            // v and its gradient are not differentiated further.
            let needed = (again == Symbol::Time) == (symbol == Symbol::Time);
            if let Some(value) = value
                && needed
                && !graph.is_exhausted()
            {
                let once = differentiate(&mut graph, &[value], symbol);
                differentiate(&mut graph, &once, again);
            }
        }
        graph.size() - before
    }

    /// The definitions that a definition uses, the last one first.
    fn used(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let names: SortedSet<&str> = self.definitions[index]
            .ast
            .nodes
            .iter()
            .filter_map(|node| match &node.kind {
                NodeKind::Name(name) => Some(name.as_str()),
                _ => None,
            })
            .collect();
        let is_used =
            move |definition: &Definition| definition.name.is_some_and(|name| names.contains(name));
        (0..index).rev().filter(move |used| is_used(&self.definitions[*used]))
    }

    /// The place of the smallest sub-expression of a definition that makes most of its nodes: the last such operand of the
    /// chain.
    fn sub_expression(&self, index: usize, own: usize) -> Option<Span> {
        let ast = &self.definitions[index].ast;
        let mut root = ast.nodes.len() - 1;
        let mut chain = vec![root];
        // The operand with the most nodes of its own tree; those trees shrink on the way down.
        while let Some(next) =
            links(ast, root).into_iter().max_by_key(|operand| operand - start(ast, *operand))
        {
            chain.push(next);
            root = next;
        }
        let most =
            |node: usize| 4 * self.size_of_derivatives(&Ast { nodes: part(ast, node) }) > 3 * own;
        // Each operand down the chain makes fewer nodes.
        let too_small = first(chain.len(), |position| !most(chain[position]));
        let node = too_small.map_or(chain.len(), |position| position).checked_sub(1)?;
        Some(ast.nodes[chain[node]].span)
    }
}

const SYMBOLS: [Symbol; 4] =
    [Symbol::Coordinate(0), Symbol::Coordinate(1), Symbol::Coordinate(2), Symbol::Time];

/// The name of a component of the displacement.
fn component(space: Space, axis: usize) -> String {
    match (space, axis) {
        (Space::Axisymmetric { .. }, 2) => "the swirl".into(),
        _ => format!("component {} of u", axis + 1),
    }
}

/// The names of a field without its definitions.
fn scope(graph: &mut Graph, field: &FieldSpec) -> Scope {
    let mut scope = Scope::default();
    let (pi, time) = (graph.pi(), graph.symbol(Symbol::Time));
    scope.define("pi", Some(pi));
    scope.define("t", Some(time));
    for (axis, name) in field.space.axes().iter().enumerate() {
        let value = graph.symbol(Symbol::Coordinate(axis));
        scope.define(name, Some(value));
    }
    for (index, parameter) in field.parameters.iter().enumerate() {
        let symbol = Symbol::Parameter(index);
        // The file itself was accepted, including its assumption that this is positive.
        scope.assume_positive(symbol);
        let value = graph.symbol(symbol);
        scope.define(&parameter.name.value, Some(value));
    }
    scope
}

fn operands(kind: &NodeKind) -> Vec<usize> {
    match kind {
        NodeKind::Number(_) | NodeKind::Name(_) => Vec::new(),
        NodeKind::Negate(operand) => vec![*operand],
        NodeKind::Binary(_, left, right) => vec![*left, *right],
        NodeKind::Call { arguments, .. } => arguments.clone(),
    }
}

/// The operands of a node. A chain such as a*b*c is one product of three: no part of it is to blame for the length of the
/// chain.
fn links(ast: &Ast, root: usize) -> Vec<usize> {
    let NodeKind::Binary(operator, mut left, right) = ast.nodes[root].kind else {
        return operands(&ast.nodes[root].kind);
    };
    let is_sum = |operator| matches!(operator, Operator::Add | Operator::Subtract);
    let mut links = vec![right];
    while operator != Operator::Power
        && let NodeKind::Binary(inner, further, last) = ast.nodes[left].kind
        && inner != Operator::Power
        && is_sum(inner) == is_sum(operator)
    {
        links.push(last);
        left = further;
    }
    links.push(left);
    links
}

/// The first node of the tree whose root is at index `root`: a tree is contiguous.
fn start(ast: &Ast, mut root: usize) -> usize {
    while let Some(first) = operands(&ast.nodes[root].kind).into_iter().min() {
        root = first;
    }
    root
}

/// The nodes of the tree whose root is at index `root`.
fn part(ast: &Ast, root: usize) -> Vec<syntax::Node> {
    let start = start(ast, root);
    let mut nodes = ast.nodes[start..=root].to_vec();
    for node in &mut nodes {
        match &mut node.kind {
            NodeKind::Number(_) | NodeKind::Name(_) => {}
            NodeKind::Negate(operand) => *operand -= start,
            NodeKind::Binary(_, left, right) => {
                *left -= start;
                *right -= start;
            }
            NodeKind::Call { arguments, .. } => {
                arguments.iter_mut().for_each(|argument| *argument -= start);
            }
        }
    }
    nodes
}
