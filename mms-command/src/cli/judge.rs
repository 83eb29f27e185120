//! `mms judge`: the observed order of any solver, from its results, or from errors that somebody measured.

mod results;

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Args;
use mms_convergence::{TOLERANCE, Verdict};
use mms_files::read::{self, FileKind};
use mms_files::store::digest;
use mms_judge::Judgements;
use mms_judge::next;
use mms_judge::table::{self, Order, Orders};
use mms_options::method::positive;
use mms_report::View;
use mms_spec::foreign;

use super::figure::FigureFile;
use super::format::{Detail, Printing};
use super::{Outcome, print, replaced, this_command, validate_output};
use crate::provenance::Input;

/// Judge the errors of any solver: observed orders with their intervals, what hides behind them, and a verdict.
///
/// Results of a FIELD are one FILE for each mesh. Their errors are measured over cells if there are any, otherwise over points.
/// Two of X, x and u give the third; --map gives the meaning of unknown names. Tractions P N belong to a face, as
/// traction_x_max, or come with unit normals N.
///
/// The table of --errors has a header and a row for each run: `h`, `dt` where it is known, and errors in columns of any names. Several
/// rows of one h are replicates, of other grid offsets or seeds. l1, l2, linf, H1, and what people call them (mean, rms,
/// max), alone or with the name of a quantity, as in u_l2, are norms; another column is judged by itself. The worst of
/// all decides. An empty field is a run that stopped; `round_off` is a column of floors below which errors are left out;
/// counts, orders and times are passed over, so that the CSV file of `mms study` can be judged as it is.
///
/// pass: the order is the expected one within --tolerance. Of three levels and more C h^p + D h^(p-1) + E h^(p+1) is fitted: the
/// share of D in the finest error, with its uncertainty, is the tolerance at most. fail: the order is lower. not
/// asymptotic: the levels do not tell, or the order is higher. Two levels are held to their order alone. exact to
/// round-off: no error of results is more than rounding makes, in files with the digits of single precision at least. no
/// evidence: a solver is given all values that were compared, at the start, on its walls or as loads, or points leave part
/// of the body empty.
///
/// The digits of a table count: an order from 1.2e-3 and 3.1e-4 is known to 0.1.
///
/// Beside a pass of u, v or F stands what it excludes: the mistakes that `mms diagnose` knows, by what they add to a run of this
/// project's own solver, over the finest error.
///
/// Exit codes: 0 pass, or exact to round-off; 1 fail, or not asymptotic; 2 no evidence, bad usage, or a bad file.
#[derive(Args)]
pub struct Judge {
    /// A gallery name, or a path to a TOML file.
    #[arg(requires = "files", required_unless_present_any = ["errors", "same"])]
    field: Option<String>,
    /// Results, each of one mesh, at one time or more: a file, a list of states (.pvd), a folder, or a quoted pattern such as
    /// 'out/*.vtu'. Tables, VTK, XDMF, NumPy, MATLAB, CalculiX, Gmsh, Tecplot, dumps of LAMMPS and Karamelo, and with the feature
    /// hdf5 HDF5 and netCDF; each is known by its content, and docs/guide/files.md lists them. --explain prints how one is read.
    #[arg(value_name = "FILE")]
    files: Vec<String>,
    /// Judge this table instead: values between commas, semicolons, tabs or blanks; lines that begin with # are comments.
    #[arg(long, value_name = "TABLE", conflicts_with_all = ["field", "files"])]
    errors: Option<PathBuf>,
    /// Judge the rows of this method in a table of several, as `mms study` writes it for a list of methods.
    #[arg(long, value_name = "NAME", requires = "errors")]
    method: Option<String>,
    #[command(flatten)]
    results: results::Options,
    /// The order to judge against: without it 2, and for results one more than the degree of their cells. H1 has the degree of
    /// the cells at most, or one less than this order in a table. Stresses and strains in cells have at least the order of H1;
    /// --start determines the orders of v and a. NAME is a norm, a quantity, QUANTITY:NORM or a column, whose order is then
    /// this one; H1 of a quantity follows from it as above. `time` is the order in dt where h and dt are refined each by
    /// itself.
    #[arg(long, value_name = "[NAME=]P,..", value_delimiter = ',')]
    expected_order: Vec<Order>,
    /// How far the observed order may be from the expected one.
    #[arg(long, value_name = "W", value_parser = positive, default_value_t = TOLERANCE)]
    tolerance: f64,
    /// Write convergence.svg, .csv and .json there.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    figure: FigureFile,
    #[command(flatten)]
    detail: Detail,
    #[command(flatten)]
    printing: Printing,
}

impl Judge {
    pub fn run(self) -> anyhow::Result<Outcome> {
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        self.figure.hold()?;
        match (&self.errors, &self.field) {
            (Some(table), _) => self.errors(table),
            (None, Some(field)) => self.results(field),
            (None, None) => self.same(),
        }
    }

    fn errors(&self, table: &Path) -> anyhow::Result<Outcome> {
        let text = read::text(table, FileKind::Errors)?;
        let (measured, notes) =
            table::read_one(table, &text, &self.orders(), self.method.as_deref())?;
        let source = foreign::path(table);
        let input =
            Input { field: None, rigid: None, window: None, set: Vec::new(), hash: digest([text]) };
        let provenance = this_command("judge", input);
        let mut report = Judgements::of(source.clone(), measured, provenance).context(source)?;
        report.notes = notes;
        report.next = next::after_judgement(&report, None, false);
        self.tell(&report)
    }

    /// Prints a report, and writes it if an option requests files.
    fn tell(&self, report: &Judgements) -> anyhow::Result<Outcome> {
        self.printing.print_in(self.detail, &View(report))?;
        let mut written = Vec::new();
        if let Some(folder) = &self.output {
            replaced::tell(folder, "convergence", &report.provenance);
            written.extend(View(report).write(folder)?);
        }
        written.extend(self.figure.write(|| View(report).figure())?);
        if !written.is_empty() && self.printing.is_text() {
            print(&format!("\nwrote {}", written.join(", ")))?;
        }
        Ok(outcome(report.verdict()))
    }

    fn orders(&self) -> Orders {
        let orders = Orders::new(&self.expected_order, self.tolerance);
        Orders { start: self.results.start, ..orders }
    }
}

/// The exit code of a verdict.
fn outcome(verdict: Verdict) -> Outcome {
    match verdict {
        Verdict::Pass | Verdict::Exact => Outcome::AsExpected,
        Verdict::Fail | Verdict::NotAsymptotic => Outcome::Refuted,
        Verdict::NoEvidence => Outcome::BadInput,
    }
}
