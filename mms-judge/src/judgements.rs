//! Judged errors, and the document of a judgement.

use mms_convergence::{Basis, Judgement, NormFinding, RULE, SequenceLevel, TermKind, Verdict};
use mms_diagnosis::follow::Follow;
use mms_documents::Names;
use mms_documents::judge as documents;
use mms_documents::provenance::Provenance;
use mms_documents::study::{JudgedLevel, JudgedNorm, LevelErrors, Limit, LowerOrder, SecondTerm};
use mms_exact::{Exact, Input, units};

use crate::measured::{Measured, Norm, Objection, Quantity, QuantityJudgement, Refined, worst};
use crate::results::{Exclusions, Measurement, exclusions};

/// Errors and their verdicts.
pub struct Judgements {
    /// The source of the errors, in a word or two.
    pub source: String,
    /// The errors.
    pub measured: Measured,
    /// The lengths that differ between the runs.
    pub refined: Refined,
    /// The judgement of each quantity.
    pub judged: Vec<QuantityJudgement>,
    /// Sentences about the measurement of the errors.
    pub notes: Vec<String>,
    /// The part of the body that results cover, if a part was enough.
    pub part: Option<String>,
    /// The mistakes that results exclude if they pass.
    pub exclusions: Option<Exclusions>,
    /// The words of the command to type next, if the verdict is no pass.
    pub next: Option<Vec<String>>,
    /// Whether a campaign file has the expected orders, and not a command line.
    is_of_campaign: bool,
    /// The place of the largest error of each quantity on the finest mesh, in words; empty for a table.
    largest: Vec<String>,
    /// A question about a time or a parameter of the field, if displacements do not pass.
    question: Option<String>,
    /// The keys of results of files.
    results: Results,
    /// The provenance of the document.
    pub provenance: Provenance,
}

/// The quantity whose errors raise a question about the field.
const DISPLACEMENT: &str = "displacement";

/// The norms of levels in the document of a study.
const NORMS: [&str; 3] = ["l1", "l2", "linf"];

impl Judgements {
    /// Judges measured errors.
    ///
    /// # Errors
    /// Runs that cannot be compared.
    pub fn of(source: String, measured: Measured, provenance: Provenance) -> anyhow::Result<Self> {
        Self::objected(source, measured, None, provenance)
    }

    fn objected(
        source: String,
        measured: Measured,
        objection: Option<&Objection>,
        provenance: Provenance,
    ) -> anyhow::Result<Self> {
        let (refined, judged) = measured.judged(objection)?;
        Ok(Self {
            source,
            refined,
            judged,
            measured,
            notes: Vec::new(),
            part: None,
            exclusions: None,
            next: None,
            is_of_campaign: false,
            largest: Vec::new(),
            question: None,
            results: Results::default(),
            provenance,
        })
    }

    /// Judges the errors of results in files. If they pass, the solver of this project runs with each mistake, to list the
    /// mistakes that the results exclude.
    ///
    /// # Errors
    /// Runs that cannot be compared.
    pub fn of_results(
        exact: &Exact,
        files: &[String],
        measurement: Measurement,
        time_step: Option<f64>,
        provenance: Provenance,
        follow: &dyn Follow,
    ) -> anyhow::Result<Self> {
        let times = measurement.times.clone();
        let report = Self::without_exclusions(exact, files, measurement, provenance)?;
        let exclusions = match report.verdict().is_good() {
            true => exclusions(exact, &report.measured, times, time_step, follow)?,
            false => None,
        };
        Ok(Self { exclusions, ..report })
    }

    /// Judges the errors of results in files, and runs nothing.
    ///
    /// # Errors
    /// Runs that cannot be compared.
    pub fn without_exclusions(
        exact: &Exact,
        files: &[String],
        measurement: Measurement,
        provenance: Provenance,
    ) -> anyhow::Result<Self> {
        let results = Results::new(exact.input(), files, &measurement);
        let Measurement { measured, notes, objection, part, largest, sample, .. } = measurement;
        let report = Self::objected(exact.title(), measured, objection.as_ref(), provenance)?;
        let sample = sample.filter(|_| !report.verdict().is_good());
        let question = sample.map_or(Ok(None), |it| it.question(exact))?;
        Ok(Self { notes, part, largest, question, results, ..report })
    }

    /// Names the key of a campaign file in place of the option.
    #[must_use]
    pub fn of_campaign(self) -> Self {
        Self { is_of_campaign: true, ..self }
    }

    /// The position of the deciding quantity, and its verdict.
    pub fn decided(&self) -> (usize, Verdict) {
        worst(&self.judged).unwrap_or((0, Verdict::NotAsymptotic))
    }

