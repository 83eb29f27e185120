//! Simplification: chooses, among several candidates for a quantity with the same exact value, the cheapest to compute of those
//! that are accurate. No candidate is best for all quantities.
//!
//! # Candidates
//!
//! The derivation is made once without relations and, if the displacement has some, once more with the motion reduced by them,
//! so that det F = 1 of a rotation is 1 from the start. `candidates` applies the passes, which give
//! several named forms of every quantity, schedules all forms, and chooses one. A pass that outgrows the graph is undone.
//!
//! # Cost
//!
//! Operations that depend on X count first, then all. Div P and b, which a solver computes in every step, are also written with
//! the part that X determines separate from the part that t determines (`separate`). That candidate is chosen if it needs fewer
//! operations, where an operation that needs t counts twice, and at most a sixteenth more at a point. For these two quantities
//! a second cost counts additions of products as free, as in loops over points on processors with fused multiply-add: one
//! number may then replace two that differ by a constant (`shift`), and constants are added up (`reassociate`), if that takes
//! fewer steps and no more steps that need t. Except for Div P and b, no chosen program costs more than the plain one; these
//! two may take at most a sixteenth more operations at a point, and a few more operations that run once per call.
//!
//! # Accuracy
//!
//! The `Form` determines the open candidates. The fast form chooses the cheapest of all, whose relative error is eps/e at a
//! small strain e, and eps/e^2 in W. The responses of the material are the same in both forms.
//!
//! In the stable form, the default, every quantity is within 64 eps of its largest magnitude over the declared body and time
//! window, at any amplitude down to 1e-12 of the size (`tests/stable/`). Quantities that vanish with the strain (u, H, E, W,
//! stress) are computed from H after cancellation rewriting (`avoid_cancellation`). Their C - I and J - 1 are reduced in terms
//! of half the angles by which the field turns: cos a = 1 - 2 h^2 with h = sin(a/2). Then a normal form is a polynomial in
//! terms that are small with the angle, and a rotation of order one cancels. All other quantities are of the size of 1, of X or
//! of a second derivative; errors of eps do not matter there, and they may be computed from F = I + H, with ln J of a product.
//! If moduli depend on X, a part of Div P is as small as the stress: then Div P and b too are computed from the rewritten H.
//!
//! A first-order bound of the rounding error (`rounding.rs`), at places of the body, decides whether a candidate is
//! accurate. The separated and shifted forms of Div P and b are chosen only if that bound grows by at most half. In the stable
//! form every quantity has a bound: a candidate beyond 64 roundings of the largest value, and beyond 16 times the least bound,
//! is replaced by another one with at most twice the operations at a point. So rewritten forms, which may lose digits at large
//! strains that H itself keeps, are replaced there by forms that are 16 times as exact. `amplitude.rs` finds the
//! candidates that keep their digits at a small amplitude; these precede cheap ones.
//!
//! `tests/operations.rs` bounds the operation counts.

use crate::amplitude::Amplitude;
use crate::candidates::{
    Candidate, Components, RequiredAccuracy, Rewriting, candidates, choose_all, reduced, unexpanded,
};
use crate::derivation::derive_without_cancellation;
use crate::derivation::{Derivation, derive};
use crate::kinematics::Route;
use crate::model::Model;
use crate::model::RigidMotion;
use crate::rounding::Rounding;
use mms_program::schedule::{cost, steps};
use mms_spec::Form;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::reassociate::reassociate;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::separate::separate;
use mms_symbolic::pass::shift::shift;
use mms_symbolic::sorted::SortedMap;

/// The quantities that a solver computes in every step, whose X part may be stored for points; and the quantities that they are
/// made of.
const FORCES: [Quantity; 5] = [
    Quantity::DivP,
    Quantity::DivSigma,
    Quantity::BodyForce,
    Quantity::BodyForceDensity,
    Quantity::CurrentBodyForceDensity,
];

/// The components of quantities.
type Quantities = Components<Quantity>;

