//! Polynomial identities between subexpressions: s^2 + c^2 = 1 for the sine and cosine of an angle, sinh^2 = cosh^2 - 1, and
//! R^2 = X^2 + Y^2 for a root of a sum of squares, as `sqrt` or `hypot` in the file.
//!
//! Each relation replaces the square of another expression. The leading terms are thus coprime, the relations are a Groebner
//! basis already, and replacing until nothing can be replaced gives one normal form (Cox, Little & O'Shea, Ideals, Varieties,
//! and Algorithms, 2015, section 2.9). The replacement ends, since the replacement of a square contains neither that square nor
//! one that an earlier relation replaces.

use super::polynomial::{Monomial, Polynomial};
use crate::expr::{Expr, Function, Graph, HALF, Node, Rational, Stage};
use crate::sorted::{SortedMap, SortedSet};

fn half_of(graph: &mut Graph, angle: Expr) -> Expr {
    graph.scale(angle, HALF)
}

/// The relations of a set of expressions.
#[derive(Clone, Debug, Default)]
pub struct Relations {
    /// The polynomial that the square of an expression equals.
    squares: SortedMap<Expr, Polynomial>,
    /// The root of each radicand.
    roots: SortedMap<Expr, Expr>,
    /// Sines and cosines, hyperbolic ones included.
    circular: SortedSet<Expr>,
    /// The expressions whose squares are in a radicand.
    squared: SortedSet<Expr>,
    /// Whether functions of a single root are multiplied out as well.
    thorough: bool,
    /// Whether functions of a root have high powers of sums, such as (1 - (R - 1)^2)^2: multiplied
    /// out, their terms are large and cancel.
    steep: bool,
}

/// The rank of an expression by its stage, the latest stage first: 0 if it needs X, 1 if it needs t and not X, else 2.
pub fn latest_stage(graph: &Graph, expr: Expr) -> u8 {
    match graph.stage(expr) {
        Stage::Point | Stage::PointTime => 0,
        Stage::Time => 1,
        Stage::Parameter => 2,
    }
}

impl Relations {
    /// Finds the relations between the sub-expressions of `expressions`.
    ///
    /// Pairs of sine and cosine count only if both occur in `expressions`. A displacement that rotates contains both; one that
    /// oscillates contains both only together with its derivatives, where no terms would cancel.
    pub fn find(graph: &mut Graph, expressions: &[Expr]) -> Self {
        let mut relations = Relations::default();
        let reachable = graph.reachable(expressions);
        for expr in reachable.iter().copied() {
            let known =
                |node: Node| graph.find(&node).filter(|expr| reachable.binary_search(expr).is_ok());
            match graph.node(expr).clone() {
                Node::Call(Function::Sin, angle) => {
                    let cosine = known(Node::Call(Function::Cos, angle));
                    relations.add_pair(graph, expr, cosine, [1, -1]);
                }
                Node::Call(Function::Sinh, angle) => {
                    let cosine = known(Node::Call(Function::Cosh, angle));
                    relations.add_pair(graph, expr, cosine, [-1, 1]);
                }
                Node::Product(factors) => {
                    for (base, exponent) in factors {
                        if exponent.denominator().is_one() || exponent.denominator() > &2u8.into() {
                            continue;
                        }
                        relations.add_root(graph, base);
                    }
                }
                _ => {}
            }
        }
        relations.steep = relations.is_steep(graph, &reachable);
        relations
    }

    /// The relations between sine and cosine of half the angles whose sine and cosine occur in `expressions`: cos^2 = 1 -
    /// sin^2, so that normal forms are polynomials in terms that are small with the angle. Roots are as in [`Relations::find`].
    ///
    /// Only angles whose half occurs in `used` count. See [`Relations::halve`].
    pub fn of_half_angles(graph: &mut Graph, expressions: &[Expr], used: &[Expr]) -> Self {
        let used = graph.reachable(used);
        let mut relations = Self::find(graph, expressions);
        relations.squares.retain(|leading, _| !relations.circular.contains(leading));
        relations.circular = SortedSet::new();
        let reachable = graph.reachable(expressions);
        for expr in reachable.iter().copied() {
            let Node::Call(function, angle) = graph.node(expr).clone() else { continue };
            let (partner, sign) = match function {
                Function::Sin => (Function::Cos, -1),
                Function::Sinh => (Function::Cosh, 1),
                _ => continue,
            };
            let cosine = graph.find(&Node::Call(partner, angle.clone()));
            if cosine.is_none_or(|cosine| reachable.binary_search(&cosine).is_err()) {
                continue;
            }
            let half = half_of(graph, angle[0]);
            let [sine, cosine] = [function, partner].map(|function| graph.call(function, &[half]));
            let square = Polynomial::power_of(sine, 2);
            let equal = Polynomial::constant(Rational::ONE).plus(&square, &Rational::from(sign));
            if used.binary_search(&sine).is_err() {
                continue;
            }
            relations.squares.extend(equal.map(|equal| (cosine, equal)));
            relations.circular.extend([sine, cosine]);
        }
        relations
    }

