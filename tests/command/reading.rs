//! Reading files: only plain files, and no more of each than its kind may hold.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::os::unix::net::UnixListener;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::mms::{BAR, Folder};

/// A size that no file may have; the file takes no space on disk.
const HUGE: u64 = 3 << 30;

/// A memory limit in KiB, far more than a command needs if it reads no more than it may.
const MEMORY: &str = "1500000";

fn sparse(folder: &Folder, name: &str) {
    File::create(folder.path(name)).expect("a file").set_len(HUGE).expect("a length");
}

fn fifo(folder: &Folder, name: &str) {
    assert!(Command::new("mkfifo").arg(folder.path(name)).status().expect("mkfifo").success());
}

/// Runs a command that has to end soon, in little memory; returns its exit code and stderr.
fn soon(folder: &Folder, arguments: &str) -> (Option<i32>, String) {
    let script = format!("ulimit -v {MEMORY}; exec {} {arguments}", env!("CARGO_BIN_EXE_mms"));
    let mut command = Command::new("sh");
    let command = command.args(["-c", &script]).current_dir(folder.path(""));
    let command = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut process: Child = command.spawn().expect("a shell");
    let start = Instant::now();
    while process.try_wait().expect("a child").is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            process.kill().expect("it was started");
            panic!("`{arguments}` hangs");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = process.wait_with_output().expect("it ended");
    (output.status.code(), String::from_utf8(output.stderr).expect("a text"))
}

/// Puts files that are not plain or too long into a folder, under names of a kind; returns them with the expected messages.
fn odd_files(folder: &Folder, extension: &str) -> Vec<(String, &'static str)> {
    let name = |stem: &str| format!("{stem}.{extension}");
    sparse(folder, &name("sparse"));
    fifo(folder, &name("fifo"));
    UnixListener::bind(folder.path(&name("socket"))).expect("a socket");
    for (link, target) in
        [("zero", "/dev/zero"), ("nowhere", "missing"), ("circle", &name("circle"))]
    {
        symlink(target, folder.path(&name(link))).expect("a link");
    }
    let said = [
        ("sparse", "it has more than "),
        ("fifo", "it is a FIFO"),
        ("socket", "it is a socket"),
        ("zero", "it is a device"),
        ("nowhere", "it is a link that leads nowhere"),
        ("circle", "symbolic link"),
    ];
    said.map(|(stem, said)| (name(stem), said)).into()
}

#[test]
fn a_field_or_a_study_that_is_no_plain_file_is_refused() {
    let folder = Folder::new();
    let mut cases = odd_files(&folder, "toml");
    fs::create_dir(folder.path("folder.toml")).expect("a folder");
    cases.push(("folder.toml".into(), "it is a folder"));
    for (file, complaint) in cases {
        for command in ["check FILE", "show FILE", "run FILE", "study --study FILE"] {
            let command = command.replace("FILE", &file);
            let (code, said) = soon(&folder, &command);
            assert_eq!(code, Some(2), "{command}: {said}");
            assert!(said.contains(&format!("cannot read `{file}`")), "{command}: {said}");
            assert!(said.contains(complaint), "{command}: {said}");
        }
    }
}

#[test]
fn a_material_that_is_no_plain_file_is_refused_where_it_is_named() {
    let folder = Folder::new();
    for (file, complaint) in odd_files(&folder, "toml") {
        folder.write("bar.toml", &BAR.replace("\"neo_hookean\"", &format!("\"./{file}\"")));
        let (code, said) = soon(&folder, "check bar.toml");
        assert_eq!(code, Some(2), "{file}: {said}");
        assert!(said.contains("bar.toml:20:11") && said.contains(complaint), "{file}: {said}");
    }
}

