//! The meaning of the language, and the texts that it refuses.

use super::*;
use crate::diagnostic::Diagnostic;
use crate::formula::formula_in;
use crate::source::Sources;

/// The tree of a formula with all its parentheses, or the messages about it.
fn parsed(text: &str) -> String {
    let mut sources = Sources::default();
    let raw = format!("'{text}'");
    let id = sources.add("x.toml", raw.as_str());
    let mut diagnostics = Vec::new();
    match parse(&formula_in(&raw, id), &mut diagnostics) {
        Some(ast) => {
            assert!(diagnostics.is_empty(), "{text}: {diagnostics:?}");
            let root = ast.nodes.len() - 1;
            shown(&ast, root)
        }
        None => {
            let messages: Vec<_> = diagnostics.into_iter().map(|found| found.message).collect();
            assert!(!messages.is_empty(), "{text}: refused in silence");
            format!("error: {}", messages.join("; "))
        }
    }
}

fn shown(ast: &Ast, node: usize) -> String {
    match &ast.nodes[node].kind {
        NodeKind::Number(value) => value.to_string(),
        NodeKind::Name(name) => name.clone(),
        NodeKind::Negate(operand) => format!("(-{})", shown(ast, *operand)),
        NodeKind::Binary(operator, left, right) => {
            let sign = match operator {
                Operator::Add => '+',
                Operator::Subtract => '-',
                Operator::Multiply => '*',
                Operator::Divide => '/',
                Operator::Power => '^',
            };
            format!("({}{sign}{})", shown(ast, *left), shown(ast, *right))
        }
        NodeKind::Call { name, arguments } => {
            let arguments: Vec<_> = arguments.iter().map(|node| shown(ast, *node)).collect();
            format!("{}({})", name.value, arguments.join(","))
        }
    }
}

/// The diagnostics of a TOML string, each with the text at its place.
fn complaints(raw: &str) -> Vec<(String, String)> {
    let mut sources = Sources::default();
    let id = sources.add("x.toml", raw);
    let mut diagnostics: Vec<Diagnostic> = Vec::new();
    assert!(parse(&formula_in(raw, id), &mut diagnostics).is_none(), "{raw}");
    let shown = |found: Diagnostic| (sources.slice(found.span).to_string(), found.message);
    diagnostics.into_iter().map(shown).collect()
}

#[test]
fn precedence_and_associativity() {
    for (text, tree) in [
        ("1 + 2*X", "(1+(2*X))"),
        ("a - b - c", "((a-b)-c)"),
        ("a/b*c", "((a/b)*c)"),
        ("a^b^c", "(a^(b^c))"),
        ("-x^2", "(-(x^2))"),
        ("(-x)^2", "((-x)^2)"),
        ("2^-3", "(2^(-3))"),
        ("2^-3*4", "((2^(-3))*4)"),
        ("2^-x^2", "(2^(-(x^2)))"),
        ("-a*b", "((-a)*b)"),
        ("a*-b + c", "((a*(-b))+c)"),
        ("--a - -b", "((-(-a))-(-b))"),
        ("((a))", "a"),
        ("X*(2*length - X)/length^2 * A", "(((X*((2*length)-X))/(length^2))*A)"),
    ] {
        assert_eq!(parsed(text), tree, "{text}");
    }
}

#[test]
fn calls() {
    for (text, tree) in [
        ("sin(x)", "sin(x)"),
        ("sin (x)", "sin(x)"),
        ("atan2(-y, x + 1)^2", "(atan2((-y),(x+1))^2)"),
        ("f(g(x), (a + b)*c)", "f(g(x),((a+b)*c))"),
        ("f()", "f()"),
        ("-f(1)", "(-f(1))"),
    ] {
        assert_eq!(parsed(text), tree, "{text}");
    }
}

#[test]
fn numbers_and_names_that_touch() {
    assert_eq!(parsed("0.1 + .5 + 1e-2"), "((1/10+1/2)+1/100)");
    assert_eq!(parsed("2e3"), "2000");
    assert_eq!(parsed("2exp(X)"), "error: expected an operator before `exp`");
    assert_eq!(parsed("2X"), "error: expected an operator before `X`");
    assert_eq!(parsed("2e"), "error: the exponent of this number has no digits");
    assert_eq!(parsed("e2"), "e2");
}

