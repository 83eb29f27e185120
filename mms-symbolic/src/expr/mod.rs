//! The expression graph: exact, hash-consed, canonical.
//!
//! An arena holds the nodes. A structure exists once, and its handle [`Expr`] is a number. Operands are made before their users
//! and nodes never change, so handles order topologically, and every pass is a loop over handles rather than a recursion. The
//! hash index is only used for look-ups, never iterated. Results of a full graph are meaningless, and its users refuse them.
//!
//! | node | canonical form |
//! |---|---|
//! | `Number` | an exact rational |
//! | `Pi`, `Symbol` | a leaf: parameter, t, X_J, N_J, H_iJ, invariant |
//! | `Sum` | a constant plus terms with non-zero coefficients, in order of handles; no term is a number or a sum |
//! | `Product` | bases with non-zero exact exponents, in order of handles; nested products are opened, numbers folded where the power is rational |
//! | `Call` | an elementary function |
//! | `Offset` | a coordinate minus a place, computed as one subtraction: as exact as the coordinate |
//! | `Small` | an angle with the proved bound of its magnitude; equal to the angle, and used by the scheduler only |
//!
//! Sums and products have any number of operands, so that equal expressions written in different order are one node.
//! Subtraction is a coefficient, division an exponent, a square root the exponent 1/2. As one of several factors, a sum is
//! normalised: a rational number goes to the coefficient, so that its first coefficient is positive and as many as possible are
//! 1 or -1. So 2 a - 2 b and b - a share a node.

mod build;
mod function;
pub mod print;
mod stage;

use std::hash::BuildHasher;

pub use build::steps_of_length;
use dashu_int::Sign;
pub use dashu_ratio::RBig as Rational;
pub use function::{Function, Small};
use hashbrown::HashTable;
use rustc_hash::{FxBuildHasher, FxHashMap};
pub use stage::Stage;

use crate::sorted::{SortedMap, SortedSet};
use crate::work::{Stop, Work};

/// A handle to a node of one [`Graph`]; smaller handles never depend on larger ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Expr(u32);

impl Expr {
    /// The position of the node in its graph.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A leaf on which expressions depend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Symbol {
    /// The parameter at this position in the field file.
    Parameter(usize),
    /// The time t.
    Time,
    /// The reference coordinate X_J.
    Coordinate(usize),
    /// The component N_J of a reference unit normal.
    Normal(usize),
    /// The component H_iJ of a displacement gradient that the caller supplies.
    Gradient(usize, usize),
    /// A strain invariant less its value at F = I; used only inside a material's density, and for bounds of a stress.
    Invariant(usize),
    /// A name for the private use of code that works with a graph; no field and no program has it.
    Local(usize),
}

/// An operation and its operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact rational number.
    Number(Rational),
    /// The circle's half circumference over its radius.
    Pi,
    /// A leaf.
    Symbol(Symbol),
    /// A constant plus terms with non-zero coefficients, in order of their handles. No term is a
    /// number or a sum.
    Sum(Rational, Vec<(Expr, Rational)>),
    /// Bases with non-zero exponents, in order of their handles. No base is a product under an
    /// integer exponent, and none is a number unless its power is irrational.
    Product(Vec<(Expr, Rational)>),
    /// An elementary function.
    Call(Function, Vec<Expr>),
    /// A coordinate less the place that a field is about.
    Offset([Expr; 2]),
    /// An angle that is proved to be small.
    Small(Small, Expr),
}

/// 1/2.
pub const HALF: Rational = Rational::from_parts_const(Sign::Positive, 1, 2);

/// |number|.
pub fn magnitude(number: &Rational) -> Rational {
    if is_negative(number) { -number.clone() } else { number.clone() }
}

/// Whether a number is 1 or -1.
pub fn is_unit(number: &Rational) -> bool {
    number.is_one() || *number == Rational::NEG_ONE
}

/// Whether a number is below 0; does not multiply, as a comparison would.
pub fn is_negative(number: &Rational) -> bool {
    number.sign() == Sign::Negative
}

