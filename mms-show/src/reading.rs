//! Expressions in which every named quantity is a leaf.
//!
//! The compiled derivation consists of expanded expressions; a person writes F once, and then uses the name F. A reading
//! therefore has its own leaves: each represents an [`Entry`], which holds its value in terms of earlier ones. Derivatives
//! follow the chain rule through the entries.

use super::name::{Along, Name, Taken};
use super::text::Text;
use super::walk::{Names, write};
use mms_codegen::compile::Compiled;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, Node, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The length in characters up to which a formula is written in place of a name of its own.
const SHORT: usize = 16;

/// Nodes of the tree beyond which a formula is long without being written.
const TREE: u64 = 400;

/// The position of an entry in its reading. Values are made of earlier entries only.
pub(super) type Id = usize;

/// The kind of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Supplied by the caller, such as the normal.
    Given,
    /// A definition of the field file.
    Definition,
    /// A component of a quantity.
    Component(Quantity),
    /// A helper that was named during the derivation.
    Helper,
}

/// Something with a name.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    /// The name.
    pub name: Name,
    /// The value, of which derivatives are computed.
    pub value: Expr,
    /// The value as displayed.
    pub shown: Expr,
    /// The kind.
    pub role: Role,
}

/// The entries so far, and the graph of their values.
pub(super) struct Reading {
    pub graph: Graph,
    pub entries: Vec<Entry>,
    /// The parameters of the field, whose leaves come before the leaves of entries.
    pub parameters: Vec<String>,
    pub taken: Taken,
    /// The names of the reference coordinates.
    axes: &'static [&'static str],
    derivatives: SortedMap<(Id, Along), Expr>,
    /// Helpers by their values, so that nothing is named twice.
    by_value: SortedMap<Expr, Id>,
    /// The last number that was tried for a helper without a better name.
    numbers: usize,
}

impl Names for Reading {
    fn name(&self, symbol: Symbol) -> Name {
        match symbol {
            Symbol::Parameter(index) => Name::plain(self.parameters[index].as_str()),
            Symbol::Local(id) => self.entries[id].name.clone(),
            Symbol::Time => Name::plain("t"),
            Symbol::Coordinate(axis) => Name::plain(self.axes[axis]),
            Symbol::Normal(axis) => Name::indexed("N", (axis + 1).to_string()),
            Symbol::Gradient(row, column) => {
                Name::indexed("H", format!("{}{}", row + 1, column + 1))
            }
            Symbol::Invariant(index) => Name::plain(format!("i{}", index + 1)),
        }
    }
}

impl Reading {
    /// A reading without entries, except the parameters of a field.
    pub fn new(compiled: &Compiled) -> Self {
        let mut graph = compiled.graph.clone();
        graph.make_room();
        let parameters: Vec<String> =
            compiled.model.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let mut taken = Taken::default();
        parameters.iter().for_each(|name| taken.keep(name));
        compiled.field.lets.iter().for_each(|definition| taken.keep(&definition.name.value));
        Reading {
            graph,
            entries: Vec::new(),
            parameters,
            taken,
            axes: compiled.field.space.axes(),
            derivatives: SortedMap::new(),
            by_value: SortedMap::new(),
            numbers: 0,
        }
    }

    /// The leaf of an entry.
    pub fn leaf(&mut self, id: Id) -> Expr {
        self.graph.symbol(self.symbol(id))
    }

    /// The symbol of an entry.
    pub fn symbol(&self, id: Id) -> Symbol {
        Symbol::Local(id)
    }

    /// The entry of a symbol, if it has one.
    pub fn entry_of(&self, symbol: Symbol) -> Option<Id> {
        match symbol {
            Symbol::Local(id) => Some(id),
            _ => None,
        }
    }

    /// Adds an entry under a name that is its own.
    pub fn push(&mut self, name: Name, value: Expr, role: Role) -> Id {
        self.entries.push(Entry { name, value, shown: value, role });
        self.entries.len() - 1
    }

    /// The leaf of a new helper, or the value itself if it is as short as a name: a number, a name, or a formula that is no
    /// longer.
    pub fn named(&mut self, name: Name, value: Expr, suffix: &str) -> Expr {
        if self.is_short(value) { value } else { self.helper(name, value, suffix) }
    }

    /// The leaf of a helper of that value.
    pub fn helper(&mut self, name: Name, value: Expr, suffix: &str) -> Expr {
        if let Some(id) = self.by_value.get(&value) {
            return self.leaf(*id);
        }
        let name = self.taken.fresh(name, suffix);
        let id = self.push(name, value, Role::Helper);
        self.by_value.insert(value, id);
        self.leaf(id)
    }