    /// The worst verdict.
    pub fn verdict(&self) -> Verdict {
        self.decided().1
    }

    /// Each quantity with its judgement.
    pub fn each(&self) -> impl Iterator<Item = (&Quantity, &QuantityJudgement)> {
        self.measured.quantities.iter().zip(&self.judged)
    }

    /// The sampling of each quantity of results.
    pub fn samplings(&self) -> Option<&Names<String>> {
        self.results.samplings.as_ref()
    }

    /// The number of points of the mesh with the fewest points.
    pub fn points(&self) -> usize {
        self.results.points
    }

    /// The files of results.
    pub fn files(&self) -> &[String] {
        self.results.files.as_deref().unwrap_or_default()
    }

    /// The name of a level.
    fn name(&self, length: f64) -> String {
        match self.refined {
            Refined::Space => format!("h {length:.3e}"),
            Refined::Time => format!("dt {length:.3e}"),
            Refined::Grid => format!("{length:.3e}"),
        }
    }

    /// The levels of a norm, each with the order from the level before; empty for a grid of h and dt.
    pub fn levels(&self, norm: &Norm) -> Vec<(SequenceLevel, Option<f64>)> {
        if self.refined == Refined::Grid {
            return Vec::new();
        }
        let levels = self.measured.sequence(self.refined, norm).levels().to_vec();
        let orders: Vec<_> = levels.windows(2).map(|pair| pair[1].order_from(&pair[0])).collect();
        levels.into_iter().zip(std::iter::once(None).chain(orders)).collect()
    }

    /// The verdict of a quantity in words, with all details.
    fn says(&self, quantity: &Quantity, judged: &QuantityJudgement) -> Vec<String> {
        self.sentences(quantity, judged, true)
    }

    /// The verdict of a quantity in words; if `is_full`, with the source of each interval.
    pub fn sentences(
        &self,
        quantity: &Quantity,
        judged: &QuantityJudgement,
        is_full: bool,
    ) -> Vec<String> {
        let fits = quantity.norms.iter().zip(&judged.fits);
        let fits = fits.filter_map(|(norm, fit)| Some(fit.as_ref()?.sentence(&norm.name.shown())));
        let QuantityJudgement { judgement, .. } = judged;
        let (symbol, name) = (self.refined.symbol(), |length| self.name(length));
        let mut lines = vec![format!("{}: {}", judgement.verdict(), judgement.headline(&name))];
        lines.extend(match is_full {
            true => judgement.explanations(symbol, &name),
            false => judgement.reasons(symbol, &name),
        });
        let deciding = judged.judgement.deciding();
        lines.extend(deciding.is_superconvergent().then(|| {
            format!(
                "superconvergence: these values are more accurate than theory promises everywhere: {}",
                deciding.expected.order
            )
        }));
        lines.extend(self.largest(quantity, judged));
        let is_asked = quantity.name.raw() == DISPLACEMENT && !judgement.verdict().is_good();
        lines.extend(self.question.clone().filter(|_| is_asked));
        lines.extend(fits);
        lines.extend(judged.objection.as_ref().map(|it| it.why.clone()));
        lines.extend(
            self.part.as_ref().map(|part| format!("only a part of the body is judged: {part}")),
        );
        lines
    }

    /// The place of the largest error, and the expected order that accepts it, if linf alone fails.
    fn largest(&self, quantity: &Quantity, judged: &QuantityJudgement) -> Option<String> {
        let order = judged.judgement.only_largest()?;
        let at = self.measured.quantities.iter().position(|it| std::ptr::eq(it, quantity));
        let place = at.and_then(|at| self.largest.get(at)).filter(|it| !it.is_empty());
        let place = place.map(|it| format!("; the largest error of the finest mesh is {it}"));
        let l2 = judged.judgement.norm("l2")?.finding.estimate?.order;
        let option = self.lower_order(quantity, judged).map(|it| match self.is_of_campaign {
            true => format!("; \"{it}\" in `order` expects that"),
            false => format!("; `--expected-order {it}` expects that"),
        });
        Some(format!(
            "linf alone fails, with order {order:.2}, and l2 has order {l2:.2}: the order is lost at few points{}{}",
            place.unwrap_or_default(),
            option.unwrap_or_default()
        ))
    }

