//! Stress, its divergence and the body force, in terms of the named components of F.
//!
//! With P = alpha F + beta F C + W,J cof F, alpha = 2 (W,I1 + I1 W,I2) and beta = -2 W,I2, and since
//! the divergence of cof F vanishes (the Piola identity),
//!
//! ```text
//! (Div P)_i = (alpha F_iJ + beta (F C)_iJ),J + cof F_iJ (W,J),J
//! ```
//!
//! See Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, chapter 6. In
//! one dimension W is a function of F alone, and P its derivative.

use std::collections::BTreeMap;

use super::abbreviate::LINE;
use super::motion::{Formulas, Quantities, resolved};
use super::name::{Along, Name};
use super::reading::{Reading, Role};
use crate::compile::Compiled;
use crate::expr::resolve::Scope;
use crate::expr::{Expr, Rational, Symbol};
use crate::mechanics::material::{FIRST, SECOND, VOLUME};
use crate::pass::differentiate::differentiate;
use crate::pass::substitute::substitute;
use crate::quantity::Quantity;

/// What W is a function of, as leaves that stand for nothing else.
struct Invariants {
    /// I1, I2 and J.
    leaves: [Expr; 3],
    symbols: [Symbol; 3],
}

/// Adds J and everything that follows from W and the density.
pub(super) fn derive(
    reading: &mut Reading,
    compiled: &Compiled,
    formulas: &Formulas,
    quantities: &mut Quantities,
) {
    let density = density(reading, compiled, formulas);
    let energy = Energy::read(reading, compiled, formulas);
    let solid = match quantities.dimension {
        1 => line(reading, compiled, quantities, &energy),
        _ => space(reading, compiled, quantities, &energy),
    };
    measures(reading, compiled, quantities);
    quantities.add(reading, compiled, Quantity::DivP, &solid);
    balance(reading, compiled, quantities, density);
    traction(reading, compiled, quantities);
}

/// W(I1, I2, J, X).
struct Energy {
    value: Expr,
    invariants: Invariants,
}

impl Energy {
    fn read(reading: &mut Reading, compiled: &Compiled, formulas: &Formulas) -> Self {
        let invariants = Invariants::new(reading);
        let typed = invariants.typed(reading, compiled, formulas);
        let value = typed.unwrap_or_else(|| invariants.of_model(reading, compiled.model.energy));
        Energy { value, invariants }
    }

    /// Partial derivatives by I1, I2 and J.
    fn slopes(&self, reading: &mut Reading) -> [Expr; 3] {
        self.invariants.symbols.map(|symbol| {
            let slope = differentiate(&mut reading.graph, &[self.value], symbol)[0];
            reading.tidy(slope)
        })
    }

