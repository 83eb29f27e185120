//! `mms campaign`: when a run counts as done, and which files and processes it may leave.

#![cfg(unix)]

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::mms::{Folder, Run};

const STUDY: &str = "[[study]]\nfield = \"bar_1d\"\ncells = [8]\n";

/// A campaign of one run; its solver gets the folder for results as its last argument.
fn campaign(run: &str, more: &str) -> String {
    let run = serde_json::to_string(run).expect("a text");
    format!("[solver]\nrun = {run}\noutput = \"{{output}}/u.csv\"\n{more}\n{STUDY}")
}

/// A solver that logs its runs in `log.txt` of a folder, and writes u at the end with an error.
fn solver(folder: &Folder, comment: &str) -> String {
    let log = folder.path("log.txt");
    format!(
        "#!/bin/sh\n# {comment}\necho run >> '{}'\nprintf 'X,u\\n0.25,0.0875\\n0.5,0.15\\n0.75,0.1875\\n' > \"$1/u.csv\"\n",
        log.display()
    )
}

fn program(folder: &Folder, name: &str, text: &str) {
    folder.write(name, text);
    fs::set_permissions(folder.path(name), Permissions::from_mode(0o755)).expect("permissions");
}

/// The number of runs that were made.
fn count(folder: &Folder) -> usize {
    fs::read_to_string(folder.path("log.txt")).unwrap_or_default().lines().count()
}

/// Runs a campaign of one run, which is done afterwards; one mesh is not enough for a verdict.
fn done(folder: &Folder, file: &str) -> Run {
    let path =
        format!("{}:{}", folder.path("bin").display(), std::env::var("PATH").expect("a PATH"));
    let run = folder.run_with(&["campaign", file, "--store", "store"], |it| it.env("PATH", path));
    run.prints("1 of 1 runs are done");
    run.exits(1)
}

#[test]
fn a_run_is_made_again_if_what_it_starts_is_another_program() {
    // The command, its working folder, and the file that is really run.
    let cases = [
        ("./solve {output}", "build", "build/solve"),
        ("./solve {output}", "{here}/build", "build/solve"),
        ("build/solve {output}", "", "build/solve"),
        ("./link {output}", "", "build/solve"),
        ("sh solve {output}", "build", "build/solve"),
        ("env A=1 sh solve {output}", "build", "build/solve"),
        ("sh -c './solve {output} 2> log' ", "build", "build/solve"),
        ("sh -c 'cd build && ./solve {output}'", "", "build/solve"),
        ("sh {here}/build/solve {output}", "{output}", "build/solve"),
        ("own_solver {output}", "", "bin/own_solver"),
        ("env own_solver {output}", "build", "bin/own_solver"),
        ("./script {output}", "", "bin/own_solver"),
    ];
    for (run, directory, file) in cases {
        let folder = Folder::new();
        program(&folder, "build/solve", &solver(&folder, "one"));
        program(&folder, "bin/own_solver", &solver(&folder, "one"));
        program(&folder, "script", "#!/usr/bin/env own_solver\n");
        symlink("build/solve", folder.path("link")).expect("a link");
        // The script is its interpreter's first argument.
        let text = match run.starts_with("./script") {
            true => solver(&folder, "one").replace("$1", "$2"),
            false => solver(&folder, "one"),
        };
        program(&folder, file, &text);
        let more = if directory.is_empty() {
            String::new()
        } else {
            format!("directory = \"{directory}\"")
        };
        folder.write("c.toml", &campaign(run, &more));
        done(&folder, "c.toml");
        done(&folder, "c.toml");
        assert_eq!(count(&folder), 1, "{run}: nothing is done twice");
        program(&folder, file, &text.replace("# one", "# two"));
        done(&folder, "c.toml");
        assert_eq!(count(&folder), 2, "{run} in {directory}: another {file}");
    }
}

/// Two folders with one store: a folder gets only results of the solver in it.
#[test]
fn a_second_checkout_is_judged_by_its_own_solver() {
    for (run, is_shared) in [("./solve {output}", true), ("sh -c '. $0/solve' . {output}", false)] {
        let folder = Folder::new();
        for (checkout, comment) in [("first", "one"), ("second", "two"), ("third", "one")] {
            program(&folder, &format!("{checkout}/build/solve"), &solver(&folder, comment));
            let file = format!("{checkout}/c.toml");
            folder.write(&file, &campaign(run, "directory = \"build\""));
            done(&folder, &file);
        }
        // If the command does not show which file is run, each folder has results of its own.
        assert_eq!(count(&folder), if is_shared { 2 } else { 3 }, "{run}");
    }
}

