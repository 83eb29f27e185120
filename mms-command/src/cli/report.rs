//! `mms report`: results of a folder on a page.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;
use mms_exact::gallery::{self, FIELDS};
use mms_files::write::write_files;
use mms_files::write::{write_own, write_whole};
use mms_report::page::gallery::Listed;
use mms_report::page::{self, Page, Verdicts};
use mms_spec::foreign;

use super::{CommandOutcome, print, refuse_overwriting, say};

/// Write one HTML page, without other files, from all results in a folder.
///
/// The page has the verdicts first, then tables, convergence plots, diagnoses, campaigns of other solvers, the verification
/// matrix, error against cost, the solver at its limits, states of runs, the formulas and motions of the fields, and the
/// commands that repeat all this.
///
/// Results are the JSON documents that `mms study`, `judge`, `diagnose`, `campaign`, `verify`, `tradeoff`, `extremes`,
/// `accuracy` and `run` write with `--output`, or print with `--json`, and the states of `run --vtk`, in DIR and its folders.
/// The page and stderr name all other files.
///
/// The exit code is 1 if a verdict is not the expected one.
#[derive(Args)]
pub struct Report {
    /// The folder with the results.
    #[arg(value_name = "DIR", required_unless_present = "gallery")]
    folder: Option<PathBuf>,
    /// The file to write; by default DIR/report.html.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Run the studies of every field of the gallery, and write a page for each, and index.html, to this folder; takes a
    /// minute or two.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["folder", "output"])]
    gallery: Option<PathBuf>,
}

impl Report {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let verdicts = match (&self.gallery, &self.folder) {
            (Some(folder), _) => gallery(folder)?,
            (None, Some(folder)) => self.results(folder)?,
            (None, None) => bail!("expected a folder with results"),
        };
        Ok(if verdicts.are_expected() {
            CommandOutcome::AsExpected
        } else {
            CommandOutcome::Refuted
        })
    }

    /// Writes the page of a folder.
    fn results(&self, folder: &Path) -> anyhow::Result<Verdicts> {
        let path = self.output.clone().unwrap_or_else(|| folder.join("report.html"));
        let page = Page::read(folder)?;
        refuse_overwriting("--output", &path, page.files())?;
        for line in page.set_aside() {
            say(format_args!("not on the page: {line}"));
        }
        // By default, a name of ours in the folder.
        let write = if self.output.is_some() { write_whole } else { write_own };
        write(&path, &page.html())
            .with_context(|| format!("cannot write `{}`", foreign::path(&path)))?;
        let verdicts = page.verdicts();
        print(&format!("{}\nwrote {}", verdicts.word, foreign::path(&path)))?;
        Ok(verdicts)
    }
}

/// Writes the pages of the gallery.
fn gallery(folder: &Path) -> anyhow::Result<Verdicts> {
    let write = |name: &str, page: String| write_files(folder, name, [("html", page)]);
    let mut fields = Vec::new();
    for (entry, field) in FIELDS.iter().zip(gallery::fields()) {
        say(entry.name);
        let page = page::gallery::page(entry, &super::study::Study::without_machine)?;
        write(entry.name, page.html())?;
        fields.push(Listed { field, verdicts: page.verdicts(), thumbnail: page.thumbnail() });
    }
    write("index", page::gallery::index(&fields))?;
    let (expected, all) = fields.iter().fold((0, 0), |(expected, all), Listed { verdicts, .. }| {
        (expected + verdicts.expected, all + verdicts.all)
    });
    let verdicts = Verdicts::several(expected, all, "studies pass");
    let folder = foreign::path(folder);
    print(&format!("{}\nwrote {} pages to {folder}", verdicts.word, FIELDS.len() + 1))?;
    Ok(verdicts)
}