    /// An expression in the invariants at their values.
    fn at(&self, reading: &mut Reading, expr: Expr, values: [Expr; 3]) -> Expr {
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

fn density(reading: &mut Reading, compiled: &Compiled, formulas: &Formulas) -> Expr {
    let formula = &compiled.field.material.density;
    let value = formulas.read(reading, formula, compiled.model.density);
    reading.named(Name::plain("rho0"), value, "material")
}

/// One dimension: W(F), P = dW/dF, Div P = dP/dX. Returns Div P.
fn line(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    energy: &Energy,
) -> Vec<Expr> {
    let stretch = quantities.component(reading, Quantity::DeformationGradient, 0);
    quantities.add(reading, compiled, Quantity::Jacobian, &[stretch]);
    let graph = &mut reading.graph;
    let square = graph.power(stretch, 2);
    let (one, two) = (graph.number(1), graph.number(2));
    let first = graph.add(square, two);
    let double = graph.scale(square, 2);
    let second = graph.add(double, one);
    // dI1/dF = 2 F, dI2/dF = 4 F, dJ/dF = 1.
    let (twice, fourfold) = (graph.scale(stretch, 2), graph.scale(stretch, 4));
    let values = [first, second, stretch];
    let slopes = energy.slopes(reading);
    let chained: Vec<_> = slopes
        .into_iter()
        .zip([twice, fourfold, one])
        .map(|(slope, inner)| {
            let slope = energy.at(reading, slope, values);
            (reading.graph.mul(slope, inner), Rational::ONE)
        })
        .collect();
    let stress = reading.graph.sum(chained);
    let stress = reading.tidy(stress);
    let energy = energy.at(reading, energy.value, values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[energy]);
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, &[stress]);
    let divergence = reading.derivative(stress, Along::Coordinate(0));
    vec![reading.tidy(divergence)]
}

/// Two and three dimensions. Returns Div P.
fn space(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    energy: &Energy,
) -> Vec<Expr> {
    let dimension = quantities.dimension;
    let deformation = quantities.components(reading, Quantity::DeformationGradient);
    second_gradient(reading, quantities, &deformation);
    let cofactors = cofactors(reading, &deformation, dimension);
    let jacobian = jacobian(reading, compiled, quantities, &deformation, &cofactors);
    let slopes = energy.slopes(reading);
    let right =
        (!reading.graph.is_zero(slopes[1])).then(|| right(reading, &deformation, dimension));
    let values = invariants(reading, &deformation, right.as_deref(), jacobian, dimension);
    let whole = energy.at(reading, energy.value, values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[whole]);
    let alongs = [Along::FirstInvariant, Along::SecondInvariant, Along::Jacobian];
    let [w1, w2, wj] = [0, 1, 2].map(|k| {
        let slope = energy.at(reading, slopes[k], values);
        let name = Name::plain("W").derivative(alongs[k]);
        match alongs[k] {
            // It stands beside a cofactor in every component, and is differentiated.
            Along::Jacobian if !reading.is_leaf(slope) => reading.helper(name, slope, "derived"),
            _ => reading.named(name, slope, "derived"),
        }
    });
    let graph = &mut reading.graph;
    let scaled = graph.mul(values[0], w2);
    let alpha = graph.add(w1, scaled);
    let alpha = graph.scale(alpha, 2);
    let beta = graph.scale(w2, -2);
    let cubic = right.map(|right| matrix_product(reading, &deformation, &right, dimension));
    let shear: Vec<Expr> = (0..deformation.len())
        .map(|k| {
            let graph = &mut reading.graph;
            let linear = graph.mul(alpha, deformation[k]);
            match &cubic {
                Some(cubic) => {
                    let term = graph.mul(beta, cubic[k]);
                    graph.add(linear, term)
                }
                None => linear,
            }
        })
        .collect();
    let stress: Vec<Expr> = (0..deformation.len())
        .map(|k| {
            let pressure = reading.graph.mul(wj, cofactors[k]);
            let stress = reading.graph.add(shear[k], pressure);
            reading.tidy(stress)
        })
        .collect();
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, &stress);
    divergence(reading, &shear, &cofactors, wj, dimension)
}

fn divergence(
    reading: &mut Reading,
    shear: &[Expr],
    cofactors: &[Expr],
    pressure: Expr,
    dimension: usize,
) -> Vec<Expr> {
    let slopes: Vec<Expr> =
        (0..dimension).map(|axis| reading.derivative(pressure, Along::Coordinate(axis))).collect();
    (0..dimension)
        .map(|row| {
            let mut terms = Vec::new();
            for axis in 0..dimension {
                let k = row * dimension + axis;
                terms.push((reading.derivative(shear[k], Along::Coordinate(axis)), Rational::ONE));
                terms.push((reading.graph.mul(cofactors[k], slopes[axis]), Rational::ONE));
            }
            let sum = reading.graph.sum(terms);
            reading.tidy(sum)
        })
        .collect()
}

/// F_iJ,K = F_iK,J: the order of derivatives does not matter, and one of the two is enough.
fn second_gradient(reading: &mut Reading, quantities: &Quantities, deformation: &[Expr]) {
    let dimension = quantities.dimension;
    for (k, id) in quantities.ids(Quantity::DeformationGradient).iter().enumerate() {
        let (row, column) = (k / dimension, k % dimension);
        for axis in 0..column {
            let mirrored = deformation[row * dimension + axis];
            let slope = reading.derivative(mirrored, Along::Coordinate(column));
            reading.declare_derivative(*id, Along::Coordinate(axis), slope);
        }
    }
}

