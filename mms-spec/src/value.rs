//! The values of a table: text, numbers, words of a fixed list, formulas.

use toml::de::DeValue;

use crate::diagnostic::{Diagnostic, quoted};
use crate::foreign::Foreign;
use crate::formula::Formula;
use crate::source::{Span, Spanned};
use crate::suggest::advice;
use crate::table::{Entry, Reader, Table, Value, decimal, list};

/// The largest number of cells and particles; more are a slip.
pub const MAX_COUNT: usize = 1_000_000_000;

impl<'a> Reader<'a> {
    /// A string.
    pub fn string(&mut self, entry: &Entry<'a>) -> Option<Spanned<String>> {
        match entry.value.get_ref() {
            DeValue::String(text) if !self.is_damaged(entry.value) => {
                Some(Spanned { value: text.to_string(), span: self.span(entry.value) })
            }
            _ => {
                self.wrong_type(&entry.key.value, entry.value, "a string");
                None
            }
        }
    }

    /// Reads the text for people of an optional key.
    pub fn optional_foreign(&mut self, table: &Table<'a>, key: &str) -> Option<Foreign> {
        let entry = table.get(key)?;
        self.string(&entry).map(|text| text.value.into())
    }

    /// Reads the string of a required key.
    pub fn required_string(&mut self, table: &Table<'a>, key: &str) -> Option<Spanned<String>> {
        let entry = self.required(table, key)?;
        self.string(&entry)
    }

    /// One of a fixed list of words; `what` names the list.
    pub fn word(
        &mut self,
        entry: &Entry<'a>,
        what: &str,
        words: &[&str],
    ) -> Option<Spanned<String>> {
        let found = self.string(entry)?;
        if words.contains(&found.value.as_str()) {
            return Some(found);
        }
        self.report(unknown_word(&found, what, words));
        None
    }

    /// A boolean.
    pub fn boolean(&mut self, entry: &Entry<'a>) -> Option<bool> {
        match entry.value.get_ref() {
            DeValue::Boolean(value) => Some(*value),
            _ => {
                self.wrong_type(&entry.key.value, entry.value, "true or false");
                None
            }
        }
    }

    /// A whole number from 1 on.
    pub fn count(&mut self, key: &str, value: &Value<'a>) -> Option<usize> {
        let DeValue::Integer(digits) = value.get_ref() else {
            self.wrong_type(key, value, "a whole number");
            return None;
        };
        let number = usize::from_str_radix(digits.as_str(), digits.radix());
        match number {
            _ if self.is_damaged(value) => None,
            Ok(number) if (1..=MAX_COUNT).contains(&number) => Some(number),
            _ => {
                let message = format!("`{key}` must be between 1 and {MAX_COUNT}");
                self.report(Diagnostic::error(self.span(value), message).label("out of range"));
                None
            }
        }
    }

    /// A positive number, for settings that are no part of the field's mathematics.
    pub fn positive(&mut self, entry: &Entry<'a>) -> Option<f64> {
        let key = &entry.key.value;
        let Some(digits) = decimal(entry.value.get_ref()) else {
            self.wrong_type(key, entry.value, "a number");
            return None;
        };
        match digits.parse::<f64>() {
            _ if self.is_damaged(entry.value) => None,
            Ok(number) if number > 0.0 && number.is_finite() => Some(number),
            _ => {
                let message = format!("`{key}` must be a positive number");
                self.report(
                    Diagnostic::error(self.span(entry.value), message).label("out of range"),
                );
                None
            }
        }
    }

    /// An expression, or a bare number.
    pub fn formula(&mut self, key: &str, value: &Value<'a>) -> Formula {
        let span = self.span(value);
        let reported = Formula::reported(span);
        if self.is_damaged(value) {
            return reported;
        }
        let raw = self.sources.slice(span);
        match value.get_ref() {
            DeValue::String(text) => Formula::from_string(raw, text, span),
            DeValue::Integer(digits) if digits.radix() == 10 => Formula::from_number(raw, span),
            DeValue::Float(digits) if digits.as_str().contains(['i', 'n']) => {
                let message = format!("{} must be finite", quoted(key));
                self.report(Diagnostic::error(span, message).label("not a number to compute with"));
                reported
            }
            DeValue::Float(_) => Formula::from_number(raw, span),
            DeValue::Integer(_) => {
                let message = format!("{} must be a decimal number", quoted(key));
                let label = "hexadecimal, octal and binary numbers are not read here";
                self.report(Diagnostic::error(span, message).label(label));
                reported
            }
            _ => {
                self.wrong_type(key, value, "a formula (a string or a number)");
                reported
            }
        }
    }

