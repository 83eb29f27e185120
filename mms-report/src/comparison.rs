//! Several methods on one field, beside each other.

use std::path::Path;

use anyhow::Context as _;
use mms_documents::provenance::Provenance;
use mms_documents::study::{self as documents, Studies, StudyOfOne};
use mms_files::write::{pretty, write_files};
use serde::Serialize;

use super::Study;
use super::page::Section as _;
use super::page::method::written;
use super::plot::Figure;
use crate::shown::Shown;
use crate::table::{FITTED, TextTable};
use crate::text::next;

/// The document of one study, or of several methods.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Document {
    One(Box<documents::Study>),
    Several(Box<Studies>),
}

/// Studies of one field with methods that differ.
pub struct Comparison {
    /// The studies, one at least.
    pub studies: Vec<Study>,
    /// The provenance.
    pub provenance: Provenance,
}

impl Comparison {
    /// The number of studies that pass.
    fn passed(&self) -> usize {
        let passes = |study: &&Study| study.verdict.is_good();
        self.studies.iter().filter(passes).count()
    }

    /// Whether there are studies, and all pass.
    pub fn is_passed(&self) -> bool {
        !self.studies.is_empty() && self.passed() == self.studies.len()
    }

    /// The names that distinguish the methods.
    pub fn names(&self) -> Vec<String> {
        let words: Vec<[String; 6]> = self.studies.iter().map(words).collect();
        let differs = |at: usize| words.iter().any(|word| word[at] != words[0][at]);
        let name = |word: &[String; 6]| {
            let told = (0..word.len()).filter(|&at| differs(at));
            told.map(|at| word[at].as_str()).collect::<Vec<_>>().join(" ")
        };
        words.iter().map(name).collect()
    }

    /// Each study with its name.
    fn named(&self) -> impl Iterator<Item = (String, &Study)> {
        self.names().into_iter().zip(&self.studies)
    }

    /// The document of several methods.
    fn several(&self) -> Studies {
        let studies = self.named().map(|(name, study)| StudyOfOne { name, study: study.content() });
        let first = &self.studies[0];
        Studies {
            field: first.field.raw().to_owned(),
            refinement: first.refinement.name().to_owned(),
            studies: studies.collect(),
            passed: self.passed(),
            provenance: self.provenance.clone(),
        }
    }

    /// l2 of each method on each level, or in time its difference from the next level.
    fn errors(&self, names: Vec<String>) -> TextTable {
        let first = &self.studies[0];
        let ends = [FITTED, "constant", "verdict"].map(str::to_owned);
        let header = ["l2".to_owned()].into_iter().chain(first.names_of_levels()).chain(ends);
        let formulation = first.method.formulation;
        let is_shared = self.studies.iter().all(|it| it.method.formulation == formulation);
        let shared = if is_shared { written(formulation.name()) } else { String::new() };
        let count = format!("{}: l2 of {} methods", first.field.shown(), self.studies.len());
        let caption = [count, shared].into_iter().filter(|it| !it.is_empty());
        let caption = caption.collect::<Vec<_>>().join(", ");
        let mut table = TextTable::new(caption, header).right_from(1);
        for (name, study) in names.into_iter().zip(&self.studies) {
            let mut cells = vec![name];
            cells.extend(study.errors_of_levels());
            cells.extend([
                study.judgement.observed_order().map_or("-".into(), |order| format!("{order:.2}")),
                study.error_constant.map_or("-".into(), |constant| format!("{constant:.2e}")),
                study.verdict.to_string(),
            ]);
            table.add_row(cells);
        }
        table
    }

    /// Writes convergence.svg, .csv and .json into a folder, and returns their paths.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        if let [alone] = self.studies.as_slice() {
            return alone.write(folder);
        }
        let document = pretty(&self.several())?;
        let files = [("svg", self.figure().svg()), ("csv", self.csv()?), ("json", document)];
        write_files(folder, "convergence", files)
    }

    /// The figure of the errors of u.
    pub fn figure(&self) -> Figure {
        if let [alone] = self.studies.as_slice() {
            return alone.figure();
        }
        let (field, count) = (self.studies[0].field.shown(), self.studies.len());
        let title = format!("{field}: l2 of {count} methods");
        Figure::new(title, self.several().plots())
    }
}

impl Shown for Comparison {
    type Document = Document;

    fn text(&self) -> String {
        if let [alone] = self.studies.as_slice() {
            return alone.text();
        }
        let first = &self.studies[0];
        let mut parts = vec![
            format!("{}: {}", first.field.shown(), first.title.shown()),
            self.errors(self.names()).to_string(),
        ];
        let verdict = |(name, study): (String, &Study)| format!("{name}: {}", study.conclusion());
        let conclusions: Vec<_> = self.named().map(verdict).collect();
        parts.push(conclusions.join("\n"));
        for (name, study) in self.named() {
            parts.extend(study.phase_text().map(|table| format!("{name}\n{table}")));
        }
        parts.push(format!("{} of {} methods pass", self.passed(), self.studies.len()));
        parts.extend(self.studies.iter().find_map(|it| next(it.next.as_ref())));
        parts.join("\n\n")
    }

    fn full_text(&self) -> String {
        match self.studies.as_slice() {
            [alone] => alone.full_text(),
            _ => self.text(),
        }
    }

    fn tables(&self) -> Vec<TextTable> {
        if let [alone] = self.studies.as_slice() {
            return alone.tables();
        }
        let names = self.names().iter().map(|it| written(it)).collect();
        vec![self.errors(names).first_apart()]
    }

    fn document(&self) -> Document {
        if let [alone] = self.studies.as_slice() {
            return Document::One(Box::new(alone.document()));
        }
        Document::Several(Box::new(self.several()))
    }

    fn csv(&self) -> anyhow::Result<String> {
        if let [alone] = self.studies.as_slice() {
            return alone.csv();
        }
        let mut writer = csv::Writer::from_writer(Vec::new());
        for (at, (name, study)) in self.named().enumerate() {
            let own = study.csv()?;
            let mut reader =
                csv::ReaderBuilder::new().has_headers(false).from_reader(own.as_bytes());
            for (line, row) in reader.records().enumerate() {
                let row = row.context("cannot read back a row of a study")?;
                let first = if line == 0 { "method" } else { name.as_str() };
                if at == 0 || line > 0 {
                    writer.write_record(std::iter::once(first).chain(row.iter()))?;
                }
            }
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}

/// The words in which the methods of a study may differ.
fn words(study: &Study) -> [String; 6] {
    let method = &study.method;
    [
        method.formulation.to_string(),
        method.shape.to_string(),
        method.integrator.to_string(),
        method.setup.transfer.to_string(),
        study.arithmetic.precision.name().to_owned(),
        study.arithmetic.form.name().to_owned(),
    ]
}
