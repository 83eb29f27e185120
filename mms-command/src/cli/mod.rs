//! The `mms` command: one file per subcommand.
//!
//! | exit code | means |
//! |---|---|
//! | 0 | done, and as expected |
//! | 1 | done, and a claim, a proof, a closed form or an order failed |
//! | 2 | bad usage or bad input |
//! | 3 | a run stopped, or none could be started; a study continues after a level that stops |
//!
//! Results go to stdout, progress and diagnostics to stderr. `print` and `say` escape the control characters that texts
//! from outside may contain; JSON has escapes for invisible characters.
//! `docs/reference/json.md` has the keys of all documents. Numbers are the shortest digits that read back as the
//! same number.

mod accuracy;
mod campaign;
mod check;
mod demo;
mod diagnose;
mod emit;
mod eval;
mod examples;
mod explain;
mod extremes;
mod figure;
mod format;
mod judge;
mod list;
mod methods;
mod naming;
mod new;
mod next;
mod observers;
mod replaced;
mod report;
mod run;
mod saved;
mod schema;
mod show;
mod state;
pub(crate) mod study;
mod tradeoff;
mod verify;
mod warned;

use std::ffi::OsString;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::{Arg, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use mms_campaign::supervisor;
use mms_files::program::arguments;
use mms_files::shell::words;
use mms_files::write::{is_same, try_to_write};
use mms_runtime::math::dispatch::{Instructions, LIMIT};
use mms_spec::foreign;

use crate::provenance::{self, Input, Provenance};
use crate::terminal::{print, print_json, printed_to_the_end, say, say_styled};

/// Manufactured solutions for solid mechanics: derive, evaluate and check them, and measure the order of convergence of your
/// own solver, or of the built-in MPM/GIMP solver, on them.
///
/// A FIELD is an exact motion with its body and material: a name that `mms list` prints, or the path of a TOML file.
///
/// Without a command, `mms` runs the convergence study of the 1D bar with contiguous-particle GIMP and leapfrog, on 8 to 128
/// cells.
///
/// Exit codes: 0 done and as expected; 1 done, but a claim, check or order failed; 2 bad usage or bad input; 3 a run failed.
///
/// The environment variable MMS_INSTRUCTIONS limits the instruction set to baseline, avx2 or avx512. By default all
/// instructions of the processor are used.
#[derive(Parser)]
#[command(name = "mms", version)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    Demo(demo::Demo),
    List(list::List),
    Show(show::Show),
    Check(check::Check),
    Eval(eval::Eval),
    Emit(emit::Emit),
    Accuracy(accuracy::Accuracy),
    Run(run::Run),
    Study(study::Study),
    Judge(judge::Judge),
    Diagnose(diagnose::Diagnose),
    State(state::State),
    Campaign(campaign::Campaign),
    Verify(verify::Verify),
    Report(report::Report),
    Plot(figure::Plot),
    Tradeoff(tradeoff::Tradeoff),
    Extremes(extremes::Extremes),
    New(new::New),
    Explain(explain::Explain),
    Schema(schema::Schema),
}

/// The outcome of a command that did its work.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CommandOutcome {
    /// Everything is as expected.
    AsExpected,
    /// A claim, check or order failed.
    Refuted,
    /// The input is wrong, or shows nothing; the messages have been printed.
    BadInput,
    /// A run could not be started or ended early.
    RunFailed,
}

/// Runs the command line of this program, or supervises a run of a campaign; returns the exit code.
pub fn run() -> u8 {
    if let Some(arguments) = supervisor::supervisor_arguments(arguments()) {
        return supervisor::run(&arguments);
    }
    let outcome = answer().unwrap_or_else(|error| {
        let style = anstyle::AnsiColor::Red.on_default().bold();
        let error = foreign::lines(&format!("{error:#}"));
        say_styled(&format!("{style}error{style:#}: {error}"));
        CommandOutcome::BadInput
    });
    match outcome {
        CommandOutcome::AsExpected => 0,
        CommandOutcome::Refuted => 1,
        CommandOutcome::BadInput => 2,
        CommandOutcome::RunFailed => 3,
    }
}

/// Does what the command line asks for.
fn answer() -> anyhow::Result<CommandOutcome> {
    let arguments = saved::expand(arguments().into_iter())?;
    let parsed = match parse(&arguments) {
        Ok(parsed) => parsed,
        Err(error) => return refused(&arguments, &error),
    };
    if let Some(word) = Instructions::unknown_limit() {
        let names: Vec<_> = Instructions::names().collect();
        anyhow::bail!("`{LIMIT}={}`: expected one of {}", foreign::shown(&word), names.join(", "));
    }
    match parsed.command {
        None => study::default_study(),
        Some(Command::Demo(demo)) => demo.run(),
        Some(Command::List(list)) => list.run(),
        Some(Command::Show(show)) => show.run(),
        Some(Command::Check(check)) => check.run(),
        Some(Command::Eval(eval)) => eval.run(),
        Some(Command::Emit(emit)) => emit.run(),
        Some(Command::Accuracy(accuracy)) => accuracy.run(),
        Some(Command::Run(run)) => run.run(),
        Some(Command::Study(study)) => study.run(&words(arguments)),
        Some(Command::Judge(judge)) => judge.run(),
        Some(Command::Diagnose(diagnose)) => diagnose.run(),
        Some(Command::State(state)) => state.run(),
        Some(Command::Campaign(campaign)) => campaign.run(),
        Some(Command::Verify(verify)) => verify.run(),
        Some(Command::Report(report)) => report.run(),
        Some(Command::Plot(plot)) => plot.run(),
        Some(Command::Tradeoff(tradeoff)) => tradeoff.run(),
        Some(Command::Extremes(extremes)) => extremes.run(),
        Some(Command::New(new)) => new.run(),
        Some(Command::Explain(explain)) => explain.run(),
        Some(Command::Schema(schema)) => schema.run(),
    }
}

