//! A study as a table, a JSON document, a CSV file and a picture.

use std::fmt;
use std::path::Path;

use mms_convergence::{CONSTANT_TOLERANCE, ExpectedOrder, Fit, Judgement, RULE, Verdict, is_near};
use mms_documents::Names;
use mms_documents::provenance::Provenance;
use mms_documents::study::{self as documents, LevelErrors, StudyErrors, StudyOfMethod};
use mms_files::words::duration;
use mms_files::write::{pretty, write_files};
use mms_judge::norms_judged;
use mms_judge::results::Exclusions;
use mms_options::method::Arithmetic;
use mms_runtime::study::{Deviations, ObservedOrders, Refinement, Series, StudyPoint};
use mms_runtime::{Division, Errors, Method, Refusal, Run, StudyLevel};
use mms_spec::foreign::Foreign;

use super::page::Section as _;
use super::page::method::whole;
use super::plot::Figure;
use super::run::quantities;
use super::shown::Shown;
use super::table::{PAIR, TextTable};
use super::text::next;
use super::{Phases, method};

/// A finished study.
pub struct Study {
    /// The field's name.
    pub field: Foreign,
    /// The field's title.
    pub title: Foreign,
    /// The units of h, dt and the quantities, if the field states units.
    pub units: Option<Names<String>>,
    /// The method.
    pub method: Method,
    /// The arithmetic of the runs.
    pub arithmetic: Arithmetic,
    /// The refined lengths.
    pub refinement: Refinement,
    /// The levels, from coarse to fine.
    pub levels: Vec<Result<Run, UnstartedLevel>>,
    /// The difference of each level from the next, in a study in time.
    pub differences: Option<Series>,
    /// The expected order and its tolerance.
    pub expected: ExpectedOrder,
    /// The judgement of the errors.
    pub judgement: Judgement,
    /// The outcome: `fail` also if a level was not started, or if the error constant is not the expected one.
    pub verdict: Verdict,
    /// The change that Richardson's extrapolation makes to the order of the finest pair.
    pub uncertainty: Option<f64>,
    /// C of l2 = C h^p, or C dt^p in time, with the expected order.
    pub error_constant: Option<f64>,
    /// The expected error constant, if it is known.
    pub expected_error_constant: Option<f64>,
    /// The fit of space and time in one formula, if it was requested, and found.
    pub fit: Option<Fit>,
    /// Amplitude and phase, if they were requested.
    pub phases: Option<Phases>,
    /// The mistakes that a pass excludes, if they were requested.
    pub exclusions: Option<Exclusions>,
    /// The likely causes of a verdict that is no pass.
    pub causes: Vec<String>,
    /// The words of the command to type next after such a verdict.
    pub next: Option<Vec<String>>,
    /// The provenance.
    pub provenance: Provenance,
}

/// A run, or a level of a study, that was not started.
#[derive(Clone, Debug)]
pub struct UnstartedLevel {
    /// Cells of the body.
    pub cells: Division,
    /// The reason why the level was not started.
    pub reason: Refusal,
}

impl fmt::Display for UnstartedLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not started: {}", self.reason)
    }
}

/// The heads of the CSV file.
const COLUMNS: [&str; 15] = [
    "cells",
    "cell_size",
    "time_step",
    "steps",
    "particles",
    "l1",
    "l2",
    "linf",
    "order_l1",
    "order_l2",
    "order_linf",
    "seconds",
    "failure",
    "round_off",
    "residual_ratio",
];

/// A level as an entry of the document.
fn row(run: &Run, before: Option<&Run>, refinement: Refinement) -> documents::Level {
    let (level, point) = (&run.level, refinement.displacement(run));
    let observed = orders(&point, before.map(|before| refinement.displacement(before)));
    let details = run.details.as_ref();
    documents::Level {
        cells: method::division(&level.cells),
        cell_size: Some(level.cell_size),
        time_step: Some(level.time_step),
        steps: Some(level.steps),
        particles: Some(level.particles),
        errors: norms(point.errors, observed),
        seconds: Some(level.seconds),
        failure: level.errors.as_ref().err().map(ToString::to_string),
        round_off: Some(details.map(|details| details.round_off)),
        residual_ratio: Some(details.and_then(|details| Some(details.residual?.relative))),
    }
}

/// A level that was not started.
fn refused_row(refused: &UnstartedLevel) -> documents::Level {
    documents::Level {
        cells: method::division(&refused.cells),
        cell_size: None,
        time_step: None,
        steps: None,
        particles: None,
        errors: LevelErrors::default(),
        seconds: None,
        failure: Some(refused.to_string()),
        round_off: Some(None),
        residual_ratio: Some(None),
    }
}