/// Simplifies the wanted quantities of a derivation without relations, and its responses; other quantities stay as they are.
pub fn simplify(
    graph: &mut Graph,
    model: &Model,
    plain: &Derivation,
    form: Form,
    wanted: impl Fn(Quantity) -> bool,
) -> Derivation {
    let relations = Relations::find(graph, &model.displacement);
    let of_strain = |quantity| wanted(quantity) && vanishes_with_the_strain(quantity);
    let others = |quantity| wanted(quantity) && !vanishes_with_the_strain(quantity);
    // Early relations keep the motion short, and everything that follows from it.
    let unrelated = Relations::default();
    let used = if relations.is_empty() { vec![&unrelated] } else { vec![&unrelated, &relations] };
    let mut by_gradient = vec![plain.quantities.clone()];
    by_gradient.extend(derived(graph, model, Route::Gradient, &used[1..]));
    let by_deformation = derived(graph, model, Route::Deformation, &used);
    let by_all_routes = [by_gradient.clone(), by_deformation].concat();
    let (rounding, unasked) = (Rounding::new(graph, model), Rounding::default());
    let any = RequiredAccuracy { amplitude: None, rounding: &unasked };
    let exact = RequiredAccuracy { rounding: &rounding, ..any };
    let mut quantities = plain.quantities.clone();
    let amplitude;
    let accuracy = match form {
        // The cheapest, which loses digits at small amplitudes.
        Form::Fast => {
            let all = only(&by_all_routes, others);
            quantities.extend(cheapest(graph, &all, &relations, any));
            let all = only(&by_all_routes, of_strain);
            quantities.extend(cheapest(graph, &all, &relations, any));
            exact
        }
        Form::Stable => {
            let all = only(&by_all_routes, others);
            quantities.extend(cheapest(graph, &all, &relations, exact));
            amplitude = Amplitude::find(graph, model);
            let accuracy = RequiredAccuracy { amplitude: amplitude.as_ref(), ..exact };
            let rewritten = rewritten(graph, model, &relations, accuracy, of_strain);
            let rewritten = rewritten.unwrap_or_default();
            let derived = only(&by_gradient, |quantity| {
                let is_exact = |rewritten: &Vec<Expr>| rounding.is_small(graph, rewritten);
                of_strain(quantity) && !rewritten.get(&quantity).is_some_and(is_exact)
            });
            let usual = cheapest(graph, &derived, &relations, exact);
            let rewritten = preferred(graph, rewritten, &usual, accuracy);
            quantities.extend(usual);
            quantities.extend(rewritten);
            repair(graph, model, &relations, accuracy, &mut quantities, others);
            accuracy
        }
    };
    for quantity in FORCES.into_iter().filter(|quantity| wanted(*quantity)) {
        let Some(components) = quantities.get_mut(&quantity) else { continue };
        *components = parted(graph, std::mem::take(components), accuracy);
        *components = fused(graph, std::mem::take(components), accuracy);
    }
    let responses = cheapest(graph, std::slice::from_ref(&plain.responses), &unrelated, any);
    Derivation { quantities, responses }
}

/// Derives the quantities of a motion by one route, with each of these relations; derivations that outgrow the graph are
/// omitted.
fn derived(
    graph: &mut Graph,
    model: &Model,
    route: Route<'_>,
    used: &[&Relations],
) -> Vec<Quantities> {
    let with = |relations: &&Relations| {
        let derived = graph.attempt(|graph| derive(graph, model, relations, route));
        derived.and_then(Result::ok).map(|derived| derived.quantities)
    };
    used.iter().filter_map(with).collect()
}

/// The wanted quantities of each derivation.
fn only(derived: &[Quantities], wanted: impl Fn(Quantity) -> bool) -> Vec<Quantities> {
    let mut derived = derived.to_vec();
    for quantities in &mut derived {
        quantities.retain(|quantity, _| wanted(*quantity));
    }
    derived
}

/// The chosen components among all candidates of several derivations of the same quantities.
fn cheapest<K: Ord + Copy>(
    graph: &mut Graph,
    derived: &[Components<K>],
    relations: &Relations,
    accuracy: RequiredAccuracy<'_>,
) -> Components<K> {
    let all = |graph: &mut Graph, derived: &_| candidates(graph, derived, relations);
    cheapest_of(graph, derived, all, accuracy)
}

/// The chosen components among the candidates that `candidates` makes.
fn cheapest_of<K: Ord + Copy>(
    graph: &mut Graph,
    derived: &[Components<K>],
    candidates: impl Fn(&mut Graph, &Components<K>) -> Vec<Candidate<K>>,
    accuracy: RequiredAccuracy<'_>,
) -> Components<K> {
    let Some(first) = derived.first() else { return Components::new() };
    if graph.work().is_over() {
        return first.clone();
    }
    let all: Vec<_> = derived.iter().flat_map(|derived| candidates(graph, derived)).collect();
    choose_all(graph, first, &all, accuracy)
}

