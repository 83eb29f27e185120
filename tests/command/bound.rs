//! The bound on the size of a derivation: it is stated, can be set, and names its cause.

use super::mms::{BAR, Folder};

/// A bar whose definition `A` is a product of `count` waves, with a large derivative.
fn waves(count: usize) -> Folder {
    let waves: Vec<_> = (1..=count).map(|k| format!("cos({k}*c*pi*t/length + X/length)")).collect();
    let text = BAR.replace("cos(c*pi*t/length)\"", &format!("({})\"", waves.join("*")));
    assert_ne!(text, BAR);
    let text = text.replace("x_max = \"free\"", "x_max = \"traction\"");
    let folder = Folder::new();
    folder.write("waves.toml", &text[..text.find("[[check]]").expect("a check")]);
    folder
}

#[test]
fn every_command_that_compiles_a_field_states_and_takes_the_bound() {
    let folder = Folder::with_bar("bar.toml");
    for command in ["check", "show", "eval", "study"] {
        let help = folder.mms(&format!("{command} --help")).exits(0);
        help.prints("--max-nodes <N>").prints("[default: 200000]");
    }
    for command in ["check bar.toml", "show bar.toml", "eval bar.toml --at 1 --time 0"] {
        folder.mms(&format!("{command} --max-nodes 100000")).exits(0);
        folder.mms(&format!("{command} --max-nodes 100")).exits(2).complains("too large");
    }
    folder.mms("study bar.toml --max-nodes 100").exits(2).complains("too large");
    folder.mms("show bar_1d --max-nodes 100").exits(2).complains("too large");
    for wrong in ["many", "1e5", "99999999999"] {
        folder.mms(&format!("show bar_1d --max-nodes {wrong}")).exits(2).complains("--max-nodes");
    }
}

#[test]
fn what_is_too_large_is_named_with_its_cause_and_the_way_out() {
    let folder = waves(12);
    let run = folder.mms("check waves.toml --max-nodes 4000").exits(2);
    run.complains("of this field is too large").complains("in `A`");
    run.complains("nodes with").complains("the bound is 4000 of both");
    run.complains("--max-nodes N");
    // The position points to the product, not to the whole definition.
    let document = folder.mms("check waves.toml --max-nodes 4000 --json").exits(2).json();
    let found = &document["files"][0]["diagnostics"][0];
    let index = |key: &str| found[key].as_u64().expect("a position") as usize - 1;
    let text = folder.read("waves.toml");
    let line = text.lines().nth(index("line")).expect("a line");
    assert!(line[index("column")..].starts_with("cos(1*c*pi"), "{found}");
    folder.mms("check waves.toml").exits(0);
}