/// Whether the error of a level may be round-off alone.
fn is_noise(row: &documents::Level) -> bool {
    row.errors.l2.zip(row.round_off.flatten()).is_some_and(|(error, floor)| error < floor)
}

/// The orders from the point before, if there is one.
fn orders(point: &StudyPoint, before: Option<StudyPoint>) -> ObservedOrders {
    before.map_or_else(ObservedOrders::default, |before| point.orders_from(&before))
}

/// The remark on the verdict of a study in time.
const IN_TIME: &str = "differences between runs show that the runs converge, but not to which solution: for that, study \
                       errors against the exact solution, without `--refine time`";

/// The errors of a level, if it ended, and the orders from the level before.
type ErrorsAndOrders = (Option<Errors>, ObservedOrders);

/// Norms, and the orders from the level before.
pub(super) fn norms(errors: Option<Errors>, observed: ObservedOrders) -> LevelErrors {
    LevelErrors {
        l1: errors.map(|errors| errors.l1),
        l2: errors.map(|errors| errors.l2),
        linf: errors.map(|errors| errors.linf),
        order_l1: observed.l1,
        order_l2: observed.l2,
        order_linf: observed.linf,
    }
}

/// The difference of two levels.
fn difference((point, observed): (StudyPoint, ObservedOrders)) -> documents::LevelDifference {
    documents::LevelDifference { time_step: point.length, errors: norms(point.errors, observed) }
}

fn fit(fit: Fit) -> documents::Fit {
    documents::Fit {
        space_constant: fit.space_constant,
        space_order: fit.space_order,
        time_constant: fit.time_constant,
        time_order: fit.time_order,
        residual: fit.residual,
    }
}

impl Study {
    /// Whether a level was started.
    pub fn is_started(&self) -> bool {
        self.started().next().is_some()
    }

    /// The levels that were started.
    pub(super) fn started(&self) -> impl Iterator<Item = &Run> {
        self.levels.iter().flatten()
    }

    /// Each level, and the one before if both were started.
    fn pairs(&self) -> impl Iterator<Item = (&Result<Run, UnstartedLevel>, Option<&Run>)> {
        let before =
            std::iter::once(None).chain(self.levels.iter().map(|level| level.as_ref().ok()));
        self.levels.iter().zip(before)
    }

    /// The refined length of each level that was started.
    fn lengths(&self) -> Vec<Option<f64>> {
        let length = |run: &Run| self.refinement.length(&run.level);
        self.levels.iter().map(|level| level.as_ref().ok().map(length)).collect()
    }

    fn rows(&self) -> Vec<documents::Level> {
        let row = |(level, before): (&Result<Run, UnstartedLevel>, Option<&Run>)| match level {
            Ok(run) => row(run, before, self.refinement),
            Err(refused) => refused_row(refused),
        };
        self.pairs().map(row).collect()
    }

    /// The symbol, the key, and the errors and orders of each level, for u, v, F and P.
    fn quantities(&self) -> [(&'static str, &'static str, Vec<ErrorsAndOrders>); 4] {
        let names = quantities(&Deviations::default());
        std::array::from_fn(|which| {
            let point = |run: &Run| StudyPoint {
                length: self.refinement.length(&run.level),
                errors: run.details.as_ref().map(|it| quantities(&it.largest)[which].2),
                floor: 0.0,
            };
            let level = |(level, before): (&Result<Run, UnstartedLevel>, Option<&Run>)| match level
            {
                Ok(run) => (point(run).errors, orders(&point(run), before.map(point))),
                Err(_) => (None, ObservedOrders::default()),
            };
            let (symbol, key, _) = names[which];
            (symbol, key, self.pairs().map(level).collect())
        })
    }

    /// The difference of each level from the next, and the orders between them.
    fn steps(&self) -> Option<Vec<(StudyPoint, ObservedOrders)>> {
        let points = self.differences.as_ref()?.points();
        let before = std::iter::once(None).chain(points.iter().copied().map(Some));
        Some(
            points
                .iter()
                .zip(before)
                .map(|(point, before)| (*point, orders(point, before)))
                .collect(),
        )
    }

    /// The judged errors: of the levels that were started, or in time the differences of successive levels.
    pub(super) fn points(&self) -> Vec<StudyPoint> {
        match &self.differences {
            Some(differences) => differences.points().to_vec(),
            None => self.started().map(|run| self.refinement.displacement(run)).collect(),
        }
    }

