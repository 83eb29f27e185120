//! Destinations of results: links, permissions, files that are not plain, and a stderr that accepts nothing.
#![cfg(unix)]

use std::fs::{self, File, Permissions};
use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _, symlink};
use std::process::{Command, Stdio};
use std::thread;

use super::mms::{BAR, Folder};

/// The run whose history is written; eight cells need 40 steps.
const RUN: &str = "run bar_1d --cells 8";

/// The header of a history, and 40 steps.
const LINES: usize = 41;

#[test]
fn a_link_stays_and_the_file_behind_it_keeps_its_permissions() {
    let folder = Folder::new();
    folder.write("data/old.csv", "old");
    let private = Permissions::from_mode(0o600);
    fs::set_permissions(folder.path("data/old.csv"), private).expect("permissions");
    for (link, target) in [("there.csv", "data/old.csv"), ("nowhere.csv", "data/new.csv")] {
        symlink(target, folder.path(link)).expect("a link");
        folder.mms(&format!("{RUN} --history {link}")).exits(0);
        assert!(folder.path(link).is_symlink(), "{link}");
        assert_eq!(folder.read(target).lines().count(), LINES);
    }
    let mode = |name: &str| fs::metadata(folder.path(name)).expect("a file").permissions().mode();
    assert_eq!(mode("data/old.csv") & 0o777, 0o600);
    assert_ne!(mode("data/new.csv") & 0o777, 0o600, "results are as open as other files");
    assert_eq!(fs::read_dir(folder.path("data")).expect("a folder").count(), 2);
}

/// A link to a file that is read is not an output.
#[test]
fn a_link_to_what_is_read_is_not_written_through() {
    let folder = Folder::with_bar("bar.toml");
    symlink("bar.toml", folder.path("link")).expect("a link");
    let run = folder.mms("run bar.toml --cells 8 --history link").exits(2);
    run.complains("`--history link`: that file is read").prints_nothing();
    assert_eq!(folder.read("bar.toml"), BAR);
}

