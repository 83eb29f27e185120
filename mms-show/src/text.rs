//! Unicode text for terminals.

mod notation;

use super::document::Document;
use super::page::{Block, blocks, left};
use super::relation::Setting;

pub use notation::Text;
pub(crate) use notation::{scientific, word};

/// The whole derivation: lines of about a hundred characters at most, unless the field file has
/// names or numbers of that length.
pub fn page(document: &Document) -> String {
    let mut lines = Vec::new();
    for block in blocks(document) {
        match block {
            Block::Title(title) => lines.push(title),
            Block::Note(note) => lines.extend(wrapped(&note)),
            Block::Heading { name, relation, note, operations } => {
                lines.push(String::new());
                let relation = relation.map(|parts| format!("  {}", Text.relation(&parts)));
                let note = note.or(operations).map(|note| format!("  ({note})"));
                let [relation, note] = [relation, note].map(Option::unwrap_or_default);
                lines.push(format!("{name}{relation}{note}"));
            }
            Block::Where => lines.push("  where".into()),
            Block::Lines { lines: shown, is_where } => {
                let indent = if is_where { "    " } else { "  " };
                lines.extend(shown.iter().map(|line| {
                    let value = document.formula(line.value, &Text);
                    format!("{indent}{} = {value}", left(line, &Text, " = "))
                }));
            }
        }
    }
    lines.join("\n")
}

/// A sentence in lines of at most [`WIDTH`] characters, as far as its words allow; later lines are indented further than the
/// first.
fn wrapped(note: &str) -> Vec<String> {
    let indent = note.len() - note.trim_start().len() + "  ".len();
    let mut lines = vec![" ".repeat(indent)];
    for word in note.split_whitespace() {
        let line = lines.last_mut().expect("it starts with one");
        let is_first = line.ends_with(' ');
        if !is_first && line.chars().count() + word.chars().count() >= WIDTH {
            lines.push(format!("{}{word}", " ".repeat(indent + 4)));
        } else {
            line.push_str(if is_first { "" } else { " " });
            line.push_str(word);
        }
    }
    lines
}

/// The length of a line of prose.
const WIDTH: usize = 96;