impl Node {
    /// The operands.
    pub fn children(&self) -> impl Iterator<Item = Expr> + '_ {
        let (weighted, plain): (&[(Expr, Rational)], &[Expr]) = match self {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => (&[], &[]),
            Node::Sum(_, terms) => (terms, &[]),
            Node::Product(factors) => (factors, &[]),
            Node::Call(_, arguments) => (&[], arguments),
            Node::Offset(operands) => (&[], operands),
            Node::Small(_, angle) => (&[], std::slice::from_ref(angle)),
        };
        weighted.iter().map(|(child, _)| *child).chain(plain.iter().copied())
    }
}

impl Node {
    /// Replaces every operand.
    pub fn map_children(&mut self, mut replace: impl FnMut(Expr) -> Expr) {
        match self {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum(_, weighted) | Node::Product(weighted) => {
                weighted.iter_mut().for_each(|(child, _)| *child = replace(*child));
            }
            Node::Call(_, arguments) => {
                arguments.iter_mut().for_each(|child| *child = replace(*child));
            }
            Node::Offset(operands) => *operands = operands.map(replace),
            Node::Small(_, angle) => *angle = replace(*angle),
        }
    }
}

/// The largest size of a graph by default: nodes and operands together. A rotating 3-D field needs a few thousand.
pub const DEFAULT_MAX_NODES: usize = 200_000;

/// The steps of making or finding a node.
pub const STEPS_OF_NODE: u64 = 20;
/// The further steps for each operand of the node.
const STEPS_OF_OPERAND: u64 = 10;

/// An arena of hash-consed nodes, of bounded size.
///
/// Beyond the limit every operation returns at once an expression without a value, [`Graph::is_exhausted`] returns true, and
/// all results are meaningless. So no text makes a compilation long or large.
#[derive(Clone, Debug)]
pub struct Graph {
    nodes: Vec<Node>,
    /// The stage at which the value of each node is known.
    stages: Vec<Stage>,
    /// The nodes by their hashes. Only ever looked up, never iterated: hash order cannot be observed.
    index: HashTable<Expr>,
    /// The results of [`Graph::split_content`] so far.
    contents: FxHashMap<Expr, (Rational, Expr)>,
    /// Nodes and operands so far.
    size: usize,
    limit: usize,
    exhausted: bool,
    /// The number of nodes when the graph became exhausted.
    made: usize,
    /// The remaining budget.
    work: Work,
}

/// The hash by which a node is found.
fn hash(node: &Node) -> u64 {
    FxBuildHasher.hash_one(node)
}

/// The content of a graph at some time.
struct Mark {
    nodes: usize,
    size: usize,
    exhausted: bool,
}

impl Default for Graph {
    fn default() -> Self {
        Self::with_limit(DEFAULT_MAX_NODES)
    }
}

impl Graph {
    /// An empty graph of at most `limit` nodes and operands.
    pub fn with_limit(limit: usize) -> Self {
        let (nodes, stages, index) = (Vec::new(), Vec::new(), HashTable::new());
        let mut graph = Graph {
            nodes,
            stages,
            index,
            contents: FxHashMap::default(),
            size: 0,
            limit,
            exhausted: false,
            made: 0,
            work: Work::new(Stop::default()),
        };
        graph.intern(Node::Number(Rational::ZERO));
        graph
    }

    /// Whether the graph has outgrown its limit; then none of its expressions has a meaning.
    pub fn is_exhausted(&self) -> bool {
        self.exhausted
    }

    /// The limit of nodes and operands.
    pub fn limit(&self) -> usize {
        self.limit
    }

