//! Whether the material is an elastic solid throughout: the density is positive over the body and the ranges of parameters, and
//! the moduli at F = I are positive definite over the ranges.
//!
//! For the defaults, `declared` checks both. It alone checks moduli that depend on no range: a fluid has mu = 0.

use super::message;
use super::sign::{Positive, Sign};
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::Formulas;
use crate::compile::Compiled;
use mms_spec::diagnostic::Diagnostic;
use mms_symbolic::expr::{Expr, Graph, Symbol};

/// The largest number of variables along which corners are examined. Wrong ranges are wrong at their ends first of all.
const MOST_OF_CORNERS: usize = 8;

/// An expression that must be positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// rho0.
    Density,
    /// The modulus at F = I of this name.
    Modulus(&'static str),
}

impl Part {
    /// The name of the part.
    pub fn name(self) -> &'static str {
        match self {
            Part::Density => "rho0",
            Part::Modulus(name) => name,
        }
    }

    /// The formula of the part, in X and all parameters.
    pub(super) fn formula(self, graph: &mut Graph, compiled: &Compiled) -> Option<Expr> {
        match self {
            Part::Density => Some(compiled.model.density),
            Part::Modulus(name) => {
                let moduli = mms_mechanics::moduli(graph, &compiled.model);
                moduli.into_iter().find(|(other, _)| *other == name).map(|(_, formula)| formula)
            }
        }
    }
}

/// The sign of the density, if it varies, and of each modulus that depends on a range; and the number of cells, at most `limit`
/// for each.
pub(super) fn bound(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    limit: usize,
) -> (Vec<(Part, Sign)>, usize) {
    let mut parts = vec![(Part::Density, compiled.model.density)];
    if chart.varying_parameters().next().is_some() {
        let moduli = mms_mechanics::moduli(graph, &compiled.model);
        parts.extend(moduli.into_iter().map(|(name, formula)| (Part::Modulus(name), formula)));
    }
    let (mut signs, mut cells) = (Vec::new(), 0);
    for (part, formula) in parts {
        let formula = chart.pull_back(graph, &[formula]);
        let symbols = graph.symbols(formula[0]);
        let variables = chart.variables().iter().enumerate();
        let mut variables: Vec<_> = variables.filter(|(_, it)| symbols.contains(it)).collect();
        let is_ranged = variables.iter().any(|(_, it)| matches!(it, Symbol::Parameter(_)));
        if !is_ranged && (part != Part::Density || variables.is_empty()) {
            continue;
        }
        variables.truncate(MOST_OF_CORNERS);
        let variables: Vec<_> = variables.into_iter().map(|(index, _)| index).collect();
        let formulas = Formulas::new(graph, chart, &formula);
        let positive = Positive::new(chart, &formulas);
        let corner = positive.at_corners(&variables).map(|sign| (sign, 0));
        let (sign, taken) = corner.unwrap_or_else(|| positive.least(limit));
        signs.push((part, sign));
        cells += taken;
    }
    (signs, cells)
}

/// A place at which a short search finds an expression that is not positive.
pub(super) fn refuted(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    limit: usize,
) -> Option<Diagnostic> {
    let (signs, _) = bound(graph, chart, compiled, limit);
    let refuted = |(part, sign): &(Part, Sign)| match sign {
        Sign::Refuted(..) => message::not_solid(compiled, *part, sign),
        Sign::Positive(_) | Sign::Unproved(..) => None,
    };
    signs.iter().find_map(refuted)
}
