//! A saved scene: `mms study --study FILE.toml`, whose keys are the options of the command. They are put into the
//! command line before it is read, so that there is one list of options.

use std::ffi::OsString;

use anyhow::{anyhow, bail};
use clap::{Arg, Args, Command};
use mms_codegen::compile::Failure;
use mms_files::read::{self, FileKind};
use mms_spec::diagnostic::Diagnostic;
use mms_spec::source::Sources;
use mms_spec::suggest::advice;
use mms_spec::table::decimal;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::study::Study;

/// The arguments of a command line, preceded by the arguments of its study file. An option of the file is dropped if the
/// command line has it or excludes it; parameters are set by both.
pub fn expand(arguments: impl Iterator<Item = OsString>) -> anyhow::Result<Vec<OsString>> {
    let mut arguments: Vec<OsString> = arguments.collect();
    if arguments.get(1).is_none_or(|command| command != "study") {
        return Ok(arguments);
    }
    let named = |argument: &OsString| argument.to_str().is_some_and(|it| is_option(it, "study"));
    let Some(at) = arguments.iter().position(named) else { return Ok(arguments) };
    let option = arguments.remove(at);
    let path = match option.to_str().and_then(|option| option.split_once('=')) {
        Some((_, path)) => OsString::from(path),
        None if at < arguments.len() => arguments.remove(at),
        None => bail!("`--study`: expected the path of a TOML file"),
    };
    if arguments.iter().any(named) {
        bail!("`--study` is given twice");
    }
    let text = read::text(path.as_ref(), FileKind::Study)?;
    let own = &arguments[2..];
    let saved = options(&path.to_string_lossy(), &text, &Given::new(own))?;
    Ok(arguments[..2].iter().cloned().chain(saved).chain(own.iter().cloned()).collect())
}

/// The options and parameters that the command line sets; they replace the same ones of a study file.
struct Given {
    command: Command,
    /// The names of options.
    options: Vec<String>,
    /// The parameters that are set.
    parameters: Vec<String>,
}

impl Given {
    fn new(arguments: &[OsString]) -> Self {
        let command = Study::augment_args(Command::new("study"));
        let words: Vec<&str> = arguments.iter().filter_map(|it| it.to_str()).collect();
        let is_given = |option: &Arg| {
            let short = option.get_short().map(|letter| format!("-{letter}"));
            let long = option.get_long().unwrap_or_default();
            words.iter().any(|word| {
                is_option(word, long) || short.as_ref().is_some_and(|it| word.starts_with(it))
            })
        };
        let options = command.get_opts().filter(|option| is_given(option));
        let options = options.filter_map(|it| it.get_long()).map(str::to_owned).collect();
        let settings = words.iter().enumerate().filter_map(|(at, word)| match *word {
            "--set" => words.get(at + 1).copied(),
            other => other.strip_prefix("--set="),
        });
        let parameters = settings.filter_map(|it| it.split_once('='));
        let parameters = parameters.map(|(name, _)| name.trim().to_owned()).collect();
        Self { command, options, parameters }
    }

    /// Whether an option of a file is given on the command line, or excluded by one of its options.
    fn replaces(&self, name: &str) -> bool {
        let option = |name: &str| self.command.get_opts().find(|it| it.get_long() == Some(name));
        let excludes = |one: &Arg, other: &Arg| {
            self.command.get_arg_conflicts_with(one).iter().any(|it| it.get_id() == other.get_id())
        };
        let Some(saved) = option(name) else { return false };
        self.options.iter().filter_map(|given| option(given)).any(|given| {
            let same = given.get_id() == saved.get_id();
            same && name != "set" || excludes(given, saved) || excludes(saved, given)
        })
    }

    /// Checks the arguments of one key: returns them, or the message with which the command refuses them.
    fn check(&self, name: &str, arguments: Vec<OsString>) -> Result<Vec<OsString>, String> {
        let command: &[&str] = if name == "field" { &["study"] } else { &["study", "field"] };
        let all = command.iter().map(OsString::from).chain(arguments.iter().cloned());
        let Err(error) = self.command.clone().try_get_matches_from(all) else {
            return Ok(arguments);
        };
        let said = error.render().to_string();
        let said = said.strip_prefix("error: ").unwrap_or(&said);
        let said = said.split("\n\n").next().unwrap_or_default();
        Err(said.split_whitespace().collect::<Vec<_>>().join(" "))
    }
}

