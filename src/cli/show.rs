//! `mms show`: the derivation, readable.

use clap::Args;
use mms_codegen::Compiled;
use mms_codegen::emit::text::{Line, definitions, derivation};
use mms_codegen::program::{Output, Stage};
use mms_codegen::quantity::Quantity;
use serde_json::{Map, Value, json};

use super::input::{Bound, Input, quantities};
use super::{Outcome, print, print_json};

/// Show what follows from a field: its derivation, claims and operation counts.
#[derive(Args)]
pub struct Show {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// Quantities, separated by commas; all by default.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    #[command(flatten)]
    bound: Bound,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl Show {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let input = Input::find(&self.field, self.bound)?;
        let quantities = match self.quantity.as_slice() {
            [] => Quantity::ALL.to_vec(),
            named => quantities(named)?,
        };
        let compiled = &input.compiled;
        if self.json {
            print_json(&document(&input.name, compiled, &quantities))?;
        } else {
            print(&text(&input.name, compiled, &quantities))?;
        }
        Ok(Outcome::AsExpected)
    }
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
    let quantities: Map<String, Value> = derivation(compiled)
        .into_iter()
        .filter(|(quantity, _)| quantities.contains(quantity))
        .map(|(quantity, lines)| {
            let formula: Vec<_> = lines.into_iter().map(|line| line.formula).collect();
            let entry = json!({ "formula": formula, "operations": operations(compiled, quantity) });
            (quantity.name().to_string(), entry)
        })
        .collect();
    let definitions: Map<String, Value> =
        definitions(compiled).into_iter().map(|line| (line.symbol, line.formula.into())).collect();
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
        "definitions": definitions,
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
    let print = |line: Line| format!("  {} = {}", line.symbol, line.formula);
    lines.extend(definitions(compiled).into_iter().map(print));
    for (quantity, formulas) in derivation(compiled) {
        if !quantities.contains(&quantity) {
            continue;
        }
        lines.push(String::new());
        let counts = operations(compiled, quantity);
        let stages: Vec<_> = Stage::ALL
            .iter()
            .filter(|stage| counts[stage.name()] != 0)
            .map(|stage| format!("{} {}", counts[stage.name()], stage.name()))
            .collect();
        let stages = if stages.is_empty() { "none".into() } else { stages.join(", ") };
        lines.push(format!("{} (operations: {stages})", quantity.name()));
        lines.extend(formulas.into_iter().map(print));
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
