//! Output to the terminal: escapes foreign texts, so that they cannot steer the terminal.

use std::io::{self, ErrorKind, Write as _};

use mms_spec::foreign;

/// Prints one JSON document.
pub(crate) fn print_json(document: &impl serde::Serialize) -> anyhow::Result<()> {
    print_shown(&foreign::json(&serde_json::to_string_pretty(document)?))
}

/// Says a line on stderr, in which nothing steers the terminal. Where it cannot be written, the work goes on without it.
pub(crate) fn say(line: impl std::fmt::Display) {
    say_styled(&foreign::lines(&line.to_string()));
}

/// Says a line on stderr that steers the terminal where it means to, and holds nothing foreign that is not shown.
pub(crate) fn say_styled(line: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{line}");
}

/// Prints a text to stdout, in which nothing steers the terminal.
pub(crate) fn print(text: &str) -> anyhow::Result<()> {
    print_shown(&foreign::lines(text))
}

pub(crate) fn print_shown(text: &str) -> anyhow::Result<()> {
    let mut stdout = anstream::stdout().lock();
    printed_to_the_end(writeln!(stdout, "{}", text.trim_end()).and_then(|()| stdout.flush()))
}

/// A reader that stopped reading is not an error of ours.
pub(crate) fn printed_to_the_end(printed: io::Result<()>) -> anyhow::Result<()> {
    match printed {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(anyhow::Error::new(error).context("cannot write to stdout"))
        }
        _ => Ok(()),
    }
}
