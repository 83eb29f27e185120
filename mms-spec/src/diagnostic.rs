//! Messages to a user, and their layout.
//!
//! A phase collects every mistake that it finds as a [`Diagnostic`] (message, span, label, help) and continues if that makes
//! sense. [`render`] prints them all at the end, in the order of their places, each with its own `path:line:column` and a caret
//! under the exact text. `mms check` and, as one compile error, `field!` print the same text.
//!
//! A mistake hides no other: an unreadable formula is replaced by an empty one that is marked as reported, and a name whose
//! definition failed is not reported where it is used.

use std::collections::BTreeSet;
use std::ops::Range;
use std::panic::Location;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use crate::foreign::{lines, one_line, shown};
use crate::source::{Sources, Span};

/// The largest number of printed diagnostics: further ones are only counted.
pub const MAX_RENDERED: usize = 100;

/// The longest name that a message quotes in full.
const MAX_QUOTED: usize = 40;

/// One message about one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The mistake, in one sentence without a full stop.
    pub message: String,
    /// The exact place.
    pub span: Span,
    /// A few words beside the caret, often the expected text.
    pub label: String,
    /// Suggestions for the user.
    pub help: Vec<String>,
    /// Whether the diagnostic is about a possible mistake only.
    pub is_warning: bool,
    /// The place in the compiler's source that made it, so that a test can find messages that no file provokes.
    pub site: &'static Location<'static>,
}

impl Diagnostic {
    /// An error at a place.
    #[track_caller]
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        let (message, label, help) = (message.into(), String::new(), Vec::new());
        Diagnostic { message, span, label, help, is_warning: false, site: Location::caller() }
    }

    /// A warning about a possible mistake.
    #[track_caller]
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Diagnostic { is_warning: true, ..Self::error(span, message) }
    }

    /// Sets the words beside the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a suggestion.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }
}

/// A piece of a user's text as messages quote it: in backticks, and cut if it is long.
pub fn quoted(text: &str) -> String {
    match text.char_indices().nth(MAX_QUOTED) {
        Some((end, _)) => format!("`{}...`", shown(&text[..end])),
        None => format!("`{}`", shown(text)),
    }
}

/// The diagnostics as plain text, in the order of their places and each once.
pub fn render(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    render_with(&Renderer::plain(), sources, diagnostics)
}

/// The diagnostics as [`render`] prints them, coloured for a terminal.
pub fn render_styled(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    render_with(&Renderer::styled(), sources, diagnostics)
}

