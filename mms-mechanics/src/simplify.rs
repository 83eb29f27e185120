//! Simplification: of several candidates for a quantity, all of the same exact value, choose the cheapest to
//! compute among those that are accurate. No candidate is best for all quantities.
//!
//! # Candidates
//!
//! The derivation is made once without relations and, if the displacement has some, once more with the motion
//! reduced by them, so that det F = 1 of a rotation is 1 from the start. Of every quantity each form is made that
//! the passes give; all are scheduled. A pass that outgrows the graph is undone.
//!
//! # Cost
//!
//! Operations that depend on X count first, then all. Div P and b, which a solver asks for at every step, are also
//! written with what X determines apart from what t does (`separate`). That candidate is taken where it leaves
//! less to be done at each time, an operation that needs t counted twice, and at most a sixteenth more from a
//! position. Of these two quantities it is also asked what they cost where a product that is added takes no step
//! of its own, as in loops over points on processors with fused multiply-add: then one number can serve in place
//! of two that differ by a constant (`shift`), and constants are added up (`gather`), where that is fewer steps
//! and no more of those that need t. But for Div P and b, no chosen program costs more than the plain one; these
//! may take at most a sixteenth more operations at a point, and some more that are done once.
//!
//! # Accuracy
//!
//! Which candidates are open is the `Form`. The fast form takes the cheapest of all, and loses eps/e where a
//! strain e is small, in W eps/e^2. What the solver asks a material is the same in both.
//!
//! In the stable form, the default, every quantity is within 64 eps of its largest magnitude over the declared
//! body and time window, at any amplitude down to 1e-12 of the size (`tests/stable/`). Quantities that vanish with
//! the strain (u, H, E, W, stress) are made of H after cancellation rewriting (`settle`), and of C - I and J - 1
//! that are reduced in half of the angles that the field turns by: cos a = 1 - 2 h^2 with h = sin(a/2), so that a
//! normal form is a polynomial in what is small with the angle, and a rotation of order one leaves nothing. All
//! others are of the size of 1, of X or of a second derivative; errors of eps do them no harm, and they may be
//! made of F = I + H, with ln J of a product. Where moduli depend on X, so does a part of Div P that is as small
//! as the stress is: then Div P and b too are made of the rewritten H.
//!
//! A first-order bound of the rounding error (`mechanics/rounding.rs`), at places of the body, holds candidates to
//! digits. The separated and shifted forms of Div P and b are taken only if that bound grows by half at most. In
//! the stable form it is asked for every quantity: a candidate beyond 64 roundings of the largest value, and 16
//! times the least bound, gives place to another one of at most twice the operations at a point. So rewritten
//! forms, which may lose digits at large strains that H itself keeps, give place there to what is 16 times as
//! exact. `mechanics/amplitude.rs` says which candidates keep their digits at a small amplitude; these go before
//! cheap ones.
//!
//! `tests/operations.rs` holds operation counts to bounds.

use std::collections::BTreeMap;

use crate::amplitude::Amplitude;
use crate::derivation::derive_settled;
use crate::derivation::{Derivation, derive};
use crate::kinematics::Route;
use crate::model::Model;
use crate::model::RigidMotion;
use crate::rounding::Rounding;
use mms_program::schedule::{Cost, cost, steps};
use mms_spec::Form;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::absorb::absorb;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::gather::gather;
use mms_symbolic::pass::nest::nest;
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::{Relations, lateness};
use mms_symbolic::pass::separate::separate;
use mms_symbolic::pass::shift::shift;

/// What a solver asks for at every step, and may keep of points as far as X determines it; and what that is made of.
const FORCES: [Quantity; 5] = [
    Quantity::DivP,
    Quantity::DivSigma,
    Quantity::BodyForce,
    Quantity::BodyForceDensity,
    Quantity::CurrentBodyForceDensity,
];

/// The components of quantities.
type Quantities = BTreeMap<Quantity, Vec<Expr>>;

