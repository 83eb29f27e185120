//! Texts from files, and names of files: terminals show them without obeying them, and pages show them in their place.

use std::process::{Command, Stdio};

use super::mms::{BAR, Folder, Run};

/// A text that steers a terminal.
const OSC: &str = include_str!("data/osc_title.toml");

/// A text that looks like two lines of `mms check`.
const FORGED: &str = include_str!("data/forged_lines.toml");

/// The line that the title of [`FORGED`] imitates.
const PROOF: &str = "  proof  J > 0: 1 <= J <= 1";

/// A file with every text field that exists, each with an escape, a line break and a mark that turns the direction of writing.
fn everywhere() -> String {
    let evil = r"e\u001b]0;pwned\u0007\u009b2J\u202e\n  proof  J > 0: 1 <= J <= 1";
    let mut text = FORGED.lines().filter(|line| !line.starts_with("title")).collect::<Vec<_>>();
    let head = format!("title = \"{evil}\"\nreference = \"{evil}\"");
    text.insert(1, &head);
    let text =
        text.join("\n").replace("unit = \"m\" }", &format!("unit = \"m\", doc = \"{evil}\" }}"));
    format!(
        "{text}\n[[check]]\nquantity = \"displacement\"\nequals = [\"A*sin(k*X)\"]\nsource = \"{evil}\"\n\
         [[extreme]]\nname = \"{evil}\"\nset = {{ amplitude = 0.01 }}\n\
         [[study]]\ncells = [4, 8]\nreason = \"{evil}\"\n"
    )
}

/// Runs a command as on a terminal, whose output has more than a pipe gets.
fn on_a_terminal(folder: &Folder, arguments: &[&str]) -> Run {
    folder.run_with(arguments, |command| command.env("CLICOLOR_FORCE", "1"))
}

/// Asserts that a run steers the terminal only with our own colours, and forges no line.
fn assert_harmless(run: &Run) {
    for text in [&run.stdout, &run.stderr] {
        let own = |rest: &str| {
            let end = rest.find(|c: char| !c.is_ascii_digit() && c != ';' && c != '[');
            rest.starts_with('[') && end.is_some_and(|end| rest[end..].starts_with('m'))
        };
        assert!(text.split('\u{1b}').skip(1).all(own), "{run}");
        let steers = |c: char| c.is_control() && !"\n\t\u{1b}".contains(c) || c == '\u{202e}';
        assert!(!text.contains(steers), "{run}");
        assert!(!text.lines().any(|line| line.starts_with(PROOF)), "{run}");
    }
}

#[test]
fn titles_are_shown_on_one_line_and_steer_nothing() {
    let folder = Folder::new();
    folder.write("osc.toml", OSC);
    folder.write("forged.toml", FORGED);
    let run = on_a_terminal(&folder, &["check", "osc.toml"]).exits(0);
    run.prints(r"osc.toml: x\u{1b}]0;pwned\u{7}\u{1b}[2J");
    assert_harmless(&run);
    let run = folder.mms("check forged.toml").exits(0);
    run.prints(r"forged.toml: T\n  proof  J > 0");
    assert_harmless(&run);
    assert_eq!(run.stdout.matches("\n  proof  J > 0").count(), 1, "its own: {run}");
}

#[test]
fn no_text_of_a_file_gets_through_any_command() {
    let folder = Folder::new();
    folder.write("evil.toml", &everywhere());
    for arguments in [
        "check evil.toml",
        "check evil.toml --json",
        "show evil.toml --quantity displacement",
        "show evil.toml --quantity displacement --json",
        "show evil.toml --quantity displacement --format latex",
        "show evil.toml --quantity displacement --format mathml",
        "show evil.toml --script sympy",
        "eval evil.toml --at 0.3 --time 0 --quantity u",
        "run evil.toml --cells 8",
        "study evil.toml --cells 4,8 --output out",
        "extremes evil.toml --row cells/one --quick",
        "accuracy evil.toml --quantity u --precision f64 --form stable --points 8 --all",
    ] {
        assert_harmless(&on_a_terminal(&folder, &arguments.split(' ').collect::<Vec<_>>()));
    }
    let targets =
        "rust rust-mms-math c cpp fortran python numpy sympy ufl octave julia moose karamelo";
    for target in targets.split(' ') {
        let run = on_a_terminal(&folder, &["emit", "evil.toml", "--target", target, "--json"]);
        assert_harmless(&run.exits(0));
    }
}

