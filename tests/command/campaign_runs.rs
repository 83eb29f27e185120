//! `mms campaign`: when a run counts as done, and what its processes may leave.

#![cfg(unix)]

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::mms::{Folder, Run};

const STUDY: &str = "[[study]]\nfield = \"bar_1d\"\ncells = [8]\n";

/// A campaign of one run; its solver gets the folder for results behind its words.
fn campaign(run: &str, more: &str) -> String {
    let run = serde_json::to_string(run).expect("a text");
    format!("[solver]\nrun = {run}\noutput = \"{{output}}/u.csv\"\n{more}\n{STUDY}")
}

/// A solver that notes its runs in `log.txt` of a folder, and writes u at the end with an error.
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

/// Runs a campaign of one run, which is then done, but one mesh is not enough for a verdict.
fn done(folder: &Folder, file: &str) -> Run {
    let path =
        format!("{}:{}", folder.path("bin").display(), std::env::var("PATH").expect("a PATH"));
    let run = folder.run_with(&["campaign", file, "--store", "store"], |it| it.env("PATH", path));
    run.prints("1 of 1 runs are done");
    run.exits(1)
}

/// The one file of this name below the store.
fn result(folder: &Folder, name: &str) -> PathBuf {
    let found = Command::new("find").arg(folder.path("store")).args(["-name", name]).output();
    let found = String::from_utf8(found.expect("find").stdout).expect("UTF-8");
    assert_eq!(found.lines().count(), 1, "{found}");
    PathBuf::from(found.trim_end())
}

/// Whether there is a process of this number that is no zombie.
fn is_there(number: &str) -> bool {
    let state = Command::new("ps").args(["-o", "stat=", "-p", number.trim()]).output();
    let state = String::from_utf8(state.expect("ps").stdout).expect("a word");
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}

/// Waits, for as long as a test may take.
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
                // Then its supervisor is alone.
                None => wait_until(|| !is_there(number)),
            }
        }
        // The next one waits for the supervisor, and takes the folder.
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

/// Where even the supervisor is killed, what it left goes on alone: in its folder, which no other run gets.
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
