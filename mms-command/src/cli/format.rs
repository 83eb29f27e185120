//! The format of what a command prints.

use anyhow::bail;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use mms_report::{Format, Shown};
use serde::Serialize;

use super::{print, print_json};

/// How a result is printed.
#[derive(Args, Clone, Copy, Debug)]
pub struct Printing {
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
    /// The output format: text for a terminal; json, like --json; csv, markdown or latex (with the package booktabs) for the
    /// tables only; junit for the studies of a campaign.
    #[arg(long, value_name = "FORMAT", conflicts_with = "json", value_parser = formats())]
    format: Option<Format>,
}

/// How much a text says.
#[derive(Args, Clone, Copy, Debug)]
pub struct Detail {
    /// Print full lists and all explanations; --json always has them.
    #[arg(long)]
    verbose: bool,
}

fn formats() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::NAMES).try_map(|name| name.parse::<Format>())
}

impl Printing {
    fn format(self) -> Format {
        if self.json { Format::Json } else { self.format.unwrap_or_default() }
    }

    /// Whether text is printed, beside which other lines may stand.
    pub fn is_text(self) -> bool {
        self.format() == Format::Text
    }

    /// Whether the document is printed.
    pub fn is_json(self) -> bool {
        self.format() == Format::Json
    }

    /// Prints a result that has no table.
    ///
    /// # Errors
    /// A format of tables.
    pub fn print_without_table(self, text: &str, document: &impl Serialize) -> anyhow::Result<()> {
        match self.format() {
            Format::Json => print_json(document),
            Format::Text => print(text),
            format => bail!("`--format {format}`: no table is printed here; expected text or json"),
        }
    }

    /// Prints a result; in full if `--verbose` requests it and the format is text.
    pub fn print_in(self, detail: Detail, result: &impl Shown) -> anyhow::Result<()> {
        match detail.verbose && self.is_text() {
            true => print(&result.full_text()),
            false => self.print(result),
        }
    }

    /// Prints a result.
    pub fn print(self, result: &impl Shown) -> anyhow::Result<()> {
        match self.format() {
            Format::Json => print_json(&result.document()),
            format => print(&result.in_format(format)?),
        }
    }
}