    /// The judged levels, by their cells or time steps; in time the last one is not among them.
    pub(super) fn names_of_levels(&self) -> Vec<String> {
        let name = |level: &Result<Run, UnstartedLevel>| match (level, self.refinement) {
            (Ok(run), Refinement::Time) => format!("dt {:.2e}", run.level.time_step),
            (
                Ok(Run { level: StudyLevel { cells, .. }, .. }) | Err(UnstartedLevel { cells, .. }),
                _,
            ) => {
                format!("{cells} cells")
            }
        };
        let judged = self.levels.len() - usize::from(self.refinement == Refinement::Time);
        self.levels[..judged].iter().map(name).collect()
    }

    /// l2 of each judged level, or the reason why there is none.
    pub(super) fn errors_of_levels(&self) -> Vec<String> {
        let mut points = self.points().into_iter();
        let judged = self.levels.iter().take(self.names_of_levels().len());
        judged
            .map(|level| match level.as_ref().ok().and_then(|_| points.next()) {
                Some(StudyPoint { errors: Some(errors), .. }) => format!("{:.2e}", errors.l2),
                Some(_) => "stopped".into(),
                None => "not started".into(),
            })
            .collect()
    }

    /// The document without its provenance. It has the list of excluded mistakes if that was requested.
    pub(super) fn content(&self) -> StudyOfMethod {
        let rows = self.rows();
        StudyOfMethod {
            field: self.field.raw().to_owned(),
            method: method::document(&self.method, self.arithmetic),
            refinement: self.refinement.name().to_owned(),
            noise: rows.iter().map(is_noise).collect(),
            levels: rows,
            quantities: self.errors_of_quantities(),
            units: self.units.clone(),
            differences: self.steps().map(|all| all.into_iter().map(difference).collect()),
            expected_order: self.expected.order,
            observed_order: self.judgement.observed_order(),
            order_uncertainty: self.uncertainty,
            order_interval: self.order_interval(),
            norm: Some(self.judgement.deciding().norm.to_owned()),
            norms: norms_judged(&self.judgement),
            rule: RULE,
            error_constant: self.error_constant,
            expected_error_constant: self.expected_error_constant,
            fit: self.fit.map(fit),
            phase: self.phases.as_ref().map(|it| it.document(&self.lengths(), self.refinement)),
            verdict: self.verdict.to_string(),
            excluded: self.exclusions.as_ref().map(Exclusions::document),
            causes: self.causes.iter().cloned().chain(self.growth()).collect(),
            next_command: self.next.clone(),
        }
    }

    /// The errors of u, v, F and P on each level.
    fn errors_of_quantities(&self) -> StudyErrors {
        let [displacement, velocity, deformation_gradient, first_piola_kirchhoff] =
            self.quantities().map(|(_, _, levels)| {
                levels.into_iter().map(|(errors, observed)| norms(errors, observed)).collect()
            });
        StudyErrors { displacement, velocity, deformation_gradient, first_piola_kirchhoff }
    }

    /// Amplitude and phase, if they were requested.
    pub(super) fn phase_text(&self) -> Option<String> {
        let table = self.phase_table()?;
        Some(format!("{table}\n\na phase lag is in radians, and negative where the run is ahead"))
    }

    /// The table of amplitude and phase.
    fn phase_table(&self) -> Option<TextTable> {
        let table = self.phases.as_ref()?.table(&self.lengths(), self.refinement);
        Some(table.of(&self.field.shown()))
    }

    fn levels_table(&self) -> TextTable {
        let heads = ["cells", "particles", "steps", "l1", PAIR, "l2", PAIR, "linf", PAIR, "time"];
        let relaxes = self.method.setup.relax;
        let header = heads.into_iter().chain(relaxes.then_some("residual"));
        let when = if relaxes { "at equilibrium" } else { "the largest over time" };
        let method = whole(&method::document(&self.method, self.arithmetic));
        let caption = format!("{}: errors of u, {when}; {method}", self.field.shown());
        let mut table = TextTable::new(caption, header).right_from(0);
        for row in self.rows() {
            let dead = if row.steps.is_some() { "stopped" } else { "not started" };
            let error = |error: Option<f64>| error.map_or(dead.into(), |e| format!("{e:.2e}"));
            let noise = if is_noise(&row) { "~" } else { "" };
            let order = |order: Option<f64>| order.map_or("-".into(), |o| format!("{noise}{o:.2}"));
            let count = |count: Option<usize>| count.map_or("-".into(), |c| c.to_string());
            let mut cells = vec![
                row.cells.to_string(),
                count(row.particles),
                count(row.steps),
                error(row.errors.l1),
                order(row.errors.order_l1),
                error(row.errors.l2),
                order(row.errors.order_l2),
                error(row.errors.linf),
                order(row.errors.order_linf),
                row.seconds.map_or("-".into(), duration),
            ];
            if relaxes {
                cells.push(
                    row.residual_ratio.flatten().map_or("-".into(), |it| format!("{it:.1e}")),
                );
            }
            table.add_row(cells);
        }
        table
    }

