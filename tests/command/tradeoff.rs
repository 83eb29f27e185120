//! `mms tradeoff`: its recommendation achieves the promised error.

use serde_json::Value;

use super::mms::{BAR, Folder, assert_close, keys};

/// The document of a search that decides in the same way on every machine.
fn document(folder: &Folder, options: &str) -> Value {
    folder.mms(&format!("tradeoff bar_1d --cost particle-steps --json {options}")).exits(0).json()
}

/// Runs a command of a document; returns its largest error and its particle-steps.
fn run(folder: &Folder, command: &Value) -> (f64, f64) {
    let command = command.as_str().and_then(|command| command.strip_prefix("mms "));
    let run = folder.mms(&format!("{} --json", command.expect("a command"))).exits(0).json();
    let work = run["particles"].as_f64().unwrap() * run["steps"].as_f64().unwrap();
    (run["errors"]["displacement"]["over_time"]["linf"].as_f64().expect("an error"), work)
}

#[test]
fn running_the_recommendation_meets_the_target_for_less() {
    let folder = Folder::new();
    for target in [1e-2, 1e-4] {
        let found = document(&folder, &format!("--target-linf {target}"));
        let choice = &found["choice"];
        let (error, work) = run(&folder, &choice["command"]);
        assert!(error <= target, "{choice:#}");
        assert_eq!(choice["linf"].as_f64(), Some(error));
        assert_eq!(choice["particle_steps"].as_f64(), Some(work));
        // With the predicted number of cells, the default method reaches the target at more than twice the work.
        let cells = found["default"]["cells"].as_f64().unwrap().ceil() + 2.0;
        let default = serde_json::json!(format!("mms run bar_1d --cells {cells}"));
        let (error, default_work) = run(&folder, &default);
        assert!(error <= target && default_work > 2.0 * work, "{error}, {default_work} and {work}");
    }
}

