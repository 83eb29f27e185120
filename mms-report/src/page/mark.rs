//! The common parts of all sections: numbers, verdicts and tables.

use std::borrow::Cow;

use maud::{Markup, html};
use mms_convergence::Verdict;
use serde_json::{Map, Value};

/// The sign for a missing number.
const NONE: &str = "\u{2013}";

/// A number as a person reads it, with all its digits in the source of the page.
pub fn number(value: Option<f64>, shown: impl Fn(f64) -> String) -> Markup {
    html! {
        @match value {
            Some(value) => data value=(format!("{value:e}")) { (shown(value)) },
            None => (NONE),
        }
    }
}

/// An error or a time step.
pub fn small(value: Option<f64>) -> Markup {
    number(value, |value| format!("{value:.2e}"))
}

/// An observed order.
pub fn order(value: Option<f64>) -> Markup {
    number(value, |value| format!("{value:.2}"))
}

/// A count.
pub fn count(value: Option<usize>) -> Markup {
    html! { @match value { Some(value) => (value), None => (NONE) } }
}

/// Seconds of a computation.
pub fn seconds(value: Option<f64>) -> Markup {
    number(value, mms_files::words::duration)
}

/// A number or a text of a document, unchanged.
pub fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(items) => items.iter().map(plain).collect::<Vec<_>>().join(", "),
        other => other.to_string(),
    }
}

/// Whether the verdict on results is good for their solver.
pub fn is_good(verdict: &str) -> bool {
    [Verdict::Pass, Verdict::Exact].iter().any(|it| it.to_string() == verdict)
}

/// A verdict, shown by its word and its sign, not by its colour alone.
pub fn verdict(word: &str, is_expected: bool) -> Markup {
    let (class, sign) = if is_expected { ("good", "\u{2713}") } else { ("bad", "\u{2717}") };
    html! { span class=(format!("verdict {class}")) { span aria-hidden="true" { (sign) " " } (word) } }
}

/// The members of an object of a document, without null and empty ones.
pub fn list(object: &Map<String, Value>) -> Markup {
    let is_there =
        |value: &Value| !value.is_null() && value.as_array().is_none_or(|it| !it.is_empty());
    html! {
        dl.inline {
            @for (key, value) in object.iter().filter(|(_, value)| is_there(value)) {
                div { dt { (key.replace('_', " ")) } dd { (plain(value)) } }
            }
        }
    }
}

/// The head of a column, and the alignment of its cells.
#[derive(Clone)]
pub enum Column {
    /// Numbers, aligned to the right.
    Number(Cow<'static, str>),
    /// Texts, aligned to the left.
    Text(Cow<'static, str>),
}

/// A column of numbers.
pub const fn numbers(name: &'static str) -> Column {
    Number(Cow::Borrowed(name))
}

/// A column of words.
pub const fn words(name: &'static str) -> Column {
    Text(Cow::Borrowed(name))
}

use Column::{Number, Text};

/// A table. The first cell of a row names the row.
pub fn table(
    caption: &str,
    columns: &[Column],
    rows: impl IntoIterator<Item = Vec<Markup>>,
) -> Markup {
    let class = |column: &Column| matches!(column, Text(_)).then_some("text");
    html! {
        // Wider than a screen, it scrolls by itself, by keyboard too.
        div.scroll role="region" tabindex="0" aria-label=(caption) {
            table {
                caption { (caption) }
                thead { tr {
                    @for column in columns {
                        @let (Number(name) | Text(name)) = column;
                        th scope="col" class=[class(column)] { (name) }
                    }
                } }
                tbody {
                    @for row in rows {
                        tr {
                            @for (at, (cell, column)) in row.into_iter().zip(columns).enumerate() {
                                @if at == 0 {
                                    th scope="row" class=[class(column)] { (cell) }
                                } @else {
                                    td class=[class(column)] { (cell) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
