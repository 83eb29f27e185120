//! `mms emit`: the source text of a field, for another solver.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use mms_codegen::emit::{File, TARGETS, Target};
use mms_codegen::selection::{Freeze, Selection};
use serde_json::json;

use super::input::{Input, Variant, quantities, settings};
use super::{Outcome, print, print_json};
use crate::report::write_whole;

/// Write the source of a field for another solver: all of it, or only what is needed.
#[derive(Args)]
pub struct Emit {
    /// A gallery name, or a path to a TOML file.
    field: String,
    /// The language.
    #[arg(long, value_name = "NAME", default_value = "rust", value_parser = targets())]
    target: String,
    /// The folder for the file; without it the text goes to stdout.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Quantities, separated by commas; without it all of them, the domain and the material.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Change the default of a parameter, to a number or a formula in the parameters above it; may
    /// be repeated. Parameters that depend on it follow.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Make parameters constants at their defaults, so that what they make 0 disappears: all of
    /// them, or those named.
    #[arg(long, value_name = "NAME,..", num_args = 0.., require_equals = true, value_delimiter = ',')]
    freeze: Option<Vec<String>>,
    #[command(flatten)]
    variant: Variant,
    /// Print one JSON document, with the text in it unless --output is given.
    #[arg(long)]
    json: bool,
}

/// The words of the compiler's list.
fn targets() -> PossibleValuesParser {
    TARGETS.iter().map(|target| PossibleValue::new(target.name).help(target.doc)).into()
}

impl Emit {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let target =
            Target::find(&self.target).with_context(|| format!("no target `{}`", self.target))?;
        let input = Input::find_with(&self.field, &self.variant.options(self.selection()?))?;
        let file = (target.emit)(&input.compiled);
        let path = match &self.output {
            Some(folder) => Some(write(folder, &file)?),
            None => None,
        };
        if self.json {
            print_json(&json!({
                "field": input.name,
                "target": target.name,
                "file": file.name,
                "path": path,
                "text": if path.is_none() { Some(&file.text) } else { None },
            }))?;
        } else {
            print(path.as_ref().unwrap_or(&file.text))?;
        }
        Ok(Outcome::AsExpected)
    }

    fn selection(&self) -> anyhow::Result<Selection> {
        let everything = self.quantity.iter().all(|name| name.trim() == "all");
        let wanted = if everything { None } else { Some(quantities(&self.quantity)?) };
        let set = settings(&self.set)?;
        let freeze = match &self.freeze {
            None => Freeze::Nothing,
            Some(names) if names.is_empty() => Freeze::Everything,
            Some(names) => Freeze::Only(names.iter().map(|name| name.trim().into()).collect()),
        };
        Ok(Selection {
            quantities: wanted.map(BTreeSet::from_iter),
            set,
            freeze,
            ..Selection::default()
        })
    }
}

/// Writes a file into a folder, whole or not at all, and returns its path.
fn write(folder: &Path, file: &File) -> anyhow::Result<String> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder `{}`", folder.display()))?;
    let path = folder.join(&file.name);
    write_whole(&path, &file.text).with_context(|| format!("cannot write `{}`", path.display()))?;
    Ok(path.display().to_string())
}