/// cof F, row-major: dJ/dF.
fn cofactors(reading: &mut Reading, deformation: &[Expr], dimension: usize) -> Vec<Expr> {
    let at =
        |row: usize, column: usize| deformation[row % dimension * dimension + column % dimension];
    (0..dimension * dimension)
        .map(|k| {
            let (row, column) = (k / dimension, k % dimension);
            let graph = &mut reading.graph;
            if dimension == 2 {
                let sign = if row == column { 1 } else { -1 };
                return graph.scale(at(row + 1, column + 1), sign);
            }
            // Cyclic indices bring the sign along.
            let down = graph.mul(at(row + 1, column + 1), at(row + 2, column + 2));
            let up = graph.mul(at(row + 1, column + 2), at(row + 2, column + 1));
            let minor = graph.sub(down, up);
            let name = Name::indexed("cof", format!("{}{}", row + 1, column + 1));
            reading.named(name, minor, "derived")
        })
        .collect()
}

/// J = F_1J cof F_1J, with J,K = cof F_iJ F_iJ,K.
fn jacobian(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    deformation: &[Expr],
    cofactors: &[Expr],
) -> Expr {
    let dimension = quantities.dimension;
    let first_row: Vec<_> = (0..dimension).map(|k| (deformation[k], cofactors[k])).collect();
    let value = dot(reading, first_row);
    quantities.add(reading, compiled, Quantity::Jacobian, &[value]);
    let id = quantities.ids(Quantity::Jacobian)[0];
    let leaf = quantities.component(reading, Quantity::Jacobian, 0);
    if !reading.is_leaf(reading.entries[id].value) {
        for axis in (0..dimension).map(Along::Coordinate) {
            let slopes: Vec<_> = deformation
                .iter()
                .zip(cofactors)
                .map(|(component, cofactor)| (*cofactor, reading.derivative(*component, axis)))
                .collect();
            let slope = dot(reading, slopes);
            reading.declare_derivative(id, axis, slope);
        }
    }
    leaf
}

/// C = F^T F, row-major, by name.
fn right(reading: &mut Reading, deformation: &[Expr], dimension: usize) -> Vec<Expr> {
    let mut right = Vec::new();
    for k in 0..dimension * dimension {
        let (row, column) = (k / dimension, k % dimension);
        if column < row {
            right.push(right[column * dimension + row]);
            continue;
        }
        let pairs: Vec<_> = (0..dimension)
            .map(|i| (deformation[i * dimension + row], deformation[i * dimension + column]))
            .collect();
        let value = dot(reading, pairs);
        let name = Name::indexed("C", format!("{}{}", row + 1, column + 1));
        right.push(reading.named(name, value, "derived"));
    }
    right
}

/// I1 and I2 by name, where the dimensions that a plane lacks contribute stretches of one, and J.
fn invariants(
    reading: &mut Reading,
    deformation: &[Expr],
    right: Option<&[Expr]>,
    jacobian: Expr,
    dimension: usize,
) -> [Expr; 3] {
    let squares: Vec<_> = deformation.iter().map(|component| (*component, *component)).collect();
    let sum = dot(reading, squares);
    let missing = reading.graph.number(i32::from(dimension == 2));
    let first = reading.graph.add(sum, missing);
    let first = reading.named(Name::plain("I1"), first, "derived");
    let Some(right) = right else { return [first, first, jacobian] };
    // I2 = ((tr C)^2 - tr C^2)/2.
    let squares: Vec<_> = right.iter().map(|component| (*component, *component)).collect();
    let contracted = dot(reading, squares);
    let graph = &mut reading.graph;
    let contracted = graph.add(contracted, missing);
    let square = graph.power(first, 2);
    let half = Rational::from_parts(1.into(), 2u8.into());
    let second = graph.sum([(square, half.clone()), (contracted, -half)]);
    let second = reading.named(Name::plain("I2"), second, "derived");
    [first, second, jacobian]
}

