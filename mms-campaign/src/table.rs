//! Reads tables of TOML, key by key, and collects what is wrong with its place.

use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::source::{SourceId, Sources, Span, Spanned};
use mms_spec::suggest::advice;
use toml::de::{DeTable, DeValue};

/// A value with its place.
pub(crate) type Value<'a> = toml::Spanned<DeValue<'a>>;

/// Reads one file.
pub(crate) struct Reader {
    pub sources: Sources,
    pub source: SourceId,
    pub diagnostics: Vec<Diagnostic>,
}

/// A table in which only some keys mean something.
pub(crate) struct Table<'a> {
    entries: &'a DeTable<'a>,
    /// How messages call it.
    name: &'static str,
    /// Where it begins.
    pub span: Span,
}

impl<'a> Table<'a> {
    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&'a Value<'a>> {
        self.entries.iter().find(|(own, _)| own.get_ref() == key).map(|(_, value)| value)
    }
}

impl Reader {
    /// A text with the path that messages show for it, and its outermost table.
    pub fn new<'a>(path: &str, text: &'a str) -> (Self, toml::Spanned<DeTable<'a>>) {
        let mut sources = Sources::default();
        let source = sources.add(path, text);
        let mut reader = Reader { sources, source, diagnostics: Vec::new() };
        let (root, errors) = DeTable::parse_recoverable(text);
        // The others mostly follow from the first.
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

    /// Says of a value what it has to be.
    pub fn expect(&mut self, span: Span, key: &str, expected: &str) {
        let message = format!("`{key}`: expected {expected}");
        self.report(Diagnostic::error(span, message).label("found this"));
    }

    pub fn span<T>(&self, value: &toml::Spanned<T>) -> Span {
        let place = value.span();
        self.sources.span(self.source, place.start, place.end)
    }

    /// A table, with a word on each key that means nothing in it.
    pub fn table<'a>(
        &mut self,
        entries: &'a DeTable<'a>,
        name: &'static str,
        span: Span,
        keys: &[&str],
    ) -> Table<'a> {
        for key in entries.keys().filter(|key| !keys.contains(&key.get_ref().as_ref())) {
            let absent = keys
                .iter()
                .copied()
                .filter(|known| entries.keys().all(|own| own.get_ref() != *known));
            let help =
                advice(key.get_ref(), absent, |_| format!("its keys are {}", keys.join(", ")));
            let message = format!("unknown key {}", quoted(key.get_ref()));
            let span = self.span(key);
            let label = format!("not a key of {name}");
            self.report(Diagnostic::error(span, message).label(label).help(help));
        }
        Table { entries, name, span }
    }

    /// Says that a key is missing.
    pub fn missing(&mut self, table: &Table<'_>, key: &str, example: &str) {
        let message = format!("missing key `{key}`");
        let label = format!("{} needs it", table.name);
        self.report(Diagnostic::error(table.span, message).label(label).help(example.to_owned()));
    }

    /// A text.
    pub fn text(&mut self, table: &Table<'_>, key: &str) -> Option<Spanned<String>> {
        let value = table.get(key)?;
        let text = self.one_text(value);
        if text.is_none() {
            self.expect(self.span(value), key, "a text in quotes");
        }
        text
    }

    /// A text or several.
    pub fn texts(&mut self, table: &Table<'_>, key: &str) -> Vec<Spanned<String>> {
        let Some(value) = table.get(key) else { return Vec::new() };
        let found = match value.get_ref() {
            DeValue::Array(items) => items.iter().map(|item| self.one_text(item)).collect(),
            _ => self.one_text(value).map(|text| vec![text]),
        };
        found.unwrap_or_else(|| {
            self.expect(self.span(value), key, "a text in quotes, or an array of such");
            Vec::new()
        })
    }

    fn one_text(&self, value: &Value<'_>) -> Option<Spanned<String>> {
        let text = value.get_ref().as_str()?.to_owned();
        Some(Spanned { value: text, span: self.span(value) })
    }

    /// True or false, or a default where nothing is said.
    pub fn flag(&mut self, table: &Table<'_>, key: &str, default: bool) -> bool {
        let Some(value) = table.get(key) else { return default };
        value.get_ref().as_bool().unwrap_or_else(|| {
            self.expect(self.span(value), key, "true or false");
            default
        })
    }

    /// A positive number.
    pub fn positive(&mut self, table: &Table<'_>, key: &str) -> Option<f64> {
        let value = table.get(key)?;
        let found = number(value).filter(|it| *it > 0.0);
        if found.is_none() {
            self.expect(self.span(value), key, "a positive number");
        }
        found
    }

    /// A number.
    pub fn number(&mut self, table: &Table<'_>, key: &str) -> Option<f64> {
        let value = table.get(key)?;
        let found = number(value);
        if found.is_none() {
            self.expect(self.span(value), key, "a number");
        }
        found
    }

    /// Numbers, one at least, of a kind.
    pub fn numbers(
        &mut self,
        table: &Table<'_>,
        key: &str,
        expected: &str,
        is_right: fn(f64) -> bool,
    ) -> Option<Vec<f64>> {
        let value = table.get(key)?;
        let items = value.get_ref().as_array().filter(|items| !items.is_empty());
        let found = items.and_then(|items| {
            items.iter().map(|item| number(item).filter(|it| is_right(*it))).collect()
        });
        if found.is_none() {
            self.expect(self.span(value), key, expected);
        }
        found
    }
}

/// A finite number.
pub(crate) fn number(value: &Value<'_>) -> Option<f64> {
    let digits = match value.get_ref() {
        DeValue::Integer(digits) if digits.radix() == 10 => digits.as_str(),
        DeValue::Float(digits) => digits.as_str(),
        _ => return None,
    };
    digits.parse::<f64>().ok().filter(|it| it.is_finite())
}

/// A number as it is written.
pub(crate) fn digits(value: &Value<'_>) -> Option<String> {
    match value.get_ref() {
        DeValue::Integer(digits) => Some(digits.as_str().to_owned()),
        DeValue::Float(digits) => Some(digits.as_str().to_owned()),
        DeValue::String(text) => Some(text.as_ref().to_owned()),
        _ => None,
    }
}
