//! The one walk from an expression to a formula: signs, fractions, powers, roots and parentheses.
//! A [`Notation`] says only how each of these is set.

use mms_symbolic::expr::{Expr, Function, Graph, HALF, Node, Rational, Symbol, magnitude};
use mms_symbolic::sorted::SortedMap;

use super::name::Name;

/// The layout of formulas: everything that a notation decides.
pub trait Notation {
    /// A whole number from 0 on, given by its digits.
    fn whole(&self, digits: &str) -> String;
    /// The circle's number.
    fn pi(&self) -> String;
    /// A name.
    fn name(&self, name: &Name) -> String;
    /// Terms with their signs, `true` for minus.
    fn sum(&self, terms: &[(bool, String)]) -> String;
    /// Factors; never empty.
    fn product(&self, factors: &[String]) -> String;
    /// Numerator over denominator.
    fn fraction(&self, above: &str, below: &str) -> String;
    /// Whether a fraction is set as a bar, so that neither side needs parentheses.
    fn has_bars(&self) -> bool;
    /// A base to a power.
    fn power(&self, base: &str, exponent: &Exponent) -> String;
    /// The root of degree 2 or 3; `is_atom` where the radicand cannot be misread.
    fn root(&self, degree: u8, radicand: &str, is_atom: bool) -> String;
    /// A function of its arguments; the power, if any, is the function's.
    fn call(&self, function: Function, arguments: &[String], power: Option<&str>) -> String;
    /// Whether a power can follow the name of a function: sin^2(x).
    fn has_powers_of_functions(&self) -> bool;
    /// Parentheses.
    fn parentheses(&self, inside: &str) -> String;
}

/// The exponent of a base.
pub enum Exponent {
    /// A positive number; never 1.
    Number(Rational),
    /// A formula; `is_atom` where it needs no parentheses on a line.
    Formula {
        /// The formula.
        text: String,
        /// Whether it is one name or number.
        is_atom: bool,
    },
}

/// The precedence of a printed factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

#[derive(Clone, Debug)]
struct Factor {
    text: String,
    binding: Binding,
    /// The function and its arguments, where the factor is a call.
    call: Option<(Function, Vec<String>)>,
}

#[derive(Clone, Debug, Default)]
struct Term {
    is_negative: bool,
    above: Vec<Factor>,
    below: Vec<Factor>,
}

/// The terms of a sum; one term is a product.
type Piece = Vec<Term>;

/// A source of names of symbols.
pub trait Names {
    /// The name of a leaf.
    fn name(&self, symbol: Symbol) -> Name;
}

impl Names for mms_symbolic::expr::print::Names {
    fn name(&self, symbol: Symbol) -> Name {
        Name::plain(self.symbol(symbol))
    }
}

/// The formula of `root` in a notation.
pub fn write(graph: &Graph, root: Expr, names: &dyn Names, notation: &dyn Notation) -> String {
    let writer = Writer { graph, names, notation };
    let mut pieces = SortedMap::<Expr, Piece>::new();
    for expr in graph.reachable(&[root]) {
        let piece = writer.node(graph.node(expr), &pieces);
        pieces.insert(expr, piece);
    }
    pieces.get(&root).map(|piece| writer.sum(piece)).unwrap_or_default()
}

struct Writer<'a> {
    graph: &'a Graph,
    names: &'a dyn Names,
    notation: &'a dyn Notation,
}

impl Factor {
    fn atom(text: String) -> Self {
        Factor { text, binding: Binding::Atom, call: None }
    }

    fn power(text: String) -> Self {
        Factor { text, binding: Binding::Power, call: None }
    }
}

impl Term {
    fn of(factor: Factor) -> Piece {
        vec![Term { above: vec![factor], ..Term::default() }]
    }
}