#[test]
fn a_solver_that_changes_while_it_runs_has_no_result() {
    let folder = Folder::new();
    program(&folder, "solve", &format!("{}echo '# more' >> \"$0\"\n", solver(&folder, "one")));
    folder.write("c.toml", &campaign("./solve {output}", ""));
    let run = folder.mms("campaign c.toml").exits(3);
    run.prints("bar_1d/1 failed: `solve` changed during the run").prints("0 of 1 runs are done");
}

#[test]
fn sources_have_a_bound() {
    let folder = Folder::new();
    folder.write("c.toml", &campaign("./solve {output}", "sources = [\"/**/*\"]"));
    let run = folder.mms("campaign c.toml --dry-run").exits(2);
    run.complains("c.toml:4:12").complains("name a folder nearer to the sources, as in");
}

#[test]
fn empty_and_cut_results_are_not_done() {
    for (first, why) in [
        (": > \"$2/u.vtu\"", "u.vtu` is empty"),
        ("head -c 3000 \"$1\" > \"$2/u.vtu\"", "it ended well, but "),
        ("echo > \"$2/u.vtu\"", "it ended well, but "),
    ] {
        let folder = Folder::new();
        let rest = "if [ -e once ]; then cp \"$1\" \"$2/u.vtu\"; else touch once; CUT; fi";
        folder.write("solve.sh", &format!("echo run >> log.txt\n{}\n", rest.replace("CUT", first)));
        let text = campaign("sh solve.sh {state} {output}", "");
        folder.write("c.toml", &text.replace("u.csv", "u.vtu"));
        let run = folder.mms("campaign c.toml --store store").exits(3);
        run.prints("0 of 1 runs are done").prints(why);
        done(&folder, "c.toml");
        done(&folder, "c.toml");
        assert_eq!(count(&folder), 2, "{first}");
    }
}

/// A table that was cut is still a table, but one program ends all of its tables in the same way.
#[test]
fn a_table_that_is_cut_within_a_line_is_not_done() {
    for (end, first, second) in [("\\n", 3, 0), ("", 0, 0)] {
        let folder = Folder::new();
        let rows = "for (i = 0; i < n; i++) { X = (i + 0.5)/n; printf \"\\n%.9f,%.9f\", X, 0.2*X*(2 - X) + 0.1/n^2 }";
        let awk = format!(
            "awk -v n=$2 'BEGIN {{ printf \"X,u\"; {rows}; printf \"{end}\" }}' > \"$1/u.csv\"\n"
        );
        let cut =
            "if [ $2 = 32 ] && [ ! -e once ]; then touch once; truncate -s CUT \"$1/u.csv\"; fi\n";
        // Without line breaks at the ends a cut cannot be detected, and nothing counts as cut.
        let cut = if end.is_empty() { "" } else { &cut.replace("CUT", "-5") };
        folder.write("solve.sh", &format!("echo run >> log.txt\n{awk}{cut}"));
        let text = campaign("sh solve.sh {output} {cells}", "").replace("[8]", "[8, 16, 32]");
        folder.write("c.toml", &text);
        let run = folder.mms("campaign c.toml --store store").exits(first);
        if first == 3 {
            run.prints("u.csv` ends within a line, and tables of other levels do not: it is cut");
            run.prints("bar_1d/3 failed").prints("2 of 3 runs are done");
        }
        let run = folder.mms("campaign c.toml --store store").exits(second);
        run.prints("3 of 3 runs are done; 1 of 1 studies pass");
        assert_eq!(count(&folder), if first == 3 { 4 } else { 3 });
    }
}