/// Whether an argument is the option of this name.
fn is_option(argument: &str, name: &str) -> bool {
    let rest = argument.strip_prefix("--").and_then(|rest| rest.strip_prefix(name));
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
}

/// The arguments of a study file, without the options that are given.
fn options(path: &str, text: &str, given: &Given) -> anyhow::Result<Vec<OsString>> {
    let options: Vec<&str> = given.command.get_opts().filter_map(|it| it.get_long()).collect();
    let known = || options.iter().copied().filter(|name| *name != "study").chain(["field"]);
    let mut sources = Sources::default();
    let source = sources.add(path, text);
    let mut diagnostics = Vec::new();
    let mut arguments = Vec::new();
    let (root, errors) = DeTable::parse_recoverable(text);
    for error in errors {
        let place = error.span().unwrap_or(0..0);
        let span = sources.span(source, place.start, place.end);
        diagnostics.push(Diagnostic::error(span, error.message().to_string()).label("here"));
    }
    for (key, value) in root.get_ref() {
        let name = key.get_ref().replace('_', "-");
        let span = sources.span_of(source, key);
        if !known().any(|option| option == name) {
            let keys: Vec<String> = known().map(|option| option.replace('-', "_")).collect();
            let help = advice(key.get_ref(), keys.iter().map(String::as_str), |_| {
                "the keys are the options of `mms study`, and `field`: see `--help`".into()
            });
            let message = format!("`{}` is no option of a study", key.get_ref());
            diagnostics.push(Diagnostic::error(span, message).label("unknown").help(help));
        } else if !given.replaces(&name) {
            let words = words(&name, value, &given.parameters);
            let words = words.map_err(|expected| format!("expected {expected}"));
            match words.and_then(|words| given.check(&name, words)) {
                Ok(words) => arguments.extend(words),
                Err(what) => {
                    let span = sources.span_of(source, value);
                    let message = format!("`{}`: {what}", key.get_ref());
                    diagnostics.push(Diagnostic::error(span, message).label("found this"));
                }
            }
        }
    }
    if !diagnostics.is_empty() {
        let failure = Failure { sources, diagnostics };
        return Err(anyhow!("the study file has mistakes\n{failure}"));
    }
    Ok(arguments)
}

/// Converts one key to arguments, without the parameters that the command line sets; the error names the expected value.
fn words(
    name: &str,
    value: &Spanned<DeValue<'_>>,
    set: &[String],
) -> Result<Vec<OsString>, &'static str> {
    let option = format!("--{name}=");
    let mut arguments: Vec<OsString> = Vec::new();
    match (name, value.get_ref()) {
        ("field", DeValue::String(field)) => arguments.push(field.as_ref().into()),
        ("field", _) => return Err("the name of a field or a path to one, in quotes"),
        ("set", DeValue::Table(table)) => {
            let left = table.iter().filter(|(name, _)| !set.iter().any(|it| it == name.get_ref()));
            for (parameter, value) in left {
                let value = word(value).ok_or("numbers")?;
                arguments.push(format!("{option}{}={value}", parameter.get_ref()).into());
            }
        }
        ("set", _) => return Err("a table, as in { young = 1e6 }"),
        (_, DeValue::Boolean(true)) => arguments.push(format!("--{name}").into()),
        (_, DeValue::Boolean(false)) => {}
        (_, DeValue::Array(items)) => {
            let words: Option<Vec<String>> = items.iter().map(word).collect();
            let words = words.ok_or("numbers, or words in quotes")?;
            arguments.push((option + &words.join(",")).into());
        }
        _ => arguments.push((option + &word(value).ok_or("a number, or a word in quotes")?).into()),
    }
    Ok(arguments)
}

/// A number as it is written, or a text.
fn word(value: &Spanned<DeValue<'_>>) -> Option<String> {
    match value.get_ref() {
        DeValue::String(text) => Some(text.as_ref().to_owned()),
        other => decimal(other).map(str::to_owned),
    }
}