/// Simplifies those quantities of a derivation without relations that are wanted, and its
/// responses; other quantities stay as they are.
pub fn simplify(
    graph: &mut Graph,
    model: &Model,
    plain: &Derivation,
    form: Form,
    wanted: impl Fn(Quantity) -> bool,
) -> Derivation {
    let relations = Relations::find(graph, &model.displacement);
    let fine = |quantity| wanted(quantity) && is_fine(quantity);
    let coarse = |quantity| wanted(quantity) && !is_fine(quantity);
    // Relations that are used early keep the motion short, and all that follows from it.
    let unrelated = Relations::default();
    let used = if relations.is_empty() { vec![&unrelated] } else { vec![&unrelated, &relations] };
    let mut of_gradient = vec![plain.quantities.clone()];
    of_gradient.extend(derived(graph, model, Route::Gradient, &used[1..]));
    let of_deformation = derived(graph, model, Route::Deformation, &used);
    let all = [of_gradient.clone(), of_deformation].concat();
    let mut quantities = plain.quantities.clone();
    let (rounding, unasked) = (Rounding::new(graph, model), Rounding::default());
    let cost_alone = Digits { amplitude: None, rounding: &unasked };
    // The fast form is the cheapest, and loses digits at small amplitudes anyway.
    let usual = match form {
        Form::Fast => cost_alone,
        Form::Stable => Digits { rounding: &rounding, ..cost_alone },
    };
    quantities.extend(cheapest(graph, only(&all, coarse), &relations, usual));
    let amplitude = match form {
        Form::Fast => None,
        Form::Stable => Amplitude::find(graph, model),
    };
    let digits = Digits { amplitude: amplitude.as_ref(), rounding: &rounding };
    match form {
        Form::Fast => quantities.extend(cheapest(graph, only(&all, fine), &relations, usual)),
        Form::Stable => {
            let settled = settled(graph, model, &relations, digits, fine).unwrap_or_default();
            let forms = only(&of_gradient, |quantity| {
                let is_exact = |settled: &Vec<Expr>| rounding.is_small(graph, settled);
                fine(quantity) && !settled.get(&quantity).is_some_and(is_exact)
            });
            let before = cheapest(graph, forms, &relations, usual);
            let settled = digits.worth_it(graph, &before, settled);
            quantities.extend(before);
            quantities.extend(settled);
            mend(graph, model, &relations, digits, &mut quantities, coarse);
        }
    }
    for quantity in FORCES.into_iter().filter(|quantity| wanted(*quantity)) {
        let Some(components) = quantities.get_mut(&quantity) else { continue };
        *components = parted(graph, std::mem::take(components), digits);
        *components = fused(graph, std::mem::take(components), digits);
    }
    let responses = vec![plain.responses.clone()];
    Derivation {
        quantities,
        responses: cheapest(graph, responses, &Relations::default(), cost_alone),
    }
}

/// What is asked of a form beside its cost.
#[derive(Clone, Copy)]
struct Digits<'a> {
    /// With what it shall keep its digits where that is small.
    amplitude: Option<&'a Amplitude>,
    /// Where it shall be as exact as others.
    rounding: &'a Rounding,
}

impl Digits<'_> {
    /// Whether components keep their digits at small amplitudes.
    fn are_kept(self, graph: &Graph, components: &[Expr]) -> bool {
        self.amplitude.is_none_or(|amplitude| amplitude.keeps(graph, components))
    }

    /// Those of the settled forms that are about as exact as what was there before, or exact enough. They come first,
    /// for strains may become small with other parameters than an amplitude; but large ones they may make worse.
    fn worth_it(self, graph: &Graph, before: &Quantities, mut settled: Quantities) -> Quantities {
        settled.retain(|quantity, settled| {
            let mut ways = vec![&settled[..]];
            let before = before.get(quantity).filter(|before| self.are_kept(graph, before));
            ways.extend(before.map(|before| &before[..]));
            self.rounding.first(graph, &ways) == Some(settled)
        });
        settled
    }

    /// Whether `after` is as good as `before`.
    fn allow(self, graph: &Graph, before: &[Expr], after: &[Expr]) -> bool {
        self.are_kept(graph, after) && self.rounding.allows(graph, before, after)
    }
}

/// What a motion comes to by one route, with each of these relations; what would outgrow the graph is left out.
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

/// Of each form these quantities alone.
fn only(forms: &[Quantities], kept: impl Fn(Quantity) -> bool) -> Vec<Quantities> {
    let mut forms = forms.to_vec();
    for form in &mut forms {
        form.retain(|quantity, _| kept(*quantity));
    }
    forms
}

/// Quantities that vanish with the displacement or the strain, with all that cancels taken apart: see
/// [`derive_settled`].
fn settled(
    graph: &mut Graph,
    model: &Model,
    relations: &Relations,
    digits: Digits<'_>,
    is_fine: impl Fn(Quantity) -> bool,
) -> Option<Quantities> {
    let amplitude = digits.amplitude;
    let settled = graph.attempt(|graph| derive_settled(graph, model, relations, amplitude));
    let forms = only(&[settled?.ok()??], is_fine);
    // To multiply out what was settled would undo it, modulo the relations of whole angles alone
    // it does not: they do not occur in what is small.
    let rewrite = |graph: &mut Graph, components: Vec<Expr>| {
        let mut ways = kept_apart(graph, components.clone());
        if !relations.is_empty() {
            ways.extend(graph.attempt(|graph| reduce(graph, &components, relations)));
        }
        ways
    };
    Some(cheapest_of(graph, &forms, rewrite, digits))
}

