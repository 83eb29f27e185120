//! Translates the tree of a formula to Python, as it was typed. Nothing is resolved, derived or simplified, so that the script
//! depends on the compiler only for its parser.

use mms_spec::syntax::{Ast, NodeKind, Operator};
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The names with a meaning in Python or in the script itself.
const KEPT: &[&str] = &[
    "False",
    "None",
    "True",
    "and",
    "as",
    "assert",
    "async",
    "await",
    "break",
    "class",
    "continue",
    "def",
    "del",
    "elif",
    "else",
    "except",
    "finally",
    "for",
    "from",
    "global",
    "if",
    "import",
    "in",
    "is",
    "lambda",
    "nonlocal",
    "not",
    "or",
    "pass",
    "raise",
    "return",
    "try",
    "while",
    "with",
    "yield",
    "Integer",
    "deformed",
    "own",
    "u",
    "diff",
    "eye",
    "determinant",
    "in_space",
    "Rational",
    "Cbrt",
    "log",
    "I1",
    "I2",
    "I3",
    "J",
    "I4",
    "eps_trace",
    "eps_squared",
    "X",
    "Y",
    "Z",
    "t",
    "pi",
];

/// The names of a file in the script.
#[derive(Clone, Debug, Default)]
pub(super) struct Renamed {
    names: SortedMap<String, String>,
    used: SortedSet<String>,
}

impl Renamed {
    /// The names of one file, each renamed where Python or the script needs the name itself.
    pub fn new<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Self {
        let mut renamed = Renamed::default();
        renamed.used.extend(names.clone().map(String::from));
        for name in names {
            let mut chosen = name.to_string();
            // Names that begin with two underscores are Python's own.
            if name.starts_with("__") {
                chosen.insert(0, 'n');
            }
            while KEPT.contains(&chosen.as_str())
                || (chosen != name && renamed.used.contains(&chosen))
            {
                chosen.push('_');
            }
            renamed.used.insert(chosen.clone());
            renamed.names.insert(name.into(), chosen);
        }
        renamed
    }

    /// The name in the script. A name that the file did not define means the same in the script.
    pub fn name<'a>(&'a self, name: &'a str) -> &'a str {
        self.names.get(name).map_or(name, String::as_str)
    }
}

/// The precedence of an operator of Python.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

struct Piece {
    text: String,
    binding: Binding,
    /// Whether Python would compute it itself, and round the quotient of two integers.
    is_plain: bool,
}

impl Piece {
    fn at_least(self, binding: Binding) -> String {
        if self.binding >= binding { self.text } else { format!("({})", self.text) }
    }

    /// The piece as a number of SymPy.
    fn exact(self) -> Self {
        match self.is_plain {
            true => {
                let text = format!("Integer({})", self.text);
                Piece { text, binding: Binding::Atom, is_plain: false }
            }
            false => self,
        }
    }
}

/// The formula in Python; its value is exact.
pub(super) fn python(ast: &Ast, names: &Renamed) -> String {
    // Each node is the operand of one other, and moves into it.
    let mut pieces: Vec<Option<Piece>> = Vec::with_capacity(ast.nodes.len());
    for node in &ast.nodes {
        let piece = piece(&node.kind, names, &mut pieces);
        pieces.push(piece);
    }
    pieces.pop().flatten().map(|piece| piece.exact().text).unwrap_or_default()
}

fn piece(kind: &NodeKind, names: &Renamed, pieces: &mut [Option<Piece>]) -> Option<Piece> {
    Some(match kind {
        NodeKind::Number(number) => literal(number),
        NodeKind::Name(name) => {
            Piece { text: names.name(name).into(), binding: Binding::Atom, is_plain: false }
        }
        NodeKind::Negate(operand) => {
            let operand = pieces[*operand].take()?;
            let is_plain = operand.is_plain;
            let text = format!("-{}", operand.at_least(Binding::Sign));
            Piece { text, binding: Binding::Sign, is_plain }
        }
        NodeKind::Binary(operator, left, right) => {
            let (left, right) = (pieces[*left].take()?, pieces[*right].take()?);
            binary(*operator, left, right)
        }
        NodeKind::Call { name, arguments } => {
            let mut texts = Vec::new();
            for argument in arguments {
                texts.push(pieces[*argument].take()?.exact());
            }
            call(&name.value, texts)
        }
    })
}