/// sigma, tau and P^T. They come after P and before Div P, as everywhere.
fn measures(reading: &mut Reading, compiled: &Compiled, quantities: &mut Quantities) {
    let dimension = quantities.dimension;
    let first = quantities.components(reading, Quantity::FirstPiolaKirchhoff);
    let deformation = quantities.components(reading, Quantity::DeformationGradient);
    let jacobian = quantities.component(reading, Quantity::Jacobian, 0);
    let transposed = transpose(&first, dimension);
    quantities.add(reading, compiled, Quantity::NominalStress, &transposed);
    let columns = transpose(&deformation, dimension);
    let kirchhoff = matrix_product(reading, &first, &columns, dimension);
    let cauchy: Vec<Expr> =
        kirchhoff.iter().map(|component| reading.graph.div(*component, jacobian)).collect();
    quantities.add(reading, compiled, Quantity::CauchyStress, &cauchy);
    quantities.add(reading, compiled, Quantity::KirchhoffStress, &kirchhoff);
}

/// b = a - Div P/rho0 and rho0 b, written out where that fits on a line.
fn balance(reading: &mut Reading, compiled: &Compiled, quantities: &mut Quantities, density: Expr) {
    let acceleration = quantities.components(reading, Quantity::Acceleration);
    let divergence = quantities.components(reading, Quantity::DivP);
    let specific = |reading: &mut Reading, [acceleration, divergence]: [Expr; 2]| {
        let part = reading.graph.div(divergence, density);
        reading.graph.sub(acceleration, part)
    };
    let per_volume = |reading: &mut Reading, [acceleration, divergence]: [Expr; 2]| {
        let inertia = reading.graph.mul(density, acceleration);
        reading.graph.sub(inertia, divergence)
    };
    type Balance<'a> = &'a dyn Fn(&mut Reading, [Expr; 2]) -> Expr;
    let forms: [(Quantity, Balance<'_>); 2] =
        [(Quantity::BodyForce, &specific), (Quantity::BodyForceDensity, &per_volume)];
    for (quantity, form) in forms {
        let mut values = Vec::new();
        let mut shown = Vec::new();
        for (row, pair) in acceleration.iter().zip(&divergence).enumerate() {
            let value = form(reading, [*pair.0, *pair.1]);
            values.push(value);
            let written_out = [Quantity::Acceleration, Quantity::DivP]
                .map(|quantity| reading.entries[quantities.ids(quantity)[row]].value);
            let whole = form(reading, written_out);
            let whole = reading.tidy(whole);
            shown.push(if reading.length(whole) <= LINE { whole } else { value });
        }
        quantities.add(reading, compiled, quantity, &values);
        quantities.show(reading, quantity, &shown);
    }
}

/// T = P N.
fn traction(reading: &mut Reading, compiled: &Compiled, quantities: &mut Quantities) {
    let dimension = quantities.dimension;
    let first = quantities.components(reading, Quantity::FirstPiolaKirchhoff);
    let zero = reading.graph.number(0);
    let normal: Vec<Expr> = (0..dimension)
        .map(|axis| {
            let index = if dimension == 1 { String::new() } else { (axis + 1).to_string() };
            let name = reading.taken.fresh(Name::indexed("N", index), "derived");
            let id = reading.push(name, zero, Role::Given);
            reading.leaf(id)
        })
        .collect();
    let traction: Vec<Expr> = first
        .chunks(dimension)
        .map(|row| dot(reading, row.iter().copied().zip(normal.iter().copied()).collect()))
        .collect();
    quantities.add(reading, compiled, Quantity::Traction, &traction);
}

fn dot(reading: &mut Reading, pairs: Vec<(Expr, Expr)>) -> Expr {
    let graph = &mut reading.graph;
    let terms: Vec<_> = pairs.into_iter().map(|(a, b)| (graph.mul(a, b), Rational::ONE)).collect();
    graph.sum(terms)
}

fn transpose(matrix: &[Expr], dimension: usize) -> Vec<Expr> {
    (0..matrix.len()).map(|k| matrix[k % dimension * dimension + k / dimension]).collect()
}

fn matrix_product(
    reading: &mut Reading,
    left: &[Expr],
    right: &[Expr],
    dimension: usize,
) -> Vec<Expr> {
    (0..dimension * dimension)
        .map(|k| {
            let (row, column) = (k / dimension, k % dimension);
            let pairs = (0..dimension)
                .map(|j| (left[row * dimension + j], right[j * dimension + column]))
                .collect();
            dot(reading, pairs)
        })
        .collect()
}
