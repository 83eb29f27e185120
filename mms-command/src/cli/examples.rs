//! Two examples at the start of the help of each command. All run in a folder with errors.csv and campaign.toml.

use clap::Command;

/// The commands in an order in which each finds the files of those before it.
pub const EXAMPLES: [(&str, [&str; 2]); 21] = [
    ("demo", ["mms demo", "mms demo --keep broken"]),
    ("new", ["mms new wave --dimension 1", "mms new ring --dimension 2 --shape annulus"]),
    ("check", ["mms check wave.toml", "mms check bar_1d --explain"]),
    ("show", ["mms show wave.toml", "mms show bar_1d --format latex --fragment"]),
    (
        "eval",
        [
            "mms eval bar_1d --at 0.5 --time 0.01",
            "mms eval wave.toml --at 0.5 --time 0 --quantity b,P --json",
        ],
    ),
    ("list", ["mms list", "mms list --json"]),
    ("schema", ["mms schema", "mms schema --document study"]),
    (
        "emit",
        [
            "mms emit bar_1d --target c --output src",
            "mms emit wave.toml --target fortran --quantity body_force --output src",
        ],
    ),
    (
        "state",
        [
            "mms state bar_1d --cells 8 --time 0.01 --output coarse.csv",
            "mms state bar_1d --cells 16 --time 0.01 --output fine.csv",
        ],
    ),
    ("judge", ["mms judge bar_1d coarse.csv fine.csv", "mms judge --errors errors.csv"]),
    ("diagnose", ["mms diagnose bar_1d coarse.csv fine.csv", "mms diagnose bar_1d --plan"]),
    (
        "campaign",
        ["mms campaign campaign.toml --dry-run", "mms campaign campaign.toml --output verdict"],
    ),
    ("report", ["mms report verdict", "mms report verdict --output page.html"]),
    (
        "plot",
        [
            "mms plot verdict/campaign.json -o orders.pdf",
            "mms plot target/mms/bar_1d/convergence.json -o column.svg --width 85",
        ],
    ),
    ("run", ["mms run bar_1d --cells 64", "mms run wave.toml --cells 16 --vtk states"]),
    ("study", ["mms study wave.toml", "mms study bar_1d --shape cpdi,cpgimp --cells 8,16,32"]),
    ("explain", ["mms explain cpgimp", "mms explain \"dead load\""]),
    ("accuracy", ["mms accuracy bar_1d", "mms accuracy wave.toml --json"]),
    ("verify", ["mms verify --list", "mms verify --row time/leapfrog"]),
    (
        "tradeoff",
        ["mms tradeoff bar_1d --target-linf 1e-3", "mms tradeoff wave.toml --budget-seconds 0.1"],
    ),
    ("extremes", ["mms extremes bar_1d", "mms extremes wave.toml --json"]),
];

/// A command whose help has its examples below the first sentence.
pub fn with_examples(command: Command) -> Command {
    let own = EXAMPLES.iter().find(|(name, _)| *name == command.get_name());
    let Some((_, [first, second])) = own else { return command };
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let long = command.get_long_about().map(ToString::to_string).unwrap_or_default();
    let rest = long.strip_prefix(&about).unwrap_or(&long).trim_start_matches('.').trim_start();
    let text = format!("{about}\n\nExamples:\n  {first}\n  {second}\n\n{rest}");
    command.long_about(text.trim_end().to_owned())
}