fn binary(operator: Operator, left: Piece, right: Piece) -> Piece {
    let both_plain = left.is_plain && right.is_plain;
    let rounds = matches!(operator, Operator::Divide | Operator::Power);
    let left = if both_plain && rounds { left.exact() } else { left };
    let is_plain = both_plain && !rounds;
    let (sign, binding, after) = match operator {
        Operator::Add => (" + ", Binding::Sum, Binding::Product),
        Operator::Subtract => (" - ", Binding::Sum, Binding::Product),
        Operator::Multiply => ("*", Binding::Product, Binding::Sign),
        Operator::Divide => ("/", Binding::Product, Binding::Sign),
        Operator::Power => ("**", Binding::Power, Binding::Sign),
    };
    let before = if operator == Operator::Power { Binding::Atom } else { binding };
    let mut text = left.at_least(before);
    text.push_str(sign);
    text.push_str(&right.at_least(after));
    Piece { text, binding, is_plain }
}

fn call(name: &str, arguments: Vec<Piece>) -> Piece {
    if name == "hypot" {
        let squares =
            arguments.into_iter().map(|side| format!("{}**2", side.at_least(Binding::Atom)));
        let text = format!("sqrt({})", squares.collect::<Vec<_>>().join(" + "));
        return Piece { text, binding: Binding::Atom, is_plain: false };
    }
    let function = match name {
        "ln" => "log",
        "cbrt" => "Cbrt",
        other => other,
    };
    let arguments: Vec<_> = arguments.into_iter().map(|argument| argument.text).collect();
    let text = format!("{function}({})", arguments.join(", "));
    Piece { text, binding: Binding::Atom, is_plain: false }
}

fn literal(number: &Rational) -> Piece {
    let (above, below) = number.clone().into_parts();
    let text = digits(&above.to_string());
    if below.is_one() {
        let binding = if text.contains('*') { Binding::Product } else { Binding::Atom };
        return Piece { text, binding, is_plain: true };
    }
    let text = format!("Rational({text}, {})", digits(&below.to_string()));
    Piece { text, binding: Binding::Atom, is_plain: false }
}

/// Digits, with a long row of zeros at the end as a power of ten.
fn digits(digits: &str) -> String {
    let mantissa = digits.trim_end_matches('0');
    match digits.len() - mantissa.len() {
        zeros if zeros > 6 && mantissa == "1" => format!("10**{zeros}"),
        zeros if zeros > 6 => format!("{mantissa}*10**{zeros}"),
        _ => digits.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mms_spec::Formula;
    use mms_spec::source::Sources;
    use mms_spec::syntax::parse;

    fn translated(text: &str) -> String {
        let mut sources = Sources::default();
        let source = sources.add("formula", text);
        let span = sources.span(source, 0, text.len());
        let mut diagnostics = Vec::new();
        let ast = parse(&Formula::plain(text, span), &mut diagnostics).expect("a right formula");
        let names = ["lambda", "lambda_", "__file__", "length", "log"];
        python(&ast, &Renamed::new(names.into_iter()))
    }

    #[test]
    fn formulas_stay_as_they_were_typed() {
        assert_eq!(translated("X*(2*length - X)/length^2"), "X*(2*length - X)/length**2");
        assert_eq!(translated("-X^Y^3 - (X - t)"), "-X**Y**3 - (X - t)");
        assert_eq!(translated("X/(Y*Z)*2^-X"), "X/(Y*Z)*2**-X");
        assert_eq!(translated("(-X)^2 + (X^2)^3 + (2*X)^t"), "(-X)**2 + (X**2)**3 + (2*X)**t");
    }

    #[test]
    fn numbers_stay_exact() {
        assert_eq!(translated("0.1"), "Rational(1, 10)");
        assert_eq!(translated("1/3"), "Integer(1)/3");
        assert_eq!(translated("2^-3*X"), "Integer(2)**-3*X");
        assert_eq!(translated("(1 + 2)/4 - 7"), "Integer(1 + 2)/4 - 7");
        assert_eq!(translated("3"), "Integer(3)");
        assert_eq!(translated("1e-9"), "Rational(1, 10**9)");
        assert_eq!(translated("5e9^2"), "Integer(5*10**9)**2");
    }

    #[test]
    fn functions_have_their_names_in_sympy() {
        assert_eq!(translated("ln(X)*cbrt(8)"), "log(X)*Cbrt(Integer(8))");
        assert_eq!(translated("hypot(X + 1, Y)"), "sqrt((X + 1)**2 + Y**2)");
    }

    #[test]
    fn names_of_python_are_renamed() {
        assert_eq!(translated("lambda + lambda_"), "lambda__ + lambda_");
        assert_eq!(translated("__file__*log"), "n__file__*log_");
    }
}