/// A FIFO gets the whole history, once, and stays.
#[test]
fn what_is_no_plain_file_is_written_to() {
    let folder = Folder::new();
    let fifo = folder.path("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().expect("mkfifo").success());
    folder.mms(&format!("{RUN} --checkpoint fifo")).exits(2).complains("expected a plain file");
    let reader = thread::spawn({
        let fifo = fifo.clone();
        move || fs::read_to_string(fifo).expect("a text")
    });
    folder.mms(&format!("{RUN} --history fifo --checkpoint kept --every 7")).exits(0);
    let read = reader.join().expect("the reader ends");
    assert_eq!(read.lines().count(), LINES);
    assert!(read.starts_with("step,time,"), "{read}");
    assert!(fs::metadata(&fifo).expect("a file").file_type().is_fifo());
    let resumed = folder.mms(&format!("{RUN} --resume kept --history fifo")).exits(2);
    resumed.complains("does not hold the 35 steps");

    let printed = folder.mms(&format!("{RUN} --history /dev/stdout")).exits(0).stdout;
    assert!(printed.starts_with("step,time,") && printed.contains("8 cells"), "{printed}");
    // Also if stdout is a plain file, whose content is not replaced.
    let out = File::options().create(true).append(true).open(folder.path("out")).expect("a file");
    let status = Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(format!("{RUN} --history /dev/stdout").split_whitespace())
        .stdout(out)
        .status();
    assert!(status.expect("the program starts").success());
    let found = folder.read("out");
    assert!(printed.lines().take(LINES).eq(found.lines().take(LINES)), "{found}");
    assert_eq!(found.lines().count(), printed.lines().count());
}

/// A link given for a state is replaced; its target and the targets of links beside it are not written.
#[test]
fn states_are_not_written_through_links() {
    let all = [
        ("--time 0 -o out.csv", "out.csv"),
        ("--time 0 -o out.csv", "out.csv.json"),
        ("--time 0 -o out.vtu", "out.vtu"),
        ("--time 0,0.01 -o out.vtu", "out_0001.vtu"),
        ("--time 0,0.01 -o out.vtu", "out.pvd"),
        ("--time 0 -o out.npz", "out.npz"),
    ];
    for (options, name) in all {
        let folder = Folder::new();
        folder.write("mine", "mine");
        for target in ["mine", "nowhere"] {
            symlink(target, folder.path(name)).expect("a link");
            let run = folder.mms(&format!("state bar_1d --cells 4 {options}")).exits(2);
            run.complains(&format!("cannot write `{name}`: it is a link, which is not written to"));
            run.complains("remove it, or name another file");
            assert_eq!(folder.read("mine"), "mine", "{name}");
            assert!(!folder.path("nowhere").exists(), "{name}");
            fs::remove_file(folder.path(name)).expect("the link is still there");
        }
        folder.mms(&format!("state bar_1d --cells 4 {options}")).exits(0);
        assert!(folder.path(name).is_file(), "{name}");
    }
}

/// A link in a given folder is replaced; its target is not written.
#[test]
fn a_link_in_a_folder_of_results_is_not_written_through() {
    let folder = Folder::new();
    folder.write("mine", "mine");
    for (arguments, name) in [
        ("emit bar_1d --target c -o out", "bar_1d.c"),
        ("study bar_1d --cells 4,8,16 --output out", "convergence.json"),
        ("run bar_1d --cells 8 --output out", "run.json"),
        ("run bar_1d --cells 8 --vtk out --frames 1", "bar_1d.pvd"),
    ] {
        fs::create_dir_all(folder.path("out")).expect("a folder");
        symlink("../mine", folder.path("out").join(name)).expect("a link");
        let run = folder.mms(arguments);
        run.complains(&format!("out/{name}`")).complains("it is a link, which is not written to");
        assert!(run.exits(2).stderr.contains("remove it, or name another folder"));
        assert_eq!(folder.read("mine"), "mine", "{arguments}");
        fs::remove_file(folder.path("out").join(name)).expect("the link is still there");
        folder.mms(arguments).exits(0);
    }
    // A folder behind such a link is not written either.
    fs::create_dir_all(folder.path("elsewhere")).expect("a folder");
    symlink("../elsewhere", folder.path("out/axis_aligned_1d")).expect("a link");
    let run = folder.mms("emit --all --target c -o out").exits(2);
    run.complains("cannot write to `out/axis_aligned_1d`")
        .complains("it is a link, which is not written to");
    assert_eq!(fs::read_dir(folder.path("elsewhere")).expect("a folder").count(), 0);
    // A FIFO is not written either, since it may have no reader.
    let fifo = folder.path("out/report.html");
    assert!(Command::new("mkfifo").arg(fifo).status().expect("mkfifo").success());
    folder.mms("report out").exits(2).complains("out/report.html`: it is a FIFO");
    // A link given as the folder itself is followed.
    fs::create_dir(folder.path("other")).expect("a folder");
    symlink("other", folder.path("link")).expect("a link");
    folder.mms("emit bar_1d --target c -o link").exits(0);
    assert!(folder.path("other/bar_1d.c").is_file());
}

/// The unfinished files of a process that was killed while it wrote are as large as the part that it wrote.
#[test]
fn what_a_killed_run_left_is_removed_by_the_next_one_and_nothing_else_is() {
    let folder = Folder::new();
    let [stale, other] = [".kept.mms-unfinished0", ".other.mms-unfinished0"];
    for name in [stale, other, ".run.csv.mms-unfinished0", "out/.run.json.mms-unfinished0"] {
        folder.write(name, "half");
    }
    folder
        .mms(&format!("{RUN} --checkpoint kept --every 1000 --history run.csv --output out"))
        .exits(0);
    let found = fs::read_dir(folder.path("")).expect("a folder");
    let mut found: Vec<_> =
        found.map(|it| it.expect("an entry").file_name().into_string().expect("a name")).collect();
    found.sort();
    assert_eq!(found, [other, "out", "run.csv"]);
    assert_eq!(fs::read_dir(folder.path("out")).expect("a folder").count(), 1);
}

/// Messages use the name that the user gave, and no other.
#[test]
fn errors_name_the_file_that_was_asked_for() {
    let folder = Folder::new();
    folder.write("file", "");
    let long = "x".repeat(300);
    for (arguments, name, reason) in [
        (
            format!("{RUN} --history missing/run.csv"),
            "missing/run.csv",
            "No such file or directory",
        ),
        (format!("{RUN} --history {long}"), long.as_str(), "File name too long"),
        (format!("{RUN} --checkpoint missing/kept"), "missing/kept", "No such file or directory"),
        (format!("{RUN} --checkpoint file/kept"), "file/kept", "Not a directory"),
        (format!("{RUN} --output file/out"), "file/out", "Not a directory"),
        ("emit bar_1d --target c -o file/out".into(), "file/out", "Not a directory"),
    ] {
        let run = folder.mms(&arguments).exits(2);
        run.complains(&format!("{name}`")).complains(reason);
        assert!(!run.stderr.contains("unfinished") && !run.stderr.contains(".tmp"), "{run}");
    }
}

/// A message that cannot be written is lost, and nothing else.
#[test]
#[cfg(target_os = "linux")]
fn a_full_stderr_stops_nothing() {
    let folder = Folder::with_bar("bar.toml");
    let broken = "[field]\ntitle = 3\n";
    folder.write("wrong.toml", broken);
    let cases = [
        ("check wrong.toml", 2),
        ("run bar_1d --cells 8 --output out", 0),
        ("run nothing", 2),
        ("study bar_1d --cells 4,8,16 --output out", 0),
    ];
    for (arguments, code) in cases {
        let full = File::options().write(true).open("/dev/full").expect("a device");
        let status = Command::new(env!("CARGO_BIN_EXE_mms"))
            .args(arguments.split_whitespace())
            .current_dir(folder.path(""))
            .stdout(Stdio::null())
            .stderr(full)
            .status()
            .expect("the program starts");
        assert_eq!(status.code(), Some(code), "{arguments}");
    }
    assert!(folder.path("out/run.json").is_file() && folder.path("out/convergence.json").is_file());
}