/// Messages about mistakes in a file are harmless, too.
#[test]
fn messages_about_a_file_quote_it_harmlessly() {
    let folder = Folder::new();
    let cases = [
        BAR.replace("[field]", "[field]\n\"k\\u001b[2J\\n  proof  J > 0: 1 <= J <= 1\" = 1"),
        BAR.replace(
            "model   = \"neo_hookean\"",
            "model = \"\\u001b[2J\\n  proof  J > 0: 1 <= J <= 1\"",
        ),
        BAR.replace("model   = \"neo_hookean\"", "model = \"./\\u001b[2J\\n.toml\""),
        BAR.replace("(2*length - X)", "(2*length \u{9b}- \u{202e}X)"),
        BAR.replace("[domain]", "[domain] \u{1b}[2J"),
    ];
    for text in cases {
        folder.write("wrong.toml", &text);
        let run = on_a_terminal(&folder, &["check", "wrong.toml"]).exits(2);
        assert_harmless(&run);
        assert_harmless(&on_a_terminal(&folder, &["show", "wrong.toml"]).exits(2));
    }
}

#[test]
#[cfg(unix)]
fn names_of_files_are_shown_as_texts_are() {
    let folder = Folder::new();
    let name = "a\u{1b}[2J\n  proof  J > 0: 1 <= J <= 1.toml";
    for command in
        [&["check"][..], &["show"], &["run", "--cells", "8"], &["emit", "--target", "python"]]
    {
        let arguments = [&command[..1], &[name], &command[1..]].concat();
        assert_harmless(&on_a_terminal(&folder, &arguments).exits(2));
    }
    folder.write(name, BAR);
    for command in [
        &["check"][..],
        &["show"],
        &["run", "--cells", "8"],
        &["study", "--cells", "4,8", "--output", "out"],
    ] {
        let arguments = [&command[..1], &[name], &command[1..]].concat();
        assert_harmless(&on_a_terminal(&folder, &arguments));
    }
    assert_harmless(
        &on_a_terminal(
            &folder,
            &["run", "bar_1d", "--cells", "8", "--history", "no\n  proof  J > 0: 1 <= J <= 1/x"],
        )
        .exits(2),
    );
    assert_harmless(
        &on_a_terminal(&folder, &["no\u{1b}[2J\n  proof  J > 0: 1 <= J <= 1"]).exits(2),
    );
    assert_harmless(
        &on_a_terminal(&folder, &["report", "no\u{1b}[2J\n  proof  J > 0: 1 <= J <= 1"]).exits(2),
    );
    let emitted = on_a_terminal(
        &folder,
        &["emit", "bar_1d", "--target", "c", "-o", "o\u{1b}\n  proof  J > 0: 1 <= J <= 1"],
    );
    assert_harmless(&emitted.exits(0));
}

/// A page has no characters that XML and HTML forbid.
#[test]
fn pages_hold_what_pages_may() {
    let folder = Folder::new();
    folder.write("evil.toml", &everywhere());
    folder.mms("run evil.toml --cells 8 --output all --vtk all --frames 1").exits(0);
    let document = folder.read("all/run.json");
    let evil = r#""field": "e\u0001\u009b\ufffe\u202e<script>","#;
    folder.write("all/other.json", &document.replace("\"field\": \"evil\",", evil));
    folder.write("all/\u{1b}\u{1}.json", "{");
    assert_harmless(&on_a_terminal(&folder, &["report", "all"]).exits(0));
    let page = folder.read("all/report.html");
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    roxmltree::Document::parse_with_options(&page, options).expect("XML");
    assert!(page.contains("e&lt;script&gt;"), "{page}");
    assert!(
        !page.contains(|c: char| c.is_control() && c != '\n' || "\u{fffe}\u{202e}".contains(c))
    );
}

/// Printing is part of a command, and a failure to print is an error.
#[test]
#[cfg(target_os = "linux")]
fn what_cannot_be_printed_is_an_error() {
    let folder = Folder::with_bar("bar.toml");
    for arguments in [
        "--help",
        "--version",
        "run --help",
        "help study",
        "list",
        "list --json",
        "schema",
        "check bar.toml",
        "check bar.toml --json",
        "show bar_1d --quantity u",
        "show bar_1d --script sympy",
        "eval bar_1d --at 0.3 --time 0 --quantity u",
        "emit bar_1d --target python",
        "run bar_1d --cells 8",
        "verify --list",
    ] {
        let full = std::fs::File::options().write(true).open("/dev/full").expect("a device");
        let output = Command::new(env!("CARGO_BIN_EXE_mms"))
            .args(arguments.split_whitespace())
            .current_dir(folder.path(""))
            .stdout(full)
            .stderr(Stdio::piped())
            .output()
            .expect("the program starts");
        let said = String::from_utf8(output.stderr).expect("a text");
        assert_eq!(output.status.code(), Some(2), "{arguments}: {said}");
        assert!(said.contains("cannot write to stdout"), "{arguments}: {said}");
    }
}
