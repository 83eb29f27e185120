//! The stress of the undeformed body, P at F = I: whether it is 0, symbolically, or at 16 points for the defaults and 16 within
//! the ranges.
//!
//! Given fields of the material are at their values at rest. A material without a stress at rest has none. A file without some
//! term of W has one, which no proof and no study of this file reveals. It may be intended, so it is a warning.

use mms_math::Scalar as _;

use super::certificate::chart_of;
use super::message;
use crate::bounds::chart::Chart;
use crate::bounds::witness::Witness;
use crate::compile::Compiled;
use mms_mechanics::extent::spread;
use mms_mechanics::{Response, at_rest, is_spherical, pressures};
use mms_program::precise::Precise;
use mms_program::schedule::schedule_plainly;
use mms_spec::diagnostic::Diagnostic;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// The number of points of the body, for the defaults and again for parameters within their ranges.
const POINTS: usize = 16;

/// The part of the longitudinal modulus below which a value may be rounding of 77 digits.
const DOUBT: f64 = 1e-40;

/// The budget of the search, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 20_000_000;

/// The verdict about P at F = I.
#[derive(Clone, Debug, PartialEq)]
pub enum Rest {
    /// The stress is 0, identically or at all examined points.
    Free,
    /// The components of P, row-major, where the greatest of them is greatest; in space if the components within the field's
    /// dimensions are 0.
    /// are 0.
    Stressed(Vec<f64>, Witness),
    /// The components of P likewise, a multiple of I that these given fields of the material set: they include the pressure
    /// that balances it.
    Pressed(Vec<f64>, Vec<String>),
    /// The evaluation takes too long.
    Unknown,
}

impl Rest {
    /// The components that are not 0.
    pub fn stress(&self) -> Option<&[f64]> {
        match self {
            Rest::Stressed(stress, _) | Rest::Pressed(stress, _) => Some(stress),
            Rest::Free | Rest::Unknown => None,
        }
    }

    /// The warning for a user, where there is something to warn of.
    pub fn warning(&self, compiled: &Compiled) -> Option<Diagnostic> {
        match self {
            Rest::Stressed(stress, witness) => {
                Some(message::stressed_at_rest(compiled, stress, witness))
            }
            Rest::Free | Rest::Pressed(..) | Rest::Unknown => None,
        }
    }
}

/// Looks for a stress at rest, with the defaults of the parameters, and then within their ranges.
pub fn stress(compiled: &Compiled) -> Rest {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    graph.work().allow(STEPS);
    let zero = graph.number(0);
    let dimension = compiled.field.space.rows();
    let entries = (0..dimension).flat_map(|i| (0..dimension).map(move |j| Symbol::Gradient(i, j)));
    let undeformed: SortedMap<_, _> = entries.map(|entry| (entry, zero)).collect();
    let responses = &compiled.derived.responses;
    let mut stress =
        substitute(&mut graph, &responses[&Response::FirstPiolaKirchhoff], &undeformed);
    let is_free = |graph: &Graph, stress: &[Expr]| stress.iter().all(|it| graph.is_zero(*it));
    let mut pressed = Vec::new();
    if !compiled.model.givens.is_empty() {
        // Given fields are at rest here; the stress that they cause elsewhere is no stress at rest.
        let [space, _] = at_rest(&mut graph, &compiled.model);
        let (field, material, model) = (&compiled.field, &compiled.material, &compiled.model);
        if is_spherical(&graph, &space) {
            let places = pressures(&mut graph, field, material, model);
            let name = |place: usize| material.givens[place].name.value.clone();
            pressed = places.into_iter().map(name).collect();
        }
        let in_plane = |place: &usize| (place / 3).max(place % 3) < dimension;
        stress = (0..9).filter(in_plane).map(|place| space[place]).collect();
    }
    if is_free(&graph, &stress) {
        // Fibres across a plane body may pull at the constraint that keeps it plane.
        [stress, _] = at_rest(&mut graph, &compiled.model);
    }
    if is_free(&graph, &stress) {
        return Rest::Free;
    }
    let [speed, density] = [Response::WaveSpeed, Response::Density].map(|it| responses[&it][0]);
    let modulus = graph.product([(speed, 2.into()), (density, 1.into())]);
    let of_defaults = chart_of(&mut graph, compiled, &SortedMap::new());
    let of_ranges = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    let formulas = [&stress[..], &[modulus]].concat();
    let found =
        [of_defaults, of_ranges].iter().find_map(|chart| greatest(&mut graph, chart, &formulas));
    match found {
        Some((stress, _)) if !pressed.is_empty() => Rest::Pressed(stress, pressed),
        Some((stress, witness)) => Rest::Stressed(stress, witness),
        None if graph.work().is_over() => Rest::Unknown,
        None => Rest::Free,
    }
}

/// The stress and the place where a component is greatest relative to the modulus, which is the last formula, among points
/// spread over a chart; `None` if all components may be rounding.
fn greatest(graph: &mut Graph, chart: &Chart, formulas: &[Expr]) -> Option<(Vec<f64>, Witness)> {
    let formulas = chart.pull_back(graph, formulas);
    let program = schedule_plainly(graph, &SortedMap::from([((), formulas)]));
    let mut run = chart.run::<Precise, _>(&program);
    let mut found: Option<(f64, Vec<f64>, Witness)> = None;
    for index in 1..=POINTS {
        let fractions = spread(index, chart.variables().len());
        let fractions: Vec<Precise> = fractions.iter().map(Precise::new).collect();
        let mut stress = run.at(&chart.place(&fractions), &[()]).swap_remove(0);
        let modulus = stress.pop()?.magnitude() * Precise::from_f64(DOUBT);
        let is_certain =
            |it: &Precise| it.is_defined() && !it.clone().magnitude().at_most(&modulus);
        if !stress.iter().any(is_certain) {
            continue;
        }
        let stress: Vec<f64> = stress.iter().map(Precise::to_f64).collect();
        let largest =
            stress.iter().fold(0.0, |largest, component| f64::max(largest, component.abs()));
        if found.as_ref().is_none_or(|(known, ..)| largest > *known) {
            found = Some((largest, stress, Witness::at_precise(chart, &fractions).0));
        }
    }
    found.map(|(_, stress, witness)| (stress, witness))
}
