//! `mms explain`: the words of the output.

use anyhow::bail;
use clap::Args;
use mms_documents::explain::{Explain as Document, Term};
use mms_report::Shown;
use mms_report::table::TextTable;
use mms_spec::foreign::shown;
use mms_spec::suggest::advice;

use super::CommandOutcome;
use super::format::Printing;

/// The page, which is also read as such.
const PAGE: &str = include_str!("../../docs/glossary.md");

/// Explain a word of the output or of the guide; without a word, list all words.
#[derive(Args)]
pub struct Explain {
    /// The words to explain, in capital or lower-case letters.
    #[arg(value_name = "TERM")]
    terms: Vec<String>,
    #[command(flatten)]
    printing: Printing,
}

/// The entries of the page, in its order.
fn entries() -> Vec<Term> {
    let items = PAGE.split("\n- **").skip(1);
    let entry = |item: &str| {
        let (term, text) = item.split_once("**: ")?;
        Some(Term { term: term.to_owned(), text: plain_text(text) })
    };
    items.filter_map(entry).collect()
}

/// The text of an entry on one line, without the marks of Markdown; a link is followed by its file.
fn plain_text(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "");
    let mut parts = line.split('[');
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once("](").and_then(|(name, rest)| Some((name, rest.split_once(')')?))) {
            Some((name, (file, rest))) => plain += &format!("{name} (docs/{file}){rest}"),
            None => plain += part,
        }
    }
    plain
}

impl Explain {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let all = entries();
        // Several words are one term, if there is such a term.
        let whole = self.terms.join(" ");
        let asked = match find(&all, &whole) {
            Some(_) => vec![whole],
            None => self.terms,
        };
        let mut terms = Vec::new();
        for term in &asked {
            let Some(found) = find(&all, term) else {
                let names: Vec<String> = all.iter().map(|it| it.term.to_lowercase()).collect();
                let names = names.iter().map(String::as_str);
                let help =
                    advice(&term.to_lowercase(), names, |_| "`mms explain` lists the words".into());
                bail!("`{}`: no such word; {help}", shown(term));
            };
            terms.push(found.clone());
        }
        let is_list = asked.is_empty();
        let terms = if is_list { all } else { terms };
        self.printing.print(&Explained { terms, is_list })?;
        Ok(CommandOutcome::AsExpected)
    }
}

fn find<'a>(all: &'a [Term], word: &str) -> Option<&'a Term> {
    let plain = |text: &str| text.to_lowercase().replace(['_', '-'], " ");
    all.iter().find(|it| plain(&it.term) == plain(word))
}

/// Some entries, or the list of all.
struct Explained {
    terms: Vec<Term>,
    is_list: bool,
}

impl Shown for Explained {
    type Document = Document;

    fn text(&self) -> String {
        let names = || self.terms.iter().map(|it| it.term.as_str());
        match self.is_list {
            true => names().collect::<Vec<_>>().join(", "),
            false => {
                let entry = |it: &Term| format!("{}: {}", it.term, it.text);
                self.terms.iter().map(entry).collect::<Vec<_>>().join("\n\n")
            }
        }
    }

    fn tables(&self) -> Vec<TextTable> {
        let mut table = TextTable::new("words", ["word", "meaning"]);
        for it in &self.terms {
            table.add_row([&it.term, &it.text]);
        }
        vec![table]
    }

    fn document(&self) -> Document {
        Document { terms: self.terms.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_have_names_in_order_and_sentences() {
        let all = entries();
        assert!(all.len() >= 50);
        for pair in all.windows(2) {
            let [before, after] = [&pair[0], &pair[1]].map(|it| it.term.to_lowercase());
            assert!(before < after, "{before} and {after}");
        }
        for it in &all {
            assert!(it.text.ends_with('.'), "{}", it.term);
            assert!(!it.text.contains(['\n', '*', '[']), "{}: {}", it.term, it.text);
            assert!(it.text.split(". ").all(|it| it.split(' ').count() <= 30), "{}", it.text);
        }
    }
}
