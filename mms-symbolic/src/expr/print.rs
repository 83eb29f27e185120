//! Text of an expression, in the language of field files.

use super::{Expr, Function, Graph, HALF, Node, Rational, Symbol, magnitude};
use crate::sorted::SortedMap;

/// The precedence of a printed text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

/// Bases with their exponents.
type Powers<B> = Vec<(B, Rational)>;

/// The names of Cartesian reference coordinates.
pub const AXES: [&str; 3] = ["X", "Y", "Z"];

/// The names of leaves and sub-expressions for readers.
#[derive(Clone, Debug)]
pub struct Names {
    /// The reference coordinates.
    pub coordinates: &'static [&'static str],
    /// The parameters, in the order of the field file.
    pub parameters: Vec<String>,
    /// Sub-expressions with names of their own; they are printed as their names.
    pub expressions: SortedMap<Expr, String>,
}

impl Default for Names {
    fn default() -> Self {
        Names { coordinates: &AXES, parameters: Vec::new(), expressions: SortedMap::new() }
    }
}

impl Names {
    /// The name of a leaf.
    pub fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Parameter(index) => match self.parameters.get(index) {
                Some(name) => name.clone(),
                None => format!("parameter_{index}"),
            },
            Symbol::Time => "t".into(),
            Symbol::Coordinate(axis) => self.coordinates[axis].into(),
            Symbol::Normal(axis) => format!("N{}", axis + 1),
            Symbol::Gradient(row, column) => format!("H{}{}", row + 1, column + 1),
            Symbol::Invariant(index) => format!("i{}", index + 1),
            Symbol::Local(index) => format!("local_{index}"),
        }
    }
}

impl Graph {
    /// The text of `root`; parsing it returns the same expression. If `root` itself has a name, its definition is printed.
    pub fn print(&self, root: Expr, names: &Names) -> String {
        let mut printed = SortedMap::<Expr, (String, Binding)>::new();
        for expr in self.reachable(&[root]) {
            let text = match names.expressions.get(&expr) {
                Some(name) if expr != root => (name.clone(), Binding::Atom),
                _ => self.print_node(expr, names, &printed),
            };
            printed.insert(expr, text);
        }
        printed.remove(&root).map(|(text, _)| text).unwrap_or_default()
    }

    fn print_node(
        &self,
        expr: Expr,
        names: &Names,
        printed: &SortedMap<Expr, (String, Binding)>,
    ) -> (String, Binding) {
        let at_least = |child: &Expr, least: Binding| {
            let (text, binding) = &printed[child];
            if *binding >= least { text.clone() } else { format!("({text})") }
        };
        match self.node(expr) {
            Node::Number(number) => print_number(number),
            Node::Pi => ("pi".into(), Binding::Atom),
            Node::Symbol(symbol) => (names.symbol(*symbol), Binding::Atom),
            Node::Sum(constant, terms) => {
                let factor = |term: &Expr| at_least(term, Binding::Product);
                print_sum(constant, terms, factor)
            }
            Node::Product(factors) => {
                let (known, factors) = self.named_powers(expr, factors, names);
                let base = |base: &Expr, exponent: &Rational| {
                    if exponent.is_one() {
                        at_least(base, Binding::Power)
                    } else if *exponent == HALF {
                        format!("sqrt({})", printed[base].0)
                    } else {
                        format!("{}^{}", at_least(base, Binding::Atom), print_exponent(exponent))
                    }
                };
                print_product(&known, &factors, base)
            }
            Node::Call(Function::Powf, arguments) => {
                let (base, exponent) = (&arguments[0], &arguments[1]);
                let (base, exponent) =
                    (at_least(base, Binding::Atom), at_least(exponent, Binding::Atom));
                (format!("{base}^{exponent}"), Binding::Power)
            }
            Node::Offset(operands) => {
                let [from, place] = operands.map(|operand| at_least(&operand, Binding::Product));
                (format!("{from} - {place}"), Binding::Sum)
            }
            Node::Small(_, angle) => printed[angle].clone(),
            Node::Call(function, arguments) => print_call(*function, arguments, printed),
        }
    }
}