    /// The orders of every quantity between the two finest levels.
    fn quantities_table(&self) -> TextTable {
        let caption = format!("{}: orders on the finest pair", self.field.shown());
        let header = ["finest pair", "l1", "l2", "linf"];
        let mut table = TextTable::new(caption, header).right_from(0);
        // A body in equilibrium is at rest.
        let is_shown = |symbol: &str| symbol != "v" || !self.method.setup.relax;
        for (symbol, _, levels) in self.quantities().into_iter().filter(|it| is_shown(it.0)) {
            let finest =
                levels.last().map_or_else(ObservedOrders::default, |(_, observed)| *observed);
            let cells = [finest.l1, finest.l2, finest.linf];
            let cells = cells.map(|order| order.map_or("-".into(), |o| format!("{o:.2}")));
            table.add_row([&[format!("order of {symbol}")][..], &cells].concat());
        }
        table
    }

    fn differences_table(&self, steps: &[(StudyPoint, ObservedOrders)]) -> TextTable {
        let header = ["time step", "to the next: l1", PAIR, "l2", PAIR, "linf", PAIR];
        let caption = format!("{}: differences to the next level", self.field.shown());
        let mut table = TextTable::new(caption, header).right_from(0);
        for (point, observed) in steps {
            let of = |norm: fn(&Errors) -> f64, order: Option<f64>| {
                let error = point.errors.as_ref().map(norm);
                let noise = if point.is_noise() { "~" } else { "" };
                [
                    error.map_or("-".into(), |error| format!("{error:.2e}")),
                    order.map_or("-".into(), |order| format!("{noise}{order:.2}")),
                ]
            };
            let norms = [
                of(|errors| errors.l1, observed.l1),
                of(|errors| errors.l2, observed.l2),
                of(|errors| errors.linf, observed.linf),
            ];
            table.add_row([&[format!("{:.3e}", point.length)][..], &norms.concat()].concat());
        }
        table
    }

    /// The verdict, with the norm and the levels that decided it.
    pub(super) fn conclusion(&self) -> String {
        let name = |length| self.name_of_level(length);
        let refused = self.levels.len() - self.started().count();
        let refused = if refused > 0 { "; a level was not started" } else { "" };
        format!("{}: {}{refused}", self.verdict, self.judgement.headline(&name))
    }

    /// The name of a level; a length between levels names itself.
    fn name_of_level(&self, length: f64) -> String {
        let is_it = |run: &&Run| self.refinement.length(&run.level) == length;
        match (self.started().find(is_it), self.refinement) {
            (_, Refinement::Time) => format!("dt {length:.2e}"),
            (Some(run), _) => format!("{} cells", run.level.cells),
            (None, _) => format!("h {length:.2e}"),
        }
    }

    /// The interval of the observed order.
    fn order_interval(&self) -> Option<[f64; 2]> {
        self.judgement.norm("l2")?.finding.estimate?.interval
    }

