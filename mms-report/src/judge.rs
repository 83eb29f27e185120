//! Judged errors as tables for a terminal, a CSV file and a picture.

use std::path::Path;

use mms_convergence::{RULE, bound};
use mms_documents::judge::Judge;
use mms_files::write::{pretty, write_files};
use mms_judge::Judgements;
use mms_judge::measured::{Norm, Quantity, Refined};
use mms_spec::foreign::shown;

use super::excluded;
use super::page::Section as _;
use super::plot::Figure;
use super::shown::Shown;
use super::table::{PAIR, TextTable};
use super::text::next;

/// The text, the table and the picture of judgements.
pub struct View<'a>(pub &'a Judgements);

/// The norm that decides over several quantities.
pub struct Deciding {
    /// The expected order.
    pub expected: f64,
    /// The observed order with its interval, if there is one.
    pub observed: Option<String>,
    /// The quantity and the norm.
    pub of: String,
}

/// An order with two digits, or the statement that there is none.
fn order(order: Option<f64>) -> String {
    order.map_or("-".into(), |order| format!("{order:.2}"))
}

impl View<'_> {
    /// The text; for several quantities it begins with the verdict.
    fn all(&self, is_full: bool) -> String {
        let next = next(self.0.next.as_ref());
        self.without_next(is_full) + &next.map_or(String::new(), |it| format!("\n{it}"))
    }

    /// The text without the next command.
    pub fn without_next(&self, is_full: bool) -> String {
        let several = self.0.judged.len() > 1;
        let mut head = vec![format!("{}: {} runs", self.0.source, self.0.measured.runs.len())];
        if several {
            let passed = self.0.judged.iter().filter(|it| it.judgement.verdict().is_good());
            let (count, all) = (passed.count(), self.0.judged.len());
            head.push(format!("{}: {count} of {all} quantities pass", self.0.verdict()));
        }
        head.extend(self.0.notes.iter().cloned());
        let mut parts = vec![head.join("\n")];
        for (quantity, judged) in self.0.each() {
            let mut lines = Vec::new();
            lines.extend(several.then(|| quantity.name.shown()));
            lines.push(self.table(quantity).to_string());
            parts.push(lines.join("\n"));
            parts.push(self.0.sentences(quantity, judged, is_full).join("\n"));
        }
        let mut end = vec![format!("by rule {RULE} of docs/guide/rule.md")];
        end.extend(self.0.exclusions.as_ref().map(|it| match is_full {
            true => excluded::text(it),
            false => excluded::counts(it),
        }));
        parts.push(end.join("\n"));
        parts.join("\n\n")
    }

    /// The norm that decides, with its expected and observed order.
    pub fn deciding(&self) -> Option<Deciding> {
        let (at, _) = self.0.decided();
        let (quantity, judged) = self.0.each().nth(at)?;
        let deciding = judged.judgement.deciding();
        let observed = deciding.finding.estimate.map(|it| match it.interval {
            Some(interval) => {
                let [low, high] = interval.map(|it| bound(it, deciding.expected.order));
                format!("{:.2} ({low} to {high})", it.order)
            }
            None => order(Some(it.order)),
        });
        let of = format!("{} {}", quantity.name.shown(), shown(&deciding.norm));
        Some(Deciding { expected: deciding.expected.order, observed, of })
    }

    /// The levels of a quantity, or the runs of a grid of h and dt.
    fn table(&self, quantity: &Quantity) -> TextTable {
        match self.0.refined {
            Refined::Grid => self.grid_table(quantity),
            _ => self.levels_table(quantity),
        }
    }

    fn caption(&self, quantity: &Quantity) -> String {
        let of = match self.0.judged.len() {
            1 => String::new(),
            _ => format!(" of {}", quantity.name.shown()),
        };
        format!("{}: errors{of}", shown(&self.0.source))
    }

    fn levels_table(&self, quantity: &Quantity) -> TextTable {
        let length = if self.0.refined == Refined::Time { "dt" } else { "h" };
        let mut header = vec![length.to_owned(), "runs".into()];
        let norms: Vec<_> = quantity.norms.iter().map(|norm| self.0.levels(norm)).collect();
        header.extend(quantity.norms.iter().flat_map(|it| [it.name.shown(), PAIR.into()]));
        let mut table = TextTable::new(self.caption(quantity), header).right_from(0);
        for at in 0..norms.first().map_or(0, Vec::len) {
            let (level, _) = &norms[0][at];
            let mut row = vec![format!("{:.3e}", level.length), level.errors.len().to_string()];
            for (level, observed) in norms.iter().map(|levels| &levels[at]) {
                let is_there = !level.errors.is_empty();
                let error = is_there.then(|| format!("{:.2e}", level.error()));
                row.extend([error.unwrap_or("stopped".into()), order(*observed)]);
            }
            table.add_row(row);
        }
        table
    }

    fn grid_table(&self, quantity: &Quantity) -> TextTable {
        let mut header = vec!["h".to_owned(), "dt".into()];
        header.extend(quantity.norms.iter().map(|it| it.name.shown()));
        let mut table = TextTable::new(self.caption(quantity), header).right_from(0);
        for (at, run) in self.0.measured.runs.iter().enumerate() {
            let number = |it: Option<f64>| it.map_or("-".into(), |it| format!("{it:.3e}"));
            let mut row = vec![number(Some(run.cell_size)), number(run.time_step)];
            row.extend(quantity.norms.iter().map(|norm| number(norm.errors[at])));
            table.add_row(row);
        }
        table
    }

    /// Writes convergence.svg and .csv into a folder, and returns their paths.
    pub fn write_parts(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        write_files(folder, "convergence", [("svg", self.figure().svg()), ("csv", self.csv()?)])
    }

    /// Writes convergence.svg, .csv and .json into a folder, and returns their paths.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        let files = [
            ("svg", self.figure().svg()),
            ("csv", self.csv()?),
            ("json", pretty(&self.0.document())?),
        ];
        write_files(folder, "convergence", files)
    }

    /// The figure of the judgement.
    pub fn figure(&self) -> Figure {
        Figure::new(self.0.source.clone(), self.0.document().plots())
    }
}