#[test]
fn the_front_is_one_and_holds_the_choice() {
    let folder = Folder::new();
    let found = document(&folder, "--target-linf 1e-3");
    let own = [
        "field",
        "unit",
        "cost",
        "target_linf",
        "budget_seconds",
        "runs",
        "choice",
        "predicted",
        "default",
        "gain",
        "exponent",
        "dominated",
        "next_command",
        "provenance",
    ];
    assert_eq!(keys(&found), own);
    let runs = found["runs"].as_array().expect("runs");
    let point = |run: &Value| Some((run["particle_steps"].as_f64()?, run["linf"].as_f64()?));
    for one in runs {
        let beaten = |other: &Value| match (point(one), point(other)) {
            (Some((work, error)), Some((less, lower))) => {
                less <= work && lower <= error && (less < work || lower < error)
            }
            _ => false,
        };
        if one["front"] == true {
            assert!(!runs.iter().any(beaten), "{one:#}");
        }
        // A run has either an error or a reason.
        assert_ne!(one["linf"].is_null(), one["failure"].is_null(), "{one:#}");
    }
    assert!(
        runs.iter().any(|run| run["command"] == found["choice"]["command"] && run["front"] == true)
    );
    assert!(
        runs.iter().any(|run| run["failure"]
            .as_str()
            .is_some_and(|it| it.contains("above the stable one")))
    );
    // Boxes that neither follow the motion nor stay fixed lose their order, in both formulations.
    let dominated: Vec<_> =
        found["dominated"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    for word in ["updated linear", "updated ugimp", "usl", "pic"] {
        assert!(dominated.contains(&word), "{dominated:?}");
    }
    // Order 2 in one dimension and time: work grows as 1/error.
    assert_close(found["exponent"].as_f64().unwrap(), 1.0, 0.2);
}

/// A search repeated with the same store prints every digit again, also of times.
#[test]
fn a_search_resumes_and_repeats_itself() {
    let folder = Folder::new();
    let search = "tradeoff bar_1d --target-linf 1e-3 --store store";
    let first = folder.mms(search).exits(0);
    let again = folder.mms(search).exits(0);
    assert_eq!(again.stdout, first.stdout);
    assert!(first.stderr.contains("steps done") && again.stderr.is_empty(), "{again}");
    // Half of the results are lost: the others stay as they are.
    let results: Vec<_> =
        std::fs::read_dir(folder.path("store")).unwrap().map(|it| it.unwrap().path()).collect();
    for path in results.iter().step_by(2) {
        std::fs::remove_file(path).unwrap();
    }
    let half = folder.mms(search).exits(0);
    half.complains("steps done").prints("For a largest error of 1e-3 choose ");
    assert!(folder.read("target/mms/bar_1d/tradeoff.svg").contains("Pareto front"));
}

#[test]
fn a_budget_in_seconds_gives_an_error_and_a_command() {
    let folder = Folder::new();
    let found = folder.mms("tradeoff bar_1d --budget-seconds 0.01 --json").exits(0).json();
    assert!(found["choice"]["seconds"].as_f64().is_some_and(|seconds| seconds <= 0.01));
    let (error, _) = run(&folder, &found["choice"]["command"]);
    assert_eq!(found["choice"]["linf"].as_f64(), Some(error));
}

/// Beyond the allowed work the result is a prediction, not a promise.
#[test]
fn a_target_that_is_not_reached_is_said_to_be() {
    let folder = Folder::new();
    let search = "tradeoff bar_1d --cost particle-steps --target-linf 1e-7 --most-work 1e5";
    let text = folder.mms(search).exits(1);
    text.prints("An error of 1e-7 is not reached: the least is ").prints("raise `--most-work`");
    let found = folder.mms(&format!("{search} --json")).exits(1).json();
    assert!(found["choice"].is_null() && found["predicted"]["particle_steps"].as_f64() > Some(1e5));
}

/// No run starts beyond the limit, not even the first, from which all others are predicted.
#[test]
fn no_run_is_begun_that_takes_more_than_it_may() {
    let folder = Folder::new();
    let search = "tradeoff bar_1d --cost particle-steps --store new --most-work";
    let none = folder.mms(&format!("{search} 1 --target-linf 1e-2")).exits(1);
    none.prints("No run was made: each is predicted to take more than 1.0e0 particle-steps");
    assert_eq!(none.stderr, "");
    let found = folder.mms(&format!("{search} 2e4 --target-linf 1e-2 --json")).exits(0).json();
    for run in found["runs"].as_array().expect("runs") {
        assert!(run["particle_steps"].as_f64().is_none_or(|work| work <= 2e4), "{run:#}");
    }
    let run = folder.mms(&format!("{search} 1")).exits(2);
    run.complains("`--most-work 1e0`: the default method").prints_nothing();
}

/// Without an error, a higher cost gains nothing.
#[test]
fn a_field_that_is_met_exactly_is_said_to_be() {
    let folder = Folder::new();
    let (bar, _) = BAR.split_once("[[check]]").expect("a check");
    let (before, line) = bar.split_once("u = [").expect("a displacement");
    let (_, after) = line.split_once('\n').expect("a line");
    folder.write("still.toml", &format!("{before}u = [\"0\"]\n{after}"));
    let search = "tradeoff still.toml --cost particle-steps --target-linf 1e-3 --store store";
    let text = folder.mms(search).exits(0);
    text.prints("make no error: only their cost distinguishes them");
    for wrong in ["0.0 times", "about 0 cells", "Dominated"] {
        assert!(!text.stdout.contains(wrong), "{text}");
    }
    let found = folder.mms(&format!("{search} --json --output all")).exits(0).json();
    assert_eq!(found["choice"]["linf"], 0.0);
    assert!(found["gain"].as_f64().is_some_and(|gain| gain > 0.5), "{found:#}");
    assert_eq!(found["dominated"], Value::Array(Vec::new()));
    folder.mms("report all").exits(0);
    assert!(folder.read("all/report.html").contains("It makes no error"));
}

/// Parameters and motions are given to every run, and are repeated in the command.
#[test]
fn the_field_is_taken_as_it_is_asked_for() {
    let folder = Folder::with_bar("bar.toml");
    let search =
        "tradeoff bar.toml --cost particle-steps --set amplitude=0.05 --target-linf 5e-3 --json";
    let found = folder.mms(search).exits(0).json();
    let command = found["choice"]["command"].as_str().expect("a command");
    assert!(
        command.contains("mms run bar.toml") && command.contains("--set amplitude=0.05"),
        "{command}"
    );
    let (error, _) = run(&folder, &found["choice"]["command"]);
    assert!(error <= 5e-3);
}

#[test]
fn what_makes_no_sense_is_refused_with_the_reason() {
    let folder = Folder::new();
    folder.write("file", "");
    let cases = [
        ("tradeoff", "FIELD"),
        ("tradeoff bar", "no field `bar`"),
        (
            "tradeoff bar_1d --target-linf 0",
            "invalid value '0' for '--target-linf <E>': expected a positive number",
        ),
        ("tradeoff bar_1d --budget-seconds nan", "expected a positive number"),
        ("tradeoff bar_1d --budget-seconds 1 --target-linf 1", "cannot be used with"),
        ("tradeoff bar_1d --budget-seconds 1 --cost memory", "leave out `--cost`"),
        ("tradeoff bar_1d --set amplitud=1", "did you mean `amplitude`?"),
        ("tradeoff bar_1d --output file", "not a folder"),
        ("tradeoff bar_1d --page", "cannot be used with"),
    ];
    for (arguments, reason) in cases {
        folder.mms(arguments).exits(2).complains(reason).prints_nothing();
    }
}

/// The memory of a run does not depend on the runs before it or on its duration.
#[test]
fn the_memory_of_a_run_is_the_same_each_time() {
    let folder = Folder::new();
    let memory = |store: &str| {
        let search = "tradeoff bar_1d --cost particle-steps --most-work 3e4 --json --store";
        let search = format!("{search} {store}");
        let run = folder.mms(&search);
        let runs = run.json()["runs"].as_array().expect("runs").clone();
        let of = |run: &Value| (run["command"].to_string(), run["memory"].to_string());
        runs.iter().map(of).collect::<std::collections::BTreeMap<_, _>>()
    };
    let first = memory("one");
    assert_eq!(memory("other"), first);
    // Half of the results are there: the others have other runs before them.
    let results = std::fs::read_dir(folder.path("other")).expect("a store");
    for path in results.map(|it| it.expect("a file").path()).step_by(2) {
        std::fs::remove_file(path).expect("removed");
    }
    assert_eq!(memory("other"), first);
}
