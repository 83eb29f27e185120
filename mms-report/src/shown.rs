//! A result in every format.

use std::fmt;
use std::str::FromStr;

use serde::Serialize;

use super::table::Table;

/// The format of what a command prints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Tables and sentences.
    #[default]
    Text,
    /// The document.
    Json,
    /// The tables, with commas between their cells.
    Csv,
    /// The tables, as GitHub and GitLab show them.
    Markdown,
    /// The tables, for the package booktabs.
    Latex,
}

impl Format {
    /// The names of all formats.
    pub const NAMES: [&str; 5] = ["text", "json", "csv", "markdown", "latex"];
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Format::NAMES[*self as usize])
    }
}

impl FromStr for Format {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "text" => Ok(Format::Text),
            "json" => Ok(Format::Json),
            "csv" => Ok(Format::Csv),
            "markdown" => Ok(Format::Markdown),
            "latex" => Ok(Format::Latex),
            _ => Err("expected text, json, csv, markdown or latex"),
        }
    }
}

/// A result that can be shown in every format.
pub trait Shown {
    /// The document of the result.
    type Document: Serialize;

    /// The text for a terminal.
    fn text(&self) -> String;

    /// The tables of the text.
    fn tables(&self) -> Vec<Table>;

    /// The document.
    fn document(&self) -> Self::Document;

    /// The numbers with all their digits as CSV; by default the tables, one after the other.
    ///
    /// # Errors
    /// A row that cannot be written.
    fn csv(&self) -> anyhow::Result<String> {
        let tables: anyhow::Result<Vec<String>> = self.tables().iter().map(Table::csv).collect();
        Ok(tables?.join("\n"))
    }

    /// The result in a format other than JSON.
    ///
    /// # Errors
    /// As of [`csv`](Self::csv).
    fn in_format(&self, format: Format) -> anyhow::Result<String> {
        let all = |view: fn(&Table) -> String| {
            self.tables().iter().map(view).collect::<Vec<_>>().join("\n")
        };
        Ok(match format {
            Format::Text | Format::Json => self.text(),
            Format::Csv => self.csv()?,
            Format::Markdown => all(Table::markdown),
            Format::Latex => all(Table::latex),
        })
    }
}
