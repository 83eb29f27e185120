//! ARCHITECTURE.md shows one datum, the bar's J, at every border of the compiler. This test computes it and compares it with
//! the page.

use std::fs;

use mms_codegen::{Compiled, Selection, compile_with};
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;
use mms_spec::syntax;
use mms_spec::syntax::{Ast, NodeKind, Operator};
use mms_symbolic::expr::print::Names;
use mms_symbolic::sorted::{SortedMap, SortedSet};

fn bar() -> Compiled {
    let text = fs::read_to_string("fields/bar_1d.toml").expect("the bar");
    let quantities = Some(SortedSet::from([Quantity::Jacobian]));
    let selection = Selection { quantities, ..Selection::default() };
    let load = |_: &str| Err("no files here".to_string());
    compile_with("bar_1d", "fields/bar_1d.toml", &text, &load, &selection.into())
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// The nodes in their order, which is postfix.
fn postfix(ast: &Ast) -> String {
    let shown = ast.nodes.iter().map(|node| match &node.kind {
        NodeKind::Number(number) => number.to_string(),
        NodeKind::Name(name) => name.clone(),
        NodeKind::Negate(_) => "negate".into(),
        NodeKind::Binary(operator, ..) => match operator {
            Operator::Add => "+",
            Operator::Subtract => "-",
            Operator::Multiply => "*",
            Operator::Divide => "/",
            Operator::Power => "^",
        }
        .into(),
        NodeKind::Call { name, .. } => format!("{}()", name.value),
    });
    shown.collect::<Vec<_>>().join(" ")
}

/// The lines of a program that an output needs.
fn needed(program: &Program, output: Output) -> String {
    let needed = program.needed(&[output]);
    let is_shown = |line: &&str| match line.strip_prefix("  v").and_then(|it| it.split_once(' ')) {
        Some((index, _)) => index.parse().is_ok_and(|index: usize| needed[index]),
        None => !line.starts_with("  ") || line.contains(&format!("{output:?} = ")),
    };
    program.to_string().lines().filter(is_shown).collect::<Vec<_>>().join("\n")
}

/// The result of every step, as the page shows it.
fn steps(compiled: &Compiled) -> Vec<(&'static str, String)> {
    let formula = &compiled.field.displacement[0];
    let ast = syntax::parse(formula, &mut Vec::new()).expect("a right formula");
    let names = Names { parameters: compiled.model.names.parameters.clone(), ..Names::default() };
    let print = |expr| compiled.graph.print(expr, &names);
    let emitted = mms_codegen::rust::file(compiled).text;
    let function = emitted.find("pub fn jacobian(").expect("the function");
    let length = emitted[function..].find("\n    }").expect("its end");
    let output = Output::Quantity(Quantity::Jacobian);
    let parameters = compiled.parameters::<f64>(&SortedMap::new());
    let mut interpreter = Interpreter::<f64, _>::new(&compiled.program, &parameters);
    interpreter.set_time(&0.0023);
    let plan = interpreter.plan(&[output]);
    interpreter.set_point(&plan, Point::at(&[0.3]));
    vec![
        ("spec", formula.text.clone()),
        ("parse", postfix(&ast)),
        ("resolve", print(compiled.model.displacement[0])),
        ("derive", print(compiled.derived.quantities[&Quantity::Jacobian][0])),
        ("simplify", print(compiled.derivation.quantities[&Quantity::Jacobian][0])),
        ("schedule", needed(&compiled.program, output)),
        ("emit", format!("{}\n}}", emitted[function..function + length].replace("\n    ", "\n"))),
        ("interpret", format!("{:?}", interpreter.output(output)[0])),
    ]
}

#[test]
fn the_page_shows_what_every_step_makes() {
    let page = fs::read_to_string("ARCHITECTURE.md").expect("the page");
    let compiled = bar();
    let shown: String = steps(&compiled)
        .into_iter()
        .map(|(step, datum)| {
            format!("{step:<12}{}\n", datum.trim_end().replace('\n', "\n            "))
        })
        .collect();
    let shown = format!("```text\n{shown}```\n");
    assert!(page.contains(&shown), "ARCHITECTURE.md, \"One datum\", should have\n\n{shown}");
}
