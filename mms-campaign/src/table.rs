//! Reads tables of TOML, key by key, and collects mistakes with their places.

use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::source::{SourceId, Sources, Span, Spanned};
use mms_spec::suggest::advice;
use mms_spec::table::decimal;
pub(crate) use mms_spec::table::{Table, Value};
use toml::de::{DeTable, DeValue};

/// Reads one file.
pub(crate) struct Reader {
    pub sources: Sources,
    pub source: SourceId,
    pub diagnostics: Vec<Diagnostic>,
}

impl Reader {
    /// Parses a text into its outermost table; messages show `path` as its path.
    pub fn new<'a>(path: &str, text: &'a str) -> (Self, toml::Spanned<DeTable<'a>>) {
        let mut sources = Sources::default();
        let source = sources.add(path, text);
        let mut reader = Reader { sources, source, diagnostics: Vec::new() };
        let (root, errors) = DeTable::parse_recoverable(text);
        // The other errors mostly follow from the first.
        if let Some(error) = errors.first() {
            let place = error.span().unwrap_or(0..0);
            let span = reader.sources.span(source, place.start, place.end);
            reader.report(Diagnostic::error(span, error.message().to_owned()).label("here"));
        }
        (reader, root)
    }

    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports the expected kind of a value.
    pub fn expect(&mut self, span: Span, key: &str, expected: &str) {
        let message = format!("`{key}`: expected {expected}");
        self.report(Diagnostic::error(span, message).label("found this"));
    }

    pub fn span<T>(&self, value: &toml::Spanned<T>) -> Span {
        self.sources.span_of(self.source, value)
    }

    /// The outermost table of a file.
    pub fn root<'a>(&mut self, root: &'a DeTable<'a>, name: &str, keys: &[&str]) -> Table<'a> {
        self.known(root, name, self.sources.span(self.source, 0, 0), keys)
    }

    /// The table in a value; reports another kind.
    pub fn table<'a>(
        &mut self,
        value: &'a Value<'a>,
        key: &str,
        expected: &str,
        (name, keys): (&str, &[&str]),
    ) -> Option<Table<'a>> {
        let entries = self.of_value(value, key, expected, |_| value.get_ref().as_table())?;
        Some(self.known(entries, name, self.span(value), keys))
    }

    /// A table; reports each unknown key.
    fn known<'a>(
        &mut self,
        entries: &'a DeTable<'a>,
        name: &str,
        span: Span,
        keys: &[&str],
    ) -> Table<'a> {
        let table = Table::new(name, span, &self.sources, self.source, entries);
        for key in table.entries.iter().map(|entry| &entry.key) {
            if !keys.contains(&key.value.as_str()) {
                let all = |_: &str| format!("its keys are {}", keys.join(", "));
                let help = advice(&key.value, table.absent(keys), all);
                let message = format!("unknown key {}", quoted(&key.value));
                let label = format!("not a key of {name}");
                self.report(Diagnostic::error(key.span, message).label(label).help(help));
            }
        }
        table
    }

    /// Reads a value; the message for another kind names the expected one.
    pub fn of_value<T>(
        &mut self,
        value: &Value<'_>,
        key: &str,
        expected: &str,
        read: impl FnOnce(&Self) -> Option<T>,
    ) -> Option<T> {
        let found = read(self);
        if found.is_none() {
            self.expect(self.span(value), key, expected);
        }
        found
    }

    /// Reads the value of an optional key.
    pub fn of_key<'a, T>(
        &mut self,
        table: &Table<'a>,
        key: &str,
        expected: &str,
        read: impl FnOnce(&Self, &'a Value<'a>) -> Option<T>,
    ) -> Option<T> {
        let value = table.value(key)?;
        self.of_value(value, key, expected, |reader| read(reader, value))
    }

    /// Reports a missing key.
    pub fn missing(&mut self, table: &Table<'_>, key: &str, example: &str) {
        let message = format!("missing key `{key}`");
        let label = format!("{} needs it", table.name);
        self.report(Diagnostic::error(table.span, message).label(label).help(example.to_owned()));
    }

    /// Reads a text.
    pub fn text(&mut self, table: &Table<'_>, key: &str) -> Option<Spanned<String>> {
        self.of_key(table, key, "a text in quotes", Self::one_text)
    }

    /// Reads a text or several.
    pub fn texts(&mut self, table: &Table<'_>, key: &str) -> Vec<Spanned<String>> {
        let expected = "a text in quotes, or an array of such";
        let found = self.of_key(table, key, expected, |reader, value| match value.get_ref() {
            DeValue::Array(items) => items.iter().map(|item| reader.one_text(item)).collect(),
            _ => reader.one_text(value).map(|text| vec![text]),
        });
        found.unwrap_or_default()
    }

    fn one_text(&self, value: &Value<'_>) -> Option<Spanned<String>> {
        let text = value.get_ref().as_str()?.to_owned();
        Some(Spanned { value: text, span: self.span(value) })
    }

    /// Reads true or false, or returns a default.
    pub fn flag(&mut self, table: &Table<'_>, key: &str, default: bool) -> bool {
        let flag = |_: &Self, value: &Value<'_>| value.get_ref().as_bool();
        self.of_key(table, key, "true or false", flag).unwrap_or(default)
    }

    /// Reads a positive number.
    pub fn positive(&mut self, table: &Table<'_>, key: &str) -> Option<f64> {
        let positive = |_: &Self, value: &Value<'_>| number(value).filter(|it| *it > 0.0);
        self.of_key(table, key, "a positive number", positive)
    }

    /// Reads a number.
    pub fn number(&mut self, table: &Table<'_>, key: &str) -> Option<f64> {
        self.of_key(table, key, "a number", |_, value| number(value))
    }

    /// Reads an array of at least one number of a kind.
    pub fn numbers(
        &mut self,
        table: &Table<'_>,
        key: &str,
        expected: &str,
        is_right: fn(f64) -> bool,
    ) -> Option<Vec<f64>> {
        let right = |item: &Value<'_>| number(item).filter(|it| is_right(*it));
        self.of_key(table, key, expected, |_, value| each(value, right))
    }
}

/// Reads each item of an array, which may not be empty.
pub(crate) fn each<T>(value: &Value<'_>, read: impl Fn(&Value<'_>) -> Option<T>) -> Option<Vec<T>> {
    value.get_ref().as_array().filter(|items| !items.is_empty())?.iter().map(read).collect()
}

/// A finite number.
pub(crate) fn number(value: &Value<'_>) -> Option<f64> {
    decimal(value.get_ref())?.parse::<f64>().ok().filter(|it| it.is_finite())
}

/// The digits of a number as written.
pub(crate) fn digits(value: &Value<'_>) -> Option<String> {
    match value.get_ref() {
        DeValue::Integer(digits) => Some(digits.as_str().to_owned()),
        DeValue::Float(digits) => Some(digits.as_str().to_owned()),
        DeValue::String(text) => Some(text.as_ref().to_owned()),
        _ => None,
    }
}
