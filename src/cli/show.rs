//! `mms show`: the derivation, readable.

use anyhow::bail;
use clap::Args;
use mms_codegen::Compiled;
use mms_codegen::expr::Expr;
use mms_codegen::program::{Output, Stage};
use mms_codegen::quantity::{Quantity, Shape};
use serde_json::{Map, Value, json};

use super::input::Input;
use super::{Outcome, print, print_json};

/// Show what follows from a field: its derivation, claims and operation counts.
#[derive(Args)]
pub struct Show {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// Quantities, separated by commas; all by default.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl Show {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let input = Input::find(&self.field)?;
        let mut quantities = Vec::new();
        for name in &self.quantity {
            match Quantity::from_name(name.trim()) {
                Some(quantity) => quantities.push(quantity),
                None => bail!("unknown quantity `{name}`; see `mms eval --help`"),
            }
        }
        if quantities.is_empty() {
            quantities = Quantity::ALL.to_vec();
        }
        let compiled = &input.compiled;
        if self.json {
            print_json(&document(&input.name, compiled, &quantities))?;
        } else {
            print(&text(&input.name, compiled, &quantities));
        }
        Ok(Outcome::AsExpected)
    }
}

/// Lines `symbol = formula` of a quantity, one per component.
fn formulas(compiled: &Compiled, quantity: Quantity) -> Vec<(String, String)> {
    let dimension = compiled.field.dimension;
    let components = &compiled.derivation.quantities[&quantity];
    let symbol = |index: usize| match quantity.shape() {
        _ if components.len() == 1 => quantity.symbol().to_string(),
        Shape::Tensor => {
            format!("{}_{}{}", quantity.symbol(), index / dimension + 1, index % dimension + 1)
        }
        Shape::Scalar | Shape::Vector => format!("{}_{}", quantity.symbol(), index + 1),
    };
    let formula = |expr: Expr| compiled.graph.print(expr, &compiled.model.names);
    components.iter().enumerate().map(|(index, expr)| (symbol(index), formula(*expr))).collect()
}

fn definitions(compiled: &Compiled) -> Vec<(String, String)> {
    let names = &compiled.model.names;
    let print = |expr: &Expr| compiled.graph.print(*expr, names);
    names.expressions.iter().map(|(expr, name)| (name.clone(), print(expr))).collect()
}

fn operations(compiled: &Compiled, quantity: Quantity) -> Map<String, Value> {
    let counts = compiled.program.operations(&[Output::Quantity(quantity)]);
    let total: usize = counts.values().sum();
    let mut operations = Map::new();
    operations.insert("total".into(), total.into());
    operations.extend(Stage::ALL.map(|stage| (stage.name().to_string(), counts[&stage].into())));
    operations
}

fn document(name: &str, compiled: &Compiled, quantities: &[Quantity]) -> Value {
    let field = &compiled.field;
    let quantities: Map<String, Value> = quantities
        .iter()
        .map(|quantity| {
            let formulas: Vec<_> =
                formulas(compiled, *quantity).into_iter().map(|(_, formula)| formula).collect();
            let entry =
                json!({ "formula": formulas, "operations": operations(compiled, *quantity) });
            (quantity.name().to_string(), entry)
        })
        .collect();
    let claims: Map<String, Value> = field
        .boundary
        .iter()
        .map(|claim| (claim.face.value.name().to_string(), claim.claim.value.name().into()))
        .collect();
    json!({
        "field": name,
        "title": field.title,
        "dimension": field.dimension,
        "reference": field.reference,
        "material": field.material.model.value,
        "definitions": definitions(compiled).into_iter().collect::<std::collections::BTreeMap<_, _>>(),
        "boundary": claims,
        "quantities": quantities,
    })
}

fn text(name: &str, compiled: &Compiled, quantities: &[Quantity]) -> String {
    let field = &compiled.field;
    let mut lines = vec![format!("{name}: {}", field.title)];
    if let Some(reference) = &field.reference {
        lines.push(format!("  {reference}"));
    }
    lines.push(String::new());
    lines.push(format!("material {}: {}", field.material.model.value, compiled.material.title));
    lines.push(format!("  W = {}", compiled.material.strain_energy.text));
    for (argument, formula) in &field.material.arguments {
        lines.push(format!("  {} = {}", argument.value, formula.text));
    }
    lines.push(format!("  rho0 = {}", field.material.density.text));
    lines.push(String::new());
    lines.push("with".into());
    let definitions = definitions(compiled);
    lines.extend(definitions.iter().map(|(name, formula)| format!("  {name} = {formula}")));
    for quantity in quantities {
        lines.push(String::new());
        let counts = operations(compiled, *quantity);
        let stages: Vec<_> = Stage::ALL
            .iter()
            .filter(|stage| counts[stage.name()] != 0)
            .map(|stage| format!("{} {}", counts[stage.name()], stage.name()))
            .collect();
        let stages = if stages.is_empty() { "none".into() } else { stages.join(", ") };
        lines.push(format!("{} (operations: {stages})", quantity.name()));
        let formulas = formulas(compiled, *quantity);
        lines.extend(formulas.iter().map(|(symbol, formula)| format!("  {symbol} = {formula}")));
    }
    if !field.boundary.is_empty() {
        lines.push(String::new());
        lines.push("boundary claims".into());
        lines.extend(
            field.boundary.iter().map(|claim| {
                format!("  {}: {}", claim.face.value.name(), claim.claim.value.name())
            }),
        );
    }
    lines.join("\n")
}