    /// The symbol of the refined length.
    fn symbol(&self) -> &'static str {
        if self.refinement == Refinement::Time { "dt" } else { "h" }
    }

    /// The verdict and its basis; in full also the origin of the interval, and a constant that was not expected.
    fn conclusions(&self, is_full: bool) -> String {
        let mut lines = vec![self.conclusion()];
        let (symbol, name) = (self.symbol(), |length| self.name_of_level(length));
        lines.extend(match is_full {
            true => self.judgement.explanations(symbol, &name),
            false => self.judgement.reasons(symbol, &name),
        });
        lines.extend(self.judgement.only_largest().map(|order| {
            format!(
                "linf alone fails, with order {order:.2}: l2 has its order, so the order is lost at few particles"
            )
        }));
        lines.extend(self.causes.iter().map(|it| format!("likely cause: {it}")));
        lines.extend(self.growth());
        let has_constant = is_full || self.expected_error_constant.is_some();
        lines.extend(has_constant.then(|| self.constant()));
        lines.extend(self.fit.map(|fit| fit.sentence("l2")));
        if self.refinement == Refinement::Time {
            lines.push(IN_TIME.into());
        }
        if self.rows().iter().any(is_noise) {
            lines.push("~ an error that may be round-off alone, and is not judged".into());
        }
        lines.join("\n")
    }

    /// Sentences about errors of F and P that grow between the two finest levels: these quantities do not converge.
    fn growth(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let [_, _, gradient, stress] = self.quantities();
        for (symbol, _, levels) in [gradient, stress] {
            let of = |norm: fn(&Errors) -> f64| -> Vec<f64> {
                levels.iter().filter_map(|(errors, _)| errors.as_ref().map(norm)).collect()
            };
            let norms = [("l2", of(|it| it.l2)), ("linf", of(|it| it.linf))];
            let grows = |errors: &[f64]| matches!(errors, [.., coarse, fine] if fine > coarse);
            let is_noise =
                self.started().last().is_some_and(|run| is_noise(&row(run, None, self.refinement)));
            if let Some((norm, errors)) = norms.iter().find(|(_, it)| grows(it) && !is_noise) {
                let errors: Vec<_> = errors.iter().map(|it| format!("{it:.2e}")).collect();
                lines.push(format!(
                    "the error of {symbol} grows on finer meshes ({norm}: {}): {symbol} does not converge",
                    errors.join(", ")
                ));
            }
        }
        lines
    }

    /// The text.
    pub(super) fn all(&self, is_full: bool) -> String {
        let mut parts = vec![
            format!(
                "{}: {}\n{}",
                self.field.shown(),
                self.title.shown(),
                method::line(&self.method, self.arithmetic)
            ),
            self.levels_table().to_string(),
        ];
        parts.extend(self.steps().map(|steps| self.differences_table(&steps).to_string()));
        parts.push(self.conclusions(is_full));
        if self.differences.is_none() {
            parts.push(self.quantities_table().to_string());
        }
        parts.extend(self.phase_text());
        let mut end = Vec::new();
        end.extend(self.exclusions.as_ref().map(|it| match is_full {
            true => super::excluded::text(it),
            false => super::excluded::counts(it),
        }));
        end.extend(next(self.next.as_ref()));
        parts.extend((!end.is_empty()).then(|| end.join("\n")));
        parts.join("\n\n")
    }

    /// The error constant, and its expected value: a defect may keep the order and change it.
    fn constant(&self) -> String {
        let length = self.symbol();
        let found = match self.error_constant {
            Some(found) => {
                format!("l2 = {found:.3e} {length}^{} on the finest level", self.expected.order)
            }
            None => "no error constant".into(),
        };
        let held = match self.expected_error_constant {
            Some(expected) => {
                let is_met = self.error_constant.is_some_and(|found| is_near(found, expected));
                let not = if is_met { "" } else { "not " };
                format!("{not}the expected {expected:e} within {:.0} %", 100.0 * CONSTANT_TOLERANCE)
            }
            None => "the order alone is judged, since no constant is expected".into(),
        };
        format!("{found}: {held}")
    }

    /// Writes convergence.svg, .csv and .json into a folder, and returns their paths.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        let figure = self.figure().svg();
        let files = [("svg", figure), ("csv", self.csv()?), ("json", pretty(&self.document())?)];
        write_files(folder, "convergence", files)
    }

    /// The figure of the errors of u.
    pub fn figure(&self) -> Figure {
        let title =
            format!("{}: {}", self.field.shown(), method::line(&self.method, self.arithmetic));
        Figure::new(title, self.content().plots())
    }
}

impl Shown for Study {
    type Document = documents::Study;

    fn text(&self) -> String {
        self.all(false)
    }

    fn full_text(&self) -> String {
        self.all(true)
    }

    fn tables(&self) -> Vec<TextTable> {
        let mut tables = vec![self.levels_table()];
        tables.extend(self.steps().map(|steps| self.differences_table(&steps)));
        tables.extend(self.differences.is_none().then(|| self.quantities_table()));
        tables.extend(self.phase_table());
        tables
    }

    fn document(&self) -> documents::Study {
        documents::Study { study: self.content(), provenance: self.provenance.clone() }
    }

    fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(COLUMNS)?;
        for row in self.rows() {
            let LevelErrors { l1, l2, linf, order_l1, order_l2, order_linf } = row.errors;
            let head = (row.cells, row.cell_size, row.time_step, row.steps, row.particles);
            let errors = (l1, l2, linf, order_l1, order_l2, order_linf);
            let tail = (row.seconds, row.failure, row.round_off, row.residual_ratio);
            writer.serialize((head, errors, tail))?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}