/// Quantities that vanish with the displacement or the strain, after cancellation rewriting: see
/// [`derive_without_cancellation`].
fn rewritten(
    graph: &mut Graph,
    model: &Model,
    relations: &Relations,
    accuracy: RequiredAccuracy<'_>,
    wanted: impl Fn(Quantity) -> bool,
) -> Option<Quantities> {
    let amplitude = accuracy.amplitude;
    let stable =
        graph.attempt(|graph| derive_without_cancellation(graph, model, relations, amplitude));
    let stable = only(&[stable?.ok()??], wanted);
    // Multiplying out would undo the rewriting. Reducing modulo the relations of whole angles does not: these do not occur in
    // small terms.
    let candidates = |graph: &mut Graph, derived: &_| {
        let mut all = unexpanded(graph, derived);
        all.extend(reduced(graph, Rewriting::Reduced, derived, relations));
        all
    };
    Some(cheapest_of(graph, &stable, candidates, accuracy))
}

/// The rewritten quantities that are about as exact as the usual ones, or exact enough. They have precedence, for strains may
/// become small with other parameters than an amplitude; but at large strains they may be less exact.
fn preferred(
    graph: &Graph,
    mut rewritten: Quantities,
    usual: &Quantities,
    accuracy: RequiredAccuracy<'_>,
) -> Quantities {
    rewritten.retain(|quantity, rewritten| {
        let mut ways = vec![&rewritten[..]];
        let usual = usual.get(quantity).filter(|usual| accuracy.is_kept(graph, usual));
        ways.extend(usual.map(|usual| &usual[..]));
        accuracy.rounding.first(graph, &ways) == Some(rewritten)
    });
    rewritten
}

/// Replaces other quantities that lose digits at small amplitudes by forms that keep more.
fn repair(
    graph: &mut Graph,
    model: &Model,
    relations: &Relations,
    accuracy: RequiredAccuracy<'_>,
    quantities: &mut Quantities,
    others: impl Fn(Quantity) -> bool,
) {
    let amplitude = accuracy.amplitude;
    // The part of Div P that is due to gradients of the moduli is as small as the stress is.
    let is_graded = is_graded(graph, model);
    let mut lost = only(std::slice::from_ref(quantities), &others).swap_remove(0);
    lost.retain(|quantity, components| {
        is_graded && FORCES.contains(quantity) || !accuracy.is_kept(graph, components)
    });
    if !lost.is_empty() {
        let derived = derived(graph, model, Route::Settled(amplitude), &[relations]);
        let derived = only(&derived, |quantity| lost.contains_key(&quantity));
        let rewritten = cheapest_of(graph, &derived, unexpanded, accuracy);
        quantities.extend(preferred(graph, rewritten, &lost, accuracy));
    }
    // If all terms of first order cancel, none of these forms keeps its digits.
    let mut of_second_order = Quantities::new();
    for (quantity, components) in only(std::slice::from_ref(quantities), &others).swap_remove(0) {
        let bent = |graph: &mut Graph| amplitude?.of_second_order(graph, &components);
        let bent = graph.attempt(bent).flatten();
        of_second_order.extend(bent.map(|components| (quantity, components)));
    }
    let exact = RequiredAccuracy { amplitude: None, ..accuracy };
    quantities.extend(cheapest_of(graph, &[of_second_order], unexpanded, exact));
}

/// Whether moduli, given fields or the direction of fibres depend on X.
fn is_graded(graph: &Graph, model: &Model) -> bool {
    let fibre = model.fibre.iter().flatten();
    let arguments = model.arguments.iter().chain(&model.givens);
    arguments
        .chain(fibre)
        .flat_map(|argument| graph.symbols(*argument))
        .any(|symbol| matches!(symbol, Symbol::Coordinate(_)))
}

