//! `mms judge FIELD FILE..`: results of any solver against a field.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use mms_convergence::Verdict;
use mms_documents::judge::JudgeExplained;
use mms_exact::Exact;
use mms_exact::evaluated;
use mms_files::read::{self, FileKind};
use mms_files::results::Disk;
use mms_judge::Judgements;
use mms_judge::next::{self, Meshes};
use mms_judge::results::{
    Baseline, Comparison, Explained, Measurement, Over, Reading, Results, Start, measure, room,
    same, weight,
};
use mms_judge::table::ExpectedOrders;
use mms_options::field::{Variant, find};
use mms_options::method::{finite, length};
use mms_report::{differences, with_baseline};
use mms_results::names::{Names, Role, everything};
use mms_spec::foreign;
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

use super::super::naming::Naming;
use super::super::next::typed;
use super::super::warned::warned;
use super::super::{CommandOutcome, say, this_command};
use super::{Judge, outcome};
use crate::session::progress::StatusLine;

/// How results are read.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    naming: Naming,
    /// The quantities to judge, by name or symbol, separated by commas; by default all that the files contain.
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    quantity: Vec<String>,
    /// The cell size h of each FILE, in their order; 1/8 is a number too. By default h is measured from the files.
    #[arg(long, value_name = "H,..", value_delimiter = ',', value_parser = length)]
    h: Vec<f64>,
    /// How the solver starts, which determines the expected orders of v and a: from exact values at its nodes, the default if
    /// the files have cells, or from the elliptic (Ritz) projection.
    #[arg(long, value_name = "HOW", requires = "field", value_parser = starts())]
    pub(super) start: Option<Start>,
    /// Accept results that cover a part of the body: a symmetric half, a line, a probe. The verdict says so.
    #[arg(long, requires = "field")]
    part: bool,
    /// Where norms are computed: over `points` or over `cells`; by default over cells, if there are any. Use `points` for a
    /// quadratic solution that was written on linear cells.
    #[arg(long, value_name = "points|cells", requires = "field", value_parser = Over::of)]
    over: Option<Over>,
    /// Print how each FILE is read and why, and judge nothing: its format, times, points and cells, the array of each
    /// quantity, the order of components, and the arrays that are not used.
    #[arg(long, requires = "field", conflicts_with = "figure")]
    explain: bool,
    /// The times to judge at, by default all that the files share. Also replaces times that files print with fewer digits, or
    /// states the times of files without times.
    #[arg(long, value_name = "T,..", value_delimiter = ',', value_parser = finite, allow_hyphen_values = true)]
    time: Vec<f64>,
    /// Judge all nine components of tensors: plane strain in two dimensions, uniaxial strain in one. F_33 is 1, and the
    /// stress out of the plane is included.
    #[arg(long)]
    all_components: bool,
    /// The column that weights means over points: volume or mass; by default all points weigh the same.
    #[arg(long, value_name = "NAME", value_parser = weight)]
    weight: Option<Role>,
    /// The most memory for reading a file, in MB; by default the free memory.
    #[arg(long, value_name = "MB")]
    max_memory: Option<u64>,
    /// Results on the mesh of one FILE, computed with a smaller tolerance of the solver. The difference is the iterative
    /// error; the verdict ignores levels whose error is not a hundred times larger.
    #[arg(long, value_name = "FILE", requires = "field")]
    tighter: Option<String>,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    variant: Variant,
    /// Compare the errors with a document that `--output` wrote, on the same meshes: they may change by 1 %. One coarse mesh
    /// is enough to show in seconds that nothing has changed.
    #[arg(long, value_name = "JSON", conflicts_with = "figure")]
    baseline: Option<PathBuf>,
    /// Compare two results of one run, from other ranks, in another precision or after a restart: print the largest
    /// differences and their places. Points are paired by numbers that both files contain (`id`, `GlobalNodeIds`, ..), else
    /// by X, else by their order; several points in one place may be paired with one. Needs no FIELD.
    #[arg(long, num_args = 2, value_names = ["A", "B"], conflicts_with_all = ["field", "files", "errors", "figure"])]
    same: Vec<String>,
}

/// Reads the start of a solver.
fn starts() -> impl TypedValueParser<Value = Start> {
    let names = PossibleValuesParser::new([
        PossibleValue::new("interpolation").help("The exact values at its nodes"),
        PossibleValue::new("projection").help(
            "The elliptic (Ritz) projection of the exact motion, so that no order is lowered",
        ),
    ]);
    names.try_map(|name| Start::of(&name))
}

impl Options {
    /// The results of a field, and the options that `mms diagnose` takes as well.
    fn meshes(&self, field: &str, files: &[String]) -> Meshes {
        let options = [
            next::list("h", &self.h).into_iter().collect(),
            next::list("time", &self.time).into_iter().collect(),
            self.naming.arguments(),
            next::each("max-memory", self.max_memory.as_slice()),
            next::each("set", &self.set),
            self.variant.arguments(),
        ];
        Meshes {
            field: field.to_owned(),
            files: files.to_vec(),
            options: options.concat(),
            of_judge: Some(typed()),
        }
    }
}