    /// The value of `--expected-order` with which a quantity passes, if linf alone fails: the observed order, rounded down.
    fn lower_order(&self, quantity: &Quantity, judged: &QuantityJudgement) -> Option<String> {
        // As it is printed, 1.699 is 1.70.
        let order = (10.0 * judged.judgement.only_largest()? + 0.05).floor() / 10.0;
        let name = quantity.name.raw();
        let symbol = mms_spec::quantity::Quantity::from_name(name).map_or(name, |it| it.symbol());
        let is_one = self.files().is_empty() && self.measured.quantities.len() == 1;
        let column = if is_one { String::new() } else { format!("{symbol}:") };
        (order > 0.0).then(|| format!("{column}linf={order}"))
    }

    /// The values of `--expected-order` with which the results pass; `None` if another norm than linf fails, or a layer at a
    /// face shows.
    pub fn lower_orders(&self) -> Option<Vec<String>> {
        let is_good = |it: &&QuantityJudgement| it.judgement.verdict().is_good();
        if self.judged.iter().all(|it| is_good(&it)) {
            return None;
        }
        let order = |(quantity, judged): (&Quantity, &QuantityJudgement)| match is_good(&judged) {
            true => None,
            false if judged.judgement.layer().is_some() => Some(None),
            false => Some(self.lower_order(quantity, judged)),
        };
        self.each().filter_map(order).collect()
    }

    /// The JSON document.
    pub fn document(&self) -> documents::Judge {
        let (at, verdict) = self.decided();
        let quantities =
            self.each().map(|(quantity, judged)| self.quantity(quantity, judged)).collect();
        let deciding = self.judged.get(at).map(|it| it.judgement.deciding());
        let finding = deciding.map(|it| &it.finding);
        let quantity = self.measured.quantities.get(at);
        let results = self.results.clone();
        documents::Judge {
            source: self.source.clone(),
            refinement: self.refined.name().to_owned(),
            levels: self.rows(),
            quantity: quantity.map(|it| it.name.raw().to_owned()),
            norm: deciding.map(|it| it.norm.to_owned()),
            expected_order: deciding.map(|it| it.expected.order),
            tolerance: deciding.map(|it| it.expected.tolerance),
            observed_order: finding.and_then(observed),
            order_interval: finding.and_then(interval),
            quantities,
            verdict: verdict.to_string(),
            rule: RULE,
            notes: self.notes.clone(),
            field: results.field,
            files: results.files,
            times: results.times,
            samplings: results.samplings,
            units: results.units,
            warnings: results.warnings,
            iterative_errors: results.iterative_errors,
            excluded: self.exclusions.as_ref().map(Exclusions::document),
            next_command: self.next.clone(),
            provenance: self.provenance.clone(),
        }
    }

    /// The levels of the first quantity, as a study writes them; for a grid, its runs.
    fn rows(&self) -> Vec<documents::JudgeLevel> {
        let Some(first) = self.measured.quantities.first() else { return Vec::new() };
        let norm = |name: &str| first.norms.iter().find(|it| it.name == *name);
        if self.refined == Refined::Grid {
            let runs = self.measured.runs.iter().enumerate();
            return runs
                .map(|(at, run)| {
                    let error = |name| norm(name).and_then(|it| it.errors[at]);
                    let errors = NORMS.map(|name| (error(name), None));
                    row(Some(run.cell_size), run.time_step, 1, errors)
                })
                .collect();
        }
        let norms = NORMS.map(|name| norm(name).map(|it| self.levels(it)));
        let all = first.norms.first().map(|it| self.levels(it)).unwrap_or_default();
        let level = |(at, (level, _)): (usize, &(SequenceLevel, Option<f64>))| {
            let errors = norms.each_ref().map(|levels| {
                let found = levels.as_ref().map(|it| &it[at]);
                let error = found.filter(|(it, _)| !it.errors.is_empty()).map(|(it, _)| it.error());
                (error, found.and_then(|it| it.1))
            });
            let [size, step] = self.sizes(level.length);
            row(size, step, level.errors.len(), errors)
        };
        all.iter().enumerate().map(level).collect()
    }

    /// h and dt of a level.
    fn sizes(&self, length: f64) -> [Option<f64>; 2] {
        let runs = &self.measured.runs;
        let of =
            |run: &&crate::measured::RunSize| self.measured.length(self.refined, run) == length;
        let run = runs.iter().find(of);
        [run.map(|it| it.cell_size), run.and_then(|it| it.time_step)]
    }