#[test]
fn a_result_that_was_changed_after_its_run_is_noticed() {
    let folder = Folder::new();
    program(&folder, "solve", &solver(&folder, "one"));
    folder.write("c.toml", &campaign("./solve {output}", ""));
    done(&folder, "c.toml");
    let result = result(&folder, "u.csv");
    let text = fs::read_to_string(&result).expect("a result");
    // As long as before.
    fs::write(&result, text.replace("0.15", "0.16")).expect("written");
    let run = done(&folder, "c.toml");
    run.complains("is not trusted: `")
        .complains("output/u.csv` has changed since the run; it is now `");
    assert_eq!((count(&folder), fs::read_to_string(&result).expect("a result")), (2, text));
    // A folder with results may have additional files.
    folder.write("c.toml", &campaign("./solve {output}", "").replace("/u.csv", ""));
    done(&folder, "c.toml");
    done(&folder, "c.toml");
    assert_eq!(count(&folder), 3);
    let second = result_folders(&folder).into_iter().find(|it| !result.starts_with(it));
    fs::write(second.expect("a folder").join("v.csv"), "X,u\n0.5,0.15\n").expect("written");
    done(&folder, "c.toml").complains("output/v.csv` has changed since the run");
    assert_eq!(count(&folder), 4);
}

/// The folders of results below the store.
fn result_folders(folder: &Folder) -> Vec<PathBuf> {
    let found = Command::new("find").arg(folder.path("store")).args(["-name", "output"]).output();
    let found = String::from_utf8(found.expect("find").stdout).expect("UTF-8");
    found.lines().map(PathBuf::from).collect()
}

/// The one file of this name below the store.
fn result(folder: &Folder, name: &str) -> PathBuf {
    let found = Command::new("find").arg(folder.path("store")).args(["-name", name]).output();
    let found = String::from_utf8(found.expect("find").stdout).expect("UTF-8");
    assert_eq!(found.lines().count(), 1, "{found}");
    PathBuf::from(found.trim_end())
}

/// Whether there is a process of this number that is not a zombie.
fn is_there(number: &str) -> bool {
    let state = Command::new("ps").args(["-o", "stat=", "-p", number.trim()]).output();
    let state = String::from_utf8(state.expect("ps").stdout).expect("a word");
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}

