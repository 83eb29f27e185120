//! A table with the place of everything in it, and a reader that collects mistakes.
//!
//! Every function here reports its own mistakes and then returns the best available value, so that one run shows every mistake
//! of a file. A value whose mistake is already known is skipped silently, and its formula is replaced by [`Formula::reported`].

use toml::de::{DeString, DeTable, DeValue};

use crate::diagnostic::{Diagnostic, quoted};
use crate::document::Document;
use crate::format::{self, Key};
use crate::formula::Formula;
use crate::language::elsewhere;
use crate::source::{SourceId, Sources, Span, Spanned};
use crate::suggest::{advice, did_you_mean};

/// The largest number of diagnostics of one file.
const MAX_DIAGNOSTICS: usize = 1000;

/// A TOML value with its place.
pub type Value<'a> = toml::Spanned<DeValue<'a>>;

/// A key and its value.
#[derive(Clone)]
pub struct Entry<'a> {
    /// The key, without quotes.
    pub key: Spanned<String>,
    /// The value of the key.
    pub value: &'a Value<'a>,
}

/// The entries of a table, in the order of the file.
pub struct Table<'a> {
    /// The name of the table in messages, such as `[domain]`.
    pub name: String,
    /// The place of its header, or of the whole inline table.
    pub span: Span,
    /// The entries.
    pub entries: Vec<Entry<'a>>,
    /// Keys that are missing only because they are misspelt, and were reported as misspelt.
    pub(crate) misspelt: Vec<&'static str>,
}

impl<'a> Table<'a> {
    /// Makes a table with its name in messages and its place.
    pub fn new(
        name: impl Into<String>,
        span: Span,
        sources: &Sources,
        id: SourceId,
        table: &'a DeTable<'a>,
    ) -> Self {
        let key = |key: &toml::Spanned<DeString<'_>>| Spanned {
            value: key.get_ref().to_string(),
            span: sources.span_of(id, key),
        };
        let mut entries: Vec<_> =
            table.iter().map(|(own, value)| Entry { key: key(own), value }).collect();
        // TOML sorts by name; definitions have the order of the file.
        entries.sort_by_key(|entry| entry.key.span.start);
        Table { name: name.into(), span, entries, misspelt: Vec::new() }
    }

    /// The value of this key.
    pub fn value(&self, key: &str) -> Option<&'a Value<'a>> {
        self.get(key).map(|entry| entry.value)
    }

    /// The keys among these that are missing in the table.
    pub fn absent<'k>(&self, keys: &[&'k str]) -> Vec<&'k str> {
        keys.iter().copied().filter(|key| self.get(key).is_none()).collect()
    }

    /// The entry of this key.
    pub fn get(&self, key: &str) -> Option<Entry<'a>> {
        self.entries.iter().find(|entry| entry.key.value == key).cloned()
    }
}

/// Reads one file.
pub(crate) struct Reader<'a> {
    /// All texts.
    pub sources: &'a Sources,
    /// The text that is read.
    pub id: SourceId,
    /// Formulas that lost their place because of a reported mistake, such as an excess component. Their own syntax is still
    /// checked.
    pub stray: Vec<Formula>,
    /// Whether a table of names could not be read: a name may be defined in it.
    pub lost_names: bool,
    /// Reserved names that the file tries to define.
    pub refused: Vec<String>,
    damage: &'a [std::ops::Range<usize>],
    incomplete: bool,
    diagnostics: &'a mut Vec<Diagnostic>,
    reported: usize,
}

impl<'a> Reader<'a> {
    /// Makes a reader for a parsed file.
    pub fn new(
        sources: &'a Sources,
        id: SourceId,
        document: &'a Document<'_>,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        let (damage, incomplete) = (document.damage.as_slice(), document.incomplete);
        Reader {
            sources,
            id,
            stray: Vec::new(),
            lost_names: incomplete,
            refused: Vec::new(),
            damage,
            incomplete,
            diagnostics,
            reported: 0,
        }
    }