/// The commands, in groups.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Fields", &["new", "check", "show", "eval", "accuracy", "list", "schema"]),
    ("Your own solver", &["emit", "state", "judge", "diagnose", "campaign", "report", "plot"]),
    ("The built-in solver", &["run", "study", "verify", "tradeoff", "extremes"]),
    ("First steps", &["demo", "explain", "help"]),
];

/// The commands in groups, each with the first sentence of its help.
fn groups(command: &clap::Command) -> String {
    let about = |name: &str| {
        let about = command.find_subcommand(name).and_then(clap::Command::get_about);
        about.map_or("Print this message or the help of a command".into(), ToString::to_string)
    };
    let group = |(head, names): &(&str, &[&str])| {
        let line = |name: &&str| format!("  {name:<9} {}\n", about(name));
        format!("{head}:\n{}\n", names.iter().map(line).collect::<String>())
    };
    GROUPS.iter().map(group).collect()
}

/// Parses a command line.
fn parse(arguments: &[OsString]) -> Result<Arguments, clap::Error> {
    let command =
        Arguments::command().mut_subcommands(|it| examples::with_examples(it).mut_args(with_signs));
    let template = format!(
        "{{before-help}}{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{}Options:\n{{options}}{{after-help}}",
        groups(&command)
    );
    let mut command = command.help_template(template);
    let matches = command.try_get_matches_from_mut(arguments)?;
    Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// Says what is wrong with a command line; or the help, or the version, that it asks for.
fn refused(arguments: &[OsString], error: &clap::Error) -> anyhow::Result<CommandOutcome> {
    if !error.use_stderr() {
        let printed = error.print().and_then(|()| io::stdout().flush());
        printed_to_the_end(printed)?;
        return Ok(CommandOutcome::AsExpected);
    }
    // The message quotes words of the command line, so they are escaped first.
    let shown: Vec<_> =
        words(arguments.iter().cloned()).iter().map(|it| foreign::shown(it).into()).collect();
    let of_shown = parse(&shown).err().filter(clap::Error::use_stderr);
    let text = of_shown.as_ref().unwrap_or(error).render();
    say_styled(text.ansi().to_string().trim_end());
    Ok(CommandOutcome::BadInput)
}

/// Lets the value of an option begin with a sign, as in `--jitter -1`: a wrong value is then reported as such, and not as an
/// unknown option `-1`.
fn with_signs(argument: Arg) -> Arg {
    let takes_one = !argument.is_positional() && argument.get_action().takes_values();
    if takes_one { argument.allow_negative_numbers(true) } else { argument }
}

/// The provenance of a document that this command line makes from an input.
fn this_command(kind: &str, input: Input) -> Provenance {
    provenance::new(kind, &words(arguments()), input)
}

/// Checks that the folder of `--output` can be made and written to, and fails before any work is done. Leaves nothing there.
fn validate_output(folder: &Path) -> anyhow::Result<()> {
    let shown = foreign::path(folder);
    if folder.exists() && !folder.is_dir() {
        anyhow::bail!("`--output {shown}`: not a folder");
    }
    let what = if folder.exists() { "write to" } else { "make" };
    let mut folders = folder.ancestors().filter(|it| !it.as_os_str().is_empty());
    let nearest = folders.find(|it| it.exists()).unwrap_or(Path::new("."));
    try_to_write(&nearest.join("output"))
        .with_context(|| format!("cannot {what} the folder `{shown}`"))
}

/// Refuses a file for results that one of the `inputs` was read from: it would be lost.
fn refuse_overwriting<'a>(
    option: &str,
    path: &Path,
    inputs: impl IntoIterator<Item = &'a PathBuf>,
) -> anyhow::Result<()> {
    if inputs.into_iter().any(|input| is_same(input, path)) {
        anyhow::bail!(
            "`{option} {}`: that file is read, and would be lost; name another one",
            foreign::path(path)
        );
    }
    Ok(())
}

/// The output folder of a field; see [`validate_output`].
fn output_folder(given: Option<&Path>, name: &str) -> anyhow::Result<PathBuf> {
    let own = name.trim_start_matches('.');
    let own = if own.is_empty() { "field" } else { own };
    let folder = given.map_or_else(|| Path::new("target/mms").join(own), Path::to_owned);
    validate_output(&folder)?;
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::examples::EXAMPLES;
    use super::*;

    #[test]
    fn every_command_has_two_examples_that_it_understands() {
        let command = Arguments::command();
        let all: BTreeSet<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        let named: BTreeSet<&str> = EXAMPLES.iter().map(|(name, _)| *name).collect();
        assert_eq!(named, all);
        for (name, examples) in EXAMPLES {
            for example in examples {
                let words: Vec<OsString> =
                    example.split(' ').map(|word| word.trim_matches('"').into()).collect();
                assert_eq!(words[1], name, "{example}");
                assert!(parse(&words).is_ok(), "{example}");
            }
        }
    }

    #[test]
    fn every_command_is_in_one_group_of_the_help() {
        let command = Arguments::command();
        let all: BTreeSet<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        let grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        let mut once: BTreeSet<&str> = grouped.iter().copied().collect();
        assert_eq!(once.len(), grouped.len());
        once.remove("help");
        assert_eq!(once, all);
    }
}