/// Other quantities, where they lose digits at small amplitudes, in a form that keeps more.
fn mend(
    graph: &mut Graph,
    model: &Model,
    relations: &Relations,
    digits: Digits<'_>,
    quantities: &mut Quantities,
    is_coarse: impl Fn(Quantity) -> bool,
) {
    let amplitude = digits.amplitude;
    let coarse = |quantities: &Quantities| {
        let coarse = quantities.iter().filter(|(quantity, _)| is_coarse(**quantity));
        coarse.map(|(quantity, components)| (*quantity, components.clone())).collect::<Quantities>()
    };
    // The part of Div P that is due to gradients of the moduli is as small as the stress is.
    let is_graded = is_graded(graph, model);
    let mut lost = coarse(quantities);
    lost.retain(|quantity, components| {
        is_graded && FORCES.contains(quantity) || !digits.are_kept(graph, components)
    });
    if !lost.is_empty() {
        let derived = derived(graph, model, Route::Settled(amplitude), &[relations]);
        let forms = only(&derived, |quantity| lost.contains_key(&quantity));
        let settled = cheapest_of(graph, &forms, kept_apart, digits);
        let settled = digits.worth_it(graph, &lost, settled);
        quantities.extend(settled);
    }
    // Where what is of first order cancels, none of these forms keeps its digits.
    let mut of_second_order = Quantities::new();
    for (quantity, components) in coarse(quantities) {
        let bent = |graph: &mut Graph| amplitude?.of_second_order(graph, &components);
        let bent = graph.attempt(bent).flatten();
        of_second_order.extend(bent.map(|components| (quantity, components)));
    }
    let usual = Digits { amplitude: None, ..digits };
    quantities.extend(cheapest_of(graph, &[of_second_order], kept_apart, usual));
}

/// Whether moduli or the direction of fibres depend on X.
fn is_graded(graph: &Graph, model: &Model) -> bool {
    let fibre = model.fibre.iter().flatten();
    let arguments = model.arguments.iter();
    arguments
        .chain(fibre)
        .flat_map(|argument| graph.symbols(*argument))
        .any(|symbol| matches!(symbol, Symbol::Coordinate(_)))
}

/// Whether a quantity vanishes with the strain or the displacement, so that an error of the size of
/// eps is too much for it. The others are of the size of 1, of X or of a derivative of second order,
/// whatever the strain.
fn is_fine(quantity: Quantity) -> bool {
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
        | Quantity::VonMises => true,
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
        | Quantity::CurrentBodyForceDensity => false,
    }
}

/// The rigid twins of a derivation without relations and of its simplified form, the second one no
/// dearer than the first.
pub fn twins(
    graph: &mut Graph,
    rigid: &RigidMotion,
    [plain, simplified]: [&Derivation; 2],
) -> (Derivation, Derivation) {
    let [plain, simplified] = [plain, simplified].map(|inner| rigid.compose(graph, inner));
    let forms = vec![plain.quantities.clone(), simplified.quantities];
    let digits = Digits { amplitude: None, rounding: &Rounding::default() };
    let quantities = cheapest(graph, forms, &Relations::default(), digits);
    (plain, Derivation { quantities, responses: simplified.responses })
}

/// The cheapest components for every key, of which some forms are known; of equals, the first.
fn cheapest<K: Ord + Copy>(
    graph: &mut Graph,
    forms: Vec<BTreeMap<K, Vec<Expr>>>,
    relations: &Relations,
    digits: Digits<'_>,
) -> BTreeMap<K, Vec<Expr>> {
    cheapest_of(graph, &forms, |graph, components| ways(graph, components, relations), digits)
}