    fn quantity(
        &self,
        quantity: &Quantity,
        judged: &QuantityJudgement,
    ) -> documents::JudgedQuantity {
        let deciding = judged.judgement.deciding();
        let mut norms = norms_judged(&judged.judgement);
        for own in &mut norms {
            let levels = quantity.norms.iter().find(|norm| own.norm == norm.name.raw());
            own.levels = Some(levels.map(|norm| self.norm(norm)));
        }
        documents::JudgedQuantity {
            name: quantity.name.raw().to_owned(),
            norm: deciding.norm.to_owned(),
            verdict: judged.judgement.verdict().to_string(),
            layer_order: judged.judgement.layer(),
            superconvergent: deciding.is_superconvergent(),
            norms,
            says: self.says(quantity, judged),
        }
    }

    fn norm(&self, norm: &Norm) -> Vec<JudgedLevel> {
        let level = |(level, order): (SequenceLevel, Option<f64>)| JudgedLevel {
            length: level.length,
            error: (!level.errors.is_empty()).then(|| level.error()),
            runs: level.errors,
            order,
        };
        self.levels(norm).into_iter().map(level).collect()
    }
}

/// The keys of the document that belong to results in files.
#[derive(Clone, Default)]
struct Results {
    field: Option<String>,
    files: Option<Vec<String>>,
    times: Option<Vec<f64>>,
    samplings: Option<Names<String>>,
    units: Option<Names<String>>,
    warnings: Option<Vec<String>>,
    iterative_errors: Option<Names<f64>>,
    /// The number of points of the mesh with the fewest points, which the document does not contain.
    points: usize,
}

impl Results {
    fn new(input: &Input, files: &[String], measurement: &Measurement) -> Self {
        let names = measurement.measured.quantities.iter().map(|quantity| quantity.name.raw());
        let samplings = measurement.samplings.iter().map(|it| it.name().to_owned());
        let iterative: Names<f64> =
            measurement.iterative.iter().map(|(name, error)| (name.to_string(), *error)).collect();
        Results {
            field: Some(input.name.raw().to_owned()),
            files: Some(files.to_vec()),
            times: Some(measurement.times.clone()),
            units: units(&input.compiled, names.clone()),
            samplings: Some(names.zip(samplings).collect()),
            warnings: Some(measurement.warnings.clone()),
            iterative_errors: (!iterative.0.is_empty()).then_some(iterative),
            points: measurement.points,
        }
    }
}

/// A level of the document; `errors` are l1, l2 and linf, each with its order.
fn row(
    cell_size: Option<f64>,
    time_step: Option<f64>,
    runs: usize,
    errors: [(Option<f64>, Option<f64>); 3],
) -> documents::JudgeLevel {
    let [(l1, order_l1), (l2, order_l2), (linf, order_linf)] = errors;
    let errors = LevelErrors { l1, l2, linf, order_l1, order_l2, order_linf };
    documents::JudgeLevel { cell_size, time_step, runs, errors }
}

fn observed(finding: &NormFinding) -> Option<f64> {
    finding.estimate.map(|it| it.order)
}

fn interval(finding: &NormFinding) -> Option<[f64; 2]> {
    finding.estimate.and_then(|it| it.interval)
}

/// The finding of each norm.
pub fn norms_judged(judgement: &Judgement) -> Vec<JudgedNorm> {
    judgement.norms.iter().map(judged).collect()
}

/// The finding of a norm.
fn judged(judged: &mms_convergence::NormJudgement) -> JudgedNorm {
    let finding = &judged.finding;
    let basis = |basis| match basis {
        Basis::Scatter => "scatter",
        Basis::Drift => "drift",
        Basis::Digits => "digits",
        Basis::Nothing => "nothing",
    };
    let kind = |kind| match kind {
        TermKind::Plateau => "plateau",
        TermKind::LowerOrder => "lower order",
        TermKind::PreAsymptotic => "pre-asymptotic",
    };
    let highest = judged.expected.highest;
    JudgedNorm {
        norm: judged.norm.to_owned(),
        expected_order: judged.expected.order,
        highest_order: (highest > judged.expected.order).then_some(highest),
        verdict: finding.verdict.to_string(),
        observed_order: observed(finding),
        order_interval: interval(finding),
        interval_from: finding.estimate.map(|it| basis(it.basis).to_owned()),
        decided_by: finding.lengths.clone(),
        lower_order: finding.share.map(|it| LowerOrder {
            order: it.order,
            share: it.share,
            share_interval: it.interval(),
        }),
        second_term: finding.term.map(|it| SecondTerm {
            kind: kind(it.kind).to_owned(),
            order: it.order,
            share: it.share,
            share_interval: it.interval,
            takes_over: it.takes_over,
        }),
        limit: finding.limit.map(|it| Limit {
            error: it.error,
            interval: it.interval,
            order: it.order,
        }),
        levels: None,
    }
}
