//! The page of the languages: its programs, built and run.

use std::fs;
use std::path::Path;

use mms_emit::Subject;

use super::build::{can_build, ports, scratch, shell, write};
use super::gallery::field;

/// The blocks of a section of the page, each with its language.
fn blocks<'a>(page: &'a str, section: &str) -> Vec<(&'a str, &'a str)> {
    let (_, rest) = page
        .split_once(&format!("\n## {section}\n"))
        .unwrap_or_else(|| panic!("docs/targets.md has no section `{section}`"));
    let section = rest.split("\n## ").next().unwrap_or(rest);
    let fenced = section.split("```").skip(1).step_by(2);
    fenced.map(|block| block.split_once('\n').expect("a language and a text")).collect()
}

#[test]
fn ten_lines_lead_to_the_first_number_in_every_language() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/targets.md");
    let page = fs::read_to_string(page).expect("the page");
    let bar = field("bar_1d");
    let bar = Subject::new(&bar);
    for target in ports() {
        let blocks = blocks(&page, target.name);
        let [(_, emit), (_, program), (_, build)] = blocks[..] else {
            panic!("{}: expected a command, a program and a command", target.name)
        };
        let expected = format!("$ mms emit bar_1d --target {} --output forcing\n", target.name);
        assert_eq!(emit, expected);
        if !can_build(target) {
            continue;
        }
        let folder = scratch(&format!("page/{}", target.name));
        write(&(target.emit)(&bar), &folder);
        let first = program.lines().next().expect("a line");
        let name = first.split(' ').find(|word| word.starts_with("first.")).expect("its name");
        fs::write(folder.join(name), program).expect("a written file");
        let run = shell(build.trim_start_matches("$ ").trim(), &folder);
        let [out, err] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text));
        assert_eq!(err.trim(), "", "{}", target.name);
        if target.name == "karamelo" {
            // In single precision.
            let found: f64 = out.trim().parse().expect("a number");
            let expected: f64 = B.parse().expect("a number");
            assert!((found - expected).abs() < 1e-6 * expected.abs(), "{found}");
            continue;
        }
        assert_eq!(out.trim(), B, "{}", target.name);
    }
}

/// b of the bar at X = 0.37 and t = 0.013: by hand, in `tests/hand/bar_1d.rs`, and by `mms eval`.
const B: &str = "-224.849959";
