//! `mms list`: what there is to choose from.

use clap::Args;
use comfy_table::Table;
use comfy_table::presets::NOTHING;
use mms_codegen::compile::MATERIALS;
use mms_runtime::{IntegratorName, ShapeName};
use serde_json::json;

use super::input::{Input, Variant};
use super::{Outcome, print, print_json};
use crate::gallery;

/// List the fields, materials and methods.
#[derive(Args)]
pub struct List {
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl List {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let fields = gallery::FIELDS
            .iter()
            .map(|entry| Input::find(entry.name, &Variant::default()))
            .collect::<anyhow::Result<Vec<_>>>()?;
        let materials: Vec<_> = MATERIALS.iter().map(|(stem, _)| *stem).collect();
        if self.json {
            let fields: Vec<_> = fields
                .iter()
                .map(|input| {
                    let field = &input.compiled.field;
                    json!({
                        "name": input.name,
                        "title": field.title,
                        "dimension": field.dimension,
                        "material": field.material.model.value,
                        "reference": field.reference,
                    })
                })
                .collect();
            print_json(&json!({
                "fields": fields,
                "materials": materials,
                "shapes": ShapeName::NAMES,
                "integrators": IntegratorName::NAMES,
            }))?;
            return Ok(Outcome::AsExpected);
        }
        let mut table = Table::new();
        table.load_style(NOTHING).set_header(["field", "dimension", "material", "title"]);
        for input in &fields {
            let field = &input.compiled.field;
            let dimension = field.dimension.to_string();
            table.add_row([&input.name, &dimension, &field.material.model.value, &field.title]);
        }
        print(&format!(
            "{table}\n\nmaterials:   {}\nshapes:      {}\nintegrators: {}",
            materials.join(", "),
            ShapeName::NAMES.join(", "),
            IntegratorName::NAMES.join(", ")
        ))?;
        Ok(Outcome::AsExpected)
    }
}
