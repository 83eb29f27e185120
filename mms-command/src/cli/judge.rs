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
use mms_judge::table::{self, ExpectedOrders, NamedOrder};
use mms_options::method::positive;
use mms_report::View;
use mms_spec::foreign;

use super::figure::FigureFile;
use super::format::{Detail, Printing};
use super::{CommandOutcome, print, replaced, this_command, validate_output};
use crate::provenance::Input;

/// Judge the errors of any solver: compute the observed orders with their intervals, search for hidden terms of lower order,
/// and give a verdict.
///
/// For the results of a FIELD, give one FILE for each mesh. Errors are measured over cells if the file has cells, otherwise
/// over points. Two of X, x and u determine the third; --map assigns unknown names. Tractions P N belong to a face, as in
/// traction_x_max, or need unit normals N.
///
/// For a table of --errors, give a header and one row for each run: `h`, `dt` if it matters, and errors in columns of any
/// names. Rows with equal h are replicates, such as other grid offsets or seeds. A column is a norm if its name is l1, l2,
/// linf, H1 or a synonym (mean, rms, max), alone or with a quantity, as in u_l2; any other column is judged by itself. The
/// worst verdict counts. An empty field is a run that stopped. A column `round_off` contains floors; errors below them are
/// ignored. Counts, orders and times are not judged, so the CSV file of `mms study` can be judged as it is.
///
/// pass: the order is the expected one within --tolerance. With three or more levels C h^p + D h^(p-1) + E h^(p+1) is fitted,
/// and the share of D in the finest error, with its uncertainty, must be at most the tolerance. With two levels only their
/// order counts.
///
/// fail: the order is lower.
///
/// not asymptotic: the levels are not conclusive, or the order is higher.
///
/// exact to round-off: all errors are at most what rounding makes, in files with at least the digits of single precision.
///
/// no evidence: the solver was given all values that were compared, at the start, on its walls or as loads; or points leave
/// part of the body empty.
///
/// The number of digits in a table matters: an order from 1.2e-3 and 3.1e-4 is known to 0.1.
///
/// If u, v or F pass, the output lists the mistakes that this excludes: mistakes that `mms diagnose` knows, and whose error, in
/// runs of the built-in solver, would have changed the verdict.
///
/// Exit codes: 0 pass, or exact to round-off; 1 fail, or not asymptotic; 2 no evidence, bad usage, or a bad file.
#[derive(Args)]
pub struct Judge {
    /// A name that `mms list` prints, or the path of a TOML file.
    #[arg(requires = "files", required_unless_present_any = ["errors", "same"])]
    field: Option<String>,
    /// Results of one mesh, at one or more times: a file, a list of states (.pvd), a folder, or a quoted pattern such as
    /// 'out/*.vtu'. Formats: tables, VTK, XDMF, NumPy, MATLAB, CalculiX, Gmsh, Tecplot, dumps of LAMMPS and Karamelo, and
    /// with the feature hdf5 HDF5 and netCDF. The content determines the format; docs/guide/files.md lists all, and --explain
    /// prints how a file is read.
    #[arg(value_name = "FILE")]
    files: Vec<String>,
    /// Judge this table of errors in place of results: values between commas, semicolons, tabs or blanks; lines that begin
    /// with # are comments.
    #[arg(long, value_name = "TABLE", conflicts_with_all = ["field", "files"])]
    errors: Option<PathBuf>,
    /// Judge the rows of this method, if the table has several, as `mms study` writes it for a list of methods.
    #[arg(long, value_name = "NAME", requires = "errors")]
    method: Option<String>,
    #[command(flatten)]
    results: results::Options,
    /// The expected order. The default is 2, and for results one more than the degree of their cells. The default for H1 is
    /// the degree of the cells, or in a table one less than the expected order. Stresses and strains in cells have at least
    /// the order of H1; --start determines the orders of v and a. With NAME= the order is for one norm, quantity,
    /// QUANTITY:NORM or column; the order of H1 of a quantity is then one less. `time` is the order in dt, if h and dt are
    /// refined separately.
    #[arg(long, value_name = "[NAME=]P,..", value_delimiter = ',')]
    expected_order: Vec<NamedOrder>,
    /// The largest allowed difference between the observed and the expected order.
    #[arg(long, value_name = "W", value_parser = positive, default_value_t = TOLERANCE)]
    tolerance: f64,
    /// The folder to write convergence.svg, convergence.csv and convergence.json to.
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
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        self.figure.validate()?;
        match (&self.errors, &self.field) {
            (Some(table), _) => self.errors(table),
            (None, Some(field)) => self.results(field),
            (None, None) => self.same(),
        }
    }

    fn errors(&self, table: &Path) -> anyhow::Result<CommandOutcome> {
        let text = read::text(table, FileKind::Errors)?;
        let (measured, notes) = table::read(table, &text, &self.orders(), self.method.as_deref())?;
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
    fn tell(&self, report: &Judgements) -> anyhow::Result<CommandOutcome> {
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

    fn orders(&self) -> ExpectedOrders {
        let orders = ExpectedOrders::new(&self.expected_order, self.tolerance);
        ExpectedOrders { start: self.results.start, ..orders }
    }
}

/// The exit code of a verdict.
fn outcome(verdict: Verdict) -> CommandOutcome {
    match verdict {
        Verdict::Pass | Verdict::Exact => CommandOutcome::AsExpected,
        Verdict::Fail | Verdict::NotAsymptotic => CommandOutcome::Refuted,
        Verdict::NoEvidence => CommandOutcome::BadInput,
    }
}
