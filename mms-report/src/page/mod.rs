//! All results of a folder on one page of HTML: complete in itself, readable without a script, and well-formed
//! XML.
//!
//! `mms report` reads documents, and runs nothing. Every number of a document on the page has all its digits behind the
//! displayed ones, `<data value="...">`, and tests compare every cell of every table with the document. Pictures are drawn from
//! the documents anew, in colours from the style sheet, so that they are right on dark screens, light ones and paper; no
//! information is in colour alone. Formulas and motions are shown for fields whose text still has the recorded hash.
//!
//! A kind of result is one file that implements [`Section`], and one line in `KINDS`.

pub mod accuracy;
mod campaign;
pub mod comparison;
mod defects;
mod diagnosis;
mod excluded;
mod extremes;
mod field;
pub mod figure;
mod folder;
mod frame;
pub mod gallery;
pub mod judge;
mod mark;
pub(crate) mod method;
mod motion;
mod phase;
mod picture;
mod run;
mod states;
pub mod study;
pub mod tradeoff;
mod verify;

use std::path::PathBuf;

use field::FieldOnPage;
use maud::{Markup, html};
use mms_documents::provenance::{Provenance, VERSION};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::plot::Plot;
use crate::tally;

/// A result, ready to be shown.
pub trait Section {
    /// The title of the result.
    fn title(&self) -> String;

    /// The verdicts on the result.
    fn verdicts(&self) -> Verdicts;

    /// The pictures of a figure in print; none, if the result has no curves.
    fn plots(&self) -> Vec<Plot> {
        Vec::new()
    }

    /// The content below the heading, which is an `h3`. Names of places in it begin with `id`.
    fn body(&self, id: &str) -> Markup;
}

/// The number of verdicts of a result, and of the expected ones among them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verdicts {
    /// The number of expected verdicts.
    pub expected: usize,
    /// The number of all verdicts.
    pub all: usize,
    /// The verdicts in a word or two.
    pub word: String,
}

impl Verdicts {
    /// One verdict.
    fn one(word: &str, is_expected: bool) -> Self {
        Self { expected: is_expected.into(), all: 1, word: word.into() }
    }

    /// Several verdicts. No verdict at all is not good: something was to be judged.
    pub fn several(expected: usize, all: usize, word: &str) -> Self {
        match all {
            0 => Self::one("nothing was judged", false),
            _ => Self { expected, all, word: format!("{expected} of {all} {word}") },
        }
    }

    /// Whether all verdicts are expected.
    pub fn are_expected(&self) -> bool {
        self.expected == self.all
    }
}

/// The way to read a kind of document.
struct DocumentKind {
    /// The `kind` of its provenance.
    name: &'static str,
    /// The heading above all documents of the kind.
    heading: &'static str,
    read: fn(&Value) -> serde_json::Result<Box<dyn Section>>,
    /// Whether its documents may have [`plots`](Section::plots).
    has_curves: bool,
}

impl DocumentKind {
    const fn of<T: Section + DeserializeOwned + 'static>(
        name: &'static str,
        heading: &'static str,
    ) -> Self {
        let read = |document: &Value| -> serde_json::Result<Box<dyn Section>> {
            Ok(Box::new(T::deserialize(document)?))
        };
        Self { name, heading, read, has_curves: false }
    }

    const fn with_curves(self) -> Self {
        Self { has_curves: true, ..self }
    }
}

/// The kinds of documents, in their order on a page.
const KINDS: &[DocumentKind] = &[
    DocumentKind {
        name: "study",
        heading: "Convergence studies",
        read: study::read,
        has_curves: true,
    },
    DocumentKind::of::<mms_documents::judge::Judge>("judge", "Judged results").with_curves(),
    DocumentKind::of::<mms_documents::diagnose::Diagnose>("diagnose", "Diagnoses"),
    DocumentKind::of::<mms_documents::campaign::Campaign>("campaign", "Campaigns").with_curves(),
    DocumentKind::of::<mms_documents::verify::Verify>("verify", "Verification matrix"),
    DocumentKind::of::<mms_documents::tradeoff::Tradeoff>("tradeoff", "Error against cost")
        .with_curves(),
    DocumentKind::of::<mms_documents::extremes::Extremes>("extremes", "At the limits")
        .with_curves(),
    DocumentKind::of::<mms_documents::verify::VerifyDefects>("defects", "Deliberate mistakes"),
    DocumentKind::of::<mms_documents::accuracy::Accuracy>("accuracy", "Accuracy of formulas")
        .with_curves(),
    DocumentKind::of::<mms_documents::run::Run>("run", "Single runs"),
];

