//! The derivation as text: each quantity in terms of the names that a reader knows by then.

use crate::compile::Compiled;
use crate::expr::print::Names;
use crate::quantity::{Quantity, Shape};

/// A line `symbol = formula`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The left-hand side.
    pub symbol: String,
    /// The right-hand side.
    pub formula: String,
}

/// The field's own definitions, in terms of those before them.
pub fn definitions(compiled: &Compiled) -> Vec<Line> {
    let mut names =
        Names { parameters: compiled.model.names.parameters.clone(), ..Names::default() };
    let mut lines = Vec::new();
    for (expr, name) in &compiled.model.names.expressions {
        lines.push(Line { symbol: name.clone(), formula: compiled.graph.print(*expr, &names) });
        names.expressions.insert(*expr, name.clone());
    }
    lines
}

/// The components of every quantity, in the order of derivation. What a component is called from
/// then on (H, F, J, ...) is what later formulas say.
pub fn derivation(compiled: &Compiled) -> Vec<(Quantity, Vec<Line>)> {
    let mut names = compiled.model.names.clone();
    let mut derivation = Vec::new();
    for quantity in Quantity::ALL {
        let components = &compiled.derivation.quantities[quantity];
        let mut lines = Vec::new();
        for (index, expr) in components.iter().enumerate() {
            let formula = match names.expressions.get(expr) {
                Some(name) => name.clone(),
                None => compiled.graph.print(*expr, &names),
            };
            lines
                .push(Line { symbol: symbol(*quantity, index, compiled.field.dimension), formula });
        }
        for (expr, line) in components.iter().zip(&lines) {
            // A leaf or a number is its own best name.
            if compiled.graph.node(*expr).children().next().is_some() {
                names.expressions.entry(*expr).or_insert_with(|| line.symbol.clone());
            }
        }
        derivation.push((*quantity, lines));
    }
    derivation
}

/// The name of a component: F in 1-D, F_12 for a tensor, u_2 for a vector.
fn symbol(quantity: Quantity, index: usize, dimension: usize) -> String {
    let symbol = quantity.symbol();
    match quantity.shape() {
        Shape::Scalar => symbol.to_string(),
        _ if dimension == 1 => symbol.to_string(),
        Shape::Tensor => format!("{symbol}_{}{}", index / dimension + 1, index % dimension + 1),
        Shape::Vector => format!("{symbol}_{}", index + 1),
    }
}