#[test]
fn a_page_names_what_is_no_plain_file_and_leaves_it_out() {
    let folder = Folder::new();
    folder.mms("run bar_1d --cells 8 --output all --vtk all --frames 1").exits(0);
    fs::create_dir(folder.path("json")).expect("a folder");
    let cases = [odd_files(&folder, "json"), odd_files(&folder, "pvd")].concat();
    for (file, _) in &cases {
        fs::rename(folder.path(file), folder.path("all").join(file)).expect("moved");
    }
    let (code, said) = soon(&folder, "report all");
    assert_eq!(code, Some(0), "{said}");
    let page = folder.read("all/report.html");
    for (file, complaint) in &cases {
        let named = |text: &str| {
            text.lines().any(|it| it.contains(&format!("{file}: ")) && it.contains(complaint))
        };
        assert!(named(&said), "{file}: {said}");
        assert!(page.contains(&format!("{file}: ")), "{file}");
    }
    // Odd files are no states either.
    for (file, complaint) in odd_files(&folder, "vtu") {
        fs::remove_file(folder.path("all/bar_1d_0000.vtu")).expect("it was there");
        fs::rename(folder.path(&file), folder.path("all/bar_1d_0000.vtu")).expect("moved");
        if file == "circle.vtu" {
            continue;
        }
        let (code, said) = soon(&folder, "report all");
        assert_eq!(code, Some(0), "{said}");
        let line = said.lines().find(|line| line.contains("bar_1d.pvd")).unwrap_or_default();
        assert!(line.contains(complaint), "{file}: {said}");
    }
    // A list leads only to files beside it.
    let list = folder.read("all/bar_1d.pvd");
    for other in ["/dev/zero", "../all/bar_1d_0001.vtu"] {
        folder.write("all/bar_1d.pvd", &list.replace("bar_1d_0000.vtu", other));
        let (_, said) = soon(&folder, "report all");
        assert!(said.contains("is no name of a file beside it"), "{said}");
    }
}

#[test]
fn a_store_sets_aside_what_is_no_plain_file() {
    let folder = Folder::new();
    let run = "verify --row time/usl --quick --store store";
    folder.mms(run).exits(0);
    for (file, complaint) in odd_files(&folder, "json") {
        if file == "circle.json" || file == "nowhere.json" {
            continue;
        }
        fs::rename(folder.path(&file), folder.path("store").join(&file)).expect("moved");
        let (code, said) = soon(&folder, run);
        assert_eq!(code, Some(0), "{file}: {said}");
        assert!(said.contains(complaint) && said.contains(&format!("{file}.aside1")), "{said}");
    }
}

#[test]
fn a_checkpoint_or_a_history_that_is_none_is_refused_at_once() {
    let folder = Folder::new();
    let run = "run bar_1d --cells 8";
    for (file, complaint) in odd_files(&folder, "checkpoint") {
        let (code, said) = soon(&folder, &format!("{run} --resume {file}"));
        assert_eq!(code, Some(2), "{file}: {said}");
        // For a plain file, the memory for its state is checked first.
        let is_named = match file.starts_with("sparse") {
            true => said.contains("no whole checkpoint") || said.contains("cannot hold its state"),
            false => said.contains(complaint) || said.contains("no whole checkpoint"),
        };
        assert!(said.contains(&format!("`{file}`")) && is_named, "{file}: {said}");
    }
    folder.mms(&format!("{run} --checkpoint kept --every 7 --history run.csv")).exits(0);
    for (file, _) in odd_files(&folder, "csv") {
        if file == "sparse.csv" {
            continue;
        }
        let (code, said) = soon(&folder, &format!("{run} --resume kept --history {file}"));
        assert_eq!(code, Some(2), "{file}: {said}");
        assert!(said.contains("does not hold the 35 steps"), "{file}: {said}");
    }
    let (code, said) = soon(&folder, &format!("{run} --resume kept --history sparse.csv"));
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("were changed since"), "{said}");
}

#[test]
fn emitted_files_are_compared_with_plain_files_alone() {
    let folder = Folder::new();
    folder.mms("emit bar_1d --target python -o out").exits(0);
    let names = fs::read_dir(folder.path("out")).expect("a folder");
    let name =
        names.map(|it| it.unwrap().file_name().into_string().unwrap()).next().expect("a file");
    fs::remove_file(folder.path("out").join(&name)).expect("it was there");
    sparse(&folder, &format!("out/{name}"));
    let (code, said) = soon(&folder, "emit bar_1d --target python -o out --check");
    assert_eq!(code, Some(1), "{said}");
    fs::remove_file(folder.path("out").join(&name)).expect("it was there");
    fifo(&folder, &format!("out/{name}"));
    let (code, said) = soon(&folder, "emit bar_1d --target python -o out --check");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("it is a FIFO"), "{said}");
}
