//! The formulas of the field file with its own names kept, and the motion that follows from them.

use super::axisymmetric::around;
use super::name::{Along, Name};
use super::reading::{Id, Reading, Role};
use super::rigid::moved;
use mms_codegen::compile::Compiled;
use mms_mechanics::resolve::Scope;
use mms_mechanics::tensor::Tensor;
use mms_spec::quantity::Quantity;
use mms_spec::syntax;
use mms_spec::{Formula, LetSpec, Space};
use mms_symbolic::expr::{Expr, HALF, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// The longest formula that is repeated in place of its name: F_11 is written out if it is short, and is 1 + H_11 otherwise.
const REPEATABLE: usize = 60;

/// The formulas of the field file, parsed.
pub(super) struct Formulas {
    /// The scope in which names mean their entries.
    typed: Scope,
    /// The scope in which names mean their definitions.
    expanded: Scope,
    /// The definition of each entry.
    definitions: SortedMap<Symbol, Expr>,
}

impl Formulas {
    /// Reads the definitions of a field.
    pub fn new(reading: &mut Reading, compiled: &Compiled) -> Self {
        let (typed, expanded) = (Scope::default(), Scope::default());
        let mut formulas = Formulas { typed, expanded, definitions: SortedMap::new() };
        let pi = reading.graph.pi();
        formulas.define("pi", pi);
        formulas.given("t", Symbol::Time, reading);
        let space = compiled.field.space;
        for (axis, name) in space.axes().iter().take(space.coordinates()).enumerate() {
            formulas.given(name, Symbol::Coordinate(axis), reading);
        }
        for (index, parameter) in compiled.model.parameters.iter().enumerate() {
            formulas.given(&parameter.name, Symbol::Parameter(index), reading);
        }
        for definition in &compiled.field.lets {
            formulas.definition(reading, definition);
        }
        for given in &compiled.field.givens {
            if let Some(value) = resolved(reading, &formulas.expanded, &given.value) {
                formulas.define(&given.name.value, value);
            }
        }
        formulas
    }

    fn define(&mut self, name: &str, value: Expr) {
        self.typed.define(name, Some(value));
        self.expanded.define(name, Some(value));
    }

    fn given(&mut self, name: &str, symbol: Symbol, reading: &mut Reading) {
        let leaf = reading.graph.symbol(symbol);
        self.define(name, leaf);
        // The field has been compiled, so each parameter that must be positive is positive.
        self.typed.assume_positive(symbol);
        self.expanded.assume_positive(symbol);
    }

    fn definition(&mut self, reading: &mut Reading, definition: &LetSpec) {
        let name = &definition.name.value;
        let expanded = resolved(reading, &self.expanded, &definition.value);
        self.expanded.define(name, expanded);
        let Some(expanded) = expanded else { return };
        let value = resolved(reading, &self.typed, &definition.value).unwrap_or(expanded);
        let id = reading.push(Name::plain(name.as_str()), value, Role::Definition);
        let leaf = reading.leaf(id);
        // A number is folded where it is used: it may be an exponent.
        let is_number = reading.graph.as_number(expanded).is_some();
        self.typed.define(name, Some(if is_number { expanded } else { leaf }));
        self.typed.assume_positive(reading.symbol(id));
        self.definitions.insert(reading.symbol(id), expanded);
    }

    /// A formula as it was typed; `derived` is the model's expression, which is returned if the two differ.
    pub fn read(&self, reading: &mut Reading, formula: &Formula, derived: Expr) -> Expr {
        let Some(typed) = resolved(reading, &self.typed, formula) else { return derived };
        let expanded = substitute(&mut reading.graph, &[typed], &self.definitions)[0];
        if expanded == derived { typed } else { derived }
    }

    /// A formula as it was typed, for which the model has no expression of its own.
    pub fn read_alone(&self, reading: &mut Reading, formula: &Formula) -> Option<Expr> {
        resolved(reading, &self.typed, formula)
            .or_else(|| resolved(reading, &self.expanded, formula))
    }

    /// The expression with every name replaced by its definition.
    pub fn expand(&self, reading: &mut Reading, expr: Expr) -> Expr {
        substitute(&mut reading.graph, &[expr], &self.definitions)[0]
    }
}

/// A formula that has been resolved without a mistake before.
pub(super) fn resolved(reading: &mut Reading, scope: &Scope, formula: &Formula) -> Option<Expr> {
    let mut diagnostics = Vec::new();
    let ast = syntax::parse(formula, &mut diagnostics)?;
    scope.resolve(&mut reading.graph, &ast, &mut diagnostics)
}

/// The quantities that have been derived: the entries of their components.
pub(super) struct Quantities {
    /// The rows of tensors.
    pub dimension: usize,
    pub space: Space,
    ids: SortedMap<Quantity, Vec<Id>>,
}

impl Quantities {
    /// u, x, v, a, H, F, C, B and E.
    pub fn motion(reading: &mut Reading, compiled: &Compiled, formulas: &Formulas) -> Self {
        let space = compiled.field.space;
        let dimension = space.rows();
        let mut quantities = Quantities { dimension, space, ids: SortedMap::new() };
        let mut displacement: Vec<Expr> = (compiled.field.displacement.iter())
            .zip(&compiled.model.displacement)
            .map(|(formula, derived)| formulas.read(reading, formula, *derived))
            .collect();
        // Where the field is axisymmetric, its own displacement has the rigid motion in it.
        if !space.is_axisymmetric() {
            displacement = moved(reading, compiled, formulas, displacement);
        }
        quantities.add(reading, compiled, Quantity::Displacement, &displacement);
        let position: Vec<Expr> = (0..space.vector())
            .map(|axis| {
                let name = quantities.component(reading, Quantity::Displacement, axis);
                match axis < space.coordinates() {
                    true => {
                        let reference = reading.graph.symbol(Symbol::Coordinate(axis));
                        reading.graph.add(reference, name)
                    }
                    false => name,
                }
            })
            .collect();
        quantities.add(reading, compiled, Quantity::Position, &position);
        let velocity = derivatives(reading, &displacement, Along::Time);
        quantities.add(reading, compiled, Quantity::Velocity, &velocity);
        let acceleration = derivatives(reading, &velocity, Along::Time);
        quantities.add(reading, compiled, Quantity::Acceleration, &acceleration);
        displacement.resize(dimension, reading.graph.number(0));
        let gradient: Vec<Expr> = (0..dimension * dimension)
            .map(|k| {
                let (row, column) = (k / dimension, k % dimension);
                let slope = match column < space.coordinates() {
                    true => reading.derivative(displacement[row], quantities.along(column)),
                    false => around(reading, &displacement, row),
                };
                reading.tidy(slope)
            })
            .collect();
        quantities.add(reading, compiled, Quantity::DisplacementGradient, &gradient);
        quantities.deformation(reading, compiled, &gradient);
        quantities.strain(reading, compiled);
        quantities
    }

    /// The coordinate of that position.
    pub fn along(&self, axis: usize) -> Along {
        Along::coordinate(self.space, axis)
    }

    /// All coordinates.
    pub fn axes(&self) -> impl Iterator<Item = Along> + use<> {
        let space = self.space;
        (0..space.coordinates()).map(move |axis| Along::coordinate(space, axis))
    }

    /// C = F^T F, B = F F^T and E = (C - I)/2, in terms of the names of F and C.
    fn strain(&mut self, reading: &mut Reading, compiled: &Compiled) {
        let deformation = self.tensor(reading, Quantity::DeformationGradient);
        let transposed = deformation.transpose();
        let right = transposed.mul(&mut reading.graph, &deformation);
        self.add(reading, compiled, Quantity::RightCauchyGreen, right.components());
        let left = deformation.mul(&mut reading.graph, &transposed);
        self.add(reading, compiled, Quantity::LeftCauchyGreen, left.components());
        let right = self.symmetric(reading, Quantity::RightCauchyGreen);
        let lagrange = Tensor::from_fn(self.dimension, |row, column| {
            let identity = reading.graph.number(i32::from(row == column));
            reading.graph.sum([(right.at(row, column), HALF), (identity, -HALF)])
        });
        self.add(reading, compiled, Quantity::GreenLagrange, lagrange.components());
    }

    fn deformation(&mut self, reading: &mut Reading, compiled: &Compiled, gradient: &[Expr]) {
        let dimension = self.dimension;
        let mut deformation = Vec::new();
        let mut shown = Vec::new();
        for (k, slope) in gradient.iter().enumerate() {
            let identity = reading.graph.number(i32::from(k / dimension == k % dimension));
            let value = reading.graph.add(identity, *slope);
            deformation.push(value);
            let name = self.component(reading, Quantity::DisplacementGradient, k);
            let by_name = reading.graph.add(identity, name);
            let is_short = reading.length(value) <= REPEATABLE;
            shown.push(if is_short { value } else { by_name });
        }
        self.add(reading, compiled, Quantity::DeformationGradient, &deformation);
        self.show(reading, Quantity::DeformationGradient, &shown);
    }

    /// Adds a quantity. A component that the derivation found to be a number is entered as that number.
    pub fn add(
        &mut self,
        reading: &mut Reading,
        compiled: &Compiled,
        quantity: Quantity,
        values: &[Expr],
    ) {
        let derived = compiled.derivation.quantities.get(&quantity);
        let count = self.space.components(quantity.shape());
        let ids = values.iter().take(count).enumerate().map(|(k, value)| {
            let found = derived.and_then(|components| components.get(k)).copied();
            let number = found.filter(|found| compiled.graph.as_number(*found).is_some());
            let name = Name::component(quantity, k, self.dimension);
            let name = reading.taken.fresh(name, "derived");
            reading.push(name, number.unwrap_or(*value), Role::Component(quantity))
        });
        let ids = ids.collect();
        self.ids.insert(quantity, ids);
    }

    /// Sets the displayed form of a quantity, if it differs from the value itself.
    pub fn show(&self, reading: &mut Reading, quantity: Quantity, shown: &[Expr]) {
        for (id, shown) in self.ids(quantity).iter().zip(shown) {
            let is_number = reading.graph.as_number(reading.entries[*id].value).is_some();
            if !is_number {
                reading.entries[*id].shown = *shown;
            }
        }
    }

    /// The entries of a quantity's components, row-major; none before it is derived.
    pub fn ids(&self, quantity: Quantity) -> &[Id] {
        self.ids.get(&quantity).map_or(&[], Vec::as_slice)
    }

    /// The best name of a component: its value where that is a number or a name itself.
    pub fn component(&self, reading: &mut Reading, quantity: Quantity, component: usize) -> Expr {
        let id = self.ids(quantity)[component];
        let value = reading.entries[id].value;
        if reading.is_leaf(value) { value } else { reading.leaf(id) }
    }

    /// The names of all components of a tensor.
    pub fn tensor(&self, reading: &mut Reading, quantity: Quantity) -> Tensor {
        Tensor::from_components(self.dimension, self.components(reading, quantity))
    }

    /// Adds a symmetric tensor: an entry above the diagonal serves its mirror image too.
    pub fn symmetric(&self, reading: &mut Reading, quantity: Quantity) -> Tensor {
        let names = self.tensor(reading, quantity);
        Tensor::from_fn(self.dimension, |row, column| names.at(row.min(column), row.max(column)))
    }

    /// The names of all components of a quantity.
    pub fn components(&self, reading: &mut Reading, quantity: Quantity) -> Vec<Expr> {
        (0..self.ids(quantity).len()).map(|k| self.component(reading, quantity, k)).collect()
    }
}

pub(super) fn derivatives(reading: &mut Reading, values: &[Expr], along: Along) -> Vec<Expr> {
    let derivative = |value: &Expr| {
        let slope = reading.derivative(*value, along);
        reading.tidy(slope)
    };
    values.iter().map(derivative).collect()
}