    /// Changes the limit of nodes and operands.
    pub fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }

    /// The remaining budget of work; when it is spent, no node can be made.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// Sets a budget of work that ends on request.
    pub fn stopped_by(mut self, stop: &Stop) -> Self {
        self.work = Work::new(stop.clone());
        self
    }

    /// The number of nodes and operands so far.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The help for a message about a full graph: the cause, and the remedy.
    pub fn exhaustion(&self) -> Vec<String> {
        if self.work.is_over() {
            return vec![
                "it takes more steps than the bound allows: write it in a shorter form, with fewer functions within each other".into(),
                "`mms ... --max-nodes N` raises that bound too; `field!` keeps the default".into(),
            ];
        }
        if self.size <= self.limit {
            return vec![
                "exact numbers become too long in it: use fewer digits or lower powers".into(),
            ];
        }
        let (nodes, operands) = (self.made, self.size - self.made);
        vec![
            format!(
                "{nodes} nodes with {operands} operands were made; the bound is {} of both",
                self.limit
            ),
            "it makes very many terms: write it in a shorter form".into(),
            "`mms ... --max-nodes N` raises the bound; `field!` keeps the default".into(),
        ]
    }

    /// Raises the limit by the present size and the default limit, so that a few more nodes fit into a graph that was within
    /// its limit.
    pub fn make_room(&mut self) {
        self.limit += self.size + DEFAULT_MAX_NODES;
    }

    /// Runs `make`. If it reaches the limit, restores the graph, and returns `None`.
    pub fn attempt<R>(&mut self, make: impl FnOnce(&mut Self) -> R) -> Option<R> {
        let before = self.mark();
        if self.work.is_over() && !before.exhausted {
            return None;
        }
        let made = make(self);
        if before.exhausted || !self.exhausted {
            return Some(made);
        }
        self.back_to(before);
        None
    }

    /// Runs `work`. If it reaches the limit, restores the graph; the caller must recognise this from the result.
    pub fn restoring_if_full<R>(&mut self, work: impl FnOnce(&mut Self) -> R) -> R {
        let before = self.mark();
        let found = work(self);
        if self.exhausted && !before.exhausted {
            self.back_to(before);
        }
        found
    }

    /// Runs `work` with a raised limit, and then removes the nodes that it made.
    pub fn with_temporary_nodes<R>(&mut self, work: impl FnOnce(&mut Self) -> R) -> R {
        let (before, limit) = (self.mark(), self.limit);
        self.make_room();
        let found = work(self);
        self.limit = limit;
        self.back_to(before);
        found
    }

    fn mark(&self) -> Mark {
        Mark { nodes: self.nodes.len(), size: self.size, exhausted: self.exhausted }
    }

    /// Removes all nodes made since the mark.
    fn back_to(&mut self, Mark { nodes, size, exhausted }: Mark) {
        for (place, node) in self.nodes.iter().enumerate().skip(nodes) {
            if let Ok(entry) = self.index.find_entry(hash(node), |expr| expr.index() == place) {
                entry.remove();
            }
        }
        self.nodes.truncate(nodes);
        self.stages.truncate(nodes);
        self.contents.clear();
        (self.size, self.exhausted) = (size, exhausted);
    }

    /// The handle of a canonical node, if it exists.
    pub fn find(&self, node: &Node) -> Option<Expr> {
        self.find_hashed(node, hash(node))
    }

    fn find_hashed(&self, node: &Node, hash: u64) -> Option<Expr> {
        self.index.find(hash, |expr| self.node(*expr) == node).copied()
    }

    /// The expression that replaces every other one in an exhausted graph: ln(-1), which has no value in any arithmetic. So an
    /// evaluation of it is undefined, and never 0.
    fn exhaust(&mut self) -> Expr {
        if !self.exhausted {
            (self.exhausted, self.made) = (true, self.nodes.len());
        }
        let number = self.enter(Node::Number(Rational::NEG_ONE));
        self.enter(Node::Call(Function::Ln, vec![number]))
    }

    /// The node behind a handle.
    pub fn node(&self, expr: Expr) -> &Node {
        &self.nodes[expr.index()]
    }

    /// The stage at which the value of an expression is known.
    pub fn stage(&self, expr: Expr) -> Stage {
        self.stages[expr.index()]
    }

    /// The number of nodes so far.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether the graph has no nodes.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The one handle of a canonical node; the node is made if it does not exist.
    fn intern(&mut self, node: Node) -> Expr {
        self.work.spend(STEPS_OF_NODE + STEPS_OF_OPERAND * node.children().count() as u64);
        if self.work.is_over() {
            return self.exhaust();
        }
        let own_hash = hash(&node);
        if let Some(expr) = self.find_hashed(&node, own_hash) {
            return expr;
        }
        self.size += 1 + node.children().count();
        // Handles are 32 bits wide; two of them are reserved for the nodes of ln(-1).
        let is_full = self.size > self.limit.min(u32::MAX as usize - 2);
        if is_full && !self.nodes.is_empty() {
            return self.exhaust();
        }
        self.enter_new(node, own_hash)
    }

    /// The handle of a node, which is made if it does not exist, even beyond the limit.
    fn enter(&mut self, node: Node) -> Expr {
        let own_hash = hash(&node);
        self.find_hashed(&node, own_hash).unwrap_or_else(|| self.enter_new(node, own_hash))
    }

    /// Makes a node that did not exist.
    fn enter_new(&mut self, node: Node, own_hash: u64) -> Expr {
        let expr = Expr(self.nodes.len() as u32);
        let own = match node {
            Node::Symbol(symbol) => Stage::of(symbol),
            _ => Stage::Parameter,
        };
        self.stages.push(node.children().fold(own, |stage, child| stage.join(self.stage(child))));
        self.nodes.push(node);
        let nodes = &self.nodes;
        self.index.insert_unique(own_hash, expr, |expr| hash(&nodes[expr.index()]));
        expr
    }

    /// The number, if the expression is one.
    pub fn as_number(&self, expr: Expr) -> Option<&Rational> {
        match self.node(expr) {
            Node::Number(number) => Some(number),
            _ => None,
        }
    }

    /// Whether the expression is the number 0.
    pub fn is_zero(&self, expr: Expr) -> bool {
        self.as_number(expr).is_some_and(Rational::is_zero)
    }

    /// All expressions that `roots` depend on, including the roots, operands before users.
    pub fn reachable(&self, roots: &[Expr]) -> Vec<Expr> {
        let reached = reachable(roots, Expr::index, |expr| self.node(expr).children());
        self.work.spend(STEPS_OF_NODE * reached.len() as u64);
        reached
    }

    /// For each expression, the number of its readers among the roots and the expressions that satisfy `among`.
    pub fn readers(&self, roots: &[Expr], among: impl Fn(Expr) -> bool) -> SortedMap<Expr, usize> {
        let mut readers = SortedMap::new();
        let reachable = self.reachable(roots);
        let among = reachable.iter().filter(|expr| among(**expr));
        let read = among.flat_map(|expr| self.node(*expr).children());
        for read in read.chain(roots.iter().copied()) {
            *readers.get_or_default(read) += 1;
        }
        readers
    }

    /// The symbols that `root` depends on.
    pub fn symbols(&self, root: Expr) -> SortedSet<Symbol> {
        let symbol = |expr: Expr| match self.node(expr) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        };
        self.reachable(&[root]).into_iter().filter_map(symbol).collect()
    }
}

