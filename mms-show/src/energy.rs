//! W as it is typed, with the invariants as leaves.

use super::motion::{Formulas, Quantities, resolved};
use super::name::Name;
use super::reading::{Reading, Role};
use mms_codegen::compile::Compiled;
use mms_mechanics::invariant::{INVARIANTS, VOLUME};
use mms_mechanics::resolve::Scope;
use mms_spec::own::Part;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// The arguments of W, as leaves used for nothing else, in the order of [`INVARIANTS`].
struct Leaves {
    leaves: Vec<Expr>,
    symbols: Vec<Symbol>,
}

/// W as a function of invariants and of X.
pub(super) struct Energy {
    /// W, in its own leaves for the invariants.
    pub value: Expr,
    symbols: Vec<Symbol>,
}

impl Energy {
    /// The W of a field's material.
    pub fn read(
        reading: &mut Reading,
        compiled: &Compiled,
        formulas: &Formulas,
        quantities: &Quantities,
    ) -> Self {
        let leaves = Leaves::new(reading);
        let typed = leaves.typed(reading, compiled, formulas, quantities);
        let value = typed.unwrap_or_else(|| leaves.of_model(reading, compiled.model.energy));
        Energy { value, symbols: leaves.symbols }
    }

    /// The partial derivative by an invariant, given by its position in [`INVARIANTS`].
    pub fn slope(&self, reading: &mut Reading, invariant: usize) -> Expr {
        let slope = differentiate(&mut reading.graph, &[self.value], self.symbols[invariant])[0];
        reading.tidy(slope)
    }

    /// An expression in the invariants at their values, by position.
    pub fn at(&self, reading: &mut Reading, expr: Expr, values: &[(usize, Expr)]) -> Expr {
        let values = values.iter().map(|(invariant, value)| (self.symbols[*invariant], *value));
        let made = substitute(&mut reading.graph, &[expr], &values.collect())[0];
        reading.tidy(made)
    }
}

impl Leaves {
    /// Entries of their own, which are replaced before anything is shown.
    fn new(reading: &mut Reading) -> Self {
        let nothing = reading.graph.number(0);
        let ids = INVARIANTS
            .map(|invariant| reading.push(Name::plain(invariant.name), nothing, Role::Given));
        let symbols = ids.map(|id| reading.symbol(id)).into();
        Leaves { leaves: ids.map(|id| reading.leaf(id)).into(), symbols }
    }

    /// The model's W, which is a function of the departures from the undeformed state.
    fn of_model(&self, reading: &mut Reading, energy: Expr) -> Expr {
        let graph = &mut reading.graph;
        let mut values = SortedMap::new();
        for (invariant, leaf) in INVARIANTS.iter().zip(&self.leaves) {
            let constant = graph.number(invariant.at_identity);
            values.insert(invariant.symbol, graph.sub(*leaf, constant));
        }
        substitute(graph, &[energy], &values)[0]
    }

    /// W as it is typed, with the field's arguments as they are typed or by their names; `None` if this differs from the
    /// model's W.
    fn typed(
        &self,
        reading: &mut Reading,
        compiled: &Compiled,
        formulas: &Formulas,
        quantities: &Quantities,
    ) -> Option<Expr> {
        let mut scope = scope(reading, &self.leaves, &self.symbols);
        let departures = INVARIANTS.map(|invariant| invariant.value(&mut reading.graph));
        let mut expanded = self::scope(reading, &departures, &self.symbols);
        for (name, formula) in &compiled.field.material.arguments {
            let value = formulas.read_alone(reading, formula)?;
            expanded.define(&name.value, Some(formulas.expand(reading, value)));
            let argument = reading.named(Name::plain(name.value.as_str()), value, "material");
            scope.define(&name.value, Some(argument));
        }
        for (own, derived) in &compiled.model.own {
            let name = &own.of;
            if own.part == Part::Value && compiled.material.given(name).is_some() {
                let given = quantities.component(reading, Quantity::Own(*own), 0);
                expanded.define(name, Some(derived[0]));
                scope.define(name, Some(given));
            }
        }
        let same = energy_in(reading, expanded, compiled)? == compiled.model.energy;
        energy_in(reading, scope, compiled).filter(|_| same)
    }
}

/// The names that a material file may use: the invariants, and functions of them.
fn scope(reading: &mut Reading, invariants: &[Expr], symbols: &[Symbol]) -> Scope {
    let mut scope = Scope::default();
    let pi = reading.graph.pi();
    scope.define("pi", Some(pi));
    for (invariant, value) in INVARIANTS.iter().zip(invariants) {
        scope.define(invariant.name, Some(*value));
        if invariant.symbol == VOLUME {
            let third = reading.graph.power(*value, 2);
            scope.define("I3", Some(third));
        }
    }
    // The field compiled: what had to be positive was shown to be.
    symbols.iter().for_each(|symbol| scope.assume_positive(*symbol));
    scope
}

/// The density of a material file in a scope that has its parameters.
fn energy_in(reading: &mut Reading, mut scope: Scope, compiled: &Compiled) -> Option<Expr> {
    for definition in &compiled.material.lets {
        let value = resolved(reading, &scope, &definition.value)?;
        scope.define(&definition.name.value, Some(value));
    }
    resolved(reading, &scope, &compiled.material.strain_energy)
}

/// W as its own file has it: in the parameters of the material and in the invariants.
pub(super) fn energy_of_file(reading: &mut Reading, compiled: &Compiled) -> Option<Expr> {
    let leaves = Leaves::new(reading);
    let mut scope = scope(reading, &leaves.leaves, &leaves.symbols);
    // These names belong to the material file; the field may use the same ones.
    for name in compiled.material.names() {
        let nothing = reading.graph.number(0);
        let id = reading.push(Name::plain(name), nothing, Role::Given);
        let leaf = reading.leaf(id);
        scope.define(name, Some(leaf));
        scope.assume_positive(reading.symbol(id));
    }
    energy_in(reading, scope, compiled)
}
