//! Sentences that reports share.

use mms_files::shell;

/// The line with the command to type next, if there is one.
pub fn next(words: Option<&Vec<String>>) -> Option<String> {
    words.map(|words| match words.first().is_some_and(|it| it == "mms") {
        true => format!("next: {}", shell::command(&words[1..])),
        false => {
            let words = words.iter().map(|it| shell::quoted(it));
            format!("next: {}", words.collect::<Vec<_>>().join(" "))
        }
    })
}

/// The number of unexpected verdicts among all; `expected` is the phrase for an expected one, as in "as theory expects".
pub fn tally(unexpected: usize, all: usize, expected: &str) -> String {
    match (unexpected, all) {
        (0, 1) => format!("the verdict is {expected}"),
        (_, 1) => format!("the verdict is not {expected}"),
        (0, all) => format!("all {all} verdicts are {expected}"),
        (1, all) => format!("1 of {all} verdicts is not {expected}"),
        (several, all) => format!("{several} of {all} verdicts are not {expected}"),
    }
}