    /// Writes expressions in half the angles of these relations: sin a = 2 sin(a/2) cos(a/2) and cos a = 1 - 2 sin^2(a/2), and
    /// similar formulas for hyperbolic functions.
    pub fn halve(&self, graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
        if self.circular.is_empty() {
            return roots.to_vec();
        }
        // Expressions inside an angle stay, since relations contain angles as they are.
        let mut halved = SortedMap::<Expr, Expr>::new();
        for expr in graph.reachable(roots) {
            let made = match graph.node(expr).clone() {
                call @ Node::Call(
                    Function::Sin | Function::Cos | Function::Sinh | Function::Cosh,
                    _,
                ) => self.half(graph, call),
                mut node => {
                    node.map_children(|child| halved[&child]);
                    graph.remake(node)
                }
            };
            halved.insert(expr, made);
        }
        roots.iter().map(|root| halved[root]).collect()
    }

    /// A sine or cosine in half its angle, if these relations contain the half angle.
    fn half(&self, graph: &mut Graph, node: Node) -> Expr {
        let Node::Call(function, angle) = &node else { return graph.remake(node) };
        let (sine, cosine, sign) = match function {
            Function::Sin | Function::Cos => (Function::Sin, Function::Cos, -2),
            Function::Sinh | Function::Cosh => (Function::Sinh, Function::Cosh, 2),
            _ => return graph.remake(node),
        };
        let is_sine = *function == sine;
        let half = half_of(graph, angle[0]);
        let [sine, cosine] = [sine, cosine].map(|function| graph.call(function, &[half]));
        if !self.circular.contains(&sine) {
            return graph.remake(node);
        }
        if is_sine {
            let product = graph.mul(sine, cosine);
            return graph.scale(product, 2);
        }
        let square = graph.power(sine, 2);
        let one = graph.number(1);
        graph.sum([(one, Rational::ONE), (square, Rational::from(sign))])
    }

    /// Whether any relation is between a sine and a cosine.
    pub fn has_angles(&self) -> bool {
        !self.circular.is_empty()
    }

    /// Whether there are no relations.
    pub fn is_empty(&self) -> bool {
        self.squares.is_empty()
    }

    /// Adds f^2 = a + b g^2, if g exists.
    fn add_pair(
        &mut self,
        graph: &Graph,
        expr: Expr,
        partner: Option<Expr>,
        [constant, coefficient]: [i32; 2],
    ) {
        let Some(partner) = partner else { return };
        // An angle of parameters only is a number in every evaluation.
        if graph.stage(expr) == Stage::Parameter {
            return;
        }
        let square = Polynomial::power_of(partner, 2);
        let Some(equal) =
            Polynomial::constant(constant.into()).plus(&square, &Rational::from(coefficient))
        else {
            return;
        };
        self.squares.insert(expr, equal);
        self.circular.extend([expr, partner]);
    }

    /// Adds r^2 = p for a root r of a sum p that contains the square of an expression: that square is replaced.
    fn add_root(&mut self, graph: &mut Graph, radicand: Expr) {
        let Node::Sum(constant, terms) = graph.node(radicand).clone() else { return };
        if self.roots.contains_key(&radicand) {
            return;
        }
        let square_of = |term: Expr| match graph.node(term) {
            Node::Product(factors) => match factors.as_slice() {
                [(base, two)] if *two == Rational::from(2) => Some(*base),
                _ => None,
            },
            _ => None,
        };
        let squares: Vec<Option<Expr>> = terms.iter().map(|(term, _)| square_of(*term)).collect();
        let leading = (0..terms.len()).rev().find_map(|index| {
            let base = squares[index].filter(|base| !self.squares.contains_key(base))?;
            let elsewhere = terms.iter().enumerate().any(|(other, (term, _))| {
                other != index && graph.reachable(&[*term]).contains(&base)
            });
            (!elsewhere).then_some((index, base))
        });
        // A radicand with a term that is no square stays opaque.
        let (Some((index, base)), true) = (leading, squares.iter().all(Option::is_some)) else {
            return;
        };
        let root = graph.power(radicand, HALF);
        let mut others = Polynomial::constant(constant);
        for (other, (_, coefficient)) in terms.iter().enumerate() {
            if let Some(square) = squares[other].filter(|_| other != index) {
                let square = self.normal_form(Polynomial::power_of(square, 2));
                let Some(sum) = square.and_then(|square| others.plus(&square, coefficient)) else {
                    return;
                };
                others = sum;
            }
        }
        let square = |expr: Expr| Polynomial::power_of(expr, 2);
        let coefficient = &terms[index].1;
        // Two roots may have all their squares in common, as sqrt(X^2 + Y^2) and sqrt(X^2 + Y^2 + 1) do: then the second
        // relation replaces the square of its own root, in terms of the first root.
        let (leading, equal) = if others.atoms().contains(&base) {
            (root, others.plus(&square(base), coefficient))
        } else {
            let equal = square(root).plus(&others, &Rational::NEG_ONE);
            let scale = Rational::ONE / coefficient;
            (base, equal.and_then(|equal| Polynomial::default().plus(&equal, &scale)))
        };
        let Some(equal) = equal else { return };
        self.squares.insert(leading, equal);
        self.roots.insert(radicand, root);
        self.squared.extend(squares.into_iter().flatten());
    }