    /// A helper `k1`, `k2`, ... for a value without a better name.
    pub fn numbered(&mut self, value: Expr) -> Expr {
        if let Some(id) = self.by_value.get(&value) {
            return self.leaf(*id);
        }
        loop {
            self.numbers += 1;
            let name = Name::plain(format!("k{}", self.numbers));
            if self.taken.is_free(&name) {
                return self.helper(name, value, "derived");
            }
        }
    }

    /// The length of a formula in characters of text; a very long one is not measured.
    pub fn length(&self, expr: Expr) -> usize {
        if self.tree_size(expr) > TREE {
            return usize::MAX;
        }
        write(&self.graph, expr, self, &Text).chars().count()
    }

    fn is_short(&self, expr: Expr) -> bool {
        self.length(expr) <= SHORT
    }

    /// The number of nodes of the expression when it is written out.
    fn tree_size(&self, root: Expr) -> u64 {
        let mut sizes = SortedMap::<Expr, u64>::new();
        for expr in self.graph.reachable(&[root]) {
            let below = self.graph.node(expr).children().map(|child| sizes[&child]);
            let size = below.fold(1, u64::saturating_add);
            sizes.insert(expr, size);
        }
        sizes.get(&root).copied().unwrap_or(1)
    }

    /// The value with common factors taken out, where that is shorter.
    pub fn tidy(&mut self, expr: Expr) -> Expr {
        let factored = factor(&mut self.graph, &[expr])[0];
        if self.length(factored) <= self.length(expr) { factored } else { expr }
    }

    /// The entries that the expressions are made of, directly.
    pub fn entries_in(&self, expr: Expr) -> SortedSet<Id> {
        let symbols = self.graph.symbols(expr);
        symbols.into_iter().filter_map(|symbol| self.entry_of(symbol)).collect()
    }

    /// The total derivative: what depends on `along` through entries counts too.
    pub fn derivative(&mut self, expr: Expr, along: Along) -> Expr {
        // Entries are made of earlier ones, so that their derivatives are known in time.
        let mut needed = SortedSet::new();
        let mut open: Vec<Id> = self.entries_in(expr).into_iter().collect();
        while let Some(id) = open.pop() {
            if !self.derivatives.contains_key(&(id, along)) && needed.insert(id) {
                open.extend(self.entries_in(self.entries[id].value));
            }
        }
        for id in needed {
            self.differentiate_entry(id, along);
        }
        self.chain_rule(expr, along)
    }

    /// Declares a derivative that has a form of its own.
    pub fn declare_derivative(&mut self, id: Id, along: Along, value: Expr) {
        let known = self.name_derivative(id, along, value);
        self.derivatives.insert((id, along), known);
    }

    fn differentiate_entry(&mut self, id: Id, along: Along) {
        let entry = &self.entries[id];
        let value = match entry.role {
            Role::Given => self.graph.number(0),
            _ => {
                let value = entry.value;
                let derivative = self.chain_rule(value, along);
                self.tidy(derivative)
            }
        };
        self.declare_derivative(id, along, value);
    }

    fn name_derivative(&mut self, id: Id, along: Along, value: Expr) -> Expr {
        if self.is_short(value) {
            return value;
        }
        let name = self.entries[id].name.derivative(along);
        self.helper(name, value, "derived")
    }

    /// d expr = partial derivative + sum of partial derivatives by entries times theirs.
    fn chain_rule(&mut self, expr: Expr, along: Along) -> Expr {
        let mut terms = Vec::new();
        if let Some(leaf) = along.leaf() {
            terms.push((differentiate(&mut self.graph, &[expr], leaf)[0], Rational::ONE));
        }
        for id in self.entries_in(expr) {
            let inner = self.derivatives[&(id, along)];
            if self.graph.is_zero(inner) {
                continue;
            }
            let symbol = self.symbol(id);
            let outer = differentiate(&mut self.graph, &[expr], symbol)[0];
            terms.push((self.graph.mul(outer, inner), Rational::ONE));
        }
        self.graph.sum(terms)
    }

    /// The identifier of an expression that is a name.
    pub fn identifier(&self, expr: Expr) -> Option<String> {
        match self.graph.node(expr) {
            Node::Symbol(symbol) => Some(self.name(*symbol).identifier()),
            _ => None,
        }
    }

    /// Whether the expression is a number or a leaf: its own best name.
    pub fn is_leaf(&self, expr: Expr) -> bool {
        matches!(self.graph.node(expr), Node::Number(_) | Node::Pi | Node::Symbol(_))
    }
}
