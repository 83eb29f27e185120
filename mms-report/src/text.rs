//! Sentences that reports share.

/// How many of all verdicts are not as expected; `expected` is how to say that, as in "as theory expects".
pub fn tally(unexpected: usize, all: usize, expected: &str) -> String {
    match (unexpected, all) {
        (0, 1) => format!("the verdict is {expected}"),
        (_, 1) => format!("the verdict is not {expected}"),
        (0, all) => format!("all {all} verdicts are {expected}"),
        (1, all) => format!("1 of {all} verdicts is not {expected}"),
        (several, all) => format!("{several} of {all} verdicts are not {expected}"),
    }
}