impl Shown for View<'_> {
    type Document = Judge;

    fn text(&self) -> String {
        self.all(false)
    }

    fn full_text(&self) -> String {
        self.all(true)
    }

    fn tables(&self) -> Vec<TextTable> {
        self.0.each().map(|(quantity, _)| self.table(quantity)).collect()
    }

    fn document(&self) -> Judge {
        self.0.document()
    }

    fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let columns = || {
            self.0
                .measured
                .quantities
                .iter()
                .flat_map(|quantity| quantity.norms.iter().map(move |norm| (quantity, norm)))
        };
        let several = self.0.measured.quantities.len() > 1;
        let column =
            |(quantity, norm): (&Quantity, &Norm)| match several && quantity.name != norm.name {
                true => format!("{}_{}", quantity.name.raw(), norm.name.raw()),
                false => norm.name.raw().to_owned(),
            };
        let has_steps = self.0.measured.runs.iter().any(|run| run.time_step.is_some());
        let lengths = if has_steps { &["h", "dt"][..] } else { &["h"] };
        writer
            .write_record(lengths.iter().map(|it| (*it).to_owned()).chain(columns().map(column)))?;
        for (at, run) in self.0.measured.runs.iter().enumerate() {
            let number = |it: Option<f64>| it.map_or(String::new(), |it| format!("{it:e}"));
            let mut row = vec![number(Some(run.cell_size))];
            row.extend(has_steps.then(|| number(run.time_step)));
            row.extend(columns().map(|(_, norm)| number(norm.errors[at])));
            writer.write_record(row)?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}