    /// Adds a diagnostic.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        if !self.is_full() {
            self.reported += 1;
            self.diagnostics.push(diagnostic);
        }
    }

    /// Whether definitions of the file may be missing from its tree.
    pub fn is_incomplete(&self) -> bool {
        self.incomplete
    }

    /// Whether further diagnostics would be dropped.
    pub fn is_full(&self) -> bool {
        self.reported >= MAX_DIAGNOSTICS
    }

    /// The place of a value.
    pub fn span(&self, value: &Value<'_>) -> Span {
        self.sources.span_of(self.id, value)
    }

    /// Whether TOML could not read a value, and has reported it.
    pub fn is_damaged(&self, value: &Value<'_>) -> bool {
        let place = value.span();
        // TOML uses an empty place for a missing value.
        place.is_empty()
            || self
                .damage
                .iter()
                .any(|damage| damage.start <= place.end && place.start <= damage.end)
    }

    /// The file's outermost table.
    pub fn root(&mut self, name: &str, root: &'a DeTable<'a>, keys: &[Key]) -> Table<'a> {
        let span = self.sources.span(self.id, 0, 0);
        let mut table = Table::new(name, span, self.sources, self.id, root);
        self.check_keys(&mut table, keys);
        table
    }

    /// Reads a table that may only have these keys.
    pub fn table(&mut self, entry: &Entry<'a>, name: &str, keys: &[Key]) -> Option<Table<'a>> {
        let mut table = self.open_table(entry, name)?;
        self.check_keys(&mut table, keys);
        Some(table)
    }

    /// Reads a table whose keys are the user's own.
    pub fn open_table(&mut self, entry: &Entry<'a>, name: &str) -> Option<Table<'a>> {
        match entry.value.get_ref() {
            DeValue::Table(table) => {
                let span = self.span(entry.value);
                Some(Table::new(name, span, self.sources, self.id, table))
            }
            _ => {
                self.wrong_type(&entry.key.value, entry.value, "a table");
                None
            }
        }
    }

    /// Reads a table of the user's own names, if there is one.
    pub fn names(&mut self, root: &Table<'a>, key: &str) -> Option<Table<'a>> {
        let entry = root.get(key)?;
        let table = self.open_table(&entry, &format!("[{key}]"));
        self.lost_names |= table.is_none();
        table
    }

    /// The tables under `[[name]]`.
    pub fn tables(&mut self, entry: &Entry<'a>, keys: &[Key]) -> Vec<Table<'a>> {
        let name = format!("[[{}]]", entry.key.value);
        let DeValue::Array(items) = entry.value.get_ref() else {
            self.wrong_type(&entry.key.value, entry.value, &format!("an array of tables, {name}"));
            return Vec::new();
        };
        let entries = items.iter().map(|value| Entry { key: entry.key.clone(), value });
        entries.filter_map(|entry| self.table(&entry, &name, keys)).collect()
    }

    /// Reports every key that is not one of these.
    fn check_keys(&mut self, table: &mut Table<'a>, keys: &[Key]) {
        let keys = format::names(keys);
        let absent = table.absent(&keys);
        for entry in &table.entries {
            let key = entry.key.value.as_str();
            // A key that lost its header to a syntax error may be right in its original table.
            if keys.contains(&key) || self.incomplete || self.is_full() {
                continue;
            }
            let absent = absent.iter().copied();
            table.misspelt.extend(did_you_mean(key, absent.clone()));
            let all = |_: &str| format!("its keys are {}", list(&keys));
            self.report(
                Diagnostic::error(entry.key.span, format!("unknown key {}", quoted(key)))
                    .label(format!("not a key of {}", table.name))
                    .help(elsewhere(key).map_or_else(|| advice(key, absent, all), str::to_owned)),
            );
        }
    }

    /// Reports a key that belongs elsewhere; returns whether the table has it.
    pub fn refuse(&mut self, table: &Table<'a>, key: &str, reason: &str) -> bool {
        let Some(entry) = table.get(key) else { return false };
        let message = format!("`{key}` has no meaning here");
        self.report(Diagnostic::error(entry.key.span, message).label(reason));
        true
    }

    /// The entry of a required key.
    pub fn required(&mut self, table: &Table<'a>, key: &str) -> Option<Entry<'a>> {
        let message = format!("missing key `{key}`");
        self.needed(table, key, message, format!("{} needs `{key}`", table.name))
    }

    /// The entry of a required table.
    pub fn required_table(&mut self, root: &Table<'a>, key: &str) -> Option<Entry<'a>> {
        let message = format!("missing table [{key}]");
        self.needed(root, key, message, format!("{} needs [{key}]", root.name))
    }

    fn needed(
        &mut self,
        table: &Table<'a>,
        key: &str,
        message: String,
        label: String,
    ) -> Option<Entry<'a>> {
        let entry = table.get(key);
        if entry.is_none() && !self.incomplete && !table.misspelt.contains(&key) {
            self.report(Diagnostic::error(table.span, message).label(label));
        }
        entry
    }

    /// Reports a value of the wrong type.
    pub fn wrong_type(&mut self, key: &str, value: &Value<'_>, expected: &str) {
        self.wrong_type_because(key, value, expected, None);
    }

    /// Reports a value of the wrong type, with advice on a right one.
    pub fn wrong_type_because(
        &mut self,
        key: &str,
        value: &Value<'_>,
        expected: &str,
        instead: Option<String>,
    ) {
        if self.is_damaged(value) {
            return;
        }
        let found = describe(value.get_ref());
        let mut diagnostic =
            Diagnostic::error(self.span(value), format!("{} must be {expected}", quoted(key)))
                .label(format!("this is {found}"));
        diagnostic.help.extend(instead);
        self.report(diagnostic);
    }
}

/// Names for a sentence: `` `a`, `b`, `c` ``.
pub(crate) fn list(names: &[&str]) -> String {
    let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// A decimal number as written.
pub fn decimal<'a>(value: &'a DeValue<'_>) -> Option<&'a str> {
    match value {
        DeValue::Integer(digits) if digits.radix() == 10 => Some(digits.as_str()),
        DeValue::Float(digits) => Some(digits.as_str()),
        _ => None,
    }
}

fn describe(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) => "an integer",
        DeValue::Float(_) => "a decimal number",
        DeValue::Boolean(_) => "a boolean",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    }
}
