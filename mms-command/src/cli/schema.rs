//! `mms schema`: the formats of files and documents.

use clap::Args;

use super::{CommandOutcome, print_json};
use crate::schema;

/// Print the JSON Schema of field files, of material files, or of a document that `--json` prints.
///
/// With the schema of field files, editors explain, complete and check keys. Save it, and name it in the first line of a
/// field file: #:schema ./field.schema.json
#[derive(Args)]
pub struct Schema {
    /// Print the schema of material files.
    #[arg(long)]
    material: bool,
    /// Print the schema of a JSON document: `study`, `judge`, `campaign` and so on; docs/reference/json.md lists them.
    #[arg(long, value_name = "NAME", conflicts_with = "material")]
    document: Option<String>,
}

impl Schema {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        print_json(&match self.document {
            Some(name) => schema::documents::document(&name)?,
            None if self.material => schema::material(),
            None => schema::field(),
        })?;
        Ok(CommandOutcome::AsExpected)
    }
}