    /// Reads the formula of a required key; if it is missing, returns a reported one.
    pub fn required_formula(&mut self, table: &Table<'a>, key: &str) -> Formula {
        match self.required(table, key) {
            Some(entry) => self.formula(key, entry.value),
            None => Formula::reported(table.span),
        }
    }

    /// Reads an array of exactly `count` formulas; `reason` explains the number. Missing ones are filled up with reported
    /// formulas.
    pub fn formulas(&mut self, entry: &Entry<'a>, count: usize, reason: &str) -> Vec<Formula> {
        let (key, value) = (entry.key.value.as_str(), entry.value);
        let span = self.span(value);
        let mut formulas: Vec<_> = match value.get_ref() {
            DeValue::Array(items) => items.iter().map(|item| self.formula(key, item)).collect(),
            _ => {
                let example = vec!["\"...\""; count].join(", ");
                let expected = format!("an array of {}", plural(count, "formula"));
                let instead = format!("write {key} = [{example}]");
                self.wrong_type_because(key, value, &expected, Some(instead));
                self.keep_stray(key, value);
                return vec![Formula::reported(span); count];
            }
        };
        if formulas.len() != count && !self.is_damaged(value) {
            self.wrong_count(key, span, formulas.len(), count, reason);
        }
        if formulas.len() > count {
            self.stray.extend(formulas.drain(count..));
        }
        formulas.resize(count, Formula::reported(span));
        formulas
    }

    /// Reads the formulas of a required key; if it is missing, returns as many reported ones.
    pub fn required_formulas(
        &mut self,
        table: &Table<'a>,
        key: &str,
        count: usize,
        reason: &str,
    ) -> Vec<Formula> {
        match self.required(table, key) {
            Some(entry) => self.formulas(&entry, count, reason),
            None => vec![Formula::reported(table.span); count],
        }
    }

    /// Two formulas: the ends of an interval.
    pub fn pair(&mut self, entry: &Entry<'a>, reason: &str) -> [Formula; 2] {
        let mut formulas = self.formulas(entry, 2, reason).into_iter();
        let span = self.span(entry.value);
        std::array::from_fn(|_| formulas.next().unwrap_or_else(|| Formula::reported(span)))
    }

    /// Reads an array of pairs of formulas; `None` if a mistake is reported.
    pub fn pairs(&mut self, entry: &Entry<'a>, what: &str) -> Option<Vec<[Formula; 2]>> {
        let key = entry.key.value.as_str();
        let DeValue::Array(items) = entry.value.get_ref() else {
            let instead = format!("write {key} = [[\"0\", \"0\"], [\"1\", \"0\"], [\"0\", \"1\"]]");
            let expected = format!("an array of {what}");
            self.wrong_type_because(key, entry.value, &expected, Some(instead));
            return None;
        };
        let pair = |value: &'a Value<'a>| {
            let item = Entry { key: entry.key.clone(), value };
            self.pair(&item, "expected X and Y")
        };
        Some(items.iter().map(pair).collect())
    }

    /// Reads an array of strings; `None` if a mistake is reported.
    pub fn strings(&mut self, entry: &Entry<'a>) -> Option<Vec<Spanned<String>>> {
        let DeValue::Array(items) = entry.value.get_ref() else {
            self.wrong_type(&entry.key.value, entry.value, "an array of strings");
            return None;
        };
        let string = |value| self.string(&Entry { key: entry.key.clone(), value });
        items.iter().map(string).collect::<Vec<_>>().into_iter().collect()
    }

    fn wrong_count(&mut self, key: &str, span: Span, found: usize, expected: usize, reason: &str) {
        let found = plural(found, "component");
        let message = format!("`{key}` has {found}, expected {expected}");
        self.report(Diagnostic::error(span, message).label(reason));
    }

    /// Keeps the formulas of an array that has lost its meaning.
    pub fn keep_strays(&mut self, entry: &Entry<'a>) {
        let DeValue::Array(items) = entry.value.get_ref() else { return };
        for item in items {
            self.keep_stray(&entry.key.value, item);
        }
    }

    /// Keeps a lone formula that should be an array, so that its syntax is still checked.
    fn keep_stray(&mut self, key: &str, value: &Value<'a>) {
        if value.get_ref().is_str() {
            let formula = self.formula(key, value);
            self.stray.push(formula);
        }
    }
}

/// A word that is on no list.
pub(super) fn unknown_word(found: &Spanned<String>, what: &str, words: &[&str]) -> Diagnostic {
    let message = format!("unknown {what} {}", quoted(&found.value));
    let diagnostic = Diagnostic::error(found.span, message).label(format!("no such {what}"));
    let expected = |_: &str| format!("expected one of {}", list(words));
    diagnostic.help(advice(&found.value, words.iter().copied(), expected))
}

/// `1 formula`, `2 formulas`.
pub(super) fn plural(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