/// A result on the page.
struct Entry {
    /// The name of its place on the page.
    id: String,
    /// The heading above all results of its kind.
    heading: &'static str,
    /// The path of its file, below the folder.
    file: String,
    /// The provenance, if the document has one.
    provenance: Option<Provenance>,
    section: Box<dyn Section>,
}

/// A page.
pub struct Page {
    title: String,
    /// The results in the order of [`KINDS`], then of their files.
    entries: Vec<Entry>,
    /// The fields of the entries.
    fields: Vec<FieldOnPage>,
    /// Files that are not shown, and why.
    set_aside: Vec<String>,
    /// The files of the folder from which the page is made.
    read: Vec<PathBuf>,
}

impl Page {
    fn new(title: &str, mut entries: Vec<Entry>, set_aside: Vec<String>) -> Self {
        let place = |entry: &Entry| KINDS.iter().position(|kind| kind.heading == entry.heading);
        entries.sort_by_key(|entry| place(entry).unwrap_or(KINDS.len()));
        for (number, entry) in entries.iter_mut().enumerate() {
            entry.id = format!("result-{}", number + 1);
        }
        let fields = field::fields(entries.iter().filter_map(|entry| entry.provenance.as_ref()));
        Self { title: title.to_owned(), entries, fields, set_aside, read: Vec::new() }
    }

    /// The files that are not shown, each with the reason.
    pub fn set_aside(&self) -> &[String] {
        &self.set_aside
    }

    /// The files from which the page is made: results, and the fields that they belong to.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.read.iter().chain(self.fields.iter().flat_map(FieldOnPage::files))
    }

    /// The verdicts on all results together.
    pub fn verdicts(&self) -> Verdicts {
        let each = || self.entries.iter().map(|entry| entry.section.verdicts());
        let expected = each().map(|verdicts| verdicts.expected).sum();
        let all = each().map(|verdicts| verdicts.all).sum();
        let word = match all {
            0 => "nothing here has a verdict".into(),
            _ => tally(all - expected, all, "as expected"),
        };
        Verdicts { expected, all, word }
    }

    /// A small picture of the deformed body of the first field.
    pub fn thumbnail(&self) -> Option<Markup> {
        self.fields.first()?.thumbnail()
    }

    /// The page.
    pub fn html(&self) -> String {
        frame::page(self)
    }
}

/// The result of a document.
fn entry(file: &str, document: &Value) -> Result<Entry, String> {
    let provenance = document.get("provenance").ok_or("it has no provenance")?;
    let provenance = Provenance::deserialize(provenance)
        .map_err(|error| format!("its provenance cannot be read: {error}"))?;
    if provenance.document_version > VERSION {
        return Err(format!(
            "its form is of version {}, and this `mms` reads versions up to {VERSION}: use the `mms` that wrote it, {}",
            provenance.document_version, provenance.version
        ));
    }
    let known = KINDS.iter().find(|kind| kind.name == provenance.kind);
    let kind = known.ok_or_else(|| format!("unknown kind of document `{}`", provenance.kind))?;
    let section = match method::lack(document) {
        Some(lack) => Err(lack),
        None => (kind.read)(document).map_err(|error| error.to_string()),
    }
    .map_err(|error| format!("not what `mms {}` writes: {error}", kind.name))?;
    let [id, file] = [String::new(), file.to_owned()];
    Ok(Entry { id, heading: kind.heading, file, provenance: Some(provenance), section })
}

/// The provenance of a result.
fn origin(entry: &Entry) -> Markup {
    let Some(Provenance { version, command, input, machine, .. }) = &entry.provenance else {
        return html! { dl.origin { dt { "file" } dd { code { (entry.file) } } } };
    };
    html! {
        dl.origin {
            dt { "command" } dd { code { (command) } }
            dt { "file" } dd { code { (entry.file) } }
            dt { "version" } dd { "mms " (version) ", input " code { (input.hash) } }
            @if let Some(machine) = machine {
                dt { "machine" } dd { (machine.processor) ", " (machine.cores) " cores" }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_nothing_was_judged_nothing_is_as_expected() {
        let none = Verdicts::several(0, 0, "pass");
        assert_eq!((none.are_expected(), none.word.as_str()), (false, "nothing was judged"));
        assert!(Verdicts::several(2, 2, "pass").are_expected());
        assert!(!Verdicts::several(1, 2, "pass").are_expected());
    }
}
