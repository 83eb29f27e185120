//! `mms report`: results of a folder on a page.

use std::path::PathBuf;

use anyhow::Context as _;
use clap::Args;

use super::{Outcome, print};
use crate::page::Page;
use crate::report::write_whole;

/// Put all results of a folder on one page of HTML, complete in itself: verdicts first, then tables, pictures of
/// convergence, the verification matrix, states of runs, the formulas and motions of the fields, and the commands
/// that make it all again.
///
/// Results are the JSON documents that `mms study`, `verify`, `accuracy` and `run` write with `--output`, or print
/// with `--json`, and the states of `run --vtk`, in DIR and in the folders in it. Files that are none of these are
/// named, on the page and on stderr.
///
/// Exit code 1 if a verdict is not the expected one.
#[derive(Args)]
pub struct Report {
    /// The folder with the results.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The file to write; DIR/report.html by default.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Report {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let page = Page::read(&self.folder)?;
        for line in page.set_aside() {
            anstream::eprintln!("not on the page: {line}");
        }
        let path = self.output.unwrap_or_else(|| self.folder.join("report.html"));
        write_whole(&path, &page.html())
            .with_context(|| format!("cannot write `{}`", path.display()))?;
        let verdicts = page.verdicts();
        print(&format!("{}\nwrote {}", verdicts.word, path.display()))?;
        Ok(if verdicts.expected == verdicts.all { Outcome::AsExpected } else { Outcome::Refuted })
    }
}
