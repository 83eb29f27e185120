//! Subtracts whole turns from the part of an angle that is known before X is.
//!
//! In sin(k X - c t) the rounding of c t would cause an error of eps times c t. So the sine becomes sin(k X - r), where r is c
//! t less whole turns, subtracted with the digits of the stage Time. An angle of four turns or fewer stays as it is, and its
//! evaluation keeps all bits (`Scalar::within_turns` of `mms-math`); in radians, an angle beyond 2^50 stays, too.

use super::substitute::rebuild;
use crate::expr::{Expr, Function, Graph, Node, Rational, Stage};

/// The largest number of products and sums within each other that are multiplied out.
const NESTED: usize = 8;

/// Subtracts whole turns from the parts of the angles of sines and cosines in `roots` that need t and no X.
pub fn whole_turns(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| {
        let reduced = match &node {
            Node::Call(function, angle) => reduced(graph, *function, angle[0]),
            _ => None,
        };
        match (node, reduced) {
            (Node::Call(function, _), Some(angle)) => graph.call(function, &[angle]),
            (node, _) => graph.remake(node),
        }
    })
}

/// The angle of a sine or a cosine with whole turns subtracted from a part of it, if there is such a part beside one that needs
/// X.
fn reduced(graph: &mut Graph, function: Function, angle: Expr) -> Option<Expr> {
    // A bound that is proved for the angle is valid without its turns, too.
    if let Node::Small(small, angle) = *graph.node(angle) {
        let reduced = reduced(graph, function, angle)?;
        return Some(graph.small(small, reduced));
    }
    let within = match function {
        Function::Sin | Function::Cos => Function::WithinTurns,
        Function::SinPi | Function::CosPi => Function::WithinTurnsPi,
        _ => return None,
    };
    if graph.stage(angle) != Stage::PointTime {
        return None;
    }
    let [late, early] = parts(graph, angle, NESTED)?;
    // A part that is subtracted as a whole stays subtracted.
    let sign = if graph.leads_with_minus(early) { -1 } else { 1 };
    let early = graph.scale(early, sign);
    let early = graph.call(within, &[early]);
    Some(graph.sum([(late, Rational::ONE), (early, sign.into())]))
}

/// The part of an angle that needs X, and the part that needs t and no X, if the angle is their sum, possibly times a factor
/// without X.
fn parts(graph: &mut Graph, angle: Expr, nested: usize) -> Option<[Expr; 2]> {
    let nested = nested.checked_sub(1)?;
    match graph.node(angle).clone() {
        Node::Sum(constant, terms) => {
            let one = graph.number(1);
            let [mut late, mut early] = [vec![], vec![(one, constant)]];
            for (term, coefficient) in terms {
                if !graph.stage(term).needs_point() {
                    early.push((term, coefficient));
                } else if let Some(parts) = parts(graph, term, nested) {
                    late.push((parts[0], coefficient.clone()));
                    early.push((parts[1], coefficient));
                } else {
                    late.push((term, coefficient));
                }
            }
            let parts = [late, early].map(|terms| graph.sum(terms));
            (graph.stage(parts[1]) == Stage::Time).then_some(parts)
        }
        Node::Product(mut factors) => {
            let needs_point = |(base, _): &(Expr, Rational)| graph.stage(*base).needs_point();
            let place = factors.iter().position(needs_point)?;
            let (sum, power) = factors.remove(place);
            if !power.is_one() || factors.iter().any(needs_point) {
                return None;
            }
            let parts = parts(graph, sum, nested)?;
            Some(parts.map(|part| {
                let part = (part, Rational::ONE);
                graph.product(factors.iter().cloned().chain([part]))
            }))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::{Small, Symbol};

    #[test]
    fn turns_are_taken_off_what_is_known_before_x_is() {
        let mut graph = Graph::default();
        let [k, c] = [0, 1].map(|index| graph.symbol(Symbol::Parameter(index)));
        let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        let t = graph.symbol(Symbol::Time);
        let ct = graph.mul(c, t);
        let (one, minus_one) = (Rational::ONE, Rational::NEG_ONE);
        // k (X + Y - c t)
        let sum = graph.sum([(x, one.clone()), (y, one.clone()), (ct, minus_one.clone())]);
        let angle = graph.mul(k, sum);
        let places = graph.add(x, y);
        let late = graph.mul(k, places);
        let early = graph.mul(k, ct);
        for (function, within) in [
            (Function::Sin, Function::WithinTurns),
            (Function::Cos, Function::WithinTurns),
            (Function::SinPi, Function::WithinTurnsPi),
        ] {
            let reduced = graph.call(within, &[early]);
            let reduced = graph.sum([(late, one.clone()), (reduced, minus_one.clone())]);
            let small = [angle, reduced].map(|angle| graph.small(Small::NearZero, angle));
            for [angle, reduced] in [[angle, reduced], small] {
                let root = graph.call(function, &[angle]);
                let expected = graph.call(function, &[reduced]);
                assert_eq!(whole_turns(&mut graph, &[root]), [expected]);
            }
        }
    }

    #[test]
    fn other_angles_and_other_functions_stay_as_they_are() {
        let mut graph = Graph::default();
        let (c, t) = (graph.symbol(Symbol::Parameter(0)), graph.symbol(Symbol::Time));
        let x = graph.symbol(Symbol::Coordinate(0));
        let [with_c, with_t] = [c, t].map(|it| graph.add(x, it));
        let product = graph.mul(x, with_t);
        let sum = graph.add(c, t);
        let angles = [x, t, with_c, product, sum];
        let mut roots: Vec<Expr> =
            angles.iter().map(|angle| graph.call(Function::Sin, &[*angle])).collect();
        roots.push(graph.call(Function::Tan, &[with_t]));
        assert_eq!(whole_turns(&mut graph, &roots), roots);
    }
}