/// The same of what `rewrite` makes of each form: of those that keep their digits at a small amplitude, if there are
/// such, and that are as exact as others.
fn cheapest_of<K: Ord + Copy>(
    graph: &mut Graph,
    forms: &[BTreeMap<K, Vec<Expr>>],
    rewrite: impl Fn(&mut Graph, Vec<Expr>) -> Vec<Vec<Expr>>,
    digits: Digits<'_>,
) -> BTreeMap<K, Vec<Expr>> {
    let mut written = Vec::new();
    if graph.work().is_over() {
        return forms.first().cloned().unwrap_or_default();
    }
    for form in forms {
        let components: Vec<Expr> = form.values().flatten().copied().collect();
        written.extend(rewrite(graph, components));
    }
    let mut position = 0;
    let mut best = BTreeMap::new();
    for (key, components) in forms.first().into_iter().flatten() {
        let range = position..position + components.len();
        position = range.end;
        if graph.work().is_over() {
            best.insert(*key, components.clone());
            continue;
        }
        let mut costs = BTreeMap::<&[Expr], Cost>::new();
        let mut ways: Vec<&[Expr]> = written.iter().map(|way| &way[range.clone()]).collect();
        for way in &ways {
            costs.entry(way).or_insert_with(|| cost(graph, way));
        }
        ways.sort_by_key(|way| costs[way]);
        ways.dedup();
        let are_kept = |way: &&[Expr]| digits.are_kept(graph, way);
        if ways.iter().any(&are_kept) {
            ways.retain(are_kept);
        }
        // Digits are not bought at any price.
        let least = ways.first().map_or(0, |way| costs[way].per_point);
        ways.retain(|way| costs[way].per_point <= 2 * least);
        let cheapest = digits.rounding.first(graph, &ways);
        best.insert(*key, cheapest.map_or_else(|| components.clone(), <[Expr]>::to_vec));
    }
    best
}

/// Components with what X determines apart from what t does, where that is worth it and as exact.
fn parted(graph: &mut Graph, components: Vec<Expr>, digits: Digits<'_>) -> Vec<Expr> {
    let is_better = |graph: &Graph, parted: &[Expr]| {
        let is_worth_it = cost(graph, &components).is_worth(cost(graph, parted));
        is_worth_it && digits.allow(graph, &components, parted)
    };
    match graph.attempt(|graph| separate(graph, &components)) {
        Some(parted) if parted != components && is_better(graph, &parted) => parted,
        _ => components,
    }
}

/// Components with one number in place of two that differ by a constant, and constants added up, where products that are
/// added cost nothing and it is worth it and as exact.
fn fused(graph: &mut Graph, components: Vec<Expr>, digits: Digits<'_>) -> Vec<Expr> {
    let shifted = graph.attempt(|graph| shift(graph, &components));
    let shifted = shifted.filter(|shifted| *shifted != components);
    let mut ways = shifted.map_or_else(Vec::new, |shifted| kept_apart(graph, shifted));
    ways.push(components.clone());
    for way in ways.clone() {
        ways.extend(graph.attempt(|graph| gather(graph, &way)));
    }
    ways.retain(|way| *way != components);
    let before = steps(graph, &components);
    let counted = ways.into_iter().map(|way| (steps(graph, &way), way));
    let mut better: Vec<_> = counted.filter(|(steps, _)| before.is_worth(*steps)).collect();
    better.sort_by_key(|(steps, _)| *steps);
    let best = better.into_iter().find(|(_, way)| digits.allow(graph, &components, way));
    best.map_or(components, |(_, way)| way)
}

/// Expressions as they are, and with factors taken out or in; no sum is multiplied out.
fn kept_apart(graph: &mut Graph, components: Vec<Expr>) -> Vec<Vec<Expr>> {
    let mut ways = vec![components.clone()];
    ways.extend(graph.attempt(|graph| nest(graph, &components, &lateness)));
    ways.extend(graph.attempt(|graph| {
        let factored = factor(graph, &components);
        absorb(graph, &factored)
    }));
    ways.extend(graph.attempt(|graph| factor(graph, &components)));
    ways
}

/// Expressions as they are, and rewritten; what would outgrow the graph is left out.
///
/// They are rewritten together, since what they have in common is then rewritten once.
pub fn ways(graph: &mut Graph, components: Vec<Expr>, relations: &Relations) -> Vec<Vec<Expr>> {
    let mut ways = kept_apart(graph, components.clone());
    let among = Relations::find(graph, &components).at_points(graph);
    let all = [Some(relations.clone()), relations.thorough(), Some(among)];
    for relations in all.into_iter().flatten().filter(|relations| !relations.is_empty()) {
        ways.extend(graph.attempt(|graph| reduce(graph, &components, &relations)));
    }
    ways
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
        let digits = Digits { amplitude: None, rounding: &Rounding::default() };
        let after = fused(&mut graph, before.clone(), digits);
        let [before, after] = [before, after].map(|components| steps(&graph, &components));
        // x^2, w, w y and two steps for the sum; then x^2 - 2, w y, and (b + c) w + (a + 2 c).
        assert_eq!((before.per_point, after.per_point), (5, 3));
    }
}