/// Waits until a condition holds, for as long as a test may take.
fn wait_until(what: impl Fn() -> bool) {
    while !what() {
        sleep(Duration::from_millis(10));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn processes_that_a_solver_leaves_behind_are_ended_and_named() {
    let folder = Folder::new();
    let text = solver(&folder, "one")
        + "(setsid sleep 1000 > /dev/null 2>&1 & echo $! > left) &\nuntil [ -s left ]; do sleep 0.01; done\n";
    program(&folder, "solve", &text);
    folder.write("c.toml", &campaign("./solve {output}", ""));
    let run = done(&folder, "c.toml");
    run.prints("bar_1d/1 left processes behind, which were ended: sleep\n");
    run.complains("; it left processes behind, which were ended: sleep\n");
    assert!(!is_there(&folder.read("left")));
    let document = folder.mms("campaign c.toml --store store --json").exits(1).json();
    assert_eq!(document["studies"][0]["runs"][0]["left_behind"], serde_json::json!(["sleep"]));
}

/// A solver that starts another process, in a session of its own, and waits; the numbers of both are in `left`.
fn waiting(folder: &Folder) -> Child {
    program(
        folder,
        "solve",
        "#!/bin/sh\nsetsid sleep 1000 > /dev/null 2>&1 &\necho $$ $! > part; mv part left\nwait\n",
    );
    folder.write("c.toml", &campaign("./solve {output}", ""));
    let mut command = Command::new(env!("CARGO_BIN_EXE_mms"));
    command.args(["campaign", "c.toml", "--store", "store"]).current_dir(folder.path(""));
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    wait_until(|| folder.path("left").exists());
    child
}

#[test]
#[cfg(target_os = "linux")]
fn whatever_ends_a_campaign_ends_its_processes() {
    for (signal, code) in
        [("-QUIT", Some(3)), ("-INT", Some(3)), ("-TERM", Some(3)), ("-KILL", None)]
    {
        let folder = Folder::new();
        let mut child = waiting(&folder);
        let status = Command::new("kill").args([signal, &child.id().to_string()]).status();
        assert!(status.expect("kill").success());
        assert_eq!(child.wait().expect("it ends").code(), code, "{signal}");
        for number in folder.read("left").split_whitespace() {
            match code {
                Some(_) => assert!(!is_there(number), "{signal}: {number} is still there"),
                // Afterwards only its supervisor is left.
                None => wait_until(|| !is_there(number)),
            }
        }
        // The next campaign waits for the supervisor, and then uses the folder.
        program(&folder, "solve", &solver(&folder, "one"));
        done(&folder, "c.toml");
        assert!(result(&folder, "u.csv").ends_with("1/output/u.csv"));
        assert!(!fs::read_dir(folder.path("store")).expect("a store").any(|it| {
            it.expect("an entry").path().extension().is_some_and(|end| end == "lock")
        }));
    }
}

/// With `nohup` a campaign outlives its terminal.
#[test]
#[cfg(target_os = "linux")]
fn a_campaign_that_ignores_the_end_of_its_terminal_goes_on() {
    let folder = Folder::new();
    program(
        &folder,
        "solve",
        &format!("kill -HUP $(cat number) $PPID\n{}", solver(&folder, "one")),
    );
    folder.write("c.toml", &campaign("sh ./solve {output}", ""));
    let script = "trap '' HUP; echo $$ > number; exec \"$0\" campaign c.toml";
    let program = env!("CARGO_BIN_EXE_mms");
    let ended =
        Command::new("sh").args(["-c", script, program]).current_dir(folder.path("")).output();
    let ended = ended.expect("a shell");
    assert_eq!(ended.status.code(), Some(1), "{}", String::from_utf8_lossy(&ended.stderr));
    assert!(String::from_utf8_lossy(&ended.stdout).contains("1 of 1 runs are done"));
}

/// If the supervisor is killed too, its solver goes on alone in its folder, which no other run gets.
#[test]
fn a_run_that_is_left_over_shares_no_folder_with_its_successor() {
    let folder = Folder::new();
    let left_over = "exec > /dev/null 2>&1\necho $$ > left\nkill -KILL $PPID\n\
                     while :; do echo X,u > \"$1/u.csv\"; sleep 0.01; done\n";
    let text =
        format!("#!/bin/sh\nif [ ! -e left ]; then\n{left_over}fi\n{}", solver(&folder, "one"));
    program(&folder, "solve", &text);
    folder.write("c.toml", &campaign("./solve {output}", ""));
    let run = folder.mms("campaign c.toml --store store").exits(3);
    run.prints("bar_1d/1 failed: its supervisor ended first: signal: 9");
    assert!(is_there(&folder.read("left")));
    let document = done(&folder, "c.toml");
    document.prints("1 of 1 runs are done");
    let again = folder.mms("campaign c.toml --store store --json").exits(1).json();
    let used = again["studies"][0]["runs"][0]["folder"].as_str().expect("a folder").to_owned();
    assert!(used.ends_with("/2"), "{used}");
    let number = folder.read("left");
    assert!(is_there(&number), "it is at work, and changes nothing");
    assert!(Command::new("kill").args(["-KILL", number.trim()]).status().expect("kill").success());
}

#[test]
fn columns_and_profiles_name_the_arrays_of_a_solver() {
    let folder = Folder::new();
    let values = "0.25,0.0875\\n0.5,0.15\\n0.75,0.1875\\n";
    program(&folder, "bare", &format!("#!/bin/sh\nprintf '{values}' > \"$1/u.csv\"\n"));
    program(&folder, "odd", &format!("#!/bin/sh\nprintf 'p,q\\n{values}' > \"$1/u.csv\"\n"));
    folder.write("own.toml", "source = 'a test'\n[quantities]\nX = 'p'\nu = 'q'\n");
    for (solver, keys) in [("bare", "columns = [\"X\", \"u\"]"), ("odd", "from = \"./own.toml\"")] {
        let text = campaign(&format!("./{solver} {{output}}"), "");
        folder.write("c.toml", &format!("{text}{keys}\n"));
        done(&folder, "c.toml").prints("norms of u");
        folder.write("c.toml", &text);
        let run = folder.run(&["campaign", "c.toml", "--store", "other"]);
        assert!(!run.stdout.contains("norms of u"), "{run}");
    }
    let text = campaign("./odd {output}", "");
    for (key, said) in [
        ("from = \"nobody\"", "no profile of that name"),
        ("over = \"lines\"", "expected points or cells"),
    ] {
        folder.write("c.toml", &format!("{text}{key}\n"));
        let run = folder.run(&["campaign", "c.toml"]).exits(2);
        run.complains(said).complains("c.toml:8:");
    }
}
