//! `--figure` and `mms plot`: curves as a figure for print.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use mms_files::write::{try_to_write, write_with};
use mms_report::page::figure;
use mms_report::plot::{Figure, FileFormat, Width};
use mms_spec::foreign;

use super::{CommandOutcome, print, refuse_overwriting, say};

/// The figure of a result.
#[derive(Args, Clone, Debug)]
pub struct FigureFile {
    /// Draw the curves for print to this file; its name ends in .svg or .pdf.
    #[arg(long, value_name = "FILE", value_parser = drawn())]
    figure: Option<PathBuf>,
}

/// Draw results for print: errors over h or dt with their orders, or error against cost.
///
/// FILE is a JSON document that `mms study`, `judge`, `campaign`, `tradeoff`, `extremes` or `accuracy` writes with
/// `--output`, or prints with `--json`. Curves of several files share a panel if they have the same axes and units; each
/// other unit has its own panel.
///
/// Marks and dashes distinguish curves in black and white. The legend has the observed order of each curve, and a triangle
/// shows the expected slope. SVG and PDF contain lines and letters, no pixels.
#[derive(Args)]
pub struct Plot {
    /// The JSON documents to draw.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// The figure to write; its name ends in .svg or .pdf.
    #[arg(long, short, value_name = "FIGURE", value_parser = drawn())]
    output: PathBuf,
    /// The width in millimetres: 85 for one column, with the legend below the curves, or 170 for a page, with the legend
    /// beside them.
    #[arg(long, value_name = "85|170", default_value_t)]
    width: Width,
}

/// A path whose ending says the format.
fn drawn() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| FileFormat::of(&path).map(|_| path))
}

impl FigureFile {
    /// Checks that the file can be written; fails before any work is done.
    pub fn validate(&self) -> anyhow::Result<()> {
        let Some(path) = &self.figure else { return Ok(()) };
        try_to_write(path)
            .with_context(|| format!("cannot write `--figure {}`", foreign::path(path)))
    }

    /// Draws a figure as wide as a page, if an option requests one, and returns its path.
    pub fn write(&self, figure: impl FnOnce() -> Figure) -> anyhow::Result<Option<String>> {
        let Some(path) = &self.figure else { return Ok(None) };
        let (figure, shown) = (figure(), foreign::path(path));
        if figure.is_empty() {
            say(format_args!("note: no error is a positive number: `{shown}` is not written"));
            return Ok(None);
        }
        write(path, &figure, Width::Page)?;
        Ok(Some(shown))
    }
}

impl Plot {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        refuse_overwriting("--output", &self.output, &self.files)?;
        let figure = figure::read(&self.files)?;
        write(&self.output, &figure, self.width)?;
        print(&format!("wrote {}", foreign::path(&self.output)))?;
        Ok(CommandOutcome::AsExpected)
    }
}

fn write(path: &Path, figure: &Figure, width: Width) -> anyhow::Result<()> {
    let format = FileFormat::of(path).map_err(anyhow::Error::msg)?;
    let bytes = figure.file(format, width);
    write_with(path, |file| Ok(std::io::Write::write_all(file, &bytes)?))
        .with_context(|| format!("cannot write `{}`", foreign::path(path)))
}