    /// The root of a sum, if a relation contains it.
    pub(super) fn root_of(&self, radicand: Expr) -> Option<Expr> {
        self.roots.get(&radicand).copied()
    }

    /// The arguments of sines and cosines.
    pub(super) fn angles<'a>(&'a self, graph: &'a Graph) -> impl Iterator<Item = Expr> + 'a {
        self.circular.iter().flat_map(|function| graph.node(*function).children())
    }

    /// Whether an expression occurs in a relation: then it is treated as an atom.
    pub(super) fn concerns(&self, expr: Expr) -> bool {
        self.circular.contains(&expr) || self.is_radical(expr)
    }

    /// Whether a sum of these factors is worth multiplying out. A sum of a single radius, or without any atom of a relation,
    /// would only grow.
    pub(super) fn opens(&self, graph: &Graph, atoms: &SortedSet<Expr>) -> bool {
        if atoms.iter().any(|atom| self.circular.contains(atom)) {
            return true;
        }
        let at_point = |atom: &&Expr| latest_stage(graph, **atom) == 0;
        atoms.iter().any(|atom| self.is_radical(*atom))
            && (self.thorough || atoms.iter().filter(at_point).count() > 1)
    }

    /// The order in which factors are taken out of sums: sines and cosines at a point, coordinates under roots, and others by
    /// their stage.
    pub(super) fn rank(&self, graph: &Graph, atom: Expr) -> u8 {
        match latest_stage(graph, atom) {
            0 if self.circular.contains(&atom) => 0,
            0 if self.squared.contains(&atom) => 1,
            late => 2 + late,
        }
    }

    /// The relations with functions of a single root multiplied out too, if there are roots: short expressions grow, but all
    /// terms that can cancel do.
    pub fn thorough(&self) -> Option<Self> {
        (!self.roots.is_empty() && !self.steep)
            .then(|| Relations { thorough: true, ..self.clone() })
    }

    /// The relations between expressions that depend on X.
    pub fn at_points(&self, graph: &Graph) -> Self {
        let mut relations = self.clone();
        relations.squares.retain(|leading, _| latest_stage(graph, *leading) == 0);
        relations.circular.retain(|function| latest_stage(graph, *function) == 0);
        relations
    }

    fn is_steep(&self, graph: &Graph, reachable: &[Expr]) -> bool {
        // The nesting depth of powers of sums, for each expression.
        let mut depths = SortedMap::<Expr, usize>::new();
        for expr in reachable {
            let of = |child: Expr| depths.get(&child).copied().unwrap_or(0);
            let depth = match graph.node(*expr) {
                Node::Sum(_, terms) => terms.iter().map(|(term, _)| of(*term)).max(),
                Node::Product(factors) => {
                    let factor = |(base, power): &(Expr, Rational)| {
                        let is_sum = matches!(graph.node(*base), Node::Sum(..));
                        let is_high = is_sum && *power > Rational::ONE && power.is_int();
                        let is_power = is_high && !self.roots.contains_key(base);
                        of(*base) + usize::from(is_power)
                    };
                    factors.iter().map(factor).max()
                }
                _ => None,
            };
            depths.insert(*expr, depth.unwrap_or(0));
        }
        depths.values().any(|depth| *depth > 1)
    }

    fn is_radical(&self, expr: Expr) -> bool {
        self.squared.contains(&expr) || self.roots.values().any(|root| *root == expr)
    }

    /// The polynomial with all squares replaced by the relations.
    pub(super) fn normal_form(&self, polynomial: Polynomial) -> Option<Polynomial> {
        let mut normal = Polynomial::default();
        let mut open = polynomial;
        while let Some((monomial, coefficient)) = open.terms.pop_last() {
            match self.replaceable(&monomial) {
                Some((rest, square, count)) => {
                    let power = square.power(count, |power| self.normal_form(power))?;
                    let replaced = Polynomial::monomial(rest, coefficient).times(&power)?;
                    open = open.plus(&replaced, &Rational::ONE)?;
                }
                None => {
                    normal = normal
                        .plus(&Polynomial::monomial(monomial, coefficient), &Rational::ONE)?;
                }
            }
        }
        Some(normal)
    }

    /// A monomial as `rest * square^count`, where a relation replaces the square.
    fn replaceable(&self, monomial: &Monomial) -> Option<(Monomial, &Polynomial, u32)> {
        let (index, square, count) =
            monomial.iter().enumerate().find_map(|(index, (atom, exponent))| {
                let square = self.squares.get(atom).filter(|_| *exponent > 1)?;
                Some((index, square, exponent.unsigned_abs() / 2))
            })?;
        let mut rest = monomial.clone();
        rest[index].1 %= 2;
        rest.retain(|(_, exponent)| *exponent != 0);
        Some((rest, square, count))
    }
}