impl Judge {
    /// Judges results, or compares two.
    pub(super) fn results(&self, field: &str) -> anyhow::Result<CommandOutcome> {
        let options = &self.results;
        if self.files.is_empty() {
            bail!(
                "expected files with results of `{}`: one mesh each, from coarse to fine",
                shown(field)
            );
        }
        let input = find(field, &options.variant)?;
        let mut exact = Exact::new(input, &options.set)?.in_space_if(options.all_components);
        if options.explain {
            return self.explain(&mut exact);
        }
        let measurement = self.measured(&mut exact, &self.orders())?;
        measurement.warnings.iter().for_each(|warning| say(format_args!("warning: {warning}")));
        if let Some(path) = &options.baseline {
            return self.against(path, &exact.title(), &measurement);
        }
        let provenance = this_command("judge", exact.input().provenance(&options.set));
        let mut report = Judgements::of_results(
            &exact,
            &self.files,
            measurement,
            None,
            provenance,
            &StatusLine::new(),
        )?;
        if !report.verdict().is_good() {
            let found = warned(exact.input(), &options.set, &options.variant)?;
            report.notes.extend(found.map(|it| it.says));
        }
        let meshes = options.meshes(field, &self.files);
        let is_chosen = !options.quantity.is_empty();
        report.next = next::after_judgement(&report, Some(&meshes), is_chosen);
        self.tell(&report)
    }

    /// Prints how each file is read.
    fn explain(&self, exact: &mut Exact) -> anyhow::Result<CommandOutcome> {
        let (names, wanted) = self.asked(exact)?;
        let reading = self.reading(&names, &wanted);
        let mut all = Vec::new();
        for file in &self.files {
            let mut results = reading.find(file, exact)?;
            all.push(Explained::new(&mut results, &reading, exact)?);
        }
        let texts: Vec<String> = all.iter().map(Explained::text).collect();
        let files = all.iter().map(Explained::document).collect();
        self.printing.print_without_table(&texts.join("\n"), &JudgeExplained { files })?;
        Ok(CommandOutcome::AsExpected)
    }

    /// The names of arrays, and the requested quantities.
    fn asked(&self, exact: &Exact) -> anyhow::Result<(Names, Vec<Quantity>)> {
        let wanted = match self.results.quantity.as_slice() {
            [] => Vec::new(),
            names => {
                let input = exact.input();
                input.offered(names, evaluated(&input.own_quantities(), names)?)?
            }
        };
        Ok((self.results.naming.names(Some(exact.input()))?, wanted))
    }

    fn reading<'a>(&self, names: &'a Names, wanted: &'a [Quantity]) -> Reading<'a> {
        let options = &self.results;
        Reading {
            files: &Disk,
            names,
            wanted,
            weight: options.weight,
            memory: options.max_memory,
            is_part: options.part,
            over: options.over,
        }
    }

    fn measured(&self, exact: &mut Exact, orders: &ExpectedOrders) -> anyhow::Result<Measurement> {
        let options = &self.results;
        let (names, wanted) = self.asked(exact)?;
        let reading = self.reading(&names, &wanted);
        let all = self
            .files
            .iter()
            .map(|file| reading.find(file, exact))
            .collect::<anyhow::Result<_>>()?;
        let tighter = options.tighter.as_deref().map(|it| reading.find(it, exact)).transpose()?;
        let status = StatusLine::new();
        let comparison = Comparison {
            sizes: &options.h,
            times: &options.time,
            orders,
            has_steps: false,
            tighter,
            follow: &status,
        };
        measure(all, &reading, exact, comparison)
    }

    fn against(
        &self,
        path: &Path,
        title: &str,
        measurement: &Measurement,
    ) -> anyhow::Result<CommandOutcome> {
        let text = read::text(path, FileKind::Result)?;
        let compared = Baseline::read(&text).and_then(|it| it.compare(&measurement.measured));
        let compared = compared.with_context(|| format!("`--baseline {}`", foreign::path(path)))?;
        let verdict =
            if compared.iter().all(|it| it.is_near()) { Verdict::Pass } else { Verdict::Fail };
        let is_no_evidence = measurement.objection.as_ref().is_some_and(|it| it.is_to_all);
        let verdict = if is_no_evidence { Verdict::NoEvidence } else { verdict };
        self.printing.print(&with_baseline(title, &compared, verdict))?;
        Ok(outcome(verdict))
    }

    /// Compares two results.
    pub(super) fn same(&self) -> anyhow::Result<CommandOutcome> {
        let [a, b] = self.results.same.as_slice() else { bail!("`--same`: expected two results") };
        let (room, advice) = room(self.results.max_memory, &Disk);
        let names = self.results.naming.names(None)?;
        let find = |given| Results::find(given, &everything(&names).within(room, advice), &Disk);
        let found = same(&find(a)?, &find(b)?, &names)?;
        self.printing.print(&differences(a, b, &found))?;
        Ok(if found.is_finite() { CommandOutcome::AsExpected } else { CommandOutcome::Refuted })
    }
}