impl Graph {
    /// Takes named products out of a product: with A = a*cos(w), the factors a*b*cos(w) are A*b.
    /// Returns the names with their powers, and the other factors.
    fn named_powers(
        &self,
        product: Expr,
        factors: &[(Expr, Rational)],
        names: &Names,
    ) -> (Powers<String>, Powers<Expr>) {
        let mut factors: SortedMap<Expr, Rational> = factors.iter().cloned().collect();
        let mut known = Vec::new();
        // Later definitions are made of earlier ones, and are more expressive.
        let earlier = names.expressions.iter().rev().skip_while(|(named, _)| **named >= product);
        for (named, name) in earlier {
            let Node::Product(parts) = self.node(*named) else { continue };
            let mut count = 0;
            while parts.iter().all(|(base, part)| holds(factors.get(base), part)) {
                for (base, part) in parts {
                    *factors.get_or_default(*base) -= part;
                }
                factors.retain(|_, exponent| !exponent.is_zero());
                count += 1;
            }
            if count > 0 {
                known.push((name.clone(), Rational::from(count)));
            }
        }
        (known, factors.into_iter().collect())
    }
}

/// Whether a power can be split into a part and a remainder of the same sign, or 0.
fn holds(power: Option<&Rational>, part: &Rational) -> bool {
    power.is_some_and(|power| {
        let same_sign = (*power > Rational::ZERO) == (*part > Rational::ZERO);
        same_sign && magnitude(power) >= magnitude(part)
    })
}

fn print_call(
    function: Function,
    arguments: &[Expr],
    printed: &SortedMap<Expr, (String, Binding)>,
) -> (String, Binding) {
    let arguments: Vec<_> = arguments.iter().map(|child| printed[child].0.as_str()).collect();
    let arguments = arguments.join(", ");
    let text = match function {
        Function::Ln1p => format!("ln(1 + {arguments})"),
        _ => format!("{}({arguments})", function.name()),
    };
    (text, Binding::Atom)
}

fn print_number(number: &Rational) -> (String, Binding) {
    let binding = match (*number < Rational::ZERO, number.is_int()) {
        (true, _) => Binding::Sum,
        (false, true) => Binding::Atom,
        (false, false) => Binding::Product,
    };
    (number.to_string(), binding)
}

fn print_exponent(exponent: &Rational) -> String {
    match print_number(exponent) {
        (text, Binding::Atom) => text,
        (text, _) if exponent.is_int() => text,
        (text, _) => format!("({text})"),
    }
}

fn print_sum(
    constant: &Rational,
    terms: &[(Expr, Rational)],
    factor: impl Fn(&Expr) -> String,
) -> (String, Binding) {
    let mut parts = Vec::new();
    if !constant.is_zero() {
        parts.push((*constant < Rational::ZERO, magnitude(constant).to_string()));
    }
    for (term, coefficient) in terms {
        let (numerator, denominator) = magnitude(coefficient).into_parts();
        let mut text = factor(term);
        if !numerator.is_one() {
            text = format!("{numerator}*{text}");
        }
        if !denominator.is_one() {
            text = format!("{text}/{denominator}");
        }
        parts.push((*coefficient < Rational::ZERO, text));
    }
    // A sum that can begin with a plus sign does.
    if let Some(first_positive) = parts.iter().position(|(negative, _)| !negative) {
        parts[..=first_positive].rotate_right(1);
    }
    let mut text = String::new();
    for (index, (negative, part)) in parts.iter().enumerate() {
        text.push_str(match (index, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(part);
    }
    let single = parts.len() == 1 && !parts[0].0;
    (text, if single { Binding::Product } else { Binding::Sum })
}

fn print_product(
    known: &[(String, Rational)],
    factors: &[(Expr, Rational)],
    power: impl Fn(&Expr, &Rational) -> String,
) -> (String, Binding) {
    let list = |negative: bool| {
        factors
            .iter()
            .filter(move |(_, exponent)| (*exponent < Rational::ZERO) == negative)
            .map(|(base, exponent)| power(base, &magnitude(exponent)))
    };
    let known = known.iter().map(|(name, exponent)| match exponent.is_one() {
        true => name.clone(),
        false => format!("{name}^{}", print_exponent(exponent)),
    });
    let above: Vec<String> = known.chain(list(false)).collect();
    let below: Vec<String> = list(true).collect();
    let numerator = if above.is_empty() { "1".to_string() } else { above.join("*") };
    let binding = match (above.as_slice(), below.is_empty()) {
        ([_], true) => Binding::Power,
        _ => Binding::Product,
    };
    match below.as_slice() {
        [] => (numerator, binding),
        [single] => (format!("{numerator}/{single}"), binding),
        several => (format!("{numerator}/({})", several.join("*")), binding),
    }
}
