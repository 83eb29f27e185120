//! Runs of small programs: how they end, and which output is kept.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use mms_campaign::printed::{HEAD, TAIL};
use mms_campaign::process::{Folder, Launch};
use mms_campaign::supervisor::{Ended, RUNNING, Report, STDERR, STDOUT};

/// Runs a command in its folder.
fn run_words(folder: &Folder, words: &[String], limit: f64, stop: &dyn Fn() -> bool) -> Report {
    let launch = Launch {
        supervisor: &[env!("CARGO_BIN_EXE_supervise").into()],
        words,
        directory: &folder.path,
        variables: &[("OMP_NUM_THREADS", "3".to_owned())],
        limit: Duration::from_secs_f64(limit),
    };
    folder.run(&launch, stop).expect("it is run")
}

/// Runs a shell script.
fn run_with(folder: &Folder, script: &str, limit: f64, stop: &dyn Fn() -> bool) -> Report {
    let words = ["sh", "-c", script, "name", "it's \"$HOME\" *"].map(str::to_owned);
    run_words(folder, &words, limit, stop)
}

/// The end of a script that leaves no processes behind.
fn run(folder: &Folder, script: &str) -> Ended {
    let report = run_with(folder, script, 20.0, &|| false);
    assert_eq!(report.left_behind, [""; 0], "{script}");
    report.ended
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
    for words in [vec!["./no such program".to_owned()], vec!["no such program".to_owned()]] {
        match run_words(&folder, &words, 20.0, &|| false).ended {
            Ended::Badly(how) => {
                assert!(how.starts_with(&format!("`{}` cannot be started", words[0])), "{how}")
            }
            other => panic!("{other:?}"),
        }
    }
}

/// A program that has started another one, and ignores the signal to end.
const STUBBORN: &str = "trap '' TERM; sleep 60 & echo $!; wait; wait; sleep 60";

/// Whether a process of this number exists and is no zombie.
fn is_there(number: &str) -> bool {
    let state =
        Command::new("ps").args(["-o", "stat=", "-p", number]).stderr(Stdio::null()).output();
    let state = String::from_utf8(state.expect("ps").stdout).expect("a word");
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}

/// Waits until no process of this number exists.
fn assert_gone(number: &str) {
    // The system may need a moment.
    let gone = (0..200).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        !is_there(number.trim())
    });
    assert!(gone, "{number} is still there");
}

#[test]
fn one_that_takes_too_long_is_ended_with_all_that_it_started() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let started = Instant::now();
    let ended = run_with(&folder, STUBBORN, 0.3, &|| false).ended;
    assert_eq!(ended, Ended::Badly("stopped after 0.3 s, its limit (`time_limit`)".into()));
    assert!(started.elapsed() < Duration::from_secs(15));
    assert_gone(&text(&folder, STDOUT));
}

#[test]
fn somebody_may_interrupt() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let asked = AtomicUsize::new(0);
    let stop = || asked.fetch_add(1, Ordering::Relaxed) > 3;
    assert_eq!(run_with(&folder, "sleep 60", 50.0, &stop).ended, Ended::Interrupted);
}

/// The process has its own session, no parent, and no file of the run.
#[test]
#[cfg(target_os = "linux")]
fn a_process_that_is_left_behind_is_ended_and_named() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let script = "(env -i setsid sleep 60 > /dev/null 2>&1 < /dev/null & echo $! > left) &
        until [ -s left ]; do sleep 0.01; done; echo done";
    let report = run_with(&folder, script, 20.0, &|| false);
    assert_eq!((report.ended, report.left_behind), (Ended::Well, vec!["sleep".to_owned()]));
    assert_gone(&text(&folder, "left"));
    assert_eq!(text(&folder, STDOUT), "done\n");
}

#[test]
fn what_is_printed_has_a_bound_and_its_end_is_kept() {
    let parent = tempfile::tempdir().unwrap();
    let folder = Folder::free(parent.path()).unwrap();
    let surplus = 1_000_000;
    let count = HEAD as usize + TAIL + surplus;
    let script = format!("echo first; head -c {count} /dev/zero; echo; echo last");
    assert_eq!(run(&folder, &script), Ended::Well);
    let printed = fs::read(folder.path.join(STDOUT)).unwrap();
    let note = format!("\n[{} bytes are left out here]\n", surplus + "first\n\nlast\n".len());
    assert_eq!(printed.len(), HEAD as usize + TAIL + note.len());
    assert!(printed.starts_with(b"first\n\0") && printed.ends_with(b"\0\nlast\n"));
    assert_eq!(&printed[HEAD as usize..HEAD as usize + note.len()], note.as_bytes());
    assert_eq!(folder.last_words().last().map(String::as_str), Some("last"));
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_folder_is_emptied_for_the_next_run() {
    let parent = tempfile::tempdir().unwrap();
    let first = Folder::free(parent.path()).unwrap();
    fs::create_dir(first.path.join("output")).unwrap();
    fs::write(first.path.join("output/old.csv"), "old").unwrap();
    assert_eq!(run(&first, "echo early"), Ended::Well);
    assert_eq!(names(&first.path), ["output", RUNNING, STDERR, STDOUT]);
    drop(first);
    assert_eq!(names(&parent.path().join("1")), ["output", STDERR, STDOUT]);
    let second = Folder::free(parent.path()).unwrap();
    assert_eq!(
        (second.path.clone(), names(&second.path)),
        (parent.path().join("1"), vec![RUNNING.to_owned()])
    );
}

/// A run whose supervisor was killed goes on: its folder is not reused.
#[test]
fn a_folder_in_which_something_may_still_write_is_left_alone() {
    let parent = tempfile::tempdir().unwrap();
    let first = Folder::free(parent.path()).unwrap();
    let report =
        run_with(&first, "kill -KILL $PPID; echo $$ > own; exec sleep 60", 20.0, &|| false);
    match &report.ended {
        Ended::Badly(how) => assert!(how.contains("signal: 9"), "{how}"),
        other => panic!("{other:?}"),
    }
    let own = first.path.join("own");
    while fs::read_to_string(&own).unwrap_or_default().is_empty() {
        std::thread::sleep(Duration::from_millis(10));
    }
    drop(first);
    for _ in 0..2 {
        let second = Folder::free(parent.path()).unwrap();
        assert_eq!(second.path, parent.path().join("2"));
    }
    assert!(own.is_file());
    let number = fs::read_to_string(own).unwrap();
    assert!(Command::new("kill").arg(number.trim()).status().expect("kill").success());
}
