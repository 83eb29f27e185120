//! Runs of small programs: how they end, and what is kept of them.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use mms_campaign::process::{Ended, Folder, Order, STDERR, STDOUT};

/// Runs a script of the shell, which is the program here.
fn run_with(folder: &Folder, script: &str, limit: f64, stop: &dyn Fn() -> bool) -> Ended {
    let words = ["sh", "-c", script, "name", "it's \"$HOME\" *"].map(str::to_owned);
    let order = Order {
        words: &words,
        directory: &folder.path,
        variables: &[("OMP_NUM_THREADS", "3".to_owned())],
        limit: Duration::from_secs_f64(limit),
    };
    folder.run(&order, stop).expect("it is run")
}

fn run(folder: &Folder, script: &str) -> Ended {
    run_with(folder, script, 20.0, &|| false)
}

fn text(folder: &Folder, name: &str) -> String {
    fs::read_to_string(folder.path.join(name)).expect("a file")
}

#[test]
fn what_is_printed_is_kept_and_words_are_words() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let script = r#"echo "$1"; echo $OMP_NUM_THREADS; pwd; echo no >&2"#;
    assert_eq!(run(&folder, script), Ended::Well);
    let here = fs::canonicalize(&folder.path).unwrap();
    let printed = text(&folder, STDOUT);
    let lines: Vec<_> = printed.lines().collect();
    assert_eq!(lines[..2], ["it's \"$HOME\" *", "3"]);
    assert_eq!(fs::canonicalize(lines[2]).unwrap(), here);
    assert_eq!(text(&folder, STDERR), "no\n");
}

#[test]
fn a_run_that_fails_says_how() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let badly = |script: &str| match run(&folder, script) {
        Ended::Badly(how) => how,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        badly("for i in 1 2 3 4 5 6 7 8 9; do echo $i >&2; done; exit 7"),
        "it ended with exit code 7"
    );
    assert_eq!(folder.last_words(), ["2", "3", "4", "5", "6", "7", "8", "9"]);
    assert!(badly("echo only; kill -SEGV $$").contains("signal: 11"));
    assert_eq!(folder.last_words().last().map(String::as_str), Some("only"));
    let words = ["./no such program".to_owned()];
    let limit = Duration::from_secs(1);
    let order = Order { words: &words, directory: &folder.path, variables: &[], limit };
    match folder.run(&order, &|| false).unwrap() {
        Ended::Badly(how) => {
            assert!(how.starts_with("`./no such program` cannot be started"), "{how}")
        }
        other => panic!("{other:?}"),
    }
}

/// A program that has started another one, and does not end when it is asked to.
const STUBBORN: &str = "trap '' TERM; sleep 60 & echo $!; wait; wait; sleep 60";

/// Whether there is a process of this number that is no zombie.
fn is_there(number: &str) -> bool {
    let state =
        Command::new("ps").args(["-o", "stat=", "-p", number]).stderr(Stdio::null()).output();
    let state = String::from_utf8(state.expect("ps").stdout).expect("a word");
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}

#[test]
fn one_that_takes_too_long_is_ended_with_all_that_it_started() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let started = Instant::now();
    let ended = run_with(&folder, STUBBORN, 0.3, &|| false);
    assert_eq!(ended, Ended::Badly("stopped after 0.3 s, its limit (`time_limit`)".into()));
    assert!(started.elapsed() < Duration::from_secs(15));
    let child = text(&folder, STDOUT);
    // The system may take a moment.
    let gone = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        !is_there(child.trim())
    });
    assert!(gone, "{child} is still there");
}

#[test]
fn somebody_may_interrupt() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let asked = AtomicUsize::new(0);
    let stop = || asked.fetch_add(1, Ordering::Relaxed) > 3;
    assert_eq!(run_with(&folder, "sleep 60", 50.0, &stop), Ended::Interrupted);
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_folder_is_emptied_and_one_in_which_something_writes_is_left_alone() {
    let parent = tempfile::tempdir().unwrap();
    let first = Folder::free(parent.path()).unwrap();
    fs::create_dir(first.path.join("output")).unwrap();
    fs::write(first.path.join("output/old.csv"), "old").unwrap();
    // What the first process has started goes on when that has ended.
    assert_eq!(run(&first, "(sleep 1; echo late) & echo early"), Ended::Well);
    drop(first);
    let second = Folder::free(parent.path()).unwrap();
    assert_eq!(second.path, parent.path().join("2"));
    assert_eq!(names(&parent.path().join("1")), ["output", STDERR, STDOUT]);
    drop(second);
    let free = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(50));
        Folder::free(parent.path()).unwrap().path.ends_with("1")
    });
    assert!(free, "the first folder is never free again");
    assert_eq!(names(&parent.path().join("1")), [STDOUT]);
    assert_eq!(fs::read_to_string(parent.path().join("1").join(STDOUT)).unwrap(), "");
}