/// Whether a quantity vanishes with the strain or the displacement, so that an error of the size of eps is too large for it.
/// The others are of the size of 1, of X or of a second derivative at any strain.
fn vanishes_with_the_strain(quantity: Quantity) -> bool {
    match quantity {
        Quantity::Displacement
        | Quantity::DisplacementGradient
        | Quantity::GreenLagrange
        | Quantity::StrainEnergy
        | Quantity::FirstPiolaKirchhoff
        | Quantity::NominalStress
        | Quantity::CauchyStress
        | Quantity::KirchhoffStress
        | Quantity::Traction
        | Quantity::SecondPiolaKirchhoff
        | Quantity::Pressure
        | Quantity::VonMises
        | Quantity::SmallStrain => true,
        Quantity::Position
        | Quantity::Velocity
        | Quantity::Acceleration
        | Quantity::DeformationGradient
        | Quantity::Jacobian
        | Quantity::RightCauchyGreen
        | Quantity::LeftCauchyGreen
        | Quantity::MassDensity
        | Quantity::DivP
        | Quantity::DivSigma
        | Quantity::BodyForce
        | Quantity::BodyForceDensity
        | Quantity::CurrentBodyForceDensity
        | Quantity::Own(_) => false,
    }
}

/// The rigid twins of a derivation without relations and of its simplified form; the second one costs no more than the first.
pub fn twins(
    graph: &mut Graph,
    rigid: &RigidMotion,
    [plain, simplified]: [&Derivation; 2],
) -> (Derivation, Derivation) {
    let [plain, simplified] = [plain, simplified].map(|inner| rigid.compose(graph, inner));
    let derived = [plain.quantities.clone(), simplified.quantities];
    let any = RequiredAccuracy { amplitude: None, rounding: &Rounding::default() };
    let quantities = cheapest(graph, &derived, &Relations::default(), any);
    (plain, Derivation { quantities, responses: simplified.responses })
}

/// Components with the parts of X and of t separated, if that pays and is as exact.
fn parted(graph: &mut Graph, components: Vec<Expr>, accuracy: RequiredAccuracy<'_>) -> Vec<Expr> {
    let is_better = |graph: &Graph, parted: &[Expr]| {
        let is_worth_it = cost(graph, &components).is_worth(cost(graph, parted));
        is_worth_it && accuracy.allows(graph, &components, parted)
    };
    match graph.attempt(|graph| separate(graph, &components)) {
        Some(parted) if parted != components && is_better(graph, &parted) => parted,
        _ => components,
    }
}

/// Components with one number instead of two that differ by a constant, and with constants added up, if that pays where
/// additions of products are free, and is as exact.
fn fused(graph: &mut Graph, components: Vec<Expr>, accuracy: RequiredAccuracy<'_>) -> Vec<Expr> {
    let shifted = graph.attempt(|graph| shift(graph, &components));
    let shifted = shifted.filter(|shifted| *shifted != components);
    let shifted = shifted.map(|shifted| unexpanded(graph, &SortedMap::from([((), shifted)])));
    let shifted = shifted.into_iter().flatten().map(|mut it| it.components.remove(&()));
    let mut ways: Vec<Vec<Expr>> = shifted.flatten().collect();
    ways.push(components.clone());
    for way in ways.clone() {
        ways.extend(graph.attempt(|graph| reassociate(graph, &way)));
    }
    ways.retain(|way| *way != components);
    let before = steps(graph, &components);
    let counted = ways.into_iter().map(|way| (steps(graph, &way), way));
    let mut better: Vec<_> = counted.filter(|(steps, _)| before.is_worth(*steps)).collect();
    better.sort_by_key(|(steps, _)| *steps);
    let best = better.into_iter().find(|(_, way)| accuracy.allows(graph, &components, way));
    best.map_or(components, |(_, way)| way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mms_symbolic::expr::Rational;

    #[test]
    fn a_number_serves_in_place_of_one_that_differs_by_a_constant() {
        let mut graph = Graph::default();
        let [a, b, c] = [0, 1, 2].map(|index| graph.symbol(Symbol::Parameter(index)));
        let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        // With w = x^2 - 2: w y, and a + b w + c x^2.
        let square = graph.mul(x, x);
        let two = graph.number(-2);
        let w = graph.add(square, two);
        let first = graph.mul(w, y);
        let [second, third] =
            [(b, w), (c, square)].map(|(factor, number)| graph.mul(factor, number));
        let second = graph.sum([a, second, third].map(|term| (term, Rational::ONE)));
        let before = vec![first, second];
        let any = RequiredAccuracy { amplitude: None, rounding: &Rounding::default() };
        let after = fused(&mut graph, before.clone(), any);
        let [before, after] = [before, after].map(|components| steps(&graph, &components));
        // x^2, w, w y and two steps for the sum; then x^2 - 2, w y, and (b + c) w + (a + 2 c).
        assert_eq!((before.per_point, after.per_point), (5, 3));
    }
}
