//! `mms campaign --canary`, and the output of a campaign for continuous integration: JUnit XML and a summary in Markdown.

#![cfg(unix)]

use super::mms::{Folder, Run};

/// At the end of its window the bar has u = 0.2 X (2 - X). The script multiplies this by $4, and adds C h^$3.
const SOLVER: &str = r#"[ "$3" = x ] && { echo "no licence" >&2; exit 3; }
awk -v n="$2" -v p="$3" -v f="$4" 'BEGIN {
    print "X,u"
    for (i = 0; i < n; i++) { X = (i + 0.5) / n; printf "%.17g,%.17g\n", X, f * 0.2 * X * (2 - X) + 0.1 / n ^ p }
}' > "$1/u.csv"
"#;

/// Runs the campaign of a solver with these words after its meshes.
fn campaign(folder: &Folder, words: &str, more: &str, options: &str) -> Run {
    folder.write("solve.sh", SOLVER);
    let text = format!(
        "[solver]\nname = \"a <small> solver\"\nrun = \"sh solve.sh {{output}} {{cells}} {words}\"\noutput = \"{{output}}/u.csv\"\n{more}\n\
         [[study]]\nfield = \"bar_1d\"\ncells = [8, 16, 32]\n"
    );
    folder.write("c.toml", &text);
    folder.mms(&format!("campaign c.toml --jobs 2 {options}"))
}

#[test]
fn a_study_fails_with_a_wrong_force_or_measures_nothing() {
    let folder = Folder::new();
    campaign(&folder, "2 {force_factor}", "", "--canary")
        .exits(0)
        .prints("canary: 1 of 1 studies fail with -b in place of b, as all must");
    // Nothing is run twice, and a campaign without canaries finds its own runs.
    let again = campaign(&folder, "2 {force_factor}", "", "--canary --json").exits(0);
    assert_eq!(again.stderr.matches("was done before").count(), 6, "{again}");
    assert_eq!(again.json()["studies"][0]["canary"], "fails");
    let plain = campaign(&folder, "2 {force_factor}", "", "--json").exits(0);
    assert_eq!(plain.stderr.matches("was done before").count(), 3, "{plain}");
    assert!(plain.json()["studies"][0]["canary"].is_null(), "{plain}");
    // This solver gets the factor and ignores it.
    let deaf = campaign(&folder, "2 1 {force_factor}", "", "--canary").exits(1);
    deaf.prints("0 of 1 studies fail").prints("bar_1d passes with -b: it measures nothing");
    assert_eq!(
        campaign(&folder, "2 1 {force_factor}", "", "--canary --json").json()["studies"][0]["canary"],
        "passes"
    );
}

/// The source that `emit` writes for a canary has -b; everything else is unchanged.
#[test]
fn the_emitted_source_of_a_canary_has_the_other_sign() {
    let folder = Folder::new();
    let solver = r#"import sys
sys.path.insert(0, sys.argv[1])
import bar_1d as field
now = field.prepare().at_time(0.0)
sign = 1 if now.body_force(0.5)[0] < 0 else -1
assert now.displacement(0.5)[0] > 0
n = int(sys.argv[2])
with open(sys.argv[3], "w") as out:
    print("X,u", file=out)
    for i in range(n):
        X = (i + 0.5)/n
        print(repr(X), repr(sign*0.2*X*(2 - X) + 0.1/n**2), sep=",", file=out)
"#;
    folder.write("solve.py", solver);
    let text = "[solver]\nrun = \"python3 solve.py {emitted} {cells} {output}/u.csv\"\noutput = \"{output}/u.csv\"\nemit = \"python\"\n\
                [[study]]\nfield = \"bar_1d\"\ncells = [8, 16, 32]\n";
    folder.write("c.toml", text);
    folder
        .mms("campaign c.toml --canary")
        .exits(0)
        .prints("canary: 1 of 1 studies fail with -b in place of b, as all must");
}

#[test]
fn a_solver_with_a_force_of_its_own_is_refused_a_canary() {
    let folder = Folder::new();
    campaign(&folder, "2 1", "", "--canary")
        .exits(2)
        .complains("the solver does not get b from the campaign")
        .complains("{force_factor}");
    campaign(&folder, "2 1", "", "--canary --dry-run").exits(2).complains("cannot be used with");
}

#[test]
fn a_campaign_is_junit_xml_and_a_summary() {
    let folder = Folder::new();
    let cases = |run: &Run| -> Vec<(String, Option<String>)> {
        let document =
            roxmltree::Document::parse(&run.stdout).unwrap_or_else(|it| panic!("{it}: {run}"));
        let suite =
            document.descendants().find(|it| it.has_tag_name("testsuite")).expect("a suite");
        assert_eq!(suite.attribute("name"), Some("a <small> solver"));
        let counted = |tag: &str| {
            document.descendants().filter(|it| it.has_tag_name(tag)).count().to_string()
        };
        assert_eq!(suite.attribute("tests"), Some(counted("testcase").as_str()));
        assert_eq!(suite.attribute("failures"), Some(counted("failure").as_str()));
        assert_eq!(suite.attribute("errors"), Some(counted("error").as_str()));
        let case = |it: roxmltree::Node<'_, '_>| {
            let child = it.children().find(|it| it.is_element());
            let what = child.map(|it| {
                format!("{}: {}", it.tag_name().name(), it.attribute("message").unwrap_or_default())
            });
            (it.attribute("name").expect("a name").to_owned(), what)
        };
        suite.children().filter(|it| it.has_tag_name("testcase")).map(case).collect()
    };
    let passed = campaign(&folder, "2 {force_factor}", "", "--canary --format junit").exits(0);
    assert_eq!(cases(&passed), [("bar_1d".to_owned(), None), ("bar_1d with -b".to_owned(), None)]);
    let deaf =
        cases(&campaign(&folder, "2 1 {force_factor}", "", "--canary --format junit").exits(1));
    assert_eq!(deaf[1].1.as_deref(), Some("failure: it passes with a wrong b"));
    let failed = cases(&campaign(&folder, "1 1", "", "--format junit").exits(1));
    let message = failed[0].1.as_deref().expect("a failure");
    assert!(message.starts_with("failure: fail: observed order 1.00"), "{message}");
    let stopped = cases(&campaign(&folder, "x", "", "--format junit").exits(3));
    assert!(
        stopped[0].1.as_deref().is_some_and(|it| it.starts_with("error: bar_1d/")),
        "{stopped:?}"
    );
    campaign(&folder, "1 1", "", "--format markdown")
        .exits(1)
        .prints("| study | field | expected | observed | of | verdict |")
        .prints("```text\nbar_1d: fail: observed order 1.00");
    folder
        .mms("list --format junit")
        .exits(2)
        .complains("only studies of `mms campaign` are test cases");
}

#[test]
fn a_canary_of_a_study_that_fails_itself_does_not_count() {
    let folder = Folder::new();
    let run = campaign(&folder, "1 {force_factor}", "", "--canary").exits(1);
    run.prints("canary: bar_1d does not count: the study does not pass with the right b either");
    assert!(!run.stdout.contains("as all must"), "{run}");
}

#[test]
fn after_a_crash_the_next_command_shows_what_the_run_printed() {
    let folder = Folder::new();
    let run = campaign(&folder, "x", "", "--store runs").exits(3);
    let next = run.stdout.lines().find_map(|it| it.strip_prefix("next: ")).expect("a command");
    assert!(next.starts_with("tail -n 50 runs/") && next.ends_with("/stderr.txt"), "{run}");
    assert_eq!(folder.types(next).stdout, "no licence\n");
}