/// All items that `roots` are made of, including the roots, in order. `operands` returns the operands of an item, and `place`
/// its position, which is greater than the positions of its operands.
pub fn reachable<N, O>(roots: &[N], place: impl Fn(N) -> usize, operands: impl Fn(N) -> O) -> Vec<N>
where
    N: Copy + Ord,
    O: IntoIterator<Item = N>,
{
    let size = roots.iter().map(|root| place(*root) + 1).max().unwrap_or(0);
    let mut seen = vec![false; size];
    let (mut open, mut reached) = (roots.to_vec(), Vec::new());
    while let Some(next) = open.pop() {
        if !std::mem::replace(&mut seen[place(next)], true) {
            reached.push(next);
            open.extend(operands(next));
        }
    }
    reached.sort_unstable();
    reached
}

/// A table of values for some expressions.
#[derive(Clone, Debug)]
pub struct ByExpr<T> {
    /// One more than the index of the value; 0 if there is none.
    places: Vec<u32>,
    values: Vec<T>,
}

impl<T> ByExpr<T> {
    /// An empty table for all sub-expressions of `roots`.
    pub fn of(roots: &[Expr]) -> Self {
        let size = roots.iter().map(|root| root.index() + 1).max().unwrap_or(0);
        ByExpr { places: vec![0; size], values: Vec::new() }
    }

    /// Enters the value of an expression, once.
    pub fn set(&mut self, expr: Expr, value: T) {
        self.values.push(value);
        self.places[expr.index()] = self.values.len() as u32;
    }

    /// The value of an expression, if one was entered.
    pub fn get(&self, expr: Expr) -> Option<&T> {
        let place = *self.places.get(expr.index())?;
        self.values.get((place as usize).wrapping_sub(1))
    }
}

impl<T> std::ops::Index<Expr> for ByExpr<T> {
    type Output = T;

    fn index(&self, expr: Expr) -> &T {
        self.get(expr).expect("operands come before their users")
    }
}
