//! W as it is typed, with I1, I2 and J as leaves.

use std::collections::BTreeMap;

use super::motion::{Formulas, resolved};
use super::name::Name;
use super::reading::{Reading, Role};
use crate::compile::Compiled;
use crate::expr::resolve::Scope;
use crate::expr::{Expr, Symbol};
use crate::mechanics::material::{FIRST, SECOND, VOLUME};
use crate::pass::differentiate::differentiate;
use crate::pass::substitute::substitute;

/// What W is a function of, as leaves that stand for nothing else.
struct Invariants {
    /// I1, I2 and J.
    leaves: [Expr; 3],
    symbols: [Symbol; 3],
}

/// W(I1, I2, J, X).
pub(super) struct Energy {
    /// W, in its own leaves for the invariants.
    pub value: Expr,
    invariants: Invariants,
}

impl Energy {
    /// The W of a field's material.
    pub fn read(reading: &mut Reading, compiled: &Compiled, formulas: &Formulas) -> Self {
        let invariants = Invariants::new(reading);
        let typed = invariants.typed(reading, compiled, formulas);
        let value = typed.unwrap_or_else(|| invariants.of_model(reading, compiled.model.energy));
        Energy { value, invariants }
    }

    /// Partial derivatives by I1, I2 and J.
    pub fn slopes(&self, reading: &mut Reading) -> [Expr; 3] {
        self.invariants.symbols.map(|symbol| {
            let slope = differentiate(&mut reading.graph, &[self.value], symbol)[0];
            reading.tidy(slope)
        })
    }

    /// An expression in the invariants at their values.
    pub fn at(&self, reading: &mut Reading, expr: Expr, values: [Expr; 3]) -> Expr {
        let values: BTreeMap<Symbol, Expr> =
            self.invariants.symbols.into_iter().zip(values).collect();
        let made = substitute(&mut reading.graph, &[expr], &values)[0];
        reading.tidy(made)
    }
}

impl Invariants {
    /// Entries of their own, which are replaced before anything is shown.
    fn new(reading: &mut Reading) -> Self {
        let nothing = reading.graph.number(0);
        let ids =
            ["I1", "I2", "J"].map(|name| reading.push(Name::plain(name), nothing, Role::Given));
        let symbols = ids.map(|id| reading.symbol(id));
        Invariants { leaves: ids.map(|id| reading.leaf(id)), symbols }
    }

    /// The model's W, which is a function of the departures from the undeformed state.
    fn of_model(&self, reading: &mut Reading, energy: Expr) -> Expr {
        let graph = &mut reading.graph;
        let mut values = BTreeMap::new();
        let departures = [(FIRST, 3), (SECOND, 3), (VOLUME, 1)];
        for ((symbol, at_identity), leaf) in departures.into_iter().zip(self.leaves) {
            let constant = graph.number(at_identity);
            values.insert(symbol, graph.sub(leaf, constant));
        }
        substitute(graph, &[energy], &values)[0]
    }

    /// W as it is typed, with the field's arguments as they are typed or by their names; `None`
    /// where that is not what the model has.
    fn typed(
        &self,
        reading: &mut Reading,
        compiled: &Compiled,
        formulas: &Formulas,
    ) -> Option<Expr> {
        let mut scope = scope(reading, self.leaves, &self.symbols);
        let departures = [(FIRST, 3), (SECOND, 3), (VOLUME, 1)].map(|(symbol, at_identity)| {
            let graph = &mut reading.graph;
            let (constant, departure) = (graph.number(at_identity), graph.symbol(symbol));
            graph.add(constant, departure)
        });
        let mut expanded = self::scope(reading, departures, &self.symbols);
        for (name, formula) in &compiled.field.material.arguments {
            let value = formulas.read_alone(reading, formula)?;
            expanded.define(&name.value, Some(formulas.expand(reading, value)));
            let argument = reading.named(Name::plain(name.value.as_str()), value, "material");
            scope.define(&name.value, Some(argument));
        }
        let same = energy_in(reading, expanded, compiled)? == compiled.model.energy;
        energy_in(reading, scope, compiled).filter(|_| same)
    }
}

/// What a material file may use: I1, I2, J, and what is made of them.
fn scope(reading: &mut Reading, invariants: [Expr; 3], symbols: &[Symbol]) -> Scope {
    let mut scope = Scope::default();
    let pi = reading.graph.pi();
    scope.define("pi", Some(pi));
    for (name, invariant) in ["I1", "I2", "J"].into_iter().zip(invariants) {
        scope.define(name, Some(invariant));
    }
    let third = reading.graph.power(invariants[2], 2);
    scope.define("I3", Some(third));
    // The field compiled: what had to be positive was shown to be.
    symbols.iter().for_each(|symbol| scope.assume_positive(*symbol));
    scope
}

/// The density of a material file in a scope that knows its parameters.
fn energy_in(reading: &mut Reading, mut scope: Scope, compiled: &Compiled) -> Option<Expr> {
    for definition in &compiled.material.lets {
        let value = resolved(reading, &scope, &definition.value)?;
        scope.define(&definition.name.value, Some(value));
    }
    resolved(reading, &scope, &compiled.material.strain_energy)
}

/// W as its own file has it: in the parameters of the material and in I1, I2 and J.
pub(super) fn energy_of_file(reading: &mut Reading, compiled: &Compiled) -> Option<Expr> {
    let invariants = Invariants::new(reading);
    let mut scope = scope(reading, invariants.leaves, &invariants.symbols);
    // These names live in the material file: they may be those of the field as well.
    for parameter in &compiled.material.parameters {
        let name = &parameter.name.value;
        let nothing = reading.graph.number(0);
        let id = reading.push(Name::plain(name.as_str()), nothing, Role::Given);
        let leaf = reading.leaf(id);
        scope.define(name, Some(leaf));
        scope.assume_positive(reading.symbol(id));
    }
    energy_in(reading, scope, compiled)
}
