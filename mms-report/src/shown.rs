//! A result in every format.

use std::fmt;
use std::str::FromStr;

use anyhow::bail;
use serde::Serialize;

use super::table::TextTable;

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
    /// The cases of a test, as JUnit XML.
    Junit,
}

impl Format {
    /// The names of all formats.
    pub const NAMES: [&str; 6] = ["text", "json", "csv", "markdown", "latex", "junit"];
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
            "junit" => Ok(Format::Junit),
            _ => Err("expected text, json, csv, markdown, latex or junit"),
        }
    }
}

/// A result that can be shown in every format.
pub trait Shown {
    /// The document of the result.
    type Document: Serialize;

    /// The text for a terminal.
    fn text(&self) -> String;

    /// The text with full lists and all explanations.
    fn full_text(&self) -> String {
        self.text()
    }

    /// The tables of the text.
    fn tables(&self) -> Vec<TextTable>;

    /// The document.
    fn document(&self) -> Self::Document;

    /// The numbers with all their digits as CSV; by default the tables, one after the other.
    ///
    /// # Errors
    /// A row that cannot be written.
    fn csv(&self) -> anyhow::Result<String> {
        let tables: anyhow::Result<Vec<String>> =
            self.tables().iter().map(TextTable::csv).collect();
        Ok(tables?.join("\n"))
    }

    /// The tables as GitHub and GitLab show them.
    fn markdown(&self) -> String {
        self.tables().iter().map(TextTable::markdown).collect::<Vec<_>>().join("\n")
    }

    /// The cases of a test, as JUnit XML.
    ///
    /// # Errors
    /// A result that has none: all but campaigns.
    fn junit(&self) -> anyhow::Result<String> {
        bail!("`--format junit`: only studies of `mms campaign` are test cases")
    }

    /// The result in a format other than JSON.
    ///
    /// # Errors
    /// The errors of [`csv`](Self::csv) and [`junit`](Self::junit).
    fn in_format(&self, format: Format) -> anyhow::Result<String> {
        Ok(match format {
            Format::Text | Format::Json => self.text(),
            Format::Csv => self.csv()?,
            Format::Markdown => self.markdown(),
            Format::Latex => {
                self.tables().iter().map(TextTable::latex).collect::<Vec<_>>().join("\n")
            }
            Format::Junit => self.junit()?,
        })
    }
}