impl Writer<'_> {
    fn node(&self, node: &Node, pieces: &SortedMap<Expr, Piece>) -> Piece {
        match node {
            Node::Number(number) => vec![self.scaled(&Term::default(), number)],
            Node::Pi => Term::of(Factor::atom(self.notation.pi())),
            Node::Symbol(symbol) => {
                Term::of(Factor::atom(self.notation.name(&self.names.name(*symbol))))
            }
            Node::Sum(constant, terms) => self.terms(constant, terms, pieces),
            Node::Product(factors) => vec![self.product(factors, pieces)],
            Node::Offset(operands) => {
                let signs = [Rational::ONE, Rational::NEG_ONE];
                let terms: Vec<_> = operands.iter().copied().zip(signs).collect();
                self.terms(&Rational::ZERO, &terms, pieces)
            }
            Node::Small(_, angle) => pieces[angle].clone(),
            Node::Call(function, arguments) => Term::of(self.call(*function, arguments, pieces)),
        }
    }

    fn terms(
        &self,
        constant: &Rational,
        terms: &[(Expr, Rational)],
        pieces: &SortedMap<Expr, Piece>,
    ) -> Piece {
        let mut sum = Piece::new();
        if !constant.is_zero() {
            sum.push(self.scaled(&Term::default(), constant));
        }
        for (child, coefficient) in terms {
            let term = match pieces[child].as_slice() {
                [single] => single.clone(),
                several => self.whole_term(several),
            };
            sum.push(self.scaled(&term, coefficient));
        }
        // A sum that can begin with a plus sign does.
        if let Some(first) = sum.iter().position(|term| !term.is_negative) {
            sum[..=first].rotate_right(1);
        }
        sum
    }

    /// 1 + x.
    fn one_more(&self, expr: Expr, pieces: &SortedMap<Expr, Piece>) -> Piece {
        match self.graph.node(expr) {
            Node::Sum(constant, terms) => self.terms(&(constant + Rational::ONE), terms, pieces),
            _ => self.terms(&Rational::ONE, &[(expr, Rational::ONE)], pieces),
        }
    }

    /// A sum as one factor.
    fn whole_term(&self, piece: &[Term]) -> Term {
        Term { above: vec![self.factor(piece)], ..Term::default() }
    }

    /// A term times a number, which goes first on both sides of the fraction.
    fn scaled(&self, term: &Term, number: &Rational) -> Term {
        let mut term = term.clone();
        term.is_negative ^= *number < Rational::ZERO;
        let (above, below) = magnitude(number).into_parts();
        let whole = |digits: String| Factor::atom(self.notation.whole(&digits));
        if !above.is_one() {
            term.above.insert(0, whole(above.to_string()));
        }
        if !below.is_one() {
            term.below.insert(0, whole(below.to_string()));
        }
        term
    }

    fn product(&self, factors: &[(Expr, Rational)], pieces: &SortedMap<Expr, Piece>) -> Term {
        let mut term = Term::default();
        let mut factors: Vec<_> = factors.iter().collect();
        factors.sort_by_key(|(base, _)| self.place(*base));
        for (base, exponent) in factors {
            let factor = self.powered(&pieces[base], &magnitude(exponent));
            match *exponent < Rational::ZERO {
                true => term.below.push(factor),
                false => term.above.push(factor),
            }
        }
        term
    }

    /// The position of a factor in its product: constants, names, coordinates, and then factors in parentheses.
    fn place(&self, base: Expr) -> u8 {
        match self.graph.node(base) {
            Node::Number(_) => 0,
            Node::Pi => 1,
            Node::Symbol(Symbol::Coordinate(_) | Symbol::Time) => 3,
            Node::Symbol(_) => 2,
            Node::Call(Function::Sqrt | Function::Cbrt, _) => 4,
            Node::Sum(..)
            | Node::Product(_)
            | Node::Call(..)
            | Node::Offset(_)
            | Node::Small(..) => 5,
        }
    }

    /// A piece as one factor: itself if it is one, or a sum to be put in parentheses.
    fn factor(&self, piece: &[Term]) -> Factor {
        match piece {
            [Term { is_negative: false, above, below }] if below.is_empty() && above.len() == 1 => {
                above[0].clone()
            }
            [Term { is_negative: false, .. }] => {
                Factor { text: self.sum(piece), binding: Binding::Product, call: None }
            }
            _ => Factor { text: self.sum(piece), binding: Binding::Sum, call: None },
        }
    }

    /// A piece to a positive power.
    fn powered(&self, piece: &[Term], exponent: &Rational) -> Factor {
        let base = self.factor(piece);
        if exponent.is_one() {
            return base;
        }
        if *exponent == HALF {
            return self.root(2, piece);
        }
        let to_function = exponent.is_int() && self.notation.has_powers_of_functions();
        if let Some((function, arguments)) = base.call.filter(|_| to_function) {
            let power = exponent.numerator().to_string();
            return Factor::power(self.notation.call(function, &arguments, Some(&power)));
        }
        let base = match base.binding {
            Binding::Atom => base.text,
            _ => self.notation.parentheses(&base.text),
        };
        Factor::power(self.notation.power(&base, &Exponent::Number(exponent.clone())))
    }

    fn call(
        &self,
        function: Function,
        arguments: &[Expr],
        pieces: &SortedMap<Expr, Piece>,
    ) -> Factor {
        match function {
            Function::Powf => self.variable_power(&pieces[&arguments[0]], &pieces[&arguments[1]]),
            Function::Sqrt => self.root(2, &pieces[&arguments[0]]),
            Function::Cbrt => self.root(3, &pieces[&arguments[0]]),
            Function::Ln1p => {
                let argument = self.one_more(arguments[0], pieces);
                self.elementary(Function::Ln, vec![self.sum(&argument)])
            }
            _ => {
                let arguments = arguments.iter().map(|argument| self.sum(&pieces[argument]));
                self.elementary(function, arguments.collect())
            }
        }
    }

    fn variable_power(&self, base: &[Term], exponent: &[Term]) -> Factor {
        let (base, exponent) = (self.factor(base), self.factor(exponent));
        let is_atom = exponent.binding == Binding::Atom;
        let base = match base.binding {
            Binding::Atom if base.call.is_none() => base.text,
            _ => self.notation.parentheses(&base.text),
        };
        let exponent = Exponent::Formula { text: exponent.text, is_atom };
        Factor::power(self.notation.power(&base, &exponent))
    }

    fn root(&self, degree: u8, radicand: &[Term]) -> Factor {
        let radicand = self.factor(radicand);
        let is_atom = radicand.binding == Binding::Atom && radicand.call.is_none();
        Factor::power(self.notation.root(degree, &radicand.text, is_atom))
    }

    fn elementary(&self, function: Function, arguments: Vec<String>) -> Factor {
        let text = self.notation.call(function, &arguments, None);
        Factor { call: Some((function, arguments)), ..Factor::atom(text) }
    }

    fn sum(&self, piece: &[Term]) -> String {
        let terms: Vec<_> = piece.iter().map(|term| (term.is_negative, self.term(term))).collect();
        match terms.as_slice() {
            [(false, text)] => text.clone(),
            _ => self.notation.sum(&terms),
        }
    }

    fn term(&self, term: &Term) -> String {
        if term.below.is_empty() {
            return self.side(&term.above, false);
        }
        let has_bars = self.notation.has_bars();
        let above = self.side(&term.above, has_bars);
        let mut below = self.side(&term.below, has_bars);
        if term.below.len() > 1 && !has_bars {
            below = self.notation.parentheses(&below);
        }
        self.notation.fraction(&above, &below)
    }

    /// One side of a fraction; `is_free` where a sum alone needs no parentheses.
    fn side(&self, factors: &[Factor], is_free: bool) -> String {
        let guarded = |factor: &Factor| match factor.binding {
            Binding::Sum | Binding::Product => self.notation.parentheses(&factor.text),
            Binding::Power | Binding::Atom => factor.text.clone(),
        };
        match factors {
            [] => self.notation.whole("1"),
            [single] if is_free => single.text.clone(),
            _ => self.notation.product(&factors.iter().map(guarded).collect::<Vec<_>>()),
        }
    }
}