fn render_with(renderer: &Renderer, sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    let ordered = in_order(diagnostics);
    let mut rendered: Vec<String> = ordered
        .iter()
        .take(MAX_RENDERED)
        .map(|diagnostic| render_one(renderer, sources, diagnostic))
        .collect();
    if ordered.len() > MAX_RENDERED {
        rendered.push(format!("... and {} more", ordered.len() - MAX_RENDERED));
    }
    let mut text = rendered.join("\n\n");
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

/// The diagnostics by place, then in the order of detection; a message of two phases is shown once.
fn in_order(diagnostics: &[Diagnostic]) -> Vec<&Diagnostic> {
    let mut ordered: Vec<&Diagnostic> = diagnostics.iter().collect();
    ordered.sort_by_key(|diagnostic| (diagnostic.span.source, diagnostic.span.start));
    let mut seen = BTreeSet::new();
    ordered.retain(|diagnostic| seen.insert((diagnostic.span, diagnostic.message.as_str())));
    ordered
}

fn render_one(renderer: &Renderer, sources: &Sources, diagnostic: &Diagnostic) -> String {
    let (line_number, _) = sources.location(diagnostic.span);
    let (line, caret) = shown_line(sources, diagnostic.span);
    let mut annotation = AnnotationKind::Primary.span(caret);
    if !diagnostic.label.is_empty() {
        annotation = annotation.label(one_line(&diagnostic.label));
    }
    let snippet = Snippet::source(line)
        .line_start(line_number)
        .path(sources.get(diagnostic.span.source).path.shown())
        .annotation(annotation);
    let help = diagnostic.help.iter().map(|help| Level::HELP.message(one_line(help)));
    let level = if diagnostic.is_warning { Level::WARNING } else { Level::ERROR };
    let title = level.primary_title(one_line(&diagnostic.message));
    renderer.render(&[title.element(snippet).elements(help)])
}

/// The line on which a span starts, and the part of the span on it. Only this line is shown, so that a message about a long
/// array or a long file stays short.
fn shown_line(sources: &Sources, span: Span) -> (String, Range<usize>) {
    let text = sources.get(span.source).text.as_str();
    let span = sources.span(span.source, span.start, span.end);
    let start = text[..span.start].rfind('\n').map_or(0, |newline| newline + 1);
    let length = text[start..].find('\n').unwrap_or(text.len() - start);
    let line = text[start..start + length].trim_end_matches('\r');
    let first = (span.start - start).min(line.len());
    let last = (span.end - start).clamp(first, line.len());
    let [before, inside, after] = [&line[..first], &line[first..last], &line[last..]].map(lines);
    let caret = before.len()..before.len() + inside.len();
    (before + &inside + &after, caret)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> (Sources, impl Fn(usize, usize) -> Span + use<>) {
        let mut sources = Sources::default();
        let id = sources.add("fields/x.toml", text);
        let span = move |start, end| Span { source: id, start, end };
        (sources, span)
    }

    #[test]
    fn shows_place_caret_and_help() {
        let (sources, span) = source("[field]\ntitel = 1\n");
        let diagnostic = Diagnostic::error(span(8, 13), "unknown key `titel`")
            .label("not a key of [field]")
            .help("did you mean `title`?");
        let expected = "\
error: unknown key `titel`
 --> fields/x.toml:2:1
  |
2 | titel = 1
  | ^^^^^ not a key of [field]
  |
  = help: did you mean `title`?
";
        assert_eq!(render(&sources, &[diagnostic]), expected);
    }

    #[test]
    fn sorts_and_shows_each_message_once() {
        let (sources, span) = source("ab");
        let (a, b) = (Diagnostic::error(span(0, 1), "a"), Diagnostic::error(span(1, 2), "b"));
        let text = render(&sources, &[b.clone(), a.clone(), b]);
        assert_eq!(text.matches("error:").count(), 2);
        assert!(text.find("error: a") < text.find("error: b"), "{text}");
    }

    #[test]
    fn any_place_can_be_shown() {
        for text in ["", "\n", "\r\n", "\u{3bb}", "a\nb"] {
            let (sources, span) = source(text);
            for start in 0..5 {
                for end in start..5 {
                    let text = render(&sources, &[Diagnostic::error(span(start, end), "m")]);
                    assert!(text.contains("fields/x.toml:"), "{text}");
                }
            }
        }
    }

    #[test]
    fn counts_what_it_does_not_show() {
        let (sources, span) = source(&"x".repeat(MAX_RENDERED + 7));
        let all: Vec<_> =
            (0..MAX_RENDERED + 7).map(|at| Diagnostic::error(span(at, at + 1), "m")).collect();
        assert!(render(&sources, &all).ends_with("... and 7 more\n"));
    }

    #[test]
    fn terminal_controls_in_a_name_do_not_reach_the_terminal() {
        let (sources, span) = source("\"\u{1b}[31m\"");
        let diagnostic = Diagnostic::error(span(0, 3), "bad `\u{1b}`").help("not \u{1b}");
        assert!(!render(&sources, &[diagnostic]).contains('\u{1b}'));
    }

    /// The column refers to the line as it is shown.
    #[test]
    fn no_text_makes_lines_of_its_own_and_the_caret_stays_in_place() {
        let mut sources = Sources::default();
        let id = sources.add("a\nb.toml", "\u{9b}x = \u{202e}y\u{1b} z\n");
        let span = Span { source: id, start: 7, end: 12 };
        let diagnostic = Diagnostic::error(span, "m\n  proof").label("l\nl").help("h\r\u{1b}");
        let expected = "\
error: m\\n  proof
 --> a\\nb.toml:1:11
  |
1 | \\u{9b}x = \\u{202e}y\\u{1b} z
  |           ^^^^^^^^^^^^^^^^ l\\nl
  |
  = help: h\\r\\u{1b}
";
        assert_eq!(render(&sources, &[diagnostic]), expected);
    }
}
