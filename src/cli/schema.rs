//! `mms schema`: the format of field files, for editors.

use clap::Args;

use super::{Outcome, print_json};
use crate::schema;

/// Print the JSON Schema of field files, by which editors explain, complete and check their keys.
///
/// Save it, and name it in the first line of a field file: #:schema ./field.schema.json
#[derive(Args)]
pub struct Schema {
    /// The schema of material files instead.
    #[arg(long)]
    material: bool,
}

impl Schema {
    pub fn run(self) -> anyhow::Result<Outcome> {
        print_json(&if self.material { schema::material() } else { schema::field() })?;
        Ok(Outcome::AsExpected)
    }
}