#[test]
fn every_mistake_has_its_message() {
    for (text, message) in [
        ("", "this formula is empty"),
        ("  ", "this formula is empty"),
        ("a +", "expected a number, a name or `(`, found the end of the formula"),
        ("a + * b", "expected a number, a name or `(`, found `*`"),
        ("+a", "expected a number, a name or `(`, found `+`"),
        ("()", "expected a number, a name or `(`, found `)`"),
        ("f(a,)", "expected a number, a name or `(`, found `)`"),
        ("f(,a)", "expected a number, a name or `(`, found `,`"),
        ("f(-)", "expected a number, a name or `(`, found `)`"),
        ("(a + b", "this `(` is never closed"),
        ("f(a", "this `(` is never closed"),
        ("a)", "this `)` closes nothing"),
        ("0,5", "unexpected `,`"),
        ("(a, b)", "unexpected `,`"),
        ("a b", "expected an operator before `b`"),
        ("2(a)", "expected an operator before `(`"),
        ("a**b", "unexpected `**`"),
        ("1.2.3", "`1.2.3` is not a number"),
        ("a = b ; c", "unexpected character `=`; unexpected character `;`"),
    ] {
        assert_eq!(parsed(text), format!("error: {message}"), "{text}");
    }
}

#[test]
fn the_caret_is_exact_in_escaped_and_unicode_strings() {
    let lambda = "unexpected character `\u{3bb}`";
    assert_eq!(complaints("\"a + \u{3bb}*b\""), [("\u{3bb}".into(), lambda.into())]);
    assert_eq!(complaints("\"a + \\u03bb*b\""), [("\\u03bb".into(), lambda.into())]);
    assert_eq!(complaints("\"\\u0061\\t*\\u0028\""), [("".into(), complaint_at_end())]);
    assert_eq!(
        complaints("\"\\u0061 \\u0062\""),
        [("\\u0062".into(), "expected an operator before `b`".into())]
    );
    assert_eq!(
        complaints("\"\"\"\n  \u{e9}\u{e8}\n  + \\\n  (b\"\"\"")[0],
        ("\u{e9}\u{e8}".into(), "unexpected characters `\u{e9}\u{e8}`".into())
    );
}

fn complaint_at_end() -> String {
    "expected a number, a name or `(`, found the end of the formula".into()
}

#[test]
fn spans_are_those_of_the_parts() {
    let raw = "\"(a + b)*f(-c)\"";
    let mut sources = Sources::default();
    let id = sources.add("x.toml", raw);
    let ast = parse(&formula_in(raw, id), &mut Vec::new()).expect("a tree");
    let spans: Vec<_> = ast.nodes.iter().map(|node| sources.slice(node.span)).collect();
    assert_eq!(spans, ["a", "b", "a + b", "c", "-c", "f(-c)", "(a + b)*f(-c)"]);
}

#[test]
fn operands_stand_before_their_node() {
    let raw = "'a^b - f(c*d, -e)/2'";
    let mut sources = Sources::default();
    let id = sources.add("x.toml", raw);
    let ast = parse(&formula_in(raw, id), &mut Vec::new()).expect("a tree");
    for (index, node) in ast.nodes.iter().enumerate() {
        let before = match &node.kind {
            NodeKind::Number(_) | NodeKind::Name(_) => true,
            NodeKind::Negate(operand) => *operand < index,
            NodeKind::Binary(_, left, right) => *left < index && *right < index,
            NodeKind::Call { arguments, .. } => arguments.iter().all(|operand| *operand < index),
        };
        assert!(before, "{index}: {node:?}");
    }
}

#[test]
fn bounds_are_diagnostics() {
    let deep = |times: usize| format!("{}x{}", "(".repeat(times), ")".repeat(times));
    assert_eq!(parsed(&deep(MAX_DEPTH)), "x");
    let too_deep = format!("error: this expression is nested more than {MAX_DEPTH} deep");
    assert_eq!(parsed(&deep(100_000)), too_deep);
    assert_eq!(parsed(&"-".repeat(100_000)), too_deep);
    assert_eq!(parsed(&"2^".repeat(100_000)), too_deep);
    assert_eq!(parsed(&"sin(".repeat(100_000)), too_deep);
    let too_long = format!("error: this expression has more than {MAX_NODES} terms");
    assert_eq!(parsed(&"x+".repeat(100_000)), too_long);
    assert_eq!(parsed("1e999999999"), "error: the exponent of this number is too large");
}

#[test]
fn a_long_sum_is_not_deep() {
    let mut sources = Sources::default();
    let raw = format!("'{}x'", "x + ".repeat(40_000));
    let id = sources.add("x.toml", raw.as_str());
    let ast = parse(&formula_in(&raw, id), &mut Vec::new()).expect("a tree");
    assert_eq!(ast.nodes.len(), 80_001);
}
